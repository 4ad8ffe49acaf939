"""A solve after a load step: enough to continue it with the same bits.

With contact of surfaces to rounding only: what a solve touched before decides the order of its
elimination (``solver.assembly.pairs.coupling``).
"""

from __future__ import annotations

import os
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from solver.arrays import Reals
from solver.assembly.state import State
from solver.errors import SolverError
from solver.input_types import file_path
from solver.results.solution import PathPoint


@dataclass
class Effort:
    """Running counts of a solve."""

    iterations: int = 0
    factorizations: int = 0
    load_steps: int = 0
    refused_steps: int = 0

    @property
    def steps(self) -> int:
        """Accepted and refused ones."""
        return self.load_steps + self.refused_steps


@dataclass(frozen=True)
class Checkpoint:
    """An accepted load step, with the data that the next one depends on.

    Attributes:
        reached: equilibrium at ``load``.
        load: fraction of the whole load.
        step: length of the next step, as a fraction of the whole load.
        direction: derivative of the equilibrium with respect to the load; zero at the whole load.
        points: the path so far.
        effort: counts so far, in the order of ``Effort``.

    Examples:
        >>> import numpy as np
        >>> from solver import Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.002))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> kept = []
        >>> whole = solve(bar, listener=lambda event: kept.append(event.checkpoint))
        >>> first = next(checkpoint for checkpoint in kept if checkpoint is not None)
        >>> again = solve(bar, resume=first)
        >>> print(first.load, np.array_equal(again.displacement, whole.displacement))
        0.1 True
    """

    reached: State
    load: float
    step: float
    direction: State
    points: tuple[PathPoint, ...]
    effort: tuple[int, int, int, int]

    def save(self, path: Path | str) -> None:
        """Write to ``path``, completely or not at all."""
        path = file_path("checkpoint: path", path)
        temporary = path.with_name(f".{path.name}.{os.getpid()}")
        try:
            with temporary.open("wb") as file:
                np.savez(file, **self._arrays())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)

    @staticmethod
    def load_from(path: Path | str) -> Checkpoint:
        """Read what ``save`` wrote. Raises ``SolverError`` if the file holds anything else."""
        path = file_path("checkpoint: path", path)
        try:
            with np.load(path, allow_pickle=False) as file:
                return _checkpoint({name: file[name] for name in file.files})
        except (KeyError, ValueError, TypeError, EOFError, BadZipFile) as error:
            name = Path(path).name
            raise SolverError(f"checkpoint: {name} does not hold one ({error}).") from error

    def _arrays(self) -> dict[str, Any]:
        points = np.array([[np.nan if v is None else v for v in astuple(p)] for p in self.points])
        states = {
            f"{name}_{field.name}": getattr(getattr(self, name), field.name)
            for name in STATES
            for field in fields(State)
        }
        numbers = np.array([self.load, self.step])
        return {"numbers": numbers, "points": points, "effort": np.array(self.effort), **states}


STATES = ("reached", "direction")


def _checkpoint(arrays: dict[str, Any]) -> Checkpoint:
    load, step = (float(number) for number in arrays["numbers"])
    reached, direction = (
        State(*(arrays[f"{name}_{field.name}"] for field in fields(State))) for name in STATES
    )
    iterations, factorizations, steps, refused = (int(count) for count in arrays["effort"])
    return Checkpoint(
        reached=reached,
        load=load,
        step=step,
        direction=direction,
        points=tuple(_point(row) for row in arrays["points"]),
        effort=(iterations, factorizations, steps, refused),
    )


def _point(row: Reals) -> PathPoint:
    pressure, rotation, iterations, stress, volume, load, *answers = (float(v) for v in row)
    known = [None if np.isnan(answer) else bool(answer) for answer in answers]
    return PathPoint(pressure, rotation, int(iterations), stress, volume, load, *known)
