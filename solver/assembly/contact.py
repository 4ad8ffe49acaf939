"""Unilateral contact, without friction, of a body with its mirror images and with rigid planes.

Bodies that mirror each other touch in the plane between them, so it suffices that no point crosses
that plane, as with a rigid one. With g the signed distance of a point from its plane, positive on
the body's side, and d = -g, the contact energy per reference area is

    psi(d) = k d^3 / (6 s)                      for 0 < d < s,
             k (d^2 / 2 - s d / 2 + s^2 / 6)    beyond,            0 for d <= 0,

a penalty of stiffness k (MPa/mm), smoothed over the depth s so that the pressure -dpsi/dg and its
slope are continuous. It is integrated by the six-point rule over the reference surface. All planes
are written as g = n . x + c. A fixed one has constant n and c; one that is led has a c that depends
on the load, and so has the residual; the moving plane of a cell (``solver.assembly.moving_plane``)
has

    n = (-cos t, 0, sin t),   c = (L + shift) cos t,   t = tilt,

whose derivatives go into the unknowns tilt and shift. A node on that plane then has g = 0 whatever
the unknowns are. Residual and tangent are derivatives of the energy, so the tangent is symmetric.
Without contact its sparsity pattern is that of the solid alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.state import State
from solver.errors import SolverError
from solver.kernels.contact import (
    Face,
    Plane,
    assemble_contact,
    contact_pressures,
    face_energy,
)
from solver.linear.sparsity import Pattern, widened
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.mesh.proximity import OPPOSING, facet_normals
from solver.problem.contacts import ContactPlane, RigidPlane, on_moving_plane, planes_move
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering

SMOOTHING = 0.1
"""s over the penetration of a contact."""

SOFTENING = 30.0
"""Factor on the penetration of contacts in the first of two stages (``Newton.correct``)."""

INITIAL_CROSSING = 1e-6
"""Tolerance for rounding of surfaces beyond their planes at no load, in body diagonals."""

RESOLUTION = 1e3
"""Largest last correction at a rigid plane, in penetrations, over the tolerance of the solve."""

ROUNDING = 1e-11
"""Corrections that are small in any case, in body diagonals."""

DIFFERENCE = 1e-6
"""Fraction of the load between the two positions of a difference quotient."""


@dataclass(frozen=True)
class ContactPair:
    """One contact of a problem on its mesh."""

    problem: Problem
    contact: ContactPlane
    face: Face

    @staticmethod
    def of(problem: Problem, contact: ContactPlane, numbering: Numbering) -> ContactPair:
        """The contact with its triangles' quadrature and numbers of unknowns."""
        mesh, rule = problem.mesh, triangle_rule()
        triangles = mesh.triangles(contact.surface)
        face = Face(
            nodes=mesh.nodes,
            triangles=triangles,
            shapes=rule.quadratic,
            areas=_areas(mesh, triangles),
            dofs=_dofs(problem, contact, triangles, numbering),
            stiffness=problem.material.shear_modulus / contact.penetration,
            smoothing=SMOOTHING * contact.penetration,
        )
        return ContactPair(problem, contact, face)

    def plane(self, state: State, load: float) -> Plane:
        """The plane at a state and a fraction of the load."""
        return _plane_of(self.problem, self.contact, state, load)

    def gaps(self, state: State, load: float) -> Reals:
        """Signed distances of the quadrature points from the plane, (k, q), mm."""
        *normal, constant = self.plane(state, load).equation
        along = (self.face.nodes + state.displacement) @ np.array(normal)
        gaps: Reals = along[self.face.triangles] @ self.face.shapes.T + constant
        return gaps

    def softer(self, factor: float) -> ContactPair:
        """The same contact with ``factor`` times its penetration."""
        depth = factor * self.contact.penetration
        stiffness, smoothing = self.face.stiffness / factor, SMOOTHING * depth
        face = self.face._replace(stiffness=stiffness, smoothing=smoothing)
        return ContactPair(self.problem, replace(self.contact, penetration=depth), face)

    def entries(self, pattern: Pattern | None) -> Integers:
        """Positions of the triangles' entries in a pattern, (k, 210); (k, 0) without one."""
        if pattern is None:
            return np.empty((len(self.face.triangles), 0), np.int32)
        return pattern.entries(self.face.dofs)

    def touches(self, state: State, load: float) -> bool:
        """True if a quadrature point is beyond the plane."""
        return bool((self.gaps(state, load) < 0).any())

    def pressures(self, state: State, load: float) -> Reals:
        """Pressure per reference area at the quadrature points, (k, q), MPa."""
        pressures: Reals = contact_pressures(self.face, self.gaps(state, load))
        return pressures

    def change(self, before: State, after: State, load: float) -> float:
        """Change of the pressures between two states, relative to those of the latter."""
        pressures = self.pressures(after, load)
        changes = np.abs(pressures - self.pressures(before, load))
        change = float((self.face.areas * changes).sum())
        return change / float((self.face.areas * pressures).sum()) if change else 0.0

    def energy(self, state: State, load: float) -> float:
        """Energy of the penetration, N mm."""
        return float(face_energy(self.face, self.plane(state, load), state.displacement))

    def forces(self, state: State, load: float) -> Reals:
        """Nodal forces (n, 3) of the plane on the body, N; ``face`` numbers all displacements."""
        residual = np.zeros(state.displacement.size)
        if self.touches(state, load):
            assemble_contact(
                self.face, self.entries(None), self.plane(state, load),
                np.full(len(state.displacement), np.nan), 0.0,
                np.ascontiguousarray(state.displacement), False, residual, np.zeros(0),
            )  # fmt: skip
        return -residual.reshape(-1, 3)


