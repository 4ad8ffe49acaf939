"""Whatever numbers a design admits build one valid body; all others are refused."""

from __future__ import annotations

from typing import Any

import pytest
from cavities import void
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from bellows_design.design.design import Design
from bellows_design.geometry.actuator import full_body, half_body, printed_part
from bellows_design.geometry.tessellation import tessellate


def rounded_floats(lowest: float, highest: float) -> st.SearchStrategy[float]:
    """Lengths as people type them, and as optimizers do."""
    floats = st.floats(lowest, max(lowest, highest))
    return floats.map(lambda value: round(value, 1)) | floats


@st.composite
def numbers(draw: st.DrawFn) -> dict[str, float]:
    """Twelve numbers of a short bellows, mostly admissible, often at the edge of it."""
    wall, tendon_wall = draw(rounded_floats(0.4, 2.5)), draw(rounded_floats(0.4, 2.5))
    chamber, distance = draw(rounded_floats(0.4, 6)), draw(rounded_floats(0.4, 4))
    offset, pitch = draw(rounded_floats(tendon_wall, 7)), chamber + 2 * wall + distance
    thicker = max(0, wall - tendon_wall)
    narrowest = max(2, 2 * tendon_wall + 0.5) + thicker
    width = draw(rounded_floats(max(4, narrowest + 2 * thicker), 25))
    height = draw(rounded_floats(max(4, narrowest + wall), 25))
    widest = width - 2 * thicker
    inner = draw(st.sampled_from([0.0, chamber / 2]) | rounded_floats(0.05, chamber / 2))
    inner = min(inner, width / 2 - wall, height / 2 - wall)
    outer = st.sampled_from([0.0, chamber / 2 + wall, inner + wall])
    return {
        "bubble_width": width,
        "bubble_height": height,
        "bubble_thickness": wall,
        "tendon_width": draw(st.just(widest) | rounded_floats(narrowest, widest)),
        "tendon_height": draw(rounded_floats(narrowest, height - wall)),
        "tendon_thickness": tendon_wall,
        "chamber_length": chamber,
        "bubble_distance": distance,
        "inner_fillet": inner,
        "outer_fillet": draw(outer | rounded_floats(0.05, chamber / 2 + wall)),
        "length": draw(rounded_floats(max(10, offset + pitch), offset + 3 * pitch)),
        "offset": offset,
    }


@st.composite
def indents(draw: st.DrawFn, bellows: dict[str, float]) -> dict[str, Any] | None:
    thinner = min(bellows["bubble_thickness"], bellows["tendon_thickness"])
    side = draw(st.sampled_from([None, "outside", "inside"]))
    if side is None or thinner < 0.5:
        return None
    chamber = bellows["chamber_length"]
    shape = draw(st.sampled_from(["arc", "rectangular"])) if side == "outside" else "rectangular"
    widest = chamber if side == "inside" else chamber + 2 * bellows["bubble_thickness"]
    width = draw(st.just(widest) | rounded_floats(0.2, widest))
    deepest = thinner - 0.4 if shape == "rectangular" else min(thinner - 0.4, width / 2)
    depth = draw(rounded_floats(0.05, deepest))
    most = width / 2 if side == "inside" else min(depth, width / 2)
    fillet = 0.0 if shape == "arc" else draw(st.sampled_from([0.0, most]))
    return {"side": side, "shape": shape, "depth": depth, "width": width, "fillet": fillet}


@st.composite
def parts(draw: st.DrawFn) -> tuple[dict[str, float], dict[str, Any] | None, dict[str, float]]:
    bellows = draw(numbers())
    diameter = draw(st.sampled_from([2.0, 4.0, 6.0]))
    return bellows, draw(indents(bellows)), {"tube_diameter": diameter}


def builds_or_is_refused(
    part: tuple[dict[str, float], dict[str, Any] | None, dict[str, float]],
) -> bool:
    """Whether the numbers are admitted; if so they must make one body with one closed cavity."""
    try:
        design = Design(name="any", bellows=part[0], indent=part[1], port=part[2])
    except ValueError as refusal:
        assert not isinstance(refusal, ValidationError)  # but the sentence made of it
        assert all(len(line) < 250 and "mm" in line for line in str(refusal).splitlines())
        return False
    whole = full_body(design.bellows, design.indent)
    assert whole.solid.isValid() and len(whole.solid.Shells()) == 2
    assert 0 < abs(void(whole).Volume()) < whole.solid.BoundingBox().DiagonalLength ** 3
    half_of_it = half_body(design.bellows, design.indent)
    assert half_of_it.solid.Volume() == pytest.approx(whole.solid.Volume() / 2, rel=1e-4)
    assert len(half_of_it.solid.Shells()) == 1
    part_solid = printed_part(design.bellows, design.indent, design.port).solid
    mesh = tessellate(part_solid)
    assert len(part_solid.Shells()) == 1
    assert len(mesh.vertices) - len(mesh.triangles) / 2 == 2
    return True


def count_built(examples: int) -> int:
    built = 0

    @settings(
        max_examples=examples,
        deadline=None,
        derandomize=True,
        database=None,
        phases=[Phase.generate],  # shrinking builds hundreds of solids
        suppress_health_check=list(HealthCheck),
    )
    @given(parts())
    def sweep(part: tuple[dict[str, float], dict[str, Any] | None, dict[str, float]]) -> None:
        nonlocal built
        built += builds_or_is_refused(part)

    sweep()
    return built


def test_admissible_numbers_build_and_all_others_are_refused() -> None:
    assert count_built(examples=8) >= 2


@pytest.mark.slow
def test_many_admissible_numbers_build_and_all_others_are_refused() -> None:
    assert count_built(examples=150) >= 40
