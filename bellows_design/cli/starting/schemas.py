"""``bellows schema``: the JSON Schemas of answers."""

from __future__ import annotations

from collections.abc import Sequence

from bellows_design.cli.answer import Answer


def schema(words: Sequence[str]) -> Answer:
    """The schema of a command, with all that it refers to; without words the names of all."""
    from bellows_design.schemas.library import bundled, schema_names

    if not words:
        return Answer({}, list(schema_names()))
    return Answer(bundled(" ".join(words)), [], states_schema=False)
