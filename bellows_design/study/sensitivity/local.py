"""What the derivatives at a design say of its highest stress itself, and by percent.

The derivative of the stress is that of a smooth maximum a few percent above the highest one; both
are taken to change by the same fraction.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from bellows_design.neighbours.sensitivities import RESPONSES, STRESS

if TYPE_CHECKING:
    from bellows_design.batch.answer import Answer
    from bellows_design.neighbours.sensitivities import Sensitivities

STRENGTH = 0.02
"""Parameters whose elasticities are all below this share of their response's largest have no part
in a global study: linearly 0.04 % of its variance."""


def values(found: Sensitivities) -> dict[str, float]:
    """Of the responses at the design: °, mm³, MPa."""
    return {name: found.responses[name] / _above(name, found) for name in RESPONSES}


def slopes(found: Sensitivities) -> dict[str, dict[str, float]]:
    """Of each response (°, mm³, MPa) by each parameter (mm, MPa): response -> parameter."""
    return {
        response: {
            each.parameter: each.derivatives[response] / _above(response, found)
            for each in found.parameters
        }
        for response in RESPONSES
    }


def slopes_of(answer: Answer, found: Sensitivities) -> dict[str, dict[str, float]]:
    """The same at another design near the one of ``found``; empty without derivatives there."""
    return {
        response: {name: value / _above(response, found) for name, value in row.items()}
        for response, row in (answer.derivatives or {}).items()
    }


def strongest(found: Sensitivities) -> tuple[str, ...]:
    """Parameters that have a part in a global study."""
    limits = {name: STRENGTH * _largest(name, found) for name in RESPONSES}
    return tuple(
        each.parameter
        for each in found.parameters
        if any(_reaches(each.elasticities, name, limit) for name, limit in limits.items())
    )


def _above(response: str, found: Sensitivities) -> float:
    """How far what the derivatives are of lies above the response, as a factor."""
    return found.smooth_peak_ratio if response == STRESS else 1.0


def _largest(response: str, found: Sensitivities) -> float:
    return max(abs(each.elasticities[response] or 0.0) for each in found.parameters)


def _reaches(elasticities: Mapping[str, float | None], response: str, limit: float) -> bool:
    return limit > 0 and abs(elasticities[response] or 0.0) >= limit
