"""What lines above a table say of the specimen: width, thickness, area and gauge length."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence

from bellows_design.materials.measurements.table.rows import Row, Sheet
from bellows_design.materials.measurements.table.units import AREA, LENGTH, plain_unit

_NAMES = {
    "width": "width breite largeur anchura probenbreite specimen_width sample_width",
    "thickness": "thickness dicke épaisseur espesor probendicke specimen_thickness "
    "sample_thickness",
    "area": "area cross_section cross_sectional_area querschnitt querschnittsfläche section "
    "initial_area initial_cross_section anfangsquerschnitt",
    "gauge_length": "gauge_length gage_length messlänge anfangsmesslänge initial_length l0 "
    "grip_separation initial_gauge_length",
}
_FACTS = {name: fact for fact, names in _NAMES.items() for name in names.split()}


def facts(rows: Sequence[Row], sheet: Sheet) -> dict[str, tuple[float, ...]]:
    """Fact -> the different values the lines give it, mm or mm²; those without a unit are none."""
    found: dict[str, set[float]] = {}
    for row in rows:
        name, value = _fact(row.cells, sheet)
        if name and value is not None:
            found.setdefault(name, set()).add(value)
    return {name: tuple(sorted(values)) for name, values in found.items()}


def _fact(cells: Sequence[str], sheet: Sheet) -> tuple[str | None, float | None]:
    """``Width (mm);6``, ``Width;6;mm``, ``Width: 6 mm`` or ``Width [mm] = 6``."""
    parts = [part for cell in cells for part in re.split(r"[:=]|(?<=\d)\s+(?=[^\d\s])", cell)]
    parts = [part.strip() for part in parts if part.strip()]
    if len(parts) < 2:
        return None, None
    name, inner = re.fullmatch(r"([^\[(]*)(?:[\[(]([^\])]*)[\])])?.*", parts[0], re.DOTALL).groups()  # type: ignore[union-attr]
    fact = _FACTS.get(re.sub(r"[\s_-]+", "_", name.strip().lower()))
    unit = inner if inner is not None else (parts[2] if len(parts) > 2 else "")
    factor = (AREA if fact == "area" else LENGTH).get(plain_unit(unit.strip("[]()")))
    value = sheet.number(parts[1])
    usable = fact is not None and factor is not None and value is not None and value > 0
    return fact, value * factor if usable and value and factor else None


def initial_area(known: Mapping[str, tuple[float, ...]]) -> float | None:
    """The initial area, mm², if the lines above the table give one and no other."""
    sizes = {round(size, 9) for size in known.get("area", ())}
    widths, thicknesses = known.get("width", ()), known.get("thickness", ())
    if len(widths) == len(thicknesses) == 1:
        sizes.add(round(widths[0] * thicknesses[0], 9))
    smallest = min(sizes, default=math.nan)
    return smallest if sizes and max(sizes) < 1.01 * smallest else None
