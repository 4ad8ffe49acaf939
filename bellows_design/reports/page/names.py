"""How the file of a report is called."""

from __future__ import annotations

from bellows_design.export.manifest import report_name

__all__ = ["report_name"]
