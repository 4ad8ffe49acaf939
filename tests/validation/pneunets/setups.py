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

COARSE, FINE, SAMPLE = (3.0, 6.0), (2.0, 4.0), (4.0, 8.0)
"""Edges at the chambers and elsewhere, mm."""

THIN, STIFF = 0.2, 200.0
"""Thickness of a film that is a solid, mm, and its Young's modulus, MPa: it stretches by half a
percent, and bends by less than a hundredth of the body's stiffness."""

MEMBRANE = Film(82.0)
"""A fiftieth of the published stiffness: with more the film, pressed together, folds on the mesh."""


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


BASE = setup("c5-w7", "Ogden")


def with_body(**changes: float | bool) -> Setup:
    """The base with another body."""
    return replace(BASE, body=replace(BASE.body, **changes))  # type: ignore[arg-type]


VARIANTS: Mapping[str, Setup] = {
    "material 15 % softer": replace(BASE, material=ogden(stiffness=0.85)),
    "weight, hanging": replace(BASE, weight=(1.0, 0.0, 0.0)),
    "weight, standing": replace(BASE, weight=(-1.0, 0.0, 0.0)),
    "weight, film below": replace(BASE, weight=(0.0, 0.0, -1.0)),
    "weight, film above": replace(BASE, weight=(0.0, 0.0, 1.0)),
    "Poisson's ratio 0.45": replace(BASE, material=ogden(0.45)),
    "Poisson's ratio 0.499": replace(BASE, material=ogden(0.499)),
    "inlet open": with_body(inlet_open=True),
    "film half as stiff": replace(BASE, film=Film(STIFF / 2, thickness=THIN)),
    "film twice as stiff": replace(BASE, film=Film(STIFF * 2, thickness=THIN)),
    "0.5 mm of silicone above the film": with_body(layer=0.5),
    "membrane under 0.5 mm": with_membrane(BASE),
    "membrane under 0.5 mm, half as stiff": with_membrane(BASE, Film(41.0)),
    "membrane under 0.5 mm, finer mesh": with_membrane(setup("c5-w7", "Ogden", FINE)),
}
"""One change each of c5-w7, Ogden."""

CLAMP = 5.0
"""Length of the body in the clamp where the force was measured, mm."""

GAPS = (10.0, 20.0)
"""Of the plate, degrees."""


def force_setup(body: str, material: str, missing: int, gap: float = 0.0) -> Setup:
    """The actuator with its tip on a plate, ``missing`` chambers filled at the clamp."""
    free = setup(body, material)
    longer = replace(free.body, clamp=CLAMP, missing=missing)
    return replace(free, body=longer, plate=True, gap=gap, highest=BODIES[body][2])


def all_setups() -> dict[str, Setup]:
    """Name of a computation -> setup."""
    found = {
        f"{body}, {material}": setup(body, material) for body in BODIES for material in MATERIALS
    }
    found["c5-w7, finer mesh"] = setup("c5-w7", "Ogden", FINE)
    found |= {f"c5-w7, {name}": changed for name, changed in VARIANTS.items()}
    found |= {
        f"force {body}, {material}, {missing} missing": force_setup(body, material, missing)
        for body in BODIES
        for material in MATERIALS
        for missing in (0, 1)
    }
    found |= {
        f"force c5-w7, plate at {gap:g}°": force_setup("c5-w7", "Ogden", 0, gap) for gap in GAPS
    }
    found["sample"] = replace(setup("c5-w7", "Ogden", SAMPLE), highest=1.0)
    return found
