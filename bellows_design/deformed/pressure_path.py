"""Equilibria of one body at several pressures: those that were kept, else its path walked again."""

from __future__ import annotations

from collections.abc import Sequence

from solver import Solution

SAME = 1e-9
"""Of a pressure: two that differ by less are one."""

ROUGH = 1e-3
"""Newton tolerance, in units of the body's diagonal. At 1e-5 nodes of Prototype 1's cell are up to
0.005 mm elsewhere, for twice the time."""


def same_pressure(one: float, other: float) -> bool:
    """Whether two pressures are one but for rounding."""
    return abs(one - other) <= SAME * max(abs(one), abs(other))


def equilibria_at(solution: Solution, pressures: Sequence[float]) -> tuple[Solution, ...]:
    """Equilibria at ascending pressures (MPa, by size), none beyond that of ``solution``.

    Fewer, from the lowest on, where the path cannot be followed once more.
    """
    kept = [_kept(solution, pressure) for pressure in pressures]
    found = [each for each in kept if each is not None]
    return tuple(found) if len(found) == len(kept) else _walked(solution, pressures)


def _kept(solution: Solution, pressure: float) -> Solution | None:
    """What an evaluation has at a pressure; None if it has nothing there."""
    known = (*solution.at_stops, solution)
    return next((each for each in known if same_pressure(each.pressure, pressure)), None)


def _walked(known: Solution, pressures: Sequence[float]) -> tuple[Solution, ...]:
    """From the state that is known down through the pressures, or up to them from zero.

    No walls are asked whether they touch: they did not at the pressure that was reached.
    """
    from solver import SolverOptions, solve

    end = pressures[-1]
    start = (known.displacement, known.hydrostatic_pressure)
    again = solve(
        known.problem,
        end,
        SolverOptions(tolerance=ROUGH),
        initial=start if same_pressure(known.pressure, end) else None,
        stops=tuple(pressures[:-1]),
    )
    return (*again.at_stops, again) if again.converged else again.at_stops
