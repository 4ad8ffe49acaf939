"""A server that speaks the studio's protocol but solves nothing: for tests of the page's logic.

Designs are checked as the real one checks them; angle and stress are made-up functions of the
parameters, so that a test can say at once what must stand on the page.
"""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from aiohttp import WSMsgType, web

import bellows_design.studio
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.web.packing import packed
from bellows_design.web.scene import Field, Surface
from bellows_design.web.style import page_style

PAGE = Path(bellows_design.studio.__file__).parent / "page"
WEB = PAGE.parents[1] / "web"

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'"
)

BOX = np.array([[x, y, z] for x in (0, 1) for y in (-0.5, 0.5) for z in (0, 1)], dtype=float)
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip

SLIDERS = (
    ("bubble_width", "Bubbles", "mm", 4, 200), ("bubble_height", "Bubbles", "mm", 4, 200),
    ("bubble_thickness", "Bubbles", "mm", 0.4, 10), ("chamber_length", "Bubbles", "mm", 0.4, 50),
    ("bubble_distance", "Bubbles", "mm", 0.4, 50), ("number_of_bubbles", "Bubbles", "", 1, 100),
    ("tendon_width", "Tendon", "mm", 2, 200), ("tendon_height", "Tendon", "mm", 2, 200),
    ("tendon_thickness", "Tendon", "mm", 0.4, 10), ("length", "Tendon", "mm", 10, 1000),
    ("offset", "Tendon", "mm", 0, 200), ("inner_fillet", "Fillets", "mm", 0, 25),
    ("outer_fillet", "Fillets", "mm", 0, 25), ("load.pressure", "Load", "MPa", 0.001, 0.6),
)  # fmt: skip


def angle_of(design: Design) -> float:
    """What this server claims that the design bends by, degrees."""
    bellows = design.bellows
    return 40 * design.load.pressure * bellows.bubble_count * bellows.bubble_height / 20


def stress_of(design: Design) -> float:
    """What it claims to be its highest stress, MPa."""
    return 30 * design.load.pressure / design.bellows.bubble_thickness


def shape_of(design: Design, *, deformed: bool) -> bytes:
    """Boxes for bubbles and tendon, at rest or also bent."""
    bellows = design.bellows
    boxes = [BOX * bellows.bubble_size + (start - bellows.bubble_length / 2, 0, 0)
             for start in bellows.bubble_middles]  # fmt: skip
    boxes.append(BOX * (bellows.length, bellows.tendon_width, bellows.tendon_height))
    points = np.concatenate(boxes)
    triangles = np.concatenate([FACES + 8 * number for number in range(len(boxes))])
    if not deformed:
        thickness = np.full(len(points), bellows.bubble_thickness)
        fields = (Field("wall thickness", "mm", thickness),)
        return packed([Surface("outside", triangles, points[None], fields)])
    turn = np.radians(angle_of(design)) * points[:, 0] / bellows.length
    radius = bellows.length / max(np.radians(angle_of(design)), 1e-6)
    x, z = (radius + points[:, 2]) * np.sin(turn), (radius + points[:, 2]) * np.cos(turn) - radius
    bent = np.stack([x, points[:, 1], z], axis=1)
    stress = np.stack([0 * turn, stress_of(design) * (0.5 + 0.5 * np.cos(points[:, 0]))])
    surface = Surface(
        "outside", triangles, np.stack([points, bent]), (Field("von Mises stress", "MPa", stress),)
    )
    return packed([surface])


