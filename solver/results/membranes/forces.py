"""Forces in membranes, and where they are pressed together.

A real film buckles into wrinkles under the least compression, and bears next to none of it. So does
a ``Membrane``, but for one with ``wrinkles=False``, until the body under it is no longer stable.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.assembly.membranes import tension_field
from solver.assembly.membranes.membranes import SAMPLES, Membranes
from solver.assembly.membranes.response import as_tensors, components, frames, metrics
from solver.mesh.elements import TRIANGLE_EDGES, quadratic_gradients, triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane
from solver.problem.problem import Problem

COMPRESSED = 0.01
"""Compression, as a share of the largest principal force, from which on a triangle counts."""

UNSTRAINED = 1e-8
"""Compressive strain up to this one is what a solve leaves."""


@dataclass(frozen=True)
class MembraneForces:
    """Forces in a membrane per deformed length, at the centres of its triangles.

    Attributes:
        surface: name of its surface.
        principal: the larger and the smaller principal force of each triangle; positive in tension.

            *Shape:* (k, 2) in N/mm.
        positions: of the centres in the undeformed body.

            *Shape:* (k, 3) in mm.
        areas: of the undeformed triangles.

            *Shape:* (k,) in mm^2.
        stiffness: Young's modulus times thickness, N/mm.

    Examples:
        >>> from solver import Membrane, Ogden, Problem, Supports, Traction, membrane_forces, solve
        >>> from solver.mesh import block
        >>> bar, pull = block((30, 4, 4), (6, 1, 1)), Traction("x1", (0.01, 0, 0))
        >>> film = Membrane("z0", young_modulus=500.0, poisson_ratio=0.3, thickness=0.05)
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> problem = Problem(bar, rubber, Supports(("x0",)), loads=(pull,), membranes=(film,))
        >>> (forces,) = membrane_forces(solve(problem))
        >>> print(forces.principal.shape, forces.stiffness, "N/mm")
        (12, 2) 25.0 N/mm
    """

    surface: str
    principal: Reals
    positions: Reals
    areas: Reals
    stiffness: float

    @property
    def highest(self) -> float:
        """Largest principal force, N/mm; negative if all are compressive."""
        return float(self.principal.max())

    @property
    def lowest(self) -> float:
        """Smallest principal force, N/mm; negative in compression."""
        return float(self.principal.min())

    @property
    def compressed(self) -> NDArray[np.bool_]:
        """Triangles (k,) whose smaller force is a compression above 1 % of the largest force.

        And above 1e-8 of the stiffness, which is what a solve leaves.
        """
        largest = float(np.abs(self.principal).max())
        least = max(COMPRESSED * largest, UNSTRAINED * self.stiffness)
        return np.asarray(self.principal[:, 1] < -least)

    @property
    def warning(self) -> str:
        """One sentence on where a real film would wrinkle; empty if it would not."""
        compressed = self.compressed
        if not compressed.any():
            return ""
        share = self.areas[compressed].sum() / self.areas.sum()
        place = ", ".join(f"{x:.4g}" for x in self.positions[self.principal[:, 1].argmin()])
        return (
            f"the membrane {self.surface!r} is compressed over {100 * share:.0f} % of its area, "
            f"most by {-self.lowest:.3g} N/mm at ({place}) mm of the undeformed body: a real film "
            "wrinkles there and bears next to none of it."
        )


def forces_of(problem: Problem, displacement: Reals) -> tuple[MembraneForces, ...]:
    """Forces in the membranes of a problem after displacements (n, 3), mm."""
    return tuple(_forces(problem.mesh, each, displacement) for each in problem.membranes)


def _forces(mesh: Mesh, membrane: Membrane, displacement: Reals) -> MembraneForces:
    """Cauchy stress times thickness, S (1 + 2 E) t / sqrt(det (1 + 2 E)): its eigenvalues."""
    triangles = mesh.triangles(membrane.surface)
    frame = frames(_central_metrics(mesh.nodes, triangles))
    samples = Membranes.on(mesh, membrane).strains(displacement)
    centre = np.tensordot(2 * triangle_rule().weights, SAMPLES.basis, (0, 1))
    strain = components(frame, np.tensordot(samples, centre, 1))
    stress = as_tensors(tension_field.stress(membrane, strain))
    deformed = np.eye(2) + 2 * as_tensors(strain)
    principal = _eigenvalues(stress @ deformed) / np.sqrt(np.linalg.det(deformed))[:, None]
    centres = mesh.nodes[triangles[:, :3]].mean(axis=1)
    areas = _areas(mesh.nodes, triangles)
    return MembraneForces(membrane.surface, principal, centres, areas, membrane.stiffness)


def _areas(nodes: Reals, triangles: Integers) -> Reals:
    """Areas (k,) of curved triangles, mm^2."""
    metric, _ = metrics(nodes, triangles)
    return np.sqrt(np.linalg.det(metric)) @ triangle_rule().weights


def _central_metrics(nodes: Reals, triangles: Integers) -> Reals:
    """A_ab (k, 2, 2) at the centres of triangles, mm^2."""
    gradients = quadratic_gradients(np.full((1, 3), 1 / 3), TRIANGLE_EDGES)[0]
    tangents = np.einsum("ad,kai->kdi", gradients, nodes[triangles])
    metric: Reals = tangents @ tangents.swapaxes(1, 2)
    return metric


def _eigenvalues(tensors: Reals) -> Reals:
    """Real eigenvalues (k, 2) of mixed tensors (k, 2, 2), the larger ones first."""
    mean = np.trace(tensors, axis1=1, axis2=2) / 2
    across = np.sqrt(np.maximum(mean**2 - np.linalg.det(tensors), 0.0))
    return np.stack([mean + across, mean - across], axis=1)
