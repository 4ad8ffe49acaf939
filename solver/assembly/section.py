"""Where the section in a moving plane is, and the dead loads on it: a couple, a force along x.

The section's origin is the point of the plane that lies as far below the section's mean height as
z = 0 does in the undeformed body. With g the mean of what its points have gained in height, the
origin is at

    x = L + shift + g sin(tilt)

(see ``solver.assembly.moving_plane``). No single node decides where it is, and the force, which
does work on its motion, is spread evenly over the section of the undeformed body: a force on a node
would move it by more and more as the mesh is refined.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.state import State
from solver.linear.sparsity import Pattern
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.loads import plane_loads
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering


@dataclass(frozen=True)
class Section:
    """The section in a moving plane: ``shares`` (k,) of its undeformed area are its nodes'."""

    plane: MovingPlane
    shares: Reals

    @staticmethod
    def of(problem: Problem) -> Section | None:
        """The section of a problem; None without a moving plane."""
        if problem.moving_plane is None:
            return None
        plane = MovingPlane.of(problem.mesh, problem.moving_plane)
        weights = _nodal_areas(problem.mesh, problem.moving_plane)[plane.nodes]
        return Section(plane, weights / weights.sum())

    def gains(self, state: State) -> Reals:
        """What the plane's nodes have gained in height (k,), mm."""
        heights: Reals = self.plane.heights(state)[self.plane.nodes]
        return heights - self.plane.positions[:, 2]

    def gain(self, state: State) -> float:
        """Mean gain in height of the section's points, mm."""
        return float((self.shares * self.gains(state)).sum())

    def motion(self, state: State) -> Reals:
        """Tilt (rad) and displacement along x of the origin (mm), (2,)."""
        tilt, shift = state.plane
        return np.array([tilt, shift + self.gain(state) * np.sin(tilt)])

    def moves(self, state: State, displacement: Reals, plane: Reals) -> Reals:
        """Parts (k,) of the nodes in the origin's motion along x, without the plane's own shift.

        Along a direction of displacements (n, 3) and of the ``plane`` (2,): the mean of these parts
        over the undeformed section and the shift add up to the motion.
        """
        sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
        along, up = displacement[self.plane.nodes, 0], displacement[self.plane.nodes, 2]
        rises = sine * (along - plane[1]) + cosine * up
        parts: Reals = sine * rises + plane[0] * cosine * self.gains(state)
        return parts

    def rates(self, state: State, numbering: Numbering) -> Reals:
        """Derivatives (2, m) of the motion by the unknowns."""
        tilt = state.plane[0]
        rates, rises = np.zeros((2, numbering.size)), np.zeros(state.displacement.shape)
        rises[self.plane.nodes, 2] = self.shares * np.sin(tilt)
        rates[1] = numbering.gather(rises)
        rates[1, numbering.plane] = self.gain(state) * np.cos(tilt), 1.0
        rates[0, numbering.plane[0]] = 1.0
        return rates


@dataclass(frozen=True)
class SectionLoads:
    """Couple (N mm) and axial force (N) on a section, ``loads`` (2,).

    ``entries`` (k + 1,): where each node's height and the tilt, and last the tilt with itself, meet
    in the tangent; -1 for a height that is given.
    """

    section: Section
    loads: Reals
    numbering: Numbering
    entries: Integers

    @staticmethod
    def of(problem: Problem, numbering: Numbering, pattern: Pattern) -> SectionLoads | None:
        """The loads of a problem; None without any."""
        section, loads = Section.of(problem), plane_loads(problem.loads)
        if section is None or not loads.any():
            return None
        tilt = numbering.plane[0]
        heights = numbering.displacement[section.plane.nodes, 2]
        pairs = np.stack([heights, np.full_like(heights, tilt)], axis=1)
        both = pattern.entries(np.array([[tilt]], np.int32))[:, 0]
        return SectionLoads(
            section, loads, numbering, np.concatenate([pattern.entries(pairs)[:, 1], both])
        )

    def force(self, state: State) -> Reals:
        """Their forces (m,) on the unknowns."""
        force: Reals = self.loads @ self.section.rates(state, self.numbering)
        return force

    def add_tangent(self, state: State, load: float, values: Reals) -> None:
        """Add minus the derivative of ``load`` times the forces to CSR values."""
        tilt, axial = state.plane[0], load * self.loads[1]
        bends = np.append(
            self.section.shares * np.cos(tilt), -self.section.gain(state) * np.sin(tilt)
        )
        free = self.entries >= 0
        values[self.entries[free]] -= axial * bends[free]


def section_work(problem: Problem, state: State) -> float:
    """Work of the whole loads on a section on the straight way from rest, N mm."""
    section = Section.of(problem)
    return 0.0 if section is None else float(plane_loads(problem.loads) @ section.motion(state))


def _nodal_areas(mesh: Mesh, surface: str) -> Reals:
    """Integrals (n,) of the nodes' shape functions over an undeformed surface, mm^2."""
    rule, triangles = triangle_rule(), mesh.triangles(surface)
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[triangles])
    sizes = np.linalg.norm(np.cross(tangents[0], tangents[1]), axis=-1)
    areas = np.zeros(len(mesh.nodes))
    np.add.at(areas, triangles, np.einsum("q,kq,qa->ka", rule.weights, sizes, rule.quadratic))
    return areas
