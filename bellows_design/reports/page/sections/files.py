"""The files of the export beside the report, with their hashes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.reports.page.blocks import Block, Cell, Fact, Facts, Grid, Section, Sentences
from bellows_design.reports.page.wording import headings, number

if TYPE_CHECKING:
    from bellows_design.reports.page.findings import Findings

NONE = (
    "This report was made without an export. bellows run writes the files of an approved design, "
    "and a report beside them that states their hashes."
)


def files(findings: Findings) -> Section:
    """Digest of the design, and name, length and SHA-256 of every file."""
    digest = Facts((Fact("design digest", findings.outcome.design.digest),))
    blocks: tuple[Block, ...] = (digest, Sentences((NONE,), "muted"))
    if findings.files:
        rows = tuple(
            (Cell(name), number(str(each["bytes"])), Cell(str(each["sha256"])))
            for name, each in findings.files.items()
        )
        told = Sentences(
            ("bellows verify FOLDER compares them, and rebuilds the design.",), "muted"
        )
        blocks = (digest, Grid(headings("file", "bytes", "SHA-256", right=("bytes",)), rows), told)
    return Section("files", "Files", blocks)
