"""The boundary value problem: mesh, material, supports, loads, contacts, springs, membranes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from solver.errors import SolverError
from solver.input_types import check_instance, check_number, members_of, names, numbers
from solver.material.law import Hyperelastic
from solver.mesh.mesh import Mesh
from solver.problem.materials import Distribution, checked_materials
from solver.problem.supports import Supports

if TYPE_CHECKING:
    from solver.problem.contacts import AnyContact
    from solver.problem.loads import Load
    from solver.problem.membranes import Membrane
    from solver.problem.springs import Spring


@dataclass(frozen=True)
class SlenderAxis:
    """Axis of a slender body along +x that bends in the plane normal to y.

    Attributes:
        stations: at least two ascending positions along x, mm. The first is where the body is held;
            the others follow its parts (for a bellows: middles of bubbles and gaps, and the tip).

    Raises:
        SolverError: fewer than two stations, or ones that are not finite or not ascending.

    Examples:
        >>> from solver import Ogden, Problem, SlenderAxis, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.004))
        >>> bar = block((60, 4, 4), (12, 1, 1))
        >>> axis = SlenderAxis((0.0, 15.0, 30.0, 45.0, 60.0))  # where it is held, and what follows
        >>> held, rubber = Supports(("x0",)), Ogden.neo_hooke(0.5)
        >>> problem = Problem(bar, rubber, held, loads=(bend,), axis=axis)
        >>> solution = solve(problem)
        >>> print(solution.message, solution.load_steps)
        reached 100 % of the load. 2
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
class Problem:
    """A hyperelastic solid under a follower pressure, dead loads and prescribed motions.

    Dead loads and prescribed motions grow with the pressure, from nothing to their full size.

    Attributes:
        mesh: the undeformed body.
        material: its hyperelastic law, where ``materials`` names no other.
        supports: displacement boundary conditions.
        pressurised: names of the surfaces under pressure.
        loads: dead loads; with a moving plane couples and axial forces only.
        axis: if given, increments are applied as finite rotations along it (``SlenderMotion``).
        moving_plane: name of a plane surface normal to x that stays plane, free to rotate about y
            and to shift along x: the section between two cells of a uniform chain. It carries the
            resultant of the pressure in the cavity beyond it (``MovingPlane``), couples and axial
            forces.
        sharp_edge_radius: mm; stresses nearer than that to an edge at which the ideal body's are
            unbounded are left out of peaks (``solver.results.sharp_edges``).
        contacts: surfaces that may not cross planes of symmetry, rigid bodies, some of which move
            with the load, or each other (``solver.assembly.contact``); with a moving plane only
            planes of symmetry and that one.
        springs: linear springs between the body and the ground; none with a moving plane.
        membranes: films on surfaces that stretch by their modulus and bend freely; none with a
            moving plane.
        materials: region of the mesh -> its hyperelastic law.

    Raises:
        SolverError: a surface or region is unknown, a surface has no triangles or is not made of
            outer faces, the moving plane is not plane, loads, springs, membranes or rigid bodies do
            not go with it, a contact has no plane, supports and springs leave a rigid motion free,
            or the supports leave the pressure of an incompressible body or region undetermined.

    Examples:
        >>> from solver import Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> beam = block((40, 8, 8), (10, 4, 4), hollow=((1, 1, 2), (9, 3, 3)))  # above the middle
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> problem = Problem(beam, rubber, Supports(clamped=("x0",)), pressurised=("cavity",))
        >>> print(solve(problem, pressure=0.02).message)
        reached 0.02 of 0.02 MPa.
    """

    mesh: Mesh
    material: Hyperelastic
    supports: Supports
    pressurised: tuple[str, ...] = ()
    loads: tuple[Load, ...] = ()
    axis: SlenderAxis | None = None
    moving_plane: str | None = None
    sharp_edge_radius: float = 0.0
    contacts: tuple[AnyContact, ...] = ()
    springs: tuple[Spring, ...] = ()
    materials: Mapping[str, Hyperelastic] = field(default_factory=dict)
    membranes: tuple[Membrane, ...] = ()

    def __post_init__(self) -> None:
        self._check_kinds()
        from solver.mesh.checks import check_mesh
        from solver.problem.contacts import check_contacts, surfaces_of
        from solver.problem.loads import check_loads, loaded_surfaces
        from solver.problem.membranes import check_membranes
        from solver.problem.springs import check_springs, sprung_surfaces
        from solver.problem.support_checks import check_pressure, check_supports
        from solver.problem.supports import fixed_displacements

        check_loads(self.loads, self.moving_plane)
        springs = check_springs(self.springs, self.moving_plane)
        object.__setattr__(self, "springs", springs)
        contacts = check_contacts(self.mesh, self.contacts, self.moving_plane)
        object.__setattr__(self, "contacts", contacts)
        loaded = (*loaded_surfaces(self.loads), *sprung_surfaces(springs))
        touching = (name for each in contacts for name in surfaces_of(each))
        check_mesh(self.mesh, self.pressurised, (*loaded, *touching))
        films = check_membranes(self.mesh, self.membranes, self.moving_plane)
        object.__setattr__(self, "membranes", films)
        if not 0 <= self.sharp_edge_radius < np.inf:
            raise SolverError(
                f"sharp_edge_radius = {self.sharp_edge_radius} mm must be a number of at least 0."
            )
        check_supports(self.mesh, self.supports, self.moving_plane, self.springs)
        if not all(each.compliance for each in self.distribution.materials):
            fixed = fixed_displacements(self.mesh, self.supports)
            check_pressure(self.distribution, fixed)

    @cached_property
    def distribution(self) -> Distribution:
        """Which material is where."""
        return Distribution(self.mesh, self.material, self.materials)

    def _check_kinds(self) -> None:
        """Raise ``SolverError`` for values of another kind; sequences become tuples."""
        from solver.problem.loads import LOAD_KINDS

        check_instance("mesh", self.mesh, Mesh)
        check_instance("material", self.material, Hyperelastic)
        check_instance("supports", self.supports, Supports)
        check_instance("axis", self.axis, SlenderAxis, optional=True)
        check_instance("moving_plane", self.moving_plane, str, optional=True)
        check_number("sharp_edge_radius", self.sharp_edge_radius)
        materials = MappingProxyType(checked_materials(self.mesh, self.materials))
        object.__setattr__(self, "materials", materials)
        object.__setattr__(self, "pressurised", names("pressurised", self.pressurised))
        object.__setattr__(self, "loads", members_of("loads", self.loads, LOAD_KINDS))
