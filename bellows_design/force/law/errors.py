"""How far off a law may be."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.analysis.error_estimate import ENDS_ERROR, FREE_REACH_ERROR, REACH_ERROR


@dataclass(frozen=True)
class LawError:
    """Estimated errors of rotations, rad.

    Attributes:
        interpolation: of half a bubble between the points of the table: twice the largest
            at points that were computed to see it, or by how much two interpolations differ
            within rows, and between rows without such points.
        mesh: of half a bubble, by the mesh: what the last refinement changed at the design's
            pressure, and how much less the correction for it fits where neighbours press each
            other.
        ends: of either end: what is uncertain about the short actuator that stands for them.
        stress_percent: of the highest stress; None where nothing is known.
        complete: whether the table is as fine as was asked for; else the time was over.
    """

    interpolation: float
    mesh: float
    ends: float
    stress_percent: float | None
    complete: bool = True


def ends_error(added: float, free: float, with_stubs: bool) -> float:
    """Of one end without a moment, rad, as an evaluation takes it.

    ``added``: by which it turns more than half a bubble, which turns by ``free``, rad.
    ``with_stubs``: the end is half of an actuator of one bubble, else half a bubble by itself.
    """
    reach = REACH_ERROR if with_stubs else FREE_REACH_ERROR
    return ENDS_ERROR * abs(added) + reach * abs(free)
