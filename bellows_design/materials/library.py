"""Materials: the constants of a printed elastomer, and a library of them as data files.

A material is the Ogden model in Abaqus's form, of any number of terms, with Yeoh's higher ones,

    W = Σ 2 μᵢ/αᵢ² (λ̄₁^αᵢ + λ̄₂^αᵢ + λ̄₃^αᵢ − 3) + C₂₀ (Ī₁ − 3)² + C₃₀ (Ī₁ − 3)³,

with μᵢ and Cᵢ₀ in MPa. The literature writes μₚ/αₚ instead: μᵢ = μₚ αₚ / 2. The field's other
models are cases of it, and are written with their own constants:

    model = "neo-hooke"      c10                  μ = 2 c10, α = 2
    model = "mooney-rivlin"  c10, c01             μ = (2 c10, 2 c01), α = (2, −2)
    model = "yeoh"           c10, c20, c30        μ = 2 c10, α = 2, higher = (c20, c30)
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from contextlib import suppress
from importlib.metadata import entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, field_validator, model_validator

from bellows_design.design.bellows_parameters import Parameters
from bellows_design.errors import DesignError, did_you_mean, quoted, sentences

ENTRY_POINTS = "bellows_design.materials"
"""Entry-point group: each entry names an importable package that holds ``NAME.toml`` files."""

SOFTEST, STIFFEST = 0.003, 300.0
"""MPa. Initial shear moduli from the softest silicones to the hardest TPU; more is a unit."""


MOST_HIGHER = 4
"""Of Yeoh's higher terms; more would only fit the noise."""

NAMED: dict[str, tuple[tuple[str, ...], ...]] = {
    "neo-hooke": (("c10",),),
    "mooney-rivlin": (("c10", "c01"),),
    "yeoh": (("c10", "c20"), ("c10", "c20", "c30")),
}
"""Model -> the sets of constants it may be written with, besides μ and α themselves."""

EXPONENTS = {"neo-hooke": (2.0,), "mooney-rivlin": (2.0, -2.0), "yeoh": (2.0,)}
"""Model -> its α."""

Strain = Annotated[float, Field(gt=-1, le=20)]
Coefficient = Annotated[float, Field(ge=-STIFFEST, le=STIFFEST)]


class Material(Parameters):
    """Hyperelastic material; every Ogden term obeys Hill's inequality μₚαₚ > 0, that is μᵢ > 0.

    Terms of mixed sign can be stable over the range they were fitted in, but a design may leave
    that range anywhere on its load path; they are refused rather than trusted. Yeoh's higher terms
    may be negative as long as the three tests are stable over ``valid_strain``, or everywhere
    without one; results are checked against it.
    """

    name: str = Field(default="custom", min_length=1, max_length=64)
    model: Literal["ogden", "neo-hooke", "mooney-rivlin", "yeoh"] = "ogden"
    mu: tuple[float, ...] = Field(
        min_length=1,
        max_length=6,
        description="μᵢ of Abaqus's form",
        json_schema_extra={"unit": "MPa"},
    )
    alpha: tuple[float, ...] = Field(min_length=1, max_length=6, description="exponents αᵢ")
    higher: tuple[Coefficient, ...] = Field(
        default=(),
        max_length=MOST_HIGHER,
        description="C₂₀, C₃₀, … of Yeoh's model",
        json_schema_extra={"unit": "MPa"},
    )
    yield_strength: float = Field(ge=0.01, le=200, json_schema_extra={"unit": "MPa"})
    elongation_at_break: float | None = Field(
        default=None, ge=20, le=3000, json_schema_extra={"unit": "%"}
    )
    valid_strain: tuple[Strain, Strain] | None = Field(
        default=None, description="lowest and highest principal nominal strain of the tests"
    )
    source: str = Field(default="", max_length=1000)

    @model_validator(mode="before")
    @classmethod
    def _as_ogden(cls, data: Any) -> Any:
        """With the constants of the model's own names turned into μ, α and higher ones."""
        return _translated(data) if isinstance(data, dict) else data

    @field_validator("mu", "alpha", "higher", "valid_strain", mode="before")
    @classmethod
    def _list_is_tuple(cls, value: Any) -> Any:
        return tuple(value) if isinstance(value, list) else value

    @field_validator("valid_strain")
    @classmethod
    def _range_holds_zero(cls, value: tuple[float, float] | None) -> tuple[float, float] | None:
        if value is not None and not value[0] < 0 < value[1]:
            raise ValueError(
                f"material.valid_strain is {list(value)} but must run from a number below 0 to "
                "one above it (nominal strain, a fraction)"
            )
        return value

    @field_validator("name", "source")
    @classmethod
    def _is_printable(cls, text: str) -> str:
        if not text.isprintable():
            raise ValueError(f"{quoted(text)} must be printable text on one line")
        return text

    @model_validator(mode="after")
    def _is_stable(self) -> Self:
        if len(self.mu) != len(self.alpha):
            raise ValueError(
                f"material.mu has {len(self.mu)} and material.alpha {len(self.alpha)} numbers; "
                "each term needs one of both"
            )
        for index, (mu, alpha) in enumerate(zip(self.mu, self.alpha, strict=True)):
            _check_term(index, mu, alpha)
        shear = self.initial_shear_modulus
        if not SOFTEST <= shear <= STIFFEST:
            raise ValueError(
                f"material.mu sums to an initial shear modulus of {shear:g} MPa but must lie "
                f"between {SOFTEST:g} and {STIFFEST:g} MPa; are the constants given in MPa?"
            )
        if self.alpha != EXPONENTS.get(self.model, self.alpha):
            raise ValueError(
                f"material.alpha is {list(self.alpha)} but the model {quoted(self.model)} has "
                f"{list(EXPONENTS[self.model])}"
            )
        if self.higher:
            _check_higher(self)
        return self

    @property
    def initial_shear_modulus(self) -> float:
        """Shear modulus of the undeformed material, MPa: Σ μᵢ."""
        return sum(self.mu)


