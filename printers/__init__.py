"""Printer profiles, and the check whether a part can be printed airtight on such a printer.

The package knows solids, given as closed triangle meshes, and nothing of what they are for.
Lengths are in mm, angles in degrees; the build direction is +z.
"""

from __future__ import annotations

from printers.model import DeclaredGap, DeclaredWall, Opening, PrintedModel
from printers.profile import PrinterProfile, SlicerAdvice, available_profiles, load_profile
from printers.report import PrintabilityReport, RuleResult

__all__ = [
    "DeclaredGap",
    "DeclaredWall",
    "Opening",
    "PrintabilityReport",
    "PrintedModel",
    "PrinterProfile",
    "RuleResult",
    "SlicerAdvice",
    "available_profiles",
    "check_printability",
    "load_profile",
]


def check_printability(model: PrintedModel, profile: PrinterProfile) -> PrintabilityReport:
    """Apply every rule of the package to a part; see `printers.check.check_printability`."""
    from printers.check import check_printability as check  # compiled code: only when needed

    return check(model, profile)
