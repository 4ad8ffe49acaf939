"""Tables and paragraphs in Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table, or nothing where there are no rows."""
    lines = [_row(cells) for cells in rows]
    return "\n".join([_row(header), _row(["---"] * len(header)), *lines, ""]) if lines else ""


def _row(cells: Iterable[str]) -> str:
    return "| " + " | ".join(_cell(text) for text in cells) + " |"


def _cell(text: str) -> str:
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def prose(text: str) -> str:
    """A sentence of a help text or docstring as Markdown: code in single backticks."""
    text = re.sub(r"``([^`]*)``", r"`\1`", text)
    return re.sub(r"(?<![`\\])([<>*_])(?![^`]*`(?:[^`]*`[^`]*`)*[^`]*$)", r"\\\1", text)
