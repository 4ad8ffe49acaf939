"""Every material of the library: it loads, says where it is from, and is stable where it holds."""

from __future__ import annotations

import re
import tomllib
from importlib.resources import files

import numpy as np
import pytest

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.materials.library import load_material, material_names
from bellows_design.materials.material import Material
from solver import Ogden
from solver.material.homogeneous import UNIAXIAL, nominal_stress
from solver.material.stability import HIGHEST, LOWEST, stability

SHIPPED = sorted(
    file.name.removesuffix(".toml")
    for file in (files("bellows_design") / "materials").iterdir()
    if file.name.endswith(".toml")
)


def text_of(name: str) -> str:
    return (files("bellows_design") / "materials" / f"{name}.toml").read_text("utf-8")


def test_the_library_has_the_papers_material_and_others() -> None:
    assert {"ninjaflex", "ninjaflex_linear", "natural_rubber_treloar"} <= set(SHIPPED)
    assert set(SHIPPED) <= set(material_names())


@pytest.mark.parametrize("name", SHIPPED)
def test_a_material_loads_under_its_files_name_and_has_a_source(name: str) -> None:
    material = load_material(name)
    assert material.name == name
    assert len(material.source) > 40 and re.search(r"\b(19|20)\d\d\b", material.source)
    own = {"c10", "c01", "c20", "c30"}
    assert tomllib.loads(text_of(name)).keys() <= type(material).model_fields.keys() | own


@pytest.mark.parametrize("name", SHIPPED)
def test_a_material_is_stable_over_its_stated_range(name: str) -> None:
    material = load_material(name)
    low, high = material.valid_strain or (LOWEST - 1, HIGHEST - 1)
    found = stability(material.law_constants())
    assert found.covers(max(1 + low, LOWEST), min(1 + high, HIGHEST))
    assert found.shear_modulus == pytest.approx(material.initial_shear_modulus)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_design_takes_every_material_by_name(name: str) -> None:
    table = load_design("prototype_1").model_dump() | {"material": name}
    design = Design.of(table)
    assert design.material == load_material(name)
    assert Design.from_toml(design.to_toml()) == design


def test_the_linear_data_have_the_manufacturers_modulus() -> None:
    material, step = load_material("ninjaflex_linear"), 1e-6
    stress = nominal_stress(UNIAXIAL, np.array([1 + step]), material.law_constants())[0]
    assert stress / step == pytest.approx(12.0, rel=1e-5)


def test_treloars_rubber_carries_what_he_measured() -> None:
    """Uniaxial, of his table (1944, kg/cm² in MPa): the ends of the range, within 20 %."""
    material = load_material("natural_rubber_treloar")
    ours = nominal_stress(UNIAXIAL, np.array([1.24, 3.02]), material.law_constants())
    assert ours == pytest.approx([0.226, 0.863], rel=0.2)


@pytest.mark.parametrize(
    ("name", "modulus"), [("dragon_skin_20", 0.338), ("dragon_skin_30", 0.593)]
)
def test_silicones_are_within_a_third_of_the_data_sheets_modulus_at_100_percent(
    name: str, modulus: float
) -> None:
    material = load_material(name)
    ours = nominal_stress(UNIAXIAL, np.array([2.0]), material.law_constants())[0]
    assert 2 / 3 * modulus < ours < modulus * 4 / 3


@pytest.mark.parametrize(
    ("name", "stress"),
    [
        ("ecoflex_00_30", 0.0297),
        ("ecoflex_00_50", 0.0410),
        ("dragon_skin_10", 0.113),
        ("mold_star_16", 0.186),
        ("sortaclear_40", 0.564),
        ("filaflex_60a", 2.64),
        ("filaflex_70a", 3.66),
        ("chinchilla", 3.73),
        ("ninjaflex_yeoh", 6.01),
    ],
)
def test_own_fits_carry_what_was_measured_at_100_percent(name: str, stress: float) -> None:
    """The points of the data sets that the files name, MPa."""
    material = load_material(name)
    ours = nominal_stress(UNIAXIAL, np.array([2.0]), material.law_constants())[0]
    assert ours == pytest.approx(stress, rel=0.1)


