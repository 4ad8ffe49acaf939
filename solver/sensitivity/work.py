"""Virtual work of a body along a direction, and its derivatives by the nodes' positions.

The work of all forces along the direction of an adjoint is the adjoint times the residual. Its
parts are the solid's (``solver.kernels.shape_derivatives``), the pressure's, those of contacts,
springs, membranes and dead loads.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.assembly.assembly import NO_SUPPORTS, Assembly, solid
from solver.assembly.colouring import chunks
from solver.assembly.membranes.derivatives import membrane_derivatives
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.pairs.pair import ContactPair
from solver.assembly.state import State
from solver.kernels.assembly import Places, assemble
from solver.kernels.element import Solid
from solver.kernels.shape_derivatives import work_derivatives
from solver.problem.unknowns import Numbering, number_unknowns
from solver.sensitivity.contact_work import contact_derivatives
from solver.sensitivity.load_work import load_derivative, section_derivative, spring_derivative
from solver.sensitivity.surface_integrals import (
    at_points,
    flux_derivative,
    summed,
    volume_curvature,
    volume_derivative,
)
from solver.sensitivity.unknowns import Direction


@dataclass(frozen=True)
class Derivatives:
    """Of a scalar: ``by_position`` at fixed displacements, and ``by_displacement``, (n, 3)."""

    by_position: Reals
    by_displacement: Reals

    def __add__(self, other: Derivatives) -> Derivatives:
        return Derivatives(
            self.by_position + other.by_position, self.by_displacement + other.by_displacement
        )

    def __sub__(self, other: Derivatives) -> Derivatives:
        return Derivatives(
            self.by_position - other.by_position, self.by_displacement - other.by_displacement
        )


@dataclass(frozen=True)
class Equilibrated:
    """What a virtual work is taken of: a state under a ``pressure`` (MPa) and dead loads."""

    assembly: Assembly
    state: State
    pressure: float
    load: float

    @property
    def positions(self) -> Reals:
        """Of the deformed nodes, (n, 3), mm."""
        positions: Reals = self.assembly.problem.mesh.nodes + self.state.displacement
        return positions

    @cached_property
    def touching(self) -> tuple[ContactPair, ...]:
        """The contacts of which points touch."""
        pairs = contact_pairs(self.assembly.problem)
        return tuple(pair for pair in pairs if pair.touches(self.state, self.load))


def work_gradients(at: Equilibrated, directions: Sequence[Direction]) -> tuple[Derivatives, ...]:
    """Derivatives of the works along directions that keep their displacements."""
    solids = _solids(at, directions)
    return tuple(
        part + _of_forces(at, direction) for part, direction in zip(solids, directions, strict=True)
    )


def _of_forces(at: Equilibrated, direction: Direction) -> Derivatives:
    """The parts of all that acts on the solid."""
    through_positions = _pressure(at, direction)
    both = Derivatives(through_positions, through_positions)
    problem = at.assembly.problem
    for pair in at.touching:
        both = both + Derivatives(*contact_derivatives(pair, at.state, at.load, direction))
    if at.assembly.springs is not None:
        both = both + Derivatives(
            spring_derivative(problem, at.state.displacement, direction.displacement),
            at.assembly.springs.forces(direction.displacement),
        )
    if problem.membranes:
        moved = at.state.displacement, direction.displacement
        both = both + Derivatives(*membrane_derivatives(problem, *moved))
    if problem.loads:
        nodal = load_derivative(problem, direction.displacement)
        dead = at.load * (nodal + section_derivative(problem, at.state, direction))
        both = both - Derivatives(dead, np.zeros_like(dead))
    return both


def _solids(at: Equilibrated, directions: Sequence[Direction]) -> list[Derivatives]:
    """The parts of the solid, of all directions at once: they share its stress and tangent."""
    mesh, state = at.assembly.problem.mesh, at.state
    parts = np.empty((2, len(directions), *mesh.tets.shape, 3))
    work_derivatives(
        solid(at.assembly.problem), np.ascontiguousarray(state.displacement),
        state.hydrostatic_pressure, np.stack([each.displacement for each in directions]),
        np.stack([each.hydrostatic_pressure for each in directions]), *parts,
    )  # fmt: skip
    size = len(mesh.nodes)
    return [
        Derivatives(*(summed(size, mesh.tets, part) for part in pair))
        for pair in zip(*parts, strict=True)
    ]


def _pressure(at: Equilibrated, direction: Direction) -> Reals:
    """Derivative (n, 3) of the pressure's part by deformed positions.

    With a moving plane, as for its force, minus that of the pressure times the enclosed volume.
    """
    problem = at.assembly.problem
    triangles, along = problem.mesh.triangles(*problem.pressurised), direction.displacement
    if problem.moving_plane is not None:
        return -at.pressure * volume_curvature(at.positions, triangles, along)
    field = at.pressure * at_points(along, triangles)
    return flux_derivative(at.positions, triangles, field)


def plane_forces(at: Equilibrated) -> Reals:
    """Nodal forces (n, 3) in the residual at the nodes of the moving plane, N.

    There they need not balance, the unknowns being others; elsewhere they are incomplete.
    """
    problem, plane = at.assembly.problem, at.assembly.plane
    nodes = () if plane is None else plane.nodes
    around = np.flatnonzero(np.isin(problem.mesh.tets, nodes).any(axis=1))
    forces, _ = SolidResidual.of(at, around)(solid(problem))
    triangles = problem.mesh.triangles(*problem.pressurised)
    forces -= at.pressure * volume_derivative(at.positions, triangles)
    for pair in at.touching:
        forces -= pair.forces(at.state, at.load)
    return forces


@dataclass(frozen=True)
class SolidResidual:
    """Residual of the solid over all displacements at a state, of any material of one mesh."""

    at: Equilibrated
    everything: Numbering
    places: Places

    @staticmethod
    def of(at: Equilibrated, elements: NDArray[np.int64] | None = None) -> SolidResidual:
        """Of all ``elements``, or some."""
        mesh = at.assembly.problem.mesh
        everything = number_unknowns(mesh, NO_SUPPORTS)
        dofs = everything.of_tets(mesh)
        no_entries = np.empty((len(dofs), 0), np.int32)
        return SolidResidual(at, everything, Places(*chunks(mesh, elements), dofs, no_entries))

    def __call__(self, body: Solid) -> tuple[Reals, Reals]:
        """Internal forces (n, 3), N, and constraint violations (v,), mm^3, of a ``body``."""
        state, elements = self.at.state, len(body.tets)
        residual = np.zeros(self.everything.size)
        assemble(
            body, self.places, np.ascontiguousarray(state.displacement), state.hydrostatic_pressure,
            np.empty((elements, 0, 6)), False, residual, np.zeros(0), np.empty(elements),
        )  # fmt: skip
        forces, violations, _ = self.everything.expand(residual)
        return forces, violations
