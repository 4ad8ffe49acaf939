"""Measurements from files: what test machines write, with a record of how it was read.

A line that names the columns is looked for below whatever stands above it; strains are nominal,
stress is nominal (force over initial area), unless names or options say otherwise. What is not
certain is asked in one sentence, which names the option that settles it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.bounds import SOFTEST, STIFFEST
from bellows_design.materials.measurements.branches import on_one_branch
from bellows_design.materials.measurements.breaks import before_break, without_holds
from bellows_design.materials.measurements.columns import columns_of
from bellows_design.materials.measurements.conversion import converted
from bellows_design.materials.measurements.crosscheck import checked_by_force
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.points import Measurements, Reading
from bellows_design.materials.measurements.series import Series, all_of, series_of
from bellows_design.materials.measurements.specimens import mean_of
from bellows_design.materials.measurements.strain_scale import bend_of
from bellows_design.materials.measurements.table.file import sheet_of_file
from bellows_design.materials.measurements.table.header import table_of
from bellows_design.materials.measurements.table.rows import Sheet, sheet_of_text
from bellows_design.materials.measurements.zero import from_zero
from bellows_design.validation.quoting import quoted_path
from solver.arrays import Reals
from solver.material.homogeneous import MODES

FEWEST_POINTS = 5

SMALLEST_PEAK = 1e-6
"""MPa. Below this nothing was measured, or in another unit."""

STRAY = 0.05
"""Part of a test's largest stress up to which a stress of the wrong sign may be noise."""

USUAL = (0.008, 30.0)
"""MPa. Initial shear moduli from Shore 00-20 to 50 D; others get a hint."""

MOST_FILES = 50

DEFAULT = ReadingOptions()


def load_measurements(
    paths: str | Path | Sequence[str | Path], options: ReadingOptions = DEFAULT
) -> Measurements:
    """The measurements in a file, or in several, each with specimens of its own.

    Args:
        paths: Tables of text or Excel workbooks; see ``docs/materials.md``.
        options: What the files leave open.

    Returns:
        Stretches without unit and nominal stresses in MPa, with a record of how they were read.

    Raises:
        DesignError: A file cannot be read, is open to several readings, or a value is out of
            bounds; one sentence.

    Examples:
        >>> from pathlib import Path
        >>> from bellows_design.materials import load_measurements
        >>> rows = [f"uniaxial,{s},{0.4 * (s - s**-2):.4f}" for s in (1.1, 1.2, 1.4, 1.6, 1.8, 2.0)]
        >>> _ = Path("test.csv").write_text("\\n".join(["mode,stretch,stress_mpa", *rows]))
        >>> tests = load_measurements("test.csv")
        >>> print(len(tests.stretch), "points")
        6 points
    """
    files = [Path(paths)] if isinstance(paths, str | Path) else [Path(path) for path in paths]
    if not 1 <= len(files) <= MOST_FILES:
        raise DesignError(f"{len(files)} files are given but must be 1 to {MOST_FILES}.")
    series: list[Series] = []
    reading = Reading()
    for file in files:
        place = quoted_path(file)
        found, record = _series(sheet_of_file(file, place, options), place, options, file.name)
        series, reading = series + found, reading + _named(record, file.name, len(files) > 1)
    name = files[0].name + (f" and {len(files) - 1} more" if len(files) > 1 else "")
    return _measurements(series, reading, name, quoted_path(files[0]))


def parse_measurements(
    text: str, place: str, name: str = "", options: ReadingOptions = DEFAULT
) -> Measurements:
    """The measurements written as ``text``; ``place`` is what messages call it."""
    series, reading = _series(sheet_of_text(text, place, options), place, options, name)
    return _measurements(series, reading, name, place)


def _named(record: Reading, name: str, several: bool) -> Reading:
    if not several:
        return record
    return Reading(
        *(tuple(f"{name}: {each}" for each in texts) for texts in (record.notes, record.hints))
    )


def _series(
    sheet: Sheet, place: str, options: ReadingOptions, file: str
) -> tuple[list[Series], Reading]:
    """The series of a sheet, each on one branch, until break, and counted from its zero."""
    table = table_of(sheet, place, options)
    columns = columns_of(table)
    raw = series_of(table, columns, sheet, place)
    if not raw:
        raise DesignError(f"{place} has 0 points but must have at least {FEWEST_POINTS}.")
    series, how = converted(raw, table, columns.pairs[0], options)
    notes = [*sheet.notes, *how, *columns.notes]
    if columns.mode is None:
        notes.append("all points are of uniaxial tests: no column “mode” says otherwise")
    for each in series:
        note = checked_by_force(each, table, columns.pairs[0], sheet, options)
        notes += [note] if note else []
    result = []
    for each in series:
        parts, note = on_one_branch(each, options.branch)
        notes += [_of(each, note)] if note else []
        for number, part in enumerate(parts):
            prepared, more = _prepared(part, options)
            label = f"{file} {each.specimen} {number if len(parts) > 1 else ''}".strip()
            result.append(replace(prepared, specimen=label))
            notes += [_of(each, text) for text in more]
    return result, Reading(tuple(notes))


def _of(series: Series, note: str) -> str:
    return f"specimen {series.specimen}: {note}" if series.specimen else note


