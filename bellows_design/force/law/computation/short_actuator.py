"""An actuator of one bubble under pressure and a couple at its tip: both ends of a finger at once.

The section in the middle of its bubble parts what belongs to the root from what belongs to the tip.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.interpolation.points import HALVES, SectionPoint
from bellows_design.geometry.face_names import TIP
from solver.arrays import Reals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bellows_design.design.bellows_parameters import BellowsParameters
    from solver import Mesh, Problem, Solution, Traction
    from solver.nonlinear.newton import Newton

BAND = 1 / 8
"""Of the pitch: half the width of the slice of nodes whose rotation is that of the middle.

They are those up to the tendon's height. With three bubbles of Prototype 1 at 0.1 MPa the root
turns by 17.1 degrees, as the gaps between bubbles tell; so taken by 17.5, with nodes of the whole
height by 21.1.
"""

SMALL_MOTION = 1e-4
"""Displacement in body diagonals by which derivatives of a section's place are found."""


@dataclass(frozen=True)
class EndPoint:
    """One end in equilibrium under a pressure and a moment, full width, without forces.

    Attributes:
        motion: rotation and extension of a ``SectionLaw``, rad and mm.

            *Shape:* (2,).
        compliance: its derivative by moment and axial force, symmetric.

            *Shape:* (2, 2).
        rate: its derivative by the pressure, per MPa.

            *Shape:* (2,).
        volume: air inside, mm^3.
    """

    motion: Reals
    compliance: Reals
    rate: Reals
    volume: float


@dataclass(frozen=True)
class SolvedEnds:
    """Root and tip at one pressure (MPa) and moment (N mm), with the state they were read from.

    ``point``: the same, where the state is of a cell.
    """

    pressure: float
    moment: float
    ends: tuple[EndPoint, EndPoint]
    solution: Solution
    point: SectionPoint | None = None


@dataclass(frozen=True)
class Sections:
    """Where the sections of a short actuator are: at the root, in the bubble's middle, at the tip.

    Attributes:
        mesh: of half of it.
        middle: nodes about the bubble's middle, up to the tendon's height.
        tip: nodes of the tip's face.
        places: of the middle and of the tip's face along x, mm.
        length: of half a bubble with half a gap, mm.
    """

    mesh: Mesh
    middle: NDArray[np.intp]
    tip: NDArray[np.intp]
    places: tuple[float, float]
    length: float

    @staticmethod
    def of(mesh: Mesh, bellows: BellowsParameters) -> Sections:
        """Those of ``bellows`` with one bubble."""
        middle, half = bellows.bubble_middles[0], bellows.pitch / 2
        near = np.abs(mesh.nodes[:, 0] - middle) < BAND * bellows.pitch
        near &= mesh.nodes[:, 2] <= bellows.tendon_height
        tip = mesh.surface_nodes(TIP).astype(np.intp)
        at_tip = float(mesh.nodes[tip, 0].mean())
        return Sections(mesh, np.flatnonzero(near), tip, (middle, at_tip), half)

    def motions(self, displacement: Reals) -> Reals:
        """Rotation and extension of root and tip, (2, 2).

        Where the middle lies along its own plane has no meaning, so that there is no slip.
        """
        turn, total = self.turns(displacement)
        (start, end), middle = self.gaps(displacement), self.middles_place(displacement)
        root, tip = (float(step @ normal(turn)) for step in (middle - start, end - middle))
        return np.array([[turn, root - self.length], [total - turn, tip - self.length]])

    def turns(self, displacement: Reals) -> tuple[float, float]:
        """Of the bubble's middle, and of the tip with whole turns, rad."""
        turn, total = self._turn(displacement, self.middle), self._turn(displacement, self.tip)
        return turn, total + 2 * np.pi * round((turn - total) / (2 * np.pi))

    def gaps(self, displacement: Reals) -> tuple[Reals, Reals]:
        """Origins (2,) of the sections between bubble and stubs."""
        middle, at_tip = self.places
        stub = at_tip - middle - self.length
        _, total = self.turns(displacement)
        end = self._origin(displacement, self.tip, at_tip, total) - stub * normal(total)
        return np.array([middle - self.length, 0.0]), end

    def middles_place(self, displacement: Reals) -> Reals:
        """Origin (2,) of the bubble's middle."""
        turn, _ = self.turns(displacement)
        return self._origin(displacement, self.middle, self.places[0], turn)

    def _turn(self, displacement: Reals, nodes: NDArray[np.intp]) -> float:
        """Rotation of least squares of nodes in the plane, rad."""
        before = self.mesh.nodes[nodes][:, [0, 2]]
        after = before + displacement[nodes][:, [0, 2]]
        before, after = before - before.mean(axis=0), after - after.mean(axis=0)
        sine = (before[:, 1] * after[:, 0] - before[:, 0] * after[:, 1]).sum()
        return float(np.arctan2(sine, (before * after).sum()))

    def _origin(
        self, displacement: Reals, nodes: NDArray[np.intp], place: float, turn: float
    ) -> Reals:
        """Where the point at z = 0 of the section at ``place`` is, by the mean of nodes, (2,)."""
        before = self.mesh.nodes[nodes][:, [0, 2]].mean(axis=0)
        moved: Reals = before + displacement[nodes][:, [0, 2]].mean(axis=0)
        return moved + (place - before[0]) * normal(turn) + before[1] * tangent(turn)


