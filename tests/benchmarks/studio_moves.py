"""From a slider's rest to the new angle, in the real page of the real studio.

    python tests/benchmarks/studio_moves.py [--moves 100] [--all] [--design D] [--output F]

Random moves from a fixed seed, of all kinds of sliders, in a headless Chromium that draws the 3D
view in software on the same processors: seven of ten by up to a tenth of the slider's range, two by
up to a third, one to anywhere. Where the values do not go together, the page must say so, and the
move is undone as people do. A value is timed from the last input event to the picture with the new
angle; the 120 ms after which the page takes the slider for at rest are part of it.

Then the designs as the page saved them are evaluated by `bellows evaluate --json` in a process of
its own with a store of its own: every tenth move and the slowest, with `--all` all of them. The
angle that was shown must agree within the sum of both estimates. Prints a table, writes JSON.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median, quantiles
from typing import Any

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE.parent / "support"), str(ROOT)]

from browser import running_browser  # noqa: E402
from studio_in_browser import (  # noqa: E402
    moved,
    running_studio,
    saved,
    sliders,
    wait_for_answer,
    wait_for_any_answer,
)

from bellows_design.machine import machine  # noqa: E402

SEED = 20261127
INPUTS = 6
"""Of one move: input events, one a frame."""

REACHES = ((0.7, 0.1), (0.9, 1 / 3), (1.0, 1.0))
"""Up to which share of moves, and how far they go, as a share of the slider's range."""

STUCK = 60.0
"""s. No answer and no explanation by then counts as stuck."""

PAUSE = 1.0
"""s. Between two moves, as people look at what they did."""

VIEWPORT = {"width": 1280, "height": 860}

EVERY = 10
AIMS = (1.0, 2.0)
"""s: of the median, and of nine in ten."""


@dataclass(frozen=True)
class Move:
    """One move of a slider, and what the page showed.

    Attributes:
        parameter, value: What was moved, and where to.
        seconds: From the last input to the new angle drawn, or to the explanation.
        state: "preview", "refined", "invalid", "failed" or "stuck".
        angle_deg, error_deg: As shown; None without a valid design, or without an estimate.
        how: The page's sentence on how the angle was found, or what is wrong.
        toml: The design as the page saved it.
        load: Of the machine, in the last minute.
    """

    parameter: str
    value: float
    seconds: float
    state: str
    angle_deg: float | None
    error_deg: float | None
    how: str
    toml: str
    load: float

    @property
    def answered(self) -> bool:
        """Whether an angle was shown."""
        return self.state in ("preview", "refined")


@dataclass(frozen=True)
class Check:
    """A shown angle beside the ordinary evaluation of the saved design, degrees.

    ``shown_error_deg`` is None where the page said that it knows none yet.
    """

    move: int
    shown_deg: float
    shown_error_deg: float | None
    evaluated_deg: float
    evaluated_error_deg: float

    @property
    def agrees(self) -> bool:
        """Within the sum of both estimates."""
        allowed = (self.shown_error_deg or 0.0) + self.evaluated_error_deg
        return abs(self.shown_deg - self.evaluated_deg) <= allowed + 0.05  # shown with one decimal


def walked(page: Any, count: int, seed: int = SEED) -> Iterator[Move]:
    """So many random moves, each from the design that the last one left."""
    chance = random.Random(seed)
    _give_all_numbers(page)
    names: list[str] = []
    for _ in range(count):
        found = sliders(page)
        if not names:  # all kinds before any comes again
            names = sorted(found)
            chance.shuffle(names)
        name = names.pop()
        yield _move(page, name, _target(found[name], chance))
        page.wait_for_timeout(1000 * PAUSE)


def _give_all_numbers(page: Any) -> None:
    """Take the number of bubbles in hand, and switch the indent on, so that all sliders move."""
    page.locator('[data-parameter="number_of_bubbles"] input[type=checkbox]').uncheck()
    if not page.locator("#indent-on").is_checked():
        page.locator("#indent-on").check()
    page.wait_for_timeout(300)
    wait_for_any_answer(page)


def _target(slider: dict[str, float], chance: random.Random) -> float:
    """Where to, on the slider's grid, and never where it is."""
    reach = next(share for up_to, share in REACHES if chance.random() <= up_to or up_to == 1)
    span = slider["high"] - slider["low"]
    wanted = slider["value"] + chance.uniform(-reach, reach) * span
    steps = round(
        (min(slider["high"], max(slider["low"], wanted)) - slider["value"]) / slider["step"]
    )
    if steps == 0:
        steps = 1 if slider["value"] + slider["step"] <= slider["high"] else -1
    return float(round(slider["value"] + steps * slider["step"], 6))


def _move(page: Any, name: str, target: float) -> Move:
    start = sliders(page)[name]["value"]
    way = [start + (target - start) * step / INPUTS for step in range(1, INPUTS + 1)]
    found = moved(page, name, way, STUCK)
    answered = found["state"] in ("preview", "refined")
    toml = saved(page) if answered else ""
    how = found["problem"] if found["state"] == "invalid" else found["how"]
    if not answered:
        page.locator("#undo").click()
        wait_for_any_answer(page)
    return Move(
        name, float(found["value"].replace("−", "-")), found["seconds"], found["state"],
        found["angle_deg"] if answered else None, _error(page) if answered else None, how, toml,
        os.getloadavg()[0],
    )  # fmt: skip


