"""Every material of the library: it loads, says where it is from, and is stable where it holds."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import EntryPoint
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from bellows_design.design import Design, load_design
from bellows_design.errors import DesignError
from bellows_design.homogeneous import UNIAXIAL, nominal_stress
from bellows_design.materials import ENTRY_POINTS, Material, load_material, material_names
from bellows_design.stability import stability

RANGE = re.compile(r"valid_strain = \[(-[0-9.]+), ([0-9.]+)\]")
SHIPPED = sorted(
    file.name.removesuffix(".toml")
    for file in (files("bellows_design") / "materials").iterdir()
    if file.name.endswith(".toml")
)


def text_of(name: str) -> str:
    return (files("bellows_design") / "materials" / f"{name}.toml").read_text("utf-8")


def stretches_of(name: str) -> tuple[float, float]:
    """The range of principal stretches a file states; all that are looked at without one."""
    found = RANGE.search(text_of(name))
    return (0.1, 10.0) if found is None else (1 + float(found[1]), 1 + float(found[2]))


def test_the_library_has_the_papers_material_and_others() -> None:
    assert {"ninjaflex", "ninjaflex_linear", "natural_rubber_treloar"} <= set(SHIPPED)
    assert set(SHIPPED) <= set(material_names())


@pytest.mark.parametrize("name", SHIPPED)
def test_a_material_loads_under_its_files_name_and_has_a_source(name: str) -> None:
    material = load_material(name)
    assert material.name == name
    assert len(material.source) > 40 and re.search(r"\b(19|20)\d\d\b", material.source)
    assert tomllib.loads(text_of(name)).keys() <= type(material).model_fields.keys()


@pytest.mark.parametrize("name", SHIPPED)
def test_a_material_is_stable_over_its_stated_range(name: str) -> None:
    material, (low, high) = load_material(name), stretches_of(name)
    assert low < 1 < high
    found = stability(material.mu, material.alpha)
    assert found.everywhere and found.covers(max(low, 0.1), min(high, 10.0))
    assert found.shear_modulus == pytest.approx(material.initial_shear_modulus)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_design_takes_every_material_by_name(name: str) -> None:
    table = load_design("prototype_1").model_dump() | {"material": name}
    design = Design.of(table)
    assert design.material == load_material(name)
    assert Design.from_toml(design.to_toml()) == design


def test_the_linear_data_have_the_manufacturers_modulus() -> None:
    material, step = load_material("ninjaflex_linear"), 1e-6
    stress = nominal_stress(UNIAXIAL, np.array([1 + step]), material.mu, material.alpha)[0]
    assert stress / step == pytest.approx(12.0, rel=1e-5)


def test_treloars_rubber_carries_what_he_measured() -> None:
    """Uniaxial, of his table (1944, kg/cm² in MPa): the ends of the range, within 20 %."""
    material = load_material("natural_rubber_treloar")
    ours = nominal_stress(UNIAXIAL, np.array([1.24, 3.02]), material.mu, material.alpha)
    assert ours == pytest.approx([0.226, 0.863], rel=0.2)


@pytest.mark.parametrize(
    ("name", "modulus"), [("dragon_skin_20", 0.338), ("dragon_skin_30", 0.593)]
)
def test_silicones_are_within_a_third_of_the_data_sheets_modulus_at_100_percent(
    name: str, modulus: float
) -> None:
    material = load_material(name)
    ours = nominal_stress(UNIAXIAL, np.array([2.0]), material.mu, material.alpha)[0]
    assert 2 / 3 * modulus < ours < modulus * 4 / 3


@pytest.mark.parametrize("content", [b"mu = ", b"\xff\xfe", b"mu = [1]\nmu = [2]"])
def test_a_broken_file_of_another_package_is_named_in_one_sentence(
    content: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "labmat").mkdir()
    (tmp_path / "labmat/__init__.py").touch()
    (tmp_path / "labmat/foam.toml").write_bytes(content)
    monkeypatch.syspath_prepend(tmp_path)
    entries = [EntryPoint("lab", module, ENTRY_POINTS) for module in ("labmat", "gone_package")]
    monkeypatch.setattr("bellows_design.materials.entry_points", lambda group: entries)
    with pytest.raises(DesignError, match=r"foam.* cannot be read"):
        load_material("foam")
    assert load_material("ninjaflex").mu


@pytest.mark.parametrize("key", ["name", "source"])
def test_texts_of_a_material_stay_on_one_line(key: str) -> None:
    content = load_material("ninjaflex").model_dump() | {key: "a\nb\x1b[2J"}
    with pytest.raises(ValueError, match="printable text on one line"):
        Material.model_validate(content)
