"""Strains that were reached against the range of the tests, breakage, and stability."""

from __future__ import annotations

import json

import numpy as np
import pytest
from fakes import FakeEvaluation

from bellows_design.analysis.material_range import strain_of
from bellows_design.materials.library import load_material
from bellows_design.materials.material import Material
from bellows_design.reports.evaluation import evaluation_table

SOFTENING = Material(
    model="yeoh",
    mu=(0.8,),
    alpha=(2.0,),
    higher=(-0.12, 0.002),
    valid_strain=(-0.1, 0.2),
    yield_strength=1.0,
)


def logs_of(*stretches: float) -> np.ndarray:
    """Uniaxial states at those stretches, ascending principal logs (k, 3)."""
    along = np.log(np.array(stretches))[:, None] * np.array([1.0, -0.5, -0.5])
    return np.sort(along, axis=1)


def test_extremes_are_those_of_all_points_and_within_says_whether_they_were_tested() -> None:
    material = load_material("ninjaflex_linear")  # -10 % to 10 %
    inside = strain_of(material, logs_of(1.0, 1.05, 1.08))
    assert inside.lowest == pytest.approx(1.08**-0.5 - 1) and inside.highest == pytest.approx(0.08)
    assert inside.within is True and inside.warnings == () and not inside.breaks
    stretched = strain_of(material, logs_of(1.05, 1.11))
    squeezed = strain_of(material, logs_of(1.05, 0.89))
    assert stretched.within is False and squeezed.within is False
    (sentence,) = stretched.warnings
    assert "strained from -5.08 % to +11 %" in sentence and "from -10 % to +10 %" in sentence


def test_a_material_without_a_range_is_neither_inside_nor_outside() -> None:
    found = strain_of(load_material("ninjaflex"), logs_of(4.0))
    assert found.within is None and found.warnings == ()
    assert json.loads(json.dumps(found.to_dict()))["within"] is None


def test_strain_beyond_the_elongation_at_break_is_told() -> None:
    found = strain_of(load_material("ninjaflex"), logs_of(7.7))
    assert found.breaks and any("elongation at break of +660 %" in each for each in found.warnings)


def test_materials_of_positive_constants_are_stable_wherever_a_result_may_go() -> None:
    logs = np.random.default_rng(2).uniform(-2, 2, (5000, 3))
    logs = np.sort(logs - logs.mean(axis=1, keepdims=True), axis=1)
    for name in ("ninjaflex", "natural_rubber_treloar", "sortaclear_40"):
        assert strain_of(load_material(name), logs).instability is None


def test_lost_stability_is_named_with_the_least_strain_that_loses_it() -> None:
    """Uniaxial Yeoh of these constants is stable up to stretch 1.529, as the mode check has it."""
    stretches = np.linspace(1.0, 1.9, 181)
    found = strain_of(SOFTENING, logs_of(*stretches))
    assert found.instability is not None and found.instability.inequality == "Drucker"
    assert found.instability.strains[2] == pytest.approx(0.53, abs=0.006)
    assert found.instability.share == pytest.approx(0.37 / 0.9, abs=0.01)
    assert any("unstable" in each and "+53 %" in each for each in found.warnings)
    assert found.to_dict()["stable"] is False
    assert strain_of(SOFTENING, logs_of(1.0, 1.2, 1.5)).instability is None


def test_stability_is_asked_of_every_state_and_not_of_three_tests_only() -> None:
    """Between uniaxial and biaxial tension, at a stretch where both of them are still stable."""
    logs = np.log([[1 / (1.3 * 1.24), 1.24, 1.3]])
    assert strain_of(SOFTENING, logs).instability is not None
    assert strain_of(SOFTENING, logs_of(1.3)).instability is None


def test_the_terminal_shows_strains_and_warnings() -> None:
    import io

    from rich.console import Console

    strain = strain_of(load_material("ninjaflex_linear"), logs_of(1.2))
    evaluation = FakeEvaluation(warnings=("beyond the tests.",), strain=strain)
    console = Console(width=120, record=True, file=io.StringIO())
    for line in evaluation_table(evaluation):
        console.print(line)
    text = console.export_text()
    assert "-8.71 … +20 % (material tested -10 … +10 %)" in text
    assert "warning: beyond the tests." in text
