"""A body that was solved as it is, or as what lies on one side of planes of symmetry."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from bellows_design.deformed.joined.copies import Assembled, Copy, Placed
from bellows_design.deformed.joined.motion import Motion
from bellows_design.deformed.joined.state import ActuatorState
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.face_names import CAVITY, OUTSIDE, ROOT, SYMMETRY, TIP
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

FACES = {name: name for name in (OUTSIDE, CAVITY, ROOT, TIP)}


@dataclass(frozen=True)
class Single:
    """All of an actuator, or its half with its mirror image at y = 0."""

    assembled: Assembled

    @staticmethod
    def of(mesh: Mesh) -> Single:
        """From its mesh, half if that has a surface ``symmetry``."""
        planes = {SYMMETRY: 1} if SYMMETRY in mesh.surfaces else {}
        return Single(Assembled.of([mesh], mirrored_copies(planes, FACES)))

    def at_rest(self, bellows: BellowsParameters, state: ActuatorState) -> Placed:
        """Without load, on the mesh of ``state``, which may be a moved one."""
        del bellows
        return Placed((state.body.nodes,), (Motion(),))

    def loaded(self, bellows: BellowsParameters, state: ActuatorState) -> Placed:
        """Under load."""
        del bellows
        return Placed((state.body.moved,), (Motion(),))

    def values(self, body: Reals, ends: Reals | None) -> tuple[Reals, ...]:
        """Values at the nodes of the body."""
        del ends
        return (body,)


def mirrored_copies(planes: Mapping[str, int], named: Mapping[str, str]) -> list[Copy]:
    """A body and its images at planes through the origin: surface -> axis it is normal to."""
    copies = [Copy(0, (1, 1, 1), 0, (), named)]
    for surface, axis in planes.items():
        copies += [
            _image(copy, number, len(copies), surface, axis) for number, copy in enumerate(copies)
        ]
    return copies


def _image(copy: Copy, number: int, count: int, surface: str, axis: int) -> Copy:
    """The image of copy ``number`` of ``count``, which are all mirrored one after the other."""
    x, y, z = (-sign if along == axis else sign for along, sign in enumerate(copy.signs))
    among_images = tuple((name, other + count) for name, other in copy.shared)
    return replace(copy, signs=(x, y, z), shared=(*among_images, (surface, number)))
