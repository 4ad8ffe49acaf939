"""A poor fit is no material, or one that says so for ever."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from tensile import NINJAFLEX, SHEAR, curve

from bellows_design.design.digest import digest_of
from bellows_design.design.shipped import load_design
from bellows_design.materials import load_material, material_names
from bellows_design.materials.bounds import POOR_FIT, POOR_MODULUS
from bellows_design.materials.fitted_material import fitted_material, why_poor
from bellows_design.materials.fitting.initial_modulus import initial_modulus
from bellows_design.materials.library import checked_material, write_material
from bellows_design.materials.material import Material
from bellows_design.materials.measurements.loading import load_measurements
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import fit, fit_model
from solver.material.homogeneous import MODES, nominal_stress

CASES = Path(__file__).parents[1] / "data/measurements"
GOOD = {"mu": [1.0], "alpha": [2.0], "yield_strength": 4.0}
MODULI = [name for name in material_names() if name != "ninjaflex_linear"]


def made_of(law: object, reach: float = 2.0, noise: float = 0.01, seed: int = 0) -> Measurements:
    strain, stress = curve(reach, law=law, noise=noise, seed=seed)  # type: ignore[arg-type]
    return Measurements("made", 1 + strain, stress, np.zeros(strain.size, np.intp))


def test_no_shipped_material_has_a_warning() -> None:
    assert all(load_material(name).warnings == () for name in material_names())
    assert Material.model_validate(GOOD).warnings == ()


@pytest.mark.parametrize(
    ("error", "warned"), [(0.0, False), (POOR_FIT, False), (POOR_FIT + 0.1, True), (1e6, True)]
)
def test_a_material_warns_of_an_error_beyond_the_bar(error: float, warned: bool) -> None:
    material = checked_material(GOOD | {"name": "mine", "fit_error": error})
    assert len(material.warnings) == warned
    if warned:
        assert "“mine” is a poor fit" in material.warnings[0] and "15 %" in material.warnings[0]


def test_a_material_warns_of_a_modulus_beyond_the_bar() -> None:
    assert checked_material(GOOD | {"fit_modulus_error": POOR_MODULUS}).warnings == ()
    (warning,) = checked_material(GOOD | {"fit_modulus_error": 25.0}).warnings
    assert "initial shear modulus" in warning and "25 % off" in warning


@pytest.mark.parametrize(
    ("source", "warned"),
    [
        ("fit of neo-Hooke to after_break.csv: R² -4.7, largest error 4.66 MPa", True),
        ("fit of neo-hooke to “a.csv”: 5 points, uniaxial; R² 0.85931, largest error 1 MPa", True),
        ("own fit, R^2 = 0.31", True),
        ("own fit, R2: 0.2", True),
        ("R² −4.7", True),
        ("fit of ogden2 to “sound.csv”: 60 points; R² 0.99922", False),
        ("own fit (ogden1, R² 0.9983, largest error 0.15 MPa)", False),
        ("R2D2 printed it", False),
        ("datasheet R20-5, 2020", False),
        ("", False),
    ],
)
def test_a_poor_fit_that_only_the_source_states_is_warned_of(source: str, warned: bool) -> None:
    """As files have it that were written before there was a field."""
    material = checked_material(GOOD | {"source": source})
    assert bool(material.warnings) is warned
    assert checked_material(GOOD | {"source": source, "fit_error": 2.0}).warnings == ()


def test_fields_of_the_fit_are_bounded_and_survive_a_file(tmp_path: Path) -> None:
    for key in ("fit_error", "fit_modulus_error"):
        with pytest.raises(ValueError, match=f"{key} is -1 %"):
            checked_material(GOOD | {key: -1.0})
    material = checked_material(GOOD | {"fit_error": 20.0, "fit_modulus_error": 12.0})
    write_material(material, tmp_path / "m.toml")
    again = checked_material(tomllib.loads((tmp_path / "m.toml").read_text("utf-8")))
    assert again == material and len(again.warnings) == 2


def test_designs_without_these_fields_keep_their_digests() -> None:
    design = load_design("finger")
    plain = design.model_copy(update={"material": design.material.model_copy()})
    assert digest_of(plain) == digest_of(design)
    poor = design.material.model_copy(update={"fit_error": 20.0})
    assert digest_of(design.model_copy(update={"material": poor})) != digest_of(design)


@pytest.mark.parametrize("name", MODULI)
def test_the_beginning_of_a_test_tells_the_modulus_without_a_law(name: str) -> None:
    """Within 1 % without noise, within three standard errors with it."""
    material = load_material(name)
    truth = material.initial_shear_modulus
    for mode in MODES:
        strain = np.linspace(0.02, 2, 120)
        stress = nominal_stress(MODES[mode], 1 + strain, material.law_constants())
        number = np.full(120, list(MODES).index(mode))
        exact = initial_modulus(Measurements("made", 1 + strain, stress, number))
        assert exact is not None and exact.value == pytest.approx(truth, rel=0.01)
        noise = 1 + 0.01 * np.random.default_rng(1).standard_normal(120)
        noisy = initial_modulus(Measurements("made", 1 + strain, stress * noise, number))
        assert noisy is not None and abs(noisy.value - truth) < 3 * noisy.error + 0.01 * truth


def test_too_little_at_small_strains_tells_no_modulus() -> None:
    strain = np.linspace(0.3, 2, 60)
    stress = nominal_stress(MODES["uniaxial"], 1 + strain, NINJAFLEX)
    assert initial_modulus(Measurements("made", 1 + strain, stress, np.zeros(60, np.intp))) is None


def test_a_fit_that_misses_the_beginning_is_poor() -> None:
    data = made_of(NINJAFLEX)
    assert why_poor(data, fit(data).fit) is None
    poor = fit_model(data, "neo-hooke")
    assert poor.relative_error > POOR_FIT / 100 and "off by" in (why_poor(data, poor) or "")
    short = made_of(NINJAFLEX, reach=1.0, noise=0.001)
    missed = fit_model(short, "neo-hooke")
    assert missed.relative_error < POOR_FIT / 100
    assert "initial shear modulus" in (why_poor(short, missed) or "")
    material = fitted_material(short, missed, "m", 4.0)
    assert material.fit_modulus_error is not None and material.fit_modulus_error > POOR_MODULUS


@pytest.mark.parametrize("seed", range(5))
def test_five_points_do_not_choose_a_model_that_misses_them(seed: int) -> None:
    """AICc alone takes neo-Hooke, 20 % off, for it counts a second constant 24 units."""
    strain = np.array([0.02, 0.45, 0.9, 1.3, 1.75])
    stress = nominal_stress(MODES["uniaxial"], 1 + strain, NINJAFLEX)
    noise = 1 + 0.01 * np.random.default_rng(seed).standard_normal(5)
    data = Measurements("five", 1 + strain, stress * noise, np.zeros(5, np.intp))
    choice = fit(data)
    assert choice.fit.relative_error < 0.05
    assert choice.by_criterion is None or choice.by_criterion.model == "neo-hooke"
    assert choice.fit.stability.shear_modulus == pytest.approx(SHEAR, rel=0.06)


@pytest.mark.parametrize("points", [5, 8, 30])
def test_where_the_smallest_model_is_the_truth_it_is_chosen_whatever_the_number_of_points(
    points: int,
) -> None:
    from solver.material.ogden import packed

    hits = 0
    for seed in range(5):
        strain, stress = curve(1.5, points, packed([0.7], [2.0]), seed, noise=0.03)
        data = Measurements("few", 1 + strain, stress, np.zeros(points, np.intp))
        choice = fit(data)
        hits += choice.fit.model == "neo-hooke" and choice.by_criterion is None
    assert hits >= 4


def test_the_reported_break_makes_no_poor_material() -> None:
    """Its points after break made R² −4.7; with them it is refused, without them it is good."""
    data = load_measurements(CASES / "after_break.csv")
    assert why_poor(data, fit(data).fit) is None
    kept = load_measurements(CASES / "after_break.csv", ReadingOptions(keep=("break", "zero")))
    assert kept.stretch.size == 65 and why_poor(kept, fit(kept).fit) is not None
