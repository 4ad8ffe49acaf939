"""A pleated silicone finger of which no walls are stated: the shape of its curve."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from record import Case, Report, Results

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "marchese.json").read_text(encoding="utf-8")
)


def slopes() -> tuple[float, ...]:
    """Slopes of log angle over log pressure between the measured points."""
    pressures, angles = np.array(DATA["kpa_deg"]).T
    return tuple(np.diff(np.log(angles)) / np.diff(np.log(pressures)))


def report(results: Results) -> Report:
    """The section; nothing is computed."""
    (first, start), (last, end) = DATA["kpa_deg"][0], DATA["kpa_deg"][-1]
    return Report(
        part=f"A pleated finger of silicone. Source: {DATA['source']}.",
        measured=(
            f"Nine angles from {start:g}° at {first:g} kPa to {end:g}° at {last:g} kPa. On "
            f"logarithmic axes the curve's slope is {slopes()[0]:.2f} at first, rises to "
            f"{max(slopes()):.2f} at about 46 kPa, and ends at {slopes()[-1]:.2f}: the finger "
            "softens as its pleats swell, and stiffens again."
        ),
        posed=(
            "Not posed: walls, pleats and silicone are not stated. What is left is a shape after "
            "scaling both axes, by a modulus and by the walls."
        ),
        rows=(),
        unknown="Everything that decides pressure and angle but the outer size.",
        verdict=(
            "No validation: two free scales fit any curve that bends upwards once, so that "
            "agreement would say nothing. Actuators like it are in case A, where the "
            "walls are known."
        ),
    )


CASE = Case("D. The shape of a pleated finger's curve: nothing to claim", {}, report)
