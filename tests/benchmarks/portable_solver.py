"""The linear solvers on the tangents of the shipped Prototype 1, and along a balloon's path.

    python tests/benchmarks/portable_solver.py [rounds]

A unit cell and two halves under 0.1 MPa: seconds of PARDISO, feral and SuperLU in turn, medians of
so many rounds (five without), error against PARDISO, inertia, memory. Then the inertia through a
limit point, and the bits of a solution in new processes with one thread and with two. Prints
Markdown.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from solver.arrays import Reals
from solver.linear.feral import FERAL_OPTIONS
from solver.linear.interface import LinearSolver
from solver.linear.solvers import linear_solver
from solver.linear.sparsity import Pattern

ROOT = Path(__file__).parents[2]
NAMES = ("pardiso", "feral", "superlu")
BALLOON_STEPS = 24
ONE_THREAD = dict.fromkeys(("RAYON_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"), "1")


@dataclass(frozen=True)
class System:
    """A tangent under load, a right-hand side, and how many pressures a stable body has."""

    name: str
    pattern: Pattern
    values: Reals
    force: Reals
    pressures: int

    def save(self, path: Path) -> None:
        """For other processes."""
        arrays = {"indptr": self.pattern.indptr, "indices": self.pattern.indices}
        np.savez(path, **arrays, values=self.values, force=self.force)


@dataclass
class Times:
    """Seconds of one solver on one system, round by round."""

    factorization: list[float] = field(default_factory=list)
    solve: list[float] = field(default_factory=list)


def systems() -> Iterator[System]:
    """From the smallest to the largest."""
    from bellows_design.analysis.models import HALF, UNIT_CELL
    from bellows_design.benchmark.study import computations
    from bellows_design.design.shipped import load_design
    from solver.assembly.assembly import Assembly

    design = load_design("prototype_1")
    for model, meshes in ((UNIT_CELL, (2,)), (HALF, (1, 2))):
        for number, found in enumerate(computations(design, model, "", max(meshes)), start=1):
            if number not in meshes:
                continue
            end = found.finest
            there = Assembly(end.problem).evaluate(end.state, end.pressure)
            name = f"{model.name}, mesh {number}"
            vertices = len(end.problem.mesh.vertices)
            yield System(name, there.pattern, there.tangent, there.force, vertices)


def timed(solvers: dict[str, LinearSolver], system: System, rounds: int) -> dict[str, Times]:
    """The solvers in turn, so that all of them share what else the machine does.

    The first round, in which feral orders, does not count; SuperLU is in the second one only.
    """
    found = {name: Times() for name in solvers}
    for number in range(rounds + 1):
        for name in solvers if number < 2 else NAMES[:2]:
            start = time.perf_counter()
            solvers[name].factorize(system.values)
            middle = time.perf_counter()
            solvers[name].solve(system.force)
            found[name].factorization.append(middle - start)
            found[name].solve.append(time.perf_counter() - middle)
    return found


def ordering_seconds(name: str, system: System, rounds: int) -> float | None:
    """Median seconds of the analysis of a pattern; None where every factorization repeats it."""
    pattern = system.pattern
    if name == "superlu":
        return None
    if name == "pardiso":
        solver = linear_solver(name)
        return median(seconds(lambda: solver.analyze(pattern)) for _ in range(rounds))
    import feral

    pointer, rows = (numbers.astype(np.int64) for numbers in (pattern.indptr, pattern.indices))
    matrix = feral.CscMatrix(len(pointer) - 1, pointer, rows, system.values)
    used = FERAL_OPTIONS["ordering"]
    return median(seconds(lambda: feral.analyze(matrix, ordering=used)) for _ in range(rounds))


def seconds(run: Callable[[], object]) -> float:
    """How long ``run`` takes."""
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def rows(system: System, rounds: int, file: Path) -> Iterator[str]:
    """One line a solver."""
    solvers = {name: linear_solver(name) for name in NAMES}
    for solver in solvers.values():
        solver.analyze(system.pattern)
    found = timed(solvers, system, rounds)
    expected = solvers["pardiso"].solve(system.force)
    usual = median(found["pardiso"].factorization[1:])
    for name, solver in solvers.items():
        ordering = ordering_seconds(name, system, rounds)
        factorization = median(found[name].factorization[1:])
        error = np.abs(solver.solve(system.force) - expected).max() / np.abs(expected).max()
        negative = solver.negative_pivots
        inertia = "unknown" if negative is None else f"{negative - system.pressures}"
        memory = in_a_process(name, file)["memory_mib"]
        yield (
            f"| {system.name} | {len(expected)} | {solver.name} "
            f"| {'–' if ordering is None else f'{ordering:.2f}'} "
            f"| {factorization:.3f} | {factorization / usual:.1f} "
            f"| {median(found[name].solve[1:]):.3f} | {error:.0e} | {inertia} | {memory:.0f} MiB |"
        )


def in_a_process(name: str, file: Path, environment: dict[str, str] | None = None) -> Any:
    """What ``here`` finds in a process of its own."""
    command = [sys.executable, __file__, "--here", name, str(file)]
    variables = os.environ | (environment or {})
    return json.loads(subprocess.check_output(command, env=variables, encoding="utf-8"))


def here(name: str, file: Path) -> dict[str, Any]:
    """Memory a factorization holds, seconds of feral's second one, and the solution's bits."""
    data = np.load(file)
    pattern, values = Pattern(data["indptr"], data["indices"]), data["values"]
    solver = linear_solver(name)
    before = resident()
    solver.analyze(pattern)
    solver.factorize(values)
    memory = resident() - before
    again = seconds(lambda: solver.factorize(values)) if name == "feral" else None
    bits = hashlib.sha256(solver.solve(data["force"]).tobytes()).hexdigest()
    return {"memory_mib": memory, "seconds": again, "bits": bits}


def resident() -> float:
    """Memory this process holds, MiB."""
    import psutil

    return psutil.Process().memory_info().rss / 2**20


def repeatability(system: System, file: Path) -> str:
    """One line: feral in four processes, with all threads and with one, twice each."""
    found = [in_a_process("feral", file, mode) for mode in ({}, {}, ONE_THREAD, ONE_THREAD)]
    kinds = len({run["bits"] for run in found})
    both, one = (min(run["seconds"] for run in found[k : k + 2]) for k in (0, 2))
    return f"| {system.name} | {kinds} | {both:.3f} | {one:.3f} |"


def balloon() -> str:
    """The inertia along a path through limit points, by PARDISO and by feral."""
    sys.path.insert(0, str(ROOT / "tests/support"))
    from meshes import sphere_mesh

    from solver import Ogden, Problem, Supports, trace
    from solver.assembly.assembly import Assembly

    planes = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    rubber = Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054))
    problem = Problem(sphere_mesh(10.0, 12.0, 2, 6), rubber, planes, ("inside",))
    path, assembly = trace(problem, 2.0, steps=BALLOON_STEPS), Assembly(problem)
    solvers = [linear_solver(name) for name in ("pardiso", "feral")]
    counts = []
    for solver in solvers:
        solver.analyze(assembly.pattern)
    for state, point in zip(path.states, path.points, strict=True):
        tangent = assembly.evaluate(state, point.pressure).tangent
        for solver in solvers:
            solver.factorize(tangent)
        counts.append([(s.negative_pivots or 0) - len(problem.mesh.vertices) for s in solvers])
    same = sum(one == other for one, other in counts)
    modes = " ".join(str(count) for _, count in counts)
    limits = ", ".join(limit.kind for limit in path.limits)
    return (
        f"{assembly.numbering.size} unknowns, {len(counts)} equilibria past {limits}: the same "
        f"inertia at {same} of them. Negative eigenvalues beyond one a pressure: {modes}."
    )


def main(rounds: int = 5) -> None:
    """Print the tables as they come."""
    print(
        "| tangent | unknowns | solver | ordering, s | factorization, s | of PARDISO's | solve, s "
        "| error against PARDISO | unstable modes | memory |\n|" + "---|" * 10
    )
    repeated = []
    with TemporaryDirectory() as folder:
        file = Path(folder) / "system.npz"
        for system in systems():
            system.save(file)
            for row in rows(system, rounds, file):
                print(row, flush=True)
            repeated.append(repeatability(system, file))
    print("\n| tangent | different solutions of four | two threads, s | one thread, s |")
    print("|---|---|---|---|", *repeated, sep="\n")
    print(f"\n{balloon()}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--here"]:
        print(json.dumps(here(sys.argv[2], Path(sys.argv[3]))))
    else:
        main(*map(int, sys.argv[1:]))
