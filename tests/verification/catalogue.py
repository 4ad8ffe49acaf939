"""All verification cases, in families: the modules ``cases_*.py`` next to this one.

The first line of a module's docstring is the family's title.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path

from case import Case

HERE = Path(__file__).parent
DOCUMENT = HERE.parents[1] / "docs" / "verification.md"


@dataclass(frozen=True)
class Family:
    """Cases that belong together."""

    title: str
    cases: tuple[Case, ...]


@cache
def families() -> tuple[Family, ...]:
    """All families, by the names of their modules."""
    modules = [import_module(path.stem) for path in sorted(HERE.glob("cases_*.py"))]
    return tuple(
        Family((module.__doc__ or "").strip().splitlines()[0].rstrip("."), module.CASES)
        for module in modules
    )


def all_cases() -> tuple[Case, ...]:
    """Every case once."""
    return tuple(case for family in families() for case in family.cases)
