"""``bellows study paper``: every design of the paper, beside its printed results."""

from __future__ import annotations

from pathlib import Path

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.layout.said import stated
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store


def paper(output: Path | None, plot: Path | None, cached: bool) -> Answer:
    """Compute the 13 designs; write the numbers and a picture if asked."""
    from bellows_design.files.json_files import write_json
    from bellows_design.reports.studies.paper import paper_tables
    from bellows_design.reports.studies.paper_plot import plot_paper

    require_working_folder()
    require_address_space(EVALUATION)
    require_file(output, ".json")
    require_plot(plot)
    from bellows_design.study.comparison import compared

    with solving() as progress:
        comparison = compared(progress, usual_store(progress) if cached else None)
    content = stated(comparison.to_dict())
    failed = unwritten(
        *(() if output is None else (lambda: write_json(content, output),)),
        *(() if plot is None else (lambda: plot_paper(comparison, plot),)),
    )
    status = DONE if comparison.converged else NOT_SOLVED
    return Answer(content, paper_tables(comparison), status, failed)
