"""Time of a chain's equilibrium, and its error, against the number of pieces.

    python tests/benchmarks/chain_solves.py [OUTPUT.json]

A beam of a finger's size and bending stiffness curls under pressure, alone, against a load cell,
against a wall and around a cylinder with friction. Times, of the processor, are those of one solve
from the state before, with its record, along equal steps in pressure; the error is that of
the tip's place at the last one, as part of the length, against a chain of many pieces.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median

import numpy as np

from bellows_design.force.chain import path as chain_path
from bellows_design.force.chain.contact.obstacles import Disc, Plane
from bellows_design.force.chain.finger.chain import Chain, Piece
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import follow_loads, rest
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import Hold, LoadPoint, Surroundings
from bellows_design.force.section_law import LinearLaw

LENGTH, BENDING, CURL, PRESSURE = 50.0, 800.0, 0.4, 0.1
STEPS, PIECES, FINE = 20, (6, 10, 14, 20, 40), 160
SCENES = {
    "free": Surroundings(),
    "load cell": Surroundings(hold=Hold.load_cell()),
    "wall": Surroundings(objects=(Plane((0.0, -8.0), (0.0, 1.0)),)),
    "cylinder, friction": Surroundings(objects=(Disc((30.0, -22.0), 14.0),), friction=0.4),
}


@dataclass(frozen=True)
class Row:
    """A scene with so many pieces: CPU milliseconds and Newton iterations a solve, tip's error."""

    scene: str
    pieces: int
    solve_ms: float
    iterations: float
    attempts: int
    error: float


def beam(count: int) -> Chain:
    """Pieces of equal length, backward and forward in turn."""
    size = LENGTH / count
    law = LinearLaw(size, np.diag([size / BENDING, 0.0, 0.0]), np.array([CURL * size, 0.0, 0.0]))
    return Chain(tuple(Piece(law, number % 2 == 0) for number in range(count)))


def solved(around: Surroundings, count: int) -> tuple[list[ChainState], list[float]]:
    """States of the steps, and the time of every attempt (ms)."""
    loaded = LoadedChain.of(beam(count), around)
    times: list[float] = []
    attempt = chain_path._attempt

    def timed(*given: object) -> object:
        start = time.process_time()
        outcome = attempt(*given)  # type: ignore[arg-type]
        times.append(1e3 * (time.process_time() - start))
        return outcome

    chain_path._attempt = timed  # type: ignore[assignment]
    try:
        loads = [LoadPoint(float(each)) for each in np.linspace(0, PRESSURE, STEPS + 1)]
        path = follow_loads(loaded, rest(loaded), loads)
    finally:
        chain_path._attempt = attempt
    if path.ending:
        raise RuntimeError(path.ending.sentence)
    return list(path.steps[1:]), times


def rows() -> list[Row]:
    """All scenes and numbers of pieces."""
    found = []
    for name, around in SCENES.items():
        exact = np.array(solved(around, FINE)[0][-1].tip[:2])
        for count in PIECES:
            states, times = solved(around, count)
            error = np.hypot(*(np.array(states[-1].tip[:2]) - exact)) / LENGTH
            iterations = float(np.mean([state.iterations for state in states]))
            found.append(Row(name, count, median(times), iterations, len(times), float(error)))
    return found


def main(output: Path) -> None:
    """Print the table, write it as JSON."""
    print("| scene | pieces | CPU ms a solve, median | iterations | attempts | error of the tip |")
    print("|" + "---|" * 6)
    found = rows()
    for row in found:
        print(
            f"| {row.scene} | {row.pieces} | {row.solve_ms:.1f} | {row.iterations:.1f} "
            f"| {row.attempts} | {100 * row.error:.3f} % |"
        )
    output.write_text(json.dumps([asdict(row) for row in found], indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_suffix(".json"))
