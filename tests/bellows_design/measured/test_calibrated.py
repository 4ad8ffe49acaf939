"""The material with the factor: all its stresses scaled, written and read like any other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.materials.library import load_material, material_at, write_material
from bellows_design.materials.material import Material
from bellows_design.measured.calibrated import calibrated_material, with_stiffness
from solver.material.homogeneous import MODES, nominal_stress

FIVE = Material.model_validate(
    {
        "name": "five",
        "model": "mooney-rivlin-5",
        "c10": 0.2,
        "c01": 0.1,
        "c20": 0.01,
        "c11": 0.0,
        "c02": 0.0,
        "yield_strength": 4.0,
        "valid_strain": (-0.2, 0.5),
    }
)
LAWS = {"ogden": "ecoflex_00_30", "yeoh": "ninjaflex_yeoh", "linear": "ninjaflex_linear"}


@pytest.mark.parametrize(
    "material", [*(load_material(name) for name in LAWS.values()), FIVE], ids=[*LAWS, "own"]
)
def test_all_stresses_are_scaled_and_the_file_serves_a_design(
    material: Material, tmp_path: Path
) -> None:
    file, stretch = tmp_path / "my_print.toml", np.linspace(0.85, 1.4, 8)
    made = calibrated_material(material, 1.2, 1.16, 1.25, "my_print", "print.csv")
    write_material(made, file)
    read = material_at(file)
    for mode in MODES.values():
        stress, before = (
            nominal_stress(mode, stretch, each.law_constants()) for each in (read, material)
        )
        assert stress == pytest.approx(1.2 * before, rel=1e-9)
    assert read.yield_strength == material.yield_strength and read.name == "my_print"
    assert read.valid_strain == material.valid_strain and read.fit_error == material.fit_error
    assert "times 1.2 (1.16 to 1.25, 95 %), by bellows compare with print.csv" in read.source
    design = with_overrides(load_design("prototype_1"), [f"material={file}"])
    assert design.material == read


def test_a_factor_that_leaves_the_bounds_of_materials_is_refused() -> None:
    with pytest.raises(DesignError, match="initial shear modulus"):
        with_stiffness(load_material("ecoflex_00_30"), 0.01)


def test_a_long_source_is_cut() -> None:
    long = load_material("ninjaflex").model_copy(update={"source": 1000 * "x"})
    made = calibrated_material(long, 1.1, 1.0, 1.2, "x", "print.csv")
    assert len(made.source) == 1000 and made.source.startswith("ninjaflex with all moduli")