class Contacts:
    """All contacts of a problem, and the pattern of its tangent with them.

    A surface in contact with the moving plane couples with its tilt and shift. The pattern has
    entries for that only where there is such contact.
    """

    def __init__(
        self,
        problem: Problem,
        numbering: Numbering,
        plane: MovingPlane | None,
        pattern: Pattern,
        start: Reals,
    ) -> None:
        """``start`` (n, 3): displacements at the start; a later stage may begin in contact.

        Raises ``SolverError`` if a surface of the undeformed body lies beyond its plane.
        """
        self._plane = plane
        self._pattern = pattern
        self._size = problem.mesh.size
        self._pairs = tuple(ContactPair.of(problem, each, numbering) for each in problem.contacts)
        if not start.any():
            _check_apart(problem, self._pairs)

    @contextmanager
    def softened(self) -> Iterator[None]:
        """Context with contacts softer by ``SOFTENING``, for Newton's method to converge faster."""
        stiff = self._pairs
        self._pairs = tuple(pair.softer(SOFTENING) for pair in stiff)
        try:
            yield
        finally:
            self._pairs = stiff

    @property
    def move(self) -> bool:
        """Whether rigid planes move with the load."""
        return planes_move([pair.contact for pair in self._pairs])

    def way(self, before: float, after: float) -> float:
        """Longest way of a rigid plane between two fractions of the load, mm."""
        planes = (each.contact for each in self._pairs if isinstance(each.contact, RigidPlane))
        ways = (plane.displacement(after) - plane.displacement(before) for plane in planes)
        return max((float(np.linalg.norm(way)) for way in ways), default=0.0)

    def rate(self, state: State, load: float) -> Reals:
        """Derivative (m,) of the contact forces in the residual by the load at rest, N.

        By planes that move, as a difference quotient: only predictors use it.
        """
        step = DIFFERENCE if load < 0.5 else -DIFFERENCE
        here, there = np.zeros((2, len(self._pattern.indptr) - 1))
        self.add(state, False, here, np.zeros(0), load)
        self.add(state, False, there, np.zeros(0), load + step)
        rate: Reals = (there - here) / step
        return rate

    def energy(self, state: State, load: float = 0.0) -> float:
        """Energy of all contacts, N mm."""
        return float(sum(pair.energy(state, load) for pair in self._pairs))

    def depth(self, state: State, load: float, tolerance: float) -> float:
        """Bound of a last correction by the active contacts, mm; infinite without any.

        The penetration; at rigid planes, whose force is asked for, a share of it in proportion to
        the ``tolerance``: a correction by the whole penetration changes the pressure by the shear
        modulus.
        """
        active = (pair.contact for pair in self._pairs if pair.touches(state, load))
        return min((self._bound(contact, tolerance) for contact in active), default=np.inf)

    def _bound(self, contact: ContactPlane, tolerance: float) -> float:
        """Bound of a last correction by one contact, mm."""
        if not isinstance(contact, RigidPlane):
            return contact.penetration
        share = min(1.0, RESOLUTION * tolerance)
        return max(share * contact.penetration, ROUNDING * self._size)

    def against_rigid(self, state: State, load: float) -> bool:
        """Whether the body touches a rigid plane."""
        rigid = (pair for pair in self._pairs if isinstance(pair.contact, RigidPlane))
        return any(pair.touches(state, load) for pair in rigid)

    def settled(self, before: State, after: State, load: float, tolerance: float) -> bool:
        """Whether a last correction hardly changes what rigid planes exert.

        It may be small beside the penetration and yet as large as the force on a soft body.
        """
        if np.abs(after.displacement - before.displacement).max() <= ROUNDING * self._size:
            return True
        share = min(1.0, RESOLUTION * tolerance)
        return all(
            pair.change(before, after, load) <= share
            for pair in self._pairs
            if isinstance(pair.contact, RigidPlane)
        )

    def add(
        self, state: State, tangent: bool, residual: Reals, values: Reals, load: float = 0.0
    ) -> tuple[Reals, Pattern]:
        """Add contact forces to ``residual``; returns the tangent with contact, and its pattern.

        Planes are where they are at the fraction ``load`` of the load. ``values`` are in the
        pattern without contact, and empty unless ``tangent``.
        """
        active = [pair for pair in self._pairs if pair.touches(state, load)]
        pattern = self._pattern
        if tangent and any(on_moving_plane(pair.contact) for pair in active):
            pattern, places = self._widened
            solid, values = values, np.zeros(len(pattern.indices))
            values[places] = solid
        for pair in active:
            assemble_contact(
                pair.face, pair.entries(pattern if tangent else None), pair.plane(state, load),
                self._heights(state), state.plane[0], np.ascontiguousarray(state.displacement),
                tangent, residual, values,
            )  # fmt: skip
        return values, pattern

    def _heights(self, state: State) -> Reals:
        """h of the nodes on the moving plane, NaN for all others, (n,), mm."""
        if self._plane is None:
            return np.full(len(state.displacement), np.nan)
        return self._plane.heights(state)

    @cached_property
    def _widened(self) -> tuple[Pattern, Integers]:
        """Pattern with contact at the moving plane, and positions of the solid's entries in it."""
        cells = [pair.face.dofs for pair in self._pairs if on_moving_plane(pair.contact)]
        return widened(self._pattern, np.concatenate(cells))


