"""The table of laws: what materials, fits and the command make of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from bellows_design.design import load_design
from bellows_design.errors import DesignError
from bellows_design.materials.laws import FIT_CHOICES, FIT_MODELS, LAWS, Law, law_of_fit
from bellows_design.materials.library import checked_material


@pytest.mark.parametrize("law", LAWS.values(), ids=lambda law: law.name)
def test_a_material_may_be_written_with_every_set_of_constants_of_its_law(law: Law) -> None:
    for form in law.written:
        values = dict(zip(form, (0.4, 0.1, 0.01, 0.0, 0.0), strict=False))
        material = checked_material({"model": law.name, "yield_strength": 1.0, **values})
        if law.constants:
            assert material.constants == tuple(values.values()) and material.mu == ()
            continue
        count = len(law.exponents)
        assert material.alpha == law.exponents
        assert material.mu == tuple(2 * values[key] for key in form[:count])
        assert material.higher == tuple(values[key] for key in form[count:])


def test_a_law_that_is_not_in_the_table_is_refused_with_those_that_are() -> None:
    with pytest.raises(DesignError) as caught:
        checked_material({"model": "gent", "mu": [1.0], "alpha": [2.0], "yield_strength": 1.0})
    assert all(f"'{name}'" in str(caught.value) for name in LAWS)


def test_the_size_of_a_model_is_that_of_its_fitted_constants() -> None:
    sizes = {name: model.constants for name, model in FIT_MODELS.items()}
    others = {name: len(law.constants) for name, law in LAWS.items() if law.constants}
    assert sizes == others | {
        "neo-hooke": 1,
        "ogden1": 2,
        "mooney-rivlin": 2,
        "ogden2": 4,
        "ogden3": 6,
        "yeoh": 3,
    }


def test_a_fit_is_written_as_a_material_of_its_law() -> None:
    others = {name: name for name, law in LAWS.items() if law.constants}
    assert {name: law_of_fit(name).name for name in FIT_MODELS} == others | {
        **dict.fromkeys(("neo-hooke", "ogden1", "mooney-rivlin", "ogden2", "ogden3"), "ogden"),
        "yeoh": "yeoh",
    }


def test_the_help_of_fit_names_every_model(bellows) -> None:  # type: ignore[no-untyped-def]
    _, out, _ = bellows("fit", "--help")
    assert all(name in out for name in FIT_CHOICES)


@pytest.mark.parametrize(
    ("constants", "words"),
    [
        ({"model": "mooney-rivlin", "c10": 3.5, "c01": -0.5}, "material.c01 is -0.5 MPa"),
        ({"model": "mooney-rivlin", "c10": -3.5, "c01": 0.5}, "material.c10 is -3.5 MPa"),
        ({"model": "mooney-rivlin", "c10": 3.5, "c01": 0}, "material.c01 is 0 MPa"),
        ({"model": "neo-hooke", "c10": -1}, "material.c10 is -1 MPa"),
        ({"model": "yeoh", "c10": -1, "c20": 0.1}, "material.c10 is -1 MPa"),
        ({"model": "yeoh", "c10": 1, "c20": -9}, "material.c20: with [-9.0] MPa"),
        ({"model": "neo-hooke", "c10": 200}, "material.c10: the initial shear modulus is 400 MPa"),
        ({"model": "neo-hooke", "c10": True}, "material.c10 is true but must be a number"),
        ({"model": "neo-hooke", "c10": "1,5"}, "write 1.5, not 1,5"),
        ({"model": "ogden", "mu": [1, -2], "alpha": [2, 3]}, "material.mu[1] is -2 MPa"),
    ],
)
def test_a_constant_that_is_refused_is_called_by_its_own_name(
    constants: dict[str, object], words: str
) -> None:
    with pytest.raises(DesignError) as caught:
        checked_material({"yield_strength": 4.0, **constants})
    (told,) = caught.value.sentences
    assert words in told and ("mu[" in told) == ("mu" in constants)


def test_the_design_with_a_negative_c01_names_it_and_what_is_allowed() -> None:
    path = Path(__file__).parents[1] / "data/mooney_rivlin_negative_c01.toml"
    with pytest.raises(
        DesignError, match=r"material\.c01 is -0\.5 MPa .* greater than 0"
    ) as caught:
        load_design(path)
    assert "without c01" in str(caught.value)
