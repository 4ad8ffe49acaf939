"""All stages in order: part, printability, evaluation, leak test, verdict, files.

``examine`` finds out, ``run`` writes what follows from it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.export.part import Part
from bellows_design.printability import check_dict as check_dict
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.approval import Verdict
    from bellows_design.force.result import SceneResult
    from bellows_design.leak_test.record import LeakTest, LeakTester, Unavailable
    from bellows_design.store.store import Store
    from printers.report import PrintabilityReport


@dataclass(frozen=True)
class Outcome:
    """What a run found out.

    Attributes:
        design: The design that was run.
        report: Printability of its part.
        evaluation: The actuator under its design pressure; None if the design was refused before.
        verdict: Approval, or all reasons against it.
        leak_test: What became of the leak test.
        scenes: The scenes that the design must hold.
        part: The solid as printed and its mesh.
        folder: Where the approved files are; None if the design is refused.
        withdrawn: Folder of an earlier approved export that this refusal took back.
        page: The report beside the approved files; None where none was made.
        no_page: Why the report that was asked for could not be made; empty if it was.

    Examples:
        >>> from bellows_design import examine, load_design
        >>> outcome = examine(load_design("prototype_1"))
        >>> print(outcome.verdict.approved, outcome.folder)  # refused, and nothing is written
        False None
        >>> print(outcome.verdict.reasons[0].message)
        bubble_thickness 1.5 mm is 3.75 lines of 0.4 mm, not a whole number
    """

    design: Design
    report: PrintabilityReport
    evaluation: Evaluation | None
    verdict: Verdict
    leak_test: LeakTest
    part: Part = field(repr=False, compare=False)
    scenes: tuple[SceneResult, ...] = ()
    folder: Path | None = None
    withdrawn: Path | None = None
    page: Path | None = None
    no_page: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        from bellows_design.export.statements import scene_statements

        evaluation = self.evaluation
        return {
            "design": self.design.name,
            "digest": self.design.digest,
            **self.verdict.to_dict(),
            "folder": None if self.folder is None else str(self.folder),
            "withdrawn": None if self.withdrawn is None else str(self.withdrawn),
            "report": None if self.page is None else str(self.page),
            "no_report": self.no_page or None,
            "from_cache": None if evaluation is None else evaluation.from_cache or None,
            "check": check_dict(self.design, self.report),
            "leak_test": self.leak_test.to_dict(),
            "evaluation": None if evaluation is None else evaluation.to_dict(),
            **scene_statements(self),
        }


Reporter = Callable[[Outcome, Mapping[str, bytes]], bytes]
"""Makes the report on an approved outcome, beside these files (name -> content)."""


def run(
    design: Design,
    output_root: Path | str,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
    leak_tester: LeakTester | Unavailable | None = None,
    reporter: Reporter | None = None,
) -> Outcome:
    """Build, check and evaluate ``design``, decide, and export it if it is approved.

    Args:
        design: What is to be printed and pressurised.
        output_root: Folder of the exports; files appear in its folder ``NAME`` if the design is
            approved, and an earlier export there is withdrawn if it is not.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        store: Where evaluations are looked for and kept; None for none.
        leak_tester: The leak test, or why there is none; None for that of this machine.
        reporter: Makes the report beside the files, such as ``reports.page.make.run_report``; None
            for no report. Whatever goes wrong in it is a note, and the export goes on without it.

    Returns:
        Printability, evaluation, verdict, and what became of the files.

    Raises:
        BellowsError: No solid, no watertight mesh, a first mesh beyond the budget, an unknown
            printer, or a place for the files that is taken by others.
        PrintersError: The leak test is required, and the slicer here cannot be used.
        MeshingError: No usable mesh, or none in time.
        OSError: The files could not be written; then nothing has changed.

    Examples:
        >>> from bellows_design import load_design, run
        >>> outcome = run(load_design("finger"), "exports")
        >>> outcome.verdict.approved
        True
        >>> {".stl", ".3mf", ".step"} <= {path.suffix for path in outcome.folder.iterdir()}
        True
    """
    from bellows_design.export.approved import require_place

    output_root = Path(output_root)
    require_place(design.name, output_root)
    found = examine(design, progress, budget, store, leak_tester)
    return _settled(found, output_root, reporter, progress)


def examine(
    design: Design,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
    leak_tester: LeakTester | Unavailable | None = None,
) -> Outcome:
    """All that ``run`` finds out, and no files.

    Every rule is applied even after one has failed, so that a refusal names all reasons. Where
    only the estimated error keeps the verdict open, the mesh is refined and decided upon again, as
    far as the budget allows. The leak test is made of designs that nothing else speaks against; one
    that requires it where there is none is refused before it is evaluated.

    Args:
        design: What is to be printed and pressurised.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        store: Where evaluations are looked for and kept; None for none.
        leak_tester: The leak test, or why there is none; None for that of this machine.

    Returns:
        Printability, evaluation and verdict, without a folder.

    Raises:
        BellowsError: No solid, no watertight mesh, a first mesh beyond the budget, or an unknown
            printer.
        PrintersError: The leak test is required, and the slicer here cannot be used.
        MeshingError: No usable mesh, or none in time.

    Examples:
        >>> from bellows_design import examine, load_design
        >>> found = examine(load_design("prototype_1"))
        >>> print(sorted({reason.rule for reason in found.verdict.reasons}))
        ['max_von_mises', 'wall_multiple', 'wall_multiple_measured']
    """
    from bellows_design.approval import decide, refused_for_want_of_a_slicer, with_leak_test
    from bellows_design.leak_test.record import LeakTest, Unavailable
    from bellows_design.leak_test.slicer import usual_tester

    setting = design.limits.leak_test
    tester = usual_tester(setting) if leak_tester is None else leak_tester
    progress.stage("geometry")
    part = build_part(design)
    progress.stage("check")
    report = check(design, part)
    if setting == "required" and isinstance(tester, Unavailable):
        verdict = refused_for_want_of_a_slicer(design, report, tester)
        return Outcome(design, report, None, verdict, LeakTest(setting, why=tester.why), part)
    evaluation = _evaluated(design, report, progress, budget, store)
    scenes = _scenes(design, evaluation, progress, budget, store)
    verdict = decide(design, report, evaluation, scenes)
    test = _leak_test(design, part, tester, verdict, progress)
    return Outcome(design, report, evaluation, with_leak_test(verdict, test), test, part, scenes)


def _scenes(
    design: Design,
    evaluation: Evaluation,
    progress: Progress,
    budget: Budget,
    store: Store | None,
) -> tuple[SceneResult, ...]:
    """The scenes that approval must hold, once the pressure is reached without them."""
    from bellows_design.force.result import SceneResult

    names = design.limits.scenes
    if not names:
        return ()
    if not evaluation.converged:
        why = "the pressure was not reached without it"
        return tuple(SceneResult(name, failure=why) for name in names)
    from bellows_design.force.required_scenes import required_scenes

    return required_scenes(design, progress, budget, store)


def _evaluated(
    design: Design,
    report: PrintabilityReport,
    progress: Progress,
    budget: Budget,
    store: Store | None,
) -> Evaluation:
    from bellows_design.approval import open_question
    from bellows_design.store.lookup import evaluated

    def question(state: LoadedState) -> str:
        return open_question(design, report, state)

    return evaluated(design, progress=progress, budget=budget, open_question=question, store=store)


def _leak_test(
    design: Design,
    part: Part,
    tester: LeakTester | Unavailable,
    verdict: Verdict,
    progress: Progress,
) -> LeakTest:
    """The leak test, or why it was left out."""
    from bellows_design.leak_test.record import SWITCHED_OFF, LeakTest, Unavailable
    from printers.errors import PrintersError

    setting = design.limits.leak_test
    if setting == "off":
        return LeakTest(setting, why=SWITCHED_OFF)
    if not verdict.approved:
        return LeakTest(setting, why="the design is refused without it")
    if isinstance(tester, Unavailable):
        return LeakTest(setting, why=tester.why)
    progress.stage("leak test")
    try:
        return LeakTest(setting, tester(design, part.mesh))
    except PrintersError as error:
        return LeakTest(setting, why=str(error).rstrip("."), failed=True)


def build_part(design: Design) -> Part:
    """The printed part of ``design``.

    Args:
        design: Twelve numbers, port and, where it has them, indent, mount and fingertip, mm.

    Returns:
        The solid as printed and its watertight triangle mesh, mm, with the labels of the design and
        the profile of its printer.

    Raises:
        DesignError: Indent, port, mount or fingertip do not fit the bellows.
        GeometryError: The CAD kernel cannot build the solid.
        TessellationError: The solid's triangles do not close.
        PrintersError: The design's printer is unknown.

    Examples:
        >>> from bellows_design import build_part, load_design
        >>> part = build_part(load_design("prototype_1"))
        >>> low, high = part.mesh.vertices.min(axis=0), part.mesh.vertices.max(axis=0)
        >>> print((high - low).round(1), "mm")
        [58. 20. 20.] mm
    """
    from bellows_design.geometry.actuator import printed_part
    from bellows_design.geometry.tessellation import tessellate

    profile = design.profile()
    solid = printed_part(
        design.bellows, design.indent, design.port, design.mount, design.fingertip
    ).solid
    mesh = tessellate(solid)
    return Part(design.name, design.description, design.digest, solid, mesh, profile)


def check(
    design: Design, part: Part | None = None, printer: str | None = None
) -> PrintabilityReport:
    """Printability of ``design``'s part.

    Args:
        design: Declares walls, gaps, the port's opening and the limits of the cross-section, mm.
        part: What ``build_part`` made of it; None where it is not at hand, and is built.
        printer: Name of a printer profile, or path of a TOML file, instead of the design's.

    Returns:
        The result of every rule, measured and required.

    Raises:
        PrintersError: No such profile, or one that is none.
        BellowsError: As ``build_part``, where the part is built here.

    Examples:
        >>> from bellows_design import check, load_design
        >>> report = check(load_design("finger"))
        >>> print(report.printer, report.verdict, [rule.rule for rule in report.failures])
        prusa_i3 pass []
    """
    from bellows_design.printability import printed_model
    from printers import check_printability, load_profile

    profile = design.profile() if printer is None else load_profile(printer)
    mesh = (part or build_part(design)).mesh
    return check_printability(printed_model(design, mesh), profile)


def _settled(
    found: Outcome, output_root: Path, reporter: Reporter | None, progress: Progress
) -> Outcome:
    """The outcome once an approved part is exported, or an earlier export of it withdrawn."""
    from bellows_design.export.approved import export_approved
    from bellows_design.export.manifest import report_name
    from bellows_design.export.statements import companions, grounds, run_statement

    if not found.verdict.approved:
        return replace(found, withdrawn=_withdrawn(found, output_root))
    page = _Page(found, reporter, progress)
    stated = grounds(found), output_root, companions(found), run_statement(found)
    folder = export_approved(found.part, found.verdict, *stated, page.made)
    path = folder / report_name(found.design.name) if page.there else None
    return replace(found, folder=folder, page=path, no_page=page.failure)


@dataclass
class _Page:
    """The report beside an export, or why there is none: no run fails for want of it."""

    found: Outcome
    reporter: Reporter | None
    progress: Progress
    there: bool = False
    failure: str = ""

    def made(self, files: Mapping[str, bytes]) -> bytes | None:
        """The page, or None, and then a note where one was asked for."""
        if self.reporter is None:
            return None
        self.progress.stage("report")
        try:
            page = self.reporter(self.found, files)
        except Exception as error:  # a fault of the page must not cost an approved export
            self.failure = f"{type(error).__name__}: {error}"
            self.progress.note(f"no report was made ({self.failure}); the export is whole")
            return None
        self.there = True
        return page


def _withdrawn(found: Outcome, output_root: Path) -> Path | None:
    """The earlier export of a refused design, removed. Raises ``CannotWrite`` if it cannot be."""
    from bellows_design.export.approved import withdraw
    from bellows_design.files.errors import CannotWrite

    name = found.design.name
    try:
        return withdraw(name, output_root)
    except OSError as error:
        rules = ", ".join(dict.fromkeys(reason.rule for reason in found.verdict.reasons))
        why = f"{error.strerror or error}; it is refused ({rules}), but its earlier export remains"
        raise CannotWrite(output_root / name, why) from error