@dataclass
class PretendedStudio:
    """One server in a thread; what it received, and how quickly it answers.

    Attributes:
        preview_seconds, refined_seconds: From a rest to both answers.
        received: All messages of the page, in order.
        held: While it is true, no answers are sent.
        refusal: Code and reason by which new connections are closed at once, if any.
    """

    preview_seconds: float = 0.05
    refined_seconds: float = 0.15
    held: bool = False
    refusal: tuple[int, bytes] | None = None
    received: list[dict[str, Any]] = field(default_factory=list)
    url: str = ""
    port: int = 0

    def __enter__(self) -> PretendedStudio:
        self._loop = asyncio.new_event_loop()
        self._sockets: list[web.WebSocketResponse] = []
        threading.Thread(target=self._loop.run_forever, daemon=True).start()
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
        self._loop.call_soon_threadsafe(self._loop.stop)

    def start(self) -> None:
        """Listen, on the port of before where there was one."""
        self._run(self._listen())

    def stop(self) -> None:
        """End all connections and listen no more."""
        self._run(self._end())

    def cut(self, code: int = 1000) -> None:
        """End all connections; new ones are taken."""
        self._run(self._close_all(code))

    def say(self, kind: str, **content: Any) -> None:
        """Send a message of one's own to all pages."""
        self._run(self._to_all({"type": kind, **content}))

    def last(self, kind: str) -> dict[str, Any]:
        """The last message of that kind that came."""
        return [each for each in self.received if each["type"] == kind][-1]

    def _run(self, work: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(10)

    async def _listen(self) -> None:
        app = web.Application()
        app.router.add_get("/session", self._session)
        app.router.add_get("/design.toml", self._toml)
        app.router.add_get("/{path:.*}", self._file)
        self._runner = web.AppRunner(app)
        await self._runner.setup()
        site = web.TCPSite(self._runner, "127.0.0.1", self.port)
        await site.start()
        self.port = self._runner.addresses[0][1]
        self.url = f"http://127.0.0.1:{self.port}/?token=pretended"

    async def _end(self) -> None:
        await self._close_all()
        await self._runner.cleanup()

    async def _close_all(self, code: int = 1000) -> None:
        for socket in list(self._sockets):
            await socket.close(code=code)

    async def _to_all(self, message: Mapping[str, Any]) -> None:
        for socket in self._sockets:
            await socket.send_str(json.dumps(message))

    async def _file(self, request: web.Request) -> web.StreamResponse:
        path = request.match_info["path"]
        headers = {"Content-Security-Policy": POLICY, "Cache-Control": "no-store"}
        if path == "assets/style.css":
            return web.Response(text=page_style(), content_type="text/css", headers=headers)
        if path == "assets/viewer.js":
            return web.FileResponse(WEB / "assets/viewer.js", headers=headers)
        name = path.removeprefix("assets/page/") or "index.html"
        return web.FileResponse(PAGE / name, headers=headers)

    async def _toml(self, request: web.Request) -> web.StreamResponse:
        return web.Response(text=self._designs[int(request.query["revision"])].to_toml())

    async def _session(self, request: web.Request) -> web.StreamResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        if self.refusal:
            await socket.close(code=self.refusal[0], message=self.refusal[1])
            return socket
        self._sockets.append(socket)
        await _Talk(self, socket).run()
        self._sockets.remove(socket)
        return socket

    _designs: dict[int, Design] = field(default_factory=dict)


class _Talk:
    """One connection: the design that was opened, and what was made of it."""

    def __init__(self, studio: PretendedStudio, socket: web.WebSocketResponse) -> None:
        self.studio, self.socket = studio, socket
        self.base = self.design = load_design("prototype_1")
        self.tasks: set[asyncio.Task[None]] = set()

    async def run(self) -> None:
        await self.open(self.base, 0)
        async for message in self.socket:
            if message.type == WSMsgType.TEXT:
                content = json.loads(message.data)
                self.studio.received.append(content)
                await getattr(self, f"on_{content['type']}")(content)

    async def say(self, kind: str, **content: Any) -> None:
        if not self.studio.held and not self.socket.closed:
            await self.socket.send_str(json.dumps({"type": kind, **content}))

    async def say_binary(self, kind: str, payload: bytes, **content: Any) -> None:
        head = json.dumps({"type": kind, **content}).encode()
        if not self.studio.held and not self.socket.closed:
            await self.socket.send_bytes(len(head).to_bytes(4, "little") + head + payload)

    async def open(self, design: Design, revision: int) -> None:
        self.base = design
        bellows = design.bellows
        sliders = [_slider(design, *each) for each in SLIDERS]
        indent = design.indent.model_dump() if design.indent else None
        await self.say(
            "start", revision=revision, session="pretended", name=design.name, parameters=sliders,
            designs=list(shipped_designs()), materials=["ninjaflex", "filaflex_60a"],
            printers=["prusa_i3", "prusa_mk4"], material=design.material.name,
            printer="prusa_i3", indent=indent, toml=design.to_toml(), version="pretended",
        )  # fmt: skip
        assert bellows.bubble_count > 0
        await self.changed(design, revision)
        await self.on_rest({"revision": revision})

    async def on_open(self, message: Mapping[str, Any]) -> None:
        await self.open(load_design(message["design"]), message["revision"])

    async def on_open_toml(self, message: Mapping[str, Any]) -> None:
        try:
            await self.open(Design.from_toml(message["text"]), message["revision"])
        except DesignError as error:
            await self.say("failed", revision=message["revision"], what="open", message=str(error))

    async def on_change(self, message: Mapping[str, Any]) -> None:
        revision, table = message["revision"], self.base.model_dump()
        for name, value in message["values"].items():
            _put(table, name, value)
        try:
            await self.changed(Design.of(table), revision)
        except DesignError as error:
            self.design = None
            moved = list(message["values"])
            problems = [{"parameter": _concerned(str(error), moved), "message": str(error)}]
            await self.say("problems", revision=revision, problems=problems)

    async def changed(self, design: Design, revision: int) -> None:
        self.design = self.studio._designs[revision] = design
        current = {name: _number(design, name) for name, *_ in SLIDERS}
        await self.say("problems", revision=revision, problems=[], values=current)
        await self.say("lights", revision=revision, source="declared", lights=_lights(design))
        await self.say_binary("shape", shape_of(design, deformed=False), revision=revision)

    async def on_rest(self, message: Mapping[str, Any]) -> None:
        if self.design is None:
            return
        task = asyncio.create_task(self.answer(self.design, message["revision"]))
        self.tasks.add(task)
        task.add_done_callback(self.tasks.discard)

    async def answer(self, design: Design, revision: int) -> None:
        await asyncio.sleep(self.studio.preview_seconds)
        await self.say("answer", **_answer(design, revision, "preview"))
        await self.say_binary(
            "deformed", shape_of(design, deformed=True), revision=revision, state="preview"
        )
        slopes = [
            {"parameter": "load.pressure", "unit": "MPa", "angle_per_unit": angle_of(design) / 0.1,
             "stress_per_unit": stress_of(design) / 0.1},
            {"parameter": "bubble_height", "unit": "mm", "angle_per_unit": angle_of(design) / 20,
             "stress_per_unit": 0.0},
        ]  # fmt: skip
        await self.say("sensitivities", revision=revision, sensitivities=slopes)
        await asyncio.sleep(self.studio.refined_seconds)
        await self.say("lights", revision=revision, source="measured", lights=_lights(design))
        await self.say("answer", **_answer(design, revision, "refined"))

    async def on_scene(self, message: Mapping[str, Any]) -> None:
        line = '<path d="M2 10h36" stroke="#000"/>'
        svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20">{line}</svg>'
        figures = [{"label": "Force", "value": 1.234, "unit": "N", "error_percent": 4.0}]
        await self.say(
            "scene", revision=message["revision"], scene=message["scene"], figures=figures, svg=svg,
            message="at 0.05 MPa it slips.", warnings=["mass_g is large."],
            caption="Darker: later.",
        )  # fmt: skip

    async def on_run(self, message: Mapping[str, Any]) -> None:
        revision = message["revision"]
        await self.say("working", revision=revision, what="run", fraction=0.5)
        files = [{"name": "part.stl", "href": "/exports/part/part.stl"}]
        await self.say("ran", revision=revision, approved=True, reasons=[], files=files)


def _slider(
    design: Design, name: str, group: str, unit: str, least: float, most: float
) -> dict[str, Any]:
    value = _number(design, name)
    automatic = name == "number_of_bubbles" and design.bellows.number_of_bubbles is None
    step = {"mm": 0.1, "MPa": 0.001, "": 1}[unit]
    span = max(abs(value) / 2, 10 * step)
    return {
        "name": name, "label": name.split(".")[-1].replace("_", " ").capitalize(), "unit": unit,
        "lowest": max(least, round(value - span, 3)), "highest": min(most, round(value + span, 3)),
        "step": step, "value": value, "least": least, "most": most, "group": group,
        "meaning": f"what {name} means", "whole": unit == "", "automatic": automatic,
        "optional": name == "number_of_bubbles",
    }  # fmt: skip


def _number(design: Design, name: str) -> float:
    if name == "number_of_bubbles":
        return design.bellows.bubble_count
    return design.load.pressure if "." in name else getattr(design.bellows, name)


def _put(table: dict[str, Any], name: str, value: Any) -> None:
    *parents, last = name.split(".")
    if not parents and last in table["bellows"]:
        parents = ["bellows"]
    for parent in parents:
        table[parent] = dict(table[parent])
        table = table[parent]
    table[last] = value


def _concerned(sentence: str, moved: list[str]) -> str:
    return next((name for name in moved if name in sentence), moved[0] if moved else "")


def _lights(design: Design) -> list[dict[str, Any]]:
    thin = design.bellows.bubble_thickness < 1.2
    wall = {
        "rule": "wall_thickness", "verdict": "fail" if thin else "pass",
        "message": f"{design.bellows.bubble_thickness:g} mm of wall, 1.2 mm are needed",
        "measured": design.bellows.bubble_thickness, "required": 1.2,
    }  # fmt: skip
    return [wall, {"rule": "build_volume", "verdict": "pass", "message": "fits", "measured": 1}]


def _answer(design: Design, revision: int, state: str) -> dict[str, Any]:
    stress = stress_of(design)
    return {
        "revision": revision, "state": state, "pressure_mpa": design.load.pressure,
        "bending_angle_deg": angle_of(design), "angle_error_percent": 2.5,
        "max_von_mises_mpa": stress, "stress_error_percent": 5.0, "stress_limit_mpa": 4.0,
        "cavity_volume_mm3": 9000.0, "converged": True, "warnings": [], "seconds": 0.1,
        "verdict": "pass" if stress <= 4 else "fail",
        "reasons": [] if stress <= 4 else [f"{stress:.3g} MPa exceed the limit of 4 MPa."],
        "how": "made up for tests", "digest": design.digest,
    }  # fmt: skip
