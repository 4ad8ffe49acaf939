"""Fits of made-up and of published curves: constants come back, and what is open is said."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from bellows_design.errors import DesignError
from bellows_design.materials.laws import FIT_MODELS, law_of_fit
from bellows_design.materials.measurements.loading import load_measurements, parse_measurements
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import NOT_MUCH_WORSE, fit, fit_model
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed

MEASURED = Path(__file__).parents[2] / "data/treloar_1944.csv"
POINTS = Path(__file__).parents[3] / "solver/data/ogden_points.json"
NINJAFLEX = (3.2778, 0.19825), (-0.0054, 3.05)
TRELOAR = (0.4095, 0.01, 0.003), (1.3, -2.0, 5.0)
STRETCHES = np.concatenate([np.linspace(0.5, 0.95, 10), np.linspace(1.05, 4.0, 40)])


def made(
    constants: tuple[tuple[float, ...], tuple[float, ...]],
    modes: tuple[str, ...] = tuple(MODES),
    noise: float = 0.0,
    stretches: np.ndarray = STRETCHES,
    seed: int = 0,
) -> Measurements:
    """Measurements of a known material, with relative noise of that standard deviation."""
    random = np.random.default_rng(seed)
    stress = np.concatenate(
        [nominal_stress(MODES[m], stretches, packed(*constants)) for m in modes]
    )
    numbers = np.repeat([list(MODES).index(mode) for mode in modes], stretches.size)
    factors = 1 + noise * random.standard_normal(stress.size)
    return Measurements("made.csv", np.tile(stretches, len(modes)), stress * factors, numbers)


def treloar() -> Measurements:
    """Ogden's (1972) curves of Treloar's rubber in tension, in the digits of the reference."""
    cases = json.loads(POINTS.read_text("utf-8"))["cases"]
    curves = next(c["reference"] for c in cases if c["name"] == "M2_treloar_ogden1972")
    names = {"uniaxial": "uniaxial", "biaxial": "equibiaxial", "planar": "planar"}
    rows = [
        f"{mode},{stretch},{stresses[name]!r}"
        for mode, name in names.items()
        for stretch, stresses in curves.items()
        if float(stretch) >= 1.01
    ]
    return parse_measurements("mode,stretch,stress_mpa\n" + "\n".join(rows), "Treloar", "Treloar")


def test_treloars_rubber_gives_ogdens_constants_back() -> None:
    best = fit(treloar()).fit
    assert best.model == "ogden3" and best.determined and best.stable and not best.vanished
    assert best.mu == pytest.approx(TRELOAR[0], rel=1e-7)
    assert best.alpha == pytest.approx(TRELOAR[1], rel=1e-7)
    assert best.r_squared == pytest.approx(1, abs=1e-12)
    assert best.misfit.error < 1e-7


@pytest.mark.parametrize(
    ("model", "constants"),
    [
        ("neo-hooke", ((0.7,), (2.0,))),
        ("mooney-rivlin", ((0.6, 0.05), (2.0, -2.0))),
        ("ogden1", ((0.02,), (-3.3,))),
        ("ogden1", ((5.0,), (0.0,))),
        ("ogden2", NINJAFLEX),
        ("ogden3", TRELOAR),
    ],
)
def test_exact_curves_give_their_constants_back(
    model: str, constants: tuple[tuple[float, ...], tuple[float, ...]]
) -> None:
    found = fit_model(made(constants), model)
    assert found.mu == pytest.approx(constants[0], rel=1e-5)
    assert found.alpha == pytest.approx(constants[1], rel=1e-5, abs=1e-5)
    assert found.relative_error < 1e-7 and found.determined


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("model", "constants"),
    [("neo-hooke", ((0.7,), (2.0,))), ("ogden1", ((4.0,), (1.2,))), ("ogden2", NINJAFLEX)],
)
def test_noisy_curves_give_constants_within_their_intervals(
    model: str, constants: tuple[tuple[float, ...], tuple[float, ...]], seed: int
) -> None:
    found = fit_model(made(constants, noise=0.02, seed=seed), model)
    truth = {f"mu_{k + 1}": value for k, value in enumerate(constants[0])}
    truth |= {f"alpha_{k + 1}": value for k, value in enumerate(constants[1])}
    for constant in found.constants:
        assert constant.low <= truth[constant.name] <= constant.high or constant.fixed
    assert found.relative_error == pytest.approx(0.02, rel=0.3)
    assert found.determined


def test_intervals_hold_the_truth_about_as_often_as_they_say() -> None:
    """Of 200 intervals at 95 % some 190 should; fewer than 180 has a chance of 1e-3 at most."""
    constants = ((4.0,), (1.2,))
    hits = 0
    for seed in range(100):
        found = fit_model(made(constants, ("uniaxial",), 0.02, seed=seed), "ogden1")
        for constant, truth in zip(found.constants, (4.0, 1.2), strict=True):
            hits += constant.low <= truth <= constant.high
    assert hits >= 180


def test_best_is_the_smallest_model_that_does() -> None:
    assert fit(made(((0.7,), (2.0,)), noise=0.02)).fit.model == "neo-hooke"
    assert fit(made(((0.7, 0.1), (2.0, -2.0)), noise=0.02)).fit.model == "mooney-rivlin"
    assert fit(made(((0.7,), (1.1,)), noise=0.02)).fit.model == "ogden1"
    choice = fit(made(NINJAFLEX, noise=0.02))
    assert choice.fit.model == "ogden2"
    sizes = [FIT_MODELS[each.model].constants for each in choice.tried]
    assert sizes == sorted(sizes) and len(sizes) >= 4


def test_best_says_so_when_no_model_that_fits_is_determined() -> None:
    """Uniaxial tension far into the upturn: several sets of constants follow it."""
    data = made(TRELOAR, ("uniaxial",), 0.02, np.linspace(1.1, 7.0, 25))
    choice = fit(data)
    assert choice.fit.relative_error < 0.05
    assert choice.fit.determined or not any(
        each.determined and each.aicc < choice.fit.aicc + NOT_MUCH_WORSE for each in choice.tried
    )


def test_a_term_too_many_is_said_to_add_nothing() -> None:
    found = fit_model(made(((0.7,), (2.0,)), ("uniaxial",)), "mooney-rivlin")
    assert found.vanished and not found.determined
    assert found.constants[2].high == math.inf and found.constants[2].value < 1e-12


def test_constants_the_tests_do_not_tell_get_wide_intervals() -> None:
    """Small strains in one test say little beyond the modulus."""
    stretches = np.linspace(1.01, 1.1, 30)
    data = made(NINJAFLEX, ("uniaxial",), 0.02, stretches)
    found = fit_model(data, "ogden2")
    assert not found.determined
    assert fit(data).fit.determined


def test_planar_tests_alone_do_not_tell_the_sign_of_an_exponent() -> None:
    """P = 4 μ sinh(α ln λ) / (α λ): the same for α and −α, which differ in other tests."""
    found = fit_model(made(((1.5,), (3.0,)), ("planar",)), "ogden1")
    assert abs(found.alpha[0]) == pytest.approx(3.0) and found.relative_error < 1e-7
    assert all(constant.determined for constant in found.constants)
    assert not found.unique and not found.determined and found.ambiguity > 0.5
    assert fit_model(made(((1.5,), (3.0,)), ("planar", "uniaxial")), "ogden1").unique


def test_repeated_points_of_one_stretch_determine_nothing_but_a_modulus() -> None:
    rows = "\n".join(f"1.5,{stress}" for stress in (1.0, 1.1, 0.9, 1.05, 0.95))
    data = parse_measurements("stretch,stress_mpa\n" + rows, "it", "it")
    found = fit_model(data, "ogden1")
    assert not found.determined and any(c.high - c.low > 1e3 for c in found.constants)
    assert fit(data).fit.model == "neo-hooke"


@given(
    scale=st.floats(1e-3, 300),
    alpha=st.floats(-8, 8),
    mode=st.sampled_from(["uniaxial", "biaxial"]),
)
@settings(max_examples=15, deadline=None)
def test_a_fit_scales_with_the_stress(scale: float, alpha: float, mode: str) -> None:
    found = fit_model(made(((scale,), (alpha,)), (mode,), stretches=STRETCHES[::3]), "ogden1")
    assert found.mu[0] == pytest.approx(scale, rel=1e-4)
    assert found.alpha[0] == pytest.approx(alpha, rel=1e-4, abs=1e-4)


@given(
    st.lists(
        st.tuples(
            st.integers(0, 2), st.floats(0.05, 20), st.floats(1e-5, 1000) | st.sampled_from([1.0])
        ),
        min_size=5,
        max_size=12,
    )
)
@settings(max_examples=40, deadline=None)
@pytest.mark.thorough
def test_whatever_the_reader_lets_through_is_fitted_or_refused(
    points: list[tuple[int, float, float]],
) -> None:
    modes, stretches, sizes = (np.array(each) for each in zip(*points, strict=True))
    stress = sizes * np.sign(stretches - 1)
    assume(stress.any())
    data = Measurements("any", stretches, stress, modes.astype(np.intp))
    try:
        choice = fit(data)
    except DesignError as error:
        assert "points away from stretch 1" in str(error)
        return
    for each in choice.tried:
        assert np.isfinite([*each.mu, *each.alpha, each.r_squared, each.relative_error]).all()
        assert not any(math.isnan(c.low) or math.isnan(c.high) for c in each.constants)


def test_every_fit_can_be_a_material_or_says_why_not() -> None:
    """Curves no positive constants can follow: the fit that answers is poor, never unstable."""
    stretch = np.linspace(1.05, 2, 20)
    data = Measurements("odd", stretch, np.sin(3 * (stretch - 1)), np.zeros(20, np.intp))
    choice = fit(data)
    assert choice.fit.stable
    for each in choice.tried:
        assert min(each.mu, default=0) >= 0 and (each.stable or law_of_fit(each.model).softens)


def test_a_hundred_thousand_points_take_seconds() -> None:
    stretches = np.random.default_rng(1).uniform(0.6, 3, 100_000)
    data = made(((4.0,), (1.2,)), ("uniaxial",), 0.02, stretches)
    found = fit_model(data, "ogden1")
    assert found.mu[0] == pytest.approx(4.0, rel=1e-3)


@pytest.mark.parametrize(
    ("model", "words"),
    [("ogden4", "did you mean ogden"), ("yoeh", "did you mean yeoh"), ("", "unknown model")],
)
def test_unknown_models_are_refused_in_one_sentence(model: str, words: str) -> None:
    with pytest.raises(DesignError, match=words):
        fit(made(NINJAFLEX), model)


def test_too_few_points_are_refused_in_one_sentence() -> None:
    few = made(NINJAFLEX, ("uniaxial",), stretches=np.array([1.0, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5]))
    with pytest.raises(DesignError, match="5 points away from stretch 1 but ogden2, with 4"):
        fit(few, "ogden2")
    assert {each.model for each in fit(few).tried} <= {"neo-hooke", "ogden1", "mooney-rivlin"}
    rest = made(NINJAFLEX, ("uniaxial",), stretches=np.array([1.0, 1.0, 1.0, 1.0, 1.3]))
    with pytest.raises(DesignError, match="1 points away from stretch 1"):
        fit(rest)


def test_treloars_measurements_need_three_terms_and_tell_all_their_constants() -> None:
    """His numbers, not Ogden's curves: three tests, up to 661 % strain."""
    data = load_measurements(MEASURED)
    assert data.modes == ("uniaxial", "biaxial", "planar") and data.stress.size == 53
    assert data.valid_strain == pytest.approx((4.44**-2 - 1, 6.61))
    best = fit(data).fit
    assert best.model == "ogden3" and best.determined and best.stable
    assert best.relative_error < 0.05 and best.r_squared > 0.99
    assert best.stability.shear_modulus == pytest.approx(0.4225, rel=0.12)  # Ogden's (1972)
    for each in best.constants:
        assert each.low < each.value < each.high


