"""The case in CalculiX: ten-node tetrahedra C3D10 by displacements alone, it has no mixed ones.

Its Ogden needs D1 = 2/K; left out, CalculiX takes a Poisson's ratio of 0.475. Version 2.20 does not
get past small loads with its Ogden, not even with both exponents 2, where the same deck with
*HYPERELASTIC, NEO HOOKE converges in two or three iterations a step. Needs the command ``ccx``.
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from case import (
    ALPHA,
    MU,
    Case,
    Integers,
    Progress,
    Reals,
    main,
    report,
)

ABAQUS_ORDER = (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
INCREMENTS = "0.05, 1., 1e-4, 0.2"
"""First, total, smallest and largest time of CalculiX's automatic increments."""
POLL_SECONDS = 0.5


def deck(case: Case, pressure: float) -> Iterator[str]:
    """Lines of the input file; time 1 is the whole ``pressure`` (MPa)."""
    yield "*NODE, NSET=ALL"
    yield from table(case.nodes)
    yield "*ELEMENT, TYPE=C3D10, ELSET=SOLID"
    yield from table(case.tets[:, ABAQUS_ORDER] + 1)
    for name, numbers in (("ROOT", case.root), ("SYMMETRY", case.symmetry)):
        yield f"*NSET, NSET={name}"
        yield from (f"{number + 1}," for number in numbers)
    yield from ("*BOUNDARY", "ROOT, 1, 3", "SYMMETRY, 2, 2")
    yield from ("*MATERIAL, NAME=NINJAFLEX", "*HYPERELASTIC, OGDEN, N=2")
    yield f"{MU[0]!r}, {ALPHA[0]!r}, {MU[1]!r}, {ALPHA[1]!r}, 0., 0."
    yield "*SOLID SECTION, ELSET=SOLID, MATERIAL=NINJAFLEX"
    yield from ("*STEP, NLGEOM, INC=1000", "*STATIC", INCREMENTS, "*DLOAD")
    for element, face in cavity_faces(case):
        yield f"{element + 1}, P{face + 1}, {pressure:.12g}"
    yield from ("*NODE PRINT, NSET=ALL", "U", "*END STEP")


def table(rows: Reals | Integers) -> Iterator[str]:
    """Numbered lines; CalculiX reads at most 20 characters of a number."""
    for number, row in enumerate(rows.tolist(), start=1):
        yield ", ".join([str(number), *(f"{value:.12g}" for value in row)])


def cavity_faces(case: Case) -> Iterator[tuple[int, int]]:
    """Element and its face, both from 0, of each triangle of the cavity."""
    wanted = {tuple(row) for row in np.sort(case.cavity[:, :3], axis=1).tolist()}
    for face, corners in enumerate(FACES):
        found = np.sort(case.tets[:, corners], axis=1).tolist()
        for element, triangle in enumerate(found):
            if tuple(triangle) in wanted:
                yield element, face


def run(case: Case, pressure: float) -> None:
    """Solve in a temporary directory and report."""
    if shutil.which("ccx") is None:
        sys.exit("not installed: ccx")
    version = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.split()[-1]
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        (directory / "job.inp").write_text("\n".join(deck(case, pressure)) + "\n")
        progress = Progress(case, memory_of=resource.RUSAGE_CHILDREN)
        message = solve(directory, case, pressure, progress)
    report("CalculiX", version, progress, message)


def solve(directory: Path, case: Case, pressure: float, progress: Progress) -> str:
    """Run ccx, telling its progress; returns how it ended."""
    with (directory / "log").open("w") as log:
        process = subprocess.Popen(["ccx", "job"], cwd=directory, stdout=log, stderr=log)
        while process.poll() is None:
            time.sleep(POLL_SECONDS)
            follow(directory, case, pressure, progress)
    follow(directory, case, pressure, progress)
    if np.isclose(progress.reached_mpa, pressure):
        return f"reached {pressure:.4g} MPa"
    return f"stopped at {progress.reached_mpa:.4g} MPa: {reason(directory / 'log')}"


def follow(directory: Path, case: Case, pressure: float, progress: Progress) -> None:
    """Read the increments that have converged since, and all iterations."""
    iterations = len(numbers(directory / "job.cvg"))
    changed, progress.iterations = iterations != progress.iterations, iterations
    converged = [row for row in numbers(directory / "job.sta") if "U" not in row[2]]
    if len(converged) > progress.load_steps:
        states = displacements(directory / "job.dat", len(case.nodes))
        for time_reached, displacement in states[progress.load_steps :]:
            progress.reached(time_reached * pressure, displacement)
    elif changed:
        progress.tell()


def numbers(path: Path) -> list[list[str]]:
    """Rows of a table of CalculiX without its headings."""
    if not path.exists():
        return []
    rows = [line.split() for line in path.read_text().splitlines()]
    return [row for row in rows if row and row[0].isdigit()]


def displacements(path: Path, count: int) -> list[tuple[float, Reals]]:
    """Time and displacement (n, 3), mm, of every increment that is written down completely."""
    states = []
    for block in path.read_text().split("displacements")[1:]:
        heading, *lines = block.strip().splitlines()
        if len(lines) >= count:
            rows = [line.split()[1:4] for line in lines if line.strip()][:count]
            states.append((float(heading.split()[-1]), np.array(rows, float)))
    return states


def reason(log: Path) -> str:
    """What CalculiX says went wrong."""
    lines = [line.strip() for line in log.read_text().splitlines() if line.strip()]
    errors = [position for position, line in enumerate(lines) if "*ERROR" in line]
    if errors:
        return " ".join(lines[errors[0] : errors[0] + 2])
    attempts = sum("attempt" in line and line.startswith("increment") for line in lines)
    return f"no convergence in {attempts} attempts"


if __name__ == "__main__":
    main(run, __doc__)
