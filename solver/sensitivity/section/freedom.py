"""How a cell may move antisymmetrically: about its plane of symmetry at x = 0, and about the other.

At x = 0 nodes keep their y and z. The section in the moving plane slides along that as a whole, and
its points may move out of it: it warps. Neither a shift nor a turn of the whole cell matters, so
the section's mean shift and turn are none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, hstack

from solver.arrays import Reals
from solver.assembly.section import Section
from solver.problem.supports import axes_of
from solver.problem.unknowns import Numbering
from solver.results.solution import Solution


@dataclass(frozen=True)
class Freedom:
    """Motions (m, k) of the unknowns that are free, and ``gauge`` (g, m): what of them is none."""

    motions: csr_array
    gauge: csr_array

    @staticmethod
    def of(solution: Solution, section: Section, numbering: Numbering, warps: bool) -> Freedom:
        """The freedom of a cell whose section in the moving plane warps, or stays plane."""
        normal, tangent = axes_of_plane(solution)
        count = len(section.plane.nodes)
        parts = [
            _one_by_one(_unheld(solution, section, numbering), numbering.size),
            _along(section, numbering, tangent, np.zeros(count, np.int64)),
        ]
        if not warps:
            return Freedom(csr_array(hstack(parts)), csr_array((0, numbering.size)))
        parts.append(_along(section, numbering, normal, np.arange(count)))
        return Freedom(csr_array(hstack(parts)), _gauge(solution, section, numbering, normal))


def axes_of_plane(solution: Solution) -> tuple[Reals, Reals]:
    """Normal and upward tangent (3,) of the moving plane."""
    sine, cosine = np.sin(solution.plane[0]), np.cos(solution.plane[0])
    return np.array([cosine, 0.0, -sine]), np.array([sine, 0.0, cosine])


def middle_nodes(solution: Solution) -> NDArray[np.int64]:
    """Nodes (k,) on planes of symmetry normal to x."""
    return _nodes_held_along(solution, 0)


def _nodes_held_along(solution: Solution, axis: int) -> NDArray[np.int64]:
    problem = solution.problem
    held = [
        problem.mesh.surface_nodes(surface)
        for surface, axes in problem.supports.symmetry.items()
        if axis in axes_of(axes)
    ]
    return np.unique(np.concatenate([np.zeros(0, np.int64), *held]))


def _unheld(solution: Solution, section: Section, numbering: Numbering) -> NDArray[np.int64]:
    """Unknowns that are free by themselves: not those of the section's nodes."""
    numbers, held = numbering.displacement, np.zeros(numbering.size, bool)
    held[numbers[section.plane.nodes]] = True
    held[numbers[_nodes_held_along(solution, 1), 1]] = True
    held[numbers[middle_nodes(solution)][:, 1:]] = True
    return np.flatnonzero(~held)


def _one_by_one(unknowns: NDArray[np.int64], size: int) -> csr_array:
    """Motions (size, k) of one of the unknowns (k,) each."""
    count = len(unknowns)
    places = (unknowns, np.arange(count))
    return csr_array(coo_array((np.ones(count), places), shape=(size, count)))


def _along(
    section: Section, numbering: Numbering, direction: Reals, columns: NDArray[np.int64]
) -> csr_array:
    """Motions (m, k) of the section's nodes along a direction, in the column of each (k,)."""
    rows = numbering.displacement[section.plane.nodes][:, [0, 2]].ravel()
    values = np.tile(direction[[0, 2]], len(columns))
    shape = (numbering.size, int(columns.max()) + 1)
    return csr_array(coo_array((values, (rows, np.repeat(columns, 2))), shape=shape))


def _gauge(solution: Solution, section: Section, numbering: Numbering, normal: Reals) -> csr_array:
    """Rows (2, m): mean of the motions out of the plane, and their mean turn."""
    heights, shares = section.plane.heights(solution.state)[section.plane.nodes], section.shares
    arms = heights - shares @ heights
    rows = np.zeros((2, numbering.size))
    for row, weights in zip(rows, (shares, shares * arms / np.abs(arms).max()), strict=True):
        row[numbering.displacement[section.plane.nodes]] = weights[:, None] * normal
    return csr_array(rows)
