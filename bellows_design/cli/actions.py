"""What each command does: from its parsed options to its answer.

Heavy modules are imported once the input is known to be good.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import BAD_INPUT, DONE, NOT_SOLVED, REFUSED, Answer, unwritten
from bellows_design.cli.layout.said import stated
from bellows_design.cli.output_files import require_file, require_folder, require_plot
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import (
    CHECK,
    EVALUATION,
    GEOMETRY,
    require_address_space,
)
from bellows_design.cli.surroundings.solving import solving, usual_store
from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.cli.options import BudgetOptions, DesignOptions
    from bellows_design.neighbours.sensitivities import Sensitivities
    from bellows_design.progress import Progress


def design(options: DesignOptions, output: Path, with_settings: bool = False) -> Answer:
    """Build the printed part and write it in the format of ``output``'s suffix.

    A 3MF carries the settings of the design's printer if ``with_settings`` says so.
    """
    from bellows_design.export.companions import three_mf_with_settings
    from bellows_design.export.formats import write_part, writer_for
    from bellows_design.pipeline import build_part
    from bellows_design.progress import on_stderr

    require_address_space(GEOMETRY)
    chosen = options.load()
    writer = three_mf_with_settings if with_settings else writer_for(output)
    if with_settings:
        require_file(output, ".3mf")
    require_folder(output)
    with on_stderr() as progress:
        progress.stage("geometry")
        part = build_part(chosen)
        progress.stage(f"write {output.name}")
        write_part(part, output, writer)
    triangles, volume = len(part.mesh.triangles), part.mesh.volume
    content = {
        "design": chosen.name,
        "digest": chosen.digest,
        "file": str(output),
        "triangles": triangles,
        "volume_mm3": volume,
    }
    return Answer(content, [f"{output}: {triangles} triangles, {volume / 1000:.2f} cm³"])


def evaluate(
    options: DesignOptions,
    model: str,
    pressure: str | None,
    accuracy: float | None,
    vtu: Path | None,
    limits: BudgetOptions,
    cached: bool,
    derivatives: bool = False,
) -> Answer:
    """Compute the design under ``pressure``, to estimated errors of ``accuracy`` percent.

    With ``derivatives`` also how every number of the design changes the results.
    """
    from bellows_design.cli.own_body import evaluate as own_body
    from bellows_design.cli.own_body.evaluate import body_named
    from bellows_design.cli.pressures import parse_pressures
    from bellows_design.reports.evaluation import evaluation_table
    from bellows_design.reports.sensitivities import sensitivities_table

    require_working_folder()
    require_address_space(EVALUATION)
    pressures = () if pressure is None else parse_pressures(pressure)
    body, budget = body_named(options, model, derivatives), limits.budget()
    if body is not None:
        return own_body.evaluate(body, pressures, accuracy, vtu, budget)
    chosen = options.load(pressures[-1] if pressures else None)
    require_file(vtu, ".vtu")
    from bellows_design.analysis import evaluate as analysis
    from bellows_design.store import evaluated

    with solving() as progress:
        store = usual_store(progress) if cached else None
        found = evaluated(
            chosen, model, accuracy, pressures, progress, budget, store=store, keep=derivatives
        )
        writers = () if vtu is None else (lambda: analysis.write_vtu(found, vtu),)
        failed = unwritten(*writers)
        changes = _sensitivities(found, progress) if derivatives else ""
    status = DONE if found.converged else NOT_SOLVED
    content = found.to_dict() | {"from_cache": found.from_cache or None}
    tables = list(evaluation_table(found))
    if derivatives:
        content["sensitivities"] = None if isinstance(changes, str) else changes.to_dict()
        tables += sensitivities_table(changes)
    return Answer(content, tables, status, failed)


def _sensitivities(found: Evaluation, progress: Progress) -> Sensitivities | str:
    """Those of an evaluation, or why there are none: the evaluation is an answer all the same."""
    from bellows_design.neighbours.sensitivities import sensitivities
    from solver.errors import SolverError

    if not found.converged:
        return "the pressure was not reached"
    if found.contact.void:
        return "walls run through each other"
    progress.stage("sensitivities")
    try:
        return sensitivities(found)
    except (BellowsError, SolverError) as error:
        return str(error)


def run(options: DesignOptions, output: Path, limits: BudgetOptions, cached: bool) -> Answer:
    """Take the design through all stages; what is approved is written below ``output``."""
    from bellows_design import pipeline
    from bellows_design.reports.outcome import outcome_table

    require_working_folder()
    require_address_space(EVALUATION)
    chosen = options.load(rename=True)
    chosen.profile()
    budget = limits.budget()
    with solving() as progress:
        store = usual_store(progress) if cached else None
        outcome = pipeline.run(chosen, output, progress, budget, store)
    unsolved = outcome.evaluation is not None and not outcome.evaluation.converged
    refused = NOT_SOLVED if unsolved else REFUSED
    status = DONE if outcome.verdict.approved else refused
    return Answer(outcome.to_dict(), outcome_table(outcome), status)


def verify(folder: Path, quick: bool, limits: BudgetOptions, cached: bool) -> Answer:
    """Check every file of an export, and whether its design would be approved again."""
    from bellows_design.reports.verification import verification_table

    require_working_folder()
    require_address_space(CHECK if quick else EVALUATION)
    budget = limits.budget()
    from bellows_design.verification.verify import Means, verify

    with solving() as progress:
        store = usual_store(progress) if cached and not quick else None
        found = verify(folder, quick, Means(progress, budget, store))
    status = DONE if found.verified else REFUSED
    return Answer(found.to_dict(), verification_table(found), status)


def benchmark(
    options: DesignOptions,
    models: Sequence[str],
    meshes: int | None,
    output: Path | None,
    plot: Path | None,
    limits: BudgetOptions,
) -> Answer:
    """Time ``models`` on so many meshes each; write the numbers and a picture if asked."""
    from bellows_design.files.json_files import write_json
    from bellows_design.reports.benchmark import benchmark_tables
    from bellows_design.reports.benchmark_plot import plot_benchmark

    require_working_folder()
    require_address_space(EVALUATION)
    chosen = options.load()
    budget = limits.budget()
    require_file(output, ".json")
    require_plot(plot)
    from bellows_design.benchmark import study as benchmarks

    names = models or benchmarks.DEFAULT_MODELS
    with solving() as progress:
        study = benchmarks.study(chosen, names, meshes, progress, budget=budget)
    content = stated(study.to_dict())
    failed = unwritten(
        *(() if output is None else (lambda: write_json(content, output),)),
        *(() if plot is None else (lambda: plot_benchmark(study, plot),)),
    )
    status = DONE if study.converged else NOT_SOLVED
    return Answer(content, benchmark_tables(study), status, failed)


def cache(clear: bool) -> Answer:
    """Say what is kept of earlier evaluations; remove it if ``clear`` says so."""
    from bellows_design.reports.cache import cache_table
    from bellows_design.store import Store

    require_working_folder()
    store = Store.usual()
    before = store.holdings()
    left = store.clear() if clear else 0
    content = before.to_dict() | {"cleared": clear and not left}
    return Answer(content, cache_table(before, clear, left), BAD_INPUT if left else DONE)
