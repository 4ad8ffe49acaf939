"""Per cent or fractions: what is certain is read, what physics decides is said, the rest asked."""

from __future__ import annotations

from itertools import product

import pytest
from tensile import NINJAFLEX, SHEAR, SOFT, SOFT_SHEAR, curve, table

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.loading import parse_measurements
from bellows_design.materials.measurements.options import ReadingOptions

RUBBERS = {"ninjaflex": (NINJAFLEX, SHEAR), "silicone": (SOFT, SOFT_SHEAR)}
REACHES = (0.05, 0.15, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0)


def written(rubber: str, reach: float, factor: float, header: str) -> str:
    strain, stress = curve(reach, law=RUBBERS[rubber][0])
    return table(f"{header},stress_mpa", factor * strain, stress)


@pytest.mark.parametrize(("rubber", "reach", "factor"), [*product(RUBBERS, REACHES, (1, 100))])
def test_strains_without_a_unit_are_never_taken_for_a_hundredth_or_a_hundred_times(
    rubber: str, reach: float, factor: float
) -> None:
    """Either they are read right, saying why, or the question names both readings."""
    text = written(rubber, reach, factor, "strain")
    try:
        data = parse_measurements(text, "it")
    except DesignError as error:
        assert "--units strain=1 or --units strain=% tells which" in str(error)
        data = parse_measurements(
            text, "it", options=ReadingOptions(units=f"strain={'1' if factor == 1 else '%'}")
        )
    else:
        assert any("“strain” is read as nominal strain, as" in note for note in data.reading.notes)
    assert data.stretch.max() == pytest.approx(1 + reach)


@pytest.mark.parametrize("reach", [0.15, 0.5, 1.0, 2.0, 3.0])
def test_usual_tests_in_fractions_are_read_without_a_question(reach: float) -> None:
    for rubber in RUBBERS:
        data = parse_measurements(written(rubber, reach, 1, "strain"), "it")
        assert data.stretch.max() == pytest.approx(1 + reach)


@pytest.mark.parametrize("reach", [0.3, 0.5, 1.0, 2.0, 3.0])
def test_tests_in_per_cent_beyond_all_rubbers_as_fractions_are_read(reach: float) -> None:
    for rubber in RUBBERS:
        data = parse_measurements(written(rubber, reach, 100, "strain"), "it")
        assert data.stretch.max() == pytest.approx(1 + reach)


@pytest.mark.parametrize(("rubber", "reach"), [*product(RUBBERS, (0.5, 1.0, 2.0, 3.0, 5.0, 8.0))])
def test_a_header_that_the_curve_contradicts_is_asked_about(rubber: str, reach: float) -> None:
    fractions = written(rubber, reach, 1, "strain (%)")
    with pytest.raises(DesignError, match="says per cent, but the curve bends"):
        parse_measurements(fractions, "it")
    told = parse_measurements(fractions, "it", options=ReadingOptions(units="strain=1"))
    assert told.stretch.max() == pytest.approx(1 + reach)
    with pytest.raises(DesignError, match="--units tells it"):
        parse_measurements(written(rubber, reach, 100, "strain [-]"), "it")


def test_an_option_is_stronger_than_the_curve() -> None:
    text = written("silicone", 2.0, 1, "strain")
    data = parse_measurements(text, "it", options=ReadingOptions(units="strain=%"))
    assert data.stretch.max() == pytest.approx(1.02)


def test_stretches_called_strain_are_asked_about_and_so_are_strains_called_stretch() -> None:
    strain, stress = curve()
    with pytest.raises(DesignError, match="is the column a stretch"):
        parse_measurements(table("strain,stress_mpa", 1 + strain, stress), "it")
    for start in (0.02, 0.06):
        strain, stress = curve(start=start, points=25)
        with pytest.raises(DesignError):
            parse_measurements(table("stretch,stress_mpa", strain, stress), "it")


def test_moduli_that_no_elastomer_has_are_refused_and_rare_ones_get_a_hint() -> None:
    strain, stress = curve()
    for factor, words in ((145.04, "which no elastomer has"), (1e-4, "which no elastomer has")):
        with pytest.raises(DesignError, match=words):
            parse_measurements(table("strain [-],stress_mpa", strain, stress * factor), "it")
    data = parse_measurements(table("strain [-],stress_mpa", strain, stress * 10.2), "it")
    assert any("kgf/cm²" in hint for hint in data.reading.hints)


def test_stress_that_never_bends_gets_a_hint_of_true_stress() -> None:
    strain, stress = curve(law=SOFT)
    with pytest.raises(DesignError, match="--true-stress"):
        parse_measurements(table("strain [-],stress_mpa", strain, stress * (1 + strain)), "it")
    as_it_is = ReadingOptions(keep=("zero",))
    text = table("strain [-],stress_mpa", strain, stress * (1 + strain))
    hints = parse_measurements(text, "it", options=as_it_is).reading.hints
    assert any("--true-stress" in hint for hint in hints)
    assert (
        parse_measurements(table("strain [-],stress_mpa", strain, stress), "it").reading.hints == ()
    )
