"""The whole deformed actuator as a file."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import meshio
import numpy as np
import pytest

from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import HALF
from bellows_design.deformed import deformed_actuator
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.exchange import write_actuator
from solver.exchange.abaqus.cells import reordered

pytestmark = pytest.mark.thorough

Bellows = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def evaluation() -> Evaluation:
    settings = ["length=11.5", "offset=3", "number_of_bubbles=1"]
    design = with_overrides(load_design("prototype_1"), settings)
    return evaluation_of(started(design, HALF, "as asked for"))  # one mesh is enough here


def test_the_file_holds_both_halves_bent_as_far_as_evaluated(
    evaluation: Evaluation, tmp_path: Path
) -> None:
    write_actuator(evaluation, tmp_path / "bent.vtu")
    body, read = deformed_actuator(evaluation), meshio.vtu.read(tmp_path / "bent.vtu")
    assert [path.name for path in tmp_path.iterdir()] == ["bent.vtu"]
    assert np.array_equal(read.points, body.mesh.nodes)
    assert np.array_equal(read.point_data["displacement_mm"], body.displacement)
    assert read.points[:, 1].min() == pytest.approx(-read.points[:, 1].max())
    assert read.points[:, 0].max() == pytest.approx(11.5)
    tip = body.mesh.surfaces["tip"][:, :3]
    moved = (body.mesh.nodes + read.point_data["displacement_mm"])[tip]
    normals = np.cross(moved[:, 1] - moved[:, 0], moved[:, 2] - moved[:, 0]).sum(axis=0)
    angle = np.degrees(np.arctan2(-normals[2], normals[0]))
    assert angle == pytest.approx(evaluation.bending_angle_deg, rel=0.05)


def test_stress_and_pressure_are_where_they_are(evaluation: Evaluation, tmp_path: Path) -> None:
    write_actuator(evaluation, tmp_path / "bent.vtu")
    body, read = deformed_actuator(evaluation), meshio.vtu.read(tmp_path / "bent.vtu")
    stress, pressure = (read.point_data[name] for name in ("von_mises_mpa", "pressure_mpa"))
    assert np.array_equal(stress, body.von_mises)
    on = np.zeros(len(read.points), bool)
    on[body.mesh.surface_nodes("cavity")] = True
    assert (pressure[on] == evaluation.pressure_mpa).all() and not pressure[~on].any()
    (cells,) = read.cells
    corners = read.points[cells.data[:, :4]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert cells.type == "tetra10" and volume > 0


def test_xdmf_holds_the_same(evaluation: Evaluation, tmp_path: Path) -> None:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

    body = deformed_actuator(evaluation)
    write_actuator(body, tmp_path / "bent.xdmf")
    reader = vtkXdmfReader()
    reader.SetFileName(str(tmp_path / "bent.xdmf"))
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    found = vtk_to_numpy(grid.GetPointData().GetArray("displacement_mm"))
    assert found == pytest.approx(body.displacement, abs=1e-12)
    assert grid.GetNumberOfCells() == len(body.mesh.tets)
    assert vtk_to_numpy(grid.GetPointData().GetArray("von_mises_mpa")) == pytest.approx(
        body.von_mises
    )


def test_meshio_reads_the_xdmf_too(
    evaluation: Evaluation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It imports h5py even for files that have no HDF5."""
    monkeypatch.setitem(sys.modules, "h5py", ModuleType("h5py"))
    body = deformed_actuator(evaluation)
    write_actuator(body, tmp_path / "bent.xdmf")
    read = meshio.read(tmp_path / "bent.xdmf")
    assert read.points == pytest.approx(body.mesh.nodes, abs=1e-12)
    assert np.array_equal(read.cells_dict["tetra10"], reordered(body.mesh.tets))
    assert read.point_data["displacement_mm"] == pytest.approx(body.displacement, abs=1e-12)


def test_other_endings_are_refused(evaluation: Evaluation, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"must end in \.vtu or \.xdmf"):
        write_actuator(evaluation, tmp_path / "bent.vtk")
    assert not list(tmp_path.iterdir())


def test_evaluate_writes_the_whole_and_the_model(
    bellows: Bellows, evaluation: Evaluation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def evaluated(*_: Any, **__: Any) -> Evaluation:
        return evaluation

    monkeypatch.setattr("bellows_design.store.evaluated", evaluated)
    whole, model = tmp_path / "whole.vtu", tmp_path / "model.vtu"
    asked = ("--vtu", str(whole), "--vtu-model", str(model), "--no-cache")
    status, _, _ = bellows("evaluate", "prototype_1", *asked)
    read, solved = meshio.vtu.read(whole), meshio.vtu.read(model)
    assert status == 0 and read.points[:, 1].min() < -5 and solved.points[:, 1].min() > -1e-6
    finest = evaluation.computation.finest
    assert np.array_equal(solved.point_data["displacement_mm"], finest.displacement)
    status, _, err = bellows("evaluate", "prototype_1", "--vtu-model", "model.xdmf")
    assert status == 2 and "must end in .vtu" in err
