"""``bellows fit``: from a table of measurements to a material a design can use."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer, unwritten
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.errors import DesignError
from bellows_design.materials.laws import BEST

if TYPE_CHECKING:
    from bellows_design.reports.fit import FitReport


def fit(
    data: Path,
    model: str = BEST,
    output: Path | None = None,
    yield_strength: float | None = None,
    plot: Path | None = None,
) -> Answer:
    """Fit ``model`` to the measurements in ``data``; write a material and a plot if asked.

    ``yield_strength`` in MPa goes into the material, which cannot do without: it decides what is
    approved, and these tests do not determine it. Exit status 1, and no material, if the fit cannot
    be one. Raises ``DesignError`` for bad input, before anything is computed where possible.
    """
    _check(output, yield_strength, plot)
    from bellows_design.materials.fitted_material import why_no_material
    from bellows_design.materials.fitting.measurements import load_measurements
    from bellows_design.materials.selection import fit as fit_measurements
    from bellows_design.reports.fit import FitReport, fit_table

    measurements = load_measurements(data)
    choice = fit_measurements(measurements, model)
    refused = why_no_material(measurements, choice.fit)
    report = FitReport(measurements, model, choice, refused, None if refused else output, plot)
    failed = unwritten(lambda: _write(report, yield_strength))
    if failed is not None:
        report = replace(report, material_file=None, plot_file=None)
    return Answer(report.to_dict(), fit_table(report), REFUSED if refused else DONE, failed)


def _check(output: Path | None, yield_strength: float | None, plot: Path | None) -> None:
    require_file(output, ".toml")
    if output is not None and yield_strength is None:
        raise DesignError(
            "a material needs a yield strength in MPa, which these tests do not determine; "
            "give it with --yield-strength."
        )
    if yield_strength is not None and not 0.01 <= yield_strength <= 200:
        shown = f"{yield_strength:g}" if math.isfinite(yield_strength) else str(yield_strength)
        raise DesignError(f"--yield-strength is {shown} MPa but must lie between 0.01 and 200 MPa.")
    require_plot(plot)


def _write(report: FitReport, yield_strength: float | None) -> None:
    """The files that the report names."""
    if report.material_file is not None and yield_strength is not None:
        from bellows_design.materials.fitted_material import fitted_material
        from bellows_design.materials.library import write_material

        name = _name(report.material_file)
        material = fitted_material(report.data, report.fit, name, yield_strength)
        write_material(material, report.material_file)
    if report.plot_file is not None:
        from bellows_design.reports.fit_plot import plot_fit

        plot_fit(report.data, report.fit, report.plot_file)


def _name(output: Path) -> str:
    return re.sub(r"[^A-Za-z0-9_-]+", "_", output.stem).strip("_-")[:64] or "fitted"
