"""Digests: stored results are found by them, so they must stay what they are."""

from __future__ import annotations

import json
from importlib.resources import files

import pytest

from bellows_design.design import Design, Load, load_design, shipped_designs
from bellows_design.study.paper import TABLE_4, Result

STORED = {
    "finger": "6864549071c8487e9e9c49e73281cd5110b83ee786cc2bca34862ef3142719e3",
    "prototype_1": "f02f6b6d90ce154632afab17c0173d7861cc616bdc4d035add24b950a49aa231",
    "prototype_2": "9d2b0c32f5709682047afd5bbe2e908575b05555c328c0bfe746eda03c35f35a",
    "prototype_2_indent": "2417871276d967ed0056df20b31c25b5ba16aa2b96429d7344164c3808ffda9a",
}
REFERENCES = json.loads((files("bellows_design.benchmark") / "reference.json").read_text("utf-8"))


def test_every_shipped_design_has_a_stored_digest() -> None:
    assert set(STORED) == set(shipped_designs())


@pytest.mark.parametrize("name", STORED)
def test_the_digests_of_the_shipped_designs_stay(name: str) -> None:
    assert load_design(name).digest == STORED[name]


@pytest.mark.parametrize("result", TABLE_4, ids=lambda result: result.label)
def test_the_stored_references_are_found_by_their_designs(result: Result) -> None:
    assert result.build().digest == REFERENCES["designs"][result.label]["digest"]


class LaterLoad(Load):
    """A load with a field that is not of the first version."""

    torque: float = 0.0


class LaterDesign(Design):
    """A design with fields, and a table, that are not of the first version."""

    load: LaterLoad = LaterLoad()
    rows: int = 1
    sensor: Load | None = None


def test_a_field_of_a_later_version_counts_once_it_differs_from_its_default() -> None:
    table = load_design("prototype_1").model_dump()
    later = LaterDesign.of(table)
    assert later.digest == STORED["prototype_1"]
    changed = [
        LaterDesign.of(table | change)
        for change in (
            {"rows": 2},
            {"load": {"torque": 1.0}},
            {"sensor": {}},
            {"sensor": {"pressure": 0.2}},
        )
    ]
    assert len({later.digest, *(each.digest for each in changed)}) == 5


def test_only_scenes_that_must_hold_count() -> None:
    table = load_design("prototype_1").model_dump()
    scenes = {name: {"kind": "payload", "mass_g": 5.0} for name in ("a", "b")}
    unused = Design.of(table | {"scenes": scenes})
    assert unused.digest == STORED["prototype_1"]
    limits = {"limits": {"scenes": ["a"]}}
    required = Design.of(table | {"scenes": scenes} | limits)
    assert required.digest != unused.digest
    assert Design.of(table | {"scenes": {"a": scenes["a"]}} | limits).digest == required.digest
    heavier = {"a": {"kind": "payload", "mass_g": 6.0}}
    assert Design.of(table | {"scenes": heavier} | limits).digest != required.digest
