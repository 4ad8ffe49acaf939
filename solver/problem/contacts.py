"""Planes that surfaces of the body may not cross: of symmetry, and rigid ones that may move."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import check_number, is_axis, shown
from solver.mesh.mesh import Mesh
from solver.problem.vectors import finite

Vector: TypeAlias = tuple[float, float, float]

PlaneMotion: TypeAlias = Callable[[float], Sequence[float] | Reals]
"""Fraction of the load -> displacement (3,) of a plane in mm; zero at no load."""


@dataclass(frozen=True)
class Contact:
    """Frictionless contact of a surface with a plane of symmetry, which it may not cross.

    Attributes:
        surface: name of the surface.
        penetration: depth beyond the plane, mm, at a contact pressure equal to the material's
            initial shear modulus; other pressures in proportion.
        axis: normal of the plane, 0, 1 or 2; None for the problem's moving plane.
        position: of the plane along ``axis``, mm.

    Raises:
        SolverError: another axis, a penetration that is not positive and finite, or a position that
            is not finite.
    """

    surface: str
    penetration: float
    axis: int | None = None
    position: float = 0.0

    def __post_init__(self) -> None:
        check_number("contacts: penetration", self.penetration)
        check_number("contacts: position", self.position)
        if self.axis is not None and not is_axis(self.axis):
            raise SolverError(
                f"contacts: the plane's axis must be 0, 1 or 2, got {shown(self.axis)}."
            )
        if not 0 < self.penetration < np.inf or not np.isfinite(self.position):
            raise SolverError(
                f"contacts: penetration = {self.penetration:g} mm must be above 0 and position = "
                f"{self.position:g} mm finite."
            )


@dataclass(frozen=True)
class RigidPlane:
    """Frictionless contact of a surface with a rigid plane, which stands still or moves.

    In a later stage a plane that has moved begins at its new ``point``. What a plane that is gone,
    or stands elsewhere, has exerted until then fades with the load.

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
    """

    surface: str
    penetration: float
    normal: Vector
    point: Vector
    motion: PlaneMotion | None = None

    def __post_init__(self) -> None:
        depth = float(finite("contacts: penetration (mm)", self.penetration, ()))
        if depth <= 0:
            raise SolverError(f"contacts: penetration = {depth:g} mm must be above 0.")
        for name, given in (("normal", self.normal), ("point", self.point)):
            values = finite(f"contacts: the {name} of the rigid plane", given, (3,))
            object.__setattr__(self, name, tuple(float(x) for x in values))
        if not any(self.normal):
            raise SolverError("contacts: the normal of the rigid plane must not have length zero.")
        if self.motion is not None and not callable(self.motion):
            raise SolverError(
                "contacts: the motion of a rigid plane must be a function of the load, "
                f"got {shown(self.motion)}."
            )
        self.displacement(0.0), self.displacement(1.0)

    @property
    def unit_normal(self) -> Reals:
        """The normal with length 1, (3,)."""
        normal = np.array(self.normal) / np.abs(self.normal).max()  # so that no square overflows
        unit: Reals = normal / np.linalg.norm(normal)
        return unit

    def displacement(self, load: float) -> Reals:
        """Displacement of the plane (3,) at a fraction of the load, mm.

        Raises ``SolverError`` unless the motion gives three finite numbers.
        """
        if self.motion is None:
            return np.zeros(3)
        what = f"contacts: the motion of the plane of {self.surface!r} at load {load:g} (mm)"
        return finite(what, self.motion(load), (3,))

    def equation(self, load: float) -> Reals:
        """n and c (4,) of the signed distance n . x + c from the plane at a fraction of the load.

        It is positive on the body's side.
        """
        normal = self.unit_normal
        return np.append(normal, -normal @ (np.array(self.point) + self.displacement(load)))


ContactPlane: TypeAlias = Contact | RigidPlane


def on_moving_plane(contact: ContactPlane) -> bool:
    """Whether the contact is with the problem's moving plane."""
    return isinstance(contact, Contact) and contact.axis is None


def planes_move(contacts: Sequence[ContactPlane]) -> bool:
    """Whether rigid planes move with the load."""
    return any(isinstance(each, RigidPlane) and each.motion is not None for each in contacts)


def check_contacts(
    mesh: Mesh, contacts: Sequence[ContactPlane], moving_plane: str | None
) -> tuple[ContactPlane, ...]:
    """Contacts as a tuple; ``SolverError`` for unknown surfaces and planes that are not there."""
    if not isinstance(contacts, Sequence) or isinstance(contacts, str):
        raise SolverError(f"contacts: needs a tuple of contacts, got {contacts!r}.")
    for contact in contacts:
        if not isinstance(contact, Contact | RigidPlane):
            raise SolverError(f"contacts: needs Contact or RigidPlane, got {contact!r}.")
        if len(mesh.triangles(contact.surface)) == 0:
            raise SolverError(f"contacts: the surface {contact.surface!r} has no triangles.")
        if on_moving_plane(contact) and moving_plane is None:
            raise SolverError(
                f"contacts: the surface {contact.surface!r} needs an axis, as the problem has no "
                "moving plane."
            )
        if isinstance(contact, RigidPlane):
            _check_rigid(mesh, contact, moving_plane)
    return tuple(contacts)


def _check_rigid(mesh: Mesh, contact: RigidPlane, moving_plane: str | None) -> None:
    """Raise ``SolverError`` for a rigid plane at a cell, or one whose motion begins with a leap."""
    if moving_plane is not None:
        raise SolverError(
            "contacts: a cell with a moving plane touches mirror images, not rigid planes."
        )
    start = float(np.abs(contact.displacement(0.0)).max())
    if start > 1e-9 * mesh.size:
        raise SolverError(
            f"contacts: the motion of the plane of {contact.surface!r} must be zero at no load, "
            f"got {start:.3g} mm."
        )
