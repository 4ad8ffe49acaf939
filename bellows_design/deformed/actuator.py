"""The whole deformed actuator of an evaluation, as a body and as a surface."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import HALF, UNIT_CELL
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.deformed.solved import Found, SolvedBodies, anchor_of, reached
from bellows_design.deformed.surface import SurfaceFrames
from bellows_design.deformed.whole import Whole, WholeSurface, stress_of, whole_of
from bellows_design.errors import DesignError
from bellows_design.neighbours.record import NeighbourEvaluation
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.morphing.morpher import Morpher
    from solver import Solution


@dataclass(frozen=True)
class DeformedActuator:
    """The whole actuator under pressure: its root clamped where it was, all bubbles, both sides.

    Attributes:
        mesh: undeformed, with the surfaces ``root``, ``tip``, ``outside`` and ``cavity``, which
            together bound the body. Nodes are shared where mirror images join, but not in the
            middles of the outermost bubbles where cell and ends do: there the two meshes lie
            against each other.
        displacement: of its nodes.

            *Shape:* (n, 3) in mm.
        von_mises: Cauchy stress at the nodes.

            *Shape:* (n,) in MPa.
        pressure_mpa: negative for a vacuum.
        counted: which nodes are farther from sharp edges than stress is read; see
            ``docs/accuracy.md``.

            *Shape:* (n,).

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> from bellows_design.deformed import DeformedActuator, deformed_actuator
        >>> body = deformed_actuator(evaluate(load_design("prototype_1")))
        >>> print(isinstance(body, DeformedActuator), sorted(body.mesh.surfaces))
        True ['cavity', 'outside', 'root', 'tip']
        >>> root = body.mesh.surface_nodes("root")
        >>> print(abs(body.displacement[root]).max() < 1e-9)  # mm: clamped
        True
    """

    mesh: Mesh
    displacement: Reals
    von_mises: Reals
    pressure_mpa: float
    counted: NDArray[np.bool_]


def deformed_actuator(found: Found) -> DeformedActuator:
    """The whole actuator on the finest mesh, at the pressure that was reached.

    Args:
        found: An evaluation; of a neighbour, with the ends of the one that it started from.

    Returns:
        The body as analysed: with its fingertip, without port and mount. Where bubbles without
        neighbours stand for the ends (``FREE_ENDS`` in ``analysis.wall_contact``), what lies beyond
        the outermost gaps' middles is drawn out from their section, without a fingertip, and its
        stress fades out: it was not solved for.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> from bellows_design.deformed import deformed_actuator
        >>> found = evaluate(load_design("prototype_1"))
        >>> body = deformed_actuator(found)
        >>> print(body.pressure_mpa == found.pressure_mpa, body.displacement.shape[1])
        True 3
    """
    return Assembly.of(anchor_of(found)).actuator(found)


def deformed_surface(found: Found) -> SurfaceFrames:
    """Its surface at rest and at the pressure that was reached, in mm and MPa.

    Who asks again and again, for neighbours of one evaluation, keeps an ``Assembly``.

    Args:
        found: An evaluation, or one of a neighbour.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> from bellows_design.deformed import deformed_surface
        >>> frames = deformed_surface(evaluate(load_design("prototype_1")))
        >>> print(len(frames.positions), frames.pressures_mpa)
        2 [0.  0.1]
    """
    return Assembly.of(anchor_of(found)).surface(found)


@dataclass(frozen=True)
class Assembly:
    """How the whole actuator follows from what was solved, for an evaluation and its neighbours.

    What is asked for it must be that evaluation, or have it as ``anchor``; a neighbour that was
    evaluated by itself (``fallback``) has another one. Else a ``DesignError`` says so.

    Attributes:
        anchor: The ordinary evaluation that meshes and ends are of.
        whole: Which nodes of the solved bodies make up the actuator.

    Examples:
        >>> from bellows_design import evaluate, load_design, varied
        >>> from bellows_design.deformed import Assembly
        >>> design = load_design("prototype_1")
        >>> first = evaluate(design)
        >>> assembly = Assembly.of(first)
        >>> wider = evaluate(varied(design, {"bubble_width": 20.2}), near=first)
        >>> rest = [assembly.surface(each).positions[0] for each in (first, wider)]
        >>> print(rest[0].shape == rest[1].shape, f"{(rest[1] - rest[0]).max():.2f} mm")
        True 0.10 mm
    """

    anchor: Evaluation
    whole: Whole

    @staticmethod
    def of(anchor: Evaluation) -> Assembly:
        """For an evaluation and its neighbours."""
        solved = SolvedBodies.of(anchor)
        ends = None if solved.ends is None else solved.ends.problem.mesh
        return Assembly(anchor, whole_of(anchor.design, solved.body.problem.mesh, ends))

    def actuator(self, found: Found) -> DeformedActuator:
        """The body, as ``deformed_actuator``; of the anchor or of a neighbour of it."""
        state, bellows = self._state(found), found.design.bellows
        whole = self.whole.assembled
        nodes = whole.positions(self.whole.at_rest(bellows, state))
        moved = whole.positions(self.whole.loaded(bellows, state))
        return DeformedActuator(
            Mesh(nodes, whole.tets, whole.surfaces),
            moved - nodes,
            whole.values(stress_of(self.whole, state)),
            found.pressure_mpa,
            self._counted,
        )

    def surface(self, found: Found) -> SurfaceFrames:
        """The surface, as ``deformed_surface``; of the anchor or of a neighbour of it."""
        state, bellows = self._state(found), found.design.bellows
        stress = self._surface.von_mises(state)
        return SurfaceFrames(
            self._surface.flat.triangles,
            np.stack([self._surface.at_rest(bellows, state), self._surface.loaded(bellows, state)]),
            np.stack([0 * stress, stress]),
            np.array([0.0, found.pressure_mpa]),
            np.degrees([0.0, state.angle]),
        )

    def _state(self, found: Found) -> ActuatorState:
        if anchor_of(found) is not self.anchor:
            raise DesignError(
                f"assembly: the evaluation of {found.design.name} has other meshes: make an "
                "Assembly of that evaluation, or of its anchor."
            )
        if found.design == self.anchor.design:
            return self._reached
        assert isinstance(found, NeighbourEvaluation)
        body, angle = BodyState.of(found.solution), float(np.radians(found.bending_angle_deg))
        return ActuatorState(body, self._moved_ends(found.design), angle)

    @cached_property
    def _reached(self) -> ActuatorState:
        return reached(self.anchor)

    def _moved_ends(self, design: Design) -> BodyState | None:
        """The ends as solved, on the mesh moved to a neighbour."""
        ends = self._reached.ends
        if ends is None:
            return None
        moved = replace(self._solved, design=design).design_of_ends
        return replace(ends, nodes=self._morpher.mesh_of(moved).nodes)

    @property
    def _solved(self) -> SolvedBodies:
        return SolvedBodies.of(self.anchor)

    @cached_property
    def _morpher(self) -> Morpher:
        """Moves the mesh of the ends to neighbours."""
        from bellows_design.morphing.morpher import Morpher

        solved = self._solved
        assert solved.ends is not None
        body = UNIT_CELL if solved.free_ends else HALF
        return Morpher.of(solved.design_of_ends, body.name, solved.ends.problem.mesh)

    @cached_property
    def _counted(self) -> NDArray[np.bool_]:
        """Which nodes are far from sharp edges; of new ones, those between such."""
        solved = self._solved
        body, ends = _doubtful(solved.body), None if solved.ends is None else _doubtful(solved.ends)
        return np.asarray(self.whole.assembled.values(self.whole.values(body, ends)) == 0)

    @cached_property
    def _surface(self) -> WholeSurface:
        return WholeSurface.of(self.whole, self.anchor.design.bellows, self._solved.at_rest)


def _doubtful(solution: Solution) -> Reals:
    """1 at nodes (n,) whose stress does not count, else 0."""
    from solver.results.sharp_edges import trusted_nodes

    return (~trusted_nodes(solution.problem)).astype(np.float64)
