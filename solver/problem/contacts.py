"""What surfaces of the body may not cross.

Planes of symmetry, the moving plane, rigid bodies, and other surfaces of the body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from solver.errors import SolverError
from solver.input_types import check_number, is_axis, shown
from solver.mesh.mesh import Mesh
from solver.problem.rigid_bodies import RigidBody, RigidCylinder, RigidPlane, RigidSphere


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

    Examples:
        >>> from solver import Contact, Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> ball = block((10, 10, 10), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> wall = Contact("x1", penetration=0.01, axis=0, position=11.0)
        >>> problem = Problem(ball, Ogden.neo_hooke(0.5), held, ("cavity",), contacts=(wall,))
        >>> blown = solve(problem, 0.4)
        >>> print(f"{(ball.nodes + blown.displacement)[:, 0].max():.2f} mm")  # not beyond the plane
        11.01 mm
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
class SurfaceContact:
    """Frictionless contact of a surface of the body with another one, which it may not cross.

    The pressure is integrated over the first surface alone: the other one, which bears it, is
    better the coarser or the stiffer one.

    Attributes:
        surface: name of the surface whose points are kept on the outer side of the other one.
        other: name of the other surface; the two share no node.
        penetration: depth at a contact pressure equal to the material's initial shear modulus, mm;
            other pressures in proportion.
        reach: how deep behind the other surface a point is still taken for one in contact, mm: more
            than a correction on the way to equilibrium moves it, less than the body is thick there.
            By default a mean edge of the mesh.

    Raises:
        SolverError: a penetration or reach that is not positive and finite, or a surface that is to
            touch itself.

    Examples:
        >>> from solver import Mesh, Ogden, Problem, SurfaceContact, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> clip = block((12, 4, 6), (6, 1, 3), hollow=((1, 0, 1), (6, 1, 2)))  # two arms
        >>> heights = clip.nodes[clip.surfaces["cavity"][:, :3]].mean(axis=1)
        >>> arms = {"lower": heights[:, 2] < 2.1, "upper": heights[:, 2] > 3.9}
        >>> named = {name: clip.surfaces["cavity"][here] for name, here in arms.items()}
        >>> mesh = Mesh(clip.nodes, clip.tets, clip.surfaces | named)
        >>> push = Traction("z1", (0, 0, -0.01))
        >>> contact = SurfaceContact("upper", "lower", penetration=0.02)
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> held = Supports(("z0",))
        >>> shut = solve(Problem(mesh, rubber, held, loads=(push,), contacts=(contact,)))
        >>> tip = mesh.surface_nodes("upper")
        >>> lowest = (mesh.nodes + shut.displacement)[tip, 2].min()
        >>> print(f"{lowest:.2f} mm")  # on the arm below, at 2 mm
        1.93 mm
    """

    surface: str
    other: str
    penetration: float
    reach: float | None = None

    def __post_init__(self) -> None:
        for name in ("penetration", "reach"):
            value = getattr(self, name)
            if value is None and name == "reach":
                continue
            check_number(f"contacts: {name}", value)
            if not 0 < value < np.inf:
                raise SolverError(f"contacts: {name} = {value:g} mm must be above 0 and finite.")
        if self.surface == self.other:
            raise SolverError(
                f"contacts: the surface {self.surface!r} must touch another one, not itself."
            )


AnyContact: TypeAlias = Contact | SurfaceContact | RigidPlane | RigidCylinder | RigidSphere


def surfaces_of(contact: AnyContact) -> tuple[str, ...]:
    """Names of the surfaces of the body that a contact is about."""
    if isinstance(contact, SurfaceContact):
        return contact.surface, contact.other
    return (contact.surface,)


def on_moving_plane(contact: AnyContact) -> bool:
    """Whether the contact is with the problem's moving plane."""
    return isinstance(contact, Contact) and contact.axis is None


def bodies_move(contacts: Sequence[AnyContact]) -> bool:
    """Whether rigid bodies move with the load."""
    return any(isinstance(each, RigidBody) and each.motion is not None for each in contacts)


def check_contacts(
    mesh: Mesh, contacts: Sequence[AnyContact], moving_plane: str | None
) -> tuple[AnyContact, ...]:
    """Contacts as a tuple; ``SolverError`` for unknown surfaces and planes that are not there."""
    if not isinstance(contacts, Sequence) or isinstance(contacts, str):
        raise SolverError(f"contacts: needs a tuple of contacts, got {contacts!r}.")
    for contact in contacts:
        if not isinstance(contact, AnyContact):
            raise SolverError(
                "contacts: needs Contact, SurfaceContact, RigidPlane, RigidCylinder or "
                f"RigidSphere, got {contact!r}."
            )
        for surface in surfaces_of(contact):
            if len(mesh.triangles(surface)) == 0:
                raise SolverError(f"contacts: the surface {surface!r} has no triangles.")
        if on_moving_plane(contact) and moving_plane is None:
            raise SolverError(
                f"contacts: the surface {contact.surface!r} needs an axis, as the problem has no "
                "moving plane."
            )
        if isinstance(contact, RigidBody):
            _check_rigid(mesh, contact, moving_plane)
        if isinstance(contact, SurfaceContact):
            _check_surfaces(mesh, contact, moving_plane)
    return tuple(contacts)


def _check_surfaces(mesh: Mesh, contact: SurfaceContact, moving_plane: str | None) -> None:
    """Raise ``SolverError`` for surfaces at a cell, or ones that share nodes."""
    if moving_plane is not None:
        raise SolverError(
            "contacts: a cell with a moving plane touches mirror images, not other surfaces."
        )
    one, other = mesh.surface_nodes(contact.surface), mesh.surface_nodes(contact.other)
    if len(np.intersect1d(one, other)):
        raise SolverError(
            f"contacts: the surfaces {contact.surface!r} and {contact.other!r} share nodes; those "
            "of two that touch must not."
        )


def _check_rigid(mesh: Mesh, contact: RigidBody, moving_plane: str | None) -> None:
    """Raise ``SolverError`` for a rigid body at a cell, or one whose motion begins with a leap."""
    if moving_plane is not None:
        raise SolverError(
            "contacts: a cell with a moving plane touches mirror images, not rigid "
            f"{contact.kind}s."
        )
    start = float(np.abs(contact.displacement(0.0)).max())
    if start > 1e-9 * mesh.size:
        raise SolverError(
            f"contacts: the motion of the {contact.kind} of {contact.surface!r} must be zero at no "
            f"load, got {start:.3g} mm."
        )
