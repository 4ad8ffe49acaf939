"""Designs: what is admitted, what is refused, and in which words."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.conditions import Load
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.overrides import with_overrides
from bellows_design.design.port import Port
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.materials.library import load_material
from bellows_design.materials.material import Material
from bellows_design.validation.parameters import Parameters

SHIPPED = shipped_designs()


def refusal(name_or_text: str) -> str:
    """The sentence with which a design written as TOML is refused."""
    with pytest.raises(DesignError) as caught:
        Design.from_toml(name_or_text)
    return str(caught.value)


def written(**changes: object) -> str:
    """Prototype 1 as TOML with fields of its bellows replaced by ``changes`` as they stand."""
    fields = {
        **load_design("prototype_1").bellows.model_dump(exclude_none=True),
        **changes,
    }
    lines = [f"{key} = {value}" for key, value in fields.items()]
    return "\n".join(['name = "changed"', "[bellows]", *lines])


@pytest.mark.parametrize("name", SHIPPED)
def test_a_shipped_design_survives_being_written_and_read(name: str) -> None:
    design = load_design(name)
    assert Design.from_toml(design.to_toml()) == design
    assert design.name == name


def test_a_material_of_ones_own_survives_being_written_and_read() -> None:
    table = load_design("prototype_1").model_dump()
    table["material"] |= {"name": "mine", "mu": [1.0], "alpha": [2.0]}
    design = Design.of(table)
    assert Design.from_toml(design.to_toml()) == design


def test_prototype_2_corrects_the_two_misprints_and_holds_nine_bubbles() -> None:
    bellows = load_design("prototype_2").bellows
    assert (bellows.chamber_length, bellows.bubble_distance) == (1.4, 1.2)
    assert bellows.bubble_count == 9
    assert bellows.inner_fillet == bellows.chamber_length / 2
    assert bellows.outer_fillet == pytest.approx(bellows.bubble_length / 2)


def test_the_default_stress_limit_is_the_yield_strength() -> None:
    design = load_design("prototype_1")
    assert design.max_von_mises == 4.0
    table = design.model_dump() | {"limits": {"max_von_mises": 3.0}}
    assert Design.of(table).max_von_mises == 3.0


def test_digest_ignores_key_order_number_spelling_and_labels() -> None:
    design = load_design("prototype_1")
    table = design.model_dump()
    reordered = {key: table[key] for key in reversed(table)}
    reordered["bellows"] = dict(reversed(table["bellows"].items()))
    reordered["bellows"]["bubble_width"] = 20  # a whole number instead of 20.0
    reordered |= {"name": "renamed", "description": "other words"}
    assert Design.of(reordered).digest == design.digest


@pytest.mark.parametrize("field", sorted(set(BellowsParameters.model_fields)))
def test_digest_changes_with_every_number_of_the_bellows(field: str) -> None:
    design = load_design("prototype_1")
    table = design.model_dump()
    old = table["bellows"][field]
    table["bellows"][field] = 6 if old is None else old * 0.99
    assert Design.of(table).digest != design.digest


def test_digest_is_the_same_in_every_process_and_version() -> None:
    """Caches and manifests outlive a process: a change of this value must be a decision."""
    assert load_design("prototype_1").digest.startswith("f02f6b6d90ce")


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("0.02", "0.02 m would be 20 mm"),
        ("20000", "20000 µm would be 20 mm"),
        ("-20", "at least 4 mm"),
        ("nan", "finite number"),
        ("inf", "finite number"),
        ("1e999", "finite number"),
        ('"20"', "must be a number, in mm"),
        ("true", "must be a number, in mm"),
        ("[20]", "must be a number, in mm"),
        ("1" * 400, "must be a number, in mm"),
    ],
)
def test_a_wrong_length_is_refused_in_one_sentence(value: str, words: str) -> None:
    sentence = refusal(written(bubble_width=value))
    assert sentence.startswith("bellows.bubble_width is ")
    assert words in sentence
    assert "\n" not in sentence and len(sentence) < 200


@pytest.mark.parametrize("field", ["bubble_width", "bubble_thickness", "chamber_length", "length"])
@pytest.mark.parametrize("factor", [1e-3, 1e3, 1e-6, 1e6])
def test_lengths_mistaken_by_a_factor_of_a_thousand_are_refused(field: str, factor: float) -> None:
    value = getattr(load_design("prototype_1").bellows, field)
    assert field in refusal(written(**{field: value * factor}))


@pytest.mark.parametrize(
    ("pressure", "words"),
    [
        ("1", "1 bar would be 0.1 MPa"),
        ("100", "100 kPa would be 0.1 MPa"),
        ("100000", "100000 Pa would be 0.1 MPa"),
        ("0.0001", "0.0001 GPa would be 0.1 MPa"),
        ("0", "at least 0.001 MPa"),
        ("-0.0005", "at most -0.001 MPa"),
        ("-0.2", "at least -0.101325 MPa"),
    ],
)
def test_a_pressure_in_another_unit_is_recognised(pressure: str, words: str) -> None:
    sentence = refusal(written() + f"\n[load]\npressure = {pressure}")
    assert sentence.startswith("load.pressure is ") and words in sentence


UNITS = {Load: "MPa", BellowsParameters: "mm", Indent: "mm", Port: "mm"}
"""Table -> the unit of all its numbers that are not counted."""


@pytest.mark.parametrize("table", UNITS, ids=lambda table: table.__name__)
def test_every_number_of_a_table_states_its_unit(table: type[Parameters]) -> None:
    for name, field in table.model_fields.items():
        if field.annotation is float:
            extra = field.json_schema_extra
            assert isinstance(extra, dict) and extra["unit"] == UNITS[table], name


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("port.wall=99", "port.wall is 99 mm but must be at most 10 mm."),
        ("port.wall=1e3", "port.wall is 1000 mm but must be at most 10 mm; 1000 µm would be 1 mm."),
        ("port.depth=true", "port.depth is true but must be a number, in mm."),
        ("indent.fillet=nan", "indent.fillet is nan but must be a finite number, in mm."),
    ],
)
def test_a_wrong_length_of_any_table_is_refused_in_mm(key: str, words: str) -> None:
    with pytest.raises(DesignError) as caught:
        with_overrides(load_design("prototype_2_indent"), [key])
    assert str(caught.value) == words


def test_an_unknown_key_names_its_likeness() -> None:
    assert "did you mean bellows.bubble_thickness" in refusal(written(bubble_tickness=1.2))


def test_a_missing_key_is_named_with_its_meaning() -> None:
    text = "\n".join(line for line in written().splitlines() if not line.startswith("offset"))
    assert refusal(text).startswith("bellows.offset is missing: length of the root")


def test_several_problems_are_one_line_each() -> None:
    lines = refusal(written(bubble_width=-1, tendon_width="nan")).splitlines()
    assert len(lines) == 2
    assert "bubble_width" in lines[0] and "tendon_width" in lines[1]


def test_walls_that_fill_the_bubble_are_refused() -> None:
    assert "bubble_thickness" in refusal(written(bubble_thickness=10))


def test_an_indent_through_the_wall_is_refused() -> None:
    sentence = refusal(written() + "\n[indent]\ndepth = 1.4\nwidth = 3")
    assert "indent.depth" in sentence and "mm" in sentence


@pytest.mark.parametrize(
    "name",
    ["../x", "a/b", "a\\b", ".", "..", "", "-x", "x" * 65, "x\n", "con", "COM1", "nul", "ä", "a b"],
)
def test_a_name_that_is_no_plain_file_name_is_refused(name: str) -> None:
    table = load_design("prototype_1").model_dump() | {"name": name}
    with pytest.raises(DesignError, match="name is "):
        Design.of(table)


def test_the_constructor_speaks_in_sentences_too() -> None:
    with pytest.raises(DesignError) as caught:
        Design(name="x")
    assert str(caught.value) == "bellows is missing."


def test_a_design_cannot_be_changed() -> None:
    with pytest.raises(ValidationError):
        load_design("prototype_1").name = "other"  # type: ignore[misc]


def test_ninjaflex_has_the_initial_shear_modulus_of_the_paper() -> None:
    assert load_material("ninjaflex").initial_shear_modulus == pytest.approx(3.47605)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mu": [-0.2, 3.3]}, "Hill"),
        ({"mu": [0.2]}, "each term needs one of both"),
        ({"mu": [198250.0, 3277800.0]}, "given in MPa"),
        ({"mu": [0.000198, 0.0003278]}, "given in MPa"),
        ({"alpha": [3.05, math.nan]}, "finite"),
        ({"alpha": [3.05, 1e6]}, "between -50 and 50"),
        ({"yield_strength": 4000.0}, "4000 kPa would be 4 MPa"),
        ({"elongation_at_break": 6.6}, "at least 20 %"),
        ({"model": "mooney"}, "'ogden'"),
    ],
)
def test_a_material_that_is_unstable_or_in_other_units_is_refused(
    change: dict[str, object], words: str
) -> None:
    table = load_design("prototype_1").model_dump()
    table["material"] |= change
    with pytest.raises(DesignError) as caught:
        Design.of(table)
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_the_hencky_limit_alpha_zero_is_a_material() -> None:
    assert Material(mu=(3.5,), alpha=(0.0,), yield_strength=4.0).initial_shear_modulus == 3.5


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("prototyp_1", "did you mean prototype_1"),
        ("../prototype_1", "there is no file"),
        ("missing.toml", "there is no file"),
        ("a\0b.toml", "a?b.toml"),
        ("x" * 5000 + ".toml", "cannot be read"),
        (".", "is a folder"),
        ("/dev/null", "is a device"),
    ],
)
def test_what_is_no_design_file_is_refused_in_one_sentence(given: str, words: str) -> None:
    with pytest.raises(DesignError) as caught:
        load_design(given)
    assert words in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\xff\xfe", "UTF-8"),
        (b"name = ", "not valid TOML"),
        (b"x = " + b"[" * 100_000, "nested too deeply"),
        (b"x = " + b"1" * 5000, "not valid TOML"),
        (b"#" * 2_000_000, "larger than 1 MB"),
        (b"", "bellows is missing"),
    ],
)
def test_a_broken_file_is_refused_in_sentences(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "broken.toml"
    path.write_bytes(content)
    with pytest.raises(DesignError, match=words):
        load_design(path)


SCALARS = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=20)
    | st.dates()
    | st.sampled_from([0.1, 20, 1.5, "ninjaflex", "outside"])
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)


@given(data=st.data())
@pytest.mark.thorough
def test_any_table_is_a_design_or_refused_in_sentences(data: st.DataObject) -> None:
    table = load_design("prototype_2_indent").model_dump()
    for _ in range(data.draw(st.integers(1, 3))):
        target = data.draw(st.sampled_from([table, *filter(_is_table, table.values())]))
        key = data.draw(st.sampled_from([*target, "name"]) | st.text(max_size=8))
        target[key] = data.draw(VALUES)
    try:
        design = Design.of(table)
    except DesignError as error:
        assert error.sentences
        assert all(0 < len(line) < 600 for line in str(error).splitlines())
    else:
        assert Design.from_toml(design.to_toml()) == design


@given(text=st.text(max_size=200))
def test_any_text_is_a_design_or_refused_in_sentences(text: str) -> None:
    with pytest.raises(DesignError):
        Design.from_toml(text)


def test_written_toml_is_valid_toml() -> None:
    tomllib.loads(load_design("prototype_2_indent").to_toml())


def _is_table(value: object) -> bool:
    return isinstance(value, dict)
