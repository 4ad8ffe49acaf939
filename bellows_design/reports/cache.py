"""What the store of results holds, as text for people."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.store.store import Holdings

MIB = 2**20


def cache_table(holdings: Holdings, cleared: bool, left: int) -> Sequence[RenderableType]:
    """Folder, number, size and age; and, if it was to be ``cleared``, how much was ``left``."""
    table = Table(box=SIMPLE, show_header=False)
    for name, value in _rows(holdings).items():
        table.add_row(name, Text(value))
    removed = f"{left} could not be removed." if left else "All of it was removed."
    return [table, *([Text(removed)] if cleared else [])]


def _rows(holdings: Holdings) -> dict[str, str]:
    usable = f"{holdings.usable} of them by this version on this machine"
    return {
        "folder": str(holdings.folder),
        "evaluations": f"{holdings.results}, {usable}",
        "size": f"{holdings.size / MIB:.1f} MiB of at most {holdings.limit / MIB:.0f} MiB",
        "last used": f"{_day(holdings.oldest)} … {_day(holdings.newest)}",
    }


def _day(time: datetime | None) -> str:
    return "–" if time is None else f"{time:%Y-%m-%d %H:%M} UTC"
