"""The table of laws: what materials, fits and the command make of it."""

from __future__ import annotations

import pytest

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
