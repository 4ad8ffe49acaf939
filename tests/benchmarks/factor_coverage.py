"""How often the interval of ``bellows compare`` holds the factor that a measurement was made with.

    python tests/benchmarks/factor_coverage.py 1000

Measurements are made of a curve in closed form with a known factor and a scatter of 2 % of the
values: independent, correlated over a part of the range of pressures, or of a constant size. It
prints a table, and writes ``factor_coverage.json`` beside this file. An interval of 95 % should
hold the factor in 95 cases of 100; more is caution.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "bellows_design"))

from synthetic_curves import bend, made_up, measured, model

from bellows_design.measured.factor.fit import fit_factor
from bellows_design.measured.reading.curve import MeasuredCurve

SCATTER = 0.02


@dataclass(frozen=True)
class Family:
    """A kind of measurements.

    Attributes:
        points: Of each curve.
        correlation: Length over which scatter is correlated, by the range of pressures.
        constant: Whether the scatter is 2 % of the largest value everywhere, not of each.
        by_force: Whether forces are measured.
    """

    points: int
    correlation: float = 0.0
    constant: bool = False
    by_force: bool = False


FAMILIES = (
    *(Family(points) for points in (6, 12, 20, 40)),
    Family(20, by_force=True),
    Family(20, constant=True),
    *(Family(points, 0.15) for points in (6, 12, 20, 40)),
    *(Family(points, 0.3) for points in (20, 40, 100)),
    Family(20, 0.5),
    Family(20, 1.0),
)


def case(family: Family, seed: int) -> tuple[float, MeasuredCurve]:
    """A factor from 0.6 to 1.7, and a measurement with it."""
    rng = np.random.default_rng([family.points, seed])
    factor = float(np.exp(rng.uniform(np.log(0.6), np.log(1.7))))
    made = made_up(
        rng, factor, family.points, SCATTER, family.correlation, by_force=family.by_force
    )
    if not family.constant:
        return factor, made
    exact = bend(made.pressure / factor)
    noise = SCATTER * exact.max() * rng.normal(size=family.points)
    return factor, measured(exact + noise, made.pressure)


def coverage(family: Family, cases: int) -> dict[str, float]:
    """Share of intervals that hold the factor, their half width, and the error of the factor, %."""
    curve, hits, widths, errors = model(by_force=family.by_force), 0, [], []
    for seed in range(cases):
        factor, part = case(family, seed)
        found = fit_factor(part, curve).factor
        if found is None:
            continue
        hits += found.low <= factor <= found.high
        widths.append(50 * np.log(found.high / found.low))
        errors.append(100 * np.log(found.value / factor))
    return {
        "cases": cases,
        "determined": len(widths),
        "held": hits / len(widths),
        "half_width_percent": float(np.median(widths)),
        "error_percent": float(np.sqrt(np.mean(np.square(errors)))),
    }


def main(cases: int) -> None:
    """Print a row for each family, and write all of them."""
    rows = []
    print("| points | correlated over | scatter | held | half width, % | error, % (rms) |")
    print("|---|---|---|---|---|---|")
    for family in FAMILIES:
        row = asdict(family) | coverage(family, cases)
        rows.append(row)
        kind = ("constant" if family.constant else "of the value") + ", N" * family.by_force
        length = f"{family.correlation:g} of the range" if family.correlation else "nothing"
        print(
            f"| {family.points} | {length} | {kind} | {100 * row['held']:.1f} % of "
            f"{row['determined']} | {row['half_width_percent']:.2f} | {row['error_percent']:.2f} |",
            flush=True,
        )
    file = Path(__file__).with_suffix(".json")
    file.write_text(json.dumps({"scatter": SCATTER, "families": rows}, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