def _check_term(index: int, mu: float, alpha: float) -> None:
    if mu <= 0:
        raise ValueError(
            f"material.mu[{index}] is {mu:g} MPa but must be greater than 0 (Hill's inequality); "
            "constants of the literature's form become μ = μₚ αₚ / 2"
        )
    if abs(alpha) > 50:
        raise ValueError(f"material.alpha[{index}] is {alpha:g} but must lie between -50 and 50")


def _translated(table: dict[str, Any]) -> dict[str, Any]:
    """The same material with μ, α and higher instead of ``c10``, ``c01``, ``c20`` and ``c30``."""
    given = [key for key in ("c10", "c01", "c20", "c30") if key in table]
    if not given:
        return table
    model = str(table.get("model", "ogden"))
    both = [key for key in ("mu", "alpha", "higher") if key in table]
    if both:
        raise ValueError(f"material.{given[0]} and material.{both[0]} say the same thing twice")
    if tuple(given) not in NAMED.get(model, ()):
        forms = " or ".join(", ".join(form) for form in NAMED.get(model, (("mu", "alpha"),)))
        raise ValueError(
            f"material has {', '.join(given)} but the model {quoted(model)} is written with {forms}"
        )
    rest = {key: value for key, value in table.items() if key not in given}
    values = [_constant(key, table[key]) for key in given]
    if model == "mooney-rivlin":
        return rest | {"mu": tuple(2 * c for c in values), "alpha": EXPONENTS[model]}
    return rest | {"mu": (2 * values[0],), "alpha": (2.0,), "higher": tuple(values[1:])}


def _constant(key: str, value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (number and abs(value) <= STIFFEST):
        shown = quoted(str(value)[:40])
        raise ValueError(
            f"material.{key} is {shown} but must lie between {-STIFFEST:g} and {STIFFEST:g} MPa"
        )
    return float(value)


def _check_higher(material: Material) -> None:
    from solver.material.stability import HIGHEST, LOWEST, stability

    low, high = material.valid_strain or (LOWEST - 1, HIGHEST - 1)
    found = stability(material.mu, material.alpha, material.higher)
    if not found.covers(max(1 + low, LOWEST), min(1 + high, HIGHEST)):
        worst = min(found.ranges, key=lambda each: each.highest / each.lowest)
        raise ValueError(
            f"material.higher is {list(material.higher)} MPa, with which {worst.mode} tests are "
            f"stable only at stretches from {worst.lowest:.3g} to {worst.highest:.3g}, less than "
            "valid_strain says (all stretches, without one)"
        )


def load_material(name: str) -> Material:
    """The library's material of that name.

    Raises ``DesignError`` if the library has none, naming those that look alike.
    """
    library = dict(reversed(list(_library())))
    if name not in library:
        known = sorted(library)
        raise DesignError(f"unknown material {quoted(name)}{did_you_mean(name, known)}")
    try:
        return Material.model_validate(tomllib.loads(library[name].read_text("utf-8-sig")))
    except ValidationError as error:
        raise DesignError(*sentences(error, Material)) from None
    except (ValueError, RecursionError, OSError) as error:
        text = " ".join(str(error).split())
        raise DesignError(f"material {quoted(name)} cannot be read: {text[:200]}.") from None


def material_names() -> tuple[str, ...]:
    """Names of all materials of the library, the shipped ones and those of other packages."""
    return tuple(sorted(dict(_library())))


def _library() -> Iterator[tuple[str, Traversable]]:
    """(name, file) of every material; the shipped ones come first and win.

    A package that is named by an entry point but gone has none; the others keep theirs.
    """
    packages = [ENTRY_POINTS, *(entry.module for entry in entry_points(group=ENTRY_POINTS))]
    for package in packages:
        with suppress(ImportError):
            for file in files(package).iterdir():
                if file.name.endswith(".toml"):
                    yield file.name.removesuffix(".toml"), file
