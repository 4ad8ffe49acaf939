"""What a comparison says, in sentences."""

from __future__ import annotations

import numpy as np

from bellows_design.measured.comparison import Comparison
from bellows_design.measured.factor.departure import Departure
from bellows_design.measured.factor.fit import Factor
from bellows_design.validation.quoting import quoted

NEAR = 0.02
"""Of the highest pressure: a departure that ends so near to it goes to the end."""


def sentences(found: Comparison) -> tuple[str, ...]:
    """The verdict first, then what limits it."""
    said = [_verdict(found), *_band(found), *_departed(found), *_limits(found)]
    return tuple(each for each in said if each)


def _verdict(found: Comparison) -> str:
    factor = found.factor
    if factor is None:
        return f"No factor: {found.fitted.refused}" if found.fitted.refused else ""
    sheet, name = "the data sheet", quoted(found.material.name)
    interval = f"({_number(factor.low)} to {_number(factor.high)})"
    if factor.agrees:
        return (
            f"Your print agrees with {sheet} of {name}: it is {_number(factor.value)} times as "
            f"stiff {interval}."
        )
    return (
        f"Your print is {_number(factor.value)} times as stiff as {sheet} {interval}, that of "
        f"{name}."
    )


def _band(found: Comparison) -> list[str]:
    reached, count = found.reached, found.measured.value.size
    if not reached:
        return ["The model as designed reaches none of the measured pressures."]
    what = "error"
    if found.material_percent is not None:
        what += f" and ± {found.material_percent:.3g} % of the material's stiffness"
    inside = int(found.inside.sum())
    text = (
        f"{inside} of {reached} points lie within the model's band as designed, by its estimated "
        f"{what}."
    )
    if reached < count:
        text += f" It does not reach the other {count - reached}."
    if found.material_percent is None:
        text += (
            " The material does not say how uncertain it is; --material-uncertainty PERCENT does."
        )
    return [text]


def _departed(found: Comparison) -> list[str]:
    """Where no factor helps."""
    if not found.departures:
        return []
    places = "; ".join(_place(each, found) for each in found.departures)
    factor = found.factor
    if factor is None:
        return [f"The model as designed departs from the measurement: {places}."]
    return [f"A factor does not explain all of it{_left(factor, found)}: {places}."]


def _left(factor: Factor, found: Comparison) -> str:
    before, after = factor.difference
    unit, largest = found.measured.quantity.unit, float(np.abs(found.measured.value).max())
    share = f"{after:.3g} {unit}, {100 * after / largest:.2g} % of the largest value"
    if not np.isfinite(before):
        return f", which leaves a mean difference of {share}"
    return f": it brings the mean difference from {before:.3g} to {share}"


def _place(each: Departure, found: Comparison) -> str:
    unit = found.measured.quantity.unit
    more = "more" if each.largest > 0 else "less"
    highest = float(found.pressure.max())
    span = (
        f"from {each.start:.4g} MPa on"
        if each.end > (1 - NEAR) * highest
        else f"from {each.start:.4g} to {each.end:.4g} MPa"
    )
    return (
        f"{span} the part has up to {abs(each.largest):.3g} {unit} {more} than the model (at "
        f"{each.pressure:.4g} MPa)"
    )


def _limits(found: Comparison) -> list[str]:
    """What was left out, and why."""
    factor, said = found.factor, []
    if factor is not None and factor.beyond:
        why = found.model.ending or "the model is not known further"
        said.append(
            f"{factor.beyond} points at the highest pressures tell nothing of the factor: {why}."
        )
    elif _ends_early(found):
        said.append(f"{found.model.ending[0].upper()}{found.model.ending[1:]}.")
    if factor is not None and factor.offset is not None:
        unit = found.measured.quantity.unit
        said.append(
            f"All measured values have {factor.offset:.3g} {unit} more in common than the model."
        )
    if factor is not None and not 0.4 <= factor.value <= 2.5:
        said.append(
            "So large a difference is seldom the filament's: check units, wall thickness, clamping "
            "and pressure before you believe it."
        )
    return said


def _ends_early(found: Comparison) -> bool:
    """Whether the model's end is the reason for what is missing, and not said with the factor."""
    ending, refused = found.model.ending, found.fitted.refused
    short = found.reached < found.measured.value.size
    return bool(ending) and found.factor is None and short and ending not in refused


def _number(value: float) -> str:
    """A factor with as many digits as say something."""
    return f"{value:.2f}" if value >= 0.1 else f"{value:.2g}"
