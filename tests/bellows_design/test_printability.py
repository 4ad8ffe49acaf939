"""Verdicts on designs do not hang on the tessellation, and the port's wall is one of the walls."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from bellows_design.design import Design, load_design, with_overrides
from bellows_design.geometry.actuator import printed_part
from bellows_design.geometry.tessellation import tessellate
from bellows_design.printability import printed_model
from printers import PrintabilityReport, check_printability, load_profile

SHORT = ("offset=14", "length=18.4", "number_of_bubbles=1", "indent=none")


@cache
def report(tolerance: float, *changes: str) -> PrintabilityReport:
    design = with_overrides(load_design("finger"), [*SHORT, *changes])
    features = design.mount, design.fingertip
    solid = printed_part(design.bellows, design.indent, design.port, *features).solid
    model = printed_model(design, tessellate(solid, tolerance))
    return check_printability(model, load_profile("prusa_i3"))


@pytest.mark.parametrize(
    ("tolerance", "fillet"),
    [*((0.02, fillet) for fillet in (1.6, 1.75, 1.9, 2.05, 2.2)), (0.01, 1.75), (0.01, 2.05)],
)
@pytest.mark.thorough
def test_no_outer_fillet_makes_the_walls_of_the_finger_taper(
    tolerance: float, fillet: float
) -> None:
    found = report(tolerance, f"outer_fillet={fillet}")
    assert found.verdict == "pass", [rule.message for rule in found.failures]


@pytest.mark.parametrize(
    ("changes", "failing"),
    [
        (("bubble_thickness=2.35",), {"wall_multiple", "wall_multiple_measured"}),
        (("bubble_thickness=2.5",), set()),
        (("bubble_thickness=3",), set()),
        (("port.wall=2", "port.depth=2"), set()),
        (("port.wall=1.2",), set()),
        # Obliquely upwards air crosses lines and layers, and 0.8 mm are too few of both.
        (("port.wall=0.8", "port.depth=2"), {"minimum_lines", "minimum_layers"}),
    ],
)
@pytest.mark.thorough
def test_walls_are_judged_as_declared_and_as_measured(
    changes: tuple[str, ...], failing: set[str]
) -> None:
    assert {rule.rule for rule in report(0.02, *changes).failures} == failing


PAD = ("fingertip.length=8", "fingertip.width=16", "fingertip.thickness=3", "fingertip.ribs=4")
STUB = ("length=20", "number_of_bubbles=1", "offset=5")


@pytest.mark.parametrize(
    "mount",
    [
        ("mount.kind=foot", "mount.holes=4"),
        ("mount.kind=foot", "mount.edge_distance=1.2", "mount.fillet=0"),
        ("mount.kind=flange", "mount.thickness=4"),
        ("mount.kind=flange", "mount.holes=4", "mount.edge_distance=1.2"),
    ],
)
@pytest.mark.thorough
def test_a_finger_with_mount_and_fingertip_keeps_all_rules(mount: tuple[str, ...]) -> None:
    found = report(0.02, *STUB, *PAD, *mount)
    assert found.verdict == "pass", [rule.message for rule in found.failures]
    assert {warning.rule for warning in found.warnings} <= {"overhang"}


@pytest.mark.thorough
def test_the_room_of_the_cross_section_is_that_of_the_finger_and_not_of_its_mount() -> None:
    flange = ("mount.kind=flange", "mount.thickness=4")
    wide = report(0.02, *STUB, *flange)
    (section,) = (rule for rule in wide.rules if rule.rule == "cross_section")
    assert (section.verdict, section.measured) == ("pass", "20.00 × 20.00")
    (volume,) = (rule for rule in wide.rules if rule.rule == "build_volume")
    assert "36.20" in str(volume.measured)
    narrow = report(0.02, *STUB, *flange, "limits.cross_section_width=19")
    assert [rule.rule for rule in narrow.failures] == ["cross_section"]


def test_a_boss_of_another_thickness_than_declared_is_found() -> None:
    """The walls of the finger are 1.2 and 1.6 mm; a boss of 2 mm is declared as either."""
    built = with_overrides(load_design("finger"), [*SHORT, "port.wall=2"])
    solid = printed_part(built.bellows, built.indent, built.port).solid
    mesh = tessellate(solid)
    for wall in (1.2, 1.6):
        (rule,) = port_rules(built, mesh, wall)
        assert (rule.verdict, rule.measured) == ("fail", pytest.approx(2, abs=0.02))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("wall", "depth", "status", "verdict"),
    [("2", "2", 0, "pass"), ("1.2", "8", 0, "pass"), ("0.8", "2", 1, "fail")],
)
def test_the_command_judges_the_boss_by_itself(
    bellows: Callable[..., tuple[int, str, str]], wall: str, depth: str, status: int, verdict: str
) -> None:
    settings = ("--set", f"port.wall={wall}", "--set", f"port.depth={depth}")
    found, output, _ = bellows("check", "finger", *settings, "--json")
    assert found == status
    rules = [rule for rule in json.loads(output)["rules"] if rule["where"] == "port.wall"]
    sealing = {rule["verdict"] for rule in rules if rule["rule"] == "minimum_lines"}
    assert sealing == {verdict}
    (measured,) = (r["measured"] for r in rules if r["rule"] == "wall_as_declared")
    assert measured == pytest.approx(float(wall), abs=0.02)


def test_the_command_takes_no_true_for_a_number_of_a_printer(
    bellows: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    printer = tmp_path / "printer.toml"
    bellows("init", "printer", str(printer))
    text = printer.read_text("utf-8")
    assert "\nperimeters = " in text
    lines = [
        "perimeters = true" if line.startswith("perimeters") else line for line in text.splitlines()
    ]
    printer.write_text("\n".join(lines), "utf-8")
    status, _, errors = bellows("check", "finger", "--printer", str(printer))
    assert status == 2 and "perimeters is true" in errors


def port_rules(built: Design, mesh: object, wall: float) -> list:  # type: ignore[type-arg]
    from dataclasses import replace

    model = printed_model(built, mesh)  # type: ignore[arg-type]
    walls = tuple(
        replace(each, thickness=wall) if each.name == "port.wall" else each for each in model.walls
    )
    found = check_printability(replace(model, walls=walls), load_profile("prusa_i3"))
    return [r for r in found.rules if (r.rule, r.where) == ("wall_as_declared", "port.wall")]


@pytest.mark.parametrize("name", ["finger", "prototype_2", "prototype_2_indent"])
@pytest.mark.thorough
def test_a_shipped_design_raises_no_alarm(name: str) -> None:
    """Prototype 1 has walls of 3.75 lines, which its paper says itself."""
    design = load_design(name)
    solid = printed_part(design.bellows, design.indent, design.port).solid
    found = check_printability(printed_model(design, tessellate(solid)), design.profile())
    assert found.verdict == "pass", [rule.message for rule in found.failures]
    assert {warning.rule for warning in found.warnings} == {"overhang"}
    margins = {r.rule: r.margin for r in found.rules if r.margin is not None and r.margin < 0}
    assert set(margins) <= {"minimum_lines", "thinnest_place", "opening_width"}
