"""Texts and tables that fit a width, and of which nothing is cut.

A table that does not fit gets narrower columns, where these may wrap between words. Where even that
does not do, each row becomes a few lines, one for each cell behind the heading of its column.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import deepcopy
from typing import TYPE_CHECKING, cast

from rich.measure import Measurement
from rich.table import Column, Table
from rich.text import Text

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

COMFORTABLE, TIGHT = 16, 8
"""Columns that a cell with several words has at least, if it has that many at all; and where there
is little room."""

LONGEST_WORD = 32
"""Columns. Longer words, such as paths, go on in the next line."""

INDENT = 2


def fitted(item: RenderableType, console: Console) -> Iterator[RenderableType]:
    """``item`` as renderables that are no wider than the console."""
    if isinstance(item, Table):
        yield from _fitted_table(item, console)
    elif isinstance(item, str | Text):
        text = console.render_str(item) if isinstance(item, str) else item
        for line in text.split("\n", allow_blank=True):
            yield from hanging(line, console.width, console)
    else:
        yield item


def hanging(line: Text, width: int, console: Console) -> Iterator[Text]:
    """A line as lines of at most ``width``; those that follow are indented as the first one is."""
    plain = line.plain
    bare = plain.lstrip(" ")
    indent = len(plain) - len(bare) + (2 if bare.startswith("- ") else 0)
    if line.cell_len <= width or indent > width // 2:
        yield from line.wrap(console, width, overflow="fold") if plain else [line]
        return
    for number, part in enumerate(line[indent:].wrap(console, width - indent, overflow="fold")):
        part.rstrip()
        yield line[:indent] + part if number == 0 else Text(" " * indent) + part


def _fitted_table(table: Table, console: Console) -> Iterator[RenderableType]:
    """The table as it is, with narrower columns, these nearer to each other, or as records."""
    if _frame(table, console) + sum(_natural(table, console)) <= console.width:
        yield table
        return
    table = deepcopy(table)  # whose columns are changed; its owner may print it elsewhere
    for comfort, padding in ((COMFORTABLE, None), (TIGHT, None), (TIGHT, (0, 0))):
        if padding is not None:
            table.padding, table.pad_edge = padding, False
        room = console.width - _frame(table, console)
        least = _least_widths(table, comfort, console)
        if sum(least) <= room:
            yield _with_widths(table, _shared(_natural(table, console), least, room))
            return
    yield from _records(table, console)


def _frame(table: Table, console: Console) -> int:
    """Columns that all but the cells take."""
    endless = console.options.update_width(100_000)
    whole = Measurement.get(console, endless, table).maximum
    return whole - sum(_natural(table, console))


def _natural(table: Table, console: Console) -> list[int]:
    """Columns that the longest line of each column takes."""
    return [_widest(column, table, console) for column in table.columns]


def _least_widths(table: Table, comfort: int, console: Console) -> list[int]:
    """Columns below which words would be cut, or there would be too little to read."""
    return [_least(column, table, comfort, console) for column in table.columns]


def _widest(column: Column, table: Table, console: Console) -> int:
    """Columns that its longest line takes."""
    return max((line.cell_len for line in _lines(column, table, console)), default=0)


def _least(column: Column, table: Table, comfort: int, console: Console) -> int:
    natural = _widest(column, table, console)
    if column.no_wrap:
        return natural
    words = (word for line in _lines(column, table, console) for word in line.plain.split())
    longest = max((Text(word).cell_len for word in words), default=0)
    return max(min(longest, LONGEST_WORD), min(natural, comfort))


def _lines(column: Column, table: Table, console: Console) -> Iterator[Text]:
    heads = [column.header] if table.show_header else []
    for cell in (*heads, *column.cells):
        yield from _text(cell, console).split("\n", allow_blank=True)


def _text(cell: RenderableType, console: Console) -> Text:
    return cell if isinstance(cell, Text) else console.render_str(cast("str", cell))


def _shared(natural: Sequence[int], least: Sequence[int], room: int) -> list[int]:
    """Widths between ``least`` and ``natural`` that fill the room: each short column in full."""
    widths, wanting = list(least), [i for i in range(len(least)) if natural[i] > least[i]]
    rest = room - sum(widths)
    while rest > 0 and wanting:
        each = max(rest // len(wanting), 1)
        for i in list(wanting):
            more = min(each, natural[i] - widths[i], rest)
            widths[i] += more
            rest -= more
            if widths[i] == natural[i]:
                wanting.remove(i)
    return widths


def _with_widths(table: Table, widths: Sequence[int]) -> Table:
    """The same table with columns of these widths."""
    for column, width in zip(table.columns, widths, strict=True):
        column.width = width
        column.overflow = "fold"
    return table


def _records(table: Table, console: Console) -> Iterator[RenderableType]:
    """Each row as lines: a cell behind its heading, or, in a table without, below the first."""
    if table.title:
        title = _text(table.title, console)
        yield from hanging(title, console.width, console)
    heads = [_one_line(_text(column.header, console)) for column in table.columns]
    if not table.show_header:
        heads = [Text("")] * len(heads)
    for row in zip(*(column.cells for column in table.columns), strict=True):
        if table.show_header:
            yield Text("")
        cells = [_one_line(_text(cell, console)) for cell in row]
        yield from _record(heads, cells, console)
    yield Text("")


def _record(heads: Sequence[Text], cells: Sequence[Text], console: Console) -> Iterator[Text]:
    """The cells of a row; one that has no heading is one with the next, as a verdict is."""
    bare = next((n for n, head in enumerate(heads) if head.plain), len(heads) - 2)
    begin = max(bare, 0) if bare else 0
    first = Text(" ").join(cells[: begin + 1]) if begin else _named(heads[0], cells[0])
    others = [_named(*each) for each in zip(heads[begin + 1 :], cells[begin + 1 :], strict=True)]
    yield from hanging(first, console.width, console)
    for each in others:
        if each.plain.strip():
            yield from hanging(Text(" " * INDENT) + each, console.width, console)


def _named(head: Text, cell: Text) -> Text:
    if not (head.plain and cell.plain.strip()):
        return cell
    return Text(f"{head.plain}: ") + cell


def _one_line(text: Text) -> Text:
    """Lines of a narrow heading joined: a word that was hyphenated for it, as a whole."""
    if "\n" not in text.plain:
        return text
    return Text(text.plain.strip().replace("-\n", "").replace("\n", " "))