def of_model(**content: object) -> Material:
    return Material.model_validate({"yield_strength": 1.0, **content})


def test_models_of_the_field_are_cases_of_ogden_with_yeohs_terms() -> None:
    logs = np.array([0.5, 0.1, -0.6])
    x, y = np.exp(2 * logs).sum() - 3, np.exp(-2 * logs).sum() - 3
    energies = {
        of_model(model="neo-hooke", c10=0.3): 0.3 * x,
        of_model(model="mooney-rivlin", c10=0.3, c01=0.1): 0.3 * x + 0.1 * y,
        of_model(model="yeoh", c10=0.3, c20=0.02): 0.3 * x + 0.02 * x**2,
        of_model(model="yeoh", c10=0.3, c20=-0.01, c30=0.002, valid_strain=[-0.5, 2]): (
            0.3 * x - 0.01 * x**2 + 0.002 * x**3
        ),
    }
    for material, energy in energies.items():
        solid = Ogden(material.mu, material.alpha, higher=material.higher)
        assert solid.energy(logs) == pytest.approx(energy, rel=1e-14)
        assert Material.model_validate(material.model_dump()) == material


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ({"model": "neo-hooke", "c10": 1.0, "c20": 1.0}, "“neo-hooke” is written with c10"),
        ({"model": "yeoh", "c10": 1.0, "c30": 1.0}, "c10, c20 or c10, c20, c30"),
        ({"c10": 1.0}, "“ogden” is written with mu, alpha"),
        ({"model": "yeoh", "c10": 1.0, "mu": [1.0]}, "say the same thing twice"),
        (
            {"model": "yeoh", "c10": "1", "c20": 1.0},
            "material.c10 is “1” but must be a number, in MPa; write 1 without quotes",
        ),
        ({"model": "yeoh", "c10": 10**400, "c20": 1.0}, "must lie between -300 and 300 MPa"),
        ({"model": "neo-hooke", "mu": [1.0], "alpha": [3.0]}, "“neo-hooke” has"),
        ({"model": "mooney-rivlin", "c10": 0.3, "c01": -0.1}, "Hill's inequality"),
        (
            {"model": "yeoh", "c10": 0.4, "c20": -0.12, "c30": 0.002},
            "biaxial tests are stable only",
        ),
        ({"mu": [1.0], "alpha": [2.0], "valid_strain": [0.1, 0.2]}, "must run from a number below"),
        ({"mu": [1.0], "alpha": [2.0], "valid_strain": [-1.0, 0.2]}, "must be greater than -1"),
    ],
)
def test_what_is_no_material_is_refused_in_one_sentence(
    content: dict[str, object], words: str
) -> None:
    from pydantic import ValidationError

    from bellows_design.validation.sentences import sentences

    with pytest.raises(ValidationError) as caught:
        of_model(**content)
    told = sentences(caught.value, Material)
    assert any(words in each for each in told) and all("\n" not in each for each in told)


def test_yeoh_may_soften_outside_of_the_range_it_states() -> None:
    constants = {"model": "yeoh", "c10": 0.4, "c20": -0.12, "c30": 0.002}
    assert of_model(**constants, valid_strain=[-0.1, 0.2]).higher == (-0.12, 0.002)


def test_a_range_of_validity_leaves_the_digest_and_yeohs_terms_change_it() -> None:
    table = load_design("prototype_1").model_dump()
    plain = Design.of(table)
    table["material"] |= {"valid_strain": [-0.5, 1.0]}
    assert Design.of(table).digest == plain.digest
    table["material"] |= {"higher": [0.01]}
    assert Design.of(table).digest != plain.digest


@pytest.mark.parametrize("key", ["name", "source"])
def test_texts_of_a_material_stay_on_one_line(key: str) -> None:
    content = load_material("ninjaflex").model_dump() | {key: "a\nb\x1b[2J"}
    with pytest.raises(ValueError, match="printable text on one line"):
        Material.model_validate(content)
