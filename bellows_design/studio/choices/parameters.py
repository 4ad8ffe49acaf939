"""The sliders: each parameter with its unit, bounds, step, and what it does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.conditions import Limits, Load
from bellows_design.design.design import Design
from bellows_design.design.variation import settable

GROUPS: Mapping[str, tuple[str, ...]] = {
    "Bubbles": (
        "bubble_width", "bubble_height", "bubble_thickness", "chamber_length", "bubble_distance",
        "number_of_bubbles",
    ),
    "Tendon": ("tendon_width", "tendon_height", "tendon_thickness", "length", "offset"),
    "Fillets": ("inner_fillet", "outer_fillet"),
}  # fmt: skip
"""The bellows' numbers as the page groups them."""

SPAN = 0.5
"""Of the value: how far a slider reaches to either side, within the bounds."""

LEAST_SPAN = 2.0
"""mm. Of a slider, also where the value is small or zero."""

STEPS = ((10.0, 0.5), (3.0, 0.1), (0.0, 0.05))
"""From so much (mm) on a slider moves in such steps; walls and fillets move finely."""

PRESSURE_STEP, STRESS_STEP = 0.001, 0.1


@dataclass(frozen=True)
class Slider:
    """A number that may be moved.

    Attributes:
        name: As ``--set`` takes it.
        label: For people.
        unit: mm, MPa, or empty.
        lowest: The slider's least value; ``highest`` its largest.
        step: Between two values.
        value: The opened design's; None where the number of bubbles is as many as fit.
        least: Smallest value that is admitted; ``most`` the largest.
        meaning: What it is.
        group: Of which table.
        whole: Whether it is a whole number.
        automatic: Whether the value follows from others unless it is given.
        optional: Whether it may be null.
    """

    name: str
    label: str
    unit: str
    lowest: float
    highest: float
    step: float
    value: float | None
    least: float
    most: float
    meaning: str
    group: str
    whole: bool = False
    automatic: bool = False
    optional: bool = False


def sliders(design: Design) -> list[dict[str, Any]]:
    """All sliders of a design as plain values."""
    return [asdict(slider) for slider in _sliders(design)]


def current_values(design: Design) -> dict[str, float | int | None]:
    """What the sliders show for a design, by name: fillets that followed, bubbles that fit."""
    return {slider.name: slider.value for slider in _sliders(design)}


def _sliders(design: Design) -> Iterator[Slider]:
    for group, names in GROUPS.items():
        for name in names:
            yield _bellows_slider(design, name, group)
    yield _slider("load.pressure", Load, design.load.pressure, "Load")
    yield _stress_limit(design)
    for name in ("cross_section_width", "cross_section_height"):
        yield _slider(f"limits.{name}", Limits, getattr(design.limits, name), "Limits")
    for table in ("indent", "port", "mount", "fingertip"):
        yield from _of_table(design, table)


def _bellows_slider(design: Design, name: str, group: str) -> Slider:
    if name != "number_of_bubbles":
        return _slider(name, BellowsParameters, getattr(design.bellows, name), group)
    given, count = design.bellows.number_of_bubbles, design.bellows.bubble_count
    field = BellowsParameters.model_fields[name]
    return Slider(
        name, "Number of bubbles", "", 1, max(6, 2 * count), 1, given, 1, 100,
        str(field.description), group, whole=True, automatic=given is None, optional=True,
    )  # fmt: skip


def _stress_limit(design: Design) -> Slider:
    found = _slider("limits.max_von_mises", Limits, design.max_von_mises, "Limits")
    given = design.limits.max_von_mises
    return Slider(**asdict(found) | {"automatic": given is None, "optional": True})


def _of_table(design: Design, table: str) -> Iterator[Slider]:
    """The numbers of a part that the design has."""
    part = getattr(design, table)
    if part is None:
        return
    for name in type(part).model_fields:
        value, key = getattr(part, name), f"{table}.{name}"
        numeric = isinstance(value, int | float) and not isinstance(value, bool)
        left_out = table == "indent" and key not in settable(design)
        if numeric and not left_out and _bounds(type(part).model_fields[name]) is not None:
            yield _slider(key, type(part), value, table.capitalize())


def _slider(key: str, model: type[BaseModel], value: float, group: str) -> Slider:
    name = key.rsplit(".", 1)[-1]
    field = model.model_fields[name]
    least, most = _bounds(field) or (0.0, 2 * value)
    unit, whole = _unit(field), isinstance(value, int) and field.annotation is int
    step = 1 if whole else _step(unit, value)
    lowest, highest = _range(unit, value, least, most, step)
    return Slider(
        key, name.replace("_", " ").capitalize(), unit, lowest, highest, step, value,
        least, most, str(field.description or ""), group, whole,
    )  # fmt: skip


def _bounds(field: FieldInfo) -> tuple[float, float] | None:
    least = next((rule.ge for rule in field.metadata if hasattr(rule, "ge")), None)
    most = next((rule.le for rule in field.metadata if hasattr(rule, "le")), None)
    return None if least is None or most is None else (least, most)


def _unit(field: FieldInfo) -> str:
    extra = field.json_schema_extra
    return str(extra.get("unit", "")) if isinstance(extra, dict) else ""


def _step(unit: str, value: float) -> float:
    if unit == "MPa":
        return PRESSURE_STEP if abs(value) < 1 else STRESS_STEP
    return next(step for least, step in STEPS if value >= least)


def _range(unit: str, value: float, least: float, most: float, step: float) -> tuple[float, float]:
    """Around the value, in whole steps from it, within the bounds."""
    span = max(abs(value) * SPAN, LEAST_SPAN / 2 if unit == "mm" else 0.0)
    reach = max(1, round(span / step)) * step
    return _rounded(max(least, value - reach)), _rounded(min(most, value + reach))


def _rounded(value: float) -> float:
    return round(value, 6) + 0.0
