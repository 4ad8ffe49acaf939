"""From columns as they are named to stretch and nominal stress in MPa."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.columns import Pair, shown
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.series import Series, all_of
from bellows_design.materials.measurements.strain_scale import (
    percent_or_fraction,
    require_plausible,
)
from bellows_design.materials.measurements.table.facts import initial_area
from bellows_design.materials.measurements.table.header import Table
from bellows_design.materials.measurements.table.headings import Heading
from bellows_design.materials.measurements.table.units import UNITS, shown_unit
from solver.arrays import Reals
from solver.material.homogeneous import MODES

SMALLEST_STRETCH, LARGEST_STRETCH = 0.05, 20.0
"""No rubber is tested beyond; a larger number is a strain in per cent or a length in mm."""

LARGEST_STRESS = 1000.0
"""MPa. More is another unit."""


def converted(
    series: Sequence[Series], table: Table, pair: Pair, options: ReadingOptions
) -> tuple[list[Series], tuple[str, ...]]:
    """The series with stretches and nominal stresses in MPa, and notes on what was taken for what.

    Raises:
        DesignError: A unit, an area or a length is missing, or a value is out of bounds.
    """
    strain, stress = (table.headings[k] for k in pair)
    if series[0].percent:
        strain = strain._replace(unit="%", told=True)
    factor, stress_note = _stress_factor(stress, table, options)
    scaled = [replace(each, stress=each.stress * factor) for each in series]
    scale, strain_note = _strain_scale(strain, scaled, table, options)
    true_strain = strain.true or options.true_strain
    true_stress = stress.true or options.true_stress
    stretched = [
        replace(each, strain=_stretch(each.strain * scale, strain, true_strain)) for each in scaled
    ]
    turned, note = _in_compression(stretched, strain, stress)
    for each in turned:
        _require_bounds(each, strain)
    results = [
        replace(each, stress=each.stress / each.strain) if true_stress else each for each in turned
    ]
    notes = (_kind(strain, true_strain, strain_note), _kind(stress, true_stress, stress_note), note)
    return results, tuple(text for text in notes if text)


def _stress_factor(found: Heading, table: Table, options: ReadingOptions) -> tuple[float, str]:
    """From numbers as given to MPa, and a note."""
    if found.unit is None:
        name, units = (
            ("stress", "MPa, kPa, Pa, N/mm², psi, kgf/cm² …")
            if found.quantity == "stress"
            else ("force", "N, kN, kgf, lbf …")
        )
        raise DesignError(
            f"{table.named}: {shown(found)} has no unit; --units {name}=UNIT tells it "
            f"({units}), such as --units {name}={units.split(',')[0]}."
        )
    unit = UNITS[found.quantity or ""][found.unit]
    if found.quantity == "stress":
        return unit, f"in {shown_unit(found.unit)}"
    area = options.area or initial_area(table.facts)
    if area is None:
        raise DesignError(
            f"{table.named}: {shown(found)} is a force; --area MM2 gives the initial area of the "
            "specimen in mm² that it is divided by."
        )
    origin = "as given" if options.area else "from the lines above the table"
    return (
        unit / area,
        f"in {shown_unit(found.unit)}, over the initial area of {area:g} mm² ({origin})",
    )


def _strain_scale(
    found: Heading, series: Sequence[Series], table: Table, options: ReadingOptions
) -> tuple[float, str]:
    """From numbers as given to strains or stretches without unit, and a note."""
    if found.quantity == "extension":
        return _extension_scale(found, table, options)
    if found.unit is not None:
        factor = UNITS[found.quantity or ""][found.unit]
        if not found.told and found.quantity == "strain":
            require_plausible(
                found, factor, all_of(series, "strain"), all_of(series, "stress"), table.named
            )
        return factor, f"in {shown_unit(found.unit)}" if factor != 1 else "as a fraction"
    if found.quantity == "stretch":
        return 1.0, "as length over initial length"
    modes = [list(MODES.values())[each.mode] for each in series]
    stiffness = float(np.mean([2 * mode.gap for mode in modes]))
    return percent_or_fraction(
        found, all_of(series, "strain"), all_of(series, "stress"), stiffness, table.named
    )


def _extension_scale(found: Heading, table: Table, options: ReadingOptions) -> tuple[float, str]:
    lengths = table.facts.get("gauge_length", ())
    length = options.gauge_length or (lengths[0] if len(lengths) == 1 else None)
    if found.unit is None or length is None:
        missing = (
            "--units extension=mm tells its unit"
            if found.unit is None
            else ("--gauge-length MM gives the initial length in mm that it is divided by")
        )
        raise DesignError(f"{table.named}: {shown(found)} is an extension; {missing}.")
    origin = "as given" if options.gauge_length else "from the lines above the table"
    unit = UNITS["extension"][found.unit]
    return (
        unit / length,
        f"in {shown_unit(found.unit)}, over the initial length of {length:g} mm ({origin})",
    )


def _stretch(strain: Reals, found: Heading, true: bool) -> Reals:
    if found.quantity == "stretch":
        return strain
    result: Reals = np.exp(np.clip(strain, -700, 700)) if true else 1 + strain
    return result


def _in_compression(
    series: list[Series], strain: Heading, stress: Heading
) -> tuple[list[Series], str]:
    """Signs turned where a name says that compression counts as positive, and the numbers do."""
    positive = all((each.strain >= 0.999).all() and each.stress.sum() > 0 for each in series)
    if not (strain.compressive or stress.compressive) or not positive:
        return series, ""
    turned = [replace(each, strain=2 - each.strain, stress=-each.stress) for each in series]
    return turned, "compression, as the names say: strain and stress are taken as negative"


def _kind(found: Heading, true: bool, how: str) -> str:
    kind = {
        "stretch": "stretch",
        "extension": "extension",
        "force": "force",
        "strain": "true (logarithmic) strain" if true else "nominal strain",
        "stress": "true (Cauchy) stress, turned into nominal" if true else "nominal stress",
    }[found.quantity or ""]
    return f"{shown(found)} is read as {kind}, {how}"


def _require_bounds(series: Series, found: Heading) -> None:
    low, high = SMALLEST_STRETCH, LARGEST_STRETCH
    outside = ~((series.strain >= low) & (series.strain <= high))
    if outside.any():
        index = int(outside.argmax())
        raise DesignError(
            f"{series.where(index)}: {found.text} is a stretch of {series.strain[index]:g} but "
            f"must lie between {low:g} and {high:g} (length over initial length; as strain from "
            f"{low - 1:g} to {high - 1:g}); is it in another unit? --units tells it."
        )
    beyond = np.abs(series.stress) > LARGEST_STRESS
    if beyond.any():
        index = int(beyond.argmax())
        raise DesignError(
            f"{series.where(index)}: the stress is {series.stress[index]:g} MPa but must lie "
            f"between {-LARGEST_STRESS:g} and {LARGEST_STRESS:g} MPa; is it in another unit? "
            "--units tells it."
        )
