"""Responses of a body: values, and derivatives by positions, displacements and the plane's tilt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.pressure import enclosed_volume
from solver.nonlinear.finite_motion import rotation, turn_of
from solver.problem.problem import Problem
from solver.sensitivity.smooth_peak import PeakRegion
from solver.sensitivity.surface_integrals import volume_derivative
from solver.sensitivity.work import Derivatives, Equilibrated

ROTATION, VOLUME, PEAK = "rotation", "volume", "peak_stress"

TIP = "tip"
"""The surface whose rotation is meant where there is no moving plane."""


@dataclass(frozen=True)
class Response:
    """A scalar at a state: its ``value``, and derivatives at fixed unknowns' meaning.

    ``explicit``: by positions and displacements; ``by_tilt``: by the tilt of the moving plane
    (rad), besides that of displacements.
    """

    name: str
    value: float
    explicit: Derivatives
    by_tilt: float = 0.0


def available(problem: Problem) -> tuple[str, ...]:
    """Names of the responses that a problem has."""
    turns = problem.moving_plane is not None or len(problem.mesh.surfaces.get(TIP, ())) > 0
    names = {ROTATION: turns, VOLUME: bool(problem.pressurised), PEAK: True}
    return tuple(name for name, there in names.items() if there)


def response(name: str, at: Equilibrated, region: PeakRegion) -> Response:
    """The response of that name."""
    if name == ROTATION:
        return _rotation(at)
    if name == VOLUME:
        return _volume(at)
    displacement = at.state.displacement
    explicit = Derivatives(*region.derivatives(displacement))
    return Response(name, region.value(region.body, displacement), explicit)


def _volume(at: Equilibrated) -> Response:
    problem = at.assembly.problem
    surfaces = problem.pressurised
    value = enclosed_volume(problem.mesh, at.state.displacement, surfaces)
    derivative = volume_derivative(at.positions, problem.mesh.triangles(*surfaces))
    return Response(VOLUME, value, Derivatives(derivative, derivative))


def _rotation(at: Equilibrated) -> Response:
    mesh, state = at.assembly.problem.mesh, at.state
    none = np.zeros_like(state.displacement)
    if at.assembly.plane is not None:
        nothing, degrees = Derivatives(none, none), float(np.degrees(1.0))
        return Response(ROTATION, float(np.degrees(state.plane[0])), nothing, degrees)
    nodes = mesh.surface_nodes(TIP)
    before, after = none.copy(), none.copy()
    parts = rotation_derivatives(mesh.nodes[nodes], state.displacement[nodes])
    before[nodes], after[nodes] = np.degrees(parts)
    value = rotation(mesh, state.displacement, TIP)
    return Response(ROTATION, value, Derivatives(before + after, after))


def rotation_derivatives(nodes: Reals, displacement: Reals) -> tuple[Reals, Reals]:
    """Derivatives (k, 3) of the best-fit rotation about y by positions before and after, 1/mm.

    The rotation is a function of M = sum of a b^T over centred positions after (a) and before (b).
    In the plane it is the angle of M itself, and in space that of M's rotation R (polar
    decomposition M = R S), which changes by R times the cross product with (tr(S) 1 - S)^-1 times
    the axial vector of R^T dM - dM^T R.
    """
    before = nodes - nodes.mean(axis=0)
    moved = nodes + displacement
    after = moved - moved.mean(axis=0)
    turn, in_space = turn_of(before, after)
    matrix = after.T @ before
    by_matrix = _by_turn(turn) if in_space else _by_turn(matrix)
    if in_space:
        by_matrix = _through_polar(turn, turn.T @ matrix, by_matrix)
    return after @ by_matrix, before @ by_matrix.T


def _by_turn(turn: Reals) -> Reals:
    """Derivative (3, 3) of arctan2(T_02 - T_20, T_00 + T_22)."""
    sine, cosine = turn[0, 2] - turn[2, 0], turn[0, 0] + turn[2, 2]
    derivative, size = np.zeros((3, 3)), sine**2 + cosine**2
    derivative[0, 2], derivative[2, 0] = cosine / size, -cosine / size
    derivative[0, 0] = derivative[2, 2] = -sine / size
    return derivative


def _through_polar(turn: Reals, stretch: Reals, by_turn: Reals) -> Reals:
    """Derivative (3, 3) by M = R S from that by R."""
    inverse = np.linalg.inv(np.trace(stretch) * np.eye(3) - stretch)
    local = turn.T @ by_turn
    axial = inverse.T @ _axial(local - local.T)
    return turn @ _cross_matrix(axial)


def _axial(skew: Reals) -> Reals:
    """The vector w of a skew matrix [w]x."""
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def _cross_matrix(w: Reals) -> Reals:
    """[w]x, with [w]x v = w cross v."""
    return np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
