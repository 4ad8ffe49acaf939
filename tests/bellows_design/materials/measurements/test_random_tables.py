"""Tables drawn at random: materials, ranges, units, separators, names. None is read wrongly."""

from __future__ import annotations

import random

import numpy as np
import pytest
from tensile import curve, table

from bellows_design.errors import DesignError
from bellows_design.materials import load_material, material_names
from bellows_design.materials.measurements.loading import parse_measurements

MATERIALS = [name for name in material_names() if name != "ninjaflex_linear"]
REACHES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1, 1.5, 2, 3, 4, 6)
UNITS = {"MPa": 1, "kPa": 1e3, "psi": 145.03774, "N/mm²": 1, "kgf/cm²": 10.197162}
FORMS = ((",", "."), (";", ","), ("\t", "."), ("\t", ","), (";", "."), ("  ", "."))
STRAINS = (
    *("strain [-]", "Strain (mm/mm)", "strain [%]", "Strain (%)", "strain_percent"),
    *("strain", "Strain in per cent, without a word", "stretch", "True strain [-]"),
)


def drawn(chance: random.Random) -> tuple[str, float, float]:
    """A table, and the largest stretch and stress (MPa) in it."""
    reach, unit = chance.choice(REACHES), chance.choice(list(UNITS))
    law = load_material(chance.choice(MATERIALS)).law_constants()
    points, start = chance.choice((8, 12, 20, 40, 100, 300)), chance.choice((0, 0.005, 0.02, 0.05))
    noise = chance.choice((0, 0.003, 0.01, 0.02))
    strain, stress = curve(reach, points, law, chance.randrange(10**6), start, noise)
    named = chance.choice(STRAINS)
    silent = "without a word" in named
    given = {"stretch": 1 + strain, "True strain [-]": np.log1p(strain)}.get(
        named, 100 * strain if "%" in named or "percent" in named or silent else strain
    )
    separator, decimal = chance.choice(FORMS)
    timed = chance.random() < 0.5
    names = [*["Time (s)"] * timed, "Strain" if silent else named, f"stress [{unit}]"]
    columns = [*[np.arange(points) * 0.1] * timed, given, stress * UNITS[unit]]
    preamble = "Sample: x\nWidth: 6 mm\n\n" if chance.random() < 0.3 else ""
    ending = chance.choice(("", separator.strip()))
    header = preamble + separator.join(names)
    text = table(header, *columns, separator=separator, decimal=decimal, ending=ending)
    end = "\r\n" if chance.random() < 0.3 else "\n"
    return text.replace("\n", end), 1 + reach, float(np.abs(stress).max())


def questions(tables: int, seed: int) -> int:
    """How many tables are asked about; all others are read right."""
    chance, asked = random.Random(seed), 0
    for _ in range(tables):
        text, stretch, stress = drawn(chance)
        try:
            data = parse_measurements(text, "it")
        except DesignError:
            asked += 1
            continue
        assert data.stretch.max() == pytest.approx(stretch, rel=0.03), text[:300]
        assert np.abs(data.stress).max() == pytest.approx(stress, rel=0.02), text[:300]
    return asked


def test_tables_drawn_at_random_are_read_right_or_asked_about() -> None:
    assert questions(200, seed=1) <= 30


@pytest.mark.slow
def test_many_tables_drawn_at_random_are_read_right_or_asked_about() -> None:
    assert questions(4000, seed=2) <= 400
