"""Folded elements of a deformed body: where its map from the undeformed one is not one-to-one.

The volume ratio J is the Jacobian of the deformed element over that of the undeformed one, both
cubic polynomials, the latter positive. A solve watches J at the quadrature points only, where it
enters the equations; an element may fold at a corner between them, as happens next to the rim of a
bonded face. The fields of such an element are those of an equilibrium of the mesh, not of a body:
what is read near it is not to be trusted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.jacobians import folded
from solver.mesh.mesh import Mesh


@dataclass(frozen=True)
class Folds:
    """Elements of a deformed body in which J is negative somewhere.

    Attributes:
        elements: their numbers, ascending.

            *Shape:* (k,).
        positions: of their centres in the undeformed body.

            *Shape:* (k, 3) in mm.

    Examples:
        >>> from solver import Ogden, Problem, Supports, folded_elements, solve
        >>> from solver.mesh import block
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0", "x1")), ("z1",))
        >>> folds = folded_elements(solve(bar, 0.002))
        >>> print(len(folds.elements), folds.positions.shape)
        0 (0, 3)
    """

    elements: Integers
    positions: Reals

    @property
    def warning(self) -> str:
        """One sentence with their number and a place; empty without any."""
        count = len(self.elements)
        if not count:
            return ""
        place = ", ".join(f"{x:.4g}" for x in self.positions[0])
        return (
            f"{count} element{'s are' if count > 1 else ' is'} folded (J < 0 in part of it), "
            f"{'the first ' if count > 1 else ''}at ({place}) mm of the undeformed body: "
            "stresses near there are not to be trusted."
        )


def folds_of(mesh: Mesh, displacement: Reals) -> Folds:
    """The folded elements of a mesh after displacements (n, 3), mm."""
    elements = folded(mesh.nodes + displacement, mesh.tets)
    return Folds(elements, mesh.nodes[mesh.tets[elements, :4]].mean(axis=1))


def folded_around(mesh: Mesh, folds: Folds, node: int) -> bool:
    """Whether an element is folded that contains a node, or that touches one which does."""
    ring = np.unique(mesh.tets[(mesh.tets == node).any(axis=1)])
    return bool(np.isin(mesh.tets[folds.elements], ring).any())
