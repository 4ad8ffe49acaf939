"""Results of a solve: the path and its last equilibrium."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from solver.arrays import Reals
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.input_types import check_instance, names
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem
from solver.problem.vectors import check_displacement
from solver.results.folds import Folds, folds_of
from solver.results.membranes.forces import MembraneForces, forces_of

StopKind: TypeAlias = Literal["", "step", "limit", "guard", "budget"]
"""What ended a path before the whole load: no step succeeds, a limit point or bifurcation, a state
that the caller's guard does not accept, or a spent budget; empty at the whole load."""


@dataclass(frozen=True)
class PathPoint:
    """One equilibrium on an equilibrium path.

    Attributes:
        pressure: applied, MPa.
        rotation: of the moving plane or else of the surface ``tip`` about y, degrees, positive
            towards -z, past 360; NaN without either.
        iterations: of Newton's method in the step.
        max_von_mises: largest nodal von Mises stress, MPa.
        volume: inside the pressurised surfaces, mm^3, see ``enclosed_volume``.
        load: fraction of the whole load.
        stable: whether it is stable at constant load; None where the linear solver cannot tell.
        stable_at_volume: whether it is stable while its volume is held, on a path of ``inflate``;
            else, and where the linear solver cannot tell, None.

    Examples:
        >>> from solver import Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> problem = Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",))
        >>> blown = solve(problem, 0.1, stops=(0.05,))
        >>> for point in blown.path:
        ...     print(f"{point.pressure:.3f} MPa {point.volume:.1f} mm^3 {point.stable}")
        0.000 MPa 15.6 mm^3 True
        0.010 MPa 16.0 mm^3 True
        0.030 MPa 16.7 mm^3 True
        0.050 MPa 17.6 mm^3 True
        0.090 MPa 19.4 mm^3 True
        0.100 MPa 19.9 mm^3 True
    """

    pressure: float
    rotation: float
    iterations: int
    max_von_mises: float
    volume: float
    load: float = 1.0
    stable: bool | None = None
    stable_at_volume: bool | None = None


