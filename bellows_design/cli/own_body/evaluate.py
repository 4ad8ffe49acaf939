"""``bellows evaluate`` on a body of one's own."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.output_files import require_file
from bellows_design.cli.surroundings.solving import solving
from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bellows_design.budget import Budget
    from bellows_design.cli.options import DesignOptions
    from bellows_design.own_body import OwnBody


def body_named(options: DesignOptions, model: str, derivatives: bool) -> OwnBody | None:
    """The own body that is named; None where the name is not that of a body's file.

    ``model`` and ``derivatives`` are options of ``evaluate`` that no body takes.

    Raises ``DesignError``.
    """
    from bellows_design.design.shipped import LIBRARY, is_own_body
    from bellows_design.files.toml_files import read_toml
    from bellows_design.own_body.files import body_of

    path = LIBRARY.path_of(options.name)
    if path is None:
        return None
    table = read_toml(path, str(path), "design")
    if not is_own_body(table):
        return None
    _require_no_options_of_bellows(options, model, derivatives)
    return body_of(table, path.parent)


def evaluate(
    body: OwnBody,
    pressures: Sequence[float],
    accuracy: float | None,
    vtu: Path | None,
    budget: Budget,
) -> Answer:
    """Compute the body under its load; nothing is kept."""
    from bellows_design.reports.own_bodies.tables import body_tables

    chosen = body.at_pressure(pressures[-1]) if pressures else body
    require_file(vtu, ".vtu")
    from bellows_design.analysis.evaluate import write_vtu
    from bellows_design.own_body.analysis import evaluate as analysis

    with solving() as progress:
        found = analysis.evaluate(chosen, accuracy, pressures, progress, budget)
        writers = () if vtu is None else (lambda: write_vtu(found, vtu),)
        failed = unwritten(*writers)
    status = DONE if found.converged else NOT_SOLVED
    return Answer(found.to_dict(), body_tables(found), status, failed)


def _require_no_options_of_bellows(options: DesignOptions, model: str, derivatives: bool) -> None:
    """Raise ``DesignError`` for an option that only designs of bellows take."""
    if options.settings:
        raise DesignError("--set changes designs of bellows; change an own body in its file.")
    if model != "auto":
        raise DesignError(f"--model {model}: an own body has one model only; leave it out.")
    if derivatives:
        raise DesignError("--sensitivities are those of a design of bellows; leave them out.")
