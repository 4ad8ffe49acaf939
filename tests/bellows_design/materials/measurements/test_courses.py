"""The course of a test: branches, break, preload, slack, specimens, and points in no order."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tensile import NINJAFLEX, SHEAR, curve, table

from bellows_design.errors import DesignError
from bellows_design.materials import load_material, material_names
from bellows_design.materials.measurements.loading import parse_measurements
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import fit
from solver.arrays import Reals
from solver.material.homogeneous import MODES, nominal_stress

HEADER = "strain [-],stress [MPa]"
STRAIN, STRESS = curve()


def read(*columns: Reals, header: str = HEADER, **options: Any) -> Measurements:
    return parse_measurements(table(header, *columns), "it", "it", ReadingOptions(**options))


def said(data: Measurements, words: str) -> bool:
    return any(words in note for note in data.reading.notes)


def shear(data: Measurements) -> float:
    return fit(data).fit.stability.shear_modulus


def cycles(peaks: tuple[float, ...], rest: float = 0.0) -> tuple[Reals, Reals]:
    """Loadings to each peak and back, softer where the material was before (Mullins)."""
    strains: list[Reals] = []
    stresses: list[Reals] = []
    reached = 0.0
    for peak in peaks:
        for ends in ((0.01 + rest * (reached > 0), peak), (peak, 0.01 + rest)):
            line = np.linspace(*ends, 30)[ends[0] == peak :]
            virgin = nominal_stress(MODES["uniaxial"], 1 + line, NINJAFLEX)
            soft = 0.7 * (line - rest).clip(0) / line
            strains.append(line)
            before = (line < reached) if ends[0] < peak else np.full(line.size, True)
            stresses.append(np.where(before, soft, 1) * virgin)
        reached = max(reached, peak)
    return np.concatenate(strains), np.concatenate(stresses)


@pytest.mark.parametrize("peaks", [(1.0, 1.0, 1.0), (0.5, 1.0, 2.0), (2.0, 1.0), (1.0,)])
def test_of_a_cyclic_test_the_first_loading_is_used_and_it_is_said(peaks: tuple[float]) -> None:
    data = read(*cycles(peaks, rest=0.05))
    virgin = nominal_stress(MODES["uniaxial"], data.stretch, NINJAFLEX)
    assert data.stress == pytest.approx(virgin, rel=1e-5)
    assert data.stretch.max() == pytest.approx(1 + max(peaks))
    assert said(data, f"{len(peaks)} times up: loading for the first time is used")
    assert said(data, "--branch last uses the last")


def test_the_last_loading_or_all_points_are_used_if_asked_for() -> None:
    strain, stress = cycles((1.0, 1.0, 1.0))
    last = read(strain, stress, branch="last")
    assert said(last, "loading for the last time is used")
    assert last.stress.max() == pytest.approx(stress[-30], rel=0.02)
    assert last.stress[5] < 0.8 * np.interp(last.stretch[5], 1 + STRAIN, STRESS)
    assert read(strain, stress, branch="all", keep=("zero",)).stretch.size == strain.size


def test_noise_in_the_strain_is_no_turn() -> None:
    strain = STRAIN + 0.005 * np.random.default_rng(0).standard_normal(60)
    data = read(strain.clip(0.001), STRESS, keep=("zero",))
    assert data.stretch.size == 60 and not said(data, "to and fro")


@pytest.mark.parametrize(
    ("strain", "stress", "left_out"),
    [
        ([2.01, 2.02, 2.03], [0.5, 0.02, 0.0], 3),
        ([2.01], [0.5], 1),
        ([1.9, 1.5, 1.2], [0.1, 0.02, 0.0], 3),
        ([2.0, 2.01, 2.02, 2.1], [3.0, -0.6, 0.1, -0.3], 4),
        (np.linspace(2.01, 2.3, 30), 4.79 * np.linspace(0.9, 0.02, 30), 30),
    ],
)
def test_points_after_break_are_left_out_and_it_is_said(
    strain: list[float], stress: list[float], left_out: int
) -> None:
    data = read(np.append(STRAIN, strain), np.append(STRESS, stress))
    assert data.stretch.size == 60 and data.stretch.max() == pytest.approx(3)
    assert said(data, "taken for the break") or said(data, f"{left_out} other points")
    assert shear(data) == pytest.approx(SHEAR, rel=0.03)


def test_points_after_break_are_kept_if_asked_for() -> None:
    strain, stress = np.append(STRAIN, 2.01), np.append(STRESS, 0.5)
    assert read(strain, stress, keep=("break",)).stretch.size == 61


def test_a_curve_that_sags_is_not_broken() -> None:
    line = np.linspace(0.05, 2, 40)
    data = read(line, 3 * np.log1p(line) / (1 + line) ** 0.6)
    assert data.stretch.size == 40 and not said(data, "break")


@pytest.mark.parametrize("slack", [0.03, 0.05, 0.1, 0.2])
def test_slack_is_noticed_and_strain_counted_from_its_end(slack: float) -> None:
    line = np.linspace(0, 2, 120)
    stress = nominal_stress(MODES["uniaxial"], 1 + line, NINJAFLEX)
    noisy = stress * (1 + 0.01 * np.random.default_rng(3).standard_normal(120))
    strain = np.append(np.linspace(0, slack, 10, endpoint=False), (1 + line) * (1 + slack) - 1)
    data = read(strain, np.append(0.002 * np.arange(10), noisy.clip(0.02)))
    assert said(data, "the curve begins flat, as with slack or a toe: strain is counted from")
    assert shear(data) == pytest.approx(SHEAR, rel=0.05)
    kept = read(strain, np.append(np.zeros(10), noisy), keep=("zero",))
    assert kept.stretch.max() == pytest.approx(1 + strain[-1])


@pytest.mark.parametrize("preload", [0.01, 0.03, 0.05])
def test_a_preload_is_noticed_and_the_curve_continued_to_zero(preload: float) -> None:
    line = np.linspace(preload, 2, 120)
    stress = nominal_stress(MODES["uniaxial"], 1 + line, NINJAFLEX)
    noisy = stress * (1 + 0.01 * np.random.default_rng(3).standard_normal(120))
    data = read((1 + line) / (1 + preload) - 1, noisy)
    assert said(data, "taken for a preload") and said(data, "--keep zero takes it as it is")
    assert shear(data) == pytest.approx(SHEAR, rel=0.05)


@pytest.mark.parametrize("offset", [-0.05, 0.05, 0.1])
def test_stress_measured_at_zero_strain_is_a_preload_however_small(offset: float) -> None:
    data = read(np.append(0, STRAIN), np.append(0, STRESS) + offset)
    assert said(data, "the stress at zero strain is") and shear(data) == pytest.approx(SHEAR, 0.05)


def test_waiting_at_zero_changes_nothing() -> None:
    random = np.random.default_rng(5)
    for noise in (0.0, 1e-5, 1e-4):
        strain = np.append(noise * random.standard_normal(50), STRAIN)
        stress = np.append(0.01 * random.standard_normal(50), STRESS)
        assert shear(read(strain, stress)) == pytest.approx(SHEAR, rel=0.05)


def test_points_at_which_the_strain_is_held_are_left_out() -> None:
    relaxing = STRESS[29] * (1 - 0.1 * np.linspace(0, 1, 40))
    strain = np.concatenate([STRAIN[:30], np.full(40, STRAIN[29]), STRAIN[30:]])
    stress = np.concatenate([STRESS[:30], relaxing, STRESS[30:]])
    data = read(strain, stress)
    assert data.stretch.size == 60 and said(data, "40 points are left out, of each hold the first")
    assert read(strain, stress, keep=("break",)).stretch.size == 100


def test_a_seating_cycle_before_the_test_is_no_part_of_it() -> None:
    up, down = np.linspace(0.001, 0.06, 15), np.linspace(0.058, 0.002, 14)
    first = np.interp(np.append(up, down), np.append(0, STRAIN), np.append(0, STRESS))
    strain = np.concatenate([up, down, STRAIN])
    data = read(strain, np.concatenate([first * np.repeat([1, 0.8], [15, 14]), STRESS]))
    assert said(data, "2 times up") and shear(data) == pytest.approx(SHEAR, rel=0.03)


def test_one_point_that_jumps_up_is_no_peak_before_a_break() -> None:
    data = read(STRAIN, np.where(np.arange(60) == 30, 3, 1) * STRESS)
    assert data.stretch.size == 60 and not said(data, "break")


@pytest.mark.parametrize("name", [each for each in material_names() if "linear" not in each])
def test_tests_of_every_material_of_the_library_are_read_without_a_question(name: str) -> None:
    """Up to 300 %, where silicones stiffen; no hint but of how soft or stiff they are."""
    law = load_material(name).law_constants()
    for reach in (0.3, 1.0, 3.0):
        strain, stress = curve(reach, law=law)
        data = read(strain, stress)
        assert data.stretch == pytest.approx(1 + strain, rel=1e-5)


def test_tension_that_counts_as_negative_is_asked_about() -> None:
    part = STRAIN < 0.9
    with pytest.raises(DesignError, match="tension with the signs turned"):
        read(-STRAIN[part], -STRESS[part])
    with pytest.raises(DesignError):
        read(-STRAIN, -STRESS, header="strain,stress_mpa")


def test_a_preload_beyond_belief_is_asked_about() -> None:
    line = np.linspace(0.2, 2, 120)
    stress = nominal_stress(MODES["uniaxial"], 1 + line, NINJAFLEX)
    with pytest.raises(DesignError, match="too far from zero for preload or slack"):
        read((1 + line) / 1.2 - 1, stress)


@pytest.mark.parametrize("seed", range(8))
def test_sound_tests_are_neither_shifted_nor_cut(seed: int) -> None:
    for reach in (0.3, 1.0, 3.0):
        for start in (0.0, 0.02):
            strain, stress = curve(reach, seed=seed, start=start)
            data = read(strain, stress)
            assert data.stretch == pytest.approx(1 + strain, rel=1e-5) and not data.reading.hints


SPECIMENS = [curve(1.8 + 0.1 * k, seed=k) for k in range(3)]
STACKED = tuple(np.concatenate(each) for each in zip(*SPECIMENS, strict=True))


def of_three(data: Measurements) -> None:
    """Their mean, over the strains all of them reach, with the spread."""
    assert data.stretch.max() <= 2.8 + 1e-9 and data.spread is not None
    truth = nominal_stress(MODES["uniaxial"], data.stretch, NINJAFLEX)
    assert np.abs(data.stress / truth - 1).max() < 0.02
    assert 0.003 < np.median(data.spread / data.stress) < 0.015
    assert said(data, "3 specimens in uniaxial tests: their mean is fitted")


def test_specimens_beside_each_other_are_known_by_their_names() -> None:
    columns = [each for specimen in SPECIMENS for each in specimen]
    of_three(read(*columns, header=",".join([HEADER] * 3)))
    numbered = ",".join(f"Strain {k} [-],Stress {k} [MPa]" for k in (1, 2, 3))
    of_three(read(*columns, header=numbered))


def test_specimens_of_other_lengths_beside_each_other_end_early() -> None:
    rows = [f"{x:.6f},{y:.6f}" for x, y in zip(*SPECIMENS[0], strict=True)]
    short = [f",{x:.6f},{y:.6f}" for x, y in zip(*curve(1.0, 40, seed=4), strict=True)] + [","] * 20
    text = f"{HEADER},{HEADER}\n" + "\n".join(map("".join, zip(rows, short, strict=True)))
    data = parse_measurements(text, "it")
    assert said(data, "2 specimens") and data.stretch.max() <= 2.0 + 1e-6


def test_specimens_in_a_column_or_below_each_other_with_times_are_told_apart() -> None:
    text = table(f"Specimen,{HEADER}", ["A"] * 60 + ["B"] * 60 + ["C"] * 60, *STACKED)
    of_three(parse_measurements(text, "it"))
    of_three(read(np.tile(np.arange(60.0), 3), *STACKED, header=f"time [s],{HEADER}"))


def test_tables_below_each_other_with_names_of_their_own_are_specimens() -> None:
    blocks = [
        f"Specimen {k + 1}\n" + table("Strain,Stress\n(%),(MPa)", 100 * strain, stress)
        for k, (strain, stress) in enumerate(SPECIMENS)
    ]
    of_three(parse_measurements("\n".join(blocks), "it"))


def test_areas_that_differ_from_specimen_to_specimen_are_asked_about() -> None:
    blocks = [
        f"Area: {area} mm²\n" + table("Strain [-],Force [N]", strain, stress * area)
        for area, (strain, stress) in zip((7.5, 7.5, 9.0), SPECIMENS, strict=True)
    ]
    data = parse_measurements("\n".join(blocks[:2]), "it")
    assert said(data, "over the initial area of 7.5 mm²") and said(data, "2 specimens")
    with pytest.raises(DesignError, match="--area MM2"):
        parse_measurements("\n".join(blocks), "it")


def test_returns_without_a_way_back_are_asked_about() -> None:
    with pytest.raises(DesignError, match="--branch specimens, --branch first or --branch last"):
        read(*STACKED)
    of_three(read(*STACKED, branch="specimens"))
    assert read(*STACKED, branch="first").stretch.size >= 60
    assert read(*STACKED, branch="all").stretch.size == 180


def test_times_that_run_on_are_cycles_without_the_way_back() -> None:
    data = read(np.arange(180.0), *STACKED, header=f"time [s],{HEADER}")
    assert data.spread is None and said(data, "loading for the first time")


def test_points_in_no_order_and_in_falling_order_are_all_used() -> None:
    order = np.random.default_rng(0).permutation(60)
    shuffled = read(STRAIN[order], STRESS[order])
    assert shuffled.stretch.size == 60 and said(shuffled, "in no order of strain; all are used")
    falling = read(STRAIN[::-1], STRESS[::-1])
    assert falling.stretch.size == 60 and not said(falling, "order")


def test_compression_and_tension_in_one_table_are_kept_apart() -> None:
    strain = -np.linspace(0.01, 0.5, 40)
    stress = nominal_stress(MODES["uniaxial"], 1 + strain, NINJAFLEX)
    data = read(np.append(strain, STRAIN), np.append(stress, STRESS))
    assert data.stretch.size == 100 and shear(data) == pytest.approx(SHEAR, rel=0.03)
