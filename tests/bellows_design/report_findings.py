"""Findings for reports: real parts, made-up numbers."""

from __future__ import annotations

from functools import cache
from html.parser import HTMLParser
from typing import Any

import numpy as np
from fakes import FakeEvaluation, fake_report

from bellows_design import load_design, with_overrides
from bellows_design.analysis.evaluation import MeshReading, MeshSize
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.approval import decide
from bellows_design.deformed.surface import SurfaceFrames
from bellows_design.design.design import Design
from bellows_design.leak_test.record import LeakTest
from bellows_design.pipeline import Outcome, build_part
from bellows_design.reports.page.findings import Findings
from bellows_design.reports.page.make import report_html

SHORT = ("length=20", "number_of_bubbles=2")


@cache
def part_of(name: str, *settings: str) -> Any:
    """The printed part of a design, built once."""
    return build_part(design_of(name, *settings))


@cache
def design_of(name: str = "finger", *settings: str) -> Design:
    """A shipped design with two bubbles."""
    return with_overrides(load_design(name), [*SHORT, *settings])


def made_up(design: Design, **changes: Any) -> FakeEvaluation:
    """An evaluation with a path of five states, to the design's pressure."""
    pressure = design.load.pressure
    path = tuple(
        Reading(share * pressure, 60 * share, 3 * share, 1000 + 500 * share)
        for share in (0.0, 0.25, 0.5, 0.75, 1.0)
    )
    meshes = tuple(
        MeshReading(MeshSize(n, 2 * n, 6 * n), Reading(pressure, 60 + 1 / n, 3.0 - 1 / n, 1500))
        for n in (100, 400)
    )
    own = {"path": path, "meshes": meshes, "pressure_mpa": pressure, "bending_angle_deg": 60.0}
    return FakeEvaluation(design=design, **(own | changes))


def bending(frames: int = 4) -> SurfaceFrames:
    """A tetrahedron that grows, as an actuator under pressure."""
    corners = np.array([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]], float)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    share = np.linspace(0, 1, frames)
    positions = corners[None] * (1 + share[:, None, None])
    stress = share[:, None] * np.array([0.5, 1.0, 2.0, 3.0])
    return SurfaceFrames(triangles, positions, stress, 0.1 * share, 60 * share)


def findings(
    design: Design | None = None,
    evaluation: Any = "made up",
    report: Any = None,
    leak_test: LeakTest | None = None,
    **others: Any,
) -> Findings:
    """All that a report shows, of a small design unless another is given."""
    design = design or design_of()
    found = made_up(design) if evaluation == "made up" else evaluation
    checked = report or fake_report()
    test = leak_test or LeakTest("if-available", why="there is no slicer here")
    verdict = others.pop("verdict", None) or decide(design, checked, found)
    part = part_of("finger") if design.bellows == design_of().bellows else build_part(design)
    scenes = others.pop("scenes", ())
    outcome = Outcome(design, checked, found, verdict, test, part, scenes)
    return Findings(outcome, **({"deformed": bending()} | others))


VOID = {"meta", "link", "br", "img", "input", "hr"}
HIDDEN = {"script", "style", "title"}


class Read(HTMLParser):
    """The text of a page without scripts and styles, and its elements."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.texts: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.elements.append((tag, dict(attrs)))
        self.open += [] if tag in VOID else [tag]

    def handle_startendtag(self, tag: str, attrs: Any) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not HIDDEN & set(self.open):
            self.texts.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.texts).split())


def page_text(html: bytes) -> Read:
    """A page as a reader reads it; fails if an element is not closed by its own end."""
    found = Read()
    found.feed(html.decode())
    found.close()
    assert found.open == []
    return found


def read(found: Findings) -> Read:
    """The report on findings."""
    return page_text(report_html(found))
