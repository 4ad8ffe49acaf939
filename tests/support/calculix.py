"""CalculiX, where it is installed: a deck computed, and the displacements that it prints."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from solver import Problem, write_deck

NAMES = ("ccx", "ccx_2.22", "ccx_2.21", "ccx_2.20")
SECONDS = 540.0

TABLE = "displacements (vx,vy,vz)"


def calculix() -> str | None:
    """The program; None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def displacement_by_calculix(
    problem: Problem, pressure: float, folder: Path
) -> NDArray[np.float64] | None:
    """Displacement (n, 3) in mm under the whole load, None if CalculiX does not reach it.

    The deck is that of ``write_deck`` but for one request of output more.
    """
    deck = folder / "job.inp"
    write_deck(deck, problem, pressure, "calculix")
    everywhere = f"*NSET, NSET=everywhere, GENERATE\n1, {len(problem.mesh.nodes)}\n*STEP"
    asked = deck.read_text().replace("*STEP", everywhere, 1)
    wanted = "*NODE PRINT, NSET=everywhere\nU\n*END STEP"
    deck.write_text(asked.replace("*END STEP", wanted))
    program = calculix()
    assert program is not None
    subprocess.run(
        [program, "job"],
        cwd=folder,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        capture_output=True,
        timeout=SECONDS,
    )
    return _last(folder / "job.dat", len(problem.mesh.nodes))


def _last(path: Path, nodes: int) -> NDArray[np.float64] | None:
    """The last table of displacements, if it is that of the whole load."""
    head, *rows = path.read_text().split(TABLE)[-1].strip().splitlines()
    if float(head.split()[-1]) < 1.0:
        return None
    return np.array([row.split()[1:] for row in rows if len(row.split()) == 4][:nodes], float)
