"""Scenes as data: what is admitted, what is refused, and what a design becomes with them."""

from __future__ import annotations

import copy
import math
import operator
import pickle
from pathlib import Path
from typing import Any

import pytest

from bellows_design.design import Design, load_design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.payload import Payload
from bellows_design.design.scenes.scene import named_scene, scene_of
from bellows_design.errors import DesignError

GRIP: dict[str, Any] = {
    "kind": "grip", "size": 30.0, "mass_g": 20.0, "distance": 18.0, "place": 40.0,
}  # fmt: skip


def with_scenes(scenes: dict[str, Any], *limits: str) -> Design:
    """Prototype 1 with scenes, of which approval must hold some."""
    table = load_design("prototype_1").model_dump()
    return Design.of(table | {"scenes": scenes, "limits": {"scenes": list(limits)}})


def refusal(table: dict[str, Any]) -> str:
    """The sentence with which a scene is refused."""
    with pytest.raises(DesignError) as caught:
        with_scenes({"mine": table})
    return str(caught.value)


def test_every_kind_of_scene_survives_being_written_and_read() -> None:
    scenes = {
        "hanging": {"kind": "free", "gravity": "forward"},
        "wall": {"kind": "blocked", "support": "wall", "distance": 4.0, "friction": 0.3},
        "lift": {"kind": "payload", "mass_g": 20, "place": 31.5, "gravity": [0.3, -1]},
        "cup": GRIP,
    }
    design = with_scenes(scenes, "cup", "blocked")
    assert Design.from_toml(design.to_toml()) == design
    assert [type(each) for each in design.scenes.values()] == [Free, Blocked, Payload, Grip]
    assert design.limits.scenes == ("cup", "blocked")


@pytest.mark.parametrize("scale", [1.7e308, 1e-310, 5e-324])
def test_directions_of_any_length_are_unit_vectors(scale: float) -> None:
    for x, z in ((1, 1), (0, -1)):
        found = scene_of({"kind": "free", "gravity": [x * scale, z * scale]}, "it").gravity  # type: ignore[union-attr]
        assert found == pytest.approx((x / math.hypot(x, z), z / math.hypot(x, z)), rel=1e-12)


def test_an_integer_beyond_all_numbers_is_no_direction() -> None:
    assert "must be none, down" in refusal({"kind": "free", "gravity": [10**400, 1]})


def test_a_mass_without_gravity_is_refused() -> None:
    for none in ("none", [0.0, 0.0]):
        sentence = refusal({"kind": "payload", "mass_g": 20, "gravity": none})
        assert "mass_g = 20 g has no weight" in sentence


def test_a_design_without_scenes_is_written_and_found_as_before_there_were_any() -> None:
    design = load_design("prototype_1")
    assert "scenes" not in design.to_toml()
    assert "scenes" not in design.model_dump() and "scenes" not in design.model_dump()["limits"]


def test_the_digest_knows_kinds_and_numbers_of_scenes() -> None:
    designs = [
        with_scenes({}),
        with_scenes({"a": {"kind": "free"}}, "a"),
        with_scenes({"a": {"kind": "blocked"}}, "a"),
        with_scenes({"a": {"kind": "blocked", "distance": 1.0}}, "a"),
        with_scenes({"b": {"kind": "blocked", "distance": 1.0}}, "b"),
        with_scenes({}, "blocked"),
    ]
    assert len({design.digest for design in designs}) == len(designs)
    assert with_scenes({"a": {"kind": "blocked", "friction": 0.0}}, "a").digest == designs[2].digest


def test_the_scenes_of_a_design_stay() -> None:
    design = with_scenes({"cup": GRIP})
    for change in (
        lambda: design.scenes.update(a=Free()),
        lambda: design.scenes.pop("cup"),
        lambda: design.scenes.clear(),
        lambda: operator.setitem(design.scenes, "a", Free()),
        lambda: operator.delitem(design.scenes, "cup"),
        lambda: operator.ior(design.scenes, {"a": Free()}),
        lambda: operator.setitem(load_design("finger").scenes, "a", Free()),
    ):
        with pytest.raises(TypeError, match="cannot be changed"):
            change()
    for again in (pickle.loads(pickle.dumps(design)), copy.deepcopy(design)):
        assert again == design and type(again.scenes) is type(design.scenes)


def test_equal_designs_with_scenes_have_equal_hashes() -> None:
    assert hash(with_scenes({"cup": GRIP})) == hash(with_scenes({"cup": GRIP}))


def test_gravity_is_a_unit_vector_whatever_its_length() -> None:
    scene = scene_of({"kind": "payload", "mass_g": 5, "gravity": [3, -4]}, "mine")
    assert scene.gravity == pytest.approx((0.6, -0.8), rel=1e-15)
    assert math.hypot(*scene_of({"kind": "free", "gravity": [0, 0]}, "mine").gravity) == 0
    assert scene_of({"kind": "payload", "mass_g": 5}, "mine").gravity == (0, -1)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"mass_g": -5.0}, "mass_g is -5 g but must be greater than 0 g."),
        ({"size": 40.0}, "reaches 2 mm into the finger at rest"),
        ({"fingers": 4}, "fingers is 4 but must be at most 3."),
        ({"fingers": 3}, "cannot close on a cylinder"),
        ({"height": 3.0}, "height belongs to a box"),
        ({"place": 60.0}, "place = 60 mm lies beyond the finger's length of 50 mm."),
        ({"masse": 3.0}, "unknown key “masse”"),
        ({"kind": "gripp"}, "did you mean grip?"),
        ({"friction": "0.5"}, "friction is “0.5” but must be a number"),
        ({"object": "cone"}, "object is “cone” but must be"),
    ],
)
def test_a_bad_grip_gets_one_sentence(change: dict[str, Any], sentence: str) -> None:
    message = refusal(GRIP | change)
    assert sentence in message and message.count("\n") == 0
    assert message.startswith("scenes.mine")


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ({"kind": "blocked", "friction": 0.2}, "belongs to the support 'wall'"),
        ({"kind": "blocked", "support": "held", "distance": 2.0}, "stays where it is at rest"),
        ({"kind": "free", "gravity": "dwn"}, "did you mean down?"),
        ({"kind": "free", "gravity": [1]}, "a direction [x, z]"),
        ({}, "scenes.mine.kind is missing: one of free, blocked, payload, grip."),
    ],
)
def test_another_bad_scene_gets_one_sentence(table: dict[str, Any], sentence: str) -> None:
    assert sentence in refusal(table)


def test_an_unknown_scene_suggests_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"unknown scene “blockd”; did you mean blocked\?"):
        named_scene("blockd", {})
    with pytest.raises(DesignError, match=r"limits\.scenes names an unknown scene “cap”.*cup"):
        with_scenes({"cup": GRIP}, "cap")


def test_a_scene_is_found_in_the_design_built_in_or_in_a_file(tmp_path: Path) -> None:
    own = with_scenes({"blocked": {"kind": "blocked", "distance": 3.0}}).scenes
    assert named_scene("blocked", {}) == ("blocked", Blocked())
    assert named_scene("blocked", own) == ("blocked", Blocked(distance=3.0))
    file = tmp_path / "table.toml"
    file.write_text('kind = "payload"\nmass_g = 12\n', "utf-8")
    assert named_scene(str(file), own) == ("table", Payload(mass_g=12.0))
