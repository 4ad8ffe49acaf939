"""The case in our solver, its walk over the load as it is."""

from __future__ import annotations

import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from case import ALPHA, MU, Case, Progress, main, report

sys.path.insert(0, str(Path(__file__).parents[3]))  # the repository this file belongs to

from solver import Event, Mesh, Ogden, Problem, SlenderAxis, Supports, solve


def problem_of(case: Case) -> Problem:
    """The case as our solver's problem."""
    return Problem(
        mesh=Mesh(case.nodes, case.tets, case.surfaces),
        material=Ogden(mu=MU, alpha=ALPHA),
        supports=Supports(clamped=("root",), symmetry={"symmetry": 1}),
        pressurised=("cavity",),
        axis=SlenderAxis(tuple(case.stations)),
    )


def run(case: Case, pressure: float) -> None:
    """Solve and report."""
    progress = Progress(case)

    def listen(event: Event) -> None:
        if event.kind == "iteration":
            progress.iterations += 1
        elif event.kind == "step":
            progress.load_steps += 1
            progress.reached_mpa, progress.rotation_deg = event.load * pressure, event.rotation
            progress.tell()

    solution = solve(problem_of(case), pressure, listener=listen)
    progress.compare(solution.pressure, solution.displacement)
    report("ours", our_version(), progress, f"{solution.message} {solution.linear_solver}")


def our_version() -> str:
    """Version of the installed distribution."""
    try:
        return version("bellows-design")
    except PackageNotFoundError:
        return "not installed"


if __name__ == "__main__":
    main(run, __doc__)
