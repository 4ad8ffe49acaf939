"""A material: the constants of a printed elastomer, and the range they are known to hold in.

A material is the Ogden model in Abaqus's form, of any number of terms, with Yeoh's higher ones,

    W = Σ 2 μᵢ/αᵢ² (λ̄₁^αᵢ + λ̄₂^αᵢ + λ̄₃^αᵢ − 3) + C₂₀ (Ī₁ − 3)² + C₃₀ (Ī₁ − 3)³,

with μᵢ and Cᵢ₀ in MPa. The literature writes μₚ/αₚ instead: μᵢ = μₚ αₚ / 2. The field's other
models are cases of it, and are written with their own constants:

    model = "neo-hooke"      c10                  μ = 2 c10, α = 2
    model = "mooney-rivlin"  c10, c01             μ = (2 c10, 2 c01), α = (2, −2)
    model = "yeoh"           c10, c20, c30        μ = 2 c10, α = 2, higher = (c20, c30)

Laws that are no case of it have ``constants`` of their own names instead; they may be of either
sign. All laws stand in ``laws.py``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import Field, field_validator, model_validator
from pydantic_core import PydanticKnownError

from bellows_design.materials.bounds import (
    POOR_FIT,
    POOR_MODULUS,
    POOR_R_SQUARED,
    SOFTEST,
    STIFFEST,
)
from bellows_design.materials.laws import LAWS, OWN_CONSTANTS, Law
from bellows_design.validation.parameters import Parameters, require
from bellows_design.validation.quoting import quoted
from bellows_design.validation.sentences import written_right
from solver.material.laws import law as solver_law

if TYPE_CHECKING:
    from solver.material.constants import Constants
    from solver.material.law import Hyperelastic

MOST_HIGHER = 4
"""Of Yeoh's higher terms; more would only fit the noise."""

_R_SQUARED = re.compile(
    r"\bR(?:²|\^?2)(?:\s*[=:]\s*|\s+)(?:of\s+)?([-\u2212]?\d{1,9}(?:\.\d{1,9})?)", re.ASCII
)
"""A coefficient of determination that a source states."""

Strain = Annotated[float, Field(gt=-1, le=20)]
Coefficient = Annotated[float, Field(ge=-STIFFEST, le=STIFFEST)]


