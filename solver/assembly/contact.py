"""Unilateral contact, without friction, with mirror images, rigid bodies, and between surfaces.

Bodies that mirror each other touch in the plane between them, so it suffices that no point crosses
that plane, as with a rigid one. With g the signed distance of a point from its plane (or cylinder,
sphere, or another surface), positive on the body's side, and d = -g, the contact energy per
reference area is

    psi(d) = k d^3 / (6 s)                      for 0 < d < s,
             k (d^2 / 2 - s d / 2 + s^2 / 6)    beyond,            0 for d <= 0,

a penalty of stiffness k (MPa/mm), smoothed over the depth s so that the pressure -dpsi/dg and its
slope are continuous. It is integrated by the six-point rule over the reference surface. What g is,
and its derivatives, is in ``solver.assembly.pairs``. A node on the moving plane of a cell has g = 0
from it whatever the unknowns are. Residual and tangent are derivatives of the energy, so the
tangent is symmetric. Without contact its sparsity pattern is that of the solid alone; two surfaces
in contact widen it (``solver.assembly.pairs.coupling``).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.pairs.coupling import Coupling
from solver.assembly.pairs.made import contact_pair, contact_pairs
from solver.assembly.pairs.pair import ContactPair, PlaneUnknowns
from solver.assembly.pairs.planes import PlanePair
from solver.assembly.pairs.surfaces import SurfacePair
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.sparsity import Pattern, widened
from solver.mesh.proximity import OPPOSING, facet_normals
from solver.problem.contacts import AnyContact, SurfaceContact, bodies_move, on_moving_plane
from solver.problem.problem import Problem
from solver.problem.rigid_bodies import RigidBody, RigidPlane
from solver.problem.unknowns import Numbering

SOFTENING = 30.0
"""Factor on the penetration of contacts in the first of two stages (``Newton.correct``)."""

INITIAL_CROSSING = 1e-6
"""Tolerance for rounding of surfaces that cross at no load, in body diagonals."""

RESOLUTION = 1e3
"""Largest last correction at a rigid body, in penetrations, over the tolerance of the solve."""

ROUNDING = 1e-11
"""Corrections that are small in any case, in body diagonals."""

DIFFERENCE = 1e-6
"""Fraction of the load between the two positions of a difference quotient."""


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

        Raises ``SolverError`` if a surface of the undeformed body crosses what it must not.
        """
        self._plane = plane
        self._pattern = pattern
        self._size = problem.mesh.size
        self._pairs = tuple(contact_pair(problem, each, numbering) for each in problem.contacts)
        self._coupling = Coupling(pattern, len(self._pairs))
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
        """Whether rigid bodies move with the load."""
        return bodies_move([pair.contact for pair in self._pairs])

    def way(self, before: float, after: float) -> float:
        """Longest way of a rigid body between two fractions of the load, mm."""
        bodies = (each.contact for each in self._pairs if isinstance(each.contact, RigidBody))
        ways = (body.displacement(after) - body.displacement(before) for body in bodies)
        return max((float(np.linalg.norm(way)) for way in ways), default=0.0)

    def passed(self, before: State, load: float, after: State, target: float) -> str:
        """Why one state cannot follow another, at fractions of the load: contact was passed."""
        for pair in self._pairs:
            if what := pair.passed(before, load, after, target):
                return f"the surface {pair.contact.surface!r} would pass through {what}"
        return ""

    def rate(self, state: State, load: float) -> Reals:
        """Derivative (m,) of the contact forces in the residual by the load at rest, N.

        By rigid bodies that move, as a difference quotient: only predictors use it.
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

        The penetration; at rigid bodies, whose force is asked for, a share of it in proportion to
        the ``tolerance``: a correction by the whole penetration changes the pressure by the shear
        modulus.
        """
        active = (pair.contact for pair in self._pairs if pair.touches(state, load))
        return min((self._bound(contact, tolerance) for contact in active), default=np.inf)

    def _bound(self, contact: AnyContact, tolerance: float) -> float:
        """Bound of a last correction by one contact, mm."""
        if not isinstance(contact, RigidBody):
            return contact.penetration
        share = min(1.0, RESOLUTION * tolerance)
        return max(share * contact.penetration, ROUNDING * self._size)

    def touched(self, state: State, load: float) -> bool:
        """Whether any contact is active."""
        return any(pair.touches(state, load) for pair in self._pairs)

    def against_rigid(self, state: State, load: float) -> bool:
        """Whether the body touches a rigid one."""
        rigid = (pair for pair in self._pairs if isinstance(pair.contact, RigidBody))
        return any(pair.touches(state, load) for pair in rigid)

    def settled(self, before: State, after: State, load: float, tolerance: float) -> bool:
        """Whether a last correction hardly changes what rigid bodies exert.

        It may be small beside the penetration and yet as large as the force on a soft body.
        """
        if np.abs(after.displacement - before.displacement).max() <= ROUNDING * self._size:
            return True
        share = min(1.0, RESOLUTION * tolerance)
        return all(
            pair.change(before, after, load) <= share
            for pair in self._pairs
            if isinstance(pair.contact, RigidBody)
        )

    def add(
        self, state: State, tangent: bool, residual: Reals, values: Reals, load: float = 0.0
    ) -> tuple[Reals, Pattern]:
        """Add contact forces to ``residual``; returns the tangent with contact, and its pattern.

        Rigid bodies are where they are at the fraction ``load`` of the load. ``values`` are in the
        pattern without contact, and empty unless ``tangent``.
        """
        active = [pair for pair in self._pairs if pair.touches(state, load)]
        pattern, places = self._widened_for(state, active) if tangent else (self._pattern, None)
        if places is not None:
            values = spread(values, places, pattern)
        for pair in active:
            at_plane = self._plane_unknowns(state)
            pair.add(state, load, at_plane, residual, values, pattern if tangent else None)
        return values, pattern

    def _plane_unknowns(self, state: State) -> PlaneUnknowns:
        """Heights h of the nodes on the moving plane, NaN for all others, and its tilt."""
        nowhere = np.full(len(state.displacement), np.nan)
        heights = nowhere if self._plane is None else self._plane.heights(state)
        return PlaneUnknowns(heights, state.plane[0])

    def in_pattern(self, values: Reals, state: State, load: float) -> Reals:
        """Values in the solid's pattern as ones in the pattern that ``add`` returned last."""
        active = [pair for pair in self._pairs if pair.touches(state, load)]
        pattern, places = self._widened_for(state, active)
        return values if places is None else spread(values, places, pattern)

    def _widened_for(
        self, state: State, active: list[ContactPair]
    ) -> tuple[Pattern, Integers | None]:
        """Pattern that active contacts need, and positions of the solid's entries if another."""
        if any(on_moving_plane(pair.contact) for pair in active):
            return self._widened
        touching = [
            (number, pair, pairs)
            for number, pair in enumerate(self._pairs)
            if isinstance(pair, SurfacePair) and len(pairs := pair.coupled(state))
        ]
        return self._coupling.widened(touching) if touching else (self._pattern, None)

    @cached_property
    def _widened(self) -> tuple[Pattern, Integers]:
        """Pattern with contact at the moving plane, and positions of the solid's entries in it."""
        cells = [pair.face.dofs for pair in self._pairs if on_moving_plane(pair.contact)]
        return widened(self._pattern, np.concatenate(cells))


