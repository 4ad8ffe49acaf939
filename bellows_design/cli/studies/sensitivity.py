"""``bellows study sensitivity``: how results depend on the numbers of a design."""

from __future__ import annotations

from pathlib import Path

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.layout.said import stated
from bellows_design.cli.options import DesignOptions
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store


def sensitivity(
    options: DesignOptions,
    percent: float,
    samples: int | None,
    wall: float,
    modulus: float,
    seed: int,
    sobol: bool,
    output: Path | None,
    plot: Path | None,
    cached: bool,
) -> Answer:
    """Study a design, its surroundings and tolerances; write numbers and a picture if asked."""
    from bellows_design.design.variation import counted
    from bellows_design.files.json_files import write_json
    from bellows_design.neighbours.equilibrium import unusable
    from bellows_design.reports.studies.sensitivity import sensitivity_tables
    from bellows_design.reports.studies.sensitivity_plot import plot_sensitivity
    from bellows_design.store import evaluated
    from bellows_design.study.sensitivity.causes import Tolerances
    from bellows_design.study.sensitivity.indices import require_salib
    from bellows_design.study.sensitivity.study import SAMPLES, Plan, studied

    require_working_folder()
    require_address_space(EVALUATION)
    chosen = options.load()
    chosen.profile()
    plan = Plan(
        percent, SAMPLES if samples is None else samples, seed, Tolerances(wall, modulus), sobol
    )
    if sobol:
        require_salib()
    require_file(output, ".json")
    require_plot(plot)
    with solving() as progress:
        store = usual_store(progress) if cached else None
        evaluation = evaluated(counted(chosen), progress=progress, store=store, keep=True)
        if reason := unusable(evaluation):
            sentence = f"{chosen.name} has no state to study: {reason}."
            return Answer({"error": sentence, "exit_status": NOT_SOLVED}, [sentence], NOT_SOLVED)
        study = studied(chosen, evaluation, plan, progress)
    content = stated(study.to_dict())
    failed = unwritten(
        *(() if output is None else (lambda: write_json(content, output),)),
        *(() if plot is None else (lambda: plot_sensitivity(study, plot),)),
    )
    return Answer(content, sensitivity_tables(study), DONE, failed)
