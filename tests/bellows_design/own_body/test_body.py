"""Own bodies as values: names of faces, bounds, digests, and sentences on mistakes."""

from __future__ import annotations

import re
from typing import Any

import cadquery as cq
import pytest
from own_body.bodies import INSIDE, RUBBER, bar, box, part

from bellows_design import BodyPart, DesignError, OwnBody
from bellows_design.own_body.selection import Selection, face_names


def names(solid: cq.Solid, **surfaces: Any) -> dict[tuple[float, ...], str]:
    """Centre of each face -> its name."""
    made = BodyPart(**part(solid))
    given = {name: (Selection(**each),) for name, each in surfaces.items()}
    (found,) = face_names((made,), given)
    centres = (tuple(round(x, 6) for x in face.Center().toTuple()) for face in solid.Faces())
    return dict(zip(centres, found, strict=True))


def test_selectors_boxes_and_parts_choose_faces() -> None:
    found = names(box(4, 2, 2), left={"select": "<X"}, top={"box": ((0, 0, 2), (4, 2, 2))})
    assert found[0, 1, 1] == "left" and found[2, 1, 2] == "top"
    assert found[4, 1, 1] == "outside" and found[2, 1, 0] == "outside"


def test_the_faces_of_a_closed_hole_are_inner_ones() -> None:
    hollow = box(4, 4, 4).cut(box(2, 2, 2, at=(1, 1, 1))).Solids()[0]
    found = names(hollow, cavity={"inner": True})
    assert sorted(found.values()) == 6 * ["cavity"] + 6 * ["outside"]
    assert found[2, 2, 3] == "cavity" and found[2, 2, 4] == "outside"


def test_a_selector_chooses_among_the_faces_of_all_parts_or_of_one() -> None:
    parts = [part(box(2, 2, 2), "low"), part(box(2, 2, 2, at=(0, 0, 2)), "high")]
    surfaces = {"bottom": ">Z", "held": {"select": "<Z", "part": "high"}}
    body = OwnBody.of(
        {"name": "two", "parts": parts, "surfaces": surfaces, "supports": {"clamped": "held"},
         "pressurised": "bottom", "load": {"pressure": 0.01}}
    )  # fmt: skip
    low, high = body.face_names
    assert set(low) == {"outside"} and sorted(high) == ["bottom", "held", *4 * ["outside"]]


def test_the_digest_depends_on_shape_and_conditions_and_not_on_names() -> None:
    body, same = bar(), bar(name="other", description="the same")
    assert body.digest == same.digest and body.digest == bar().digest
    assert body.digest != bar(load={"pressure": 0.005}).digest
    assert body.digest != body.at_pressure(0.005).digest
    longer = bar(parts=[part(box(21, 5, 10), density_kg_m3=1070.0)], pressurised=["tip"],
                 surfaces={"root": "<X", "tip": ">X", "middle": "<Y"})  # fmt: skip
    shorter = bar(parts=[part(box(20, 5, 10), density_kg_m3=1070.0)], pressurised=["tip"],
                  surfaces={"root": "<X", "tip": ">X", "middle": "<Y"})  # fmt: skip
    assert longer.table == shorter.table and longer.digest != shorter.digest


NAMED = {"root": "<X", "middle": "<Y", "cavity": INSIDE}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"surfaces": {"root": "<X", "cavity": "<Q"}}, "no selector of CadQuery's"),
        ({"surfaces": {**NAMED, "side": "<X"}}, "both choose the face at (0, 2.5, 5) mm"),
        ({"surfaces": {**NAMED, "tip": "<X[9]"}}, "surfaces.tip: “<X[9]” chooses no face"),
        ({"surfaces": {**NAMED, "hole": {"inner": True}}}, "no face"),
        ({"surfaces": {**NAMED, "a": {"select": "<X", "part": "bod"}}}, "did you mean body?"),
        ({"supports": {"clamped": ["rot"]}}, "unknown surface “rot”; did you mean root?"),
        ({"supports": {"symmetry": {"middle": "w"}}}, "must be 'x', 'y' or 'z'"),
        ({"load": {"pressure": 4.0}}, "load.pressure is 4 MPa but must be at most 2 MPa"),
        ({"load": {"pressure": 0.1, "largest_volume": 2.0}}, "exclude each other"),
        ({"load": {}}, "nothing acts on the body"),
        ({"films": [{"surface": "body|lid", "young_modulus": 1, "thickness": 1}]}, "body|lid"),
        ({"gravity": {"direction": [0, 0, 0]}}, "must not be of length zero"),
        ({"gravity": {}, "parts": [part(box(20, 5, 10))]}, "density_kg_m3 of every part"),
        ({"parts": [part(cq.Workplane().box(1, 1, 1).faces(">X"))]}, "must be one solid, not 0"),
        ({"parts": [part(box(1, 1, 1), material="ecoflex")]}, "did you mean ecoflex_00_"),
        ({"parts": [part(box(1, 1, 1)), part(box(1, 1, 1))]}, "two parts have the same name"),
        ({"presurised": ["cavity"]}, "did you mean pressurised?"),
        ({"name": "con"}, "not be a device of Windows"),
    ],
)
def test_a_mistake_gets_a_sentence(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises(DesignError) as error:
        bar(**change)
    assert sentence in str(error.value) and "\n" not in error.value.sentences[0]


def test_a_pressure_cannot_be_asked_for_where_the_volume_is_given() -> None:
    with pytest.raises(DesignError, match="the pressure is a result"):
        bar(load={"largest_volume": 2.0}).at_pressure(0.01)


def test_a_body_is_frozen_and_has_a_hash() -> None:
    body = bar()
    assert hash(body) == hash(bar()) and len({body, bar()}) == 1
    with pytest.raises(ValueError, match="frozen"):
        body.name = "other"  # type: ignore[misc]
    assert RUBBER["name"] == body.parts[0].material.name


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"supports": {"symmetry": {"tip": "y"}}}, "“tip” must lie in one plane normal to y"),
        (
            {"surfaces": {**NAMED, "middle": "|Y and (not <Y[1])"}},
            "“middle” must lie in one plane normal to y",
        ),
        ({"surfaces": {**NAMED, "cavity": 5}}, "a surface is 5 but must be a selector, a table"),
        (
            {"surfaces": {**NAMED, "cavity": {"inter": True}}},
            "did you mean surfaces.cavity.0.inner",
        ),
        ({"surfaces": {**NAMED, "cavity": ">Q"}}, "“>Q” is no selector of CadQuery's, such as >X"),
    ],
)
def test_what_no_half_body_and_no_surface_can_be_is_said(
    changed: dict[str, Any], sentence: str
) -> None:
    with pytest.raises(DesignError, match=re.escape(sentence)):
        bar(**changed)
