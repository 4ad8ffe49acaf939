"""Lengths on the sketch are those of the part and of its parameters, and labels stand apart."""

from __future__ import annotations

from functools import cache
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import pytest

from bellows_design import load_design
from bellows_design.design.shipped import shipped_designs
from bellows_design.pipeline import build_part
from bellows_design.reports.page.drawing.marks import Drawing, Line, Text
from bellows_design.reports.page.drawing.svg import as_svg
from bellows_design.reports.page.sketch.dimension import Dimension, View
from bellows_design.reports.page.sketch.layout import drawn
from bellows_design.reports.page.sketch.sheets import scale_of
from bellows_design.reports.page.sketch.views import views

ROOT = Path(__file__).parents[4]
EXAMPLES = sorted(str(path) for path in (ROOT / "examples").glob("*.toml"))
FEW = ("finger", str(ROOT / "examples/finger_gripping.toml"))
OTHERS = [each for each in (*shipped_designs(), *EXAMPLES) if each not in FEW]

EVERY = [
    *FEW,
    *(pytest.param(each, marks=pytest.mark.slow) for each in OTHERS),
]
each_design = pytest.mark.parametrize("name", EVERY)

NEAR = 0.05
"""mm: the mesh's tolerance, and what a plane beside the middle of a round makes."""


@cache
def views_of(name: str) -> tuple[View, ...]:
    design = load_design(name)
    return views(design, build_part(design).mesh)


def drawings_of(name: str) -> list[Drawing]:
    return [drawn(view, scale_of(view)) for view in views_of(name)]


@each_design
@pytest.mark.thorough
def test_drawn_lengths_equal_the_parameters(name: str) -> None:
    for view in views_of(name):
        for each in view.dimensions:
            assert each.measured == pytest.approx(each.value, abs=1e-9) or "built" in each.note


@each_design
def test_dimensions_end_on_the_part(name: str) -> None:
    for view in views_of(name):
        for each in view.dimensions:
            if not each.name.startswith("limits."):
                for place in (each.start, each.end):
                    assert _on_contour(view, each, place) < NEAR, (view.title, each.name, place)


def _on_contour(view: View, dimension: Dimension, place: Any) -> float:
    """mm from a dimension's end to where the part's contour crosses its direction, or touches."""
    axis = 0 if dimension.side in ("above", "below") else 1
    found = []
    for loop in view.loops:
        for a, b in pairwise((*loop, loop[0])):
            low, high = sorted((a[1 - axis], b[1 - axis]))
            if low - NEAR <= place[1 - axis] <= high + NEAR:
                across = b[1 - axis] - a[1 - axis]
                share = 0.5 if abs(across) < 1e-9 else (place[1 - axis] - a[1 - axis]) / across
                share = min(1.0, max(0.0, share))
                found.append(abs(a[axis] + share * (b[axis] - a[axis]) - place[axis]))
    return min(found)


@each_design
def test_every_number_of_the_design_is_drawn(name: str) -> None:
    design = load_design(name)
    named = {each.name for view in views_of(name) for each in (*view.dimensions, *view.callouts)}
    wanted = {key for key, _ in design.bellows if key != "number_of_bubbles"}
    wanted |= {f"port.{key}" for key, _ in design.port}
    if design.indent is not None:
        wanted |= {"indent.depth", "indent.width"}
        wanted |= {"indent.fillet"} if design.indent.shape == "rectangular" else set()
    if design.mount is not None:
        wanted |= {
            f"mount.{key}" for key in ("thickness", "hole_diameter", "edge_distance", "fillet")
        }
    if design.fingertip is not None:
        wanted |= {f"fingertip.{key}" for key in ("length", "width", "thickness")}
    assert named >= wanted


@each_design
def test_no_label_lies_on_another(name: str) -> None:
    for drawing in drawings_of(name):
        for one, other in combinations(drawing.texts, 2):
            assert not _overlap(one, other), (drawing.title, one.text, other.text)


def _overlap(one: Text, other: Text) -> bool:
    a, b = one.box, other.box
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


@each_design
def test_everything_is_on_its_sheet(name: str) -> None:
    for drawing in drawings_of(name):
        for text in drawing.texts:
            left, top, right, bottom = text.box
            assert left >= 0 and top >= 0
            assert right <= drawing.width and bottom <= drawing.height


def test_labels_state_names_and_values() -> None:
    texts = {text.text for drawing in drawings_of("finger") for text in drawing.texts}
    assert {"bubble_thickness 1.2", "outer_fillet R 2.2", "indent.depth 0.4", "length 50"} <= texts


def test_text_in_a_drawing_is_escaped() -> None:
    drawing = Drawing(10, 10, (Text((1, 1), "<b>&</b>"), Line(((0, 0), (1, 1)))), "<i>")
    svg = as_svg(drawing)
    assert "<b>" not in svg and "&lt;b&gt;&amp;&lt;/b&gt;" in svg and "&lt;i&gt;" in svg
