"""Names of columns: quantity and unit, in the words and spellings of machines."""

from __future__ import annotations

import pytest

from bellows_design.materials.measurements.table.headings import heading
from bellows_design.materials.measurements.table.units import UNITS, plain_unit


@pytest.mark.parametrize(
    ("text", "quantity", "unit"),
    [
        ("stress_mpa", "stress", "mpa"),
        ("Stress [MPa]", "stress", "mpa"),
        ("Spannung / N/mm²", "stress", "n/mm2"),
        ("Standardkraft in N", "force", "n"),
        ("Tensile strain (Displacement) (%)", "strain", "%"),
        ("Tensile extension (mm)", "extension", "mm"),
        ("strain%", "strain", "%"),
        ("strain_percent", "strain", "%"),
        ("Strain 1 [-]", "strain", "-"),
        ("Strain [mm/mm]", "strain", "mm/mm"),
        ("Elongation (%)", "strain", "%"),
        ("Elongation [mm]", "extension", "mm"),
        ("elongation", "elongation", None),
        ("Déformation (%)", "strain", "%"),
        ("ε [%]", "strain", "%"),
        ("λ", "stretch", None),
        ("Stretch ratio", "stretch", None),
        ("Load (kgf)", "force", "kgf"),
        ("Prüfzeit [s]", "time", "s"),
        ("Specimen ID", "specimen", None),
        ("stress [psi]", "stress", "psi"),
        ("STRESS_KPA", "stress", "kpa"),
        ("Dehnung", "strain", None),
    ],
)
def test_a_name_that_is_known(text: str, quantity: str, unit: str | None) -> None:
    found = heading(text)
    assert (found.quantity, found.unit) == (quantity, unit)
    assert not found.true and not found.compressive


@pytest.mark.parametrize(
    "text",
    [
        *("Strain rate (1/s)", "Max stress (MPa)", "Strain at break (%)", "Load cell temperature"),
        *("stress_furlong", "pressure", "", "mod", "x" * 5000, "[[[", "((((", "Stress (N)"),
        *("Strain (corrected)", "Force (MPa)", "Time (mm)", "Work (J)"),
    ],
)
def test_a_name_that_is_not(text: str) -> None:
    assert heading(text).quantity is None


def test_true_and_compressive_quantities_are_told_by_their_names() -> None:
    for text in ("True stress (MPa)", "Cauchy stress", "Wahre Spannung [MPa]"):
        assert heading(text).true and heading(text).quantity == "stress"
    for text in ("True strain", "Log strain (%)", "Hencky strain"):
        assert heading(text).true and heading(text).quantity == "strain"
    assert heading("Compressive strain (%)").compressive
    assert heading("Nominal stress (MPa)").nominal and heading("Eng. strain").nominal


def test_units_have_the_factors_of_their_definitions() -> None:
    stress, force = UNITS["stress"], UNITS["force"]
    assert stress["psi"] == pytest.approx(force["lbf"] / 25.4**2, rel=1e-12)
    assert stress["kgf/cm2"] == pytest.approx(force["kgf"] / 100, rel=1e-12)
    assert stress["n/mm2"] == stress["mpa"] == stress["mn/m2"] == 1
    assert force["kgf"] == 9.80665 and UNITS["extension"]["in"] == 25.4
    assert UNITS["strain"]["%"] == 0.01 and UNITS["strain"]["mm/m"] == 1e-3
    assert plain_unit(" N / mm^2 ") == plain_unit("N/mm²") == "n/mm2"
