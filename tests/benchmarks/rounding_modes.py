"""Load steps and factorizations in modes that round differently: they should be the same.

    python tests/benchmarks/rounding_modes.py [results.json [mode ...]]

Prototype 1's half on the mesh of ``tests/solver/data``, the cells of the 13 designs of the paper at
the default accuracy, and ten bodies that are hard to walk. Each mode has a process of its own.
Prints a Markdown table: load steps / refused steps / factorizations, all meshes of a design added
up, and by how much the factorizations differ.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
TESTS = ROOT / "tests"
ONE_THREAD = dict.fromkeys(("MKL_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
MODES: dict[str, dict[str, str]] = {
    "two threads": {},
    "one thread": ONE_THREAD,
    "COMPATIBLE": {"MKL_CBWR": "COMPATIBLE"},
    "AVX2": {"MKL_CBWR": "AVX2"},
    "feral": {"HIDDEN": "without_mkl"},
    "SuperLU": {"HIDDEN": "without_mkl without_feral"},
}
COUNTS = ("load_steps", "refused_steps", "factorizations")

if __name__ == "__main__" and "HIDDEN" in os.environ:
    sys.path.insert(0, str(TESTS / "support"))
    for plugin in os.environ["HIDDEN"].split():
        import_module(plugin)


def halves() -> Iterator[tuple[str, Callable[[], Iterable[Any]]]]:
    """The half of Prototype 1 whose displacement two other codes confirm."""
    import numpy as np

    from solver import Mesh, Ogden, Problem, SlenderAxis, Supports, solve

    data = np.load(TESTS / "solver/data/half_actuator.npz")
    names = [key for key in data.files if key.startswith("surface_")]
    surfaces = {key.removeprefix("surface_"): data[key] for key in names}
    problem = Problem(
        mesh=Mesh(data["nodes"], data["tets"], surfaces),
        material=Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054)),
        supports=Supports(clamped=("root",), symmetry={"symmetry": 1}),
        pressurised=("cavity",),
        axis=SlenderAxis(tuple(data["stations"])),
    )
    yield "Prototype 1, half", lambda: [solve(problem, 0.1)]


def cells() -> Iterator[tuple[str, Callable[[], Iterable[Any]]]]:
    """The paper's designs by the unit cell, with their ends."""
    from bellows_design.analysis.evaluate import evaluate
    from bellows_design.study.paper import TABLE_4

    def solutions(design: Any) -> Iterable[Any]:
        return evaluate(design, "unit-cell").computation.all_solutions

    for case in TABLE_4:
        yield case.label, lambda case=case: solutions(case.build())  # type: ignore[misc]


def hard_bodies() -> Iterator[tuple[str, Callable[[], Iterable[Any]]]]:
    """Slender, led, pulled far, sucked, burst, squeezed, and starts that are too bold."""
    sys.path[:0] = [str(TESTS / folder) for folder in ("support", "hard_cases", "verification")]
    import numpy as np
    from hard_bodies import NINJAFLEX, actuator, rolled, stretched
    from meshes import box_mesh, sphere_mesh

    from solver import Ogden, Problem, SlenderAxis, SolverOptions, Supports, solve

    planes = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 3), Ogden((1.0,), (2.0,)), planes, ("inside",))
    held = Supports(("x0",), {"y0": 1, "z0": 2}, {"x1": stretched(7.6, clamped=True)})
    strip = Problem(box_mesh((6, 2, 1), (10.0, 2.0, 0.5)), NINJAFLEX, held)
    rolls = Supports(("x0",), {"y0": 1}, {"x1": rolled(2.2, 20.0, 0.15)})
    axis = SlenderAxis(tuple(np.linspace(0.0, 20.0, 9)))
    bar = Problem(box_mesh((16, 1, 1), (20.0, 1.0, 0.3)), NINJAFLEX, rolls, axis=axis)
    bold = SolverOptions(first_step=1.0)
    yield "4 bubbles, 68°", lambda: [solve(actuator(4), 0.2)]
    yield "4 bubbles, the whole load at once", lambda: [solve(actuator(4), 0.2, bold)]
    yield "8 bubbles, 197°", lambda: [solve(actuator(8), 0.36)]
    yield "16 bubbles, 420°", lambda: [solve(actuator(16), 0.4)]
    yield "24 bubbles, 619°", lambda: [solve(actuator(24), 0.4)]
    yield "2 bubbles, suction", lambda: [solve(actuator(2), -0.1)]
    yield "ball, 90 % of its limit", lambda: [solve(ball, 0.9 * 0.2117)]
    yield "strip pulled by 660 %", lambda: [solve(strip, 0.0)]
    yield "strip pulled by 660 % at once", lambda: [solve(strip, 0.0, bold)]
    yield "bar rolled up by 792°", lambda: [solve(bar, 0.0)]


def measured() -> dict[str, list[int]]:
    """Counts of everything in this process."""
    found = {}
    for family in (halves, cells, hard_bodies):
        for name, run in family():
            ends = list(run())
            counts = [sum(getattr(end, key) for end in ends) for key in COUNTS]
            found[name] = [*counts, int(all(end.converged for end in ends))]
    return found


def in_a_process(mode: str) -> dict[str, list[int]]:
    """Counts of everything in a mode."""
    environment = {**os.environ, **MODES[mode]}
    command = [sys.executable, __file__, "--here"]
    done = subprocess.run(command, env=environment, capture_output=True, encoding="utf-8")
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


def table(found: dict[str, dict[str, list[int]]]) -> str:
    """One line a body."""
    lines = [f"| body | {' | '.join(found)} | differ by |", "|---" * (len(found) + 2) + "|"]
    for name in next(iter(found.values())):
        counts = [mode[name] for mode in found.values()]
        cells = ["/".join(map(str, c[:3])) + ("" if c[3] else " stopped") for c in counts]
        spread = max(c[2] for c in counts) - min(c[2] for c in counts)
        lines.append(f"| {name} | {' | '.join(cells)} | {spread} |")
    return "\n".join(lines)


def main(target: str | None = None, *modes: str) -> None:
    """Measure, print, and write to ``target``."""
    found: dict[str, dict[str, list[int]]] = {}
    for mode in modes or MODES:
        found[mode] = in_a_process(mode)
        if target is not None:
            Path(target).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(table(found))


if __name__ == "__main__":
    if sys.argv[1:] == ["--here"]:
        print(json.dumps(measured()))
    else:
        main(*sys.argv[1:])
