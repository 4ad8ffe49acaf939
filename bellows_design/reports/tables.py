"""Results as tables for people, made from the same plain values that ``--json`` prints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rich.box import SIMPLE
from rich.console import JustifyMethod, RenderableType
from rich.table import Table
from rich.text import Text

_STYLES = {"pass": "green", "warn": "yellow", "fail": "bold red"}


def check_table(report: Mapping[str, Any]) -> Sequence[RenderableType]:
    """A row for every rule, then the sentences of those that did not pass."""
    table = Table(
        title=f"{report['design']} on {report['printer']}", title_justify="left", box=SIMPLE
    )
    table.add_column("", no_wrap=True)
    table.add_column("rule", no_wrap=True)
    for heading in ("measured", "required", "where"):
        table.add_column(heading)
    for rule in report["rules"]:
        verdict = Text(rule["verdict"], style=_STYLES[rule["verdict"]])
        measured = f"{_short(rule['measured'])} {rule['unit']}"
        cells = (rule["rule"], measured, _short(rule["required"]), rule["where"])
        table.add_row(verdict, *(Text(cell) for cell in cells))
    notes = [f"{r['verdict']}: {r['message']}" for r in report["rules"] if r["verdict"] != "pass"]
    return [table, *notes, f"printability: {report['verdict']}"]


def evaluation_table(evaluation: Mapping[str, Any]) -> Sequence[RenderableType]:
    """The numbers an engineer asks for first."""
    error, mesh = evaluation["error_estimate"], evaluation["mesh"]
    solver, seconds = evaluation["solver"], evaluation["seconds"]
    angle, stress = evaluation["bending_angle_deg"], evaluation["max_von_mises_mpa"]
    rows = {
        "pressure": f"{evaluation['pressure_mpa']:.4g} MPa",
        "bending angle": _value(angle, "°") + _error(error, "bending_angle"),
        "highest von Mises stress": _value(stress, " MPa") + _error(error, "max_von_mises"),
        "at (x, y, z)": _place(evaluation["max_von_mises_position_mm"]),
        "cavity volume": _value(evaluation["cavity_volume_mm3"], " mm³"),
        "principal strains": _strains(evaluation["strain"]),
        "contact": _contact(evaluation["contact"]),
        "model": f"{evaluation['model']} ({evaluation['model_reason']}), "
        f"{mesh['elements']} tetrahedra, {mesh['unknowns']} unknowns",
        "solver": f"{solver['load_steps']} load steps, {solver['newton_iterations']} iterations, "
        f"{solver['linear_solver']}",
        "time": f"{seconds['total']:.1f} s",
    }
    table = Table(title=evaluation["design"], title_justify="left", box=SIMPLE, show_header=False)
    for name, value in rows.items():
        table.add_row(name, Text(value))
    curve = [_curve(evaluation["curve"])] if len(evaluation.get("curve", ())) > 1 else []
    notes = [Text(f"warning: {text}", style="yellow") for text in evaluation["warnings"]]
    return [table, *curve, *notes, *([] if evaluation["converged"] else [_not_reached(evaluation)])]


def _strains(strain: Mapping[str, Any]) -> str:
    """The extremes, and the range of the material's tests."""
    text = f"{100 * strain['lowest']:+.3g} … {100 * strain['highest']:+.3g} %"
    if strain["valid"] is None:
        return text
    low, high = strain["valid"]
    return f"{text} (material tested {100 * low:+.3g} … {100 * high:+.3g} %)"


def _curve(readings: Sequence[Mapping[str, float]]) -> Table:
    """Angle, stress and volume over the pressure."""
    table = Table(box=SIMPLE)
    for heading in ("pressure, MPa", "angle, °", "stress, MPa", "cavity, mm³"):
        table.add_column(heading, justify="right")
    for reading in readings:
        table.add_row(
            f"{reading['pressure_mpa']:.4g}",
            f"{reading['bending_angle_deg']:.2f}",
            f"{reading['max_von_mises_mpa']:.3f}",
            f"{reading['cavity_volume_mm3']:.0f}",
        )
    return table


def outcome_table(outcome: Mapping[str, Any]) -> Sequence[RenderableType]:
    """Check, evaluation, and the verdict with its reasons."""
    lines: list[RenderableType] = [
        *check_table(outcome["check"]),
        *evaluation_table(outcome["evaluation"]),
    ]
    if outcome["approved"]:
        lines.append(Text(f"APPROVED: {outcome['folder']}", style="bold green"))
        return lines
    lines.append(Text(f"REFUSED: {outcome['design']}", style="bold red"))
    lines += [f"  - {reason['rule']}: {reason['message']}" for reason in outcome["reasons"]]
    if outcome["withdrawn"] is not None:
        lines.append(f"The earlier export {outcome['withdrawn']} was withdrawn.")
    return lines


def benchmark_tables(benchmark: Mapping[str, Any]) -> Sequence[RenderableType]:
    """Work and precision of every mesh of every model, then orders, growth and the machine."""
    models = benchmark["models"]
    work = _numbers(f"{benchmark['design']}: work", WORK)
    precision = _numbers("precision", PRECISION)
    for model in models:
        for mesh in model["meshes"]:
            last = mesh is model["meshes"][-1]
            work.add_row(model["model"], *_work(mesh), end_section=last)
            precision.add_row(model["model"], *_precision(mesh), end_section=last)
    texts = [text for model in models for text in _findings(model)]
    legend = "estimate: the product's own, %; ratio: estimate over error"
    return [work, precision, legend, *texts, _machine(benchmark["machine"])]


