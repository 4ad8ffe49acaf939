"""What the columns of an inflation test are called, and their units."""

from __future__ import annotations

from bellows_design.materials.measurements.table import units
from bellows_design.materials.measurements.table.vocabulary import Vocabulary

PRESSURE = {
    **{unit: units.STRESS[unit] for unit in ("mpa", "kpa", "pa", "bar", "mbar", "psi", "n/mm2")},
    **{unit: units.STRESS[unit] for unit in ("n/m2", "kn/m2", "n/cm2", "kgf/cm2", "kg/cm2")},
    **{"hpa": 1e-4, "barg": 0.1, "bar(g)": 0.1, "psig": units.STRESS["psi"]},
    **{"psi(g)": units.STRESS["psi"], "mmhg": 1.33322387415e-4, "cmh2o": 9.80665e-5},
    "kpag": 1e-3,
}
"""Gauge pressure; factors to MPa."""

_DEGREES = 57.29577951308232
ANGLE = {
    **dict.fromkeys(("deg", "°", "degree", "degrees", "grad"), 1.0),
    **dict.fromkeys(("rad", "radian", "radians"), _DEGREES),
    "mrad": 1e-3 * _DEGREES,
}
"""Factors to degrees. ``Grad`` is the German word for them."""

_PLACED = "tip end displacement deflection position verschiebung auslenkung spitze marker u d"

INFLATION = Vocabulary(
    words={
        "spread": "spread std sd stdev scatter deviation standardabweichung streuung sigma σ",
        "pressure": "pressure druck überdruck innendruck pression presión presion pressione p",
        "displacement_x": "x dx ux",
        "displacement_z": "z dz uz",
        "displacement": "displacement deflection verschiebung auslenkung durchbiegung "
        "déplacement desplazamiento spostamento",
        "angle": "angle winkel biegewinkel ángulo angulo angolo θ theta rotation bend bending curl",
        "force": "force load kraft blockierkraft fuerza forza",
        "branch": "branch phase direction richtung ramp",
        "specimen": "specimen sample probe print part run test cycle cycles zyklus repeat",
        "time": "time zeit temps tiempo tempo timestamp",
        "other": "temperature temperatur temp index point nr no row step frame",
    },
    qualifiers={
        "spread": "standard angle bending force blocked displacement deflection tip of dev x z",
        "pressure": "internal inner gauge gage relative applied supply air chamber input inlet "
        "measured actual set setpoint target sensor mean",
        "displacement_x": _PLACED,
        "displacement_z": _PLACED,
        "displacement": "tip end total magnitude mean measured spitze marker",
        "angle": "tip end bending bend total mean measured chord tangent rotation",
        "force": "blocked blocking block tip end contact normal load cell mean measured gripping",
        "specimen": "id number name no count",
        "time": "test elapsed total",
        "other": "number",
    },
    units={
        "pressure": PRESSURE,
        "angle": ANGLE,
        "displacement": units.LENGTH,
        "displacement_x": units.LENGTH,
        "displacement_z": units.LENGTH,
        "force": units.FORCE,
        "spread": {**ANGLE, **units.LENGTH, **units.FORCE},
        "time": units.TIME,
    },
    by_unit={"angle": ("displacement",), "displacement": ("angle",), "force": ("pressure",)},
    needed=(
        frozenset(("pressure",)),
        frozenset(("angle", "displacement", "displacement_x", "displacement_z", "force")),
    ),
    examples=("pressure_kpa,angle_deg", "pressure_kpa,force_n"),
    numbered="pressure_kpa=1,angle_deg=2",
    units_example="pressure=kPa,angle=deg,displacement=mm,force=N",
    names="known are pressure, angle, displacement, x, z, force, spread, branch and specimen, with "
    "a unit behind (pressure_kpa, angle_deg), and - for a column to leave out.",
    lacking="none is a pressure, or none is an angle, a displacement or a force",
    known_units=frozenset().union(
        PRESSURE, ANGLE, units.LENGTH, units.FORCE, units.TIME, units.OTHER
    )
    - {"p"},
    texts=("branch", "specimen"),
)
"""Of parts that are inflated."""
