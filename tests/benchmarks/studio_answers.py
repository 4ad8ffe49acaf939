"""From rest to the first answer of the studio's server, without a browser; and what it is off by.

    python tests/benchmarks/studio_answers.py [--moves 100] [--design prototype_1] [--check 10]
        [--output F]

Random moves from a fixed seed: seven of ten by up to a tenth of the slider's range, two by up to a
third, one to anywhere; after five moves it begins anew at the opened design. A move that makes no
valid design is undone. Times are from the message ``rest`` to the message ``answer``; beside them
the time of all processors that the studio's processes took meanwhile. Some answers, evenly spread,
and the slowest are compared with ordinary evaluations of the designs as they are saved. The server
also measures by how much its event loop is late.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import random
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median, quantiles
from typing import Any

import aiohttp
import psutil

from bellows_design.design.shipped import load_design
from bellows_design.machine import machine
from bellows_design.studio.serving.running import Options, serve

SEED = 20261127
REACHES = ((0.7, 0.1), (0.9, 1 / 3), (1.0, 1.0))
"""Up to which share of moves, and how far they go, as a share of the slider's range."""

INPUTS, REST, PAUSE, TICK = 6, 0.12, 3.0, 0.01
"""Messages of one move; s: until rest, between moves, between two looks at the clock."""

WALK = 5
"""Moves before it begins anew."""

LONGEST = 60.0
"""s. No answer and no explanation by then counts as stuck."""

FIRST = 900.0
"""s. The first time everything is compiled."""

LEFT_OUT = ("limits.", "port.", "mount.", "fingertip.")


@dataclass
class Move:
    """One move, and what the server said."""

    parameter: str
    value: float
    seconds: float = 0.0
    shape_seconds: float | None = None
    outcome: str = "stuck"
    angle_deg: float | None = None
    error_percent: float | None = None
    how: str = ""
    toml: str = ""
    evaluated_deg: float | None = None
    evaluated_error_percent: float | None = None
    processor_seconds: float = 0.0
    load: float = 0.0

    @property
    def off(self) -> float | None:
        """How far the angle is from the evaluated one, over the sum of both estimates."""
        if self.angle_deg is None or not self.evaluated_deg or self.error_percent is None:
            return None
        allowed = abs(self.angle_deg) * self.error_percent
        allowed += abs(self.evaluated_deg) * (self.evaluated_error_percent or 0.0)
        return 100 * abs(self.angle_deg - self.evaluated_deg) / allowed


class Client:
    """A page without a browser."""

    def __init__(self, socket: Any) -> None:
        self.socket, self.revision = socket, 0
        self.start: dict[str, Any] = {}
        self.values: dict[str, float] = {}

    async def heard(self, seconds: float = LONGEST) -> dict[str, Any]:
        message = await asyncio.wait_for(self.socket.receive(), seconds)
        if message.type is aiohttp.WSMsgType.TEXT:
            return dict(json.loads(message.data))
        size = int.from_bytes(message.data[:4], "little")
        return dict(json.loads(message.data[4 : 4 + size]))

    async def until(self, *kinds: str) -> dict[str, Any]:
        while True:
            found = await self.heard(FIRST)
            if found["type"] in kinds:
                return found

    async def tell(self, kind: str, **content: Any) -> None:
        await self.socket.send_json({"type": kind, "revision": self.revision, **content})

    async def move(self, name: str, value: float, inputs: int = INPUTS) -> Move:
        """Drag a slider there, rest, and wait for the first answer or explanation."""
        slider = next(each for each in self.start["parameters"] if each["name"] == name)
        before = self.values.get(name, slider["value"] or self.start["bubble_count"])
        for step in range(1, inputs + 1):
            there = before + (value - before) * step / inputs
            self.values[name] = round(there) if slider["whole"] else round(there, 6)
            self.revision += 1
            await self.tell("change", values=self.values)
            sent = time.perf_counter()
            await asyncio.sleep(REST if step == inputs else 1 / 60)
        rested, spent = time.perf_counter(), processor_seconds()
        await self.tell("rest")
        move = await self._answered(Move(name, self.values[name]), sent, rested)
        move.processor_seconds = processor_seconds() - spent
        return move

    async def _answered(self, move: Move, sent: float, rested: float) -> Move:
        while True:
            try:
                found = await self.heard()
            except TimeoutError:
                return move
            now = time.perf_counter()
            if found.get("revision") != self.revision:
                continue
            if found["type"] == "shape" and move.shape_seconds is None:
                move.shape_seconds = now - sent
            if found["type"] == "problems" and found["problems"]:
                move.outcome, move.how = "invalid", found["problems"][0]["message"]
                move.seconds = now - sent
                return move
            if found["type"] == "failed" and found["what"] in ("refine", "preview"):
                move.outcome, move.how, move.seconds = "failed", found["message"], now - rested
                return move
            if found["type"] == "answer":
                move.outcome, move.how, move.seconds = found["state"], found["how"], now - rested
                move.angle_deg = found["bending_angle_deg"]
                move.error_percent = found["angle_error_percent"]
                return move


