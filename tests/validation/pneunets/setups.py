"""What is computed of the actuators: bodies, materials, films, and one change at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from pneunets.body import Actuator
from pneunets.paths import Film, Setup, ogden, yeoh

BODIES = {
    "c5-w7": (Actuator(5, 7.0), 46.0, 45.5),
    "c7-w7": (Actuator(7, 7.0), 41.0, 40.5),
    "c5-w10": (Actuator(5, 10.0), 51.0, 46.0),
}
"""Name -> dimensions, and the pressures up to which angle and force are computed, kPa."""

MATERIALS = {"Ogden": ogden(), "Yeoh": yeoh()}

COARSE, FINE = (3.0, 6.0), (2.0, 4.0)
"""Edges at the chambers and elsewhere, mm."""

THIN = 0.1
"""Thickness of the film as a solid, mm."""

FILM = Film(4100.0 * 0.5 / THIN, thickness=THIN)
"""Stretches as the published membrane of 4100 MPa and 0.5 mm does."""


def setup(body: str, material: str, mesh: tuple[float, float] = COARSE) -> Setup:
    """The free actuator; the film, a thin solid, closes the chambers."""
    actuator, highest, _ = BODIES[body]
    closed = replace(actuator, layer=0.0, film=THIN)
    near, far = mesh
    return Setup(closed, MATERIALS[material], FILM, near, far, highest=highest)


BASE = replace(setup("c5-w7", "Ogden"), highest=40.5)
"""Up to where changes are compared."""


SHORT = replace(BASE, highest=30.0)
"""Up to before the knee."""


def with_film(stiffness: float) -> Setup:
    """The film's stiffness changed by a factor."""
    changed = replace(FILM, young_modulus=stiffness * FILM.young_modulus)
    return replace(BASE, film=changed)


def wrinkling(body: str, highest: float) -> Setup:
    """The published membrane under 0.5 mm of silicone; it bears no compression."""
    return replace(
        setup(body, "Ogden"), body=BODIES[body][0], film=Film(wrinkles=True), highest=highest
    )


VARIANTS: Mapping[str, Setup] = {
    "film that wrinkles": wrinkling("c5-w7", 44.0),
    "film a fiftieth as stiff": with_film(0.02),
    "film of 0.05 mm, stretching alike": replace(
        BASE,
        body=replace(BASE.body, film=THIN / 2),
        film=Film(2 * FILM.young_modulus, thickness=THIN / 2),
    ),
    "weight, film below": replace(SHORT, weight=(0.0, 0.0, -1.0)),
    "weight, tip down": replace(SHORT, weight=(1.0, 0.0, 0.0)),
    "ν 0.45": replace(SHORT, material=ogden(0.45)),
    "ν 0.49": replace(SHORT, material=ogden(0.49)),
}
"""One change each of c5-w7, Ogden."""

WRINKLING: Mapping[str, Setup] = {
    "c7-w7, film that wrinkles": wrinkling("c7-w7", 30.5),
    "c5-w10, film that wrinkles": wrinkling("c5-w10", 30.5),
}
"""The same change of the other bodies, up to before the knee."""

FINER = {"c5-w7, Ogden, finer mesh": replace(setup("c5-w7", "Ogden", FINE), highest=42.0)}

SAMPLE = "c5-w7, Ogden, coarsest mesh"
"""What tests repeat: the first four equilibria."""

SAMPLED = replace(setup("c5-w7", "Ogden", (5.0, 10.0)), highest=1.0)

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
    ("c7-w7", "Yeoh"),
    ("c5-w10", "Ogden"),
    ("c5-w10", "Yeoh"),
)
"""Bodies and materials of which the angle is computed."""

FORCED = (("c5-w7", "Ogden"), ("c7-w7", "Ogden"), ("c5-w10", "Ogden"))
"""Bodies and materials of which the force is computed, for both readings of the clamp."""

AWAY = 5.0
"""Angle by which the plate may lean away, degrees: where the free tip is at some 30 kPa."""

PLATES: Mapping[str, Setup] = {
    f"{missing} missing, plate {AWAY:g}° away": force_setup("c5-w7", "Ogden", missing, gap=AWAY)
    for missing in (0, 1)
}
"""Force of c5-w7, Ogden, on a plate that stands away."""


def all_setups() -> dict[str, Setup]:
    """Name of a computation -> setup."""
    found = {f"{body}, {material}": setup(body, material) for body, material in FREE}
    found |= FINER | {SAMPLE: SAMPLED}
    found |= {f"c5-w7, {name}": changed for name, changed in VARIANTS.items()} | WRINKLING
    found |= {
        f"force {body}, {material}, {missing} missing": force_setup(body, material, missing)
        for body, material in FORCED
        for missing in (0, 1)
    }
    found |= {f"force c5-w7, {name}": changed for name, changed in PLATES.items()}
    return found
