"""Whether strains without a unit are fractions or per cent: by physics, or it is asked.

A test of an elastomer that ends below 0.3 % tells nothing, so smaller numbers are fractions.
Beyond, each reading must give an initial modulus that an elastomer can have. Where both do, the
curve decides for fractions if it bends as rubber does over such strains but cannot within so many
per cent; where it does not, the reading is asked for. Per cent are never assumed from the bend.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.ndimage import median_filter

from bellows_design.errors import DesignError
from bellows_design.materials.bounds import SOFTEST, STIFFEST
from bellows_design.materials.measurements.table.headings import Heading
from bellows_design.validation.quoting import quoted
from solver.arrays import Reals

LARGEST_FRACTION = 19.0
"""No rubber is stretched to more than 20 times its length."""

SMALLEST_TEST = 0.3
"""Per cent. No test of an elastomer ends below."""

MOST_BEND = 3.0
"""Relative fall of the secant modulus for each unit of strain that no elastomer exceeds at once.
The measured NinjaFlex has 1.2 over the first 15 %, neo-Hookean rubber 1."""

NOISE = 0.05
"""Relative fall of the secant modulus that counts as noise."""


class Bend(NamedTuple):
    """How the secant modulus, stress over strain, changes along a test.

    Attributes:
        stiffest: Its largest value, in units of stress.
        fall: Its least value beyond that, over the largest.
        rise: Its last value over that least one.
    """

    stiffest: float
    fall: float
    rise: float

    def is_of_rubber(self, percent: float) -> bool:
        """True if no elastomer bends so within that many per cent: they must be fractions."""
        falls = self.fall < 1 - MOST_BEND * percent / 100 - NOISE
        return falls or (self.rise > 1 + 3 * NOISE and self.fall < 1 - 2 * NOISE)


def bend_of(strain: Reals, stress: Reals) -> Bend:
    """The bend of a curve, from points with at least 5 % of the largest stress, noise smoothed."""
    order = np.argsort(np.abs(strain), kind="stable")
    size, load = np.abs(strain[order]), np.abs(stress[order])
    kept = (size > 0) & (load > 0) & (load >= 0.05 * load.max(initial=0.0))
    if not kept.any():
        return Bend(0.0, 1.0, 1.0)
    secant = _smoothed(load[kept] / size[kept])
    peak = int(secant.argmax())
    least = float(secant[peak:].min())
    return Bend(float(secant[peak]), least / float(secant[peak]), float(secant[-1]) / least)


def percent_or_fraction(
    heading: Heading, strain: Reals, stress: Reals, stiffness: float, named: str
) -> tuple[float, str]:
    """The factor from strains without a unit to fractions, and how it was decided.

    ``stress`` in MPa; ``stiffness`` is the initial slope of the test over the shear modulus, 3 in
    uniaxial tension. Raises ``DesignError``, a question, where it remains open.
    """
    reach = float(np.abs(strain).max(initial=0.0))
    bend = bend_of(strain, stress)
    shear = bend.stiffest / stiffness
    in_bounds = reach <= LARGEST_FRACTION and strain.min(initial=0.0) >= -0.95
    fraction, percent = in_bounds and _possible(shear), _possible(100 * shear)
    of_rubber = bend.is_of_rubber(reach)
    if reach < SMALLEST_TEST:
        return 1.0, f"as a fraction: its largest number is {reach:.3g}"
    if fraction and not percent:
        return 1.0, f"as a fraction: in per cent the shear modulus would be {100 * shear:.3g} MPa"
    if fraction and of_rubber:
        return 1.0, (
            f"as a fraction: the curve bends as rubber does up to {100 * reach:.3g} %, not within "
            f"{reach:.3g} %"
        )
    if percent and not (fraction or of_rubber):
        return 0.01, f"as per cent: fractions would reach {reach:.3g}, {_moduli(shear)}"
    raise DesignError(
        f"{named}: the strains {quoted(heading.text)}, up to {reach:.3g}, may be fractions or per "
        f"cent ({_moduli(shear)}); --units strain=1 or --units strain=% tells which."
    )


def _moduli(shear: float) -> str:
    return (
        f"an initial shear modulus of {shear:.3g} MPa as fractions, {100 * shear:.3g} as per cent"
    )


def require_plausible(
    heading: Heading, factor: float, strain: Reals, stress: Reals, named: str
) -> None:
    """Refuse per cent, as a header says, where the curve can only be of fractions.

    ``strain`` as given, ``factor`` the unit's. Raises ``DesignError``, a question.
    """
    reach = float(np.abs(strain).max(initial=0.0))
    if factor == 0.01 and 0 < reach <= 19 and bend_of(strain, stress).is_of_rubber(reach):
        raise DesignError(
            f"{named}: {quoted(heading.text)} says per cent, but the curve bends as rubber does up "
            f"to {100 * reach:.3g} %, not within {reach:.3g} %; --units strain=1 or --units "
            "strain=% tells which."
        )


def _possible(shear: float) -> bool:
    return SOFTEST <= shear <= STIFFEST


def _smoothed(values: Reals) -> Reals:
    """Medians of five neighbours, of fewer at the ends."""
    if values.size < 5:
        return values
    result: Reals = median_filter(values, 5, mode="nearest")
    return result
