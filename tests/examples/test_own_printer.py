"""The example of a package that brings a printer profile."""

from __future__ import annotations

import importlib
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from manifold3d import Manifold

from printers import (
    Opening,
    PrintabilityReport,
    PrintedModel,
    available_profiles,
    check_printability,
    load_profile,
)

PACKAGE = Path(__file__).parents[2] / "examples" / "own_printer"
GROUP = "bellows_design.printers"


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The package can be imported and has the entry points of its pyproject, without pip."""
    project = tomllib.loads((PACKAGE / "pyproject.toml").read_text("utf-8"))["project"]
    lines = [f"{name} = {value}" for name, value in project["entry-points"][GROUP].items()]
    info = tmp_path / "own_printer-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: own-printer\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("\n".join([f"[{GROUP}]", *lines]) + "\n")
    monkeypatch.syspath_prepend(PACKAGE)
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    yield
    sys.modules.pop("own_printer", None)


def checked_box(wall: float, floor: float) -> PrintabilityReport:
    """A hollow box of these walls with a port of 4 mm, on the package's printer."""
    inner = np.array([16.0, 10.0, 9.6])
    box = Manifold.cube(tuple(inner + 2 * np.array([wall, wall, floor])))
    cavity = Manifold.cube(tuple(inner)).translate((wall, wall, floor))
    centre = (0.0, wall + 5.0, floor + 4.8)
    bore = Manifold.cylinder(wall + 2, 2.0, 2.0, 64).rotate((0, 90, 0)).translate(centre)
    mesh = (box - cavity - bore.translate((-1, 0, 0))).to_mesh64()
    vertices, triangles = mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)
    port = Opening("port", centre, (-1.0, 0.0, 0.0), 2.0)
    model = PrintedModel(vertices, triangles, openings=(port,))
    return check_printability(model, load_profile("delta_0_8"))


@pytest.mark.usefixtures("installed")
def test_the_profile_of_another_package_is_known_by_name() -> None:
    assert "delta_0_8" in available_profiles()
    assert load_profile("delta_0_8").minimum_wall == pytest.approx(1.6)


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize(("wall", "verdict"), [(1.6, "pass"), (1.2, "fail"), (2.0, "fail")])
def test_a_box_is_checked_against_that_printer(wall: float, verdict: str) -> None:
    report = checked_box(wall, floor=1.2)
    assert (report.printer, report.verdict) == ("delta_0_8", verdict), report.failures
