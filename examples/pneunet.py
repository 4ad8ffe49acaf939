"""A silicone bending actuator above a silk film: its angle over the pressure.

Half of it by symmetry about y = 0; mm, N, MPa. Shape and material of Moseley et al., Advanced
Engineering Materials 18 (2016), whose chambers are closed by the film alone.
"""

import cadquery as cq

from bellows_design import OwnBody
from bellows_design.evaluation import evaluate, write_vtu

N, WALL, LAYER = 5, 7, 0.5  # chambers, walls between them, silicone below them
L, W, H = N * 2 + (N + 1) * WALL, 4 + WALL, 8 + WALL
ECOFLEX = {"mu": [0.024361, 6.6703e-5, 4.5381e-4], "alpha": [1.71378, 7.06787, -3.36588]}


def pneunet(size: float = 4.0, largest_volume: float = 20.0) -> OwnBody:
    """Meshed with edges of ``size`` and inflated to that multiple of its air."""
    half = cq.Workplane().box(L, W, H + LAYER, centered=False).translate((0, 0, -LAYER))
    half = half.cut(cq.Workplane().box(L - WALL, 1, 2, centered=False))  # inlet and tunnel
    for start in range(WALL, L - WALL, WALL + 2):
        half = half.cut(cq.Workplane(origin=(start, 0, 0)).box(2, 4, 8, centered=False))
    inside = {"box": [[0.1, 0.1, -0.1], [L - 0.1, W - 0.1, H - 0.1]]}
    return OwnBody(
        name=f"pneunet_c{N}_w{WALL}",
        parts=[{"name": "body", "solid": half, "material": {**ECOFLEX, "yield_strength": 1.4}}],
        surfaces={"root": "<X", "tip": ">X", "middle": "<Y", "bottom": "<Z", "cavity": inside},
        supports={"symmetry": {"middle": "y"}},
        load={"largest_volume": largest_volume},
        films=[{"surface": "bottom", "young_modulus": 4100.0, "thickness": 0.5}],
        tip={"point": [L, 0, -LAYER], "base": [0, 0, -LAYER]},
        mesh={"size": size},
    )


if __name__ == "__main__":
    found = evaluate(pneunet())
    for at in found.curve:
        print(f"{1e3 * at.pressure_mpa:6.2f} kPa {at.chord_angle_deg:7.2f} degrees")
    write_vtu(found, "pneunet.vtu")
