"""Residual and tangent of a problem at a state, assembled directly into CSR values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from solver.arrays import Reals
from solver.assembly.colouring import chunks
from solver.assembly.contact import Contacts
from solver.assembly.free_rim import FreeRim
from solver.assembly.layout import Layout
from solver.assembly.membranes.films import Films
from solver.assembly.membranes.membranes import Membranes
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.pressure import pressure_facets
from solver.assembly.section import SectionLoads
from solver.assembly.springs import Springs
from solver.assembly.state import State
from solver.kernels.assembly import Places, assemble, assemble_plane, total_energy
from solver.kernels.element import Solid
from solver.kernels.pressure import assemble_pressure, assemble_volume
from solver.kernels.stress import extrapolated_stress
from solver.linear.sparsity import Pattern
from solver.material.law import Hyperelastic
from solver.mesh.checks import check_elements
from solver.mesh.elements import tetrahedron_rule
from solver.problem.loads import nodal_forces
from solver.problem.problem import Problem
from solver.problem.springs import stiffness_matrix
from solver.problem.supports import Supports
from solver.problem.unknowns import Numbering, number_unknowns


@dataclass(frozen=True)
class Equilibrium:
    """Residual and tangent at a state, over the unknowns (m,).

    ``residual`` is internal minus external force (N) and constraint violation (mm^3); ``force``
    its derivative with respect to the applied pressure (mm^2); ``tangent`` the CSR values of the
    symmetric part of its derivative with respect to the unknowns, in ``pattern``, empty if not
    requested; ``skew`` those of the skew part, empty where the loads have a potential.
    ``smallest_jacobian`` is the least J of all quadrature points; the rest is meaningless unless it
    is positive.
    """

    residual: Reals
    force: Reals
    tangent: Reals
    smallest_jacobian: float
    pattern: Pattern
    skew: Reals = field(default_factory=lambda: np.zeros(0))

    @property
    def admissible(self) -> bool:
        """No element is inverted and every number is finite."""
        numbers = (self.residual, self.tangent, self.skew)
        return bool(self.smallest_jacobian > 0 and all(np.isfinite(x).all() for x in numbers))


class Assembly:
    """Residual and tangent of a problem: its layout, and element data that no state changes."""

    problem: Problem
    layout: Layout

    def __init__(
        self, problem: Problem, start: Reals | None = None, former: Layout | None = None
    ) -> None:
        """``start`` (n, 3): displacements that the supports act from, mm; by default none.

        ``former``: the layout of a problem before, which is used again if it fits.
        """
        mesh = problem.mesh
        self.problem = problem
        check_elements(mesh)
        same = former is not None and former.fits(problem)
        self.layout = former if former is not None and same else Layout.of(problem)
        surface = problem.moving_plane
        self.plane = None if surface is None else MovingPlane.of(mesh, surface)
        self._solid = solid(problem)
        self._facets = pressure_facets(mesh, self.layout.triangles, *self.layout.facets)
        self._nodal_force = self.numbering.gather(nodal_forces(mesh, problem.loads))
        self._section_loads = SectionLoads.of(problem, self.numbering, self.pattern)
        self.springs = Springs.of(problem, self.numbering, self.pattern)
        self.films = Films.of(problem, self.numbering, self.pattern)
        still = np.zeros(mesh.nodes.shape) if start is None else start
        self._rim = FreeRim.of(problem, self.numbering, self.pattern, still)
        self.contacts = Contacts(problem, self.numbering, self.plane, self.pattern, still)

    @property
    def numbering(self) -> Numbering:
        """Numbers of the unknowns."""
        return self.layout.numbering

    @property
    def pattern(self) -> Pattern:
        """Sparsity pattern of the tangent without contact at a moving plane or between surfaces."""
        return self.layout.pattern

    def evaluate(
        self, state: State, pressure: float, tangent: bool = True, load: float = 0.0
    ) -> Equilibrium:
        """Residual and tangent at ``state``, ``pressure`` (MPa) and a fraction of dead loads."""
        residual = np.zeros(self.numbering.size)
        force = np.zeros(self.numbering.size)
        values = np.zeros(len(self.pattern.indices) if tangent else 0)
        smallest = self._add_solid(state, tangent, residual, values)
        self._add_pressure(state, pressure, tangent, force, values)
        residual += pressure * force - load * self.dead_force(state)
        if tangent and self._section_loads is not None:
            self._section_loads.add_tangent(state, load, values)
        self._add_springs(state, tangent, residual, values)
        if self.films is not None:
            self.films.add(state, tangent, residual, values)
        values, pattern = self.contacts.add(state, tangent, residual, values, load)
        skew = self._skew(state, pressure) if tangent else np.zeros(0)
        if len(skew):
            skew = self.contacts.in_pattern(skew, state, load)
        return Equilibrium(residual, force, values, smallest, pattern, skew)

    def dead_force(self, state: State) -> Reals:
        """Forces (m,) of the whole dead loads on the unknowns: on a moving plane, as it stands."""
        if self._section_loads is None:
            return self._nodal_force
        return self._nodal_force + self._section_loads.force(state)

    @property
    def symmetric(self) -> bool:
        """Whether the tangent is symmetric: all loads have a potential."""
        return len(self._rim.edges) == 0

    def _skew(self, state: State, pressure: float) -> Reals:
        """CSR values of the skew part of the tangent; empty where it is symmetric."""
        if self.symmetric:
            return np.zeros(0)
        values = np.zeros(len(self.pattern.indices))
        self._rim.add_tangent(self.problem.mesh.nodes + state.displacement, pressure, values)
        return values

    def _add_solid(self, state: State, tangent: bool, residual: Reals, values: Reals) -> float:
        """Add all elements to ``residual`` and ``values``; the smallest J."""
        jacobians = np.empty(len(self.problem.mesh.tets))
        displacement = np.ascontiguousarray(state.displacement)
        assemble(
            self._solid, self.layout.places, displacement, state.hydrostatic_pressure,
            self._geometric(state), tangent, residual, values, jacobians,
        )  # fmt: skip
        if self.plane is not None:
            assemble_plane(
                self._solid, self.layout.at_plane, self.plane.heights(state), state.plane[0],
                *self.layout.plane, displacement, state.hydrostatic_pressure,
                self._geometric(state), tangent, residual, values, jacobians,
            )  # fmt: skip
        return float(jacobians.min(initial=np.inf))

    def _add_pressure(
        self, state: State, pressure: float, tangent: bool, force: Reals, values: Reals
    ) -> None:
        """Add unit-pressure forces to ``force`` and the tangent of ``pressure`` to ``values``."""
        displacement = np.ascontiguousarray(state.displacement)
        if self.plane is None:
            assemble_pressure(self._facets, displacement, pressure, tangent, force, values)
            return
        assemble_volume(
            self._facets, self.plane.heights(state), state.plane[0], displacement, pressure,
            tangent, force, values,
        )  # fmt: skip

    def _add_springs(self, state: State, tangent: bool, residual: Reals, values: Reals) -> None:
        """Add all springs to ``residual`` and ``values``."""
        if self.springs is None:
            return
        residual += self.numbering.gather(self.springs.forces(state.displacement))
        if tangent:
            values[self.springs.entries] += self.springs.values

    def extrapolated_stress(self, state: State, increment: State) -> Reals:
        """Stress after an increment from a state, to first order: a ``State.geometric_stress``.

        On a moving plane too the increment's displacements are those of the nodes.
        """
        stress = np.empty((len(self.problem.mesh.tets), len(self._solid.weights), 6))
        extrapolated_stress(
            self._solid, np.ascontiguousarray(state.displacement), state.hydrostatic_pressure,
            np.ascontiguousarray(increment.displacement), increment.hydrostatic_pressure, stress,
        )  # fmt: skip
        return stress

    def energy(self, state: State, load: float = 0.0) -> float:
        """Pi of the solid, its springs, membranes and contacts, N mm.

        Its gradient is the residual without pressure and dead loads; rigid bodies are where they
        are at the fraction ``load`` of the load.
        """
        solid = total_energy(self._solid, state.displacement, state.hydrostatic_pressure)
        springs = self.springs.energy(state.displacement) if self.springs is not None else 0.0
        films = self.films.energy(state) if self.films is not None else 0.0
        return float(solid[0]) + springs + films + self.contacts.energy(state, load)

    def _geometric(self, state: State) -> Reals:
        """A state's geometric stress in the form of the kernels: (e, 0, 6) for none."""
        stress = state.geometric_stress
        return stress if len(stress) else np.empty((len(self.problem.mesh.tets), 0, 6))


