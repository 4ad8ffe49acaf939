"""Mount and fingertip as solids: volumes of closed forms, faces, and holes apart from the air."""

from __future__ import annotations

from functools import cache

import cadquery as cq
import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from bellows_design.design import Design, load_design, with_overrides
from bellows_design.errors import DesignError
from bellows_design.geometry.actuator import full_body, half_body, printed_part
from bellows_design.geometry.ends import root_length, tip_length, tip_stub
from bellows_design.geometry.fingertip import fingertip_pad
from bellows_design.geometry.mount import mount_plate
from bellows_design.geometry.named_solids import NamedSolid
from bellows_design.geometry.tessellation import tessellate

ONE_BUBBLE = with_overrides(load_design("finger"), ["number_of_bubbles=1", "length=12"])
SHORT = with_overrides(ONE_BUBBLE, ["inner_fillet=0", "outer_fillet=0", "indent=none"])
PAD = ("fingertip.length=10", "fingertip.width=14", "fingertip.thickness=3", "fingertip.ribs=4")
BOX = 1e-6
"""mm. The CAD kernel's boxes are larger by a tenth of that on every side."""

MOUNTS = {
    "foot": ("mount.kind=foot",),
    "foot of four": ("mount.kind=foot", "mount.holes=4", "mount.fillet=0"),
    "foot as high as the boss": ("mount.kind=foot", "mount.thickness=7.2"),
    "foot above the socket's axis": ("mount.kind=foot", "mount.thickness=5"),
    "foot no longer than the boss": ("mount.kind=foot", "port.depth=12", "mount.holes=2"),
    "flange": ("mount.kind=flange",),
    "flange of four": ("mount.kind=flange", "mount.holes=4", "mount.fillet=4.7"),
    "flange as thick as the boss is long": ("mount.kind=flange", "mount.thickness=8"),
}


def part(design: Design) -> NamedSolid:
    return printed_part(design.bellows, design.indent, design.port, design.mount, design.fingertip)


@cache
def with_mount(name: str) -> tuple[Design, NamedSolid]:
    design = with_overrides(SHORT, MOUNTS[name])
    return design, part(design)


@cache
def without_mount(port_depth: float) -> NamedSolid:
    return part(with_overrides(SHORT, [f"port.depth={port_depth}"]))


@cache
def with_pad() -> tuple[Design, NamedSolid]:
    design = with_overrides(SHORT, PAD)
    return design, part(design)


@pytest.mark.parametrize("name", MOUNTS)
def test_a_mount_adds_its_plate_less_holes_corners_and_boss(name: str) -> None:
    design, whole = with_mount(name)
    assert design.mount is not None
    bare = without_mount(design.port.depth).solid.Volume()
    expected = design.mount.volume(design.bellows, design.port)
    assert whole.solid.Volume() - bare == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("name", MOUNTS)
def test_a_mount_stands_on_the_bed_before_the_finger(name: str) -> None:
    design, whole = with_mount(name)
    mount, box = design.mount, whole.solid.BoundingBox()
    assert mount is not None
    half, length = mount.width(design.bellows, design.port) / 2, mount.length(design.port)
    assert (box.zmin, box.ymin) == pytest.approx((0, -half), abs=BOX)
    assert box.xmin == pytest.approx(-max(design.port.depth, length), abs=BOX)
    plate = mount_plate(mount, design.bellows, design.port).solid.BoundingBox()
    assert plate.xmax == pytest.approx(0, abs=BOX)
    assert plate.zmax == pytest.approx(mount.height(design.port), abs=BOX)


@pytest.mark.parametrize("name", MOUNTS)
def test_a_mount_changes_neither_cavity_nor_socket(name: str) -> None:
    design, whole = with_mount(name)
    bare = without_mount(design.port.depth)
    for face in ("cavity", "port"):
        assert whole.area(face) == pytest.approx(bare.area(face), rel=1e-6)
    assert whole.area("mount") > 0


@pytest.mark.parametrize("name", MOUNTS)
def test_each_screw_passes_its_hole_and_meets_nothing_but_its_wall(name: str) -> None:
    design, whole = with_mount(name)
    mount = design.mount
    assert mount is not None
    along = cq.Vector(0, 0, 1) if mount.kind == "foot" else cq.Vector(-1, 0, 0)
    for place in mount.hole_places(design.bellows, design.port):
        for radius, inside in ((0.999, False), (1.02, True)):
            start = cq.Vector(*place) - along * 2
            screw = cq.Solid.makeCylinder(
                radius * mount.hole_diameter / 2, mount.thickness + 4, start, along
            )
            assert (screw.intersect(whole.solid).Volume() > 1e-6) is inside


@pytest.mark.parametrize("name", ["foot of four", "flange"])
def test_a_part_with_a_mount_is_watertight(name: str) -> None:
    _, whole = with_mount(name)
    assert tessellate(whole.solid).vertices[:, 2].min() == pytest.approx(0, abs=1e-9)


def edges_of_plates() -> st.SearchStrategy[dict[str, float | int | str]]:
    return st.fixed_dictionaries(
        {
            "kind": st.sampled_from(["foot", "flange"]),
            "holes": st.sampled_from([2, 4]),
            "thickness": st.floats(1, 8),
            "hole_diameter": st.floats(2, 6),
            "edge_distance": st.floats(1.2, 6),
            "fillet": st.sampled_from([0.0, 0.5, 2.2]),
        }
    )


