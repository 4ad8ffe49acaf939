"""A material from a fit, if it can be one."""

from __future__ import annotations

from typing import Any

from bellows_design.materials.bounds import POOR_FIT, POOR_MODULUS
from bellows_design.materials.fitting.fit_result import Fit
from bellows_design.materials.fitting.initial_modulus import initial_modulus
from bellows_design.materials.laws import law_of_fit
from bellows_design.materials.library import checked_material
from bellows_design.materials.material import Material
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import usable
from bellows_design.validation.quoting import quoted


def why_no_material(data: Measurements, fit: Fit) -> str | None:
    """One sentence on why no design would take the fit to ``data``; None if one would."""
    if not usable(data, fit):
        return f"{fit.model} is unstable; a design takes no such material."
    if fit.vanished:
        return f"{fit.model} has a term that adds nothing; a design takes no such material."
    return None


def why_poor(data: Measurements, fit: Fit) -> str | None:
    """One sentence on why the fit to ``data`` is too poor for a material; None if it is not."""
    error, start = 100 * fit.relative_error, initial_modulus(data)
    if error > POOR_FIT:
        return (
            f"{fit.model} is off by {error:.0f} % in the mean of the points; more than "
            f"{POOR_FIT:g} % is no material. Look at the plot, at other models and at how the "
            "measurements were read; --accept-poor-fit takes it, with a warning that stays."
        )
    modulus = fit.stability.shear_modulus
    if start is not None and start.contradicts(modulus, POOR_MODULUS):
        return (
            f"{fit.model} has an initial shear modulus of {modulus:.4g} MPa, but the beginning of "
            f"the tests says {start.value:.4g} ± {2 * start.error:.2g} MPa; more than "
            f"{POOR_MODULUS:g} % off is no material. Try other models; --accept-poor-fit takes it, "
            "with a warning that stays."
        )
    return None


def fitted_material(
    data: Measurements,
    fit: Fit,
    name: str,
    yield_strength: float,
    elongation_at_break: float | None = None,
) -> Material:
    """The material that the fit to ``data`` describes, its constants to nine digits.

    Args:
        data: The measurements, for the range of strain and the source.
        fit: A fit for which ``why_no_material`` is None.
        name: What the material is called.
        yield_strength: MPa; these tests do not determine it.
        elongation_at_break: %; None leaves it open.

    Raises:
        DesignError: A constant is out of bounds.
    """
    table = {
        "name": name,
        "model": law_of_fit(fit.model).name,
        **_constants(fit),
        "yield_strength": yield_strength,
        "elongation_at_break": elongation_at_break,
        "valid_strain": _valid_strain(data),
        "fit_error": float(f"{100 * fit.relative_error:.3g}"),
        "fit_modulus_error": _modulus_error(data, fit),
        "source": _source(data, fit),
    }
    return checked_material(table)


def _modulus_error(data: Measurements, fit: Fit) -> float | None:
    """Difference of the initial shear modulus from what the beginning of the tests says, %."""
    start = initial_modulus(data)
    if start is None:
        return None
    return float(f"{100 * abs(fit.stability.shear_modulus / start.value - 1):.2g}")


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
