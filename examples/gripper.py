"""A gripper: two or three fingers with flanges on a printed plate, their pads towards its axis.

    python examples/gripper.py gripper --fingers 3 --distance 30

writes ``gripper.step``, the assembly with names and colours, and ``finger.stl`` and ``plate.stl``
to print. The fingers are those of ``finger_gripping.toml``; any design with a flange may take their
place. Every finger's port goes through a hole in the plate, so that its tube comes from behind.
Lengths are in mm.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import cadquery as cq

from bellows_design.design import Design, load_design
from bellows_design.errors import BellowsError
from bellows_design.export.formats import Part, write_part
from bellows_design.geometry.tessellation import tessellate
from bellows_design.pipeline import build_part

FINGER = Path(__file__).with_name("finger_gripping.toml")
CLEARANCE = 0.4
"""mm. Of the holes for the ports."""

MARGIN = 3.0
"""mm. How far the plate reaches beyond the flanges."""

COLOURS = {"plate": cq.Color(0.55, 0.58, 0.62), "finger": cq.Color(0.95, 0.45, 0.1)}


@dataclass(frozen=True)
class Gripper:
    """Fingers of one design around the z axis, on a plate from z = 0 up to its thickness, mm.

    ``distance``: of the fingers' gripping sides from the axis.
    """

    design: Design
    fingers: int = 3
    distance: float = 30.0
    plate_thickness: float = 6.0

    def __post_init__(self) -> None:
        mount = self.design.mount
        if mount is None or mount.kind != "flange":
            raise BellowsError("the gripper's fingers need a mount of the kind flange.")
        if self.fingers not in (2, 3):
            raise BellowsError(f"fingers = {self.fingers} must be 2 or 3.")
        half = mount.width(self.design.bellows, self.design.port) / 2
        least = half / math.tan(math.pi / self.fingers)
        if self.distance < least + CLEARANCE:
            raise BellowsError(
                f"distance = {self.distance:g} mm must be at least {least + CLEARANCE:.3g} mm: "
                "nearer to the axis the flanges meet."
            )

    @property
    def places(self) -> list[cq.Plane]:
        """The frame of each finger: its x along the axis, its lower side towards that."""
        height = self.plate_thickness + self.design.mount.thickness
        angles = (2 * math.pi * number / self.fingers for number in range(self.fingers))
        outwards = [(math.cos(angle), math.sin(angle), 0.0) for angle in angles]
        return [
            cq.Plane((self.distance * x, self.distance * y, height), (0, 0, 1), (x, y, 0))
            for x, y, _ in outwards
        ]

    @property
    def radius(self) -> float:
        """Of the plate: it reaches beyond the flanges' outer corners."""
        design = self.design
        mount, port = design.mount, design.port
        corner = (self.distance + mount.height(port), mount.width(design.bellows, port) / 2)
        return math.hypot(*corner) + MARGIN

    def plate(self) -> cq.Solid:
        """A disc that lies flat on the print bed, with holes for screws and ports."""
        disc = cq.Solid.makeCylinder(self.radius, self.plate_thickness)
        holes = [hole for place in self.places for hole in self._holes(place)]
        return disc.cut(*holes).Solids()[0]

    def assembly(self, finger: cq.Solid, plate: cq.Solid) -> cq.Assembly:
        """Plate and fingers, named and coloured."""
        whole = cq.Assembly(name="gripper")
        whole.add(plate, name="plate", color=COLOURS["plate"])
        for number, place in enumerate(self.places, start=1):
            name, where = f"finger_{number}", cq.Location(place)
            whole.add(finger, name=name, loc=where, color=COLOURS["finger"])
        return whole

    def _holes(self, place: cq.Plane) -> list[cq.Solid]:
        """What one finger takes from the plate: the ways of its screws and of its port."""
        design = self.design
        mount, port = design.mount, design.port
        around_port = math.hypot(port.radius, port.axis_height) + CLEARANCE
        screws = mount.hole_places(design.bellows, port)
        ways = [(mount.hole_diameter / 2, y, z) for _, y, z in screws]
        return [
            cq.Solid.makeCylinder(
                radius,
                3 * self.plate_thickness,
                place.toWorldCoords((-mount.thickness - 2 * self.plate_thickness, y, z)),
                place.xDir,
            )
            for radius, y, z in [*ways, (around_port, 0.0, port.axis_height)]
        ]


def write(gripper: Gripper, folder: Path) -> None:
    """Write the assembly as STEP, finger and plate as checked STL."""
    folder.mkdir(parents=True, exist_ok=True)
    finger, solid = build_part(gripper.design), gripper.plate()
    plate = Part("plate", "of the gripper", gripper.design.digest, solid, tessellate(solid))
    for name, part in (("finger", finger), ("plate", plate)):
        write_part(part, folder / f"{name}.stl")
    gripper.assembly(finger.solid, solid).export(str(folder / "gripper.step"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="where the files go")
    parser.add_argument("--fingers", type=int, default=3, help="2 or 3")
    parser.add_argument("--distance", type=float, default=30.0, help="of a pad from the axis, mm")
    parser.add_argument("--design", default=str(FINGER), help="a design with a flange")
    options = parser.parse_args()
    gripper = Gripper(load_design(options.design), options.fingers, options.distance)
    write(gripper, options.folder)
    print(
        f"{options.folder}: gripper.step, finger.stl, plate.stl, {2 * gripper.radius:.1f} mm wide"
    )


if __name__ == "__main__":
    try:
        main()
    except BellowsError as error:
        raise SystemExit(str(error)) from None
