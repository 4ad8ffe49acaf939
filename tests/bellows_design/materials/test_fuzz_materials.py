"""Whatever is in a material or a table of measurements, it is taken, or refused in sentences."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest
from damage import BAD_VALUES, FUZZ, mutated, saved
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused_in_sentences

from bellows_design.design.design import Design
from bellows_design.materials.fitting.fit_result import Choice
from bellows_design.materials.measurements.loading import load_measurements, parse_measurements
from bellows_design.materials.selection import fit

DESIGNS = Path(__file__).parents[3] / "bellows_design/design/designs"
MATERIALS = Path(__file__).parents[3] / "bellows_design/materials"
BASE = (DESIGNS / "prototype_2_indent.toml").read_bytes()
CSV = b"mode,stretch,stress_mpa\n" + b"".join(
    b"uniaxial,%g,%g\n" % (1 + 0.1 * i, 0.2 * i) for i in range(1, 9)
)


@pytest.mark.parametrize("key", ["mu", "alpha", "yield_strength", "name", "source", "model", "new"])
def test_a_material_of_bad_values_is_refused_in_sentences(key: str) -> None:
    table = BASE.decode().replace('material = "ninjaflex"\n', "")
    fields = {"name": '"m"', "mu": "[1.0]", "alpha": "[2.0]", "yield_strength": "4"}
    for value in [*BAD_VALUES, "[1e999]", "[nan]", "[1.0, 2.0]", "[1e308, 1e308]", "[0]", "['1']"]:
        lines = [f"{name} = {text}" for name, text in (fields | {key: value}).items()]
        text = table + "\n[material]\n" + "\n".join(lines)
        refused_in_sentences(lambda text=text: Design.from_toml(text))  # type: ignore[misc]


def test_a_damaged_table_of_measurements_is_read_or_refused(tmp_path: Path) -> None:
    chance = random.Random("measurements")
    for _ in range(300):
        path = saved(tmp_path, mutated(CSV, chance), "fuzzed.csv")
        refused_in_sentences(lambda path=path: load_measurements(path))  # type: ignore[misc]


def test_a_damaged_material_is_taken_or_refused_in_sentences() -> None:
    """Material files of the library as a table of a design, damaged."""
    table = BASE.decode().replace('material = "ninjaflex"\n', "").encode() + b"\n[material]\n"
    chance = random.Random("materials")
    paths = sorted(MATERIALS.glob("*.toml")) * 12
    assert paths
    for path in paths:
        content = table + mutated(path.read_bytes(), chance)
        refused_in_sentences(lambda text=content: Design.from_toml(text.decode("utf-8", "replace")))  # type: ignore[misc]


def tables() -> st.SearchStrategy[str]:
    """Tables that are nearly measurements: some can be fitted."""
    stretches = st.floats(0.04, 21) | st.sampled_from([1.0, 1.1, 1.2, 2.0, 5e-324, 1 + 1e-15])
    stresses = st.floats(-3, 1001) | st.sampled_from([0.0, -0.0, 1e-300, 0.1, 0.5, 1.0])
    modes = st.sampled_from(["uniaxial", "biaxial", "planar"])
    rows = st.lists(st.tuples(modes, stretches, stresses), min_size=4, max_size=12)
    return rows.map(
        lambda each: (
            "mode,stretch,stress_mpa\n"
            + "".join(f"{mode},{x:.17f},{y:.17f}\n" for mode, x, y in each)
        )
    )


@settings(FUZZ, max_examples=30)
@given(text=tables())
def test_any_table_is_fitted_or_refused_in_sentences(text: str) -> None:
    found: list[Choice] = []
    if not refused_in_sentences(
        lambda: found.append(fit(parse_measurements(text, "it"), "ogden1"))
    ):
        constants = (*found[0].fit.mu, *found[0].fit.alpha)
        assert all(math.isfinite(constant) for constant in constants)


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("h" * 5_000_000, id="a long column"),
        pytest.param("," * 1_000_000, id="many columns"),
        pytest.param("stretch,stress_mpa\n" + "1.1,0.1\n" * 100_001, id="many rows"),
        pytest.param("stretch,stress_mpa\n" + "1" * 1_000_000 + ",1\n", id="a long number"),
        pytest.param("stretch,stress_mpa\n" + "1e999,1\n" * 9, id="infinite"),
        pytest.param("stretch,stress_mpa\n" + "nan,nan\n" * 9, id="no numbers"),
        pytest.param("\n" * 1_000_000, id="empty lines"),
        pytest.param("stretch,stretch,stress_mpa\n", id="a column twice"),
    ],
)
def test_a_table_made_to_harm_is_refused_soon(text: str) -> None:
    assert refused_in_sentences(lambda: parse_measurements(text, "it"))


@FUZZ
@given(st.text(max_size=300))
def test_any_text_is_refused_as_measurements(text: str) -> None:
    assert refused_in_sentences(lambda: parse_measurements(text, "it"))
