"""Units of stress, force, length, strain and area, and their factors to MPa, N, mm, 1 and mm²."""

from __future__ import annotations

import re

STRESS = {
    **{"mpa": 1.0, "n/mm2": 1.0, "mn/m2": 1.0, "gpa": 1e3, "kpa": 1e-3, "kn/m2": 1e-3},
    **{"pa": 1e-6, "n/m2": 1e-6, "n/cm2": 1e-2, "kn/mm2": 1e3, "bar": 0.1, "mbar": 1e-4},
    **dict.fromkeys(("psi", "lbf/in2", "lb/in2"), 0.006894757293168361),
    "ksi": 6.894757293168361,
    **dict.fromkeys(("kgf/cm2", "kg/cm2", "kp/cm2"), 0.0980665),
    **dict.fromkeys(("kgf/mm2", "kg/mm2", "kp/mm2"), 9.80665),
}
FORCE = {
    **{"n": 1.0, "kn": 1e3, "mn": 1e-3, "cn": 1e-2},
    **dict.fromkeys(("kgf", "kp", "kg"), 9.80665),
    **dict.fromkeys(("gf", "p", "g"), 0.00980665),
    **dict.fromkeys(("lbf", "lb", "lbs"), 4.4482216152605),
}
LENGTH = {
    **{"mm": 1.0, "cm": 10.0, "m": 1e3, "µm": 1e-3, "um": 1e-3},
    **dict.fromkeys(("in", "inch", "inches"), 25.4),
}
STRAIN = {
    "%": 1e-2,
    **dict.fromkeys(("-", "1", "mm/mm", "m/m", "in/in", "cm/cm", "fraction"), 1.0),
    **dict.fromkeys(("‰", "mm/m"), 1e-3),
    **dict.fromkeys(("µε", "µm/m", "um/m", "microstrain"), 1e-6),
}
AREA = {"mm2": 1.0, "cm2": 100.0, "m2": 1e6, "in2": 645.16}
TIME = dict.fromkeys(("s", "sec", "ms", "min", "h"), 1.0)
OTHER = dict.fromkeys(("°c", "c", "k", "mm/min", "mm/s", "%/min", "1/s", "hz", "j", "nm"), 1.0)

UNITS = {
    "stress": STRESS,
    "force": FORCE,
    "extension": LENGTH,
    "strain": STRAIN,
    "stretch": STRAIN,
    "time": TIME,
}
"""Quantity -> its units and their factors."""

ALL = frozenset().union(STRESS, FORCE, LENGTH, STRAIN, AREA, TIME, OTHER)

_PERCENT = ("percent", "percentage", "pct", "prozent", "pourcent")

_SPELLED = (
    *("MPa", "kPa", "Pa", "GPa", "N/mm²", "MN/m²", "kN/m²", "N/m²", "N/cm²", "kN/mm²", "kgf/cm²"),
    *("kg/cm²", "kp/cm²", "kgf/mm²", "kg/mm²", "kp/mm²", "N", "kN", "mN", "cN", "mm²", "cm²"),
)


def plain_unit(text: str) -> str:
    """A unit as the tables here spell it: ``N/mm²`` and ``N / mm^2`` are ``n/mm2``."""
    lowered = text.strip().lower().replace("²", "2").replace("\u03bc", "µ")
    joined = re.sub(r"[\s^*·]+", "", lowered)
    spelled = "%" if joined in _PERCENT else joined
    return re.sub(r"^sqin|(?<=/)sqin", "in2", spelled)


def shown_unit(plain: str) -> str:
    """A unit as people write it: ``MPa`` for ``mpa``."""
    return next((unit for unit in _SPELLED if plain_unit(unit) == plain), plain)
