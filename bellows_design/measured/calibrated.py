"""A material as a print has it: all its moduli times a factor."""

from __future__ import annotations

from typing import Any

from pydantic import ValidationError

from bellows_design.errors import DesignError
from bellows_design.materials.material import Material
from bellows_design.validation.sentences import sentences

MODULI = ("mu", "higher", "constants")
"""Fields of a material in MPa that its stresses are in proportion to; exponents and strains stay,
and so does the yield strength, which no such comparison tells."""


def with_stiffness(material: Material, factor: float, **changed: Any) -> Material:
    """The material with all moduli times ``factor``, and other fields as ``changed`` says.

    Stresses at every strain are ``factor`` times what they were.

    Raises:
        DesignError: It is none then: a modulus leaves its bounds.
    """
    scaled = {name: tuple(factor * each for each in getattr(material, name)) for name in MODULI}
    try:
        return Material.model_validate(material.model_dump() | scaled | changed)
    except ValidationError as error:
        raise DesignError(*sentences(error, Material)) from None


def calibrated_material(
    material: Material, factor: float, low: float, high: float, name: str, data: str
) -> Material:
    """The material that a comparison found, which says where it is from.

    How far its modulus was off its tests no longer matters, so that is left out; the shape of its
    law stays as uncertain as it was.

    Args:
        material: That of the design.
        factor: On its moduli.
        low: Lower end of the factor's interval.
        high: Upper end.
        name: Of the new one.
        data: What the measurement is called.

    Raises:
        DesignError: As ``with_stiffness``.
    """
    source = (
        f"{material.name} with all moduli times {factor:.4g} ({low:.4g} to {high:.4g}, 95 %), by "
        f"bellows compare with {data}; yield strength as it was. {material.name}: "
    )
    longest = 1000
    text = (source + (material.source or "source not stated"))[:longest]
    return with_stiffness(material, factor, name=name, source=text, fit_modulus_error=None)
