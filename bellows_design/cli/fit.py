"""``bellows fit``: from a table of measurements to a material a design can use."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer, unwritten
from bellows_design.cli.output_files import name_of, require_file, require_plot
from bellows_design.errors import DesignError
from bellows_design.materials.laws import BEST
from bellows_design.materials.measurements.options import ReadingOptions

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_result import Fit
    from bellows_design.materials.material import Material
    from bellows_design.materials.measurements.points import Measurements
    from bellows_design.reports.fit import FitReport

DEFAULT = ReadingOptions()


@dataclass(frozen=True)
class MaterialOptions:
    """The material to write, and what the tests do not tell of it.

    Attributes:
        output: File to write, ``.toml``; None for none.
        yield_strength: MPa. It decides what is approved, so a material cannot do without.
        elongation_at_break: %. Without it no rule judges strains.
        accept_poor: Take a fit that is too poor, with a warning that the material keeps.
    """

    output: Path | None = None
    yield_strength: float | None = None
    elongation_at_break: float | None = None
    accept_poor: bool = False


NO_MATERIAL = MaterialOptions()


def fit(
    data: Path | Sequence[Path],
    model: str = BEST,
    material: MaterialOptions = NO_MATERIAL,
    plot: Path | None = None,
    reading: ReadingOptions = DEFAULT,
) -> Answer:
    """Fit ``model`` to the measurements in ``data``; write a material and a plot if asked.

    Exit status 1, and no material, if the fit cannot be one. Raises ``DesignError`` for bad input,
    before anything is computed where possible.
    """
    _check(material, plot)
    from bellows_design.materials.fitted_material import why_no_material, why_poor
    from bellows_design.materials.measurements.loading import load_measurements
    from bellows_design.materials.selection import fit as fit_measurements
    from bellows_design.reports.fit import FitReport, fit_table

    measurements = load_measurements(data, reading)
    choice = fit_measurements(measurements, model)
    poor = None if material.accept_poor else why_poor(measurements, choice.fit)
    refused = why_no_material(measurements, choice.fit) or poor
    made = None if refused else _material(measurements, choice.fit, material)
    file = None if made is None else material.output
    report = FitReport(measurements, model, choice, refused, file, plot, made)
    failed = unwritten(lambda: _write(report))
    if failed is not None:
        report = replace(report, material_file=None, plot_file=None, material=None)
    return Answer(report.to_dict(), fit_table(report), REFUSED if refused else DONE, failed)


def _check(material: MaterialOptions, plot: Path | None) -> None:
    require_file(material.output, ".toml")
    strength, elongation = material.yield_strength, material.elongation_at_break
    if material.output is not None and strength is None:
        raise DesignError(
            "a material needs a yield strength in MPa, which these tests do not determine; "
            "give it with --yield-strength."
        )
    if strength is not None and not 0.01 <= strength <= 200:
        raise DesignError(
            f"--yield-strength is {_shown(strength)} MPa but must lie between 0.01 and 200 MPa."
        )
    if elongation is not None and not 20 <= elongation <= 3000:
        hint = f"; a fraction of {elongation:g} is {100 * elongation:g} %"
        raise DesignError(
            f"--elongation-at-break is {_shown(elongation)} % but must lie between 20 and 3000 %"
            f"{hint if 0.2 <= elongation <= 30 else ''}."
        )
    require_plot(plot)


def _shown(value: float) -> str:
    return f"{value:g}" if math.isfinite(value) else str(value)


def _material(data: Measurements, fit: Fit, wanted: MaterialOptions) -> Material | None:
    """The material that is asked for; None without one."""
    if wanted.output is None or wanted.yield_strength is None:
        return None
    from bellows_design.materials.fitted_material import fitted_material

    name = name_of(wanted.output, "fitted")
    return fitted_material(data, fit, name, wanted.yield_strength, wanted.elongation_at_break)


def _write(report: FitReport) -> None:
    """The files that the report names."""
    if report.material_file is not None and report.material is not None:
        from bellows_design.materials.library import write_material

        write_material(report.material, report.material_file)
    if report.plot_file is not None:
        from bellows_design.reports.fit_plot import plot_fit

        plot_fit(report.data, report.fit, report.plot_file)
