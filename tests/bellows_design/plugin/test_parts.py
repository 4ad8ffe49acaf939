"""The CadQuery plugin and the design script."""

from __future__ import annotations

import runpy
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import cadquery as cq
import pytest
from cadquery import cqgi

from bellows_design import plugin
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.port import Port
from bellows_design.design.shipped import load_design
from bellows_design.geometry.actuator import printed_part

SCRIPT = Path(__file__).parents[3] / "examples/design_script.py"
BELLOWS = BellowsParameters.model_validate(
    {**load_design("prototype_1").bellows.model_dump(), "length": 18, "number_of_bubbles": 1}
)
DESIGN = Design(
    name="short", bellows=BELLOWS, indent=Indent(depth=0.4, width=2.4), port=Port(depth=5)
)


@cache
def own_solid() -> cq.Solid:
    return printed_part(DESIGN.bellows, DESIGN.indent, DESIGN.port).solid


def bounds(solid: cq.Shape) -> tuple[float, ...]:
    box = solid.BoundingBox()
    return box.xmin, box.xmax, box.ymin, box.ymax, box.zmin, box.zmax


@pytest.fixture
def unregistered() -> Iterator[None]:
    yield
    if hasattr(cq.Workplane, plugin.METHOD):
        delattr(cq.Workplane, plugin.METHOD)


def test_a_workplane_gets_exactly_the_printed_part() -> None:
    part = cq.Workplane().invoke(plugin.bellows(DESIGN))
    (solid,) = part.vals()
    assert isinstance(solid, cq.Solid)
    assert solid.Volume() == pytest.approx(own_solid().Volume(), rel=1e-12)
    assert len(solid.Faces()) == len(own_solid().Faces())
    assert bounds(solid) == pytest.approx(bounds(own_solid()), abs=1e-6)
    assert part.faces(">X").val().Center().x == pytest.approx(18)


def test_every_point_of_the_stack_gets_a_part_turned_as_its_workplane() -> None:
    fingers = cq.Workplane("XZ", origin=(0, 7, 0)).pushPoints([(0, 0), (30, 0)])
    first, second = fingers.invoke(plugin.bellows(DESIGN)).vals()
    # On the plane XZ the local y is the global z, and the local z points to -y.
    x0, x1, y0, y1, z0, z1 = bounds(own_solid())
    assert bounds(first) == pytest.approx((x0, x1, 7 - z1, 7 - z0, y0, y1), abs=1e-6)
    assert bounds(second) == pytest.approx((x0 + 30, x1 + 30, 7 - z1, 7 - z0, y0, y1), abs=1e-6)


def test_importing_the_plugin_leaves_cadquery_as_it_was() -> None:
    assert not hasattr(cq.Workplane, plugin.METHOD)


@pytest.mark.usefixtures("unregistered")
def test_registering_adds_a_method_and_may_be_repeated() -> None:
    plugin.register()
    plugin.register()
    part = cq.Workplane().bellows(DESIGN)
    assert part.val().Volume() == pytest.approx(own_solid().Volume(), rel=1e-12)


@pytest.mark.usefixtures("unregistered")
def test_registering_never_overrides_an_existing_name() -> None:
    def others(self: cq.Workplane) -> cq.Workplane:
        return self

    setattr(cq.Workplane, plugin.METHOD, others)  # the fixture takes it away
    with pytest.raises(ValueError, match=r"cadquery\.Workplane\.bellows is there already"):
        plugin.register()
    assert cq.Workplane.bellows is others


def test_cadquery_hosts_find_every_number_of_the_script_and_show_the_part() -> None:
    """What CQ-editor and cq-cli do: they run the script through CadQuery's gateway."""
    model = cqgi.parse(SCRIPT.read_text("utf-8"))
    parameters = model.metadata.parameters
    assert set(BellowsParameters.model_fields) - {"number_of_bubbles"} <= set(parameters)
    result = model.build({"length": 18.0, "bubble_width": 16, "indent_depth": 0.0})
    assert result.success, result.exception
    (shown,) = result.results
    solid = shown.shape.val()
    assert solid.isValid()
    assert bounds(solid)[1:4] == pytest.approx((18, -8, 8), abs=1e-6)


def test_numbers_that_make_no_bellows_reach_the_host_as_one_sentence() -> None:
    result = cqgi.parse(SCRIPT.read_text("utf-8")).build({"tendon_width": 30})
    assert not result.success
    assert "tendon_width = 30 mm must not exceed bubble_width = 20 mm" in str(result.exception)


@pytest.mark.thorough
def test_on_its_own_the_script_writes_the_checked_mesh(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import trimesh

    target = tmp_path / "part.stl"
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), str(target)])
    part = runpy.run_path(str(SCRIPT), run_name="__main__")["part"]
    mesh = trimesh.load(target)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(part.val().Volume(), rel=0.005)


@pytest.mark.thorough
def test_without_a_file_the_script_says_how_it_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(SCRIPT)])
    with pytest.raises(SystemExit, match="usage: "):
        runpy.run_path(str(SCRIPT), run_name="__main__")
