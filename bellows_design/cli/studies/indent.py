"""``bellows study indent``: which indent does what."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.layout.said import stated
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.cli.options import DesignOptions
    from bellows_design.design.design import Design
    from bellows_design.progress import Progress
    from bellows_design.store import Store
    from bellows_design.study.indent.search import IndentStudy
    from bellows_design.study.indent.trial import Trial


@dataclass(frozen=True)
class IndentOptions:
    """How many indents of each kind are spread, and how accurate evaluations shall be (%)."""

    points: int
    accuracy: float | None
    cached: bool


def indent(
    options: DesignOptions, how: IndentOptions, output: Path | None, plot: Path | None
) -> Answer:
    """Search for indents of a design; write the numbers and a picture if asked."""
    from bellows_design.files.json_files import write_json
    from bellows_design.reports.studies.indent import indent_tables
    from bellows_design.reports.studies.indent_plot import plot_indents
    from bellows_design.study.indent.search import require_points

    require_working_folder()
    require_address_space(EVALUATION)
    chosen = options.load()
    chosen.profile()
    require_points(how.points)
    require_file(output, ".json")
    require_plot(plot)
    with solving() as progress:
        study = _searched(chosen, how, progress, usual_store(progress) if how.cached else None)
    content = stated(study.to_dict())
    failed = unwritten(
        *(() if output is None else (lambda: write_json(content, output),)),
        *(() if plot is None else (lambda: plot_indents(study, plot),)),
    )
    status = DONE if study.found else NOT_SOLVED
    return Answer(content, indent_tables(study), status, failed)


def _searched(
    design: Design, how: IndentOptions, progress: Progress, store: Store | None
) -> IndentStudy:
    from bellows_design.store import evaluated
    from bellows_design.study.indent.search import searched

    def evaluate(design: Design) -> Evaluation:
        return evaluated(design, accuracy_percent=how.accuracy, progress=progress, store=store)

    def tell(trial: Trial) -> None:
        progress.note(trial.summary)

    return searched(design, evaluate, how.points, tell=tell)