def normal(angle: float) -> Reals:
    """Of a section at an angle (rad), (2,)."""
    return np.array([np.cos(angle), -np.sin(angle)])


def tangent(angle: float) -> Reals:
    """Along a section, towards -z at no angle, (2,)."""
    return np.array([-np.sin(angle), -np.cos(angle)])


@dataclass
class ShortActuator:
    """Solves for an actuator of one bubble, from state to state.

    Attributes:
        problem: half of it, without a couple.
        sections: of its mesh.
        factorizations: so far.
    """

    problem: Problem
    sections: Sections
    factorizations: int = 0
    _newton: Newton | None = field(default=None, repr=False)
    _last: Solution | None = field(default=None, repr=False)

    def from_zero(self, pressures: Sequence[float]) -> list[SolvedEnds]:
        """Without a moment, in the order of the pressures' size. Raises ``BellowsError``."""
        from solver import solve

        ordered = sorted(pressures, key=abs)
        found = solve(self.problem, ordered[-1], stops=[each for each in ordered[:-1] if each])
        self.factorizations += found.factorizations
        if not found.converged:
            raise BellowsError(f"there is no law of the ends: {found.message}")
        at_rest = [solve(self.problem, 0.0)] if 0.0 in ordered else []
        return [self._read(each, 0.0, None) for each in (*at_rest, *found.at_stops, found)]

    def beside(self, near: SolvedEnds, moment: float) -> SolvedEnds | str:
        """At a moment (N mm, full width) from that of a neighbour, or why there is none."""
        from solver import neighbouring

        if near.solution is not self._last and self._newton is not None:
            self._newton.system.forget()
        softness = sum(end.compliance[0, 0] for end in near.ends)
        turn = self.sections.turns(near.solution.displacement)[1]
        turn += softness * (moment - near.moment)
        load = self._couple(moment / HALVES, turn)
        problem = replace(self.problem, loads=(load,))
        found = neighbouring(problem, near.pressure, near.solution, former=self._newton)
        self._newton, self._last = found.newton, found.solution
        self.factorizations += found.newton.effort.factorizations
        if found.solution is None:
            return found.failure
        if found.solution.stable is False:
            return "the equilibrium would be unstable"
        return self._read(found.solution, moment, found.newton)

    def _read(self, found: Solution, moment: float, newton: Newton | None) -> SolvedEnds:
        """Both ends; their rotations at ``moment``, near that on the deformed body."""
        answers, factorizations = self._answers(found, newton)
        self.factorizations += factorizations
        motions = self.sections.motions(found.displacement)
        missing = moment - HALVES * self._moment_of(found)
        volume = HALVES * found.path[-1].volume / 2
        ends = [
            EndPoint(motion + missing * answer[:, 0], (answer[:, :2] + answer[:, :2].T) / 2,
                     answer[:, 2], volume)
            for motion, answer in zip(motions, answers, strict=True)
        ]  # fmt: skip
        return SolvedEnds(found.pressure, moment, (ends[0], ends[1]), found)

    def _moment_of(self, found: Solution) -> float:
        """About y of the dead loads on the deformed half, N mm."""
        from solver.problem.loads import nodal_forces

        mesh = found.problem.mesh
        return _moment(mesh.nodes + found.displacement, nodal_forces(mesh, found.problem.loads))

    def _answers(self, found: Solution, newton: Newton | None) -> tuple[Reals, int]:
        """Derivatives of both motions by moment, axial force and pressure: (2, 2, 3)."""
        from solver.problem.loads import Traction, nodal_forces
        from solver.sensitivity.adjoint import TangentSystem

        mesh, displacement = self.problem.mesh, found.displacement
        places = mesh.nodes + displacement
        turn, total = self.sections.turns(displacement)
        system = TangentSystem.of(found, newton)
        numbering = system.at.assembly.numbering

        def motion(vector: Reals) -> Reals:
            change, _, _ = numbering.expand(system.solve(vector)[0])
            step = SMALL_MOTION * mesh.size / max(np.abs(change).max(), TINY)
            low, high = (
                self.sections.motions(displacement + side * change) for side in (-step, step)
            )
            result: Reals = (high - low) / (2 * step)
            return result

        area = self._tip_area
        stress = [(1 / area, 0.0, 0.0), (0.0, 0.0, 1 / area)]
        couple = nodal_forces(mesh, (self._couple(1.0, total),))
        loads = [couple, *(nodal_forces(mesh, (Traction(TIP, each),)) for each in stress)]
        moved = np.stack([motion(numbering.gather(each)) for each in loads])
        by_pressure = motion(-system.equilibrium.force)
        moments = [_moment(places, each) for each in loads]
        answers, along = np.empty((2, 2, 3)), normal(turn)
        for end, origin in enumerate(self.sections.gaps(displacement)):
            answers[end, :, 0] = moved[0, end] / moments[0] / HALVES
            # a force at the section's origin is one on the tip's face, and a couple
            about = origin[1] * along[0] - origin[0] * along[1]
            couple_too = about - float(along @ moments[1:])
            by_force = along @ moved[1:, end] + couple_too * moved[0, end] / moments[0]
            answers[end, :, 1] = by_force / HALVES
            answers[end, :, 2] = by_pressure[end]
        return answers, system.factorizations

    @cached_property
    def _tip_area(self) -> float:
        from solver.sensitivity.surface_integrals import areas

        mesh = self.problem.mesh
        return float(areas(mesh.nodes, mesh.triangles(TIP)).sum())

    @cached_property
    def _tip_bending(self) -> tuple[float, float]:
        """Height of the tip's centroid (mm), and the second moment of its area (mm^4)."""
        from solver.sensitivity.surface_integrals import areas, at_points

        mesh = self.problem.mesh
        triangles = mesh.triangles(TIP)
        weights, z = areas(mesh.nodes, triangles), at_points(mesh.nodes, triangles)[..., 2]
        middle = float((weights * z).sum() / weights.sum())
        return middle, float((weights * (z - middle) ** 2).sum())

    def _couple(self, moment: float, turn: float) -> Traction:
        """A couple (N mm, half width) by traction normal to the tip's face at an angle."""
        from solver import Traction

        middle, second = self._tip_bending
        x, z = (moment / second * normal(turn)).tolist()
        return Traction(TIP, lambda places: (places[:, 2] - middle)[:, None] * [x, 0.0, z])


TINY = 1e-30
"""mm."""


def _moment(places: Reals, forces: Reals) -> float:
    """About y of nodal forces (n, 3) at places (n, 3), N mm; from z to x."""
    return float((places[:, 2] * forces[:, 0] - places[:, 0] * forces[:, 2]).sum())