def processor_seconds() -> float:
    """Of the server and all its processes but this one, so far, s."""
    server = psutil.Process(os.getppid())
    others = [each for each in server.children(recursive=True) if each.pid != os.getpid()]
    times = [each.cpu_times() for each in (server, *others)]
    return float(sum(each.user + each.system for each in times))


async def drive(address: str, design: str, moves: int) -> list[Move]:
    """Open the design, wait until all is known of it, and move."""
    chance, found = random.Random(SEED), []
    async with aiohttp.ClientSession() as web:
        place = address.replace("http:", "ws:").replace("/?", "/session?")
        async with web.ws_connect(place, max_msg_size=0) as socket:
            client = Client(socket)
            client.start = await client.until("start")
            await client.until("sensitivities", "failed")
            names = [
                each for each in client.start["parameters"] if not each["name"].startswith(LEFT_OUT)
            ]
            for number in range(moves):
                if number % WALK == 0:
                    client.values = {}
                slider = chance.choice(names)
                former = dict(client.values)
                move = await client.move(slider["name"], target(slider, client, chance))
                move.load = os.getloadavg()[0]
                if move.outcome in ("preview", "refined"):
                    move.toml = await saved(web, address, client)
                else:
                    client.values = former
                print(line(move), flush=True)
                found.append(move)
                await asyncio.sleep(PAUSE)
    return found


def target(slider: dict[str, Any], client: Client, chance: random.Random) -> float:
    """Where a slider is moved."""
    low, high, step = slider["lowest"], slider["highest"], slider["step"]
    now = client.values.get(slider["name"], slider["value"] or client.start["bubble_count"])
    kind = chance.random()
    reach = next(far for share, far in REACHES if kind <= share) * (high - low)
    there = min(high, max(low, now + chance.uniform(-reach, reach)))
    return round(round(there / step) * step, 6) + 0.0


async def saved(web: aiohttp.ClientSession, address: str, client: Client) -> str:
    query = f"&session={client.start['session']}&revision={client.revision}"
    async with web.get(address.replace("/?", "/design.toml?") + query) as answer:
        return str(await answer.text())


def line(move: Move) -> str:
    angle = "" if move.angle_deg is None else f"{move.angle_deg:8.2f}°"
    shape = "" if move.shape_seconds is None else f" shape {1e3 * move.shape_seconds:.0f} ms"
    place = f"{move.parameter} = {move.value:g}"
    spent = f"{move.seconds:6.2f} s ({move.processor_seconds:.2f} s of processors)"
    return f"{place:32} {move.outcome:8} {spent} {angle} {move.how[:60]}{shape}"