def contact_pairs(problem: Problem) -> tuple[ContactPair, ...]:
    """The problem's contacts, with every displacement numbered, also where it is given."""
    size = len(problem.mesh.nodes)
    everything = np.arange(3 * size, dtype=np.int32).reshape(size, 3)
    none = np.full(2, -1, np.int32)
    numbering = Numbering(everything, np.zeros(0, np.int32), none, everything.size)
    return tuple(ContactPair.of(problem, each, numbering) for each in problem.contacts)


def lowest_gaps(
    problem: Problem, displacement: Reals, plane: Reals, load: float = 1.0
) -> tuple[float, ...]:
    """Least signed distance from its plane of each of the problem's contacts, mm.

    ``displacement`` (n, 3) in mm; ``plane`` (2,) tilt (rad) and shift (mm) of the moving plane;
    ``load``: fraction at which rigid planes are taken. Negative in contact: minus the penetration,
    which the penalty allows.
    """
    state = State(displacement, np.zeros(0), np.asarray(plane, float))
    pairs = contact_pairs(problem)
    return tuple(float(pair.gaps(state, load).min(initial=np.inf)) for pair in pairs)


def image_gaps(problem: Problem, displacement: Reals, plane: Reals) -> tuple[float | None, ...]:
    """Least gap (mm) between each contact's surface and its mirror image.

    None where there are no facing parts, and for rigid planes. Arguments as for ``lowest_gaps``.
    Computed from flat facets; in contact minus the overlap of the surface and its image.
    """
    state = State(displacement, np.zeros(0), np.asarray(plane, float))
    lowest = lowest_gaps(problem, displacement, plane)
    gaps = []
    for contact, least in zip(problem.contacts, lowest, strict=True):
        *normal, constant = _plane_of(problem, contact, state, 1.0).equation
        centres, normals = facet_normals(problem.mesh, displacement, contact.surface)
        cosine = normals @ np.array(normal)
        facing = (cosine < 0) & (1 - 2 * cosine**2 <= OPPOSING)
        across = centres[facing] @ np.array(normal) + constant
        gaps.append(2 * (least if least < 0 else float(across.min(initial=np.inf))))
        if isinstance(contact, RigidPlane):
            gaps[-1] = np.inf
    return tuple(gap if np.isfinite(gap) else None for gap in gaps)


