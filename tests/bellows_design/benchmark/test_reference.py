"""Converged values are found by a design's digest, and judge only what is clearly coarser."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from bellows_design import load_design, with_overrides
from bellows_design.benchmark.reference import FINER, STORED, reference_of


def level(elements: int, angle: float, stress: float) -> dict[str, Any]:
    """One mesh as the benchmark writes it."""
    return {
        "elements": elements,
        "nodes": 2 * elements,
        "unknowns": 6 * elements,
        "pressure_mpa": 0.1,
        "bending_angle_deg": angle,
        "max_von_mises_mpa": stress,
        "cavity_volume_mm3": 1.0,
        "position_mm": [0.0, 0.0, 0.0],
    }


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    """Made-up values of two designs."""
    content = {
        "designs": {
            name: {
                "cell": [level(100, 1.0, 1.0), level(900, angle, 5.0)],
                "half": [level(200, 1.0, 1.0)],
                "digest": load_design(name).digest,
            }
            for name, angle in (("prototype_1", 220.0), ("prototype_2", 440.0))
        },
        "finest half": [level(300, 1.0, 1.0), level(6000, 221.0, 5.5)],
        "made_with": {"cores": 2},
    }
    path = tmp_path / "reference.json"
    path.write_text(json.dumps(content), "utf-8")
    return path


def test_the_finest_unit_cell_is_the_reference(stored: Path) -> None:
    found = reference_of(load_design("prototype_2"), stored)
    assert found is not None and found.finest_half is None
    assert (found.bending_angle_deg, found.max_von_mises_mpa) == (440.0, 5.0)
    assert (found.model, found.elements) == ("unit-cell", 900)
    assert "finest of 2 meshes, 900 tetrahedra" in found.recipe


def test_prototype_1_also_has_the_finest_half(stored: Path) -> None:
    found = reference_of(load_design("prototype_1"), stored)
    assert found is not None and found.finest_half is not None
    assert found.bending_angle_deg == 220.0
    assert found.finest_half.bending_angle_deg == 221.0
    assert found.finest_half.max_von_mises_mpa == 5.5
    assert (found.finest_half.model, found.finest_half.elements) == ("half", 6000)


def test_a_design_is_known_by_what_is_built_not_by_its_name(stored: Path) -> None:
    design = load_design("prototype_2")
    renamed = with_overrides(design, ["name=other"])
    assert reference_of(renamed, stored) == reference_of(design, stored)
    assert reference_of(with_overrides(design, ["bubble_width=18"]), stored) is None
    assert reference_of(with_overrides(design, ["load.pressure=0.09"]), stored) is None


def test_without_a_file_there_is_no_reference(tmp_path: Path) -> None:
    assert reference_of(load_design("prototype_1"), tmp_path / "none.json") is None


def test_a_mesh_as_fine_as_the_reference_is_not_judged_by_it(stored: Path) -> None:
    found = reference_of(load_design("prototype_2"), stored)
    assert found is not None
    assert found.judges("unit-cell", int(900 / FINER))
    assert not found.judges("unit-cell", int(900 / FINER) + 1)
    assert found.judges("half", 100_000)


@pytest.mark.skipif(not STORED.is_file(), reason="the reference values are not computed yet")
def test_the_shipped_values_cover_prototype_1() -> None:
    found = reference_of(load_design("prototype_1"))
    assert found is not None and found.finest_half is not None
    for other in (found, found.finest_half):
        assert other.bending_angle_deg == pytest.approx(found.bending_angle_deg, rel=0.01)
        assert other.max_von_mises_mpa == pytest.approx(found.max_von_mises_mpa, rel=0.1)
