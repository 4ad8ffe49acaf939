"""Made-up responses of a design: products of powers of its lengths, with exact derivatives.

They have the signs and sizes of those of the design ``finger``, so that what is sought among them
is bounded by the same limits, at no cost.
"""

from __future__ import annotations

import math

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.design.variation import parameters
from bellows_design.neighbours.distance import distance

REFERENCE = {
    "bubble_width": 20.0,
    "bubble_height": 20.0,
    "bubble_thickness": 1.2,
    "tendon_width": 4.0,
    "tendon_height": 5.5,
    "tendon_thickness": 1.2,
    "chamber_length": 1.8,
    "bubble_distance": 0.6,
    "inner_fillet": 0.6,
    "indent.width": 2.4,
}
ANGLE = {
    "bubble_width": 1.2,
    "bubble_height": 0.46,
    "bubble_thickness": -1.0,
    "tendon_width": -0.13,
    "tendon_height": -0.39,
    "chamber_length": -0.15,
    "inner_fillet": -0.05,
    "indent.width": 0.02,
}
STRESS = {
    "bubble_width": 0.98,
    "bubble_height": 0.35,
    "bubble_thickness": -0.24,
    "tendon_width": 0.06,
    "tendon_height": -0.26,
    "chamber_length": -0.66,
    "inner_fillet": -0.15,
    "indent.width": -0.055,
}
DEGREES_A_BUBBLE, MPA, MM3_A_BUBBLE = 60.0, 4.0, 1000.0


def answered(question: Question) -> Answer:
    """The made-up answer to a question."""
    given = parameters(question.design)
    count = question.design.bellows.bubble_count
    angle = DEGREES_A_BUBBLE * count * _product(given, ANGLE)
    stress = MPA * _product(given, STRESS)
    volume = MM3_A_BUBBLE * count * given["bubble_width"] * given["bubble_height"] / 400
    derivatives = {
        "bending_angle_deg": _slopes(given, ANGLE, angle),
        "max_von_mises_mpa": _slopes(given, STRESS, stress),
        "cavity_volume_mm3": _slopes(given, {"bubble_width": 1, "bubble_height": 1}, volume),
    }
    near = not isinstance(question.start, str)
    return Answer(
        key=question.key,
        digest=question.design.digest,
        bending_angle_deg=angle,
        bending_angle_error_percent=1.0,
        max_von_mises_mpa=stress,
        max_von_mises_error_percent=2.0,
        cavity_volume_mm3=volume,
        highest_strain=stress / 10,
        smallest_gap_mm=given["bubble_distance"] - 0.45,
        origin="neighbour" if near else "ordinary",
        distance=distance(question.start, question.design) if near else 0.0,
        seconds=1.0,
        derivatives=derivatives if question.derivatives else None,
    )


def _product(given: dict[str, float], powers: dict[str, float]) -> float:
    """A full round, which is no parameter, counts as what it follows."""
    known = given | {"inner_fillet": given.get("inner_fillet", given["chamber_length"] / 2)}
    return math.prod(
        (known[name] / REFERENCE[name]) ** power for name, power in powers.items() if name in known
    )


def _slopes(given: dict[str, float], powers: dict[str, float], value: float) -> dict[str, float]:
    slopes = dict.fromkeys(given, 0.0)
    for name, power in powers.items():
        if name in given:
            slopes[name] += power * value / given[name]
        elif name == "inner_fillet":
            slopes["chamber_length"] += power * value / given["chamber_length"]
    return slopes
