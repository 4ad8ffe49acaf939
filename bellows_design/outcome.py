"""What a run found out about a design, as one record."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.design.design import Design
from bellows_design.printability import check_dict

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.approval import Verdict
    from bellows_design.export.part import Part
    from bellows_design.leak_test.record import LeakTest
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
        part: The solid as printed and its mesh.
        folder: Where the approved files are; None if the design is refused.
        withdrawn: Folder of an earlier approved export that this refusal took back.
    """

    design: Design
    report: PrintabilityReport
    evaluation: Evaluation | None
    verdict: Verdict
    leak_test: LeakTest
    part: Part = field(repr=False, compare=False)
    folder: Path | None = None
    withdrawn: Path | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        evaluation = self.evaluation
        return {
            "design": self.design.name,
            "digest": self.design.digest,
            **self.verdict.to_dict(),
            "folder": None if self.folder is None else str(self.folder),
            "withdrawn": None if self.withdrawn is None else str(self.withdrawn),
            "from_cache": None if evaluation is None else evaluation.from_cache or None,
            "check": check_dict(self.design, self.report),
            "leak_test": self.leak_test.to_dict(),
            "evaluation": None if evaluation is None else evaluation.to_dict(),
        }
