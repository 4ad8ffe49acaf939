"""Completions as options and arguments take them: with the design that stands before them."""

from __future__ import annotations

import typer

from bellows_design.cli.completion import names
from bellows_design.cli.completion.settings import settings


def complete_setting(context: typer.Context, incomplete: str) -> names.Completion:
    """Of ``--set``."""
    return settings(_design(context), incomplete)


def complete_scene(context: typer.Context, incomplete: str) -> names.Completion:
    """Of ``--scene``."""
    return names.scenes(_design(context), incomplete)


def complete_model(incomplete: str) -> names.Completion:
    """Laws that ``bellows fit`` knows."""
    from bellows_design.materials.laws import FIT_CHOICES

    return list(names.beginning(incomplete, FIT_CHOICES))


def complete_source(context: typer.Context, incomplete: str) -> names.Completion:
    """What ``bellows init KIND FILE --from`` begins with."""
    kind = _argument(context, "kind", 0)
    known = {"design": names.designs, "printer": names.printers, "filament": names.filaments}
    if kind == "material":
        return list(names.beginning(incomplete, names.materials()))
    return known[kind](incomplete) if kind in known else []


def complete_schema(incomplete: str) -> names.Completion:
    """Names of schemas."""
    from bellows_design.schemas.library import schema_names

    return list(names.beginning(incomplete, schema_names()))


def _design(context: typer.Context) -> str:
    """The design that was typed so far; empty where there is none.

    Where an option still waits for its value, arguments are not assigned to parameters yet.
    """
    return _argument(context, "name", 0)


def _argument(context: typer.Context, name: str, place: int) -> str:
    waiting = [word for word in context.args if not word.startswith("-")]
    given = context.params.get(name) or (waiting[place] if len(waiting) > place else "")
    return str(given)