class Material(Parameters):
    """Hyperelastic material; every Ogden term obeys Hill's inequality μₚαₚ > 0, that is μᵢ > 0.

    Terms of mixed sign can be stable over the range they were fitted in, but a design may leave
    that range anywhere on its load path; they are refused rather than trusted. Yeoh's higher terms
    and the constants of other laws may be negative as long as the three tests are stable over
    ``valid_strain``, or everywhere without one; results are checked against it.

    Attributes:
        name: What the material is called; one line of text.
        model: Name of its law, see ``laws.LAWS``.
        mu: μᵢ of Abaqus's form, MPa.
        alpha: Exponents αᵢ, one for each μᵢ.
        higher: C₂₀, C₃₀, … of Yeoh's model, MPa.
        constants: Those of a law that is no case of Ogden's, in the order of ``laws.LAWS``, MPa.
        yield_strength: Highest admissible von Mises stress unless the design limits it, MPa.
        elongation_at_break: Nominal strain at break in a tensile test, %.
        valid_strain: Lowest and highest principal nominal strain of the tests (fractions).
        fit_error: Root mean square of the relative errors of the fit the constants come from, %.
        fit_modulus_error: How far that fit's initial shear modulus is from what the beginning of
            the tests says, %.
        source: Where the constants are from.

    Raises:
        pydantic.ValidationError: A number leaves its bounds, or the material is unstable. A
            ``Design`` and ``load_material`` make sentences of it.

    Examples:
        >>> from bellows_design import Material
        >>> rubber = Material(model="yeoh", c10=0.2, c20=0.01, yield_strength=3.0)  # MPa
        >>> print(rubber.mu, rubber.alpha, rubber.higher)
        (0.4,) (2.0,) (0.01,)
    """

    name: str = Field(
        default="custom", min_length=1, max_length=64, description="at most 64 characters"
    )
    model: str = Field(default="ogden", description="name of the material's law")
    mu: tuple[float, ...] = Field(
        max_length=6,
        description="μᵢ of Abaqus's form",
        json_schema_extra={"unit": "MPa"},
    )
    alpha: tuple[float, ...] = Field(max_length=6, description="exponents αᵢ")
    higher: tuple[Coefficient, ...] = Field(
        default=(),
        max_length=MOST_HIGHER,
        description="C₂₀, C₃₀, … of Yeoh's model",
        json_schema_extra={"unit": "MPa"},
    )
    constants: tuple[Coefficient, ...] = Field(
        default=(),
        description="constants of a law that is no case of Ogden's",
        json_schema_extra={"unit": "MPa"},
    )
    yield_strength: float = Field(
        ge=0.01,
        le=200,
        description="highest von Mises stress unless the design limits it",
        json_schema_extra={"unit": "MPa"},
    )
    elongation_at_break: float | None = Field(
        default=None,
        ge=20,
        le=3000,
        description="nominal strain at break in a tensile test",
        json_schema_extra={"unit": "%"},
    )
    valid_strain: tuple[Strain, Strain] | None = Field(
        default=None, description="lowest and highest principal nominal strain of the tests"
    )
    fit_error: float | None = Field(
        default=None,
        ge=0,
        description="root mean square of the relative errors of the fit its constants come from",
        json_schema_extra={"unit": "%"},
    )
    fit_modulus_error: float | None = Field(
        default=None,
        ge=0,
        description="difference of its initial shear modulus from the beginning of the tests",
        json_schema_extra={"unit": "%"},
    )
    source: str = Field(default="", max_length=1000, description="where the numbers are from")

    @model_validator(mode="before")
    @classmethod
    def _as_ogden(cls, data: Any) -> Any:
        """With the constants of the model's own names turned into μ, α and higher ones."""
        return _translated(data) if isinstance(data, dict) else data

    @field_validator("model")
    @classmethod
    def _is_a_law(cls, model: str) -> str:
        if model not in LAWS:
            *others, last = (f"'{name}'" for name in LAWS)
            expected = f"{', '.join(others)} or {last}"
            raise PydanticKnownError("literal_error", {"expected": expected})
        return model

    @field_validator("mu", "alpha", "higher", "constants", "valid_strain", mode="before")
    @classmethod
    def _list_is_tuple(cls, value: Any) -> Any:
        return tuple(value) if isinstance(value, list) else value

    @field_validator("valid_strain")
    @classmethod
    def _range_holds_zero(cls, value: tuple[float, float] | None) -> tuple[float, float] | None:
        require(
            value is None or value[0] < 0 < value[1],
            f"material.valid_strain is {list(value or ())} but must run from a number below 0 to "
            "one above it (nominal strain, a fraction)",
        )
        return value

    @field_validator("name", "source")
    @classmethod
    def _is_printable(cls, text: str) -> str:
        require(text.isprintable(), f"{quoted(text)} must be printable text on one line")
        return text

    @model_validator(mode="after")
    def _is_stable(self) -> Self:
        for check in (_check_terms, _check_modulus, _check_exponents, _check_stability):
            check(self)
        return self

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on why results with this material deserve doubt; none for a good fit."""
        return tuple(text for text in (_poor_fit(self), _wrong_modulus(self)) if text)

    @property
    def initial_shear_modulus(self) -> float:
        """Shear modulus of the undeformed material, MPa: Σ μᵢ of Ogden's law."""
        return self.hyperelastic().shear_modulus if self.constants else sum(self.mu)

    def hyperelastic(self) -> Hyperelastic:
        """This material as the solver takes it.

        Raises:
            SolverError: The solver takes no such constants.
        """
        if self.constants:
            material: Hyperelastic = solver_law(self.model).implementation.MATERIAL(*self.constants)
            return material
        from solver import Ogden

        return Ogden(mu=self.mu, alpha=self.alpha, higher=self.higher)

    def law_constants(self) -> Constants:
        """Law and constants, for its homogeneous states and its stability."""
        return self.hyperelastic().constants


def _poor_fit(material: Material) -> str | None:
    """What the material says of its fit, in a field or, as files of old, in its source."""
    name, error = quoted(material.name), material.fit_error
    if error is not None and error > POOR_FIT:
        return (
            f"the material {name} is a poor fit: it is off by {error:.3g} % in the mean of its "
            f"tests (more than {POOR_FIT:g} %); its results are as uncertain."
        )
    stated = _R_SQUARED.search(material.source) if error is None else None
    if stated is not None and float(stated.group(1).replace("\u2212", "-")) < POOR_R_SQUARED:
        return (
            f"the material {name} is a poor fit: its source states R² {stated.group(1)} (less than "
            f"{POOR_R_SQUARED:g}); results with it are a guess."
        )
    return None


def _wrong_modulus(material: Material) -> str | None:
    error = material.fit_modulus_error
    if error is None or error <= POOR_MODULUS:
        return None
    return (
        f"the initial shear modulus of the material {quoted(material.name)} is {error:.2g} % off "
        f"what the beginning of its tests says (more than {POOR_MODULUS:g} %)."
    )


def _check_terms(material: Material) -> None:
    mu, alpha, own = material.mu, material.alpha, LAWS[material.model].constants
    require(
        len(material.constants) == len(own),
        f"material.constants has {len(material.constants)} numbers but the model "
        f"{quoted(material.model)} has {len(own)}{': ' * bool(own)}{', '.join(own)}",
    )
    require(
        bool(mu) != bool(own),
        f"material.mu has {len(mu)} numbers but the model {quoted(material.model)} "
        f"{'has none' if own else 'needs at least one'}",
    )
    require(
        len(mu) == len(alpha),
        f"material.mu has {len(mu)} and material.alpha {len(alpha)} numbers; each term needs one "
        "of both",
    )
    for index, (modulus, exponent) in enumerate(zip(mu, alpha, strict=True)):
        require(modulus > 0, _not_positive(material, index))
        require(
            abs(exponent) <= 50,
            f"material.alpha[{index}] is {exponent:g} but must lie between -50 and 50",
        )


