"""How a cell gives way to a transverse force: to first order, at an equilibrium.

The cell is half of a period of a chain, between its own plane of symmetry at x = 0 and the moving
plane. A transverse force Q (N, towards -z on the moving plane, constant along the chain) moves the
period antisymmetrically about x = 0: there y and z are held and x is free. The moment about the
origin of the section in the moving plane falls by the force times the cell's length l.

With t the tilt, Q has the parts Q sin(t) normal to the moving plane and -Q cos(t) along it. The
motion is taken apart into the answer s to that moment and that normal force, which is the cell's to
a couple and an axial force Q tan(t), symmetric about the moving plane, and the rest b, which is
antisymmetric about it: there the section slides along its plane as a whole, and warps. So b follows
from the tangent with these supports, loaded by what holds s at x = 0, and by a force Q / cos(t)
along the section. Walls that touch their images at the moving plane press each other no more and no
less in b. That is exact where the period is straight; where it is bent, the axial force's answer is
not quite symmetric about the moving plane, so that it holds up to terms of sin(t)^2.

A chain of rigid pieces that turn at the gaps' sections only, in proportion to the moment there,
overrates the bending under a moment that varies. That is subtracted, so that the slip makes up for
it: in a beam with the shear coefficient k of Cowper (The shear coefficient in Timoshenko's beam
theory, J. Appl. Mech. 33, 1966), which also goes by the mean motion of a section, it is

    Q (l / (k G A) - 2 l^3 / (3 E I)).

So it is of either sign.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_array, coo_array, csr_array

from solver.arrays import Reals
from solver.assembly.section import Section
from solver.errors import SolverError
from solver.linear.interface import SingularMatrix
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import Pattern
from solver.problem.unknowns import Numbering
from solver.results.solution import Solution
from solver.sensitivity.adjoint import TangentSystem, Workspace, check_equilibrium, inner
from solver.sensitivity.section.freedom import Freedom, axes_of_plane, middle_nodes
from solver.sensitivity.section.nodal_tangent import nodal_tangent
from solver.sensitivity.unknowns import Direction


def shear_compliance(
    solution: Solution, newton: Workspace | None = None, warps: bool = True
) -> float:
    """Slip of a cell's section towards -z per transverse force, mm/N; see the module.

    One factorization of the size of the cell's tangent. Of a symmetric part, per its own share of
    the force: half of the width slips twice as far under a Newton as all of it.

    Args:
        solution: a converged equilibrium of a cell with a moving plane and a plane of symmetry
            normal to x at x = 0.
        newton: as for ``section_response``.
        warps: whether the section does; without warping the slip is one that is too stiff, and says
            how much depends on it.

    Raises:
        SolverError: another kind of problem, a solution that is not converged, walls that touch
            their images at x = 0, or a tangent that is singular.

    Examples:
        >>> from solver import Ogden, Problem, Supports, shear_compliance, solve
        >>> from solver.mesh import block
        >>> cell = block((0.5, 0.5, 1.0), (4, 1, 4))
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "y1": 1})  # a beam in plane strain
        >>> beam = solve(Problem(cell, Ogden.neo_hooke(1.0), held, moving_plane="x1"))
        >>> cowper = 0.5 / (20 / 23 * 0.5) - 2 * 0.5**3 / (3 * 4 * 0.5 / 12)  # as the module has it
        >>> print(f"{shear_compliance(beam):.3f}, {cowper:.3f} mm/N")
        0.649, 0.650 mm/N
    """
    check_equilibrium(solution, "shear_compliance")
    section = Section.of(solution.problem)
    if section is None or not len(middle_nodes(solution)):
        raise SolverError(
            "shear_compliance: the cell needs a moving plane, and one of symmetry at x = 0."
        )
    matrix, numbering = nodal_tangent(solution)
    bent = _Bent.of(solution, section, newton)
    freedom = Freedom.of(solution, section, numbering, warps)
    rest = _rest(solution, section, matrix, numbering, freedom, bent.motion)
    _, tangent = axes_of_plane(solution)
    sliding = rest[numbering.displacement[section.plane.nodes]] @ tangent
    sunk = -bent.rise - float(section.shares @ sliding) * tangent[2]
    return float(sunk - bent.length * bent.turn)


@dataclass(frozen=True)
class _Bent:
    """The part s of the motion under Q = 1, in a cell of a ``length`` (mm).

    ``rise``: of the section's origin along z, mm; ``turn``: of the section by the axial force, rad,
    which the chain does not count.
    """

    motion: Direction
    length: float
    rise: float
    turn: float

    @staticmethod
    def of(solution: Solution, section: Section, newton: Workspace | None) -> _Bent:
        system, state = TangentSystem.of(solution, newton, "shear_compliance"), solution.state
        rates = section.rates(state, system.at.assembly.numbering)
        by_couple, by_force = (system.solve(rate)[0] for rate in rates)
        length = float(section.plane.positions[0, 0] + section.motion(state)[1])
        axial = float(np.tan(solution.plane[0]))
        vector = axial * by_force - length * by_couple
        motion = Direction.of(system.at.assembly, state, vector)
        turn = axial * inner(rates[0], by_force)
        return _Bent(motion, length, _rise(section, solution, motion), turn)


def _rest(
    solution: Solution,
    section: Section,
    matrix: csr_array,
    numbering: Numbering,
    freedom: Freedom,
    bent: Direction,
) -> Reals:
    """The part b (m,): y and z of s are taken back at x = 0, and what held it there."""
    motion = numbering.gather(bent.displacement)
    motion[numbering.pressure] = bent.hydrostatic_pressure
    middle = numbering.displacement[middle_nodes(solution)]
    given, load = np.zeros((2, numbering.size))
    given[middle[:, 1:]] = -motion[middle[:, 1:]]
    load[middle[:, 0]] = -(matrix @ motion)[middle[:, 0]]
    _, tangent = axes_of_plane(solution)
    along = -tangent / tangent[2]
    load[numbering.displacement[section.plane.nodes]] += section.shares[:, None] * along
    return given + _solved(matrix, freedom, load - matrix @ given)


def _rise(section: Section, solution: Solution, along: Direction) -> float:
    """Motion of the section's origin along z, mm: of the plane's point at a fixed mean height."""
    nodes, shares, tilt = section.plane.nodes, section.shares, solution.plane[0]
    below = float(shares @ section.plane.positions[:, 2])
    mean = float(shares @ along.displacement[nodes, 2])
    return mean + below * float(np.sin(tilt)) * along.plane[0]


def _solved(matrix: csr_array, freedom: Freedom, load: Reals) -> Reals:
    """Motion (m,) under a load (m,) among those that are free.

    Raises ``SolverError`` if the tangent is singular.
    """
    free, gauge = freedom.motions, freedom.gauge
    reduced, rows = free.T @ matrix @ free, gauge @ free
    count = rows.shape[0]
    whole = csr_array(block_array([[reduced, rows.T], [rows, csr_array((count, count))]]))
    right = np.concatenate([free.T @ load, np.zeros(count)])
    pattern, values = _upper(whole)
    solver = linear_solver()
    solver.analyze(pattern)
    try:
        solver.factorize(values)
    except SingularMatrix as error:
        raise SolverError(
            f"shear_compliance: the tangent is singular at this state ({error})."
        ) from error
    vector = solver.solve(right)
    for _ in range(REFINEMENTS):
        vector = vector + solver.solve(right - whole @ vector)
    motion: Reals = free @ vector[: free.shape[1]]
    return motion


REFINEMENTS = 2
"""Of a solution, whose factorization is less precise than the matrix."""


def _upper(matrix: csr_array) -> tuple[Pattern, Reals]:
    """Upper triangle with the whole diagonal, zeros included, and its values."""
    entries, size = matrix.tocoo(), matrix.shape[0]
    above, all_of_it = entries.row <= entries.col, np.arange(size)
    rows = np.concatenate([entries.row[above], all_of_it])
    columns = np.concatenate([entries.col[above], all_of_it])
    values = np.concatenate([entries.data[above], np.zeros(size)])
    upper = csr_array(coo_array((values, (rows, columns)), shape=matrix.shape))
    upper.sort_indices()
    pattern = Pattern(upper.indptr.astype(np.int32), upper.indices.astype(np.int32))
    return pattern, upper.data
