"""How hard does a rubber ball press on a plate?

    python examples/pressing.py

Builds an eighth of a ball in CadQuery, presses the ball between two rigid plates, and prints the
force beside Hertz's. It is the larger the more the ball is pressed: Hertz counts the way to a point
far away, the plates that to the middle of a ball.
"""

from __future__ import annotations

from io import BytesIO

import cadquery as cq
import numpy as np

from solver import (
    Mesh,
    Ogden,
    Problem,
    RigidPlane,
    Solution,
    Supports,
    contact_forces,
    solve,
    strain_energy,
    work,
)
from solver.meshing.solid import MeshOptions, mesh_solid

RADIUS, SHEAR_MODULUS = 10.0, 0.5  # mm, MPa
LIFT = 0.02  # mm; the mesh's curved triangles reach a little beyond the sphere


def mesh() -> Mesh:
    """x, y, z > 0 of a ball, in curved quadratic tetrahedra."""
    corner = cq.Workplane().box(RADIUS, RADIUS, RADIUS, centered=False)
    solid = cq.Workplane().sphere(RADIUS).intersect(corner).val()
    brep = BytesIO()
    solid.exportBrep(brep)
    names = [
        "xyz"[int(np.abs(face.normalAt().toTuple()).argmax())]
        if face.geomType() == "PLANE"
        else "outside"
        for face in solid.Faces()
    ]
    return mesh_solid(brep.getvalue(), names, MeshOptions(size=1.5))


def pressed(ball: Mesh, distance: float) -> Solution:
    """Under a plate that comes down on the pole by ``distance`` (mm)."""

    def motion(load: float) -> tuple[float, float, float]:
        return 0.0, 0.0, -load * (distance + LIFT)

    above = (0, 0, RADIUS + LIFT)
    plate = RigidPlane("outside", 0.01, normal=(0, 0, -1), point=above, motion=motion)
    supports = Supports(symmetry={"x": 0, "y": 1, "z": 2})
    return solve(Problem(ball, Ogden.neo_hooke(SHEAR_MODULUS), supports, contacts=(plate,)))


def hertz(distance: float) -> float:
    """Force, N: 4/3 E* sqrt(R d^3), E* = 4 mu."""
    return 16 / 3 * SHEAR_MODULUS * float(np.sqrt(RADIUS * distance**3))


def main() -> None:
    """Print force, pressure and area over the way of the plate, and the work it has done."""
    ball, path = mesh(), []
    print("closer by   force   Hertz   peak pressure   contact radius")
    for distance in np.arange(1, 6) * 0.2:
        path.append(pressed(ball, float(distance)))
        (contact,) = contact_forces(path[-1])
        force, radius = -4 * contact.force[2], np.sqrt(4 * contact.area / np.pi)
        print(
            f"{distance:6.2f} mm {force:7.3f} {hertz(distance):7.3f} "
            f"{contact.peak_pressure:11.3f} MPa {radius:13.2f} mm"
        )
    print(f"work of the plates {8 * work(path).total:.3f} N mm, ", end="")
    print(f"stored in the ball {8 * strain_energy(path[-1]):.3f} N mm")


if __name__ == "__main__":
    main()
