"""Fixtures that put made-up results in the place of the slow stages."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import pytest
from answers import assert_fits
from fakes import fake_report
from rendered import printed_on_any_terminal

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.export.formats import Part
from bellows_design.geometry.tessellation import tessellate
from bellows_design.progress import SILENCE, Progress
from printers import PrintabilityReport


@pytest.fixture(scope="session")
def cube_part() -> Part:
    """A 10 mm cube under the name of a design."""
    import cadquery as cq

    solid = cq.Solid.makeBox(10, 10, 10)
    return Part("cube", "ten by ten <by> ten µm", "ab" * 32, solid, tessellate(solid))


@pytest.fixture
def stub_stages(monkeypatch: pytest.MonkeyPatch, cube_part: Part) -> Callable[..., None]:
    """Call it with an evaluation (and a report) that every design shall get."""
    from bellows_design import pipeline

    def build(design: Design) -> Part:
        return replace(
            cube_part, name=design.name, description=design.description, digest=design.digest
        )

    def install(evaluation: Any, report: PrintabilityReport | None = None) -> None:
        def evaluate(
            design: Design,
            model: str = "auto",
            accuracy: float | None = None,
            pressures: Sequence[float] = (),
            progress: Progress = SILENCE,
            budget: Budget = DEFAULT,
            open_question: Any = None,
            keep: bool = False,
        ) -> Any:
            progress.stage("solve")
            if isinstance(evaluation, BaseException):
                raise evaluation
            return evaluation

        monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
        monkeypatch.setattr(pipeline, "build_part", build)
        monkeypatch.setattr(pipeline, "check", lambda *_: report or fake_report())

    return install


@pytest.fixture
def bellows(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., tuple[int, str, str]]:
    """Run the command in this process: (exit status, stdout, stderr).

    With ``--json`` the answer is as the schema that it names says; without, what is printed fits
    terminals of any width, and nothing of it is cut.
    """
    monkeypatch.setattr("bellows_design.cli.answer.print_for_people", printed_on_any_terminal)
    from bellows_design.cli.commands import app

    def call(*arguments: str) -> tuple[int, str, str]:
        status: int | str | None = 0
        try:
            app(list(arguments))
        except SystemExit as exit_:
            status = exit_.code
        captured = capfd.readouterr()
        assert isinstance(status, int | None)
        if "--json" in arguments:
            assert_fits(json.loads(captured.out))
        return status or 0, captured.out, captured.err

    return call
