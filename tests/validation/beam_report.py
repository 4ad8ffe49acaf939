"""What the document says of the beam."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from record import Interval, Report, Results, Row, Table

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "beam.json").read_text(encoding="utf-8")
)
CELLS = (12.0, 6.0, 3.0)
SEVERAL = 6.0
"""mm; cells on which variants are computed."""
NEARLY, INCOMPRESSIBLE, AUTHORS = "nearly incompressible", "incompressible", "authors' modulus"
MARKERS = {
    "top": ((0.0, 30.0), (0.0, 1.0)),
    "left": ((15.0, 24.0), (1.0, 0.0)),
    "right": ((15.0, 6.0), (1.0, 0.0)),
}
"""Foot and normal (y, z) in the half y > 0 that is modelled; the left marker is mirrored."""
LOADS: list[float] = DATA["loads_n"]
ALLOWED = 0.03


def on_cells(what: str, cell: float) -> str:
    """Name of a computation."""
    return f"{what}, cells of {cell:g} mm"


def report(results: Results) -> Report:
    """The section."""
    rows = _rows(results)
    single = [row for row in _rows(results, single=True) if not row.inside]
    return Report(
        part=(
            "A beam of silicone (Dragon Skin 10), 100 × 30 × 30 mm, held at one end, its axis "
            f"horizontal. Source: {DATA['source']}."
        ),
        measured=(
            "Three markers at the tip, filmed while the beam, level at first, sags under its "
            "weight, and under a further load on the upper edge of the tip; each twice. "
            "Deflections are those of the authors' frames; the tilt is ours from their recordings. "
            f"{_moduli(results)}"
        ),
        posed=(
            "Half the beam, y > 0; neo-Hooke with ν = 0.499; one end face clamped; weight 1070 "
            "kg/m³ × 9.80709 m/s²; the load as a line load along the upper edge of the tip. Only "
            "Young's modulus is fitted, and only to the unloaded rows: to the mean deflection of "
            "the three markers. A marker is a point 6 mm off the surface, in the plane of the end "
            "face, that moves as rigidly as the surface below it, 6 mm around its foot on average. "
            f"{_off_the_surface(results)}"
        ),
        rows=rows,
        unknown=(
            "What markers and the thread of the load weigh is not stated: each gram at the tip is "
            f"{_per_gram(results):.2f} mm. The beam still sinks by 0.02 to 0.1 mm/s when the "
            "recordings end, so a modulus is one of a few seconds; their last 0.3 s give up to "
            "0.2 mm other deflections than the authors' frames, so that the sag is known to some "
            f"3 %. How the clamp holds the end face is not stated. {_of_the_ratio(results)}"
        ),
        verdict=_verdict(rows, single),
        tables=(_moduli_table(results), _against_comsol(results), _speed(results)),
        figure="validation-beam.png",
    )


def finest(results: Results) -> float:
    """The smallest cells that are stored, mm."""
    return min(cell for cell in CELLS if on_cells(NEARLY, cell) in results)


def down(readings: Mapping[str, Any], load: int, marker: str) -> float:
    """Deflection of a marker, mm."""
    return -float(readings["markers_xz_mm"][load][marker][1])


def _rows(results: Results, single: bool = False) -> tuple[Row, ...]:
    """Of both loads: deflections and tilt, over the moduli of both runs or the mean one."""
    found = []
    for load in (1, 2):
        key, name = f"{LOADS[load]:g}", f"{LOADS[load]:.2f} N"
        for number, marker in enumerate(MARKERS):
            runs = [run[number] for run in DATA["deflections_mm"][key]]
            ours, error = _ours(results, lambda r, m=marker, k=load: down(r, k, m), single)
            found.append(Row(f"{name}, {marker} marker", _span(runs), ours, "mm", error, ALLOWED))
        ours, error = _ours(results, lambda r, k=load: r["tilt_deg"][k], single)
        measured = tuple(DATA["tilts_deg"][key])
        found.append(Row(f"{name}, tilt of the tip", measured, ours, "°", error, ALLOWED))
    return tuple(found)


def _ours(results: Results, read: Any, single: bool) -> tuple[Interval, float]:
    """On the finest mesh, over the moduli of both runs, and the error by the mesh."""
    cells = [cell for cell in CELLS if on_cells(NEARLY, cell) in results]
    values = [read(results[on_cells(NEARLY, cell)].readings) for cell in cells]
    last = values[-1]
    error = abs(values[-1] - extrapolated(cells, values))
    if single:
        return (last, last), error
    both = read(results[on_cells(NEARLY, SEVERAL)].readings)
    runs = [read(results[on_cells(f"run {n} alone", SEVERAL)].readings) for n in (1, 2)]
    return _span([last * run / both for run in runs]), error


def order(results: Results) -> float:
    """Observed order of the modulus over the halved cells."""
    moduli = [_kilopascals(results, on_cells(NEARLY, cell)) for cell in CELLS]
    return float(np.log2((moduli[1] - moduli[0]) / (moduli[2] - moduli[1])))


def extrapolated(cells: list[float], values: list[float]) -> float:
    """To cells of no size, from the finest two, by the order 1 that edges of clamps leave."""
    (coarse, fine), (before, last) = cells[-2:], values[-2:]
    return last + (last - before) * fine / (coarse - fine)


def _span(values: list[float]) -> Interval:
    return min(values), max(values)


def _kilopascals(results: Results, name: str) -> float:
    return 1e3 * float(results[name].readings["young_modulus_mpa"])


def _moduli(results: Results) -> str:
    both = _kilopascals(results, on_cells(NEARLY, finest(results)))
    one, two = (_kilopascals(results, on_cells(f"run {n} alone", SEVERAL)) for n in (1, 2))
    return (
        f"The weight alone tells a modulus of {both:.1f} kPa; run 1 alone {one:.1f}, run 2 "
        f"{two:.1f}: the runs differ by {100 * (one / two - 1):.1f} %. The authors' own fit is "
        f"{1e3 * DATA['authors_young_modulus_mpa']:.1f} kPa."
    )


def _moduli_table(results: Results) -> Table:
    lines = []
    for name, stored in results.items():
        if "young_modulus_mpa" in stored.readings:
            iterations = sum(stored.readings["newton_iterations"])
            lines.append(
                (
                    name,
                    f"{_kilopascals(results, name):.2f} kPa",
                    *(f"{down(stored.readings, k, 'top'):.3f} mm" for k in range(3)),
                    str(iterations),
                )
            )
    heading = ("computation", "modulus from the weight", *(f"top, {n:.2f} N" for n in LOADS))
    title = (
        "Identification and convergence; the modulus converges with the order "
        f"{order(results):.1f} (the edges of the clamp leave no more):"
    )
    return Table(title, (*heading, "Newton iterations"), tuple(lines))


def _off_the_surface(results: Results) -> str:
    readings = results[on_cells(NEARLY, SEVERAL)].readings
    differences = [
        down(readings, 2, marker) - readings["surface_down_mm"][2][marker] for marker in MARKERS
    ]
    return (
        "Under 1 N it sinks by "
        + ", ".join(
            f"{value:+.2f} mm ({marker})".replace("-", "−")
            for marker, value in zip(MARKERS, differences, strict=True)
        )
        + " more than the node of the surface at its foot."
    )


def _of_the_ratio(results: Results) -> str:
    ours = results[on_cells(NEARLY, SEVERAL)].readings
    other = results[on_cells(INCOMPRESSIBLE, SEVERAL)].readings
    changes = [down(other, 2, marker) / down(ours, 2, marker) - 1 for marker in MARKERS]
    moduli = other["young_modulus_mpa"] / ours["young_modulus_mpa"] - 1
    return (
        f"Incompressible silicone instead of ν = 0.499 changes the modulus by "
        f"{100 * abs(moduli):.2f} %, and deflections under 1 N by at most "
        f"{100 * max(map(abs, changes)):.2f} %."
    )


def _per_gram(results: Results) -> float:
    readings = results[on_cells(NEARLY, SEVERAL)].readings
    slope = (down(readings, 1, "top") - down(readings, 0, "top")) / LOADS[1]
    return float(slope * 9.80709e-3)


def _against_comsol(results: Results) -> Table:
    """With the authors' modulus, of the surface's nodes."""
    readings = results[on_cells(AUTHORS, CELLS[2])].readings
    lines = []
    for load, newton in enumerate(LOADS):
        theirs = DATA["comsol_mm"][f"{newton:g}"]
        for number, marker in enumerate(MARKERS):
            ours = readings["surface_down_mm"][load][marker]
            lines.append(
                (
                    f"{newton:.2f} N, {marker}",
                    f"{theirs[number]:.2f} mm",
                    f"{ours:.2f} mm",
                    f"{100 * (ours / theirs[number] - 1):+.1f} %".replace("-", "−"),
                )
            )
    title = (
        "The authors' COMSOL and our solver with the authors' modulus, of the surface where the "
        "markers stand (two computations; their law and mesh are not stated):"
    )
    return Table(title, ("load, place", "COMSOL", "ours", "difference"), tuple(lines))


def _speed(results: Results) -> Table:
    """Seconds of the whole prediction, and how far it is from the extrapolated one."""
    cells = [cell for cell in CELLS if on_cells(NEARLY, cell) in results]
    tops = [down(results[on_cells(NEARLY, cell)].readings, 2, "top") for cell in cells]
    limit = extrapolated(cells, tops)
    lines = []
    for cell, top in zip(cells, tops, strict=True):
        stored = results[on_cells(NEARLY, cell)]
        error = 100 * abs(top / limit - 1)
        lines.append(
            (
                f"{cell:g} mm",
                str(stored.tetrahedra),
                str(stored.unknowns),
                f"{stored.seconds:.3g}",
                f"{error:.2f} %",
            )
        )
    heading = ("cells", "tetrahedra", "unknowns", "seconds", "error")
    title = (
        "Speed against error: the seconds of modulus and both loads together, and the error of the "
        "top marker's deflection under 1 N against its extrapolation to cells of no size:"
    )
    return Table(title, heading, tuple(lines))


def _verdict(rows: tuple[Row, ...], single: list[Row]) -> str:
    worst = max((abs(row.beyond) for row in single), default=0.0)
    inside = sum(row.inside for row in rows)
    return (
        f"The sag alone predicts {inside} of {len(rows)} readings under both loads within the "
        "spread of the two runs and 3 %, the modulus being known no better than the two runs tell "
        f"it; with the one modulus of both runs {len(single)} of them lie beyond, by at most "
        f"{100 * worst:.1f} %."
    )


def draw(results: Results, path: str) -> None:
    """Deflections of the three markers over the load."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    readings = results[on_cells(NEARLY, finest(results))].readings
    figure, axes = pyplot.subplots(figsize=(6.4, 4.0), layout="constrained")
    for number, (marker, colour) in enumerate(zip(MARKERS, ("C0", "C1", "C2"), strict=True)):
        axes.plot(
            LOADS, [down(readings, k, marker) for k in range(3)], colour, label=f"{marker}, ours"
        )
        for run, sign in zip((0, 1), "ox", strict=True):
            values = [DATA["deflections_mm"][f"{load:g}"][run][number] for load in LOADS]
            shift = 0.012 * (number - 1)
            axes.plot(np.array(LOADS) + shift, values, colour + sign, mfc="none")
    axes.plot([], [], "ko", mfc="none", label="measured, run 1")
    axes.plot([], [], "kx", label="measured, run 2")
    axes.set(xlabel="load on the edge of the tip, N", ylabel="deflection of the marker, mm")
    axes.legend()
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
