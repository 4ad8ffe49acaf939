"""The five-parameter Mooney-Rivlin law from a fit to a design: no line of code of its own here."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from bellows_design import load_design
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.materials.fitted_material import fitted_material, why_no_material
from bellows_design.materials.library import checked_material, write_material
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import fit_model
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.mooney_rivlin import MooneyRivlin

MODEL = "mooney-rivlin-5"
TRUTH = (0.4, 0.05, 0.02, -0.002, 0.003)
CONSTANTS = dict(zip(("c10", "c01", "c20", "c11", "c02"), TRUTH, strict=True))


def made(noise: float = 0.0, seed: int = 0) -> Measurements:
    """Tests of all three kinds on a material with the constants of ``TRUTH``."""
    line, law = np.linspace(0.75, 1.7, 40), MooneyRivlin(*TRUTH).constants
    stress = np.concatenate([nominal_stress(mode, line, law) for mode in MODES.values()])
    factors = 1 + noise * np.random.default_rng(seed).standard_normal(stress.size)
    return Measurements("made", np.tile(line, 3), stress * factors, np.repeat([0, 1, 2], 40))


def test_exact_curves_give_the_constants_back() -> None:
    found = fit_model(made(), MODEL)
    assert [constant.name for constant in found.constants] == [*CONSTANTS]
    assert [constant.value for constant in found.constants] == pytest.approx(TRUTH, rel=1e-8)
    assert found.relative_error < 1e-10 and found.determined and not found.vanished


def test_intervals_hold_the_truth_about_as_often_as_they_say() -> None:
    """Of 200 intervals at 95 % some 190 should; fewer than 176 has a chance of 1e-4."""
    hits = 0
    for seed in range(40):
        found = fit_model(made(0.02, seed), MODEL)
        for constant, truth in zip(found.constants, TRUTH, strict=True):
            hits += constant.low <= truth <= constant.high
    assert hits >= 176


def test_a_fit_becomes_a_material_of_named_constants_and_comes_back(tmp_path: Path) -> None:
    data = made()
    found = fit_model(data, MODEL)
    assert why_no_material(data, found) is None
    material = fitted_material(data, found, "mine", 4.0)
    write_material(material, tmp_path / "mine.toml")
    table = tomllib.loads((tmp_path / "mine.toml").read_text("utf-8"))
    assert {key: table[key] for key in CONSTANTS} == pytest.approx(CONSTANTS, rel=1e-8)
    assert not {"mu", "alpha", "higher", "constants"} & set(table)
    assert checked_material(table) == material


def test_a_design_takes_it_and_the_solver_gets_its_constants() -> None:
    table = load_design("prototype_1").model_dump()
    table["material"] = {"model": MODEL, "yield_strength": 4.0, **CONSTANTS}
    table["material"] |= {"valid_strain": [-0.3, 0.5]}
    design = Design.of(table)
    assert design.material.hyperelastic() == MooneyRivlin(*TRUTH)
    assert design.material.initial_shear_modulus == pytest.approx(0.9)
    again = Design.from_toml(design.to_toml())
    assert again == design and again.digest == design.digest
    table["material"]["c11"] = -0.0021
    assert Design.of(table).digest != design.digest


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"c11": -0.2}, "tests are stable only at stretches from"),
        ({"c10": -0.05}, "shear modulus"),
        ({"c02": None}, "is written with c10, c01, c20, c11, c02"),
        ({"mu": [1.0]}, "say the same thing twice"),
        ({"c10": 1e6}, "must lie between -300 and 300 MPa"),
    ],
)
def test_what_is_no_material_is_refused_in_one_sentence(
    changes: dict[str, object], words: str
) -> None:
    table = {"model": MODEL, "yield_strength": 4.0, **CONSTANTS, **changes}
    with pytest.raises(DesignError, match=words) as caught:
        checked_material({key: value for key, value in table.items() if value is not None})
    assert len(caught.value.sentences) == 1
