"""Rigid planes, cylinders and spheres that a surface of the body may not enter, and their motions.

All of them stand still or are displaced with the load, without turning.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import shown
from solver.problem.vectors import finite

Vector: TypeAlias = tuple[float, float, float]

Motion: TypeAlias = Callable[[float], Sequence[float] | Reals]
"""Fraction of the load -> displacement (3,) of a rigid body in mm; zero at no load."""


class RigidBody:
    """What rigid planes, cylinders and spheres have in common.

    In a later stage a body that has moved begins at its new place. What one that is gone, or stands
    elsewhere, has exerted until then fades with the load.
    """

    kind: ClassVar[str]
    surface: str
    penetration: float
    motion: Motion | None

    def displacement(self, load: float) -> Reals:
        """Displacement of the rigid body (3,) at a fraction of the load, mm.

        Raises ``SolverError`` unless the motion gives three finite numbers.
        """
        if self.motion is None:
            return np.zeros(3)
        what = f"contacts: the motion of the {self.kind} of {self.surface!r} at load {load:g} (mm)"
        return finite(what, self.motion(load), (3,))

    def place(self, load: float) -> Reals:
        """A point (3,) of it that moves with it at a fraction of the load, mm."""
        raise NotImplementedError

    def _check_common(self, **vectors: Vector) -> None:
        """Raise ``SolverError`` for a penetration, vectors or a motion that mean nothing."""
        depth = float(finite("contacts: penetration (mm)", self.penetration, ()))
        if depth <= 0:
            raise SolverError(f"contacts: penetration = {depth:g} mm must be above 0.")
        for name, given in vectors.items():
            values = finite(f"contacts: the {name} of the rigid {self.kind}", given, (3,))
            object.__setattr__(self, name, tuple(float(x) for x in values))
        if self.motion is not None and not callable(self.motion):
            raise SolverError(
                f"contacts: the motion of a rigid {self.kind} must be a function of the load, "
                f"got {shown(self.motion)}."
            )

    def _check_motion(self) -> None:
        """Raise ``SolverError`` unless the motion gives displacements."""
        self.displacement(0.0), self.displacement(1.0)

    def _check_length(self, name: str, vector: Vector) -> None:
        """Raise ``SolverError`` for a direction of length zero."""
        if not any(vector):
            raise SolverError(
                f"contacts: the {name} of the rigid {self.kind} must not have length zero."
            )

    def _check_radius(self, radius: float) -> None:
        """Raise ``SolverError`` unless a radius is a positive number."""
        value = float(finite(f"contacts: radius of the rigid {self.kind} (mm)", radius, ()))
        if value <= 0:
            raise SolverError(
                f"contacts: radius of the rigid {self.kind} = {value:g} mm must be above 0."
            )


@dataclass(frozen=True)
class RigidPlane(RigidBody):
    """Frictionless contact of a surface with a rigid plane, which stands still or moves.

    In a later stage one that has moved begins at its new ``point``; see ``RigidBody``.

    Attributes:
        surface: name of the surface.
        penetration: depth beyond the plane, mm, at a contact pressure equal to the material's
            initial shear modulus; other pressures in proportion.
        normal: of the plane, to the side on which the surface is; of any length but zero.

            *Shape:* (3,).
        point: on the plane at no load.

            *Shape:* (3,) in mm.
        motion: displacement of the plane at each fraction of the load, zero at no load; None for a
            plane that stands still.

            *Shape:* load -> (3,) in mm.

    Raises:
        SolverError: a penetration that is not positive and finite, a normal or point that is not
            three finite numbers, a normal of length zero, or a motion that is no function of the
            load or does not give three finite numbers.

    Examples:
        >>> from solver import Ogden, Problem, RigidPlane, Supports, contact_forces, solve
        >>> from solver.mesh import block
        >>> down = lambda load: (0, 0, -0.4 * load)  # by 10 %
        >>> plate = RigidPlane("z1", 0.005, (0, 0, -1), (0, 0, 4), motion=down)
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> pressed = solve(Problem(block((4, 4, 4), (2, 2, 2)), rubber, held, contacts=(plate,)))
        >>> exact = 0.5 * 16 * (0.9**-2 - 0.9)  # without penetration
        >>> print(f"{-contact_forces(pressed)[0].force[2]:.2f}, {exact:.2f} N")
        2.66, 2.68 N
    """

    kind = "plane"
    surface: str
    penetration: float
    normal: Vector
    point: Vector
    motion: Motion | None = None

    def __post_init__(self) -> None:
        self._check_common(normal=self.normal, point=self.point)
        self._check_length("normal", self.normal)
        self._check_motion()

    @property
    def unit_normal(self) -> Reals:
        """The normal with length 1, (3,)."""
        return _unit(self.normal)

    def equation(self, load: float) -> Reals:
        """n and c (4,) of the signed distance n . x + c from the plane at a fraction of the load.

        It is positive on the body's side.
        """
        normal = self.unit_normal
        return np.append(normal, -normal @ (np.array(self.point) + self.displacement(load)))

    def place(self, load: float) -> Reals:
        """The plane's point nearest to the origin (3,) at a fraction of the load, mm."""
        *normal, constant = self.equation(load)
        return -constant * np.array(normal)


