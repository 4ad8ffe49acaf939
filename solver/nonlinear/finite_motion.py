"""Finite motions of slender bodies: increments applied as finite rotations.

A Newton increment is linear in the nodes: added to a body that rotates by a finite angle, it
stretches the body. Along a known axis the increment defines a motion: at stations along the axis,
fit a translation and an in-plane rotation to the increment of the nodes around; place the segments
between stations end to end from the root with finite rotations; give each node the finite motion of
its stations, and the rotated remainder of its increment. To first order this is the increment
itself.

All rotations are about y, positive from z to x: a positive one turns +x towards -z.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.input_types import check_instance
from solver.mesh.mesh import Mesh
from solver.problem.problem import SlenderAxis
from solver.problem.vectors import check_displacement

Indices = NDArray[np.intp]

Motion = Callable[[Reals, Reals], Reals]
"""(displacement, increment) -> displacement after the increment, all (n, 3)."""


def motion_along(mesh: Mesh, axis: SlenderAxis | None) -> Motion:
    """How increments are applied: by finite rotations along an axis, by addition without one."""
    return np.add if axis is None else SlenderMotion.along(mesh, axis)


@dataclass(frozen=True)
class SlenderMotion:
    """Increments of a body with stations along x, applied as finite in-plane motions.

    ``nodes`` (n, 3); ``weights`` (n, s): share of each station's motion in a node's, linear
    between neighbouring stations.
    """

    nodes: Reals
    weights: Reals

    @staticmethod
    def along(mesh: Mesh, axis: SlenderAxis) -> SlenderMotion:
        """Interpolate linearly between the stations of ``axis``, constantly beyond them."""
        hats = np.eye(len(axis.stations))
        x = mesh.nodes[:, 0]
        weights = np.stack([np.interp(x, axis.stations, hat) for hat in hats], axis=1)
        return SlenderMotion(mesh.nodes, weights)

    def __call__(self, displacement: Reals, increment: Reals) -> Reals:
        """Displacement (n, 3) after a finite motion that is ``increment`` (n, 3) to first order."""
        plane = (self.nodes + displacement)[:, [0, 2]]
        step = increment[:, [0, 2]]
        centres, shifts, angles = self._fit(plane, step)
        w, angle = self.weights, self.weights @ angles
        linear = w @ (shifts - angles[:, None] * _quarter_turn(centres))
        linear += angle[:, None] * _quarter_turn(plane)
        finite = w @ (_placed_centres(centres, shifts, angles) - _turn(centres, angles))
        finite += (w @ np.cos(angles))[:, None] * plane
        finite += (w @ np.sin(angles))[:, None] * _quarter_turn(plane)
        result = displacement + increment
        result[:, [0, 2]] = finite + _turn(step - linear, angle) - self.nodes[:, [0, 2]]
        return result

    def _fit(self, plane: Reals, step: Reals) -> tuple[Reals, Reals, Reals]:
        """Centres (s, 2), their shifts (s, 2) and rotations (s,) of the least-squares motion.

        The first station, where the body is held, does not move.
        """
        w = self.weights
        total = w.sum(axis=0)[:, None]
        centres, shifts = w.T @ plane / total, w.T @ step / total
        lever = _quarter_turn(plane)
        moment = w.T @ (lever * step).sum(1) - total[:, 0] * (_quarter_turn(centres) * shifts).sum(
            1
        )
        inertia = w.T @ (plane**2).sum(1) - total[:, 0] * (centres**2).sum(1)
        angles = moment / inertia
        shifts[0], angles[0] = 0.0, 0.0
        return centres, shifts, angles


def _placed_centres(centres: Reals, shifts: Reals, angles: Reals) -> Reals:
    """New station centres (s, 2): segments stretched linearly, rotated and placed end to end."""
    segments = np.diff(centres, axis=0)
    mean = (angles[1:] + angles[:-1]) / 2
    stretches = np.diff(shifts, axis=0) - mean[:, None] * _quarter_turn(segments)
    turned = _turn(segments + stretches, mean)
    return np.cumsum(np.concatenate([centres[:1] + shifts[:1], turned]), axis=0)


def _quarter_turn(vectors: Reals) -> Reals:
    """(x, z) -> (z, -x): the velocity of a unit rotation about y."""
    return np.stack([vectors[:, 1], -vectors[:, 0]], axis=1)


def _turn(vectors: Reals, angles: Reals) -> Reals:
    """Vectors (k, 2) in (x, z) rotated by angles (k,) about y."""
    return np.cos(angles)[:, None] * vectors + np.sin(angles)[:, None] * _quarter_turn(vectors)


def rotation(mesh: Mesh, displacement: Reals, surface: str = "tip") -> float:
    """Rotation of a surface about y by best fit, whole turns included.

    The in-plane rotation of its nodes of least squares (Procrustes). Whole turns are counted along
    the body, whose neighbouring slices of nodes rotate little against each other, up to the surface
    from the end that has moved less. So the result is a function of the state alone. Where nodes
    are turned about another axis, as in torsion, their plane says nothing: there the rotation about
    y that is nearest to theirs in space counts.

    Args:
        mesh: the undeformed body; slices are normal to x, or to the axis along which it is more
            than twice as long.
        displacement: of its nodes.

            *Shape:* (n, 3) in mm.
        surface: name of the surface.

    Returns:
        Degrees, positive towards -z, past 180 and 360; NaN if the mesh has no such surface, or no
        triangles of it.

    Raises:
        SolverError: displacements that are not of the mesh's nodes.

    Examples:
        >>> import numpy as np
        >>> from solver import rotation
        >>> from solver.mesh import block
        >>> bar = block((30, 4, 4), (6, 1, 1))
        >>> cos, sin = np.cos(np.radians(30)), np.sin(np.radians(30))
        >>> turned = bar.nodes @ [[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]]
        >>> print(f"{rotation(bar, turned - bar.nodes, 'x1'):.1f} degrees")  # towards -z
        30.0 degrees
    """
    check_instance("rotation: mesh", mesh, Mesh)
    check_instance("rotation: surface", surface, str)
    check_displacement("rotation: displacement", displacement, len(mesh.nodes))
    if surface not in mesh.surfaces or not len(mesh.surfaces[surface]):
        return float("nan")
    own = mesh.surface_nodes(surface).astype(np.intp)
    parts = [*_slices_before(mesh, displacement, own), own]
    angles = [_best_fit_rotation(mesh.nodes[part], displacement[part]) for part in parts]
    return float(np.degrees(np.unwrap(angles)[-1]))


SLICES = 32

LEAST_NODES = 4
"""Of a slice."""

AT_REST = 0.5
"""Share of the motion of the lower end below which the upper end is the one that is held."""


def _slices_before(mesh: Mesh, displacement: Reals, surface: Indices) -> list[Indices]:
    """Nodes between the held end of a body and the nodes of a surface, slice by slice."""
    extents = np.ptp(mesh.nodes, axis=0)
    axis = 0 if 2 * extents[0] >= extents.max() else int(extents.argmax())
    places = mesh.nodes[:, axis]
    count = max(1, min(SLICES, len(places) // LEAST_NODES))
    slices = np.array_split(np.argsort(places, kind="stable"), count)
    lower, upper = (np.linalg.norm(displacement[end]) for end in (slices[0], slices[-1]))
    if upper < AT_REST * lower:
        slices, places = slices[::-1], -places
    here = places[surface].mean()
    return [part for part in slices if places[part].mean() < here]


ABOUT_Y = 0.5
"""Least cosine between y and its image for nodes to count as turned about y."""


def _best_fit_rotation(nodes: Reals, displacement: Reals) -> float:
    """Rotation about y, radians in [-pi, pi], of nodes (k, 3) by displacements (k, 3)."""
    before = nodes - nodes.mean(axis=0)
    moved = nodes + displacement
    after = moved - moved.mean(axis=0)
    turn, about_another_axis = turn_of(before, after)
    if about_another_axis:
        return _part_about_y(turn)
    before, after = before[:, [0, 2]], after[:, [0, 2]]
    return float(np.arctan2((_quarter_turn(before) * after).sum(), (before * after).sum()))


def turn_of(before: Reals, after: Reals) -> tuple[Reals, bool]:
    """Rotation (3, 3) in space between centred positions (k, 3), and whether it counts for y's.

    It does if they are turned about another axis, so that their plane says nothing.
    """
    turn = _rotation_in_space(before, after)
    return turn, bool(turn[1, 1] < ABOUT_Y)


def _part_about_y(turn: Reals) -> float:
    """Angle, radians, of the rotation about y nearest to one in space (3, 3); 0 if all are."""
    sine, cosine = turn[0, 2] - turn[2, 0], turn[0, 0] + turn[2, 2]
    return float(np.arctan2(sine, cosine)) if np.hypot(sine, cosine) > 1e-6 else 0.0


def _rotation_in_space(before: Reals, after: Reals) -> Reals:
    """Rotation (3, 3) of least squares from positions (k, 3) to others, without translation.

    Source: W. Kabsch, Acta Crystallographica A 32, 922, 1976.
    """
    left, _, right = np.linalg.svd(after.T @ before)
    left[:, 2] *= np.sign(np.linalg.det(left @ right))
    turn: Reals = left @ right
    return turn
