"""Work that is done on a body along a path of equilibria."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import unbalanced_forces
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.section import Section
from solver.assembly.state import State
from solver.assembly.swept_volume import swept_volume
from solver.errors import SolverError
from solver.input_types import members_of
from solver.problem.loads import nodal_forces, plane_loads
from solver.problem.problem import Problem
from solver.problem.rigid_bodies import RigidBody
from solver.problem.supports import fixed_displacements
from solver.results.remaining import moved_unknowns, remaining_forces
from solver.results.solution import Solution


@dataclass(frozen=True)
class Work:
    """Work done on a body along a path, by what does it.

    Attributes:
        pressure: by the pressure, N mm.
        loads: by dead loads, and by what is left of a stage before, N mm.
        supports: by supports that are led, N mm.
        planes: by rigid planes, cylinders and spheres that move, N mm.

    Examples:
        >>> from solver import Ogden, Problem, Supports, potential, solve, work
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> problem = Problem(shell, rubber, held, ("cavity",))
        >>> blown = solve(problem, 0.1, stops=(0.025, 0.05, 0.075))
        >>> done = work((*blown.at_stops, blown))
        >>> print(f"{done.pressure:.2f} N mm done, {potential(blown).stored:.2f} N mm stored")
        0.23 N mm done, 0.23 N mm stored
    """

    pressure: float
    loads: float
    supports: float
    planes: float

    @property
    def total(self) -> float:
        """By all together, N mm."""
        return self.pressure + self.loads + self.supports + self.planes


def work(solutions: Sequence[Solution]) -> Work:
    """Work done on the way from the undeformed body through ``solutions``.

    By the trapezoidal rule from each to the next, so that the error falls with the square of their
    distance. The total is the energy that is stored at the last one (``Potential.stored``).

    Args:
        solutions: equilibria of one mesh in the order of the path, such as
            ``(*solution.at_stops, solution)``, also of several stages. Rigid bodies that stand in
            the same place of ``Problem.contacts`` are the same.

    Returns:
        The work; of a symmetric part its own share.

    Raises:
        SolverError: no solution, or solutions with different meshes or numbers of contacts.

    Examples:
        >>> from solver import Ogden, Problem, Supports, solve, work
        >>> from solver.mesh import block
        >>> led = {"x1": lambda at, load: at * 0 + (3 * load, 0, 0)}
        >>> pulled = Supports(("x0",), prescribed=led)
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), Ogden.neo_hooke(0.5), pulled)
        >>> end = solve(bar, stops=(0.25, 0.5, 0.75))
        >>> print(f"{work((*end.at_stops, end)).supports:.2f} N mm")  # of the support that is led
        3.52 N mm
    """
    given = members_of("work: solutions", solutions, (Solution,))
    solutions = [each for each in given if isinstance(each, Solution)]
    if not solutions:
        raise SolverError("work: needs at least one solution.")
    first = solutions[0].problem
    for problem in (solution.problem for solution in solutions):
        if not np.array_equal(problem.mesh.nodes, first.mesh.nodes):
            raise SolverError("work: the solutions must belong to one mesh.")
        if len(problem.contacts) != len(first.contacts):
            raise SolverError("work: the solutions must have the same number of contacts.")
    stations = [_Station.at_rest(first), *map(_Station.of, solutions)]
    return Work(*np.sum([_parts(*pair) for pair in pairwise(stations)], axis=0).tolist())


@dataclass(frozen=True)
class _Station:
    """What does work at a state.

    ``dead`` and ``supports``: nodal forces (n, 3), N; ``planes``: forces (k, 3) of rigid bodies and
    their places; ``remaining``: what is left of the stage before, and the unknowns (n + 1, 3) that
    it works on; ``section``: couple (N mm) and axial force (N) on the moving plane (2,), and what
    they work on: tilt and displacement of the section's origin.
    """

    problem: Problem
    pressure: float
    displacement: Reals
    dead: Reals
    supports: Reals
    planes: tuple[Reals, Reals]
    section: tuple[Reals, Reals]
    remaining: tuple[Reals, Reals]

    @staticmethod
    def at_rest(problem: Problem) -> _Station:
        """The undeformed body."""
        none, planes = (
            np.zeros(problem.mesh.nodes.shape),
            _planes(problem, State.zero(problem), 0.0),
        )
        unmoved = np.zeros((len(none) + 1, 3))
        section, remaining = (np.zeros(2), np.zeros(2)), (unmoved, unmoved)
        return _Station(problem, 0.0, none, none, none, planes, section, remaining)

    @staticmethod
    def of(solution: Solution) -> _Station:
        """An equilibrium."""
        problem, state, load = solution.problem, solution.state, solution.load
        return _Station(
            problem=problem,
            pressure=solution.pressure,
            displacement=state.displacement,
            dead=load * nodal_forces(problem.mesh, problem.loads),
            supports=_support_forces(solution),
            planes=_planes(problem, state, load),
            section=(load * plane_loads(problem.loads), _section_motion(problem, state)),
            remaining=(remaining_forces(solution), moved_unknowns(problem, state)),
        )


def _section_motion(problem: Problem, state: State) -> Reals:
    """Tilt and displacement of the origin of the section in the moving plane (2,)."""
    section = Section.of(problem)
    return np.zeros(2) if section is None else section.motion(state)


def _support_forces(solution: Solution) -> Reals:
    """Nodal forces (n, 3) of the supports, N; zeros in a cell, whose supports do no work."""
    problem = solution.problem
    if problem.moving_plane is not None:
        return np.zeros_like(solution.displacement)
    forces = unbalanced_forces(problem, solution.state, solution.pressure, solution.load)
    forces -= remaining_forces(solution)[:-1]
    return np.where(fixed_displacements(problem.mesh, problem.supports), forces, 0.0)


def _planes(problem: Problem, state: State, load: float) -> tuple[Reals, Reals]:
    """Forces (k, 3) of rigid bodies on the body, N, and their places, mm."""
    forces, points = np.zeros((2, len(problem.contacts), 3))
    for number, pair in enumerate(contact_pairs(problem)):
        if isinstance(pair.contact, RigidBody):
            forces[number] = pair.forces(state, load).sum(axis=0)
            points[number] = pair.contact.place(load)
    return forces, points


def _parts(a: _Station, b: _Station) -> Reals:
    """Work (4,) between two states in the order of ``Work``, N mm."""
    moved = b.displacement - a.displacement
    before, after = (swept_volume(s.problem, a.displacement, b.displacement) for s in (a, b))
    pressure = a.pressure * before[0] + b.pressure * after[1]
    loads = (a.dead + b.dead) * moved
    section = (a.section[0] + b.section[0]) * (b.section[1] - a.section[1])
    left = (a.remaining[0] + b.remaining[0]) * (b.remaining[1] - a.remaining[1])
    supports = (a.supports + b.supports) * moved
    planes = (a.planes[0] + b.planes[0]) * (b.planes[1] - a.planes[1])
    halves = [loads.sum() + section.sum() + left.sum(), supports.sum(), planes.sum()]
    return np.array([pressure, *(part / 2 for part in halves)])
