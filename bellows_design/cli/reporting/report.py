"""``bellows report``: from its options to its answer. It exports nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, Answer, unwritten
from bellows_design.cli.options import BudgetOptions, DesignOptions
from bellows_design.cli.output_files import require_file
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store

if TYPE_CHECKING:
    from bellows_design.budget import Budget
    from bellows_design.design.design import Design
    from bellows_design.design.scenes.scene import Scene
    from bellows_design.force.result import SceneResult
    from bellows_design.progress import Progress
    from bellows_design.reports.page.findings import Findings
    from bellows_design.store import Store


@dataclass(frozen=True)
class ReportOptions:
    """What is asked, as it stands on the command line."""

    design: DesignOptions
    output: Path | None = None
    png: Path | None = None
    pdf: Path | None = None
    scenes: tuple[str, ...] = ()
    derivatives: bool = True
    limits: BudgetOptions = field(default_factory=BudgetOptions)
    cached: bool = True

    def require(self, page: Path) -> None:
        """Refuse files that cannot be written before anything is computed."""
        from bellows_design.reports.page.pictures.libraries import require_pictures

        require_file(page, ".html")
        require_file(self.png, ".png")
        require_file(self.pdf, ".pdf")
        if self.png is not None or self.pdf is not None:
            require_pictures()


def report_answer(options: ReportOptions) -> Answer:
    """Examine the design, and write the report and what else is asked for."""
    require_working_folder()
    require_address_space(EVALUATION)
    design = options.design.load(rename=True)
    design.profile()
    page = options.output or Path(_name(design))
    scenes = _scenes(options, design)
    options.require(page)
    budget = options.limits.budget()
    with solving() as progress:
        store = usual_store(progress) if options.cached else None
        found = _found(options, design, scenes, _Means(progress, budget, store))
        progress.stage("report")
        failed = unwritten(*_writers(options, page, found))
    written = [page, *(each for each in (options.png, options.pdf) if each is not None)]
    return _answer(found, written, failed)


@dataclass(frozen=True)
class _Means:
    """What the computation may use."""

    progress: Progress
    budget: Budget
    store: Store | None


def _name(design: Design) -> str:
    from bellows_design.export.manifest import report_name

    return report_name(design.name)


def _scenes(options: ReportOptions, design: Design) -> dict[str, Scene]:
    """The further scenes that are asked for, by their names. Raises ``DesignError``."""
    from bellows_design.design.scenes.scene import check_fits, named_scene

    found = {}
    for each in options.scenes:
        name, scene = named_scene(each, design.scenes)
        check_fits(scene, f"scene {name}", design.finger_length)
        found[name] = scene
    return found


def _found(
    options: ReportOptions, design: Design, scenes: dict[str, Scene], means: _Means
) -> Findings:
    """All that the report shows."""
    from bellows_design.pipeline import examine
    from bellows_design.reports.page.findings import findings_of

    outcome = examine(design, means.progress, means.budget, means.store)
    further = tuple(_scene(design, *each, means) for each in scenes.items())
    return findings_of(outcome, options.derivatives, further, means.progress)


def _scene(design: Design, name: str, scene: Scene, means: _Means) -> SceneResult:
    """The force in a scene along the way to the design pressure; why there is none if so."""
    from bellows_design.force.curve import force_curve
    from bellows_design.force.required_scenes import FAILURES
    from bellows_design.force.result import SceneResult

    means.progress.stage(f"scene {name}")
    pressures = [share / STEPS * design.load.pressure for share in range(1, STEPS + 1)]
    try:
        found = force_curve(
            design,
            scene,
            pressures,
            name=name,
            progress=means.progress,
            budget=means.budget,
            store=means.store,
        )
    except FAILURES as error:
        return SceneResult(name, failure=str(error))
    return SceneResult(name, found)


STEPS = 5
"""Pressures of a force curve, from a part of the design's to all of it."""


def _writers(options: ReportOptions, page: Path, found: Findings) -> Iterator[Callable[[], None]]:
    """What writes each of the files."""
    from bellows_design.reports.page.make import report_html

    yield partial(_write, page, partial(report_html, found))
    if options.png is not None:
        from bellows_design.reports.page.pictures.contact_sheet import contact_sheet

        yield partial(_write, options.png, partial(contact_sheet, found))
    if options.pdf is not None:
        from bellows_design.reports.page.pictures.pages import as_pdf

        yield partial(_write, options.pdf, partial(as_pdf, found))


def _write(path: Path, content: Callable[[], bytes]) -> None:
    """A file, complete or not at all."""
    from bellows_design.files.atomic import replacing

    made = content()
    with replacing(path) as temporary:
        temporary.write_bytes(made)


def _answer(found: Findings, written: list[Path], failed: object) -> Answer:
    from bellows_design.files.errors import CannotWrite

    outcome = found.outcome
    derivatives = found.sensitivities
    content = {
        **outcome.to_dict(),
        "further_scenes": [each.to_dict() for each in found.further],
        "sensitivities": None if isinstance(derivatives, str) else derivatives.to_dict(),
        "no_sensitivities": derivatives if isinstance(derivatives, str) else None,
        "files": [str(path) for path in written],
    }
    for own_to_exports in ("folder", "withdrawn", "report", "no_report"):
        content.pop(own_to_exports)
    verdict = "approved" if outcome.verdict.approved else "refused"
    lines = [f"{path}: {path.stat().st_size / 1e6:.1f} MB" for path in written if path.is_file()]
    text = [f"{outcome.design.name} is {verdict}", *lines]
    return Answer(content, text, DONE, failed if isinstance(failed, CannotWrite) else None)
