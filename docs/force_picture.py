"""Draw the blocked forces of the force document, with and without contact of neighbouring bubbles.

    python docs/force_picture.py docs/force.png

Needs the extra ``pictures`` (matplotlib). Laws are taken from the store, or computed and kept.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bellows_design import load_design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force.curve import force_curve
from bellows_design.force.law.cell_law import cell_law
from bellows_design.force.law_of_design import finger_law
from bellows_design.force.result import ForceCurve
from bellows_design.reports.plots import COLOURS, two_axes
from bellows_design.store import Store

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DESIGNS = ("prototype_1", "finger")
PRESSURES = tuple(np.linspace(0.005, 0.1, 20).tolist())
"""MPa."""


def curves(name: str) -> tuple[ForceCurve, ForceCurve]:
    """Of a design's tip on a load cell: as it is, and had its bubbles no neighbours."""
    design = load_design(name)
    cell = cell_law(design, store=Store.usual())
    law = finger_law(cell)
    alone = replace(law, piece=cell.without_contact)
    with_contact, without = (
        force_curve(design, Blocked(), PRESSURES, each, by_distance=False) for each in (law, alone)
    )
    return with_contact, without


def panel(axes: Axes, name: str) -> None:
    """Both curves of a design; a cross where the tip snaps off the load cell."""
    for found, line, text in zip(
        curves(name), ("-", "--"), ("with contact of neighbours", "without"), strict=True
    ):
        pressures = [each.pressure_mpa for each in found.curve]
        forces = [each.force_n for each in found.curve]
        axes.plot(pressures, forces, line, color=COLOURS[line == "--"], label=text)
        if line == "-":
            _band(axes, found)
        if not found.converged:
            axes.plot(pressures[-1:], forces[-1:], "x", color=COLOURS[line == "--"])
        print(f"{name} {text}: {forces[-1]:.3f} N at {pressures[-1]:.4g} MPa. {found.message}")
    axes.set(title=name, xlabel="pressure, MPa", ylabel="force, N", xlim=(0, 0.105))
    axes.set_ylim(bottom=0)
    axes.grid(True, linewidth=0.4, alpha=0.4)
    axes.legend(loc="lower right")


def _band(axes: Axes, found: ForceCurve) -> None:
    """The estimated error, where it is one."""
    known = [each for each in found.curve if each.error is not None and each.error.total < 100]
    low, high = (
        [each.force_n * (1 + sign * each.error.total / 100) for each in known if each.error]
        for sign in (-1, 1)
    )
    pressures = [each.pressure_mpa for each in known]
    axes.fill_between(pressures, low, high, color=COLOURS[0], alpha=0.2, linewidth=0)


def draw(target: str) -> None:
    """Write the picture."""
    with two_axes("tip on a load cell at its rest height", Path(target)) as panels:
        for axes, name in zip(panels, DESIGNS, strict=True):
            panel(axes, name)


if __name__ == "__main__":
    draw(sys.argv[1])
