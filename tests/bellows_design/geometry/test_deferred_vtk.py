"""Bodies are built without VTK, which is there for those who use it."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import sys
from bellows_design.geometry.named_solids import rounded_box

solid = rounded_box((0, 0, 0), (4, 5, 6), 1.0)
assert "vtkmodules.vtkRenderingOpenGL2" not in sys.modules, "VTK was loaded for a box"
import vtk
assert vtk.vtkPolyData().GetNumberOfCells() == 0
from vtk import vtkSphereSource
assert "vtkmodules.vtkRenderingOpenGL2" in sys.modules
print(solid.toVtkPolyData(0.1).GetNumberOfCells())
"""


@pytest.mark.thorough
def test_vtk_is_loaded_when_something_of_it_is_asked_for() -> None:
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert int(run.stdout) > 6