def unbalanced_forces(problem: Problem, state: State, pressure: float, load: float) -> Reals:
    """Out-of-balance nodal forces (n, 3) in N: zero except where supports act.

    Under ``pressure`` (MPa) and the fraction ``load`` of the dead loads and of the motions of rigid
    bodies; springs, membranes and contacts belong to the balance.
    """
    mesh = problem.mesh
    everything = number_unknowns(mesh, NO_SUPPORTS)
    dofs = everything.of_tets(mesh)
    places = Places(*chunks(mesh), dofs, np.empty((len(dofs), 0), np.int32))
    residual, force, nothing = np.zeros(everything.size), np.zeros(everything.size), np.zeros(0)
    displacement = np.ascontiguousarray(state.displacement)
    assemble(
        solid(problem), places, displacement, state.hydrostatic_pressure,
        np.empty((len(mesh.tets), 0, 6)), False, residual, nothing, np.empty(len(mesh.tets)),
    )  # fmt: skip
    triangles = mesh.triangles(*problem.pressurised)
    no_entries = np.empty((len(triangles), 0), np.int32)
    loaded = pressure_facets(mesh, triangles, everything.of_triangles(triangles), no_entries)
    assemble_pressure(loaded, displacement, pressure, False, force, nothing)
    forces, _, _ = everything.expand(residual + pressure * force)
    forces -= load * nodal_forces(mesh, problem.loads)
    if problem.springs:
        stiffness = stiffness_matrix(mesh, problem.springs)
        forces += (stiffness @ displacement.ravel()).reshape(-1, 3)
    if problem.membranes:
        forces += Membranes.of(problem).forces(displacement)
    for pair in contact_pairs(problem):
        forces -= pair.forces(state, load)
    return forces


NO_SUPPORTS = Supports()


def solid(problem: Problem) -> Solid:
    """Mesh, materials and quadrature of a problem, as arrays for the kernels."""
    mesh, rule, distribution = problem.mesh, tetrahedron_rule(), problem.distribution
    return Solid(
        nodes=mesh.nodes,
        tets=mesh.tets,
        tet_vertices=mesh.tet_vertices,
        material_of=distribution.of_tet,
        gradients=rule.gradients,
        linear=rule.linear,
        weights=rule.weights,
        **_laws(distribution.materials),
    )


def with_materials(body: Solid, materials: Sequence[Hyperelastic]) -> Solid:
    """A body with other materials, by their numbers."""
    return body._replace(**_laws(materials))


def _laws(materials: Sequence[Hyperelastic]) -> dict[str, Any]:
    """Materials as arrays of a ``Solid``."""
    constants = [each.constants for each in materials]
    return {
        "law": np.array([each.number for each in constants], np.int32),
        "constants": np.concatenate([each.values for each in constants]),
        "offsets": np.cumsum([0, *(len(each.values) for each in constants)], dtype=np.int32),
        "compliance": np.array([each.compliance for each in materials]),
        "logarithmic": np.array([each.volumetric == "logarithmic" for each in materials]),
    }