def _areas(mesh: Mesh, triangles: Integers) -> Reals:
    """Reference areas (k, q) of the quadrature points of triangles (k, 6), mm^2."""
    rule = triangle_rule()
    along = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[triangles])
    areas: Reals = rule.weights * np.linalg.norm(np.cross(along[0], along[1]), axis=2)
    return areas


def _dofs(
    problem: Problem, contact: ContactPlane, triangles: Integers, numbering: Numbering
) -> Integers:
    """Unknowns of triangles (k, 20): the moving plane's where they couple, else -1."""
    moving = problem.moving_plane
    on_plane = () if moving is None else problem.mesh.surface_nodes(moving)
    plane = np.broadcast_to(numbering.plane, (len(triangles), 2)).copy()
    if not on_moving_plane(contact):
        plane[~np.isin(triangles, on_plane).any(axis=1)] = -1
    return np.ascontiguousarray(np.hstack([numbering.of_triangles(triangles), plane]))


def _plane_of(problem: Problem, contact: ContactPlane, state: State, load: float) -> Plane:
    """A contact's plane at a state and a fraction of the load."""
    if isinstance(contact, RigidPlane):
        return _still(contact.equation(load))
    if contact.axis is None:
        return _moving_plane(_initial_x(problem), state.plane)
    middle = problem.mesh.nodes[:, contact.axis].mean()
    side = 1.0 if middle >= contact.position else -1.0  # where the body is
    equation = np.zeros(4)
    equation[contact.axis], equation[3] = side, -side * contact.position
    return _still(equation)


def _still(equation: Reals) -> Plane:
    """A plane that no unknown moves."""
    return Plane(equation, np.zeros(4), np.zeros(4), 0.0, 0.0)


def _moving_plane(end: float, motion: Reals) -> Plane:
    """The moving plane, initially at x = ``end``, after ``motion`` (2,): tilt and shift."""
    sine, cosine, reach = np.sin(motion[0]), np.cos(motion[0]), end + motion[1]
    equation = np.array([-cosine, 0.0, sine, reach * cosine])
    turned = np.array([sine, 0.0, cosine, -reach * sine])
    return Plane(equation, turned, -equation, float(cosine), -float(sine))


def _initial_x(problem: Problem) -> float:
    """x of the moving plane in the undeformed body, mm."""
    assert problem.moving_plane is not None
    return float(problem.mesh.nodes[problem.mesh.surface_nodes(problem.moving_plane)[0], 0])


def _check_apart(problem: Problem, pairs: tuple[ContactPair, ...]) -> None:
    """Raise ``SolverError`` if a surface of the undeformed body lies beyond its plane."""
    still = State.zero(problem)
    for pair in pairs:
        lowest = float(pair.gaps(still, 0.0).min(initial=0.0))
        if lowest < -INITIAL_CROSSING * problem.mesh.size:
            rigid = isinstance(pair.contact, RigidPlane)
            side = "the side to which the normal points" if rigid else "one side"
            raise SolverError(
                f"contacts: the surface {pair.contact.surface!r} lies {-lowest:.3g} mm beyond its "
                f"plane before any load; it must be on {side}."
            )
