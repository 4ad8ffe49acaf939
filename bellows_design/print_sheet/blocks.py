"""What a sheet is made of, whatever it is written as: headings, sentences, tables, steps."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Heading:
    """A line above what follows; the first of level 1, all others of level 2."""

    text: str
    level: int = 2


@dataclass(frozen=True)
class Paragraph:
    """Sentences."""

    text: str


@dataclass(frozen=True)
class Table:
    """Rows of cells below a row of headings."""

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Steps:
    """What is done one after the other: in words, with the reason."""

    steps: tuple[tuple[str, str], ...]


Block = Heading | Paragraph | Table | Steps
