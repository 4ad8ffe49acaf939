"""A design's way through the house: part, print check, evaluation, verdict, files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.export.formats import Part
from bellows_design.progress import Progress, Silence

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.approval import Verdict
    from printers.report import PrintabilityReport

SILENCE = Silence()


@dataclass(frozen=True)
class Outcome:
    """What a run found out, and where the approved files are (None if refused)."""

    design: Design
    report: PrintabilityReport
    evaluation: Evaluation
    verdict: Verdict
    folder: Path | None
    withdrawn: Path | None
    """Folder of an earlier approved export that this refusal took back."""

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "design": self.design.name,
            "digest": self.design.digest,
            **self.verdict.to_dict(),
            "folder": None if self.folder is None else str(self.folder),
            "withdrawn": None if self.withdrawn is None else str(self.withdrawn),
            "check": check_dict(self.design, self.report),
            "evaluation": self.evaluation.to_dict(),
        }


def build_part(design: Design) -> Part:
    """The design's solid as printed and its watertight mesh.

    Raises ``GeometryError`` or ``TessellationError`` (both ``ValueError``) if there is none.
    """
    from bellows_design.geometry.actuator import printed_part
    from bellows_design.geometry.tessellation import tessellate

    solid = printed_part(design.bellows, design.indent, design.port).solid
    return Part(design.name, design.description, design.digest, solid, tessellate(solid))


def check(design: Design, part: Part, printer: str | None = None) -> PrintabilityReport:
    """Printability of ``part`` on the design's printer, or on another by name or path."""
    from bellows_design.printability import printed_model
    from printers import check_printability, load_profile

    profile = load_profile(printer or design.printer)
    return check_printability(printed_model(design, part.mesh), profile)


def check_dict(design: Design, report: PrintabilityReport) -> dict[str, Any]:
    """The report on ``design`` as plain values for JSON."""
    return {"design": design.name, "digest": design.digest, **report.to_dict()}


def run(
    design: Design,
    output_root: Path,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Outcome:
    """Take ``design`` all the way; its files appear below ``output_root`` only if it is approved.

    Every rule is applied even after one has failed, so that a refusal names all reasons. Where
    only the estimated error keeps the verdict open, the mesh is refined and decided upon again, as
    far as the ``budget`` allows.
    """
    from bellows_design.analysis.evaluate import evaluate, refined
    from bellows_design.approval import decide
    from bellows_design.export.approved import require_place

    require_place(design.name, output_root)
    progress.stage("geometry")
    part = build_part(design)
    progress.stage("check")
    report = check(design, part)
    evaluation = evaluate(design, progress=progress, budget=budget)
    while decide(design, report, evaluation).undecided and evaluation.can_refine:
        evaluation = refined(evaluation, progress)
    verdict = decide(design, report, evaluation)
    folder, withdrawn = _settle(part, design, report, evaluation, verdict, output_root)
    return Outcome(design, report, evaluation, verdict, folder, withdrawn)


def _settle(
    part: Part,
    design: Design,
    report: PrintabilityReport,
    evaluation: Evaluation,
    verdict: Verdict,
    output_root: Path,
) -> tuple[Path | None, Path | None]:
    """Export what is approved, withdraw what is not."""
    from bellows_design.export.approved import export_approved, withdraw
    from bellows_design.geometry.tessellation import TOLERANCE

    if not verdict.approved:
        return None, withdraw(design.name, output_root)
    grounds = {
        "design": design.model_dump(mode="json", exclude_none=True),
        "mesh_tolerance_mm": TOLERANCE,
        "check": check_dict(design, report),
        "evaluation": evaluation.to_dict(),
    }
    return export_approved(part, verdict, grounds, output_root), None
