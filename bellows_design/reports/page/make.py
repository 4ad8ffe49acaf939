"""The report as one file: for a run, and for whoever asks for it."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from bellows_design.reports.page.findings import FEW_FRAMES, Findings, findings_of

if TYPE_CHECKING:
    from bellows_design.pipeline import Outcome
    from bellows_design.reports.page.blocks import Page

LARGEST = 8_000_000
"""Bytes that a report has at most."""


def run_report(outcome: Outcome, files: Mapping[str, bytes]) -> bytes:
    """The report beside the ``files`` of an export: what a run found out, and their hashes.

    Without sensitivities and with few frames, so that it takes a small part of the run's time.
    """
    from dataclasses import replace

    from bellows_design.export.manifest import fingerprint

    prints = {name: fingerprint(content) for name, content in sorted(files.items())}
    return report_html(
        replace(findings_of(outcome, derivatives=False, frames=FEW_FRAMES), files=prints)
    )


def report_html(findings: Findings) -> bytes:
    """The report as one HTML file, UTF-8; it loads nothing from anywhere."""
    from bellows_design.reports.page.assemble import as_html

    return as_html(page_of(findings), made_by()).encode()


def page_of(findings: Findings) -> Page:
    """Head and sections in their order."""
    from bellows_design.reports.page import sections
    from bellows_design.reports.page.blocks import Page
    from bellows_design.reports.page.sections.head import head

    return Page(head(findings), tuple(each(findings) for each in sections.in_order()))


def made_by() -> str:
    """By what, when and for how long this holds."""
    from bellows_design import __version__

    when = datetime.now(UTC).isoformat(timespec="seconds")
    return (
        f"Made by bellows-design {__version__} on {when}. The verdict is about a model: it knows "
        "the material's strength, not its fatigue, and the printer's rules, not the state of the "
        "filament."
    )
