"""What Newton's method does and finds at one load."""

from __future__ import annotations

from dataclasses import dataclass

from solver.assembly.assembly import Equilibrium
from solver.assembly.state import State


class NoCorrection(Exception):
    """Newton's method cannot continue; the message says why."""


@dataclass(frozen=True)
class Correction:
    """One correction of ``state``, where ``equilibrium`` holds: by ``increment``, to ``moved``.

    ``size``: the largest node's, mm; ``pressure_size``: the largest one of the hydrostatic
    pressure, relative to the initial shear modulus and the pressure itself.
    """

    state: State
    equilibrium: Equilibrium
    increment: State
    moved: State
    size: float
    pressure_size: float


@dataclass(frozen=True)
class Attempt:
    """Newton's outcome at one load: a state in equilibrium, or why there is none.

    ``imbalance``: the residual left there, relative to that of the load alone. ``direction``: the
    equilibrium's derivative with respect to the load, if requested. ``touched``: whether there was
    contact in any iteration. ``guarded``: it is an equilibrium that the caller does not accept.
    """

    state: State
    iterations: int
    failure: str = ""
    imbalance: float = 0.0
    direction: State | None = None
    touched: bool = False
    guarded: bool = False
