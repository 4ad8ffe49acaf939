"""Mount and fingertip as parts of a design: what they may be, and what is said else."""

from __future__ import annotations

import pytest

from bellows_design.design import Design, load_design, with_overrides
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.features.mount import Mount
from bellows_design.errors import DesignError

FINGER = load_design("finger")
FLANGE = ("mount.kind=flange",)
FOOT = ("mount.kind=foot",)
PAD = ("fingertip.length=12", "fingertip.width=16", "fingertip.thickness=3")


def test_features_at_their_defaults_leave_the_digest_and_others_change_it() -> None:
    plain, named = FINGER, with_overrides(FINGER, ["mount=none", "fingertip=none"])
    assert named.digest == plain.digest
    changes = [FLANGE, FOOT, (*FOOT, "mount.holes=4"), PAD, (*PAD, "fingertip.ribs=4")]
    digests = {with_overrides(FINGER, change).digest for change in changes}
    assert len(digests | {plain.digest}) == len(changes) + 1


def test_a_design_with_both_is_written_and_read_again() -> None:
    design = with_overrides(FINGER, [*FLANGE, *PAD, "mount.thickness=4", "fingertip.ribs=5"])
    again = Design.from_toml(design.to_toml())
    assert again == design and again.digest == design.digest
    assert again.mount is not None and again.mount.thickness == 4


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (("mount.thickness=4",), "mount.kind is missing"),
        (("mount.kind=hook",), "mount.kind is “hook” but must be 'foot' or 'flange'."),
        ((*FOOT, "mount.holes=3"), "mount.holes is 3 but must be 2 or 4."),
        ((*FOOT, "mount.edge_distance=0.5"), "mount.edge_distance is 0.5 mm but must be at least"),
        ((*FOOT, "mount.hole_diameter=0.34"), "0.34 cm would be 3.4 mm"),
        (
            (*FOOT, "mount.fillet=5"),
            "mount.fillet = 5 mm exceeds 4.7 mm, the distance from the plate's edge to the middle "
            "of a hole.",
        ),
        ((*FOOT, "mount.fillet=0.01"), "mount.fillet = 0.01 mm is no radius a printer resolves"),
        (
            (*FOOT, "mount.thickness=7.5"),
            "mount.thickness = 7.5 mm exceeds 7.2 mm, the height of the port's boss.",
        ),
        (
            (*FLANGE, "mount.thickness=8.5"),
            "mount.thickness = 8.5 mm exceeds 8 mm, port.depth: the mouth of the socket.",
        ),
        (
            (*FLANGE, "bubble_distance=4", "offset=1.6", "length=70"),
            "offset = 1.6 mm and length = 70 mm leave 1.6 mm between a mount of the kind 'flange' "
            "and the first bubble; at least bubble_distance = 4 mm are needed.",
        ),
        (("fingertip.length=12",), "fingertip.width is missing: width, along y, in mm."),
        ((*PAD, "fingertip.width=21"), "fingertip.width = 21 mm exceeds bubble_width = 20 mm."),
        (
            (*PAD, "fingertip.thickness=20.5"),
            "fingertip.thickness = 20.5 mm exceeds bubble_height = 20 mm.",
        ),
        ((*PAD, "fingertip.ribs=1"), "fingertip.ribs = 1 leaves no groove"),
        (
            (*PAD, "fingertip.ribs=9"),
            "fingertip.ribs = 9 of fingertip.rib_width = 1.2 mm leave grooves of 0.15 mm in "
            "fingertip.length = 12 mm; at least 0.4 mm are needed.",
        ),
        (
            (*PAD, "fingertip.ribs=3", "fingertip.rib_height=2.7"),
            "fingertip.rib_height = 2.7 mm leaves 0.3 mm of fingertip.thickness = 3 mm",
        ),
        (
            ("length=49.2", *PAD),
            "length = 49.2 mm leaves 0.6 mm between the last bubble and the fingertip; at least "
            "bubble_distance = 1.2 mm are needed",
        ),
    ],
)
def test_what_cannot_be_is_refused_with_value_bound_and_unit(
    changes: tuple[str, ...], sentence: str
) -> None:
    with pytest.raises(DesignError) as refusal:
        with_overrides(FINGER, changes)
    assert sentence in str(refusal.value)


def test_a_fingertip_within_the_tendons_section_may_follow_the_last_bubble_at_once() -> None:
    slim = ("fingertip.length=12", "fingertip.width=6", "fingertip.thickness=6")
    assert with_overrides(FINGER, ["length=48.6", *slim]).fingertip is not None


def test_ribs_and_grooves_fill_the_length_of_the_fingertip() -> None:
    pad = Fingertip(length=12, width=16, thickness=3, ribs=5, rib_width=1.2)
    assert pad.groove_width == pytest.approx((12 - 5 * 1.2) / 4)
    assert pad.grooves[0] == pytest.approx(1.2)
    assert pad.grooves[-1] + pad.groove_width + 1.2 == pytest.approx(12)
    assert Fingertip(length=12, width=16, thickness=3).grooves == ()


@pytest.mark.parametrize("kind", ["foot", "flange"])
@pytest.mark.parametrize("holes", [2, 4])
def test_holes_keep_their_distance_from_edges_boss_and_each_other(kind: str, holes: int) -> None:
    mount = Mount.model_validate({"kind": kind, "holes": holes, "edge_distance": 2.5})
    bellows, port = FINGER.bellows, FINGER.port
    border = 2.5 + 3.4 / 2
    places = mount.hole_places(bellows, port)
    assert len(set(places)) == holes
    length, height = mount.length(port), mount.height(port)
    for x, y, z in places:
        assert abs(y) >= port.radius + border - 1e-9
        assert abs(y) <= mount.width(bellows, port) / 2 - border + 1e-9
        along, extent = (-x, length) if kind == "foot" else (z, height)
        assert border - 1e-9 <= along <= extent - border + 1e-9
    row = sorted(x + z for x, y, z in places if y > 0)
    assert len(row) == holes // 2 and (holes == 2 or row[1] - row[0] >= 3.4 + 2.5 - 1e-9)


def test_screws_of_a_flange_pass_beside_the_bubbles() -> None:
    mount = Mount(kind="flange")
    for _, y, _ in mount.hole_places(FINGER.bellows, FINGER.port):
        assert abs(y) - mount.hole_diameter >= FINGER.bellows.bubble_width / 2 - 1e-9
