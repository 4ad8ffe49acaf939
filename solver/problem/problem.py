"""The boundary value problem: mesh, material, supports, loads and contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from solver.errors import SolverError
from solver.input_types import check_instance, check_number, members_of, names, numbers
from solver.material.law import Hyperelastic
from solver.mesh.mesh import Mesh
from solver.problem.supports import Supports

if TYPE_CHECKING:
    from solver.problem.loads import Load


@dataclass(frozen=True)
class SlenderAxis:
    """Axis of a slender body along +x that bends in the plane normal to y.

    Attributes:
        stations: at least two ascending positions along x, mm. The first is where the body is held;
            the others follow its parts (for a bellows: middles of bubbles and gaps, and the tip).

    Raises:
        SolverError: fewer than two stations, or ones that are not finite or not ascending.
    """

    stations: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "stations", numbers("axis: stations", self.stations))
        finite = bool(np.isfinite(self.stations).all())
        if len(self.stations) < 2 or not finite or not (np.diff(self.stations) > 0).all():
            raise SolverError(
                "axis: stations must be at least two positions in mm in ascending order, "
                f"got {self.stations}."
            )


@dataclass(frozen=True)
class Contact:
    """Frictionless contact of a surface with a plane of symmetry, which it may not cross.

    Attributes:
        surface: name of the surface.
        penetration: depth beyond the plane, mm, at a contact pressure equal to the material's
            initial shear modulus; other pressures in proportion.
        axis: normal of the plane, 0, 1 or 2; None for the problem's moving plane.
        position: of the plane along ``axis``, mm.

    Raises:
        SolverError: another axis, a penetration that is not positive and finite, or a position that
            is not finite.
    """

    surface: str
    penetration: float
    axis: int | None = None
    position: float = 0.0

    def __post_init__(self) -> None:
        check_number("contacts: penetration", self.penetration)
        check_number("contacts: position", self.position)
        if self.axis not in (None, 0, 1, 2):
            raise SolverError(f"contacts: the plane's axis must be 0, 1 or 2, got {self.axis}.")
        if not 0 < self.penetration < np.inf or not np.isfinite(self.position):
            raise SolverError(
                f"contacts: penetration = {self.penetration:g} mm must be above 0 and position = "
                f"{self.position:g} mm finite."
            )


@dataclass(frozen=True)
class Problem:
    """A hyperelastic solid under a follower pressure, dead loads and prescribed motions.

    Dead loads and prescribed motions grow with the pressure, from nothing to their full size.

    Attributes:
        mesh: the undeformed body.
        material: its hyperelastic law.
        supports: displacement boundary conditions.
        pressurised: names of the surfaces under pressure.
        loads: dead loads; with a moving plane couples only.
        axis: if given, increments are applied as finite rotations along it (``SlenderMotion``).
        moving_plane: name of a plane surface normal to x that stays plane, free to rotate about y
            and to shift along x: the section between two cells of a uniform chain. It carries the
            resultant of the pressure in the cavity beyond it (``MovingPlane``), and the couples.
        sharp_edge_radius: mm; stresses nearer than that to an edge at which the ideal body's are
            unbounded are left out of peaks (``solver.results.sharp_edges``).
        contacts: surfaces that may not cross planes of symmetry (``solver.assembly.contact``).

    Raises:
        SolverError: a surface is unknown, has no triangles or is not made of outer faces, the
            moving plane is not plane, loads do not go with it, a contact has no plane, the supports
            leave a rigid motion free, or they leave the pressure of an incompressible body
            undetermined.
    """

    mesh: Mesh
    material: Hyperelastic
    supports: Supports
    pressurised: tuple[str, ...] = ()
    loads: tuple[Load, ...] = ()
    axis: SlenderAxis | None = None
    moving_plane: str | None = None
    sharp_edge_radius: float = 0.0
    contacts: tuple[Contact, ...] = ()

    def __post_init__(self) -> None:
        self._check_kinds()
        from solver.mesh.checks import check_mesh
        from solver.problem.loads import check_loads, loaded_surfaces
        from solver.problem.support_checks import check_pressure, check_supports
        from solver.problem.supports import fixed_displacements

        check_loads(self.loads, self.moving_plane)
        check_mesh(self.mesh, self.pressurised, loaded_surfaces(self.loads))
        if not 0 <= self.sharp_edge_radius < np.inf:
            raise SolverError(
                f"sharp_edge_radius = {self.sharp_edge_radius} mm must be a number of at least 0."
            )
        object.__setattr__(self, "contacts", members_of("contacts", self.contacts, (Contact,)))
        _check_contacts(self)
        check_supports(self.mesh, self.supports, self.moving_plane)
        if self.material.compliance == 0:
            check_pressure(self.mesh, fixed_displacements(self.mesh, self.supports))

    def _check_kinds(self) -> None:
        """Raise ``SolverError`` for values of another kind; sequences become tuples."""
        from solver.problem.loads import LOAD_KINDS

        check_instance("mesh", self.mesh, Mesh)
        check_instance("material", self.material, Hyperelastic)
        check_instance("supports", self.supports, Supports)
        check_instance("axis", self.axis, SlenderAxis, optional=True)
        check_instance("moving_plane", self.moving_plane, str, optional=True)
        check_number("sharp_edge_radius", self.sharp_edge_radius)
        object.__setattr__(self, "pressurised", names("pressurised", self.pressurised))
        object.__setattr__(self, "loads", members_of("loads", self.loads, LOAD_KINDS))


def _check_contacts(problem: Problem) -> None:
    """Raise ``SolverError`` for contacts with unknown surfaces or with no moving plane."""
    for contact in problem.contacts:
        problem.mesh.triangles(contact.surface)
        if contact.axis is None and problem.moving_plane is None:
            raise SolverError(
                f"contacts: the surface {contact.surface!r} needs an axis, as the problem has no "
                "moving plane."
            )
