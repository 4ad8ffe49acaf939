"""Energy of an equilibrium.

It is the energy of the discrete body: the residual is its derivative. So it is stationary in a
computed equilibrium, and equal to the work on the way there (``solver.results.work``), whatever the
mesh.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.assembly.assembly import solid
from solver.assembly.free_rim import free_edges, place_of
from solver.assembly.membranes.membranes import Membranes
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.section import section_work
from solver.assembly.swept_volume import swept_volume
from solver.errors import SolverError
from solver.kernels.assembly import total_energy
from solver.problem.loads import nodal_forces
from solver.problem.springs import stiffness_matrix
from solver.results.remaining import moved_unknowns, remaining_forces
from solver.results.solution import Solution, check_solution


@dataclass(frozen=True)
class Potential:
    """Potential energy of an equilibrium; each part is zero in the undeformed body.

    Attributes:
        strain: stored in the body, N mm.
        springs: stored in the springs, N mm.
        membranes: stored in the membranes, N mm.
        contacts: stored in the penetration of contacts, N mm; it vanishes with their depth.
        loads: of dead loads and pressure, N mm: minus the work that they would do at their present
            size on the straight way from the undeformed body.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, potential, solve
        >>> from solver.mesh import block
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> pull = Traction("x1", (0.01, 0, 0))
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), Ogden.neo_hooke(0.5), held, loads=(pull,))
        >>> energy = potential(solve(bar))
        >>> print(f"{energy.loads / energy.strain:.2f}")  # nearly -2, as small strains are linear
        -2.00
    """

    strain: float
    springs: float
    membranes: float
    contacts: float
    loads: float

    @property
    def stored(self) -> float:
        """In body, springs, membranes and contacts together, N mm."""
        return self.strain + self.springs + self.membranes + self.contacts

    @property
    def total(self) -> float:
        """Stored energy and potential of the loads together, N mm."""
        return self.stored + self.loads


def strain_energy(solution: Solution) -> float:
    """Energy stored in the body, with that of the change of volume.

    Args:
        solution: an equilibrium.

    Returns:
        N mm; of a symmetric part its own share.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve, strain_energy
        >>> from solver.mesh import block
        >>> held, pull = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), Traction("x1", (0.1, 0, 0))
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> bar = solve(Problem(block((30, 4, 4), (6, 1, 1)), rubber, held, loads=(pull,)))
        >>> stretch = 1 + bar.displacement[:, 0].max() / 30
        >>> density = 0.5 / 2 * (stretch**2 + 2 / stretch - 3)  # of the neo-Hookean law, N/mm^2
        >>> print(f"{strain_energy(bar):.4f}, {density * 30 * 4 * 4:.4f} N mm")
        1.7493, 1.7493 N mm
    """
    check_solution(solution)
    state = solution.state
    displacement = np.ascontiguousarray(state.displacement)
    return float(total_energy(solid(solution.problem), displacement, state.hydrostatic_pressure)[0])


def potential(solution: Solution) -> Potential:
    """Potential energy of an equilibrium, part by part.

    Their ``total`` is stationary against all motions that the supports allow, at constant loads.

    Args:
        solution: an equilibrium.

    Returns:
        Energies, zero in the undeformed body; of a symmetric part its own share.

    Raises:
        SolverError: there is pressure on a surface with a free rim: the work of the pressure then
            depends on the way, and it has no potential (``work`` holds there too).

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, potential, solve
        >>> from solver.mesh import block
        >>> held, pull = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), Traction("x1", (0.1, 0, 0))
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), Ogden.neo_hooke(0.5), held, loads=(pull,))
        >>> print(f"{potential(solve(bar)).total:.3f} N mm")  # below zero: the load has gone along
        -1.673 N mm
    """
    check_solution(solution)
    problem, state, load = solution.problem, solution.state, solution.load
    displacement = state.displacement.ravel()
    stiffness = stiffness_matrix(problem.mesh, problem.springs)
    return Potential(
        strain=strain_energy(solution),
        springs=0.5 * float(displacement @ (stiffness @ displacement)),
        membranes=Membranes.of(problem).energy(state.displacement),
        contacts=float(sum(pair.energy(state, load) for pair in contact_pairs(problem))),
        loads=0.0 - _pressure_work(solution) - _dead_work(solution),
    )


def _pressure_work(solution: Solution) -> float:
    """Work of the present pressure on the way from the undeformed body, N mm."""
    problem, displacement = solution.problem, solution.displacement
    if not solution.pressure:
        return 0.0
    if len(free := free_edges(problem, displacement)):
        raise SolverError(
            "potential: the pressurised surfaces have a free rim, at "
            f"{place_of(problem.mesh, free)} mm, so that the "
            "work of the pressure depends on the way and it has no potential."
        )
    swept = swept_volume(problem, np.zeros_like(displacement), displacement)
    return solution.pressure * float(swept.sum())


def _dead_work(solution: Solution) -> float:
    """Work of the present dead loads on the way from the undeformed body, N mm."""
    loads, load = solution.problem.loads, solution.load
    forces = load * nodal_forces(solution.problem.mesh, loads)
    work = float((forces * solution.displacement).sum())
    left = remaining_forces(solution) * moved_unknowns(solution.problem, solution.state)
    return work + float(left.sum()) + load * section_work(solution.problem, solution.state)
