"""A silicone bending actuator of chambers above a film that does not stretch: angle over pressure.

    python examples/pneunet.py pneunet.vtu

Half of it by symmetry about y = 0; mm, N, MPa. Chambers, tunnel and inlet as in Moseley et al.,
Advanced Engineering Materials 18 (2016), 978; there the film itself closes them.
"""

import sys
from pathlib import Path

import cadquery as cq

from bellows_design import BodyPart, OwnBody
from bellows_design.evaluation import evaluate, write_vtu

COUNT, WALL, LAYER = 5, 7.0, 0.5
LENGTH, WIDTH, HEIGHT = COUNT * 2 + (COUNT + 1) * WALL, 8 + 2 * WALL, 8 + WALL


def pneunet(size: float = 4.0, largest_volume: float = 3.0) -> OwnBody:
    """The actuator on a mesh of edges of ``size``, inflated to that multiple of its air."""
    half = cq.Workplane().box(LENGTH, WIDTH / 2, HEIGHT + LAYER, centered=False)
    half = half.translate((0, 0, -LAYER))
    half = half.cut(cq.Workplane().box(LENGTH - WALL, 1, 2, centered=False))  # inlet and tunnel
    for start in (WALL + k * (2 + WALL) for k in range(COUNT)):
        half = half.cut(cq.Workplane(origin=(start, 0, 0)).box(2, 4, 8, centered=False))
    inside = {"box": [[0.1, 0.1, -0.1], [LENGTH - 0.1, WIDTH / 2 - 0.1, HEIGHT - 0.1]]}
    return OwnBody(
        name=f"pneunet_c{COUNT}_w{WALL:.0f}",
        parts=[BodyPart(name="silicone", solid=half, material="ecoflex_00_30")],
        surfaces={"root": "<X", "tip": ">X", "middle": "<Y", "bottom": "<Z", "cavity": inside},
        supports={"clamped": "root", "symmetry": {"middle": "y"}},
        load={"largest_volume": largest_volume},
        films=[{"surface": "bottom", "young_modulus": 4100, "poisson_ratio": 0.49, "thickness": 0.5}],
        tip={"point": [LENGTH, 0, -LAYER], "base": [0, 0, -LAYER]},
        mesh={"size": size},
    )  # fmt: skip


if __name__ == "__main__":
    found = evaluate(pneunet())
    for at in found.curve:
        print(f"{1e3 * at.pressure_mpa:6.2f} kPa {at.chord_angle_deg:7.2f} degrees")
    write_vtu(found, Path(sys.argv[1] if len(sys.argv) > 1 else "pneunet.vtu"))
