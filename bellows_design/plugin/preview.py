"""Designs and evaluations as notebooks show them: a table, and the shape in 3D."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import cadquery as cq
import numpy as np

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.design.design import Design
from bellows_design.plugin.subjects import Subject, design_of

if TYPE_CHECKING:
    from bellows_design.web.scene import Shown

HEIGHT = 420
"""px, of the picture; ``BAR`` of what stands below it."""

BAR = 90

TOLERANCE, ANGULAR_TOLERANCE = 0.05, 0.3
"""mm and rad, of the triangles of an assembly."""

Shape: TypeAlias = Subject | Evaluation | cq.Assembly

Rows: TypeAlias = Sequence[tuple[str, str]]


@dataclass(frozen=True)
class Preview:
    """Something to look at; a notebook shows it by itself.

    ``title`` and ``rows`` (what, value) are the table, ``page`` is a whole HTML page with the shape
    in 3D that needs no other file.

    Examples:
        >>> from bellows_design.plugin import Preview
        >>> shown = Preview("a finger", (("length", "50 mm"),), "<p>its shape</p>")
        >>> shown.save("finger.html")
        >>> "50 mm" in shown._repr_html_()
        True
    """

    title: str
    rows: Rows
    page: str = field(repr=False)

    def save(self, path: Path | str) -> None:
        """Write the page. Raises ``CannotWrite``."""
        from bellows_design.files.atomic import replacing

        with replacing(Path(path)) as temporary:
            temporary.write_text(self.page, "utf-8")

    def _repr_html_(self) -> str:
        """The table, and the page in a frame of its own: several do not disturb each other."""
        frame = (
            f'<iframe srcdoc="{escape(self.page)}" sandbox="allow-scripts allow-downloads" '
            f'title="{escape(self.title)}" loading="lazy" '
            f'style="width: 100%; height: {HEIGHT + BAR}px; border: 0"></iframe>'
        )
        return table_html(self.title, self.rows) + frame


def preview(shape: Shape, **parameters: Any) -> Preview:
    """A design's part, an evaluation's deformed actuator or an assembly, to be looked at in 3D.

    Args:
        shape: What ``bellows`` takes, an ``Evaluation``, or an assembly such as ``plate`` makes.
        parameters: Of a design, as for ``bellows``.

    Returns:
        What a notebook shows; ``save`` writes it as a page.

    Raises:
        DesignError: There is no such design, or the values make none.
        GeometryError: The CAD kernel cannot build the part.

    Examples:
        >>> from bellows_design.plugin import preview
        >>> shown = preview("prototype_1", bubble_thickness=1.6)  # mm
        >>> print(shown.title)
        prototype_1
    """
    if isinstance(shape, Evaluation):
        return _of_evaluation(shape)
    if isinstance(shape, cq.Assembly):
        return _shown(str(shape.name), [], list(_of_assembly(shape)), "")
    design = design_of(shape, parameters)
    return _shown(design.name, design_rows(design), [_part(design)], "")


def _shown(title: str, rows: Rows, surfaces: list[Shown], coloured_by: str) -> Preview:
    from bellows_design.web.element import viewer_page

    options = {"field": coloured_by, "frame": 1} if coloured_by else {}
    return Preview(title, rows, viewer_page(surfaces, title, height_px=HEIGHT, **options))


def _part(design: Design) -> Shown:
    from bellows_design.geometry.tessellation import tessellate
    from bellows_design.plugin.parts import part_of
    from bellows_design.web.scene import Surface

    mesh = tessellate(part_of(design))
    return Surface(design.name, mesh.triangles, mesh.vertices)


def _of_evaluation(found: Evaluation) -> Preview:
    from bellows_design.deformed import deformed_surface
    from bellows_design.web.scene import Field, Surface

    frames = deformed_surface(found)
    labels = tuple(f"{pressure:.3g} MPa" for pressure in frames.pressures_mpa)
    stress = Field("von Mises stress", "MPa", frames.von_mises)
    surface = Surface("actuator", frames.triangles, frames.positions, (stress,), labels)
    return _shown(found.design.name, evaluation_rows(found), [surface], stress.name)


def _of_assembly(assembly: cq.Assembly) -> Iterator[Shown]:
    from bellows_design.web.scene import Surface

    for shape, path, location, colour in assembly:
        points, triangles = shape.moved(location).tessellate(TOLERANCE, ANGULAR_TOLERANCE)
        yield Surface(
            path.rpartition("/")[2],
            np.array(triangles, np.int32),
            np.array([point.toTuple() for point in points]),
            colour="" if colour is None else _hexadecimal(colour),
        )


def _hexadecimal(colour: cq.Color) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour.toTuple()[:3])


def design_rows(design: Design) -> Rows:
    """What a table says of a design."""
    bellows = design.bellows
    size = f"{bellows.length:g} x {bellows.bubble_width:g} x {bellows.bubble_height:g} mm"
    return [
        ("description", design.description),
        ("size", size),
        ("bubbles", f"{bellows.bubble_count}, walls of {bellows.bubble_thickness:g} mm"),
        ("material", design.material.name),
        ("pressure", f"{design.load.pressure:g} MPa"),
        ("digest", design.digest[:16]),
    ]


def evaluation_rows(found: Evaluation) -> Rows:
    """What a table says of an evaluation."""
    errors = found.error_estimate
    angle, stress = errors.bending_angle_percent, errors.max_von_mises_percent
    rows = [
        ("pressure", f"{found.pressure_mpa:g} MPa"),
        ("bending angle", f"{found.bending_angle_deg:.1f}°{_within(angle)}"),
        ("highest von Mises stress", f"{found.max_von_mises_mpa:.3f} MPa{_within(stress)}"),
    ]
    return rows if found.converged else [*rows, ("not reached", found.message)]


def _within(percent: float | None) -> str:
    return "" if percent is None else f" ± {percent:.2g} %"


def table_html(title: str, rows: Rows) -> str:
    """A table of what and value under a title; all of it text."""
    body = "".join(
        f'<tr><th scope="row" style="text-align: left">{escape(what)}</th>'
        f'<td style="text-align: left">{escape(value)}</td></tr>'
        for what, value in rows
        if value
    )
    return f"<table><caption>{escape(title)}</caption><tbody>{body}</tbody></table>"
