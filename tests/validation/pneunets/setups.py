"""What is computed of the actuators: bodies, materials, films, and one change at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from pneunets.body import Actuator
from pneunets.paths import Film, Setup, ogden, yeoh

BODIES = {
    "c5-w7": (Actuator(5, 7.0), 46.0, 55.0),
    "c7-w7": (Actuator(7, 7.0), 46.0, 55.0),
    "c5-w10": (Actuator(5, 10.0), 66.0, 65.0),
}
"""Name -> dimensions, and the pressures up to which angle and force were measured, kPa."""

MATERIALS = {"Ogden": ogden(), "Yeoh": yeoh()}

COARSE, FINE = (3.0, 6.0), (2.0, 4.0)
"""Edges at the chambers and elsewhere, mm."""

THIN, STIFF = 0.2, 200.0
"""Thickness of a film that is a solid, mm, and its Young's modulus, MPa: it stretches by half a
percent, and bends by less than a hundredth of the body's stiffness."""

MEMBRANE = Film(82.0)
"""A fiftieth of the published stiffness: a stiffer one, pressed together, folds on the mesh."""


def setup(body: str, material: str, mesh: tuple[float, float] = COARSE) -> Setup:
    """The free actuator; a thin solid closes the chambers."""
    actuator, highest, _ = BODIES[body]
    closed = replace(actuator, layer=0.0, film=THIN)
    near, far = mesh
    film = Film(STIFF, thickness=THIN)
    return Setup(closed, MATERIALS[material], film, near, far, highest=highest)


def with_membrane(given: Setup, film: Film = MEMBRANE, layer: float = 0.5) -> Setup:
    """A layer of silicone closes the chambers, a membrane lies under it."""
    return replace(given, body=replace(given.body, layer=layer, film=0.0), film=film)


BASE = replace(setup("c5-w7", "Ogden"), highest=26.0)
"""Up to where slopes are compared."""


VARIANTS: Mapping[str, Setup] = {
    "weight, hanging": replace(BASE, weight=(1.0, 0.0, 0.0)),
    "membrane under 0.5 mm": replace(with_membrane(BASE), highest=38.6),
    "membrane under 0.5 mm, half as stiff": replace(with_membrane(BASE, Film(41.0)), highest=36.8),
    "membrane under 0.5 mm, finer mesh": replace(
        with_membrane(setup("c5-w7", "Ogden", FINE)), highest=36.5
    ),
}
"""One change each of c5-w7, Ogden."""

CLAMP = 5.0
"""Length of the body in the clamp where the force was measured, mm."""


def force_setup(body: str, material: str, missing: int, gap: float = 0.0) -> Setup:
    """The actuator with its tip on a plate, ``missing`` chambers filled at the clamp."""
    free = setup(body, material)
    longer = replace(free.body, clamp=CLAMP, missing=missing)
    return replace(free, body=longer, plate=True, gap=gap, highest=BODIES[body][2])


FREE = (
    ("c5-w7", "Ogden"),
    ("c5-w7", "Yeoh"),
    ("c7-w7", "Ogden"),
    ("c5-w10", "Ogden"),
    ("c5-w10", "Yeoh"),
)
"""Bodies and materials of which the angle is computed."""

FORCED = (("c5-w7", "Ogden", 0), ("c5-w7", "Ogden", 1))
"""Bodies, materials and missing chambers of which the force is computed."""


def all_setups() -> dict[str, Setup]:
    """Name of a computation -> setup."""
    found = {f"{body}, {material}": setup(body, material) for body, material in FREE}
    found |= {f"c5-w7, {name}": changed for name, changed in VARIANTS.items()}
    found |= {
        f"force {body}, {material}, {missing} missing": force_setup(body, material, missing)
        for body, material, missing in FORCED
    }
    return found