def _error(page: Any) -> float | None:
    """As it stands beside the angle, degrees; None where the page says that it is not known."""
    text = page.locator("#angle ~ .margin").inner_text()
    return float(text.split("±")[1]) if "±" in text else None


def checked(moves: Sequence[Move], every: int) -> Iterator[Check]:
    """Every so many and the slowest of the answered moves, evaluated in processes of their own."""
    answered = [number for number, move in enumerate(moves) if move.answered]
    chosen = set(answered[::every]) | {max(answered, key=lambda number: moves[number].seconds)}
    with tempfile.TemporaryDirectory() as folder:
        for number in sorted(chosen):
            yield _check(number, moves[number], Path(folder))


def _check(number: int, move: Move, folder: Path) -> Check:
    file = folder / f"{number}.toml"
    file.write_text(move.toml, encoding="utf-8")
    command = [sys.executable, "-m", "bellows_design", "evaluate", str(file), "--json"]
    environment = {**os.environ, "BELLOWS_CACHE": str(folder / "store")}
    answer = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    found = json.loads(answer.stdout)
    angle = found["bending_angle_deg"]
    percent = found["error_estimate"]["bending_angle_percent"] or 0.0
    return Check(number, move.angle_deg, move.error_deg, angle, abs(angle) * percent / 100)


def summary(moves: Sequence[Move]) -> dict[str, Any]:
    """How long the answered moves took, and what became of the others."""
    seconds = [move.seconds for move in moves if move.answered]
    states = [move.state for move in moves]
    return {
        "moves": len(moves),
        "median_seconds": median(seconds),
        "ninety_percent_seconds": quantiles(seconds, n=10)[8] if len(seconds) > 1 else seconds[0],
        "longest_seconds": max(seconds),
        "states": {state: states.count(state) for state in sorted(set(states))},
        "explained_seconds": [move.seconds for move in moves if move.state == "invalid"],
        "load": median(move.load for move in moves),
    }


def table(moves: Sequence[Move], checks: Sequence[Check]) -> str:
    """The results as Markdown."""
    found = summary(moves)
    agree = sum(check.agrees for check in checks)
    explained = found["explained_seconds"]
    rows = [
        ("moves", f"{found['moves']}"),
        ("what came", ", ".join(f"{count} {state}" for state, count in found["states"].items())),
        ("rest to angle, median", f"{found['median_seconds']:.2f} s (aim {AIMS[0]:g} s)"),
        (
            "rest to angle, nine in ten",
            f"{found['ninety_percent_seconds']:.2f} s (aim {AIMS[1]:g} s)",
        ),
        ("longest", f"{found['longest_seconds']:.2f} s"),
        (
            "to the explanation of what is invalid, median",
            f"{median(explained):.2f} s" if explained else "–",
        ),
        ("angles equal to `bellows evaluate` within both estimates", f"{agree} of {len(checks)}"),
        ("load of the machine", f"{found['load']:.1f}"),
    ]
    return "\n".join(["| | |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows)])


def arguments(words: Sequence[str]) -> argparse.Namespace:
    """What was asked for on the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moves", type=int, default=100)
    parser.add_argument("--all", action="store_true", help="evaluate the design of every move")
    parser.add_argument("--design", default="prototype_1")
    parser.add_argument("--output", type=Path, default=HERE / "studio_moves.json")
    return parser.parse_args(words)


def recorded(design: str, count: int) -> list[Move]:
    """The moves of a studio and a browser of their own, told one by one."""
    with tempfile.TemporaryDirectory() as folder:
        store = {"BELLOWS_CACHE": str(Path(folder) / "store")}
        exports = Path(folder) / "exports"
        with running_studio(design, exports, store) as url, running_browser() as browser:
            page = browser.new_page(reduced_motion="reduce", viewport=VIEWPORT)
            page.goto(url)
            wait_for_answer(page)
            moves = []
            for move in walked(page, count):
                moves.append(move)
                told = f"{len(moves)} {move.parameter} = {move.value:g}: {move.state}"
                print(f"{told} after {move.seconds:.2f} s", file=sys.stderr, flush=True)
    return moves


def content(design: str, moves: Sequence[Move], checks: Sequence[Check]) -> dict[str, Any]:
    """What is written as JSON."""
    return {
        "seed": SEED,
        "design": design,
        "date": time.strftime("%Y-%m-%d"),
        "machine": machine().to_dict(),
        "summary": summary(moves),
        "moves": [asdict(move) for move in moves],
        "checks": [asdict(check) | {"agrees": check.agrees} for check in checks],
    }


def write(file: Path, found: Mapping[str, Any]) -> None:
    """As JSON, with a line for each number."""
    text = json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False)
    file.write_text(text + "\n", encoding="utf-8")


def main(words: Sequence[str] = ()) -> None:
    """Walk, check, print, write."""
    asked = arguments(words)
    moves = recorded(asked.design, asked.moves)
    write(asked.output, content(asked.design, moves, []))  # should a check be interrupted
    checks = list(checked(moves, 1 if asked.all else EVERY))
    print(table(moves, checks))
    write(asked.output, content(asked.design, moves, checks))


if __name__ == "__main__":
    main(sys.argv[1:])
