"""Printed vessels that were filled and shut: do our rule and our leak test know which leak?"""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import leak_layers
from record import Case, Computed, Report, Results, Table

from printers import load_profile
from printers.rules.printing import judged_layer_height

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "leak.json").read_text(encoding="utf-8")
)


def judged(height: float) -> Computed:
    """What the rule ``layer_height`` says of a profile with layers of that height, mm."""
    profile = load_profile("prusa_i3").model_copy(update={"layer_height": height})
    result = judged_layer_height(height, profile, "all layers")
    return Computed({"verdict": result.verdict})


def modelled() -> dict[str, dict[str, float]]:
    """Rows of the benchmark by height: what the beads of a sliced box say."""
    rows = json.loads(leak_layers.RESULTS.read_text(encoding="utf-8"))
    return {f"{row['layer']:.2f}": row for row in rows}


def loss(height: str) -> float:
    """Share of the pressure that was lost in the first minute."""
    start, minute, _ = DATA["bar"][height]
    return float(1 - minute / start)


def report(results: Results) -> Report:
    """The section."""
    ratios = {row["ratio"] for row in modelled().values()}
    right = sum(
        (results[height].readings["verdict"] == "pass") == (loss(height) < 0.1)
        for height in results
    )
    return Report(
        part=f"Vessels printed with four heights of layers. Source: {DATA['source']}.",
        measured=(
            "Pressure at the start, after 60 s and after 140 s. In the first minute layers of 0.06 "
            f"and 0.10 mm lost {100 * loss('0.06'):.1f} and {100 * loss('0.10'):.1f} %, those of "
            f"0.15 and 0.20 mm {100 * loss('0.15'):.0f} and {100 * loss('0.20'):.0f} %."
        ),
        posed=(
            "The rule `layer_height` on the profile `prusa_i3` with each height; and a hollow box, "
            "sliced with each, in the leak test's model of the beads "
            "(`tests/benchmarks/leak_layers.py`)."
        ),
        rows=(),
        unknown=(
            "Shape, walls, filament, slicer and printer of the vessels; whether a vessel of each "
            "height was tested more than once; and the heights between 0.10 and 0.15 mm."
        ),
        verdict=(
            f"No validation: the rule is right for {right} of {len(results)} vessels, but it was "
            "made from them; the model of the beads cannot tell them apart (r\\* = "
            f"{', '.join(f'{ratio:g}' for ratio in sorted(ratios))} for all): it finds ways of air "
            "that the slicer leaves, not those that layers leave between them."
        ),
        tables=(_table(results),),
    )


def _table(results: Results) -> Table:
    lines = []
    for height, stored in results.items():
        row = modelled()[height]
        lines.append(
            (
                f"{height} mm",
                " → ".join(f"{bar:.3f}" for bar in DATA["bar"][height]),
                stored.readings["verdict"],
                f"{row['ratio']:.3f}",
                f"{row['lines']:.2f}",
            )
        )
    heading = (
        "layers",
        "bar at 0, 60, 140 s",
        "rule `layer_height`",
        "r\\* of the beads",
        "depth, lines",
    )
    return Table("", heading, tuple(lines))


CASE = Case(
    "F. Printed vessels: what the leak test cannot know",
    {height: partial(judged, float(height)) for height in DATA["bar"]},
    report,
    sample="0.10",
)
