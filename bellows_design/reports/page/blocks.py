"""What the sections of a report are made of, whatever they are written as.

Each block names the template that writes it. All text is plain text: it is escaped where it is
written.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, Literal

if TYPE_CHECKING:
    from bellows_design.reports.page.curves.chart import BarChart, Chart
    from bellows_design.reports.page.drawing.marks import Drawing
    from bellows_design.web.layers import PrintLayers
    from bellows_design.web.scene import Shown

Tone = Literal["", "good", "info", "warn", "bad", "muted"]


@dataclass(frozen=True)
class Sentences:
    """Paragraphs of one tone."""

    template: ClassVar[str] = "sentences.html"

    texts: tuple[str, ...]
    tone: Tone = ""


@dataclass(frozen=True)
class Fact:
    """A value with its error beside it; ``note`` says what it is held against."""

    name: str
    value: str
    error: str = ""
    note: str = ""
    tone: Tone = ""

    @property
    def line(self) -> str:
        """All of it on one line."""
        said = " ".join(each for each in (self.value, self.error, self.note) if each)
        return f"{self.name}: {said}"


@dataclass(frozen=True)
class Facts:
    """Values by their names."""

    template: ClassVar[str] = "facts.html"

    rows: tuple[Fact, ...]


@dataclass(frozen=True)
class Cell:
    """A cell of a table."""

    text: str
    tone: Tone = ""
    align: Literal["left", "right"] = "left"


@dataclass(frozen=True)
class Grid:
    """A table; a narrow page scrolls it by itself."""

    template: ClassVar[str] = "grid.html"

    headings: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    caption: str = ""


@dataclass(frozen=True)
class Folded:
    """Blocks that are shown on demand, below a line that names them."""

    template: ClassVar[str] = "folded.html"

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Steps:
    """What is done one after the other: in words, with the reason."""

    template: ClassVar[str] = "steps.html"

    steps: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Heading:
    """A line above what follows within a section."""

    template: ClassVar[str] = "heading.html"

    text: str


@dataclass(frozen=True)
class Picture:
    """A drawing or chart with a sentence on it."""

    content: Drawing | Chart | BarChart
    caption: str = ""


@dataclass(frozen=True)
class Pictures:
    """Pictures beside each other, as far as the page is wide enough."""

    template: ClassVar[str] = "pictures.html"

    pictures: tuple[Picture, ...]


@dataclass(frozen=True, eq=False)
class Space:
    """Surfaces to turn around; the named ``field`` colours them at first."""

    template: ClassVar[str] = "space.html"

    surfaces: tuple[Shown, ...]
    caption: str
    label: str
    field: str = ""
    height: int = 440
    frame: int = 0


@dataclass(frozen=True, eq=False)
class Layers:
    """The layers of a print, with a slider over them."""

    template: ClassVar[str] = "layers.html"

    layers: PrintLayers
    caption: str


Block = Sentences | Facts | Grid | Folded | Steps | Heading | Pictures | Space | Layers


@dataclass(frozen=True)
class Section:
    """A part of the report; ``key`` is its address on the page."""

    key: str
    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Head:
    """What stands on top: the verdict with all reasons, and the figures that matter."""

    name: str
    description: str
    verdict: str
    tone: Tone
    summary: str
    reasons: tuple[Fact, ...]
    warnings: tuple[str, ...]
    not_judged: tuple[Fact, ...]
    figures: tuple[Fact, ...]
    digest: str


@dataclass(frozen=True)
class Page:
    """A whole report."""

    head: Head
    sections: tuple[Section, ...] = field(default=())
