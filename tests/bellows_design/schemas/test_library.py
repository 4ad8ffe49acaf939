"""The schemas: one for each command with ``--json``, each valid, none with room for more fields."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import pytest
from answers import registry, validator
from jsonschema import Draft202012Validator

from bellows_design.errors import DesignError
from bellows_design.schemas.library import RECORDS, address, bundled, label, schema, schema_names
from printers.leak_test.result import Leak

each_schema = pytest.mark.parametrize("name", schema_names())


def commands_of(group: Any, before: str = "") -> Iterator[tuple[str, Any]]:
    """All commands by their whole names, those of sub-commands too."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands_of(command, f"{before}{name} ")
        else:
            yield f"{before}{name}", command


def commands_with_json() -> set[str]:
    from typer.main import get_command

    from bellows_design.cli.commands import app

    return {
        name
        for name, command in commands_of(get_command(app))
        if any("--json" in parameter.opts for parameter in command.params)
    }


def test_every_command_with_json_has_a_schema_and_no_schema_is_of_none() -> None:
    assert set(schema_names()) == commands_with_json() | {"error", *RECORDS}


@each_schema
def test_a_schema_is_one_and_says_whose_it_is(name: str) -> None:
    content = schema(name)
    Draft202012Validator.check_schema(content)
    assert content["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert content["$id"] == address(name) and content["title"]


@each_schema
def test_an_answer_names_its_schema(name: str) -> None:
    if name not in RECORDS:
        stated = [
            each["properties"]["schema"] for each in objects_of(schema(name)) if says_schema(each)
        ]
        assert stated and all(each == {"const": label(name)} for each in stated)


def says_schema(content: dict[str, Any]) -> bool:
    return "schema" in content["properties"]


@each_schema
def test_no_object_has_room_for_a_field_that_is_not_documented(name: str) -> None:
    for content in objects_of(schema(name)):
        assert content.get("additionalProperties") is False
        assert set(content.get("required", ())) <= set(content["properties"])


def objects_of(content: Any) -> Iterator[dict[str, Any]]:
    """All schemas of objects in a schema, at any depth."""
    if isinstance(content, dict):
        if isinstance(content.get("properties"), dict):
            yield content
        content = list(content.values())
    if isinstance(content, list):
        for inner in content:
            yield from objects_of(inner)


@each_schema
def test_a_bundle_needs_nothing_else(name: str) -> None:
    alone = Draft202012Validator(bundled(name))
    together = validator(name)
    for content in ({}, {"schema": label(name)}, {"error": "x", "exit_status": 2}):
        assert alone.is_valid(content) == together.is_valid(content)


def test_all_references_lead_to_a_schema() -> None:
    resolver = registry().resolver()
    for name in schema_names():
        for reference in references_of(schema(name)):
            if not reference.startswith("#"):
                resolver.lookup(reference)


def references_of(content: Any) -> Iterator[str]:
    if isinstance(content, dict):
        yield from (content[key] for key in ("$ref",) if isinstance(content.get(key), str))
        content = list(content.values())
    if isinstance(content, list):
        for inner in content:
            yield from references_of(inner)


def test_an_unknown_schema_is_named_with_what_is_near() -> None:
    with pytest.raises(DesignError, match="did you mean evaluate"):
        schema("evalute")


def test_a_leak_has_the_fields_of_its_record() -> None:
    """Most answers have none, so that the list is empty."""
    leaks = schema("check")["$defs"]["leak_test"]["properties"]["leaks"]["items"]
    found = asdict(Leak(ratio=1.2, width=0.4, place=(1.0, 2.0, 3.0)))
    assert set(leaks["required"]) == set(leaks["properties"]) == set(found)
    Draft202012Validator(leaks).validate(json.loads(json.dumps(found)))