@dataclass(frozen=True)
class Solution:
    """The last equilibrium found of a problem: at the whole load exactly if ``converged``.

    Attributes:
        problem: the problem that was solved.
        pressure: applied, MPa.
        displacement: of the nodes.

            *Shape:* (n, 3) in mm.
        hydrostatic_pressure: at ``mesh.vertices``, positive in compression.

            *Shape:* (v,) in MPa.
        path: equilibria up to this one.
        converged: whether the whole load was reached.
        message: one sentence on how much of the load was reached, and why no more.
        newton_iterations: in all.
        factorizations: of the tangent, in all.
        load_steps: accepted ones.
        refused_steps: rejected ones.
        linear_solver: its name.
        negative_pivots: of the last tangent that was factorized; v where the state is stable, None
            if the linear solver cannot tell.
        seconds: of the solve, without those in which kernels were compiled.
        plane: tilt (rad) and shift (mm) of the moving plane, zeros without one.
        load: fraction of the whole load.
        limit: pressure at the limit point that ended the path, MPa (fraction of the load where
            there is no pressure), or of ``inflate`` the one beyond which the path is unstable at
            constant pressure; None without one.
        stopped_by: what ended the path; empty if ``converged``.
        at_stops: the equilibria at the stops that were asked for, as far as they were reached, in
            ascending order of the load; after a ``resume`` those behind the checkpoint.
        remaining_force: of the stage before, as dead forces on the nodes, at an equilibrium short
            of the whole load.

            *Shape:* (n, 3) in N; (0, 3) if there is none.
        remaining_plane: of the stage before, on tilt (N mm) and shift (N) of the moving plane; what
            ``remaining_force`` has of the plane's nodes along z acts on their heights in it.

            *Shape:* (2,).
        bifurcations: points on a path of ``inflate`` at which another branch begins.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> solution = solve(bar)
        >>> print(solution.converged, solution.stable, solution.message)
        True True reached 100 % of the load.
        >>> print(solution.displacement.shape == bar.mesh.nodes.shape)
        True
        >>> print(f"{solution.displacement[:, 2].min():.2f} mm")
        -4.16 mm
    """

    problem: Problem
    pressure: float
    displacement: Reals
    hydrostatic_pressure: Reals
    path: tuple[PathPoint, ...]
    converged: bool
    message: str
    newton_iterations: int
    factorizations: int
    load_steps: int
    refused_steps: int
    linear_solver: str
    negative_pivots: int | None
    seconds: float
    plane: tuple[float, float] = (0.0, 0.0)
    load: float = 1.0
    limit: float | None = None
    stopped_by: StopKind = ""
    at_stops: tuple[Solution, ...] = ()
    remaining_force: Reals = field(default_factory=lambda: np.zeros((0, 3)))
    remaining_plane: Reals = field(default_factory=lambda: np.zeros(2))
    bifurcations: tuple[PathPoint, ...] = ()

    @property
    def stable(self) -> bool | None:
        """Whether the state is stable at constant load; None if unknown."""
        return self.path[-1].stable

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what makes the result less reliable than it looks.

        Folded elements, and membranes in compression where real films would wrinkle.
        """
        folded = folds_of(self.problem.mesh, self.displacement).warning
        films = (each.warning for each in forces_of(self.problem, self.displacement))
        return tuple(text for text in (folded, *films) if text)

    @property
    def stable_at_volume(self) -> bool | None:
        """Whether a state of ``inflate`` is stable while its volume is held; None if unknown."""
        return self.path[-1].stable_at_volume

    @property
    def state(self) -> State:
        """Displacement, hydrostatic pressure and moving plane together."""
        return State(self.displacement, self.hydrostatic_pressure, np.array(self.plane))

    @property
    def rotation(self) -> float:
        """Rotation of moving plane or ``tip`` at the end of the path, degrees."""
        return self.path[-1].rotation


def check_solution(given: object) -> None:
    """Raise ``SolverError`` unless ``given`` is a solution."""
    check_instance("solution", given, Solution)


def folded_elements(solution: Solution) -> Folds:
    """Elements of the deformed body that are folded: with J < 0 somewhere, not at a node only.

    Args:
        solution: an equilibrium.

    Returns:
        The elements and where they lie; J is bounded all over each of them.

    Examples:
        >>> from solver import Ogden, Problem, Supports, folded_elements, solve
        >>> from solver.mesh import block
        >>> led = {"x1": lambda at, load: at * 0 - (4.5 * load, 0, 0)}
        >>> shut = Supports(("x0",), prescribed=led)
        >>> crushed = solve(Problem(block((6, 6, 6), (1, 1, 1)), Ogden.neo_hooke(0.5), shut))
        >>> print(crushed.load, len(folded_elements(crushed).elements))
        1.0 0
    """
    check_solution(solution)
    return folds_of(solution.problem.mesh, solution.displacement)


def membrane_forces(solution: Solution) -> tuple[MembraneForces, ...]:
    """Forces in the membranes of an equilibrium.

    Args:
        solution: an equilibrium.

    Returns:
        Those of each of ``Problem.membranes``, in their order.

    Examples:
        >>> from solver import Membrane, Ogden, Problem, Supports, Traction, membrane_forces, solve
        >>> from solver.mesh import block
        >>> film = Membrane("z0", young_modulus=500.0, poisson_ratio=0.3, thickness=0.05)
        >>> sheet, pull = block((10, 4, 0.1), (5, 2, 1)), Traction("x1", (1.0, 0, 0))
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> problem = Problem(sheet, Ogden.neo_hooke(0.1), held, loads=(pull,), membranes=(film,))
        >>> (forces,) = membrane_forces(solve(problem))
        >>> print(f"{forces.highest:.3f} N/mm")  # nearly the 1 MPa on 0.1 mm: the rubber is soft
        0.103 N/mm
    """
    check_solution(solution)
    return forces_of(solution.problem, solution.displacement)


def cavity_volume(mesh: Mesh, displacement: Reals, surfaces: tuple[str, ...]) -> float:
    """Volume of the cavity inside surfaces of the deformed mesh; of its half in a half model.

    Args:
        mesh: the undeformed body.
        displacement: of its nodes.

            *Shape:* (n, 3) in mm.
        surfaces: names of the surfaces around the cavity; see ``enclosed_volume`` for open ones.

    Returns:
        mm^3; negative for surfaces that face outwards, around the body.

    Raises:
        SolverError: an unknown surface, or displacements that are not of the mesh's nodes.

    Examples:
        >>> import numpy as np
        >>> from solver import cavity_volume
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (5, 5, 5), hollow=((1, 1, 1), (4, 4, 4)))
        >>> print(round(cavity_volume(shell, np.zeros_like(shell.nodes), ("cavity",)), 6), "mm^3")
        27.0 mm^3
    """
    check_instance("cavity_volume: mesh", mesh, Mesh)
    check_displacement("cavity_volume: displacement", displacement, len(mesh.nodes))
    each_once = tuple(dict.fromkeys(names("cavity_volume: surfaces", surfaces)))
    return enclosed_volume(mesh, displacement, each_once)
