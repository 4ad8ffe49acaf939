"""A report as pages of A4: the same blocks as on the HTML page, one below the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Facts,
    Folded,
    Grid,
    Head,
    Heading,
    Layers,
    Page,
    Pictures,
    Sentences,
    Space,
    Steps,
)
from bellows_design.reports.page.pictures.drawn import INK, MUTED, RED, draw
from bellows_design.reports.page.pictures.libraries import require_pictures, without_glyph_warnings
from bellows_design.reports.page.pictures.rendering import Look
from bellows_design.reports.page.pictures.surfaces import draw_surface, surface_of

if TYPE_CHECKING:
    from bellows_design.reports.page.findings import Findings

WIDTH, HEIGHT = 8.27, 11.69
"""Inches, A4."""

LEFT, TOP, BOTTOM = 0.75, 0.7, 0.7

PICTURE = 3.1
"""Inches, of a row of pictures."""

BELOW = 1.2
"""Inches that stand below a heading at least."""

LINE = 0.155
"""Inches, of text of 8 points."""

LETTERS = 104
"""On a line of text."""

COLOURS = {"bad": RED, "warn": "#7a4b00", "muted": MUTED}


def as_pdf(found: Findings) -> bytes:
    """The report as PDF.

    Raises ``DesignError`` without PyVista or matplotlib, or where nothing can be drawn.
    """
    require_pictures()
    from bellows_design.reports.page.make import made_by, page_of

    page = page_of(found)
    paper = _Paper()
    _head(paper, page.head)
    for section in page.sections:
        begins = section.blocks[0]
        below = PICTURE if isinstance(begins, Pictures | Space) else 0.0
        paper.heading(section.title, 13, BELOW + below)
        for block in section.blocks:
            _block(paper, block)
    paper.text(made_by(), MUTED)
    return paper.done(page)


@dataclass
class _Paper:
    """Pages so far, and how far down the last one is filled, inches."""

    figures: list[Any] = field(default_factory=list)
    down: float = HEIGHT

    def room(self, height: float) -> float:
        """A place of this height, on a new page if need be: its upper end from below, inches."""
        if self.down + height > HEIGHT - BOTTOM:
            from matplotlib.figure import Figure

            self.figures.append(Figure(figsize=(WIDTH, HEIGHT)))
            self.down = TOP
        top = HEIGHT - self.down
        self.down += height
        return top

    def line(self, text: str, size: float = 8, colour: str = INK, **options: Any) -> None:
        """One line of text."""
        top = self.room(LINE * size / 8)
        x = options.pop("x", LEFT)
        self.figures[-1].text(
            x / WIDTH, top / HEIGHT, text, fontsize=size, color=colour, va="top",
            parse_math=False, **options,
        )  # fmt: skip

    def text(self, text: str, colour: str = INK) -> None:
        """A paragraph."""
        for line in wrap(text, LETTERS) or [""]:
            self.line(line, colour=colour)
        self.down += 0.05

    def heading(self, text: str, size: float, below: float = BELOW) -> None:
        """A title with as much room ``below`` it, inches, on the same page."""
        self.down += 0.16
        if self.down > HEIGHT - BOTTOM - below:
            self.down = HEIGHT
        self.line(text, size, weight="bold")
        self.down += 0.06

    def axes(self, height: float, start: float = 0.0, share: float = 1.0) -> Any:
        """Axes in a strip of this height that ``room`` was made for."""
        width = WIDTH - 2 * LEFT
        low = HEIGHT - self.down
        box = (
            (LEFT + start * width + 0.45) / WIDTH,
            (low + 0.4) / HEIGHT,
            (share * width - 0.6) / WIDTH,
            (height - 0.75) / HEIGHT,
        )
        return self.figures[-1].add_axes(box)

    def done(self, page: Page) -> bytes:
        """All pages."""
        from matplotlib.backends.backend_pdf import PdfPages

        content = BytesIO()
        title = {"Title": f"{page.head.name}: report", "CreationDate": None}
        with without_glyph_warnings(), PdfPages(content, metadata=title) as pages:
            for number, figure in enumerate(self.figures, 1):
                foot = f"{page.head.name}, page {number} of {len(self.figures)}"
                figure.text(0.5, 0.03, foot, fontsize=7, color=MUTED, ha="center", parse_math=False)
                pages.savefig(figure)
        return content.getvalue()


def _head(paper: _Paper, head: Head) -> None:
    paper.line(head.name, 20, weight="bold")
    paper.down += 0.1
    paper.text(head.description, MUTED)
    colour = {"good": "#17683a", "bad": RED}.get(head.tone, "#7a4b00")
    paper.line(f"{head.verdict}. {head.summary}", 12, colour, weight="bold")
    paper.down += 0.08
    for fact in head.figures:
        paper.text(fact.line)
    for fact in head.reasons:
        paper.text(f"{fact.name} ({fact.note}): {fact.value}", RED)
    for text in head.warnings:
        paper.text(text, COLOURS["warn"])
    for fact in head.not_judged:
        paper.text(f"Not judged: {fact.name}, as {fact.value}.")
    paper.text(f"design digest {head.digest}", MUTED)


def _block(paper: _Paper, block: Block) -> None:
    writers: dict[type, Callable[[_Paper, Any], None]] = {
        Sentences: _sentences,
        Facts: _facts,
        Grid: _grid,
        Folded: _folded,
        Steps: _steps,
        Heading: lambda paper, block: paper.heading(block.text, 10),
        Pictures: _pictures,
        Space: _space,
        Layers: lambda paper, block: paper.text(f"(On the HTML page: {block.caption})", MUTED),
    }
    writers[type(block)](paper, block)


def _sentences(paper: _Paper, block: Sentences) -> None:
    for text in block.texts:
        paper.text(text, COLOURS.get(block.tone, INK))


def _facts(paper: _Paper, block: Facts) -> None:
    for fact in block.rows:
        paper.text(fact.line, COLOURS.get(fact.tone, INK))


def _folded(paper: _Paper, block: Folded) -> None:
    paper.heading(block.title, 10)
    for each in block.blocks:
        _block(paper, each)


def _steps(paper: _Paper, block: Steps) -> None:
    for number, (what, why) in enumerate(block.steps, 1):
        paper.text(f"{number}. {what} {why}")


def _grid(paper: _Paper, block: Grid) -> None:
    """Columns as wide as their longest cells ask for; a cell takes as many lines as it needs."""
    widths = _column_widths(block)
    if block.caption:
        paper.text(block.caption, MUTED)
    _row(paper, block.headings, widths, MUTED)
    for row in block.rows:
        _row(paper, row, widths, INK)
    paper.down += 0.08


def _column_widths(block: Grid) -> list[int]:
    """Letters of each column, which together fill a line at most."""
    columns = list(zip(block.headings, *block.rows, strict=True))
    wanted = [max(len(cell.text) for cell in column) + 2 for column in columns]
    while sum(wanted) > LETTERS:
        wanted[wanted.index(max(wanted))] -= 1
    return wanted


def _row(paper: _Paper, row: tuple[Cell, ...], widths: list[int], colour: str) -> None:
    cells = [
        wrap(cell.text, max(4, width - 1)) or [""] for cell, width in zip(row, widths, strict=True)
    ]
    letter = (WIDTH - 2 * LEFT) / LETTERS
    for number in range(max(map(len, cells))):
        top, x = paper.room(LINE), LEFT
        for lines, cell, width in zip(cells, row, widths, strict=True):
            text = lines[number] if number < len(lines) else ""
            paper.figures[-1].text(
                x / WIDTH, top / HEIGHT, text, fontsize=7, va="top", parse_math=False,
                color=COLOURS.get(cell.tone, colour),
            )  # fmt: skip
            x += width * letter


def _pictures(paper: _Paper, block: Pictures) -> None:
    """Two beside each other."""
    for start in range(0, len(block.pictures), 2):
        pair = block.pictures[start : start + 2]
        paper.room(PICTURE)
        for number, picture in enumerate(pair):
            draw(paper.axes(PICTURE, number / 2, 0.5), picture.content)
    for picture in block.pictures:
        if picture.caption and picture.caption != picture.content.title:
            paper.text(picture.caption, MUTED)


def _space(paper: _Paper, block: Space) -> None:
    """From outside, and cut open or at rest."""
    surface = surface_of(block)
    if surface is None:
        return
    labels = surface.frame_labels
    looks = {"from outside": Look(block.field), "cut open": Look(block.field, cut=True)}
    if len(labels) > 1:
        looks = {labels[0]: Look(block.field, 0), labels[-1]: Look(block.field)}
    paper.room(PICTURE)
    for number, (title, look) in enumerate(looks.items()):
        draw_surface(paper.axes(PICTURE, number / 2, 0.5), surface, look, title)
    paper.text(block.caption, MUTED)