def _prepared(series: Series, options: ReadingOptions) -> tuple[Series, list[str]]:
    """Without holds and points after break, its strain from zero; and what was done."""
    steps = []
    if "break" not in options.keep:
        steps += [without_holds, _before_break_of_each_sign]
    if "zero" not in options.keep:
        steps.append(from_zero)
    notes = []
    for step in steps:
        series, note = step(series)
        notes += [note] if note else []
    return series, notes


def _before_break_of_each_sign(series: Series) -> tuple[Series, str | None]:
    """Tension and compression each until its break."""
    parts = [series.at(mask) for mask in (series.strain < 1, series.strain >= 1) if mask.any()]
    kept = [before_break(part) for part in parts]
    lines = np.concatenate([part.lines for part, _ in kept])
    notes = [note for _, note in kept if note]
    return series.at(np.isin(series.lines, lines)), "; ".join(notes) or None


def _measurements(
    series: Sequence[Series], reading: Reading, name: str, place: str
) -> Measurements:
    """All series together; of several specimens in one kind of test their mean."""
    for each in series:
        _require_signs(each)
    joined, spreads, notes = _means(series)
    result = Measurements(
        name,
        all_of(joined, "strain"),
        all_of(joined, "stress"),
        np.concatenate([np.full(each.strain.size, each.mode, np.intp) for each in joined]),
        np.concatenate(spreads) if len(joined) < len(series) else None,
        reading + Reading(tuple(notes), _hints(joined)),
    )
    _require_enough(result, place)
    _require_elastomer(joined, place)
    return result


def _means(series: Sequence[Series]) -> tuple[list[Series], list[Reals], list[str]]:
    """One series of each kind of test, the spread of its points, and notes."""
    joined, spreads, notes = [], [], []
    ordered = sorted(series, key=lambda each: each.mode)
    for _, group in groupby(ordered, key=lambda each: each.mode):
        specimens = list(group)
        mean, spread = specimens[0], np.zeros(specimens[0].strain.size)
        if len(specimens) > 1:
            mean, spread, note = mean_of(specimens)
            notes.append(note)
        joined.append(mean)
        spreads.append(spread)
    return joined, spreads, notes


def _require_enough(data: Measurements, place: str) -> None:
    count = data.stress.size
    if count < FEWEST_POINTS:
        points = "1 point" if count == 1 else f"{count} points"
        raise DesignError(f"{place} has {points} but must have at least {FEWEST_POINTS}.")
    if np.abs(data.stress).max() < SMALLEST_PEAK:
        raise DesignError(
            f"{place} has no stress above {SMALLEST_PEAK:g} MPa; is it in another unit? --units "
            "tells it."
        )


def _require_signs(series: Series) -> None:
    stretch, stress = series.strain, series.stress
    against = np.flatnonzero(stress * (stretch - 1) < 0)
    strays = against[np.abs(stress[against]) > STRAY * np.abs(stress).max(initial=0.0)]
    if strays.size:
        k = int(strays[0])
        rule = "positive in tension" if stretch[k] > 1 else "negative in compression"
        raise DesignError(
            f"{series.where(k)}: the stress is {stress[k]:g} MPa at stretch {stretch[k]:g} but "
            f"must be {rule}."
        )


def _require_elastomer(series: Sequence[Series], place: str) -> None:
    """Refuse numbers whose initial modulus no elastomer has: they are in another unit."""
    shears = [_shear(each) for each in series]
    for shear in shears:
        if shear and not SOFTEST / 1.1 <= shear <= 1.1 * STIFFEST:
            raise DesignError(
                f"{place} gives an initial shear modulus of about {shear:.3g} MPa, which no "
                f"elastomer has ({SOFTEST:g} to {STIFFEST:g} MPa); is the strain or the stress in "
                "another unit? --units tells it."
            )


def _shear(series: Series) -> float:
    """The initial shear modulus as the largest secant tells it, MPa; 0 where it cannot."""
    modulus = bend_of(series.strain - 1, series.stress).stiffest
    return modulus / (2 * list(MODES.values())[series.mode].gap)


def _hints(series: Sequence[Series]) -> tuple[str, ...]:
    """Curves that do not bend as nominal stress does, moduli that few elastomers have."""
    hints = []
    if any(_never_bends(each.strain - 1, each.stress) for each in series if each.mode == 0):
        hints.append(
            "the stress keeps rising nearly as steeply as at first, as nominal stress of "
            "elastomers seldom does over such strains: if it is force over present area, "
            "--true-stress turns it into nominal stress; if strains are in per cent, --units "
            "strain=% says so"
        )
    for shear in map(_shear, series):
        if shear and not USUAL[0] <= shear <= USUAL[1]:
            hints.append(
                f"the initial shear modulus is about {shear:.3g} MPa, that of few elastomers: if "
                "the stress is in another unit, such as kgf/cm², psi or kPa, --units tells it"
            )
    return tuple(dict.fromkeys(hints))


def _never_bends(strain: Reals, stress: Reals) -> bool:
    reach = float(strain.max(initial=0.0))
    inside = strain > 0.02 * reach
    if reach < 0.5 or inside.sum() < FEWEST_POINTS:
        return False
    order = np.argsort(strain[inside], kind="stable")
    secant = (stress[inside] / strain[inside])[order]
    first = np.median(secant[:3])
    as_true_stress = np.median(secant[-3:]) > 0.9 * first and secant.min() > 0.8 * first
    return bool(as_true_stress or (reach > 1.5 and bend_of(strain, stress).fall > 0.75))
