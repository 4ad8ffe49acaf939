"""A verification case: what is claimed, who says what is right, and how to compute it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One compared number.

    ``tolerance`` is relative to the reference, unless ``absolute``. ``digits``: how many
    significant digits of ours are printed; every machine must agree on them.
    """

    quantity: str
    reference: float
    ours: float
    tolerance: float
    unit: str = ""
    absolute: bool = False
    digits: int = 4

    @property
    def error(self) -> float:
        """Distance from the reference, in its own unit if ``absolute``, else as a share."""
        scale = 1.0 if self.absolute else abs(self.reference)
        return abs(self.ours - self.reference) / scale


@dataclass(frozen=True)
class Order:
    """Observed order of convergence under refinement, and the ``least`` that is accepted."""

    quantity: str
    observed: float
    least: float
    theory: str


@dataclass(frozen=True)
class Outcome:
    """What a run of a case found. ``mesh``: e.g. "864 tetrahedra; orders on 3 meshes"."""

    rows: tuple[Row, ...]
    orders: tuple[Order, ...] = ()
    mesh: str = ""


@dataclass(frozen=True)
class Case:
    """One section of ``docs/verification.md``.

    ``claim`` is a sentence that the rows show to be true, ``source`` says where the reference
    values come from. ``slow`` cases run with ``pytest -m slow``.
    """

    name: str
    claim: str
    source: str
    run: Callable[[], Outcome]
    slow: bool = False
