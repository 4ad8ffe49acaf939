"""How the section between two cells answers to the loads on it, and to the pressure.

The potential of a cell with a moving plane is

    P(q) = U(q) - couple tilt - force shift - pressure (V(q) - V(0))

with U stored in body and contacts, and V the enclosed volume. In equilibrium P is stationary in all
unknowns q. So the complementary energy pressure V(0) - P has the derivatives tilt, shift and V by
couple, force and pressure, and their derivatives are

    b_i K^-1 b_j,   b = (derivatives of tilt, shift and V by q),

with the tangent K. The pressure's force is minus the derivative of V: no other volume, such as that
in a mesh of the cavity, would do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.pressure import enclosed_volume
from solver.assembly.section import Section
from solver.errors import SolverError
from solver.results.energy import potential
from solver.results.solution import Solution
from solver.sensitivity.adjoint import TangentSystem, Workspace, check_equilibrium, inner


@dataclass(frozen=True)
class SectionDerivatives:
    """A cell's section in equilibrium: where it is, and how it moves with small further loads.

    All is that of the cell: of a symmetric part its own share of volume and energy, under its own
    share of the loads.

    Attributes:
        tilt: of the moving plane, rad.
        shift: displacement along x of the section's origin, mm: of the moving plane's point that
            lies as far below the section's mean height as z = 0 does in the undeformed body. (Not
            ``Solution.plane``, which is where the plane meets z = 0, below or above a single node.)
        volume: enclosed by the pressurised surfaces, mm^3.
        volume_at_rest: in the undeformed cell, mm^3.
        pressure: MPa.
        potential: ``Potential.total``, N mm.
        derivatives: of tilt, shift and volume (rows) by couple, axial force and pressure (columns,
            per N mm, N and MPa), symmetric.

            *Shape:* (3, 3).
        residual: largest relative residual of the three linear systems.
        factorizations: how many were made, 0 if that at hand was enough.

    Examples:
        >>> from solver import Ogden, Problem, Supports, section_response, solve
        >>> from solver.mesh import block
        >>> cell = block((3, 4, 4), (2, 2, 2), hollow=((0, 0, 0), (2, 1, 1)))  # a quarter of a tube
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> tube = solve(Problem(cell, rubber, held, ("cavity",), moving_plane="x1"), 0.02)
        >>> found = section_response(tube)
        >>> print(f"{found.derivatives[1, 1]:.4f} mm/N")  # shift by axial force
        0.7707 mm/N
    """

    tilt: float
    shift: float
    volume: float
    volume_at_rest: float
    pressure: float
    potential: float
    derivatives: Reals
    residual: float
    factorizations: int

    @property
    def complementary_energy(self) -> float:
        """N mm; its derivatives by couple, axial force and pressure are tilt, shift and volume."""
        return self.pressure * self.volume_at_rest - self.potential


def section_response(solution: Solution, newton: Workspace | None = None) -> SectionDerivatives:
    """Answer of the moving plane and the cavity to couple, axial force and pressure.

    Three solutions of a linear system.

    Args:
        solution: a converged equilibrium of a problem with a moving plane.
        newton: what the solve left, as in ``Neighbouring.newton``: its last factorization is of
            this state or one nearby. Without it one is made.

    Returns:
        The section's motion and its derivatives.

    Raises:
        SolverError: a problem without a moving plane, a solution that is not converged, or a
            tangent that is singular.

    Examples:
        >>> from solver import AxialForce, Ogden, Problem, Supports, section_response, solve
        >>> from solver.mesh import block
        >>> cell, rubber = block((3, 4, 4), (1, 2, 2)), Ogden.neo_hooke(0.5)
        >>> held = Supports(symmetry={"x0": 0, "y0": 1})
        >>> def under(force):
        ...     pull = (AxialForce(force),)
        ...     problem = Problem(cell, rubber, held, loads=pull, moving_plane="x1")
        ...     return section_response(solve(problem))
        >>> behind, here, ahead = map(under, (0.99, 1.0, 1.01))
        >>> print(f"{here.derivatives[1, 1]:.4f}, {(ahead.shift - behind.shift) / 0.02:.4f} mm/N")
        0.5320, 0.5320 mm/N
    """
    check_equilibrium(solution, "section_response")
    problem = solution.problem
    section = Section.of(problem)
    if section is None:
        raise SolverError("section_response: the problem has no moving plane.")
    system = TangentSystem.of(solution, newton, "section_response")
    rows = _rows(system, section)
    solved = [system.solve(row) for row in rows]
    tilt, shift = section.motion(solution.state).tolist()
    none = np.zeros_like(solution.displacement)
    return SectionDerivatives(
        tilt=tilt,
        shift=shift,
        volume=enclosed_volume(problem.mesh, solution.displacement, problem.pressurised),
        volume_at_rest=enclosed_volume(problem.mesh, none, problem.pressurised),
        pressure=solution.pressure,
        potential=potential(solution).total,
        derivatives=np.array([[inner(row, vector) for vector, _ in solved] for row in rows]),
        residual=max(residual for _, residual in solved),
        factorizations=system.factorizations,
    )


def _rows(system: TangentSystem, section: Section) -> Reals:
    """Derivatives (3, m) of tilt, shift and volume by the unknowns."""
    rates = section.rates(system.at.state, system.at.assembly.numbering)
    return np.vstack([rates, -system.equilibrium.force])
