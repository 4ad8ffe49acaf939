"""How the numbers were computed: meshes, errors, seconds, solver, versions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Fact,
    Facts,
    Folded,
    Grid,
    Section,
    Sentences,
)
from bellows_design.reports.page.wording import headings, number, plus_minus

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.reports.page.findings import Findings

MESHES = ("mesh", "tetrahedra", "unknowns", "pressure, MPa", "angle, °", "stress, MPa", "air, mm³")


def computation(findings: Findings) -> Section:
    """Meshes with what each says, estimates, seconds, solver, versions."""
    found = findings.outcome.evaluation
    blocks: list[Block] = [Sentences(("Nothing was computed.",))] if found is None else []
    blocks += [] if found is None else _blocks(found)
    return Section("computation", "The computation", (*blocks, _versions()))


def _blocks(found: Evaluation) -> Iterator[Block]:
    yield Facts(tuple(_facts(found)))
    rows = tuple(
        tuple(
            number(text)
            for text in (
                str(index),
                f"{each.size.elements}",
                f"{each.size.unknowns}",
                f"{each.reading.pressure_mpa:.4g}",
                f"{each.reading.bending_angle_deg:.2f}",
                f"{each.reading.max_von_mises_mpa:.3f}",
                f"{each.reading.cavity_volume_mm3:.0f}",
            )
        )
        for index, each in enumerate(found.meshes, 1)
    )
    yield Grid(headings(*MESHES, right=MESHES), rows, "What each mesh says, the finest last")


def _facts(found: Evaluation) -> Iterator[Fact]:
    error, effort, seconds = found.error_estimate, found.solver, found.seconds
    yield Fact("model", found.model.name, note=found.reason)
    yield Fact(
        "estimated error of the angle",
        plus_minus(found.bending_angle_deg, error.bending_angle_percent, "°"),
    )
    yield Fact(
        "estimated error of the stress",
        plus_minus(found.max_von_mises_mpa, error.max_von_mises_percent, " MPa", 3),
    )
    yield Fact(
        "solver",
        f"{effort.load_steps} load steps, {effort.newton_iterations} iterations, "
        f"{effort.factorizations} factorizations",
        note=effort.linear_solver,
    )
    yield Fact(
        "time",
        f"{seconds.total:.1f} s",
        note=f"geometry {seconds.geometry:.1f}, meshes {seconds.mesh:.1f}, "
        f"solves {seconds.solve:.1f} s",
    )
    if found.from_cache:
        yield Fact("computed on", found.from_cache, note="and kept since; the times are of then")


def _versions() -> Folded:
    from bellows_design.versions import versions

    rows = tuple((Cell(name), Cell(version)) for name, version in versions().items())
    return Folded("Versions", (Grid(headings("package", "version"), rows),))
