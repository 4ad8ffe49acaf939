"""From blocks to one HTML file: templates that escape all text, drawings and views between it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from markupsafe import Markup

from bellows_design.reports.page.blocks import Cell, Fact, Layers, Page, Space, Tone
from bellows_design.reports.page.drawing.marks import Drawing
from bellows_design.reports.page.drawing.svg import as_svg

if TYPE_CHECKING:
    from jinja2 import Environment

    from bellows_design.reports.page.curves.chart import BarChart, Chart

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""Content-Security-Policy of the page: nothing is loaded from anywhere, nothing sent."""

BADGES: dict[Tone, str] = {"good": "pass", "info": "none", "warn": "warn", "bad": "fail"}
BOXES: dict[Tone, str] = {
    "": "plain",
    "good": "plain",
    "info": "note",
    "warn": "warning",
    "bad": "error",
    "muted": "quiet",
}


@dataclass(frozen=True)
class Line:
    """What stands behind or below a value, and its class."""

    text: str
    kind: str


def as_html(page: Page, made: str) -> str:
    """The whole page; ``made`` says how and when."""
    from bellows_design.web.element import viewer_script
    from bellows_design.web.style import page_style

    return (
        _environment()
        .get_template("page.html")
        .render(
            page=page,
            made=made,
            policy=POLICY,
            style=Markup(page_style() + _own_style()),
            script=Markup(viewer_script()),
        )
    )


@cache
def _own_style() -> str:
    return files(__package__).joinpath("templates", "report.css").read_text("utf-8")


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    found = Environment(
        loader=PackageLoader("bellows_design.reports.page", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
    )
    found.filters |= {
        "badge": lambda tone: BADGES.get(tone, ""),
        "boxed": lambda tone: BOXES[tone],
        "lines": _lines,
        "cell_class": lambda cell: "number" if cell.align == "right" else "",
        "cell_mark": _cell_mark,
        "markup": _markup,
        "viewer": _viewer,
        "layers": _layers,
    }
    return found


def _lines(fact: Fact) -> tuple[Line, ...]:
    """Error and note of a value, as far as it has them."""
    known = (Line(fact.error, "error-text"), Line(fact.note, "note-text"))
    return tuple(each for each in known if each.text)


def _cell_mark(cell: Cell) -> str:
    """A verdict is a badge, any other tone a colour."""
    badge = BADGES.get(cell.tone, "")
    verdict = cell.text in ("pass", "info", "warn", "fail")
    return f"badge {badge}" if verdict else f"{badge}-text" if badge else ""


def _markup(content: Drawing | Chart | BarChart) -> Markup:
    """A drawing or a chart as SVG."""
    return as_svg(content) if isinstance(content, Drawing) else Markup(content.svg())


def _viewer(block: Space) -> Markup:
    from bellows_design.web.element import viewer_element

    return Markup(
        viewer_element(
            block.surfaces,
            height_px=block.height,
            label=block.label,
            field=block.field or None,
            frame=block.frame,
        )
    )


def _layers(block: Layers) -> Markup:
    from bellows_design.web.layers import layers_element

    return Markup(layers_element(block.layers))
