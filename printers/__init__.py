"""Printer profiles, and the check whether a part can be printed airtight on such a printer.

The package knows solids, given as closed triangle meshes, and nothing of what they are for.
Lengths are in mm, angles in degrees; the build direction is +z.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from printers.errors import PrintersError
from printers.profile import Filament, PrinterProfile, SlicerAdvice
from printers.profile_files import (
    available_filaments,
    available_profiles,
    load_filament,
    load_profile,
    profile_from_table,
)
from printers.report import PrintabilityReport, RuleResult
from printers.rule_table import RULES, Rule

if TYPE_CHECKING:
    from printers.model import DeclaredGap, DeclaredWall, Opening, PrintedModel

__all__ = [
    "RULES",
    "DeclaredGap",
    "DeclaredWall",
    "Filament",
    "Opening",
    "PrintabilityReport",
    "PrintedModel",
    "PrinterProfile",
    "PrintersError",
    "Rule",
    "RuleResult",
    "SlicerAdvice",
    "available_filaments",
    "available_profiles",
    "check_printability",
    "load_filament",
    "load_profile",
    "profile_from_table",
]


def __getattr__(name: str) -> Any:
    """The records of a part, which need NumPy: imported when they are first asked for."""
    if name not in ("DeclaredGap", "DeclaredWall", "Opening", "PrintedModel"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from printers import model

    return getattr(model, name)


def check_printability(model: PrintedModel, profile: PrinterProfile) -> PrintabilityReport:
    """Apply every rule to the part, standing as it is modelled, on this printer.

    Deterministic: the same mesh always gives the same report, and another triangulation of the same
    faces the same verdicts.

    Args:
        model: The part and what its designer declares about it.
        profile: The printer.

    Returns:
        One result for every rule and wall, gap or place it was applied to.

    Raises:
        PrintersError: No triangle of the mesh has an area.

    Examples:
        >>> import trimesh
        >>> from printers import PrintedModel, check_printability, load_profile
        >>> sheet = trimesh.creation.box((20, 20, 0.2))  # a single layer seals nothing
        >>> model = PrintedModel(sheet.vertices, sheet.faces)
        >>> report = check_printability(model, load_profile("prusa_i3"))
        >>> print(report.verdict, sorted({failure.rule for failure in report.failures}))
        fail ['airtightness', 'minimum_layers']
    """
    from printers.check import check_printability as check  # compiled code: only when needed

    return check(model, profile)
