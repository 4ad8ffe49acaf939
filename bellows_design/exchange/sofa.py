"""Files for SOFA: the volume, the surface of the cavity, and a scene that brings them together.

The volume is a legacy VTK file, as SOFA's ``MeshVTKLoader`` reads it. SOFA's pressures, in
``SurfacePressureForceField`` as in the SoftRobots plugin's ``SurfacePressureConstraint``, push
along the normals of triangles (the cross product of the edges from the first corner): so the
triangles around the air have their normals out of it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bellows_design.design.design import Design
from bellows_design.exchange.linear import LinearMesh

TETRAHEDRON = 10
"""VTK's number of the four-node tetrahedron."""

POISSON_RATIO = 0.45
"""Of the scene's linear tetrahedra, which lock near 0.5."""

FIXED = 0.05
"""Thickness of the slice at the root that the scene holds, in bubble heights."""


def volume_text(mesh: LinearMesh, title: str) -> str:
    """A legacy VTK file of tetrahedra."""
    cells = np.insert(mesh.tets, 0, 4, axis=1)
    return "\n".join(
        [
            "# vtk DataFile Version 2.0",
            " ".join(title.split())[:200],
            "ASCII",
            "DATASET UNSTRUCTURED_GRID",
            f"POINTS {len(mesh.nodes)} double",
            *(" ".join(map(repr, row)) for row in mesh.nodes.tolist()),
            f"CELLS {len(cells)} {cells.size}",
            *(" ".join(map(str, row)) for row in cells.tolist()),
            f"CELL_TYPES {len(cells)}",
            *(str(TETRAHEDRON) for _ in cells),
            "",
        ]
    )


def surface_stl(nodes: NDArray[np.float64], triangles: NDArray[np.int64]) -> bytes:
    """Triangles as a binary STL."""
    import trimesh

    content = trimesh.Trimesh(nodes, triangles, process=False).export(file_type="stl")
    assert isinstance(content, bytes)  # the text form has another name
    return content


def scene_text(design: Design, volume: Path, cavity: Path, half: bool) -> str:
    """A scene for ``runSofa``; mm, kg and s, so that stresses are in kPa."""
    young = 3000 * design.material.hyperelastic().shear_modulus
    bellows = design.bellows
    wide, high = bellows.bubble_width, bellows.bubble_height
    slice_at_root = [-1.0, -wide, -high, FIXED * high, wide, 3 * high]
    return SCENE.format(
        name=design.name,
        symmetry=SYMMETRY.format(box=[-1.0, -1e-3, -high, bellows.length + 1, 1e-3, 3 * high])
        if half
        else "",
        volume=volume.name,
        cavity=cavity.name,
        young=round(young, 3),
        poisson=POISSON_RATIO,
        root=slice_at_root,
        pressure=1000 * design.load.pressure,
    )


SYMMETRY = """    # the plane y = 0 of the half model
    body.addObject("BoxROI", name="middle", box={box})
    body.addObject(
        "PartialFixedProjectiveConstraint",
        indices="@middle.indices",
        fixedDirections=[0, 1, 0],
    )
"""

SCENE = '''"""{name} in SOFA: runSofa THIS_FILE. Written by bellows-design, which has not run it.

Lengths in mm, mass in kg, time in s; stresses and pressures therefore in kPa. The material is
linear elastic in rotated elements with the rubber's initial stiffness: a model to play with, no
substitute for the bending angle and stress of ``bellows evaluate``.
"""

from pathlib import Path

FOLDER = Path(__file__).parent
PRESSURE = {pressure}  # kPa, reached after RISE
RISE = 1.0  # s
PLUGINS = (
    "Sofa.Component.AnimationLoop",
    "Sofa.Component.Constraint.Projective",
    "Sofa.Component.Engine.Select",
    "Sofa.Component.IO.Mesh",
    "Sofa.Component.LinearSolver.Direct",
    "Sofa.Component.Mapping.Linear",
    "Sofa.Component.Mass",
    "Sofa.Component.MechanicalLoad",
    "Sofa.Component.ODESolver.Backward",
    "Sofa.Component.SolidMechanics.FEM.Elastic",
    "Sofa.Component.StateContainer",
    "Sofa.Component.Topology.Container.Constant",
    "Sofa.Component.Topology.Container.Dynamic",
    "Sofa.Component.Visual",
)


def createScene(root):
    root.dt = 0.01
    root.gravity = [0, 0, 0]
    for plugin in PLUGINS:
        root.addObject("RequiredPlugin", name=plugin)
    root.addObject("DefaultAnimationLoop")
    root.addObject("VisualStyle", displayFlags="showVisualModels showForceFields")

    body = root.addChild("body")
    body.addObject("EulerImplicitSolver", rayleighStiffness=0.1, rayleighMass=0.1)
    body.addObject("SparseLDLSolver", template="CompressedRowSparseMatrixMat3x3d")
    body.addObject("MeshVTKLoader", name="loader", filename=str(FOLDER / "{volume}"))
    body.addObject("TetrahedronSetTopologyContainer", src="@loader")
    body.addObject("TetrahedronSetGeometryAlgorithms", template="Vec3")
    body.addObject("MechanicalObject", template="Vec3")
    body.addObject("UniformMass", totalMass=0.02)
    body.addObject(
        "TetrahedronFEMForceField", method="large", youngModulus={young}, poissonRatio={poisson}
    )
    body.addObject("BoxROI", name="root", box={root})
    body.addObject("FixedProjectiveConstraint", indices="@root.indices")
{symmetry}
    # Normals point out of the air: a positive pressure inflates. SoftRobots'
    # SurfacePressureConstraint takes the same surface, without flipNormal.
    air = body.addChild("air")
    air.addObject("MeshSTLLoader", name="loader", filename=str(FOLDER / "{cavity}"))
    air.addObject("TriangleSetTopologyContainer", src="@loader")
    air.addObject("TriangleSetGeometryAlgorithms", template="Vec3")
    air.addObject("MechanicalObject", template="Vec3")
    air.addObject(
        "SurfacePressureForceField",
        pressure=PRESSURE,
        pulseMode=True,
        pressureLowerBound=0.0,
        pressureSpeed=PRESSURE / RISE,
    )
    air.addObject("BarycentricMapping")
'''
