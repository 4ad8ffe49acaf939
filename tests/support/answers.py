"""Answers in JSON against the schemas that are shipped."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from bellows_design.schemas.library import VERSION, schema, schema_names


@cache
def registry() -> Registry[Any]:
    """All schemas by their addresses."""
    found = [Resource.from_contents(schema(name)) for name in schema_names()]
    return Registry().with_resources((each.id() or "", each) for each in found)


@cache
def validator(name: str) -> Draft202012Validator:
    """Of the schema of that name."""
    return Draft202012Validator(schema(name), registry=registry())


def misfits(content: dict[str, Any], name: str) -> list[str]:
    """What of ``content`` is not as the schema of that name says, field by field."""
    plain = json.loads(json.dumps(content))
    return [
        f"{each.json_path}: {each.message[:300]}" for each in validator(name).iter_errors(plain)
    ]


def assert_fits(content: dict[str, Any], name: str | None = None) -> None:
    """The answer of a command is as its schema says; without ``name`` as the answer itself says."""
    stated = content.get("schema", "")
    known = name or stated.removeprefix("bellows ").removesuffix(f" {VERSION}")
    assert known in schema_names(), f"there is no schema of {stated!r}"
    found = misfits(content, known)
    assert not found, found
