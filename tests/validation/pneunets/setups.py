"""What is computed of the actuators: bodies, materials, meshes, and one change at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from pneunets.body import Actuator
from pneunets.paths import Film, Setup, ogden, yeoh

BODIES = {
    "c5-w7": (Actuator(5, 7.0), 46.0),
    "c7-w7": (Actuator(7, 7.0), 46.0),
    "c5-w10": (Actuator(5, 10.0), 66.0),
}
"""Name -> dimensions, and the pressure up to which the angle was measured, kPa."""

MATERIALS = {"Ogden": ogden(), "Yeoh": yeoh()}

MESHES = {"coarse": (3.0, 6.0), "middle": (2.0, 4.0), "fine": (1.2, 3.5)}
"""Edges at the chambers and elsewhere, mm."""

PUBLISHED = 4100.0
"""Young's modulus of the film, MPa."""


def setup(body: str, material: str, mesh: str) -> Setup:
    """The free actuator."""
    actuator, highest = BODIES[body]
    near, far = MESHES[mesh]
    return Setup(actuator, MATERIALS[material], near=near, far=far, highest=highest)


BASE = setup("c5-w7", "Ogden", "coarse")


def with_body(**changes: float | bool) -> Setup:
    """The base with another body."""
    return replace(BASE, body=replace(BASE.body, **changes))  # type: ignore[arg-type]


def with_film(factor: float) -> Setup:
    """The base with a film that is stiffer by a factor."""
    modulus = factor * BASE.film.young_modulus
    return replace(BASE, film=replace(BASE.film, young_modulus=modulus))


VARIANTS: Mapping[str, Setup] = {
    "film half as stiff": with_film(0.5),
    "film twice as stiff": with_film(2.0),
    "film without lateral contraction": replace(
        BASE, film=Film(BASE.film.young_modulus, poisson_ratio=0.0)
    ),
    "layer 0.25 mm": with_body(layer=0.25),
    "layer 1 mm": with_body(layer=1.0),
    "inlet open": with_body(inlet_open=True),
    "weight, hanging": replace(BASE, weight=(1.0, 0.0, 0.0)),
    "weight, standing": replace(BASE, weight=(-1.0, 0.0, 0.0)),
    "weight, film below": replace(BASE, weight=(0.0, 0.0, -1.0)),
    "weight, film above": replace(BASE, weight=(0.0, 0.0, 1.0)),
    "Poisson's ratio 0.45": replace(BASE, material=ogden(0.45)),
    "Poisson's ratio 0.49": replace(BASE, material=ogden(0.49)),
    "Poisson's ratio 0.499": replace(BASE, material=ogden(0.499)),
    "material 15 % softer": replace(BASE, material=ogden(stiffness=0.85)),
}
"""One change each of c5-w7, Ogden, on the coarse mesh."""

CLAMP = 5.0
"""Length of the body in the clamp where the force was measured, mm."""

FORCE_ENDS = {"c5-w7": 55.0, "c7-w7": 55.0, "c5-w10": 65.0}


def force_setup(body: str, material: str, mesh: str, missing: int) -> Setup:
    """The actuator with its tip on a plate, ``missing`` chambers filled at the clamp."""
    free = setup(body, material, mesh)
    longer = replace(free.body, clamp=CLAMP, missing=missing)
    return replace(free, body=longer, plate=True, highest=FORCE_ENDS[body])


def all_setups() -> dict[str, Setup]:
    """Name of a computation -> setup."""
    found = {
        f"{body}, {material}": setup(body, material, "middle")
        for body in BODIES
        for material in MATERIALS
    }
    found["c5-w7, Ogden, fine mesh"] = setup("c5-w7", "Ogden", "fine")
    found |= {f"{body}, Ogden, coarse mesh": setup(body, "Ogden", "coarse") for body in BODIES}
    found |= {f"c5-w7, {name}": changed for name, changed in VARIANTS.items()}
    found |= {
        f"force {body}, {material}, {missing} missing": force_setup(body, material, "coarse", missing)
        for body in BODIES
        for material in MATERIALS
        for missing in (0, 1)
    }
    found["force c5-w7, Ogden, 0 missing, middle mesh"] = force_setup("c5-w7", "Ogden", "middle", 0)
    return found
