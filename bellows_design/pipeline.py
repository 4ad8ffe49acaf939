"""All stages in order: the part, its printability, its evaluation, the verdict, the files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.export.formats import Part
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.approval import Verdict
    from bellows_design.store.store import Store
    from printers.report import PrintabilityReport


@dataclass(frozen=True)
class Outcome:
    """What a run found out.

    Attributes:
        design: The design that was run.
        report: Printability of its part.
        evaluation: The actuator under its design pressure.
        verdict: Approval, or all reasons against it.
        folder: Where the approved files are; None if the design is refused.
        withdrawn: Folder of an earlier approved export that this refusal took back.
    """

    design: Design
    report: PrintabilityReport
    evaluation: Evaluation
    verdict: Verdict
    folder: Path | None = None
    withdrawn: Path | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "design": self.design.name,
            "digest": self.design.digest,
            **self.verdict.to_dict(),
            "folder": None if self.folder is None else str(self.folder),
            "withdrawn": None if self.withdrawn is None else str(self.withdrawn),
            "from_cache": self.evaluation.from_cache or None,
            "check": check_dict(self.design, self.report),
            "evaluation": self.evaluation.to_dict(),
        }


def run(
    design: Design,
    output_root: Path,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
) -> Outcome:
    """Build, check and evaluate ``design``, decide, and export it if it is approved.

    Every rule is applied even after one has failed, so that a refusal names all reasons. Where
    only the estimated error keeps the verdict open, the mesh is refined and decided upon again, as
    far as the budget allows.

    Args:
        design: What is to be printed and pressurised.
        output_root: Folder of the exports; files appear in its folder ``NAME`` if the design is
            approved, and an earlier export there is withdrawn if it is not.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        store: Where evaluations are looked for and kept; None for none.

    Returns:
        Printability, evaluation, verdict, and what became of the files.

    Raises:
        BellowsError: No solid, no watertight mesh, a first mesh beyond the budget, an unknown
            printer, or a place for the files that is taken by others.
        MeshingError: No usable mesh, or none in time.
        OSError: The files could not be written; then nothing has changed.
    """
    from bellows_design.approval import decide, open_question
    from bellows_design.export.approved import require_place
    from bellows_design.store.lookup import evaluated

    def question(state: LoadedState) -> str:
        return open_question(design, report, state)

    require_place(design.name, output_root)
    progress.stage("geometry")
    part = build_part(design)
    progress.stage("check")
    report = check(design, part)
    evaluation = evaluated(
        design, progress=progress, budget=budget, open_question=question, store=store
    )
    verdict = decide(design, report, evaluation)
    return _settled(Outcome(design, report, evaluation, verdict), part, output_root)


def build_part(design: Design) -> Part:
    """The printed part of ``design``.

    Args:
        design: Twelve numbers, port and, if there is one, indent, mm.

    Returns:
        The solid as printed and its watertight triangle mesh, mm, with the labels of the design.

    Raises:
        DesignError: Indent or port do not fit the bellows.
        GeometryError: The CAD kernel cannot build the solid.
        TessellationError: The solid's triangles do not close.
    """
    from bellows_design.geometry.actuator import printed_part
    from bellows_design.geometry.tessellation import tessellate

    solid = printed_part(design.bellows, design.indent, design.port).solid
    return Part(design.name, design.description, design.digest, solid, tessellate(solid))


def check(design: Design, part: Part, printer: str | None = None) -> PrintabilityReport:
    """Printability of ``part``.

    Args:
        design: Declares walls, gaps, the port's opening and the limits of the cross-section, mm.
        part: What ``build_part`` made of it.
        printer: Name of a printer profile, or path of a TOML file, instead of the design's.

    Returns:
        The result of every rule, measured and required.

    Raises:
        PrintersError: No such profile, or one that is none.
    """
    from bellows_design.printability import printed_model
    from printers import check_printability, load_profile

    profile = design.profile() if printer is None else load_profile(printer)
    return check_printability(printed_model(design, part.mesh), profile)


def check_dict(design: Design, report: PrintabilityReport) -> dict[str, Any]:
    """The report on ``design`` as plain values for JSON."""
    return {"design": design.name, "digest": design.digest, **report.to_dict()}


def _settled(found: Outcome, part: Part, output_root: Path) -> Outcome:
    """The outcome once an approved part is exported, or an earlier export of it withdrawn."""
    from bellows_design.export.approved import export_approved

    if not found.verdict.approved:
        return replace(found, withdrawn=_withdrawn(found, output_root))
    folder = export_approved(part, found.verdict, _grounds(found), output_root)
    return replace(found, folder=folder)


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


def _grounds(found: Outcome) -> dict[str, Any]:
    """What an approval rests on, as plain values for the manifest."""
    from bellows_design.geometry.tessellation import TOLERANCE

    return {
        "design": found.design.model_dump(mode="json", exclude_none=True),
        "printer": found.design.profile().model_dump(mode="json"),
        "mesh_tolerance_mm": TOLERANCE,
        "check": check_dict(found.design, found.report),
        "evaluation": found.evaluation.to_dict(),
    }
