"""Own bodies for tests: bars, columns and an eighth of a ball."""

from __future__ import annotations

from typing import Any

import cadquery as cq

from bellows_design.own_body import OwnBody

MU = 0.03
"""MPa."""

RUBBER = {"name": "rubber", "model": "neo-hooke", "c10": MU / 2, "yield_strength": 1.0}

STIFF = {"name": "stiff rubber", "model": "neo-hooke", "c10": 50 * MU, "yield_strength": 10.0}


INSIDE = {"box": [[1, 0.1, 1], [19, 4.9, 9.9]]}
"""What chooses the hole of the bar."""


def box(*sides: float, at: tuple[float, float, float] = (0, 0, 0)) -> cq.Solid:
    """A box of these sides from a corner on, mm."""
    return cq.Solid.makeBox(*sides, cq.Vector(*at))


def part(solid: object, name: str = "body", **more: Any) -> dict[str, Any]:
    """A part of rubber."""
    return {"name": name, "solid": solid, "material": RUBBER, **more}


def bar(**more: Any) -> OwnBody:
    """Half of a bar with a closed hole, clamped at one end, under pressure."""
    solid = box(20, 5, 10).cut(box(14, 2, 3, at=(3, 0, 6))).Solids()[0]
    table: dict[str, Any] = {
        "name": "bar",
        "parts": [part(solid, density_kg_m3=1070.0)],
        "surfaces": {
            "root": "<X",
            "tip": ">X",
            "middle": "<Y",
            "cavity": INSIDE,
        },
        "supports": {"symmetry": {"middle": "y"}},
        "load": {"pressure": 0.004},
        "mesh": {"size": 5.0},
    }
    return OwnBody.of(table | more)
