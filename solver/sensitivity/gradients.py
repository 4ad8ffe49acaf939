"""Gradients of responses: by the positions of all nodes, by the pressure, by given displacements.

With R(q, X, c) = 0 at equilibrium and the adjoint K^T a = r_q, a response r(q, X, c) changes by

    dr/dc = r_c - a . R_c

by any parameter c (the adjoint method: K. K. Choi and N. H. Kim, Structural Sensitivity Analysis
and Optimization 2, 2005, chapter 12). a . R is the virtual work along the direction a, so that for
all positions X together only the nodal gradient of that work is needed, once for each response
(``solver.sensitivity.work``); a parameter that moves the mesh is a scalar product with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import check_number, members_of
from solver.problem.problem import Problem
from solver.problem.supports import prescribed_motion
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import Solution
from solver.sensitivity.adjoint import TangentSystem, Workspace, check_equilibrium, inner
from solver.sensitivity.reach import reach_of
from solver.sensitivity.responses import Response, available, response
from solver.sensitivity.smooth_peak import SHARPNESS, PeakRegion, SmoothPeak
from solver.sensitivity.unknowns import Direction, carried, gathered, turned
from solver.sensitivity.work import Derivatives, Equilibrated, plane_forces, work_gradients

FLAT = 1e-6
"""Difference of the velocities along x of nodes on the moving plane, in largest velocities."""

STEP = 1e-6
"""Of the difference quotients of prescribed motions, in body diagonals."""


@dataclass(frozen=True)
class ResponseGradient:
    """A response and its derivatives at equilibrium.

    Attributes:
        value: of the response: degrees, mm^3 or MPa.
        nodes: by the positions of the undeformed nodes, per mm. On a moving plane all nodes move
            along x alike, so that only the sum of their derivatives along x has a meaning.

            *Shape:* (n, 3).
        given: by displacements that ``prescribed`` supports give, per mm; zero elsewhere.

            *Shape:* (n, 3).
        pressure: by the pressure, per MPa.
        adjoint: direction of the adjoint, for further derivatives.
        residual: relative residual of the adjoint.
        remaining: first-order change of the response by the residual that the solve has left.

    Examples:
        >>> from solver import Ogden, Problem, Supports, gradients, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> found = gradients(solve(Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",)), 0.05))
        >>> volume = found.responses["volume"]
        >>> larger = (volume.nodes * shell.nodes).sum()  # by the size of the whole body
        >>> print(f"{larger / volume.value:.4f}")
        3.0000
    """

    value: float
    nodes: Reals
    given: Reals
    pressure: float
    adjoint: Direction
    residual: float
    remaining: float


@dataclass(frozen=True)
class Gradients:
    """Gradients of several responses at one equilibrium.

    Attributes:
        solution: the equilibrium.
        at: its state and loads.
        responses: name -> gradient.
        region: nodes and elements of the smooth peak stress.
        smooth_peak: its value beside the peak's.
        reach: change of the loads, as a fraction of them, over which a first order holds, see
            ``solver.sensitivity.reach``; None without pressure and dead loads.
        factorizations: how many were made, 0 if that at hand was enough.

    Examples:
        >>> from solver import Ogden, Problem, Supports, gradients, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> found = gradients(solve(Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",)), 0.05))
        >>> print(sorted(found.responses))
        ['peak_stress', 'volume']
    """

    solution: Solution
    at: Equilibrated = field(repr=False)
    responses: Mapping[str, ResponseGradient]
    region: PeakRegion = field(repr=False)
    smooth_peak: SmoothPeak
    reach: float | None
    factorizations: int

    def along(self, velocity: Reals) -> dict[str, float]:
        """Derivatives of the responses by a parameter that moves the undeformed nodes.

        Args:
            velocity: of the nodes, mm per unit of the parameter. A moving plane must stay normal to
                x; other planes that supports or openings need, likewise.

                *Shape:* (n, 3).

        Returns:
            response -> derivative per unit of the parameter.

        Raises:
            SolverError: another shape, numbers that are not finite, a moving plane that turns.
        """
        problem = self.solution.problem
        _check_velocity(problem, velocity)
        rate = _given_rate(problem, self.solution.load, velocity)
        return {
            name: inner(each.nodes, velocity) + inner(each.given, rate)
            for name, each in self.responses.items()
        }


def gradients(
    solution: Solution,
    workspace: Workspace | None = None,
    responses: Sequence[str] = (),
    sharpness: float = SHARPNESS,
    counted: NDArray[np.bool_] | None = None,
) -> Gradients:
    """Gradients of responses of an equilibrium, by one adjoint solution each.

    Displacements that a stage of loading before has left to the supports count as given.

    Args:
        solution: a converged equilibrium, not between two stages.
        workspace: assembly and factorization at hand, of this state or one nearby; without one both
            are made.
        responses: ``rotation`` (degrees, of the moving plane or else of the surface ``tip``),
            ``volume`` (mm^3, inside the pressurised surfaces), ``peak_stress`` (MPa, a smooth
            maximum of the nodal von Mises stress); by default all that the problem has.
        sharpness: p of the smooth maximum, above 1.
        counted: nodes whose stress counts; by default all farther from sharp edges than the
            problem's ``sharp_edge_radius``.

            *Shape:* (n,).

    Returns:
        The gradients.

    Raises:
        SolverError: a solution that is not converged, a response that it does not have, or a
            tangent that is singular.

    Examples:
        >>> from solver import Ogden, Problem, Supports, gradients, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> problem = Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",))
        >>> found = gradients(solve(problem, 0.05), responses=("volume",))
        >>> ahead, behind = (solve(problem, 0.05 + step).path[-1].volume for step in (1e-4, -1e-4))
        >>> by_pressure = found.responses["volume"].pressure
        >>> print(f"{by_pressure:.2f}, {(ahead - behind) / 2e-4:.2f} mm^3/MPa")
        42.23, 42.23 mm^3/MPa
    """
    check_equilibrium(solution)
    check_number("sensitivities: sharpness", sharpness)
    if not 1 < sharpness < np.inf:
        raise SolverError(f"sensitivities: sharpness = {sharpness:g} must be above 1 and finite.")
    problem, displacement = solution.problem, solution.displacement
    names = _checked_names(problem, responses)
    system = TangentSystem.of(solution, workspace)
    mask = trusted_nodes(problem) if counted is None else _checked_mask(problem, counted)
    region = PeakRegion.of(problem, displacement, mask, sharpness)
    return Gradients(
        solution=solution,
        at=system.at,
        responses=_gradients(system, {name: response(name, system.at, region) for name in names}),
        region=region,
        smooth_peak=region.peak(displacement),
        reach=reach_of(system),
        factorizations=system.factorizations,
    )


@dataclass(frozen=True)
class _Adjoint:
    """Solution (m,) of the adjoint system of a response, as a direction, and its residual."""

    vector: Reals
    direction: Direction
    residual: float

    @staticmethod
    def of(system: TangentSystem, response: Response) -> _Adjoint:
        assembly, state = system.at.assembly, system.at.state
        by_unknowns = gathered(assembly, state, response.explicit.by_displacement)
        if response.by_tilt:
            by_unknowns[assembly.numbering.plane[0]] += response.by_tilt
        vector, residual = system.solve(by_unknowns, transposed=True)
        return _Adjoint(vector, Direction.of(assembly, state, vector), residual)


def _gradients(
    system: TangentSystem, responses: Mapping[str, Response]
) -> dict[str, ResponseGradient]:
    """Gradients of several responses, whose works share the solid's stress."""
    adjoints = [_Adjoint.of(system, each) for each in responses.values()]
    works = work_gradients(system.at, [each.direction for each in adjoints])
    has_plane = system.at.assembly.plane is not None
    forces = plane_forces(system.at) if has_plane else np.zeros_like(system.at.positions)
    return {
        name: _gradient(system, responses[name], adjoint, work, forces)
        for name, adjoint, work in zip(responses, adjoints, works, strict=True)
    }


def _gradient(
    system: TangentSystem, response: Response, adjoint: _Adjoint, work: Derivatives, forces: Reals
) -> ResponseGradient:
    """The gradient of a response; ``forces`` (n, 3) act on the moving plane."""
    assembly, state = system.at.assembly, system.at.state
    total = response.explicit - work
    nodes = total.by_position + carried(assembly, state, total.by_displacement)
    return ResponseGradient(
        value=response.value,
        nodes=nodes - turned(assembly, state, adjoint.direction, forces),
        given=np.where(_led(assembly.problem), total.by_displacement, 0.0),
        pressure=-inner(adjoint.vector, system.equilibrium.force),
        adjoint=adjoint.direction,
        residual=adjoint.residual,
        remaining=-inner(adjoint.vector, system.equilibrium.residual),
    )


def _led(problem: Problem) -> NDArray[np.bool_]:
    """Which displacements (n, 3) prescribed motions give."""
    led = np.zeros(problem.mesh.nodes.shape, bool)
    for surface in problem.supports.prescribed:
        motion = prescribed_motion(problem.mesh, problem.supports, surface, 1.0)
        led[problem.mesh.surface_nodes(surface)] |= ~np.isnan(motion)
    return led


def _given_rate(problem: Problem, load: float, velocity: Reals) -> Reals:
    """Rate (n, 3) of displacements that prescribed motions give, as the mesh moves."""
    rate, mesh = np.zeros_like(velocity), problem.mesh
    largest = np.abs(velocity).max(initial=0.0)
    if not problem.supports.prescribed or largest == 0:
        return rate
    step = STEP * mesh.size / largest
    ahead, behind = (mesh.moved(mesh.nodes + s * step * velocity) for s in (1, -1))
    for surface in problem.supports.prescribed:
        there, back = (
            prescribed_motion(each, problem.supports, surface, load) for each in (ahead, behind)
        )
        nodes = mesh.surface_nodes(surface)
        rate[nodes] = np.where(np.isnan(there), rate[nodes], (there - back) / (2 * step))
    return rate


def _checked_names(problem: Problem, responses: Sequence[str]) -> tuple[str, ...]:
    there = available(problem)
    asked = tuple(str(each) for each in members_of("sensitivities: responses", responses, (str,)))
    for name in asked:
        if name not in there:
            raise SolverError(
                f"sensitivities: the problem has no response {name!r}; it has {', '.join(there)}."
            )
    return tuple(dict.fromkeys(asked)) or there


def _checked_mask(problem: Problem, counted: NDArray[np.bool_]) -> NDArray[np.bool_]:
    given, size = np.asarray(counted), len(problem.mesh.nodes)
    if given.shape != (size,) or given.dtype.kind != "b":
        raise SolverError(
            f"sensitivities: counted must be a truth value for each of the {size} nodes, got "
            f"{given.dtype} of the shape {given.shape}."
        )
    return given


def _check_velocity(problem: Problem, velocity: Reals) -> None:
    nodes = problem.mesh.nodes
    given = np.asarray(velocity)
    if given.shape != nodes.shape or given.dtype.kind not in "fiu":
        raise SolverError(
            f"sensitivities: a velocity must be numbers of the shape {nodes.shape}, got "
            f"{given.shape}."
        )
    if not np.isfinite(given).all():
        raise SolverError("sensitivities: a velocity must be finite numbers of mm per unit.")
    if problem.moving_plane is None:
        return
    along = given[problem.mesh.surface_nodes(problem.moving_plane), 0]
    if np.ptp(along) > FLAT * np.abs(given).max():
        raise SolverError(
            "sensitivities: a velocity must move all nodes of the moving plane alike along x, got "
            f"{along.min():.6g} to {along.max():.6g} mm per unit."
        )
