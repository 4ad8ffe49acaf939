"""A measurement beside the model: bands, signs, units, zeros, and how far the model is asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from synthetic_curves import HIGHEST, made_up, measured, model

from bellows_design.errors import DesignError
from bellows_design.materials.library import load_material
from bellows_design.measured.comparison import CompareOptions, Comparison, compare
from bellows_design.measured.model.curve import ModelCurve
from bellows_design.measured.quantities import ANGLE, DISPLACEMENT_Z
from bellows_design.measured.reading.curve import MeasuredCurve
from bellows_design.measured.verdict import sentences

NINJAFLEX = load_material("ninjaflex")
PLAIN = CompareOptions()


def part(factor: float = 1.2, scatter: float = 0.01, points: int = 20) -> MeasuredCurve:
    return made_up(np.random.default_rng(1), factor, points, scatter)


def held(
    data: MeasuredCurve, options: CompareOptions = PLAIN, reach: float = 9.0, ending: str = ""
) -> Comparison:
    """Against a model that is known as far as it is asked, or to its reach."""

    def asked(highest: float) -> ModelCurve:
        ended = ending if highest > reach else ""
        return model(min(highest, reach), error=0.01, ending=ended)

    return compare("finger", NINJAFLEX, data, asked, options)


def test_the_model_is_asked_further_for_a_soft_part() -> None:
    far: list[float] = []

    def asked(highest: float) -> ModelCurve:
        far.append(highest)
        return model(highest)

    found = compare("finger", NINJAFLEX, part(0.55), asked, PLAIN)
    assert found.factor is not None and found.factor.low <= 0.55 <= found.factor.high
    assert found.factor.points == 20 and found.factor.beyond == 0
    assert len(far) == 2 and far[0] < HIGHEST / 0.55 < far[1]


def test_a_path_that_ends_is_said_and_not_asked_for_again() -> None:
    found = held(part(0.7), reach=0.09, ending="the model's load path ends at 0.09 MPa (touch)")
    assert found.factor is not None and found.factor.beyond > 0
    said = " ".join(sentences(found))
    assert "load path ends at 0.09 MPa" in said and "tell nothing of the factor" in said
    assert found.reached < 20 and "does not reach the other" in said


def test_the_sentence_says_how_stiff_the_print_is() -> None:
    stiff, same, soft = (sentences(held(part(factor)))[0] for factor in (1.2, 1.0, 0.8))
    assert stiff.startswith("Your print is 1.2") and "times as stiff as the data sheet (" in stiff
    assert same.startswith("Your print agrees with the data sheet of “ninjaflex”")
    assert soft.startswith("Your print is 0.")


def test_the_band_is_that_of_mesh_and_material() -> None:
    exact = part(1.0, 0.0)
    narrow, wide = held(exact), held(exact, CompareOptions(material_percent=10))
    assert narrow.inside.all()
    low, high = narrow.band(narrow.pressure)
    assert (high - low)[8:] == pytest.approx(0.02 * narrow.values[8:], rel=0.2)
    low, high = wide.band(wide.pressure)
    curve = wide.model.values
    assert high[8:] == pytest.approx(1.01 * curve(wide.pressure, 0.9)[8:], rel=5e-3)
    assert low[8:] == pytest.approx(0.99 * curve(wide.pressure, 1.1)[8:], rel=5e-3)
    outside = held(part(1.2, 0.0))
    assert not outside.inside.any() and "0 of 20 points" in " ".join(sentences(outside))


def test_the_materials_own_uncertainty_is_taken_unless_it_is_told() -> None:
    unsure = NINJAFLEX.model_copy(update={"fit_error": 4.0, "fit_modulus_error": 7.0})

    def found(options: CompareOptions) -> float | None:
        return compare("finger", unsure, part(), model, options).material_percent

    assert found(PLAIN) == 7 and found(CompareOptions(material_percent=3)) == 3
    assert held(part()).material_percent is None
    assert "--material-uncertainty" in " ".join(sentences(held(part())))


def test_values_of_the_other_sign_are_a_matter_of_convention() -> None:
    found = held(part().turned())
    assert found.factor is not None and found.factor.low <= 1.2 <= found.factor.high
    assert any("with the other sign" in note for note in found.measured.reading.notes)


def test_both_curves_are_counted_from_the_zero() -> None:
    found = held(part(1.2, 0.002), CompareOptions(zero_at=0.0125))
    assert found.factor is not None and found.factor.low <= 1.2 <= found.factor.high
    assert np.interp(0.0125, found.pressure, found.measured.value) == pytest.approx(0, abs=1e-9)
    assert found.model.values(np.array([0.0125])) == pytest.approx(0)
    for outside in (0.001, 0.2):
        with pytest.raises(DesignError, match=r"--zero-at is .* between 0.005 and 0.1 MPa"):
            held(part(), CompareOptions(zero_at=outside))


@pytest.mark.parametrize(("scale", "unit"), [(np.pi / 180, "rad"), (180 / np.pi, "deg")])
def test_angles_in_the_other_unit_are_asked_about(scale: float, unit: str) -> None:
    wrong = replace(part(), value=scale * part().value)
    with pytest.raises(DesignError, match=f"as if they were in {unit}; --units angle={unit}"):
        held(wrong)
    told = held(replace(wrong, unit_told=True), CompareOptions(fit=False))
    assert told.factor is None
    assert held(replace(wrong, quantity=DISPLACEMENT_Z), CompareOptions(fit=False)).reached


def test_a_shape_that_no_factor_explains_is_said_with_its_pressures() -> None:
    data = part(1.1, 0.005, 30)
    knee = measured(data.value + np.where(data.pressure > 0.075, 50.0, 0.0), data.pressure)
    found = held(knee)
    said = " ".join(sentences(found))
    assert found.departures and "A factor does not explain all of it" in said
    assert "from 0.07" in said or "from 0.08" in said


def test_without_a_fit_the_model_as_designed_is_held_against_it() -> None:
    found = held(part(2.0), CompareOptions(fit=False))
    assert found.factor is None and not found.fitted.refused
    assert found.fitted_values == pytest.approx(found.values)
    assert "as designed departs" in " ".join(sentences(found))


def test_too_few_points_are_compared_without_a_factor() -> None:
    found = held(part(points=3))
    assert found.factor is None and sentences(found)[0].startswith("No factor: part.csv has 3")


@pytest.mark.parametrize("percent", [-1.0, 100.0, float("nan")])
def test_an_uncertainty_is_a_percentage(percent: float) -> None:
    with pytest.raises(DesignError, match=r"--material-uncertainty is .* below 100 %"):
        CompareOptions(material_percent=percent)


def test_a_vacuum_is_compared_by_its_size() -> None:
    data = part()
    sucked = measured(data.value, -data.pressure, ANGLE)
    found = held(sucked)
    assert found.factor is not None and found.factor.low <= 1.2 <= found.factor.high


def test_the_model_is_asked_as_far_as_the_softest_material_of_its_band_needs() -> None:
    found = held(part(1.0), CompareOptions(material_percent=40))
    assert found.inside.all() and found.reached == 20
    ended = held(part(1.0), CompareOptions(material_percent=40), reach=0.12, ending="It ends.")
    assert ended.reached == 14  # 0.6 of 0.12 MPa, at which the band's soft end is not known
    assert ended.inside.sum() == 14


def test_a_zero_among_the_points_asks_the_model_no_further() -> None:
    far: list[float] = []

    def asked(highest: float) -> ModelCurve:
        far.append(highest)
        return model(highest, error=0.01)

    found = compare("finger", NINJAFLEX, part(1.0), asked, CompareOptions(zero_at=0.01))
    assert found.factor is not None and found.factor.points == 19
    assert len(far) == 1
