"""The whole deformed actuator of an evaluation, as a body and as a surface."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import HALF, UNIT_CELL, shortened
from bellows_design.deformed.joined.chain import Chain
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.deformed.surface import SurfaceFrames
from bellows_design.deformed.whole import Whole, WholeSurface, stress_of, whole_of
from bellows_design.neighbours.record import NeighbourEvaluation
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.morphing.morpher import Morpher
    from solver import Solution

Found: TypeAlias = Evaluation | NeighbourEvaluation


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
        neighbours stand for the ends (``FREE_ENDS`` in ``analysis.wall_contact``), root and tip
        beyond the outermost gaps' middles are missing.
    """
    return Assembly.of(_anchor(found)).actuator(found)


def deformed_surface(found: Found) -> SurfaceFrames:
    """Its surface at rest and at the pressure that was reached.

    Who asks again and again, for neighbours of one evaluation, keeps an ``Assembly``.
    """
    return Assembly.of(_anchor(found)).surface(found)


@dataclass(frozen=True)
class Assembly:
    """How the whole actuator follows from what was solved, for an evaluation and its neighbours.

    Attributes:
        anchor: The ordinary evaluation that meshes and ends are of.
        whole: Which nodes of the solved bodies make up the actuator.
    """

    anchor: Evaluation
    whole: Whole

    @staticmethod
    def of(anchor: Evaluation) -> Assembly:
        """For an evaluation and its neighbours."""
        computation = anchor.computation
        ends = None if computation.ends is None else computation.ends.problem.mesh
        return Assembly(anchor, whole_of(anchor.design, computation.finest.problem.mesh, ends))

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
            np.array([0.0, found.bending_angle_deg]),
        )

    def _state(self, found: Found) -> ActuatorState:
        angle = float(np.radians(found.bending_angle_deg))
        return ActuatorState(BodyState.of(_solution(found)), self._ends_of(found.design), angle)

    def _ends_of(self, design: Design) -> BodyState | None:
        """The ends as solved, on the mesh moved to a neighbour if that is asked for."""
        if self._ends is None or design == self.anchor.design:
            return self._ends
        return replace(self._ends, nodes=self._morpher.mesh_of(self._short(design)).nodes)

    @cached_property
    def _ends(self) -> BodyState | None:
        ends = self.anchor.computation.ends
        return None if ends is None else BodyState.of(ends)

    @cached_property
    def _morpher(self) -> Morpher:
        """Moves the mesh of the ends to neighbours."""
        from bellows_design.morphing.morpher import Morpher

        ends, design = self.anchor.computation.ends, self.anchor.design
        assert ends is not None
        body = UNIT_CELL if self._free_ends else HALF
        return Morpher.of(self._short(design), body.name, ends.problem.mesh)

    @property
    def _free_ends(self) -> bool:
        """Whether a bubble without neighbours stands for the ends."""
        return isinstance(self.whole, Chain) and self.whole.ends.root.free

    def _short(self, design: Design) -> Design:
        """The design whose body the ends are."""
        return design if self._free_ends else shortened(design)

    @cached_property
    def _counted(self) -> NDArray[np.bool_]:
        """Which nodes are far from sharp edges; of new ones, those between such."""
        from solver.results.sharp_edges import trusted_nodes

        ends = self.anchor.computation.ends
        near = [
            None if each is None else (~trusted_nodes(each.problem)).astype(np.float64)
            for each in (self.anchor.computation.finest, ends)
        ]
        assert near[0] is not None
        doubtful = self.whole.assembled.values(self.whole.values(near[0], near[1]))
        return np.asarray(doubtful == 0)

    @cached_property
    def _surface(self) -> WholeSurface:
        return WholeSurface.of(self.whole)


def _anchor(found: Found) -> Evaluation:
    return found if isinstance(found, Evaluation) else found.anchor


def _solution(found: Found) -> Solution:
    return found.computation.finest if isinstance(found, Evaluation) else found.solution
