"""Progress of a solve, for a listener; and states that a caller does not accept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from solver.assembly.state import State
from solver.nonlinear.checkpoint import Checkpoint

Kind: TypeAlias = Literal["iteration", "step", "refused"]


@dataclass(frozen=True)
class Event:
    """Progress of a solve, for a listener.

    Attributes:
        kind: ``iteration`` after each correction, ``step`` after each accepted load step,
            ``refused`` after each rejected one.
        load: fraction of the whole load that is tried or reached.
        rotation: of the moving plane or else of the surface ``tip``, degrees.
        iteration: number of corrections in this step so far.
        correction: its largest component at a node, mm.
        checkpoint: of an accepted step on a path from zero, to resume the solve from.
        spent: fraction of the solve's budget of steps and seconds that is spent, the larger one.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.002))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> events = []
        >>> done = solve(bar, listener=events.append)
        >>> print([event.load for event in events if event.kind == "step"][-1])
        1.0
    """

    kind: Kind
    load: float
    rotation: float
    iteration: int
    correction: float
    checkpoint: Checkpoint | None = None
    spent: float = 0.0


Listener: TypeAlias = Callable[[Event], None]

Guard: TypeAlias = Callable[[State], str]
"""Why an equilibrium is not accepted, as text; empty if it is."""