def spread(values: Reals, places: Integers, pattern: Pattern) -> Reals:
    """Values of the solid's entries, which have these places in a wider pattern, in that one."""
    wide = np.zeros(len(pattern.indices))
    wide[places] = values
    return wide


def lowest_gaps(
    problem: Problem, displacement: Reals, plane: Reals, load: float = 1.0
) -> tuple[float, ...]:
    """Least signed distance of each of the problem's contacts, mm.

    ``displacement`` (n, 3) in mm; ``plane`` (2,) tilt (rad) and shift (mm) of the moving plane;
    ``load``: fraction at which rigid bodies are taken. Negative in contact: minus the penetration,
    which the penalty allows.
    """
    state = State(displacement, np.zeros(0), np.asarray(plane, float))
    pairs = contact_pairs(problem)
    return tuple(float(pair.gaps(state, load).min(initial=np.inf)) for pair in pairs)


def image_gaps(problem: Problem, displacement: Reals, plane: Reals) -> tuple[float | None, ...]:
    """Least gap (mm) between each contact's surface and its mirror image.

    None where there are no facing parts, and for contact with anything but planes of symmetry.
    Arguments as for ``lowest_gaps``. Computed from flat facets; in contact minus the overlap of the
    surface and its image.
    """
    state = State(displacement, np.zeros(0), np.asarray(plane, float))
    return tuple(
        _image_gap(pair, state) if isinstance(pair, PlanePair) else None
        for pair in contact_pairs(problem)
    )


def _image_gap(pair: PlanePair, state: State) -> float | None:
    """Least gap between a surface and its mirror image, mm; None without one."""
    if isinstance(pair.contact, RigidPlane):
        return None
    least = float(pair.gaps(state, 1.0).min(initial=np.inf))
    if least < 0:
        return 2 * least
    *normal, constant = pair.plane(state, 1.0).equation
    centres, normals = facet_normals(pair.problem.mesh, state.displacement, pair.contact.surface)
    cosine = normals @ np.array(normal)
    facing = (cosine < 0) & (1 - 2 * cosine**2 <= OPPOSING)
    across = centres[facing] @ np.array(normal) + constant
    return 2 * float(across.min()) if len(across) else None


def _check_apart(problem: Problem, pairs: tuple[ContactPair, ...]) -> None:
    """Raise ``SolverError`` if a surface of the undeformed body crosses what it must not."""
    still = State.zero(problem)
    for pair in pairs:
        lowest = float(pair.gaps(still, 0.0).min(initial=0.0))
        if lowest < -INITIAL_CROSSING * problem.mesh.size:
            where, wanted = _crossing(pair.contact)
            raise SolverError(
                f"contacts: the surface {pair.contact.surface!r} lies {-lowest:.3g} mm {where} "
                f"before any load; it must be {wanted}."
            )


def _crossing(contact: AnyContact) -> tuple[str, str]:
    """Where a surface is that crosses its contact, and where it must be, as text."""
    if isinstance(contact, RigidPlane):
        return "beyond its plane", "on the side to which the normal points"
    if isinstance(contact, RigidBody):
        return f"inside its {contact.kind}", "outside"
    if isinstance(contact, SurfaceContact):
        return f"behind {contact.other!r}", "in front of it"
    return "beyond its plane", "on one side"
