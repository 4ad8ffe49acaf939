"""How stiffly fingers and objects press against each other."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.force.chain.contact.obstacles import Obstacle


@dataclass(frozen=True)
class ContactModel:
    """Points of the finger's lower side press against objects in proportion to the penetration.

    The default stiffness is that of a printed wall, E b / t with E = 20 MPa, 15 mm wide, 1.5 mm
    thick: what the finger's skin gives way, of which the pieces' law knows nothing. Points must be
    dense enough for several of them to touch, or the finger slides over an edge in small jumps.

    Half to five times the stiffness, or half the spacing, changed the largest force of grips of
    ``prototype_1`` on a cylinder and on boxes with edges of 1 and 2 mm by at most half a percent.

    Attributes:
        spacing: of the points along the finger, at most, mm.
        stiffness: N/mm per mm of the finger's length.
    """

    spacing: float = 0.1
    stiffness: float = 200.0


@dataclass(frozen=True)
class Obstacles:
    """What points may touch: rigid objects, Coulomb's coefficient of friction, and how stiffly."""

    objects: tuple[Obstacle, ...]
    friction: float
    model: ContactModel
