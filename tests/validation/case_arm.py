"""One chamber of a silicone arm with four."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from arm_body import DATA, LENGTH, half_arm
from arm_report import COARSE, FREE, READINGS, SAMPLE, draw, on_mesh, report
from record import Case, Computed
from rigid_patch import RigidMotion, motion_of

from solver import BodyForce, Membrane, Ogden, Problem, Solution, SolverOptions, Supports, solve

THREAD = {"young_modulus": 1000.0, "poisson_ratio": 0.3, "thickness": 1.0}
"""MPa and mm: a hundred times as stiff as the silicone that it holds: it hardly stretches."""


def silicone() -> Ogden:
    """Neo-Hooke with the authors' moduli."""
    young, ratio = DATA["young_modulus_mpa"], DATA["poisson_ratio"]
    return Ogden((young / 2 / (1 + ratio),), (2.0,), young / 3 / (1 - 2 * ratio))


def bent(wound: str, size: float, windings: int, most: float = math.inf) -> Computed:
    """Hung up, then blown up to 45 kPa in steps; what was reached of them.

    Args:
        wound: surface with a thread around it, or "" for none.
        size: of the section's triangles, mm.
        windings: of the thread, and layers along the arm.
        most: kPa, up to which pressure.
    """
    mesh = half_arm(size, windings)
    weight = DATA["density_kg_m3"] * DATA["gravity_m_s2"] * 1e-9
    supports = Supports(clamped=("base",), symmetry={"symmetry": 1})
    given = {
        "loads": (BodyForce((weight, 0.0, 0.0)),),
        "membranes": (Membrane(f"{wound} thread", **THREAD, wrinkles=False),) if wound else (),
    }
    hung = solve(Problem(mesh, silicone(), supports, **given))
    assert hung.converged, hung.message
    pressures = [1e-3 * row[0] for row in DATA["measured"]["rows"] if row[0] <= most]
    blown = solve(
        Problem(mesh, silicone(), supports, ("pressed",), **given),
        pressures[-1],
        stops=pressures[:-1],
        options=SolverOptions(smallest_step=0.01),
        after=hung,
    )
    states = (*blown.at_stops, *((blown,) if blown.converged else ()))
    readings = {
        "pressure_kpa": [1e3 * state.pressure for state in states],
        "tip_mm": [tip(hung, state) for state in states],
        "tilt_deg": [end(state).tilt - end(hung).tilt for state in states],
        "last_kpa": 1e3 * blown.pressure,
        "limit_kpa": 1e3 * (blown.limit or 0.0),
    }
    return Computed(readings, len(mesh.tets), mesh.nodes.size + len(mesh.vertices))


def end(state: Solution) -> RigidMotion:
    """The rigid motion of the end face."""
    return motion_of(state, "tip")


def tip(hung: Solution, state: Solution) -> float:
    """Mean distance that the markers moved from where they hung, mm."""
    before, after = end(hung), end(state)
    places = [np.array([LENGTH, *place]) for place in DATA["markers_mm"]["across_along"]]
    moved = [after.displacement(place) - before.displacement(place) for place in places]
    return float(np.mean([np.linalg.norm(each[[0, 2]]) for each in moved]))


CASE = Case(
    "C. One chamber of a silicone arm",
    {
        **{on_mesh(name, COARSE): partial(bent, READINGS[name], *COARSE) for name in READINGS},
        SAMPLE: partial(bent, READINGS[FREE], 9.0, 3, 10.0),
    },
    report,
    sample=SAMPLE,
    slow=True,
    tolerance=0.05,
    draw=draw,
)
