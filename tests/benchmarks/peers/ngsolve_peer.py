"""The case in NGSolve: quadratic displacement, continuous linear pressure.

NGSolve's eigenvalues have no second derivative, so the material is evaluated in NumPy at the four
quadrature points of each element and handed back as fields on NGSolve's integration rule space.
The linear solver is MKL's PARDISO for symmetric matrices where MKL is installed, else NGSolve's own
sparse Cholesky (L D L^T).
"""

from __future__ import annotations

from case import THREADS, Case, Integers, Progress, Reals, main, report

# isort: split
import netgen.meshing as netgen
import ngsolve as ngs
import numpy as np
from ngsolve import ds, dx
from ngsolve.comp import IntegrationRuleSpace
from ogden import Principal
from pyngcore import Flags
from stepping import walk

SURFACES = ("cavity", "root", "symmetry")
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))
PARDISO = {"ordering": "metis", "refinement": 1}


def mesh_of(case: Case) -> ngs.Mesh:
    """The mesh, whose edges are straight: NGSolve itself puts nodes in their middles."""
    number = np.full(len(case.nodes), -1)
    number[case.corners] = np.arange(len(case.corners))
    mesh = netgen.Mesh(dim=3)
    mesh.AddPoints(case.nodes[case.corners])
    mesh.AddElements(dim=3, index=1, data=number[case.tets[:, :4]].astype(np.int32))
    for index, name in enumerate(SURFACES, start=1):
        mesh.Add(netgen.FaceDescriptor(surfnr=index, domin=1, domout=0, bc=index))
        mesh.SetBCName(index - 1, name)
        triangles = number[case.surfaces[name][:, :3]]
        mesh.AddElements(dim=2, index=index, data=triangles.astype(np.int32))
    return ngs.Mesh(mesh)


def middles_of(case: Case, ends: Integers) -> Integers:
    """Node in the middle of each edge, given the nodes at its ends (k, 2)."""
    middles: dict[tuple[int, int], int] = {}
    for middle, (a, b) in enumerate(EDGES, start=4):
        pairs = np.sort(case.tets[:, (a, b)], axis=1).tolist()
        middles.update(zip(map(tuple, pairs), case.tets[:, middle].tolist(), strict=True))
    return np.array([middles[a, b] for a, b in np.sort(ends, axis=1).tolist()])