WORK = (
    "model",
    "tetra-\nhedra",
    "un-\nknowns",
    "itera-\ntions",
    "factor-\nized",
    "geom.,\ns",
    "mesh,\ns",
    "solve,\ns",
    "so far,\ns",
    "peak,\nMiB",
)
PRECISION = (
    "model",
    "tetra-\nhedra",
    "so far,\ns",
    "angle,\n°",
    "error,\n%",
    "esti-\nmate",
    "ratio",
    "stress,\nMPa",
    "error,\n%",
    "esti-\nmate",
    "ratio",
)


def _numbers(title: str, headings: Sequence[str]) -> Table:
    """An empty table of numbers that keeps its digits together."""
    table = Table(title=title, title_justify="left", box=SIMPLE, padding=0)
    for heading in headings:
        justify: JustifyMethod = "left" if heading == "model" else "right"
        table.add_column(heading, justify=justify, no_wrap=True)
    return table


def _work(mesh: Mapping[str, Any]) -> tuple[str, ...]:
    seconds, memory = mesh["seconds"], mesh["peak_memory_mib"]
    counts = ("elements", "unknowns", "newton_iterations", "factorizations")
    return (
        *(str(mesh[name]) for name in counts),
        *(f"{seconds[name]:.2f}" for name in ("geometry", "mesh", "solve")),
        f"{mesh['seconds_so_far']['total']:.2f}",
        _known(memory, ".0f"),
    )


def _precision(mesh: Mapping[str, Any]) -> tuple[str, ...]:
    cells = [str(mesh["elements"]), f"{mesh['seconds_so_far']['total']:.2f}"]
    for key, value in (
        ("bending_angle", f"{mesh['bending_angle_deg']:.2f}"),
        ("max_von_mises", f"{mesh['max_von_mises_mpa']:.3f}"),
    ):
        cells += [
            value,
            _known(mesh["error"][f"{key}_percent"], ".2f"),
            _known(mesh["error_estimate"][f"{key}_percent"], ".2f"),
            _known(mesh["estimate_over_error"][key], ".2g"),
        ]
    return tuple(cells)


def _findings(model: Mapping[str, Any]) -> list[str]:
    """What a model's rows say together, and what they are measured against."""
    name, orders, reference = model["model"], model["orders"], model["reference"]
    lines = [f"{name}: errors are against {reference['recipe']}."]
    if model["ends"] is not None:
        lines.append(f"{name}: {_ends(model['ends'])}")
    if reference["finest_half"] is not None:
        lines.append(_against_half(model))
    if len(model["meshes"]) > 1:
        angle, stress = (_listed(orders[key]) for key in ("bending_angle", "max_von_mises"))
        lines.append(f"{name}: observed orders in 1/tetrahedra: angle {angle}; stress {stress}.")
    if model["exponent"] is not None:
        power = f"unknowns^{model['exponent']:.2f}"
        lines.append(f"{name}: the seconds per factorization grow as {power}.")
    if model["solve_exponent"] is not None:
        power = f"unknowns^{model['solve_exponent']:.2f}"
        lines.append(f"{name}: all seconds of solving up to a mesh grow as {power}.")
    if model["note"]:
        label = "no finer mesh" if model["converged"] else "NOT CONVERGED"
        lines.append(f"{name}: {label}: {model['note']}")
    return lines


def _ends(work: Mapping[str, Any]) -> str:
    return (
        f"the first mesh's seconds include the ends: {work['elements']} tetrahedra, "
        f"{work['factorizations']} factorizations, {work['solver_seconds']:.2f} s of solving."
    )


def _against_half(model: Mapping[str, Any]) -> str:
    errors = [mesh["error_against_finest_half"] for mesh in model["meshes"]]
    angle, stress = (
        _listed([error[f"{key}_percent"] for error in errors])
        for key in ("bending_angle", "max_von_mises")
    )
    recipe = model["reference"]["finest_half"]["recipe"]
    return f"{model['model']}: against {recipe}: angle {angle} %; stress {stress} %."


def _machine(machine: Mapping[str, Any]) -> str:
    memory, load = machine["memory_gib"], machine["load_average"]
    return (
        f"{machine['processor']}, {machine['cores']} cores"
        + ("" if memory is None else f", {memory:.1f} GiB")
        + ("" if load is None else f"; load average before the start {load:.1f}")
    )


def _listed(values: Sequence[float | None]) -> str:
    return ", ".join(_known(value, ".2f") for value in values)


def _known(value: float | None, form: str) -> str:
    return "–" if value is None else format(value, form)


def _not_reached(evaluation: Mapping[str, Any]) -> Text:
    message = evaluation.get("message") or "the load was not reached"
    return Text(f"NOT CONVERGED: {message}", style="bold red")


def _error(estimate: Mapping[str, Any], key: str) -> str:
    percent = estimate.get(f"{key}_percent")
    return " (error not estimated)" if percent is None else f" (± {percent:.2g} % estimated)"


def _value(value: float | None, unit: str) -> str:
    return "unknown" if value is None else f"{value:.4g}{unit}"


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _place(position: Sequence[float] | None) -> str:
    if position is None:
        return "unknown"
    return f"({', '.join(f'{coordinate:.2f}' for coordinate in position)}) mm"


def _contact(contact: Mapping[str, Any]) -> str:
    """Which walls touch, the smallest gaps, and what that means."""
    gaps = {"smallest gap": contact.get("min_gap_mm"), "inside": contact.get("inner_gap_mm")}
    told = [f"{name} {gap:.2f} mm" for name, gap in gaps.items() if gap is not None]
    touching = ", ".join(contact.get("where", ())) + " touch" if contact["detected"] else "none"
    note = contact.get("note")
    return ", ".join([touching, *([] if contact["detected"] else told)]) + (
        f": {note}" if note else ""
    )
