"""What the studio's previews are off by, beside what they say they may be.

    python tests/benchmarks/preview_errors.py [--bases 12] [--targets 6] [--output F]

Around shipped and random designs (`random_designs.py`) others are drawn from a fixed seed: one to
four numbers of the bellows, or the pressure, changed until the design is as far away as was drawn,
up to 60 %. Each is evaluated ordinarily, and previewed in the three ways of the studio:

- ``evaluated``: continued from the evaluation of the design it was drawn around;
- ``coarse``: its cell by itself on a coarse mesh, with ends and mesh error of that evaluation;
- ``provisional``: continued from the coarse mesh of the target before.

A preview agrees if it is within the sum of both estimates. Prints a table, writes JSON.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from threading import Event
from typing import Any

import numpy as np
from random_designs import RANGES, drawn

from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.errors import BellowsError
from bellows_design.machine import machine
from bellows_design.neighbours.distance import distance
from bellows_design.store import Store, evaluated
from bellows_design.studio.previews.coarse import coarse
from bellows_design.studio.previews.continuation import Anchors
from bellows_design.studio.workers.reporting import Report
from solver.errors import SolverError

SEED = 20261128
SHIPPED = ("prototype_1", "prototype_2", "finger", "prototype_2_indent")
FARTHEST = 0.6
MOST_NUMBERS = 4
BINS = (0.0, 0.05, 0.1, 0.2, 0.4, 0.6)


@dataclass(frozen=True)
class Row:
    """One preview: how it was found, what it says, and what the ordinary evaluation does.

    Angles in degrees, stresses in MPa, estimated errors in percent, processor time in s.
    ``start``: of the evaluation around which the design was drawn; ``mesh``: what its finer meshes
    changed there.
    """

    base: str
    kind: str
    distance: float
    angle: float
    angle_percent: float | None
    stress: float
    stress_percent: float | None
    evaluated_angle: float
    evaluated_angle_percent: float
    evaluated_stress: float
    evaluated_stress_percent: float
    start_angle_percent: float
    start_stress_percent: float
    mesh_angle_percent: float
    mesh_stress_percent: float
    seconds: float

    def share(self, quantity: str) -> float | None:
        """How far the preview is off, over the sum of both estimates; None without one."""
        shown, percent, exact, exact_percent = (
            getattr(self, name.format(quantity))
            for name in ("{}", "{}_percent", "evaluated_{}", "evaluated_{}_percent")
        )
        if percent is None:
            return None
        allowed = abs(shown) * percent + abs(exact) * exact_percent
        return float(100 * abs(shown - exact) / allowed)

    def off(self, quantity: str) -> float:
        """The same in percent of the evaluated value."""
        exact = getattr(self, f"evaluated_{quantity}")
        return float(100 * abs(getattr(self, quantity) - exact) / abs(exact))


def targets(base: Design, count: int, chance: np.random.Generator) -> Iterator[Design]:
    """Designs at drawn distances from the base, each on a drawn line through it."""
    found = tries = 0
    while found < count and tries < 200:
        tries += 1
        wanted = chance.uniform(0.01, FARTHEST)
        names = chance.choice([*RANGES, "pressure"], chance.integers(1, MOST_NUMBERS + 1), False)
        directions = dict(zip(names, chance.choice([-1.0, 1.0], len(names)), strict=True))
        design = moved(base, directions, wanted / math.sqrt(len(names)))
        if design is not None and 0.8 * wanted < distance(base, design) <= FARTHEST:
            found += 1
            yield design


def moved(base: Design, directions: dict[str, float], share: float) -> Design | None:
    """The base with some of its numbers larger or smaller by a share; None where that is none."""
    table = base.model_dump()
    for name, direction in directions.items():
        place = table["load" if name == "pressure" else "bellows"]
        factor = 1 / (1 - share) if direction > 0 else 1 - share
        place[name] = round(place[name] * factor, 3)
    try:
        return Design.model_validate(table)
    except ValueError:
        return None


class Start:
    """An evaluation that previews start from, and the coarse mesh of the last target."""

    def __init__(self, found: Evaluation) -> None:
        self.found, self.report = found, Report(lambda *_: None, Event())
        self.anchors, self.provisional = Anchors(), Anchors()
        self.anchors.add(found, self.report)
        self.near = self.anchors.nearest(found.design)

    def previews(self, design: Design) -> Iterator[tuple[str, LoadedState, float, float]]:
        """Kind, state, distance and seconds of each way that leads to the design."""
        ways = {"evaluated": self.anchors, "provisional": self.provisional}
        for kind, anchors in ways.items():
            began = time.process_time()
            nearest = anchors.nearest(design)
            continued = anchors.continued(design, self.report)
            if continued is not None and nearest is not None:
                far = distance(nearest.anchor.design, design)
                yield kind, continued.state, far, time.process_time() - began
        began = time.process_time()
        only = Anchors()
        only.add(self.found, self.report)
        with suppress(BellowsError, SolverError):
            state = coarse(only, design, self.report).state
            yield "coarse", state, distance(self.found.design, design), time.process_time() - began
            self.provisional = _provisional(only)


def _provisional(anchors: Anchors) -> Anchors:
    """Those of them that are coarse meshes alone."""
    found = Anchors()
    found._all = [each for each in anchors._all if each.provisional]
    return found


def rows(bases: int, count: int) -> Iterator[Row]:
    """All previews of all targets that can be evaluated."""
    designs = [load_design(name) for name in SHIPPED][:bases]
    designs += drawn(max(0, bases - len(designs)))
    for number, base in enumerate(designs):
        found = _evaluated(base)
        if found is None or found.model is not UNIT_CELL:
            continue
        start = Start(found)
        if start.near is None:  # void, say: no start
            continue
        for target in targets(base, count, np.random.default_rng([SEED, number])):
            exact = _evaluated(target)
            if exact is not None:
                for kind, state, far, seconds in start.previews(target):
                    yield _row(start, kind, far, state, exact, seconds)


def _evaluated(design: Design) -> Evaluation | None:
    """The ordinary evaluation; None where the load is not reached."""
    try:
        found = evaluated(design, store=Store.usual())
    except (BellowsError, SolverError):
        return None
    errors = found.error_estimate
    known = None not in (errors.bending_angle_percent, errors.max_von_mises_percent)
    return found if found.converged and known else None


def _row(
    start: Start, kind: str, far: float, state: LoadedState, exact: Evaluation, seconds: float
) -> Row:
    shown, known, before = (each.error_estimate for each in (state, exact, start.found))
    assert known.bending_angle_percent is not None and known.max_von_mises_percent is not None
    assert before.bending_angle_percent is not None and before.max_von_mises_percent is not None
    assert start.near is not None
    taken_over = start.near.taken_over
    return Row(
        start.found.design.name,
        kind,
        far,
        state.bending_angle_deg,
        shown.bending_angle_percent,
        state.max_von_mises_mpa,
        shown.max_von_mises_percent,
        exact.bending_angle_deg,
        known.bending_angle_percent,
        exact.max_von_mises_mpa,
        known.max_von_mises_percent,
        before.bending_angle_percent,
        before.max_von_mises_percent,
        100 * abs(taken_over.rotation - 1),
        100 * abs(taken_over.stress - 1),
        seconds,
    )


def table(found: Sequence[Row]) -> str:
    """Markdown, a line for each kind and range of distances."""
    lines = [
        "| continued from | distance, % | previews | angle off, %: median, most | estimated, % "
        "| share of both estimates, most | stress off, %: median, most | estimated, % "
        "| share, most |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for kind in ("evaluated", "provisional", "coarse"):
        for low, high in pairwise(BINS):
            some = [each for each in found if each.kind == kind and low <= each.distance < high]
            if some:
                lines.append(_line(kind, low, high, some))
    return "\n".join(lines)


def _line(kind: str, low: float, high: float, some: Sequence[Row]) -> str:
    cells = [kind, f"{100 * low:.0f} to {100 * high:.0f}", str(len(some))]
    for quantity in ("angle", "stress"):
        off = [each.off(quantity) for each in some]
        estimates = [e for each in some if (e := getattr(each, f"{quantity}_percent")) is not None]
        shares = [share for each in some if (share := each.share(quantity)) is not None]
        cells.append(f"{np.median(off):.2f}, {max(off):.1f}")
        cells.append(f"{np.median(estimates):.1f}" if estimates else "none")
        cells.append(f"{max(shares):.2f}" if shares else "none")
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--bases", type=int, default=12)
    parser.add_argument("--targets", type=int, default=6)
    parser.add_argument("--output", type=Path, default=Path(__file__).with_suffix(".json"))
    options = parser.parse_args()
    found: list[Row] = []
    for row in rows(options.bases, options.targets):
        found.append(row)
        print(f"{row.base:20} {row.kind:12} {row.distance:.3f} {row.share('angle')}", flush=True)
        content: dict[str, Any] = {"machine": machine().to_dict()}
        content["rows"] = [asdict(each) for each in found]
        options.output.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    print(table(found))


if __name__ == "__main__":
    main()