def test_yeoh_follows_treloar_to_a_tenth() -> None:
    found = fit(load_measurements(MEASURED), "yeoh").fit
    assert found.relative_error < 0.11 and found.r_squared > 0.99 and found.determined
    c20, c30 = found.higher
    assert c20 < 0 < c30 and found.stable


YEOH = ((0.8,), (2.0,), (-0.03, 0.002))


def made_of_yeoh(noise: float = 0.0, seed: int = 0) -> Measurements:
    line = np.linspace(0.6, 3.0, 40)
    stress = np.concatenate([nominal_stress(mode, line, packed(*YEOH)) for mode in MODES.values()])
    factors = 1 + noise * np.random.default_rng(seed).standard_normal(stress.size)
    return Measurements("made", np.tile(line, 3), stress * factors, np.repeat([0, 1, 2], 40))


def test_exact_curves_of_yeoh_give_their_constants_back() -> None:
    found = fit_model(made_of_yeoh(), "yeoh")
    assert found.mu == pytest.approx((0.8,), rel=1e-9) and found.alpha == (2.0,)
    assert found.higher == pytest.approx(YEOH[2], rel=1e-9)
    assert found.relative_error < 1e-10 and found.determined and not found.vanished


def test_intervals_of_yeoh_hold_the_truth_about_as_often_as_they_say() -> None:
    """Of 120 intervals at 95 % some 114 should; fewer than 104 has a chance of 1e-4."""
    hits = 0
    for seed in range(40):
        found = fit_model(made_of_yeoh(0.02, seed), "yeoh")
        for constant, truth in zip(found.constants, (0.4, -0.03, 0.002), strict=True):
            hits += constant.low <= truth <= constant.high
    assert hits >= 104


def test_too_few_points_for_yeoh_are_refused() -> None:
    few = made(NINJAFLEX, ("uniaxial",), stretches=np.array([1.0, 1.1, 1.2, 1.3, 1.4]))
    with pytest.raises(DesignError, match="4 points away from stretch 1 but yeoh, with 3"):
        fit(few, "yeoh")