def check(moves: list[Move], count: int) -> None:
    """Evaluate some of the designs ordinarily: evenly spread ones, and the slowest."""
    from bellows_design.design.design import Design
    from bellows_design.store import Store, evaluated

    answered = [move for move in moves if move.toml]
    every = max(1, len(answered) // max(1, count))
    chosen = answered[::every] + sorted(answered, key=lambda move: -move.seconds)[:3]
    for move in {id(each): each for each in chosen}.values():
        found = evaluated(Design.from_toml(move.toml), store=Store.usual())
        move.evaluated_deg = found.bending_angle_deg
        move.evaluated_error_percent = found.error_estimate.bending_angle_percent
        print(f"{line(move)}; evaluated {move.evaluated_deg:.2f}°, off {move.off}", flush=True)


def summary(moves: list[Move], late: list[float]) -> dict[str, Any]:
    answered = [move for move in moves if move.outcome in ("preview", "refined")]
    seconds = [move.seconds for move in answered]
    shapes = [move.shape_seconds for move in moves if move.shape_seconds is not None]
    offs = [move.off for move in moves if move.off is not None]
    kinds = ("continued", "the unit cell", "kept")
    return {
        "moves": len(moves),
        "answered": len(answered),
        "invalid": sum(move.outcome == "invalid" for move in moves),
        "failed": sum(move.outcome == "failed" for move in moves),
        "stuck": sum(move.outcome == "stuck" for move in moves),
        "median_s": median(seconds),
        "nine_in_ten_s": quantiles(seconds, n=10)[-1],
        "longest_s": max(seconds),
        "processor_median_s": median(move.processor_seconds for move in answered),
        "processor_nine_in_ten_s": quantiles([move.processor_seconds for move in answered], n=10)[
            -1
        ],
        "how": {kind: sum(move.how.startswith(kind) for move in answered) for kind in kinds},
        "shape_median_ms": 1e3 * median(shapes),
        "shape_nine_in_ten_ms": 1e3 * quantiles(shapes, n=10)[-1],
        "compared": len(offs),
        "disagree": sum(off > 1 for off in offs),
        "largest_off": max(offs, default=None),
        "loop_late_ms": 1e3 * max(late, default=0.0),
        "load": [min(move.load for move in moves), max(move.load for move in moves)],
    }


async def watch(late: list[float]) -> None:
    """By how much the loop is late."""
    while True:
        before = time.perf_counter()
        await asyncio.sleep(TICK)
        late.append(time.perf_counter() - before - TICK)


def run(arguments: argparse.Namespace) -> dict[str, Any]:
    late: list[float] = []
    addresses: list[str] = []
    tasks: list[Any] = []

    def told(address: str) -> None:
        addresses.append(address)
        tasks.append(asyncio.get_running_loop().create_task(watch(late)))
        tasks.append(asyncio.get_running_loop().create_task(driven()))

    moves: list[Move] = []

    async def driven() -> None:
        command = [sys.executable, __file__, "--drive", addresses[0]]
        command += ["--design", arguments.design, "--moves", str(arguments.moves)]
        process = await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE)
        assert process.stdout is not None
        while text := await process.stdout.readline():
            if text.startswith(b"{"):
                moves.extend(Move(**each) for each in json.loads(text)["moves"])
            else:
                print(text.decode().rstrip(), flush=True)
        raise KeyboardInterrupt

    with tempfile.TemporaryDirectory() as folder:
        options = Options(load_design(arguments.design), browser=False, output=Path(folder))
        with suppress(KeyboardInterrupt):  # once the moves are over
            serve(options, told)
    keep(arguments.output, moves, late)
    check(moves, arguments.check)
    return keep(arguments.output, moves, late)


def keep(output: Path | None, moves: list[Move], late: list[float]) -> dict[str, Any]:
    """The summary; it and the moves are written, also before the long comparison."""
    found = summary(moves, late)
    if output is not None:
        content = {
            "machine": asdict(machine()),
            "summary": found,
            "moves": [asdict(m) for m in moves],
        }
        output.write_text(json.dumps(content, indent=1) + "\n", "utf-8")
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moves", type=int, default=100)
    parser.add_argument("--design", default="prototype_1")
    parser.add_argument("--check", type=int, default=10)
    parser.add_argument("--output", type=Path)
    parser.add_argument("--drive", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.drive:
        moves = asyncio.run(drive(arguments.drive, arguments.design, arguments.moves))
        print(json.dumps({"moves": [asdict(move) for move in moves]}), flush=True)
        return
    print(json.dumps(run(arguments), indent=2))


if __name__ == "__main__":
    main()