def _names_of_mu(material: Material) -> tuple[str, ...]:
    """c10, c01, … as far as a law has such names for half of its μ; else none."""
    law = LAWS[material.model]
    return law.written[0][: len(law.exponents)] if law.written and law.exponents else ()


def _not_positive(material: Material, index: int) -> str:
    """The sentence on a term that breaks Hill's inequality, by the name that the law has for it."""
    names, modulus = _names_of_mu(material), material.mu[index]
    if not names:
        return (
            f"material.mu[{index}] is {modulus:g} MPa but must be greater than 0 (Hill's "
            "inequality); constants of the literature's form become μ = μₚ αₚ / 2"
        )
    others = f'; without {names[index]}, model = "neo-hooke" takes {names[0]} alone'
    return (
        f"material.{names[index]} is {modulus / 2:g} MPa but must be greater than 0 (Hill's "
        f"inequality){others if index else ''}"
    )


def _check_modulus(material: Material) -> None:
    shear = material.initial_shear_modulus
    names = _names_of_mu(material) or LAWS[material.model].constants or ("mu",)
    require(
        SOFTEST <= shear <= STIFFEST,
        f"material.{', '.join(names)}: the initial shear modulus is {shear:g} MPa but must lie "
        f"between {SOFTEST:g} and {STIFFEST:g} MPa; are the constants given in MPa?",
    )


def _names_of_softening(material: Material) -> str:
    """The constants that may be negative, by the names that the law has for them."""
    law, count = LAWS[material.model], len(material.higher)
    forms = [form for form in law.written if len(form) == len(law.exponents) + count]
    higher = forms[0][len(law.exponents) :] if forms and law.exponents else ("higher",)
    return ", ".join(higher if count else law.constants or ("constants",))


def _check_exponents(material: Material) -> None:
    fixed = LAWS[material.model].exponents
    require(
        fixed in ((), material.alpha),
        f"material.alpha is {list(material.alpha)} but the model {quoted(material.model)} has "
        f"{list(fixed)}",
    )


def _check_stability(material: Material) -> None:
    """Where constants may be negative. μ > 0 alone is stable at every strain."""
    if not (material.higher or material.constants):
        return
    from solver.material.stability import HIGHEST, LOWEST, stability

    low, high = material.valid_strain or (LOWEST - 1, HIGHEST - 1)
    found = stability(material.law_constants())
    worst = min(found.ranges, key=lambda each: each.highest / each.lowest)
    require(
        found.covers(max(1 + low, LOWEST), min(1 + high, HIGHEST)),
        f"material.{_names_of_softening(material)}: with "
        f"{list(material.higher or material.constants)} MPa, "
        f"{worst.mode} tests are stable only at stretches from {worst.lowest:.3g} to "
        f"{worst.highest:.3g}, less than valid_strain says (all stretches, without one)",
    )


def _translated(table: dict[str, Any]) -> dict[str, Any]:
    """The same material with the fields of ``Material`` instead of constants by their names."""
    given = [key for key in OWN_CONSTANTS if key in table]
    if not given:
        return table
    for key in ("mu", "alpha", "higher", "constants"):
        require(
            key not in table, f"material.{given[0]} and material.{key} say the same thing twice"
        )
    law, form = _law_and_form(str(table.get("model", "ogden")), given)
    rest = {key: value for key, value in table.items() if key not in given}
    values = [_constant(key, table[key]) for key in form]
    if law.constants:
        return rest | {"mu": (), "alpha": (), "constants": tuple(values)}
    count = len(law.exponents)
    mu, higher = tuple(2 * value for value in values[:count]), tuple(values[count:])
    return rest | {"mu": mu, "alpha": law.exponents, "higher": higher}


def _law_and_form(name: str, given: Sequence[str]) -> tuple[Law, tuple[str, ...]]:
    """The law called ``name``, and which of its sets of constants are given."""
    law = LAWS.get(name, Law(name))
    for form in law.written:
        if set(form) == set(given):
            return law, form
    forms = " or ".join(", ".join(form) for form in law.written or (("mu", "alpha"),))
    raise ValueError(
        f"material has {', '.join(given)} but the model {quoted(name)} is written with {forms}"
    )


def _constant(key: str, value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    require(
        number,
        f"material.{key} is {quoted(value)} but must be a number, in MPa"
        f"{written_right(value, 'MPa')}",
    )
    require(
        abs(value) <= STIFFEST,
        f"material.{key} is {quoted(value)} MPa but must lie between {-STIFFEST:g} and "
        f"{STIFFEST:g} MPa",
    )
    return float(value)
