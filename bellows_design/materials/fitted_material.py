"""A material from a fit, if it can be one."""

from __future__ import annotations

from typing import Any

from bellows_design.materials.fitting.fit_result import Fit
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.laws import law_of_fit
from bellows_design.materials.library import checked_material
from bellows_design.materials.material import Material
from bellows_design.validation.quoting import quoted


def why_no_material(data: Measurements, fit: Fit) -> str | None:
    """One sentence on why a design would not take the fit to ``data``; None if it would."""
    low, high = data.valid_strain
    in_range = law_of_fit(fit.model).softens and fit.stability.covers(1 + low, 1 + high)
    if not (fit.stable or in_range):
        return f"{fit.model} is unstable; a design takes no such material."
    if fit.vanished:
        return f"{fit.model} has a term that adds nothing; a design takes no such material."
    return None


def fitted_material(data: Measurements, fit: Fit, name: str, yield_strength: float) -> Material:
    """The material that the fit to ``data`` describes, its constants to nine digits.

    Args:
        data: The measurements, for the range of strain and the source.
        fit: A fit for which ``why_no_material`` is None.
        name: What the material is called.
        yield_strength: MPa; these tests do not determine it.

    Raises:
        DesignError: A constant is out of bounds.
    """
    table = {
        "name": name,
        "model": law_of_fit(fit.model).name,
        **_constants(fit),
        "yield_strength": yield_strength,
        "valid_strain": _valid_strain(data),
        "source": _source(data, fit),
    }
    return checked_material(table)


def _constants(fit: Fit) -> dict[str, Any]:
    """As a material's table holds them."""
    if law_of_fit(fit.model).constants:
        return {constant.name: float(f"{constant.value:.9g}") for constant in fit.constants}
    numbers = {"mu": fit.mu, "alpha": fit.alpha, "higher": fit.higher}
    return {key: [float(f"{value:.9g}") for value in values] for key, values in numbers.items()}


def _valid_strain(data: Measurements) -> list[float] | None:
    """Range of the tests, rounded; None where it does not hold 0 on its inside."""
    low, high = (round(end, 4) for end in data.valid_strain)
    return [low, high] if -1 < low < 0 < high else None


def _source(data: Measurements, fit: Fit) -> str:
    low, high = data.valid_strain
    open_ones = "" if fit.determined else " NOT DETERMINED by these tests: see the intervals."
    return (
        f"fit of {fit.model} to {quoted(data.name)}: {fit.points} points, {', '.join(data.modes)}; "
        f"R² {fit.r_squared:.5f}, largest error {fit.misfit.error:.3g} MPa; principal nominal "
        f"strains from {low:.3g} to {high:.3g}; yield strength as given.{open_ones}"
    )
