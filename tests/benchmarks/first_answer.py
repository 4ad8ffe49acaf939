"""Seconds of a first answer, this checkout against another one, on the designs of the paper.

    python tests/benchmarks/first_answer.py OTHER_CHECKOUT [rounds] [results.json]

Two long-lived processes, one on the code of each checkout, evaluate the 13 designs of the paper and
``finger`` at default accuracy in turn, so that both share what else the machine does. Prints
Markdown: medians of so many rounds (three without) in seconds of wall and of processor, ratios,
angle and stress, and how far they moved in units of the other's error estimates. Then the command
``bellows evaluate prototype_1``, each time in a new process. A first round of both, in which
functions may be compiled, does not count.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).parents[2]
COMMAND = ("-m", "bellows_design", "evaluate", "prototype_1", "--json")


@dataclass(frozen=True)
class Comparison:
    """One design on both checkouts; seconds are medians, ``other`` is what is compared with.

    ``angle_moved`` and ``stress_moved`` are in units of the other's error estimates.
    """

    label: str
    seconds: float
    other_seconds: float
    ratio: float
    processor_ratio: float
    angle_deg: float
    other_angle_deg: float
    angle_moved: float
    stress_mpa: float
    other_stress_mpa: float
    stress_moved: float

    @property
    def row(self) -> str:
        """A line of the table."""
        return (
            f"| {self.label} | {self.other_seconds:.2f} | {self.seconds:.2f} | {self.ratio:.2f} "
            f"| {self.processor_ratio:.2f} | {self.other_angle_deg:.3f} | {self.angle_deg:.3f} "
            f"| {self.angle_moved:.3f} | {self.other_stress_mpa:.4f} | {self.stress_mpa:.4f} "
            f"| {self.stress_moved:.3f} |"
        )


HEADINGS = (
    "design", "other, s", "this, s", "ratio", "of processor", "other, °", "this, °",
    "moved, estimates", "other, MPa", "this, MPa", "moved, estimates",
)  # fmt: skip


class Evaluator:
    """A process on the code of one checkout, which evaluates designs by number."""

    def __init__(self, checkout: Path) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-P", __file__, "--here"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment(checkout),
            cwd=checkout,
            encoding="utf-8",
        )

    def evaluated(self, number: int) -> dict[str, Any]:
        """What ``here`` says about the design of that number."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(f"{number}\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline()
        if not answer:
            raise RuntimeError(f"the evaluating process ended: {self._process.wait()}")
        return dict(json.loads(answer))

    def close(self) -> None:
        """End the process."""
        self._process.communicate()


def environment(checkout: Path) -> dict[str, str]:
    """Variables of a process on the code of a checkout, without kept results."""
    kept = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    return kept | {"PYTHONPATH": str(checkout)}


def labels() -> list[str]:
    """Names of the designs in their order."""
    from bellows_design.study.paper import TABLE_4

    return [*(result.label for result in TABLE_4), "finger"]


def here() -> None:
    """Evaluate the designs whose numbers come in, and write what was found."""
    from bellows_design.design.shipped import load_design
    from bellows_design.evaluation import evaluate
    from bellows_design.study.paper import TABLE_4

    designs = [*(result.build() for result in TABLE_4), load_design("finger")]
    for line in sys.stdin:
        wall, processor = time.perf_counter(), time.process_time()
        found = evaluate(designs[int(line)])
        taken = {
            "seconds": time.perf_counter() - wall,
            "processor": time.process_time() - processor,
        }
        estimates = found.error_estimate
        numbers = {
            "angle": found.bending_angle_deg,
            "stress": found.max_von_mises_mpa,
            "angle_percent": estimates.bending_angle_percent,
            "stress_percent": estimates.max_von_mises_percent,
            "factorizations": found.solver.factorizations,
        }
        print(json.dumps(taken | numbers), flush=True)


def compared(label: str, runs: list[tuple[dict[str, Any], dict[str, Any]]]) -> Comparison:
    """One design from pairs of runs, on this checkout and on the other."""
    ours, theirs = runs[-1]
    seconds, other_seconds = (median(pair[side]["seconds"] for pair in runs) for side in (0, 1))
    processor = [median(pair[side]["processor"] for pair in runs) for side in (0, 1)]
    return Comparison(
        label=label,
        seconds=seconds,
        other_seconds=other_seconds,
        ratio=median(one["seconds"] / other["seconds"] for one, other in runs),
        processor_ratio=processor[0] / processor[1],
        angle_deg=ours["angle"],
        other_angle_deg=theirs["angle"],
        angle_moved=moved(ours["angle"], theirs["angle"], theirs["angle_percent"]),
        stress_mpa=ours["stress"],
        other_stress_mpa=theirs["stress"],
        stress_moved=moved(ours["stress"], theirs["stress"], theirs["stress_percent"]),
    )


def moved(value: float, other: float, percent: float) -> float:
    """Distance of two values in units of the second one's estimate."""
    return abs(value - other) / abs(percent / 100 * other)


def in_turn(checkout: Path, rounds: int) -> Iterator[Comparison]:
    """Each design on both checkouts in turn, which begins changing from round to round."""
    ours, theirs = Evaluator(ROOT), Evaluator(checkout)
    ours.evaluated(0), theirs.evaluated(0)
    for number, label in enumerate(labels()):
        runs = []
        for turn in range(rounds):
            if turn % 2:
                other = theirs.evaluated(number)
                runs.append((ours.evaluated(number), other))
            else:
                own = ours.evaluated(number)
                runs.append((own, theirs.evaluated(number)))
        yield compared(label, runs)
    ours.close()
    theirs.close()


def command_seconds(checkout: Path) -> float:
    """How long the cold command takes on a checkout, with a folder of its own for results."""
    with tempfile.TemporaryDirectory() as folder:
        variables = environment(checkout) | {"XDG_CACHE_HOME": folder}
        start = time.perf_counter()
        subprocess.run(
            [sys.executable, *COMMAND],
            env=variables, cwd=folder, check=True, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )  # fmt: skip
        return time.perf_counter() - start


def commands(checkout: Path, rounds: int) -> tuple[float, float, float]:
    """Median seconds of the cold command, here and there, and the median of their ratios."""
    pairs = [(command_seconds(ROOT), command_seconds(checkout)) for _ in range(rounds + 1)][1:]
    ours, theirs = zip(*pairs, strict=True)
    return median(ours), median(theirs), median(one / other for one, other in pairs)


def main(checkout: str, rounds: str = "3", results: str = "") -> None:
    """Print the tables as they come, and write them as JSON."""
    other, count = Path(checkout).resolve(), int(rounds)
    print("| " + " | ".join(HEADINGS) + " |\n" + "|---" * len(HEADINGS) + "|")
    found = []
    for comparison in in_turn(other, count):
        found.append(comparison)
        print(comparison.row, flush=True)
    middle = median(each.ratio for each in found)
    ours, theirs, ratio = commands(other, count)
    print(f"\nMedian ratio of the designs: {middle:.2f}.")
    print(f"`bellows evaluate prototype_1`: {ours:.2f} s against {theirs:.2f} s, {ratio:.2f}.")
    if results:
        command = {"seconds": ours, "other_seconds": theirs, "ratio": ratio}
        record = {"designs": [asdict(each) for each in found], "median_ratio": middle}
        Path(results).write_text(json.dumps(record | {"command": command}, indent=2) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--here"]:
        here()
    else:
        main(*sys.argv[1:])
