"""What is kept of a case of validation, and what the document says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

Readings: TypeAlias = dict[str, Any]
"""Name -> number, or lists and tables of numbers, as JSON has them; units stand in the names."""

Interval: TypeAlias = tuple[float, float]
"""Lowest and highest; the same number twice where there is one only."""


@dataclass(frozen=True)
class Computed:
    """What one computation returns.

    Attributes:
        readings: what was read off the solutions.
        tetrahedra: of the mesh.
        unknowns: displacements and hydrostatic pressures.
    """

    readings: Readings
    tetrahedra: int = 0
    unknowns: int = 0


@dataclass(frozen=True)
class Stored:
    """A computation as it stands in the JSON; ``seconds`` of one processor."""

    readings: Readings
    tetrahedra: int
    unknowns: int
    seconds: float


Results: TypeAlias = Mapping[str, Stored]
"""The stored computations of a case by their names."""


@dataclass(frozen=True)
class Row:
    """One measured quantity beside ours.

    Attributes:
        quantity: what it is, with the load.
        measured: over the runs, or within the measurement's spread.
        ours: over what the experiment leaves unknown, or the materials that were published.
        unit: of both.
        error: estimated error of ours by the mesh, in ``unit``; None if not estimated.
        allowed: share by which the measured interval is widened on both sides.
        agrees: whether the document claims that both intervals meet. Tests hold either claim.
    """

    quantity: str
    measured: Interval
    ours: Interval
    unit: str = ""
    error: float | None = None
    allowed: float = 0.0
    agrees: bool = True

    @property
    def band(self) -> Interval:
        """The measured interval, widened."""
        low, high = self.measured
        return low - self.allowed * abs(low), high + self.allowed * abs(high)

    @property
    def beyond(self) -> float:
        """By how much ours lies outside the band, as a share of the measured middle; signed."""
        (low, high), (least, most) = self.band, self.ours
        away = max(least - high, 0.0) - max(low - most, 0.0)
        return away / abs(sum(self.measured) / 2)

    @property
    def inside(self) -> bool:
        """Whether ours and the band meet."""
        return self.beyond == 0


@dataclass(frozen=True)
class Table:
    """A further table: cells are text as it is printed."""

    title: str
    heading: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Report:
    """A case's section. Sentences take their numbers from the results.

    Attributes:
        part: what was made and by whom; source and licence.
        measured: what was measured and how.
        posed: body, material, supports, loads, and what was read, as computed.
        rows: measured against ours.
        unknown: what the experiment does not say, and what it may change.
        verdict: how well the model does, in a sentence.
        tables: further ones, e.g. convergence and seconds.
        figure: name of a PNG in ``docs/`` that the case draws; "" for none.
    """

    part: str
    measured: str
    posed: str
    rows: tuple[Row, ...]
    unknown: str
    verdict: str
    tables: tuple[Table, ...] = ()
    figure: str = ""


@dataclass(frozen=True)
class Case:
    """A part that others made and measured: the ``CASE`` of a module ``case_NAME.py``.

    Attributes:
        title: of its section, beginning with its letter.
        computations: name -> what computes it; run in this order by ``compute.py``, stored one by
            one in ``case_NAME.json``.
        report: makes the section from the stored results.
        sample: name of the cheap computation that tests repeat; "" if nothing is computed.
        slow: whether that takes more than some two seconds.
        tolerance: relative, between a repeated reading and the stored one. Where Gmsh makes the
            mesh, another version makes another one.
        draw: draws ``Report.figure`` into a file of that path, from the stored results.
    """

    title: str
    computations: Mapping[str, Callable[[], Computed]]
    report: Callable[[Results], Report]
    sample: str = ""
    slow: bool = False
    tolerance: float = 1e-4
    draw: Callable[[Results, str], None] | None = None
