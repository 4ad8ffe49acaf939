"""What is printed for people, on terminals of several widths."""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from rich.cells import cell_len
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.cli.terminal.console import console_on, print_for_people

WIDTHS = (40, 60, 80, 120)


class Screen(io.StringIO):
    """A terminal that keeps what is printed on it."""

    def isatty(self) -> bool:
        return True


def on_terminal(lines: Sequence[RenderableType], width: int) -> list[str]:
    """The lines that a terminal of that width shows."""
    screen = Screen()
    with _columns(width):
        print_for_people(lines, screen)
    return screen.getvalue().splitlines()


def assert_fits_terminals(lines: Sequence[RenderableType]) -> None:
    """On terminals of any width no line is too long, and no character of a cell is missing."""
    wanted = Counter(sign for text in _texts(lines) for sign in text if not sign.isspace())
    for width in WIDTHS:
        shown = on_terminal(lines, width)
        assert max((cell_len(line) for line in shown), default=0) <= width
        found = Counter("".join(shown))
        lost = {sign for sign, count in wanted.items() if found[sign] < count} - {"-"}
        assert not lost, f"{width} columns: {lost} in {shown}"
        assert found["…"] == wanted["…"] or found["…"] > wanted["…"] > 0


def printed_on_any_terminal(lines: Sequence[RenderableType]) -> None:
    """Print as a command does, once it is known to fit every terminal."""
    assert_fits_terminals(lines)
    print_for_people(lines)


def _texts(lines: Sequence[RenderableType]) -> Iterator[str]:
    """All texts and cells."""
    for line in lines:
        if isinstance(line, Table):
            yield from (_plain(cell) for column in line.columns for cell in column.cells)
        else:
            yield _plain(line)


def _plain(cell: Any) -> str:
    return cell.plain if isinstance(cell, Text) else str(cell)


def _columns(width: int) -> Any:
    from unittest.mock import patch

    return patch.dict("os.environ", {"COLUMNS": str(width), "NO_COLOR": "1"})


__all__ = ["WIDTHS", "Screen", "assert_fits_terminals", "console_on", "on_terminal"]
