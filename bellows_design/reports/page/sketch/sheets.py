"""The drawings of a part's sketch, each at a scale that suits its size."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.reports.page.drawing.marks import Drawing
from bellows_design.reports.page.sketch.dimension import View
from bellows_design.reports.page.sketch.layout import drawn
from bellows_design.reports.page.sketch.views import views

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh

LARGEST = (560.0, 300.0)
"""px across and up of a part on its drawing, without dimensions."""

SCALES = (100.0, 50.0, 40.0, 30.0, 25.0, 20.0, 16.0, 12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0)
"""px/mm."""


def sketch(design: Design, mesh: ClosedMesh) -> tuple[Drawing, ...]:
    """All views of the printed ``mesh`` of ``design`` with their dimensions."""
    return tuple(drawn(view, scale_of(view)) for view in views(design, mesh))


def scale_of(view: View) -> float:
    """The largest of ``SCALES`` at which the part fits; the smallest if it never does."""
    points = [point for loop in view.loops for point in loop]
    low, high = view.across or (min(x for x, _ in points), max(x for x, _ in points))
    up = max(y for _, y in points) - min(y for _, y in points)
    fits = (
        each for each in SCALES if each * (high - low) <= LARGEST[0] and each * up <= LARGEST[1]
    )
    return next(fits, SCALES[-1])