class NGSolveModel:
    """The case as NGSolve's spaces, fields at quadrature points, forms and factorization."""

    def __init__(self, case: Case) -> None:
        self.mesh = mesh_of(case)
        self.corners = case.corners
        ends = [[vertex.nr for vertex in edge.vertices] for edge in self.mesh.edges]
        self.ends = case.corners[np.array(ends)]
        self.middles = middles_of(case, self.ends)
        vectors = ngs.VectorH1(self.mesh, order=2, dirichlet="root", dirichlety="symmetry")
        self.space = vectors * ngs.H1(self.mesh, order=1)
        self.state = ngs.GridFunction(self.space)
        self.pressure = ngs.Parameter(0.0)
        self.bubble = self._bubble()
        self._make_fields()
        self.tangent, self.residual = self._tangent(), self._residual()
        self.inverse: ngs.BaseMatrix | None = None

    def _make_fields(self) -> None:
        """Fields at quadrature points: the state (F, p), and what the material answers."""
        points = IntegrationRuleSpace(self.mesh, order=1)
        self.volume = dx(intrules=points.GetIntegrationRules())
        self.kinematics = ngs.GridFunction(points**10)
        self.piola = ngs.GridFunction(ngs.MatrixValued(points, 3))
        self.cofactor = ngs.GridFunction(ngs.MatrixValued(points, 3))
        self.stiffness = ngs.GridFunction(ngs.MatrixValued(points, 9))
        self.dilation = ngs.GridFunction(points)
        displacement, hydrostatic = self.state.components
        gradient = ngs.Id(3) + ngs.Grad(displacement)
        self.seen = ngs.CF((gradient.Reshape((9,)), hydrostatic))

    def _tangent(self) -> ngs.BilinearForm:
        """Tangent of the solid, and of the load: the second variation of the cavity's volume."""
        (u, p), (v, q) = self.space.TnT()
        du, dv = ngs.Grad(u), ngs.Grad(v)
        flux = ngs.CacheCF(self.stiffness) * du.Reshape((9,))
        cofactor = ngs.CacheCF(self.cofactor)
        form = ngs.BilinearForm(self.space, symmetric=True)
        form += ngs.InnerProduct(flux, dv.Reshape((9,))) * self.volume
        form += p * ngs.InnerProduct(cofactor, dv) * self.volume
        form += q * ngs.InnerProduct(cofactor, du) * self.volume
        position = ngs.CF((ngs.x, ngs.y, ngs.z)) + u
        work = self.pressure / 3 * ngs.InnerProduct(position, normal(u))
        form += ngs.Variation(work * ds("cavity", bonus_intorder=2))
        return form

    def _residual(self) -> ngs.LinearForm:
        """Internal minus external forces, and the violation of J = 1."""
        v, q = self.space.TestFunction()
        inner = ngs.InnerProduct(self.piola, ngs.Grad(v)) + q * self.dilation
        outer = self.pressure * ngs.InnerProduct(normal(self.state.components[0]), v)
        form = ngs.LinearForm(self.space)
        form += inner * self.volume
        form += outer * ds("cavity", bonus_intorder=2)
        return form

    def correct(self, unknowns: Reals, pressure: float) -> Reals:
        """One Newton correction, mm and MPa."""
        self.state.vec.FV().NumPy()[:] = unknowns
        self.pressure.Set(pressure)
        with ngs.TaskManager():
            self._evaluate_material()
            self.tangent.AssembleLinearization(self.state.vec)
            self.residual.Assemble()
            self._factorize()
            correction = (self.inverse * self.residual.vec).Evaluate()
        return -np.array(correction.FV().NumPy())

    def _evaluate_material(self) -> None:
        """Fill the fields at quadrature points from the state."""
        self.kinematics.Interpolate(self.seen)
        state = self.kinematics.vec.FV().NumPy().reshape(10, -1)
        hydrostatic = state[9].copy()
        principal = Principal.of(np.ascontiguousarray(state[:9].T).reshape(-1, 3, 3))
        fill(self.piola, principal.piola(hydrostatic))
        fill(self.cofactor, principal.cofactor())
        fill(self.stiffness, principal.tangent(hydrostatic))
        fill(self.dilation, principal.volume_ratio - 1)

    def _factorize(self) -> None:
        """Factorize the tangent; the ordering is made once."""
        if self.inverse is not None:
            self.inverse.Update()
            return
        self.tangent.mat.inverse_flags = Flags(**PARDISO)
        free = self.space.FreeDofs()
        try:
            self.inverse = self.tangent.mat.Inverse(free, inverse="pardiso")
        except RuntimeError:
            self.inverse = self.tangent.mat.Inverse(free, inverse="sparsecholesky")

    def _bubble(self) -> float:
        """Value of NGSolve's quadratic edge functions in the middle of their edges."""
        first = self.mesh[ngs.NodeId(ngs.EDGE, 0)]
        self.state.vec.FV().NumPy()[:] = 0.0
        self.state.vec.FV().NumPy()[self.mesh.nv] = 1.0
        middle = np.mean([self.mesh[vertex].point for vertex in first.vertices], axis=0)
        return self.state.components[0](self.mesh(*middle))[0]

    def displacement(self, unknowns: Reals) -> Reals:
        """Displacement (n, 3) at the case's nodes, mm, of NGSolve's hierarchical functions."""
        count = len(self.corners) + len(self.middles)
        values = unknowns[: 3 * count].reshape(3, -1).T
        result = np.zeros((count, 3))
        result[self.corners] = values[: len(self.corners)]
        bubbles = self.bubble * values[len(self.corners) :]
        result[self.middles] = result[self.ends].mean(axis=1) + bubbles
        return result


def normal(displacement: ngs.CoefficientFunction) -> ngs.CoefficientFunction:
    """Deformed normal of a surface out of the solid, per undeformed area."""
    gradient = ngs.Id(3) + ngs.Grad(displacement).Trace()
    return ngs.Cof(gradient) * ngs.specialcf.normal(3)


def fill(field: ngs.GridFunction, values: Reals) -> None:
    """Set a field on the integration rule space to values (m, ...) at its points."""
    components = values.reshape(len(values), -1).T
    field.vec.FV().NumPy().reshape(components.shape)[:] = components


def run(case: Case, pressure: float) -> None:
    """Solve and report."""
    ngs.SetNumThreads(THREADS)
    progress = Progress(case)
    model = NGSolveModel(case)
    message = walk(model, np.zeros(model.space.ndof), pressure, progress)
    report("NGSolve", ngs.__version__, progress, f"{message}; {type(model.inverse).__name__}")


if __name__ == "__main__":
    main(run, __doc__)
