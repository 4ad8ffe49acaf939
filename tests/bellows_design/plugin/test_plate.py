"""Several actuators on one bed: apart, named, coloured, in every format."""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree
from zipfile import ZipFile

import cadquery as cq
import numpy as np
import pytest
import trimesh

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.plugin import plate
from bellows_design.plugin.plate import COLOURS, Piece, pieces
from bellows_design.plugin.plate_files import write_plate

Bellows = Callable[..., tuple[int, str, str]]
SHORT = ["length=18", "offset=3", "number_of_bubbles=1"]
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
BED = (100.0, 60.0, 80.0)


def short(name: str, *settings: str) -> Design:
    return with_overrides(load_design("prototype_1"), [*SHORT, f"name={name}", *settings])


LEFT, RIGHT = short("left"), short("right", "bubble_height=16")


@pytest.fixture(scope="module")
def placed() -> list[Piece]:
    return pieces([LEFT, LEFT, RIGHT, LEFT], 4.0, BED)


def test_parts_lie_apart_and_on_the_bed(placed: list[Piece]) -> None:
    bounds = [np.array(piece.bounds) for piece in placed]
    for low, high in bounds:
        assert (low[:2] >= 4.0 - 1e-6).all() and (high[:2] <= np.array(BED[:2]) - 4.0 + 1e-6).all()
        assert low[2] == pytest.approx(0.0, abs=1e-6)
    for (low, high), (other_low, other_high) in combinations(bounds, 2):
        gap = np.maximum(other_low - high, low - other_high)[:2].max()
        assert gap >= 4.0 - 1e-6
    near, far = np.array(bounds)[:, 0].min(axis=0), np.array(bounds)[:, 1].max(axis=0)
    assert (near + far)[:2] == pytest.approx(np.array(BED[:2]), abs=1e-5)  # in the middle


def test_the_solids_do_not_meet(placed: list[Piece]) -> None:
    solids = [piece.solid.moved(piece.location) for piece in placed]
    assert min(one.distance(other) for one, other in combinations(solids, 2)) >= 3.99


def test_copies_are_numbered_and_designs_coloured(placed: list[Piece]) -> None:
    assert [piece.name for piece in placed] == ["left", "left_2", "right", "left_3"]
    assert [piece.colour for piece in placed] == [*COLOURS[:1] * 2, COLOURS[1], COLOURS[0]]
    assembly = plate([LEFT, RIGHT], bed=BED)
    assert [child.name for child in assembly.children] == ["left", "right"]
    assert isinstance(assembly, cq.Assembly) and assembly.children[0].color is not None


def test_what_fits_only_across_is_turned() -> None:
    along = pieces([LEFT], 2.0, (60.0, 30.0))[0].bounds
    across = pieces([LEFT], 2.0, (28.0, 60.0))[0].bounds
    assert along[1][0] - along[0][0] == pytest.approx(across[1][1] - across[0][1])
    assert across[0][0] >= 2.0 - 1e-6 and across[1][1] <= 58.0 + 1e-6


def test_without_a_bed_it_is_that_of_the_first_designs_printer() -> None:
    low, high = map(np.array, pieces(LEFT)[0].bounds)
    bed = LEFT.profile().build_volume
    assert ((low + high) / 2)[:2] == pytest.approx(np.array(bed[:2]) / 2, abs=1e-5)


@pytest.mark.parametrize(
    ("designs", "options", "sentence"),
    [
        ([LEFT] * 9, {"bed": BED}, r"9 actuators with 5 mm around each need \d+ x \d+ mm in rows"),
        ([LEFT], {"bed": (100.0, 60.0, 15.0)}, r"a part is 20.0 mm high; the printer builds 15 mm"),
        ([], {}, "at least one design"),
        ({"prototype_1": 0}, {}, "copies must be at least 1, got 0"),
        ([LEFT], {"spacing": -1.0}, "spacing = -1 mm"),
        ([LEFT], {"bed": (0.0, 5.0)}, "two or three positive lengths"),
        ([3], {}, "a design must be a Design"),
        (["no_such"], {}, "no_such"),
    ],
)
def test_what_cannot_be_is_one_sentence(designs: object, options: dict, sentence: str) -> None:
    with pytest.raises(DesignError, match=sentence):
        plate(designs, **options)


