"""The material: its law and constants, its curve, and how far it was tested and is strained."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.materials.laws import LAWS
from bellows_design.reports.page.blocks import (
    Block,
    Fact,
    Facts,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.curves.material_chart import material_chart
from bellows_design.reports.page.wording import capitalised

if TYPE_CHECKING:
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.materials.material import Material
    from bellows_design.reports.page.findings import Findings


def material(findings: Findings) -> Section:
    """Curve, constants, source and warnings."""
    own, evaluation = findings.outcome.design.material, findings.outcome.evaluation
    reached = None if evaluation is None else evaluation.strain
    return Section("material", "Material", tuple(_blocks(own, reached)))


def _blocks(own: Material, reached: ReachedStrain | None) -> Iterator[Block]:
    yield Pictures((Picture(material_chart(own, reached), _caption(own, reached)),))
    yield Facts(tuple(_facts(own, reached)))
    if own.warnings:
        yield Sentences(tuple(map(capitalised, own.warnings)), "warn")


def _caption(own: Material, reached: ReachedStrain | None) -> str:
    tested = (
        "The shaded range was tested."
        if own.valid_strain
        else ("The material does not state the range of its tests, so none is shaded.")
    )
    marks = (
        ""
        if reached is None
        else (" Marks are the lowest and the highest principal strain that the finger reaches.")
    )
    return f"{tested}{marks}"


def _facts(own: Material, reached: ReachedStrain | None) -> Iterator[Fact]:
    yield Fact("name", own.name)
    yield Fact("law", own.model)
    yield from _constants(own)
    yield Fact("initial shear modulus", f"{own.initial_shear_modulus:.4g} MPa")
    yield Fact("yield strength", f"{own.yield_strength:g} MPa")
    elongation = own.elongation_at_break
    yield Fact("elongation at break", "not stated" if elongation is None else f"{elongation:g} %")
    yield Fact("tested strains", _range(own.valid_strain))
    if reached is not None:
        note = {True: "within the tests", False: "beyond the tests", None: ""}[reached.within]
        values = (reached.lowest, reached.highest)
        yield Fact(
            "strains reached",
            _range(values),
            note=note,
            tone="warn" if reached.within is False else "",
        )
    if own.fit_error is not None:
        yield Fact("error of the fit", f"{own.fit_error:.3g} %")
    if own.fit_modulus_error is not None:
        yield Fact("error of its initial modulus", f"{own.fit_modulus_error:.3g} %")
    yield Fact("source", own.source or "not stated")


def _constants(own: Material) -> Iterator[Fact]:
    for index, (modulus, exponent) in enumerate(zip(own.mu, own.alpha, strict=True), 1):
        yield Fact(f"μ{index}, α{index}", f"{modulus:g} MPa, {exponent:g}")
    for index, constant in enumerate(own.higher, 2):
        yield Fact(f"C{index}0", f"{constant:g} MPa")
    for name, constant in zip(LAWS[own.model].constants, own.constants, strict=False):
        yield Fact(name, f"{constant:g} MPa")


def _range(strains: tuple[float, float] | None) -> str:
    if strains is None:
        return "not stated"
    return f"{100 * strains[0]:+.3g} … {100 * strains[1]:+.3g} %"
