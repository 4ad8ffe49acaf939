"""Element sizes of the next mesh from the estimated errors of a solution.

Two criteria, of which the stricter one counts in each element:

- *energy*: the difference between an element's stress and the smoothed one (Zienkiewicz and Zhu,
  1987), as its norm over the element, shall be equal in all elements. It controls the errors of
  displacements and angles.
- *peak*: where the stress is close to its maximum, the difference itself shall be a small fraction
  of that. It controls the error of the reported stress.

Stresses are smoothed within each region, and each region has a maximum of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import Solution
from solver.results.stress import ElementStress, element_stress, von_mises


@dataclass(frozen=True)
class Refinement:
    """Targets of a refinement.

    - ``growth``: number of elements by the energy criterion, in multiples of the present one.
    - ``peak_tolerance``: wanted stress difference near the peak, as a fraction of the peak.
    - ``near_peak``: fraction of the peak above which an element counts as near it.
    """

    growth: float = 3.0
    peak_tolerance: float = 0.04
    near_peak: float = 0.75


STEP = 0.01
"""Sizes are rounded to steps of this ratio, so that rounding errors of the solution, which differ
from run to run, do not change the mesh."""

FINEST, COARSEST = 1 / 3, 1.3
"""Bounds of an element's new size in units of its old one: one error estimate supports no more."""

ENERGY_ORDER, STRESS_ORDER = 7 / 2, 2.0
"""Powers of the size in an element's error: stress of second order over a volume, or at a point."""


def refined_sizes(solution: Solution, refinement: Refinement) -> Reals:
    """Wanted edge lengths of the next mesh at the corners of this one, (n,), mm; 1 elsewhere."""
    mesh = solution.problem.mesh
    stress = element_stress(solution)
    by_energy = _energy_ratios(solution.problem, stress, refinement.growth)
    ratio = np.minimum(by_energy, _peak_ratios(solution, stress, refinement))
    sizes = np.log(ratio * mean_edges(mesh))
    corners = mesh.tets[:, :4]
    total = np.bincount(corners.ravel(), np.repeat(sizes, 4), len(mesh.nodes))
    count = np.bincount(corners.ravel(), minlength=len(mesh.nodes))
    steps = np.round(total / np.maximum(count, 1) / STEP)
    at_nodes: Reals = np.exp(STEP * steps)
    return at_nodes


def mean_edges(mesh: Mesh) -> Reals:
    """Mean length of the straight edges of each element, (e,), mm."""
    corners = mesh.nodes[mesh.tets[:, :4]]
    lengths = [np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a, b in TETRAHEDRON_EDGES]
    mean: Reals = np.mean(lengths, axis=0)
    return mean


def _energy_ratios(problem: Problem, stress: ElementStress, growth: float) -> Reals:
    """New over old sizes (e,) that spread the error evenly over ``growth`` times the elements.

    The energy of a stress goes with the inverse of the element's shear modulus.
    """
    mesh, moduli = problem.mesh, problem.distribution.tet_moduli
    squares = (von_mises(stress.jumps) ** 2).mean(axis=1) / (moduli / moduli.max())
    error = np.sqrt(np.maximum(squares * stress.volumes, 1e-300))

    def ratios(target: float) -> Reals:
        return np.clip((target / error) ** (1 / ENERGY_ORDER), FINEST, COARSEST)

    low, high = error.min() * 1e-6, error.max() * 1e6
    for _ in range(60):  # bisection: fewer elements the higher the target
        target = np.sqrt(low * high)
        enough = (ratios(target) ** -3).sum() > growth * len(mesh.tets)
        low, high = (target, high) if enough else (low, target)
    return ratios(high)


def _peak_ratios(solution: Solution, stress: ElementStress, refinement: Refinement) -> Reals:
    """New over old sizes (e,) that resolve the peak; ``COARSEST`` elsewhere."""
    mesh = solution.problem.mesh
    trusted = trusted_nodes(solution.problem)[mesh.tets]
    level = np.where(trusted, von_mises(stress.smoothed), 0.0)
    jumps = np.where(trusted, von_mises(stress.jumps), 0.0)
    peaks = np.zeros(len(mesh.region_names))
    np.maximum.at(peaks, mesh.region_of_tet, level.max(axis=1))
    peak = peaks[mesh.region_of_tet]
    near = (peak > 0) & ((level + jumps).max(axis=1) >= refinement.near_peak * peak)
    wanted = refinement.peak_tolerance * peak / np.maximum(jumps.max(axis=1), 1e-300)
    return np.where(near, np.clip(wanted ** (1 / STRESS_ORDER), FINEST, COARSEST), COARSEST)
