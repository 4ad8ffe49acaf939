"""Silicone bending actuators with a film: angle and blocked force over the pressure."""

from __future__ import annotations

from functools import partial

from pneunets.figure import draw
from pneunets.paths import Setup, path
from pneunets.report import report
from pneunets.setups import SAMPLE, all_setups
from record import Case, Computed

DIGITS = 6
"""Of readings that are stored."""


def computed(setup: Setup) -> Computed:
    """Readings of all equilibria on the path, by name."""
    mesh, found = setup.mesh(), path(setup)
    readings = {key: [float(f"{row[key]:.{DIGITS}g}") for row in found] for key in found[0]}
    unknowns = mesh.nodes.size + len(mesh.vertices)
    return Computed(readings, len(mesh.tets), unknowns)


CASE = Case(
    "A. Silicone bending actuators with a film",
    {name: partial(computed, setup) for name, setup in all_setups().items()},
    report,
    sample=SAMPLE,
    tolerance=0.03,
    draw=draw,
)
