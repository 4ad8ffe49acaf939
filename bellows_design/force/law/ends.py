"""What the ends add: the outer halves of the first and the last bubble, and the stubs beside them.

From an actuator of one bubble: it turns by more or less than two half bubbles without neighbours,
and gives way more or less to a moment on its tip. Half of the difference is taken as a hinge at
each end; which part belongs to which end is not known.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.interpolation.points import HALVES
from bellows_design.force.section_law import SectionLaw, SectionResponse
from solver.arrays import Reals

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from solver import Problem, Solution


@dataclass(frozen=True)
class EndPoint:
    """An end without a moment.

    Attributes:
        pressure: MPa.
        rotation: that it adds, rad.
        compliance: that it adds, rad per N mm of the full width; it may be negative.
        volume: that it adds, mm^3.
    """

    pressure: float
    rotation: float
    compliance: float
    volume: float


@dataclass(frozen=True, eq=False)
class EndHinge:
    """A ``SectionLaw`` of length zero: a hinge that turns with the pressure, and is elastic.

    Attributes:
        points: by ascending pressure, at least two.
    """

    points: tuple[EndPoint, ...]

    @property
    def length(self) -> float:
        """A hinge has none."""
        return 0.0

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3); only moments count."""
        moment, none = loads[:, 0], np.zeros(len(loads))
        (turn, soft, volume), (turn_rate, soft_rate, _) = (
            self._curves(pressure, order) for order in (0, 1)
        )
        compliance = np.zeros((len(loads), 3, 3))
        compliance[:, 0, 0] = soft
        rate = turn_rate + soft_rate * moment
        return SectionResponse(
            energy=self._work(pressure)[2] + turn * moment + soft * moment**2 / 2,
            motion=np.stack([turn + soft * moment, none, none], axis=1),
            compliance=compliance,
            volume=volume + turn_rate * moment + soft_rate * moment**2 / 2,
            motion_by_pressure=np.stack([rate, none, none], axis=1),
        )

    @cached_property
    def _curves(self) -> PPoly:
        """Rotation, compliance and volume by pressure."""
        from scipy.interpolate import PchipInterpolator

        pressures = [point.pressure for point in self.points]
        values = [(point.rotation, point.compliance, point.volume) for point in self.points]
        return PchipInterpolator(pressures, np.array(values))

    @cached_property
    def _work(self) -> PPoly:
        """Their integrals by the pressure from none."""
        found = self._curves.antiderivative()
        found.c[-1] -= found(0.0)
        return found


def end_hinge(short: Problem, inner: SectionLaw, pressures: tuple[float, ...]) -> EndHinge:
    """Of a short actuator of one bubble: half of what it adds to two half bubbles.

    Args:
        short: the half of an actuator of one bubble, or a bubble without neighbours.
        inner: half a bubble without neighbours.
        pressures: at which it is solved, 0 among them.

    Raises:
        BellowsError: it does not reach them.
    """
    return EndHinge(tuple(_end_point(each, inner) for each in _solutions(short, pressures)))


def _solutions(short: Problem, pressures: tuple[float, ...]) -> list[Solution]:
    """By ascending pressure."""
    from solver import solve

    ordered = sorted(pressures, key=abs)
    found = solve(short, ordered[-1], stops=[each for each in ordered[:-1] if each])
    if not found.converged:
        raise BellowsError(f"there is no law of the ends: {found.message}")
    reached = [solve(short, 0.0), *found.at_stops, found]
    return sorted(reached, key=lambda each: each.pressure)


def _end_point(short: Solution, inner: SectionLaw) -> EndPoint:
    two = inner.response(short.pressure, np.zeros((1, 3)))
    turn, soft, volume = _whole(short)
    return EndPoint(
        pressure=short.pressure,
        rotation=turn / 2 - float(two.motion[0, 0]),
        compliance=soft / 2 - float(two.compliance[0, 0, 0]),
        volume=volume / 2 - float(two.volume[0]),
    )


def _whole(short: Solution) -> tuple[float, float, float]:
    """Rotation (rad), its derivative by a moment at the tip, and volume of a full bubble."""
    from solver import section_response

    if short.problem.moving_plane is not None:  # a quarter of a bubble
        section = section_response(short)
        soft = 2 * section.derivatives[0, 0] / HALVES
        return 2 * section.tilt, float(soft), 2 * HALVES * section.volume
    volume = HALVES * short.path[-1].volume
    return float(np.radians(short.rotation)), _tip_compliance(short) / HALVES, volume


def _tip_compliance(short: Solution) -> float:
    """Rotation of the tip's face per couple on it (of the half width), rad per N mm."""
    from bellows_design.geometry.face_names import TIP
    from solver import rotation
    from solver.problem.loads import Traction, nodal_forces
    from solver.sensitivity.adjoint import TangentSystem

    mesh = short.problem.mesh
    forces = nodal_forces(mesh, (Traction(TIP, _bending(short)),))
    system = TangentSystem.of(short, None)
    numbering = system.at.assembly.numbering
    vector, _ = system.solve(numbering.gather(forces))
    change, _, _ = numbering.expand(vector)
    moment = _moment(short, forces)
    step = SMALL_TURN * mesh.size / np.abs(change).max()
    sides = [rotation(mesh, short.displacement + side * change, TIP) for side in (-step, step)]
    return float(np.radians(sides[1] - sides[0]) / (2 * step) / moment)


SMALL_TURN = 1e-4
"""Displacement in body diagonals by which a rotation's derivative is found."""


def _bending(short: Solution) -> Callable[[Reals], Reals]:
    """Traction normal to the turned tip, in proportion to the height above the face's middle."""
    from bellows_design.geometry.face_names import TIP

    mesh, turn = short.problem.mesh, np.radians(short.rotation)
    nodes = mesh.nodes[mesh.surface_nodes(TIP)]
    middle = (nodes[:, 2].min() + nodes[:, 2].max()) / 2
    normal = np.array([np.cos(turn), 0.0, -np.sin(turn)])
    return lambda places: (places[:, 2] - middle)[:, None] * normal


def _moment(short: Solution, forces: Reals) -> float:
    """About y of nodal forces (n, 3) on the deformed body, N mm; from z to x."""
    places = short.problem.mesh.nodes + short.displacement
    return float((places[:, 2] * forces[:, 0] - places[:, 0] * forces[:, 2]).sum())