@settings(
    max_examples=6,
    deadline=None,
    derandomize=True,
    database=None,
    phases=[Phase.generate],  # shrinking builds hundreds of solids
    suppress_health_check=list(HealthCheck),
)
@given(
    mount=edges_of_plates(),
    tube=st.floats(2.5, 6),
    depth=st.floats(3, 12),
    wall=st.floats(0.8, 3),
    width=st.floats(8, 30),
)
def test_no_hole_of_an_admissible_mount_comes_nearer_to_the_air_than_its_edge_distance(
    mount: dict[str, object], tube: float, depth: float, wall: float, width: float
) -> None:
    """The air is that in the socket; its boss adds its own wall."""
    table = SHORT.model_dump() | {"mount": mount}
    table["port"] = {"tube_diameter": tube, "depth": depth, "wall": wall}
    table["bellows"] |= {"bubble_width": width}
    try:
        design = Design.of(table)
    except DesignError:
        assume(False)
    assert design.mount is not None
    whole = part(design)
    assert whole.solid.isValid()
    air = cq.Compound.makeCompound([*whole.faces("port"), *whole.faces("cavity")])
    radius = design.mount.hole_diameter / 2
    flat = design.mount.kind == "foot"
    for x, y, z in design.mount.hole_places(design.bellows, design.port):
        end = (x, y, design.mount.thickness) if flat else (-design.mount.thickness, y, z)
        middle = cq.Edge.makeLine(cq.Vector(x, y, z), cq.Vector(*end))
        assert middle.distance(air) >= radius + design.mount.edge_distance - 1e-6


def test_a_fingertip_adds_its_box_less_its_grooves() -> None:
    design, whole = with_pad()
    assert design.fingertip is not None
    bare = without_mount(8).solid.Volume()
    grooves = 3 * design.fingertip.groove_width * 0.8
    assert design.fingertip.volume == pytest.approx(14 * (10 * 3 - grooves))
    assert whole.solid.Volume() - bare == pytest.approx(design.fingertip.volume, rel=1e-6)


def test_the_centre_of_a_fingertip_is_that_of_its_solid() -> None:
    design, _ = with_pad()
    assert design.fingertip is not None
    centre = fingertip_pad(design.fingertip, design.bellows).solid.Center()
    x, z = design.fingertip.centroid
    assert (centre.x, centre.y, centre.z) == pytest.approx((12 + x, 0, z), abs=1e-9)


def test_the_tip_is_the_end_of_the_fingertip_and_nothing_else() -> None:
    design, whole = with_pad()
    half = half_body(design.bellows, design.indent, design.fingertip)
    full = full_body(design.bellows, design.indent, design.fingertip)
    for body, width in ((whole, 14), (full, 14), (half, 7)):
        (tip,) = body.faces("tip")
        assert tip.Area() == pytest.approx(width * 3)
        assert tip.Center().x == pytest.approx(design.finger_length) == 22
        assert tip.normalAt().toTuple() == pytest.approx((1, 0, 0))


def test_half_and_full_bodies_hold_the_whole_fingertip() -> None:
    design, _ = with_pad()
    assert design.fingertip is not None
    half = half_body(design.bellows, design.indent, design.fingertip).solid.Volume()
    full = full_body(design.bellows, design.indent, design.fingertip).solid.Volume()
    bare = full_body(design.bellows, design.indent).solid.Volume()
    assert 2 * half == pytest.approx(full, rel=1e-6)
    assert full - bare == pytest.approx(design.fingertip.volume, rel=1e-6)


def test_only_ribs_of_a_fingertip_lie_on_the_bed() -> None:
    """So the part needs no support: the roofs of grooves are bridges of a groove's width."""
    design, whole = with_pad()
    assert design.fingertip is not None
    flat = [
        face for face in whole.solid.Faces() if face.Center().x > 12 and face.normalAt().z < -0.99
    ]
    heights = sorted({round(face.Center().z, 6) for face in flat})
    assert heights == [0, 0.8]
    roofs = [face.Area() for face in flat if face.Center().z > 0.4]
    assert roofs == pytest.approx([14 * design.fingertip.groove_width] * 3)


def test_the_stub_at_the_tip_is_what_lies_beyond_the_last_gap() -> None:
    design, whole = with_pad()
    gap = design.bellows.bubble_middles[-1] + design.bellows.pitch / 2
    stub = tip_stub(design)
    assert stub.length == tip_length(design) == pytest.approx(22 - gap)
    beyond = cq.Solid.makeBox(100, 100, 100, cq.Vector(gap, -50, -50)).intersect(whole.solid)
    assert stub.volume == pytest.approx(beyond.Volume(), rel=1e-6)
    centre = beyond.Center()
    assert stub.centroid == pytest.approx((centre.x - gap, centre.z), abs=1e-6)
    assert (stub.height, stub.lower_edge) == (3, (stub.length, 0.0))
    assert tip_stub(SHORT).height == SHORT.bellows.tendon_height


def test_root_pieces_and_tip_make_up_the_finger() -> None:
    design = with_overrides(load_design("finger"), PAD)
    pieces = design.bellows.bubble_count * design.bellows.pitch
    total = root_length(design) + pieces + tip_length(design)
    assert total == pytest.approx(design.finger_length) == 60


def test_a_tip_that_ends_with_its_last_bubble_has_no_stub() -> None:
    flush = with_overrides(SHORT, ["offset=6", "length=10.4"])
    stub = tip_stub(flush)
    assert stub.length == pytest.approx(-flush.bellows.bubble_distance / 2)
    assert (stub.volume, stub.centroid) == (0.0, (0.0, 0.0))


def test_a_part_with_both_is_watertight_and_symmetric() -> None:
    design = with_overrides(ONE_BUBBLE, [*PAD, *MOUNTS["flange of four"]])
    mesh = tessellate(part(design).solid)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    assert np.allclose([low[1], low[2], high[0]], [-high[1], 0, 22])