@dataclass(frozen=True)
class RigidCylinder(RigidBody):
    """Frictionless contact of a surface with the outside of a rigid cylinder without ends.

    The radius should be no less than the edges of triangles that it touches, between which a
    thinner one gets: there the path ends.

    Attributes:
        surface: name of the surface.
        penetration: depth inside the cylinder, mm, at a contact pressure equal to the material's
            initial shear modulus; other pressures in proportion.
        point: on the axis at no load.

            *Shape:* (3,) in mm.
        direction: of the axis; of any length but zero.

            *Shape:* (3,).
        radius: mm.
        motion: displacement of the cylinder at each fraction of the load, zero at no load; None for
            one that stands still.

            *Shape:* load -> (3,) in mm.

    Raises:
        SolverError: a penetration or radius that is not positive and finite, a point or direction
            that is not three finite numbers, a direction of length zero, or a motion that is no
            function of the load or does not give three finite numbers.

    Examples:
        >>> from solver import Ogden, Problem, RigidCylinder, Supports, contact_forces, solve
        >>> from solver.mesh import block
        >>> bar = block((20, 4, 2), (10, 1, 1))
        >>> down = lambda load: (0, 0, -2 * load)
        >>> rod = RigidCylinder("z1", 0.01, (20, 0, 5), (0, 1, 0), 3.0, motion=down)
        >>> pushed = solve(Problem(bar, Ogden.neo_hooke(0.5), Supports(("x0",)), contacts=(rod,)))
        >>> print(f"{contact_forces(pushed)[0].force[2]:.3f} N")
        -0.003 N
    """

    kind = "cylinder"
    surface: str
    penetration: float
    point: Vector
    direction: Vector
    radius: float
    motion: Motion | None = None

    def __post_init__(self) -> None:
        self._check_common(point=self.point, direction=self.direction)
        self._check_length("direction", self.direction)
        self._check_radius(self.radius)
        self._check_motion()

    @property
    def across(self) -> Reals:
        """Projection (3, 3) onto the plane across the axis."""
        along = _unit(self.direction)
        return np.eye(3) - np.outer(along, along)

    def place(self, load: float) -> Reals:
        """The axis' point (3,) at a fraction of the load, mm."""
        return np.array(self.point) + self.displacement(load)


@dataclass(frozen=True)
class RigidSphere(RigidBody):
    """Frictionless contact of a surface with the outside of a rigid sphere.

    The radius should be no less than the edges of triangles that it touches, between which a
    thinner one gets: there the path ends.

    Attributes:
        surface: name of the surface.
        penetration: depth inside the sphere, mm, at a contact pressure equal to the material's
            initial shear modulus; other pressures in proportion.
        centre: at no load.

            *Shape:* (3,) in mm.
        radius: mm.
        motion: displacement of the sphere at each fraction of the load, zero at no load; None for
            one that stands still.

            *Shape:* load -> (3,) in mm.

    Raises:
        SolverError: a penetration or radius that is not positive and finite, a centre that is not
            three finite numbers, or a motion that is no function of the load or does not give three
            finite numbers.

    Examples:
        >>> from solver import Ogden, Problem, RigidSphere, Supports, contact_forces, solve
        >>> from solver.mesh import block
        >>> pad = block((6, 6, 4), (4, 4, 2))  # a quarter: planes of symmetry at x = 0 and y = 0
        >>> ball = RigidSphere("z1", 0.01, (0, 0, 9), 5.0, motion=lambda load: (0, 0, -0.4 * load))
        >>> held = Supports(("z0",), symmetry={"x0": 0, "y0": 1})
        >>> pressed = solve(Problem(pad, Ogden.neo_hooke(0.5), held, contacts=(ball,)))
        >>> (found,) = contact_forces(pressed)
        >>> print(f"{-4 * found.force[2]:.2f} N, deepest {found.gap:.3f} mm")
        2.28 N, deepest -0.011 mm
    """

    kind = "sphere"
    surface: str
    penetration: float
    centre: Vector
    radius: float
    motion: Motion | None = None

    def __post_init__(self) -> None:
        self._check_common(centre=self.centre)
        self._check_radius(self.radius)
        self._check_motion()

    @property
    def across(self) -> Reals:
        """Identity (3, 3): every direction counts in the distance from the centre."""
        return np.eye(3)

    def place(self, load: float) -> Reals:
        """The centre (3,) at a fraction of the load, mm."""
        return np.array(self.centre) + self.displacement(load)


def _unit(vector: Vector) -> Reals:
    """A vector with length 1."""
    scaled = np.array(vector) / np.abs(vector).max()  # so that no square overflows
    unit: Reals = scaled / np.linalg.norm(scaled)
    return unit