def test_step_keeps_names_colours_and_places(placed: list[Piece], tmp_path: Path) -> None:
    write_plate(placed, tmp_path / "plate.step")
    read = cq.Assembly.importStep(str(tmp_path / "plate.step"))
    text = (tmp_path / "plate.step").read_text("utf-8")
    for piece in placed:
        assert f"'{piece.name}'" in text
    assert "COLOUR_RGB" in text and "1970-01-01T00:00:00" in text
    boxes = sorted(shape.moved(where).BoundingBox().xmin for shape, _, where, _ in read)
    assert boxes == pytest.approx(sorted(piece.bounds[0][0] for piece in placed), abs=0.05)


def test_stl_is_all_parts_where_they_stand(placed: list[Piece], tmp_path: Path) -> None:
    write_plate(placed, tmp_path / "plate.stl")
    mesh = trimesh.load_mesh(tmp_path / "plate.stl")
    assert mesh.is_watertight and mesh.body_count == len(placed)
    assert mesh.volume == pytest.approx(sum(piece.solid.Volume() for piece in placed), rel=0.005)
    low = np.min([piece.bounds[0] for piece in placed], axis=0)
    assert mesh.bounds[0] == pytest.approx(low, abs=1e-4)


def test_3mf_holds_each_design_once_and_an_item_for_each_copy(
    placed: list[Piece], tmp_path: Path
) -> None:
    write_plate(placed, tmp_path / "plate.3mf")
    with ZipFile(tmp_path / "plate.3mf") as archive:
        text = archive.read("3D/3dmodel.model").decode()
    assert text.count("<object ") == 2 and text.count("<item ") == 4
    assert all(f'partnumber="{piece.name}"' in text for piece in placed)
    root = ElementTree.fromstring(text)
    vertices = {
        found.get("id"): np.array(
            [[float(v.get(k, "")) for k in "xyz"] for v in found.iter(f"{CORE}vertex")]
        )
        for found in root.iter(f"{CORE}object")
    }
    for item, piece in zip(root.iter(f"{CORE}item"), placed, strict=True):
        rows = np.reshape([float(each) for each in item.get("transform", "").split()], (4, 3))
        where = vertices[item.get("objectid")] @ rows[:3] + rows[3]
        assert where.min(axis=0) == pytest.approx(piece.bounds[0], abs=1e-4)
        assert where.max(axis=0) == pytest.approx(piece.bounds[1], abs=1e-4)
    first = (tmp_path / "plate.3mf").read_bytes()
    write_plate(placed, tmp_path / "plate.3mf")
    assert (tmp_path / "plate.3mf").read_bytes() == first


def test_the_command_writes_copies(bellows: Bellows, tmp_path: Path) -> None:
    target = tmp_path / "plate.stl"
    status, out, _ = bellows("plate", "prototype_1:2", "-o", str(target), "--json")
    found = json.loads(out)
    assert status == 0 and [part["name"] for part in found["parts"]] == [
        "prototype_1",
        "prototype_1_2",
    ]
    assert found["file"] == str(target) and target.stat().st_size > 1000
    assert found["bed_mm"] == list(load_design("prototype_1").profile().build_volume)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("prototype_1", "-o", "plate.obj"), "must end in .3mf, .step, .stl"),
        (("prototype_1:0", "-o", "plate.stl"), "copies must be 1 to 200, got 0"),
        (("no_such", "-o", "plate.stl"), "no_such"),
        (("prototype_1", "-o", "no/where/plate.stl"), "there is no folder"),
    ],
)
def test_bad_input_is_one_sentence(
    arguments: tuple[str, ...], sentence: str, bellows: Bellows
) -> None:
    status, out, err = bellows("plate", *arguments)
    assert status == 2 and out == "" and sentence in err.splitlines()[-1]
