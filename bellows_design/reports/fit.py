"""A fit as plain values for programs and as a table for people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.materials.fitting.fit_result import Choice, Constant, Fit
from bellows_design.materials.fitting.measurements import Measurements
from solver.material.stability import HIGHEST, StableRange


def fit_content(data: Measurements, requested: str, choice: Choice) -> dict[str, Any]:
    """What ``bellows fit --json`` prints: stresses in MPa, stretches and strains without unit."""
    fit = choice.fit
    return {
        "data": data.name,
        "requested": requested,
        "model": fit.model,
        "points": fit.points,
        "tests": {mode: _test(data, mode) for mode in data.modes},
        "mu_mpa": list(fit.mu),
        "alpha": list(fit.alpha),
        "higher_mpa": list(fit.higher),
        "shear_modulus_mpa": fit.stability.shear_modulus,
        "constants": [_constant(constant) for constant in fit.constants],
        "r_squared": fit.r_squared,
        "relative_error_percent": 100 * fit.relative_error,
        "largest_error": {
            "error_mpa": fit.misfit.error,
            "test": fit.misfit.mode,
            "stretch": fit.misfit.stretch,
        },
        "aicc": fit.aicc,
        "stable": fit.stable,
        "determined": fit.determined,
        "unique": fit.unique,
        "valid_strain": list(data.valid_strain),
        "stable_stretch": {each.mode: _range(each) for each in fit.stability.ranges},
        "tried": [_summary(each) for each in choice.tried],
        "notes": fit_notes(data, fit),
        "material_file": None,
        "plot_file": None,
    }


POOR = 0.1
"""Relative error from which on a fit is called poor."""


def fit_notes(data: Measurements, fit: Fit) -> list[str]:
    """Sentences on what the fit does not tell."""
    notes = []
    if fit.relative_error > POOR:
        notes.append(
            f"a poor fit: the model is off by {100 * fit.relative_error:.0f} % in the mean of the "
            "points; look at the plot, at other models, and at the measurements."
        )
    if fit.vanished:
        notes.append(
            f"{fit.model} has a term that adds nothing, with a μ of 0 or next to it; a smaller "
            "model says the same."
        )
    open_ones = [each.name for each in fit.constants if not each.determined]
    if open_ones and not fit.vanished:
        notes.append(
            f"the measurements do not determine {', '.join(open_ones)}: other constants fit as "
            "well, and would differ where nothing was measured; try a smaller model or more tests."
        )
    if not fit.unique:
        notes.append(
            "quite other constants fit these tests as well, with stresses that differ by up to "
            f"{100 * fit.rivalry:.0f} % in the three tests over the same stretches; measure "
            "another kind of test."
        )
    if not fit.stable:
        notes.append(f"{fit.model} is unstable: see the stable stretches.")
    if len(data.modes) == 1:
        notes.append(
            f"only {data.modes[0]} tests: in other states of stress, as in a pressurised wall, "
            "the fit is a guess; an equibiaxial test would tell most."
        )
    return [*notes, *_falling(fit)]


def _falling(fit: Fit) -> list[str]:
    peaks = [each for each in fit.stability.ranges if each.load_rises_to < HIGHEST]
    return [
        f"{each.mode}: the load peaks at stretch {each.load_rises_to:.3g}; past it a part under "
        "constant load necks or bursts."
        for each in peaks
        if each.highest > each.load_rises_to
    ]


def fit_table(content: Mapping[str, Any]) -> Sequence[RenderableType]:
    """Constants with intervals, quality, ranges, the models tried, and the notes."""
    lines: list[RenderableType] = [_constants_table(content), _quality_table(content)]
    if len(content["tried"]) > 1:
        lines.append(_tried_table(content))
    lines += [Text(f"note: {note}", style="yellow") for note in content["notes"]]
    for key, what in (("material_file", "material"), ("plot_file", "plot")):
        if content[key] is not None:
            lines.append(f"{what}: {content[key]}")
    if content["refused"] is not None:
        lines.append(Text(f"REFUSED: {content['refused']}", style="bold red"))
    return lines


def _constants_table(content: Mapping[str, Any]) -> Table:
    table = Table(title=f"{content['data']}: {content['model']}", title_justify="left", box=SIMPLE)
    table.add_column("constant")
    for heading in ("value", "standard error", "95 % interval"):
        table.add_column(heading, justify="right")
    for each in content["constants"]:
        name = f"{each['name']}, MPa" if each["unit"] else each["name"]
        if each["fixed"]:
            table.add_row(name, f"{each['value']:g}", "given", "–")
            continue
        interval = f"{each['low']:.4g} … {each['high']:.4g}"
        table.add_row(name, f"{each['value']:.5g}", f"{each['standard_error']:.2g}", interval)
    return table


def _quality_table(content: Mapping[str, Any]) -> Table:
    worst = content["largest_error"]
    low, high = content["valid_strain"]
    rows = {
        "initial shear modulus": f"{content['shear_modulus_mpa']:.4g} MPa",
        "R²": f"{content['r_squared']:.6f}",
        "relative error (rms)": f"{content['relative_error_percent']:.2g} %",
        "largest error": f"{worst['error_mpa']:.3g} MPa, {worst['test']} at stretch "
        f"{worst['stretch']:.4g}",
        "points": ", ".join(
            f"{test['points']} {mode} (stretch {test['stretch'][0]:.4g} … {test['stretch'][1]:.4g})"
            for mode, test in content["tests"].items()
        ),
        "fitted range": f"principal strains {100 * low:.0f} … {100 * high:.0f} %",
    }
    rows |= {f"stable, {mode}": _told(each) for mode, each in content["stable_stretch"].items()}
    table = Table(box=SIMPLE, show_header=False)
    for name, value in rows.items():
        table.add_row(name, Text(value))
    return table


def _told(stretches: Mapping[str, Any]) -> str:
    text = f"stretch {stretches['lowest']:.3g} … {stretches['highest']:.3g}"
    return f"{text} (no end found)" if stretches["complete"] else text


def _tried_table(content: Mapping[str, Any]) -> Table:
    table = Table(title="models tried", title_justify="left", box=SIMPLE)
    table.add_column("model")
    for heading in ("constants", "error, %", "R²", "AICc", "stable", "determined"):
        table.add_column(heading, justify="right")
    for each in content["tried"]:
        table.add_row(
            Text(each["model"], style="bold" if each["model"] == content["model"] else ""),
            str(each["constants"]),
            f"{each['relative_error_percent']:.2g}",
            f"{each['r_squared']:.5f}",
            f"{each['aicc']:.1f}",
            "yes" if each["stable"] else "no",
            "yes" if each["determined"] else "no",
        )
    return table


def _test(data: Measurements, mode: str) -> dict[str, Any]:
    stretch, stress = data.of(mode)
    low, high = float(stretch.min()), float(stretch.max())
    return {
        "points": int(stretch.size),
        "stretch": [low, high],
        "strain": [low - 1, high - 1],
        "largest_stress_mpa": float(abs(stress).max()),
    }


def _constant(constant: Constant) -> dict[str, Any]:
    return {
        "name": constant.name,
        "unit": constant.unit,
        "value": constant.value,
        "standard_error": constant.standard_error,
        "low": constant.low,
        "high": constant.high,
        "fixed": constant.fixed,
        "determined": constant.determined,
    }


def _range(stable: StableRange) -> dict[str, Any]:
    return {
        "lowest": stable.lowest,
        "highest": stable.highest,
        "complete": stable.complete,
        "load_rises_to": stable.load_rises_to,
    }


def _summary(fit: Fit) -> dict[str, Any]:
    return {
        "model": fit.model,
        "constants": fit.free_constants,
        "relative_error_percent": 100 * fit.relative_error,
        "r_squared": fit.r_squared,
        "aicc": fit.aicc,
        "stable": fit.stable,
        "determined": fit.determined,
    }
