"""The fields of what commands answer with ``--json``, as their schemas have them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from generators.tables import prose, table

HEADER = """\
# Schemas of the JSON

Made from the schemas at the build of this page: what `bellows schema COMMAND` prints whole. `[]`
are the entries of a list, `*` those of an object with names of any kind. What the fields mean for
an evaluation, and when the version changes, is in [JSON](../json.md).
"""

Row = tuple[str, str, str]


def page() -> str:
    """All schemas, one section each."""
    from bellows_design.schemas.library import schema, schema_names

    return "\n".join([HEADER, *(_section(name, schema(name)) for name in schema_names())])


def _section(name: str, content: dict[str, Any]) -> str:
    about = prose(content.get("description", ""))
    lines = [f"## `{name}`", "", about, "", _table(content)]
    for part, inner in content.get("$defs", {}).items():
        lines += [f"### `{part}` of `{name}`", "", prose(inner.get("description", "")), ""]
        lines += [_table(inner) or f"{kind(inner)}.\n"]
    return "\n".join(lines)


def _table(content: dict[str, Any]) -> str:
    return table(("field", "type", "meaning"), rows("", content))


def rows(path: str, content: dict[str, Any]) -> Iterator[Row]:
    """Every field of a schema and of what it holds, by its path."""
    for key, inner in content.get("properties", {}).items():
        inner = inner if isinstance(inner, dict) else {}  # true: anything
        place = f"{path}.{key}" if path else key
        yield f"`{place}`", kind(inner), prose(inner.get("description", ""))
        yield from rows(place, inner)
    for choice in content.get("anyOf", []):
        yield from rows(path, choice)
    for mark, key in (("[]", "items"), (".*", "additionalProperties")):
        if isinstance(content.get(key), dict):
            yield from rows(f"{path}{mark}", content[key])


def kind(content: dict[str, Any]) -> str:
    """Type of a value in a few words."""
    if "$ref" in content:
        return _referred(content["$ref"])
    if "const" in content:
        return f"`{content['const']}`"
    if "enum" in content:
        return ", ".join("null" if each is None else f"`{each}`" for each in content["enum"])
    if "anyOf" in content:
        return " or ".join(dict.fromkeys(map(kind, content["anyOf"])))
    types = content.get("type", "any")
    listed = [types] if isinstance(types, str) else types
    return " or ".join(_of(each, content) for each in listed)


def _of(name: str, content: dict[str, Any]) -> str:
    """A type, with that of its entries."""
    entries = content.get({"array": "items", "object": "additionalProperties"}.get(name, ""))
    return f"{name} of {kind(entries)}" if isinstance(entries, dict) else name


def _referred(reference: str) -> str:
    """What a reference leads to: a part of this schema, or another schema or a part of it."""
    whole, _, part = reference.partition("#/$defs/")
    other = whole.rpartition(":")[2].replace("-", " ")
    return " of ".join(f"`{each}`" for each in (part, other) if each)
