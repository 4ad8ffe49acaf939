"""Materials: the constants of a printed elastomer, and a library of them as data files.

A material is the Ogden model in Abaqus's form, of any number of terms,

    W = Σ 2 μᵢ/αᵢ² (λ̄₁^αᵢ + λ̄₂^αᵢ + λ̄₃^αᵢ − 3),

with μᵢ in MPa. The literature writes μₚ/αₚ instead: μᵢ = μₚ αₚ / 2.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from contextlib import suppress
from importlib.metadata import entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any, Literal, Self

from pydantic import Field, ValidationError, field_validator, model_validator

from bellows_design.errors import DesignError, did_you_mean, quoted, sentences
from bellows_design.parameters import Parameters

ENTRY_POINTS = "bellows_design.materials"
"""Entry-point group: each entry names an importable package that holds ``NAME.toml`` files."""

SOFTEST, STIFFEST = 0.003, 300.0
"""MPa. Initial shear moduli from the softest silicones to the hardest TPU; more is a unit."""


class Material(Parameters):
    """Hyperelastic material; every term obeys Hill's inequality μₚαₚ > 0, that is μᵢ > 0.

    Terms of mixed sign can be stable over the range they were fitted in, but a design may leave
    that range anywhere on its load path; they are refused rather than trusted.
    """

    name: str = Field(default="custom", min_length=1, max_length=64)
    model: Literal["ogden"] = "ogden"
    mu: tuple[float, ...] = Field(
        min_length=1,
        max_length=6,
        description="μᵢ of Abaqus's form",
        json_schema_extra={"unit": "MPa"},
    )
    alpha: tuple[float, ...] = Field(min_length=1, max_length=6, description="exponents αᵢ")
    yield_strength: float = Field(ge=0.01, le=200, json_schema_extra={"unit": "MPa"})
    elongation_at_break: float | None = Field(
        default=None, ge=20, le=3000, json_schema_extra={"unit": "%"}
    )
    source: str = Field(default="", max_length=1000)

    @field_validator("mu", "alpha", mode="before")
    @classmethod
    def _list_is_tuple(cls, value: Any) -> Any:
        return tuple(value) if isinstance(value, list) else value

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


def load_material(name: str) -> Material:
    """The library's material of that name.

    Raises ``DesignError`` if the library has none, naming those that look alike.
    """
    library = dict(reversed(list(_library())))
    if name not in library:
        known = sorted(library)
        raise DesignError(f"unknown material {quoted(name)}{did_you_mean(name, known)}")
    try:
        return Material.model_validate(tomllib.loads(library[name].read_text("utf-8")))
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
    packages = [__name__, *(entry.module for entry in entry_points(group=ENTRY_POINTS))]
    for package in packages:
        with suppress(ImportError):
            for file in files(package).iterdir():
                if file.name.endswith(".toml"):
                    yield file.name.removesuffix(".toml"), file
