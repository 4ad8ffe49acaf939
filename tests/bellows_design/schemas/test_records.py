"""The records of an export are as their schemas say: of exports that are kept, and of a new one."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from answers import assert_fits, misfits
from fakes import FakeEvaluation

from bellows_design.schemas.library import RECORDS

EXPORTS = sorted((Path(__file__).parents[3] / "exports").glob("*/manifest.json"))
Bellows = Callable[..., tuple[int, str, str]]


@pytest.mark.parametrize("manifest", EXPORTS, ids=lambda path: path.parent.name)
@pytest.mark.parametrize("name", RECORDS)
def test_a_kept_export_is_as_its_schemas_say(manifest: Path, name: str) -> None:
    assert_fits(json.loads(manifest.with_name(name).read_text("utf-8")), name)


def test_a_new_export_is_as_its_schemas_say(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation())
    assert bellows("run", "prototype_2", "--output", str(tmp_path), "--json")[0] == 0
    for name in RECORDS:
        path = tmp_path / "prototype_2" / name
        assert_fits(json.loads(path.read_text("utf-8")), name)


@pytest.mark.parametrize("place", [(), ("check",), ("check", "rules", 0), ("verdict",)])
def test_a_field_that_is_not_documented_is_noticed(place: tuple[Any, ...]) -> None:
    content: Any = json.loads(EXPORTS[0].read_text("utf-8"))
    inner = content
    for step in place:
        inner = inner[step]
    inner["surprise"] = 1
    assert any("surprise" in each for each in misfits(content, "manifest.json"))
