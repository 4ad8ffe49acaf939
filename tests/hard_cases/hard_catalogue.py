"""All hard cases, family by family."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from hard_case import HardCase

DOCUMENT = Path(__file__).parents[2] / "docs" / "hard-cases.md"
FAMILIES = (
    "hard_materials",
    "hard_elements",
    "hard_regions",
    "hard_meshes",
    "hard_supports",
    "hard_contacts",
    "hard_inputs",
    "hard_kinds",
    "hard_reactions",
    "hard_folds",
    "hard_walks",
    "hard_limits",
    "hard_volumes",
    "hard_sameness",
    "hard_designs",
)
"""Modules; the first line of each one's docstring is its title."""


def families() -> dict[str, tuple[HardCase, ...]]:
    """Cases by the titles of their families."""
    modules = [import_module(name) for name in FAMILIES]
    return {(module.__doc__ or "").splitlines()[0].rstrip("."): module.CASES for module in modules}


def all_cases() -> tuple[HardCase, ...]:
    """Every case once."""
    return tuple(case for cases in families().values() for case in cases)
