"""The case in FElupe: quadratic displacement, continuous linear pressure, as a two-field body.

FElupe has no pressure boundary on tetrahedra, and its own Ogden is differentiated by an
optional package; both come from here instead. The linear solver is PARDISO through pypardiso, for
symmetric matrices and with one analysis for all of them, else SciPy's SuperLU.
"""

from __future__ import annotations

from collections.abc import Callable

from case import Case, Integers, Progress, Reals, main, report

# isort: split
import felupe as fem
import numpy as np
from follower import FollowerPressure
from ogden import Principal
from scipy.sparse import csr_matrix, triu
from scipy.sparse.linalg import splu
from stepping import walk

VTK_ORDER = (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)
LinearSolver = Callable[[csr_matrix, Reals], Reals]


class IncompressibleOgden(fem.ConstitutiveMaterial):
    """The material for FElupe: fields F and p, evaluated in chunks by threads."""

    def __init__(self) -> None:
        self.x = [np.zeros(0)]
        self.parallel = True

    def _gradient(self, fields: list[Reals]) -> list[Reals]:
        """dW/dF (3, 3, q, c) and dW/dp (1, q, c)."""
        gradient, pressure, state = fields
        principal, hydrostatic = _principal(gradient, pressure)
        stress = _trailing(principal.piola(hydrostatic), (3, 3), gradient)
        return [stress, _trailing(principal.volume_ratio - 1, (1,), gradient), state]

    def _hessian(self, fields: list[Reals]) -> list[Reals]:
        """d2W of (F, F), (F, p) and (p, p)."""
        gradient, pressure, _ = fields
        principal, hydrostatic = _principal(gradient, pressure)
        tangent = _trailing(principal.tangent(hydrostatic), (3, 3, 3, 3), gradient)
        cofactor = _trailing(principal.cofactor(), (3, 3), gradient)
        return [tangent, cofactor, np.zeros((1, 1, *gradient.shape[2:]))]


def _principal(gradient: Reals, pressure: Reals) -> tuple[Principal, Reals]:
    """States and pressures (m,) at points given by FElupe's (3, 3, q, c) and (1, q, c)."""
    flat = np.ascontiguousarray(gradient.reshape(9, -1).T).reshape(-1, 3, 3)
    return Principal.of(flat), np.ascontiguousarray(pressure).ravel()


def _trailing(values: Reals, shape: tuple[int, ...], like: Reals) -> Reals:
    """Values (m, ...) in FElupe's order, with quadrature points and cells last."""
    return np.ascontiguousarray(values.reshape(len(values), -1).T).reshape(shape + like.shape[2:])


class FElupeModel:
    """The case as FElupe's mesh, fields and solid body."""

    def __init__(self, case: Case) -> None:
        mesh = fem.Mesh(case.nodes, case.tets[:, VTK_ORDER], "tetra10")
        region = fem.RegionQuadraticTetra(mesh)
        displacement = fem.Field(region, dim=3)
        self.field = fem.FieldContainer([displacement, fem.FieldDual(region)])
        self.solid = fem.SolidBody(IncompressibleOgden(), self.field)
        self.load = FollowerPressure(case.nodes, case.cavity)
        self.case = case
        self.size = case.nodes.size + self.field[1].values.size
        self.system: System | None = None

    def correct(self, unknowns: Reals, pressure: float) -> Reals:
        """One Newton correction, mm and MPa."""
        displacement = self.displacement(unknowns)
        self.field[0].values[:] = displacement
        self.field[1].values[:, 0] = unknowns[displacement.size :]
        residual = self.solid.assemble.vector(self.field, parallel=True).toarray().ravel()
        residual += pressure * self.load.forces(displacement, self.size)
        tangent = self.solid.assemble.matrix(parallel=True)
        if self.system is None:
            self.system = System(tangent, free_unknowns(self.case), self.load)
        stiffness = pressure * self.load.stiffness(displacement)
        return -self.system.solve(tangent, stiffness, residual)

    def displacement(self, unknowns: Reals) -> Reals:
        """Displacement (n, 3), mm."""
        return unknowns[: self.case.nodes.size].reshape(-1, 3)


def free_unknowns(case: Case) -> Integers:
    """Unknowns that are not prescribed: FElupe numbers pressures at mid-nodes too."""
    free = np.ones(case.nodes.shape, bool)
    free[case.root] = False
    free[case.symmetry, 1] = False
    return np.concatenate([np.flatnonzero(free), case.nodes.size + case.corners])


class System:
    """The linear system of the free unknowns: upper triangle of a tangent of constant pattern.

    Finds once which entries of FElupe's ``tangent`` and of the load's stiffness go where.
    """

    def __init__(self, tangent: csr_matrix, free: Integers, load: FollowerPressure) -> None:
        self.free = free
        numbered = csr_matrix(
            (np.arange(tangent.nnz) + 1.0, tangent.indices, tangent.indptr), tangent.shape
        )
        self.upper = triu(numbered[free][:, free], format="csr")
        self.upper.sort_indices()
        self.source = self.upper.data.astype(np.int64) - 1
        self.used, self.places = self._places(load, tangent.shape[0])
        self.name, self.linear = linear_solver()

    def _places(self, load: FollowerPressure, size: int) -> tuple[Integers, Integers]:
        """Which entries of the load's stiffness are used, and the positions they add to."""
        number = np.full(size, -1)
        number[self.free] = np.arange(len(self.free))
        rows, columns = number[load.rows], number[load.columns]
        used = np.flatnonzero((rows >= 0) & (columns >= rows))
        count = len(self.free)
        known = np.repeat(np.arange(count), np.diff(self.upper.indptr)) * count
        keys = rows[used] * count + columns[used]
        return used, np.searchsorted(known + self.upper.indices, keys)

    def solve(self, tangent: csr_matrix, stiffness: Reals, residual: Reals) -> Reals:
        """Solve for all unknowns, the prescribed ones being 0."""
        data = tangent.data[self.source]
        data += np.bincount(self.places, stiffness[self.used], minlength=len(data))
        self.upper.data = data
        result = np.zeros(len(residual))
        result[self.free] = self.linear(self.upper, residual[self.free])
        return result


def linear_solver() -> tuple[str, LinearSolver]:
    """Name and function of the fastest direct solver installed, given upper triangles."""
    try:
        return "PARDISO", pardiso()
    except ImportError:
        return "SuperLU", superlu


def superlu(upper: csr_matrix, right: Reals) -> Reals:
    """SciPy's SuperLU on the whole matrix."""
    return splu((upper + triu(upper, 1).T).tocsc()).solve(right)


def pardiso() -> LinearSolver:
    """PARDISO for symmetric indefinite matrices; ordered once, as the pattern never changes."""
    from pypardiso import PyPardisoSolver

    solver = PyPardisoSolver(mtype=-2)
    analysis, factorization_and_solution = 11, 23

    def solve(upper: csr_matrix, right: Reals) -> Reals:
        if solver.phase != factorization_and_solution:
            solver.set_phase(analysis)
            solver._call_pardiso(upper, right)
        solver.set_phase(factorization_and_solution)
        return solver._call_pardiso(upper, right)

    return solve


def run(case: Case, pressure: float) -> None:
    """Solve and report."""
    progress = Progress(case)
    model = FElupeModel(case)
    message = walk(model, np.zeros(model.size), pressure, progress)
    report("FElupe", fem.__version__, progress, f"{message}; {linear_solver()[0]}")


if __name__ == "__main__":
    main(run, __doc__)
