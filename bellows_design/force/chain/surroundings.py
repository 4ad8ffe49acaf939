"""What stands around a finger and acts on it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from bellows_design.errors import BellowsError
from bellows_design.force.chain.contact.model import ContactModel
from bellows_design.force.chain.contact.obstacles import Obstacle


@dataclass(frozen=True)
class DeadForce:
    """A force that keeps its direction: x and z components in N.

    It acts at ``place`` mm from the root along the undeformed finger and ``height`` mm above its
    lower side.
    """

    place: float
    force: tuple[float, float]
    height: float = 0.0


@dataclass(frozen=True)
class Hold:
    """What the tip's lower edge and the tip's angle are held at; None is free.

    Attributes:
        x: mm.
        z: mm.
        rotation: angle of the tip's face, rad, positive from +x towards -z.
        pushes_only: it only pushes towards greater values, as a load cell below the finger does;
            the finger may leave it.
    """

    x: float | None = None
    z: float | None = None
    rotation: float | None = None
    pushes_only: bool = False

    @classmethod
    def load_cell(cls, z: float = 0.0) -> Hold:
        """A frictionless load cell below the tip's lower edge, at the height ``z`` mm."""
        return cls(z=z, pushes_only=True)

    @property
    def values(self) -> tuple[float | None, float | None, float | None]:
        """x, z and rotation."""
        return self.x, self.z, self.rotation


@dataclass(frozen=True)
class Surroundings:
    """What acts on the finger besides pressure.

    Attributes:
        objects: rigid, in the way of the finger's lower side.
        friction: Coulomb's coefficient between finger and objects; zero for none.
        dead_forces: that keep their direction.
        tip_moment: on the tip, N mm, positive from +x towards -z.
        gravity: direction (x, z) in which weights of the finger act, a unit vector; None for none.
        hold: of the tip.
        contact: how stiffly objects and finger press against each other.

    Raises:
        BellowsError: The coefficient of friction is negative.
    """

    objects: tuple[Obstacle, ...] = ()
    friction: float = 0.0
    dead_forces: tuple[DeadForce, ...] = ()
    tip_moment: float = 0.0
    gravity: tuple[float, float] | None = None
    hold: Hold = Hold()
    contact: ContactModel = field(default_factory=ContactModel)

    def __post_init__(self) -> None:
        if not self.friction >= 0:
            raise BellowsError(f"friction = {self.friction:g} must not be negative")


@dataclass(frozen=True)
class LoadPoint:
    """How much of the surroundings' loads acts.

    Attributes:
        pressure: MPa.
        forces: factor of the dead forces and of the tip's moment.
        gravity: factor of the weights.
        object_shift: x and z by which the objects are displaced, mm.
        hold_shift: x, z (mm) and rotation (rad) by which the held values are displaced.
    """

    pressure: float = 0.0
    forces: float = 1.0
    gravity: float = 1.0
    object_shift: tuple[float, float] = (0.0, 0.0)
    hold_shift: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def shifted(self, shift: tuple[float, float]) -> LoadPoint:
        """The same with the objects displaced by ``shift`` (x, z in mm)."""
        return replace(self, object_shift=shift)

    def towards(self, other: LoadPoint, fraction: float) -> LoadPoint:
        """The point at ``fraction`` of the straight way to ``other``."""

        def between(start: float, end: float) -> float:
            return end if fraction == 1 else start + fraction * (end - start)

        shift = [between(*each) for each in zip(self.object_shift, other.object_shift, strict=True)]
        hold = [between(*each) for each in zip(self.hold_shift, other.hold_shift, strict=True)]
        return LoadPoint(
            between(self.pressure, other.pressure),
            between(self.forces, other.forces),
            between(self.gravity, other.gravity),
            (shift[0], shift[1]),
            (hold[0], hold[1], hold[2]),
        )
