"""Meshes of solids whose fillets are nearly full rounds."""

from __future__ import annotations

from pathlib import Path

import pytest

from bellows_design.design import load_design, with_overrides
from bellows_design.geometry import actuator, tessellation
from bellows_design.geometry.actuator import LOOSEST, printed_part
from bellows_design.geometry.named_solids import GeometryError
from bellows_design.geometry.tessellation import TessellationError, _farthest, tessellate

SHORT = Path(__file__).parents[1] / "data/full_round_short.toml"


@pytest.mark.parametrize("changes", [(), ("inner_fillet=3.77",)])
def test_a_fillet_a_hair_short_of_a_full_round_has_a_mesh(changes: tuple[str, ...]) -> None:
    design = with_overrides(load_design(SHORT), changes)
    part = printed_part(design.bellows, design.indent, design.port)
    assert part.looseness <= LOOSEST
    mesh = tessellate(part.solid)
    assert mesh.volume == pytest.approx(part.solid.Volume(), rel=2e-3)


def test_where_the_kernel_only_bounds_the_deviation_it_is_measured() -> None:
    """A sphere is a chord's bulge off its facets; the kernel's own account is an upper bound."""
    import cadquery as cq
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    ball = cq.Solid.makeSphere(4.0, angleDegrees1=-90)
    BRepMesh_IncrementalMesh(ball.wrapped, 0.02, False, 0.3, False)
    worst = _farthest(ball, 1e-4)
    assert worst is not None and 1e-3 < worst.distance < 0.06 and worst.place.endswith("mm")


def test_a_mesh_that_misses_its_solid_is_refused_with_the_place(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import cadquery as cq

    distances = iter((0.05, 0.03, 0.04))
    monkeypatch.setattr(
        tessellation, "_farthest", lambda *_: tessellation._Miss(next(distances), "(1.0, 2.0) mm")
    )
    with pytest.raises(TessellationError, match=r"0\.03 mm off at \(1.0, 2.0\) mm; change the"):
        tessellate(cq.Solid.makeBox(1, 1, 1))


def test_a_cavity_that_no_channel_end_mends_names_a_fillet_that_may(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(actuator, "LOOSEST", -1.0)
    design = with_overrides(load_design("prototype_1"), ["number_of_bubbles=1", "length=12"])
    with pytest.raises(GeometryError, match=r"inner_fillet = 0\.5 mm to 0\.4 mm"):
        printed_part(design.bellows, design.indent, design.port)
