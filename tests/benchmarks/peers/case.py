"""The case every code solves, and how each of them reports.

Half of the paper's Prototype 1: 11 477 quadratic tetrahedra, clamped at the root, symmetric in
y = 0, 0.1 MPa of follower pressure in the cavity, NinjaFlex as an incompressible Ogden rubber.
Units: mm, N, MPa, s, degrees.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

STARTED = time.perf_counter()
THREADS = 2
for _variable in ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_variable, str(THREADS))  # read when the libraries are loaded

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

Reals = NDArray[np.float64]
Integers = NDArray[np.int64]

DATA = Path(__file__).parents[2] / "solver/data/half_actuator.npz"
FULL_PRESSURE = 0.1
MU = (0.19825, 3.2778)
ALPHA = (3.05, -0.0054)
"""NinjaFlex in Abaqus's form, W = sum 2 mu / alpha^2 (l1^alpha + l2^alpha + l3^alpha - 3), MPa."""


@dataclass(frozen=True)
class Case:
    """The reference half actuator.

    ``nodes`` (n, 3), ``tets`` (e, 10) and ``cavity`` (k, 6) in Gmsh's order, normals out of the
    solid; ``root``, ``symmetry``, ``tip`` node numbers; ``displacement`` (n, 3) at 0.1 MPa;
    ``stations``: where our solver places the stations of its axis, mm.
    """

    nodes: Reals
    tets: Integers
    cavity: Integers
    root: Integers
    symmetry: Integers
    tip: Integers
    displacement: Reals
    stations: Reals
    surfaces: dict[str, Integers]

    @property
    def corners(self) -> Integers:
        """Sorted numbers of the nodes at corners of tetrahedra, which carry pressures."""
        return np.unique(self.tets[:, :4])

    @property
    def size(self) -> float:
        """Diagonal of the bounding box, mm."""
        return float(np.linalg.norm(np.ptp(self.nodes, axis=0)))


def load_case(path: Path = DATA) -> Case:
    """Read the reference mesh and its converged displacement."""
    data = np.load(path)
    surfaces = {
        key.removeprefix("surface_"): data[key].astype(np.int64)
        for key in data.files
        if key.startswith("surface_")
    }
    root, symmetry, tip = (np.unique(surfaces[name]) for name in ("root", "symmetry", "tip"))
    return Case(
        nodes=data["nodes"].astype(np.float64),
        tets=data["tets"].astype(np.int64),
        cavity=surfaces["cavity"],
        root=root,
        symmetry=symmetry,
        tip=tip,
        displacement=data["displacement"].astype(np.float64),
        stations=data["stations"],
        surfaces=surfaces,
    )


def peak_memory_mib(who: int = resource.RUSAGE_SELF) -> float:
    """Largest resident set so far, MiB."""
    peak = resource.getrusage(who).ru_maxrss
    return peak / (1024**2 if sys.platform == "darwin" else 1024)


@dataclass
class Progress:
    """What a solve has reached, told to ``compare.py`` as JSON lines on stderr.

    ``seconds`` count from here, with the code imported and the mesh in memory, and so include what
    the code prepares once per mesh; ``total_seconds`` from the start of the script.

    ``load_steps`` counts those that converged, ``iterations`` all linear solves for Newton
    corrections, those of steps that were cut back included. ``rotation_deg`` of the tip about y
    is positive towards -z and unwrapped along the load path, ``difference_mm`` the largest
    component of displacement minus reference (at full load only).
    """

    case: Case
    started: float = field(default_factory=time.perf_counter)
    memory_of: int = resource.RUSAGE_SELF
    iterations: int = 0
    load_steps: int = 0
    reached_mpa: float = 0.0
    rotation_deg: float = 0.0
    difference_mm: float | None = None

    def reached(self, pressure: float, displacement: Reals) -> None:
        """A load step has converged at ``pressure`` (MPa) with ``displacement`` (n, 3)."""
        self.load_steps += 1
        self.reached_mpa = pressure
        turned = tip_rotation(self.case, displacement)
        self.rotation_deg = float(np.unwrap([self.rotation_deg, turned], period=360.0)[1])
        self.compare(pressure, displacement)
        self.tell()

    def compare(self, pressure: float, displacement: Reals) -> None:
        """Measure the difference to the reference, if it is of this ``pressure`` (MPa)."""
        if np.isclose(pressure, FULL_PRESSURE):
            self.difference_mm = float(np.abs(displacement - self.case.displacement).max())

    def tell(self) -> None:
        """Print where the solve is."""
        print(json.dumps(self.numbers()), file=sys.stderr, flush=True)

    def numbers(self) -> dict[str, Any]:
        """Everything measured so far."""
        now = time.perf_counter()
        return {
            "seconds": now - self.started,
            "total_seconds": now - STARTED,
            "iterations": self.iterations,
            "load_steps": self.load_steps,
            "reached_mpa": self.reached_mpa,
            "rotation_deg": self.rotation_deg,
            "difference_mm": self.difference_mm,
            "peak_memory_mib": peak_memory_mib(self.memory_of),
        }


def tip_rotation(case: Case, displacement: Reals) -> float:
    """Best-fit in-plane rotation of the tip about y, degrees in (-180, 180]."""
    before = case.nodes[case.tip][:, [0, 2]]
    after = before + displacement[case.tip][:, [0, 2]]
    before, after = before - before.mean(axis=0), after - after.mean(axis=0)
    sine = before[:, 1] @ after[:, 0] - before[:, 0] @ after[:, 1]
    return float(np.degrees(np.arctan2(sine, (before * after).sum())))


@dataclass(frozen=True)
class Report:
    """The JSON object each code prints on stdout; ``message`` says why it stopped."""

    name: str
    version: str
    seconds: float
    total_seconds: float
    iterations: int
    load_steps: int
    reached_mpa: float
    rotation_deg: float
    difference_mm: float | None
    peak_memory_mib: float
    message: str


def report(name: str, version: str, progress: Progress, message: str) -> None:
    """Print the result: one JSON object on stdout."""
    result = Report(name=name, version=version, message=message, **progress.numbers())
    print(json.dumps(asdict(result)), flush=True)


def arguments(description: str | None) -> argparse.Namespace:
    """``--load``: the fraction of 0.1 MPa to go to."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--load", type=float, default=1.0, help="fraction of 0.1 MPa")
    return parser.parse_args()


def main(run: Callable[[Case, float], None], description: str | None) -> None:
    """Run a code on the case up to the pressure asked for on the command line."""
    options = arguments(description)
    run(load_case(), options.load * FULL_PRESSURE)
