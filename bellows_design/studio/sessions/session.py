"""One open page: which design it is at, and what is computed for that.

While sliders move, only problems, lights and shape follow. Once they rest there is a preview, then
CAD with its rules, the ordinary evaluation and derivatives, one after the other. Each change makes
all of that stale.
"""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Mapping
from itertools import count
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.studio.protocol import Request, binary_of, text_of
from bellows_design.studio.sessions.lanes import SERVER, Lanes
from bellows_design.studio.sessions.outbox import Outbox
from bellows_design.studio.workers.lane import Arrays, Event, Job, Lane, Outcome

MOST_REVISIONS = 200
"""Whose values are remembered, for downloads."""

STAGES = ("part", "refine", "sensitivities")
"""After the preview, in this order."""

_numbers = count(SERVER + 1)


class Session:
    """What the server knows of one page. All methods are called in the event loop."""

    def __init__(self, lanes: Lanes) -> None:
        self.number = next(_numbers)
        self.key = secrets.token_urlsafe(12)
        self.outbox = Outbox()
        self.files: dict[str, Any] = {}
        self._lanes = lanes
        self._base, self._name = "", ""
        self._revision = -1
        self._values: dict[int, Mapping[str, Any]] = {}
        self._valid = False
        self._follows = False
        self._changing: Job | None = None
        self._chain: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[Any]] = set()

    def receive(self, request: Request) -> None:
        """Do what the page asks for."""
        if request.kind in ("open", "open_toml"):
            self.open(request.content.get("design"), request.content.get("text"), request.revision)
        elif not self._base:
            self.fail("open", "no design is open", request.revision)
        elif request.kind == "change":
            self._change(request.revision, request.content["values"])
        elif request.revision != self._revision:
            return  # of a design that is no more on the sliders
        elif request.kind == "rest":
            self._rest()
        elif request.kind == "scene":
            keys = {key: value for key, value in request.content.items() if key != "scene"}
            self._ask("scene", {"scene": request.content["scene"], "keys": keys})
        elif request.kind == "run":
            self._ask("run", {"output": str(self._lanes.output)})

    def open(self, name: str | None, text: str | None, revision: int) -> None:
        """Open a shipped design by its name, or one written as TOML."""
        self._stale()
        content = {"name": name, "text": text}

        def started(event: Event, _: Arrays) -> None:
            self._started(event, revision)

        job = self._lanes.quick.submit(Job(self.number, "open", "open", content, started))
        self._keep(self._told_if_failed(job, "open", revision))

    def close(self) -> None:
        """The page is gone."""
        for task in self._tasks:
            task.cancel()
        self._follows = False  # of cells that are yet to come nothing is shown here
        self._lanes.forget(self.number)

    def fail(self, what: str, message: str, revision: int | None = None) -> None:
        """Tell the page in a sentence what cannot be."""
        number = self._revision if revision is None else revision
        self._send("failed", number, what=what, message=message)

    async def toml(self, revision: int) -> Mapping[str, Any]:
        """Name and text of the design of a revision. Raises ``DesignError``."""
        if revision not in self._values:
            raise DesignError("this design is no more known: save it from the page again.")
        found: list[Event] = []
        topic, content = f"toml {next(_numbers)}", self._design(revision)
        job = Job(self.number, topic, "toml", content, lambda event, _: found.append(event))
        outcome, why = await _ended(self._lanes.quick.submit(job))
        if not found:
            raise DesignError(why or outcome)
        return found[0]

    def _started(self, event: Event, revision: int) -> None:
        self._base, self._name = event["toml"], event["name"]
        self._values.clear()
        self._revision = revision
        content = {key: value for key, value in event.items() if key != "kind"}
        self._send("start", revision, session=self.key, **content)
        self._change(revision, {})
        self._rest()

    def _change(self, revision: int, values: Mapping[str, Any]) -> None:
        self._stale()
        self._revision, self._valid = revision, False
        self._values[revision] = values
        for old in list(self._values)[:-MOST_REVISIONS]:
            del self._values[old]
        self._changing = self._submit(self._lanes.quick, "change", "change", {})

    def _stale(self) -> None:
        """Nothing that was begun for the design before is needed any more."""
        if self._chain is not None:
            self._chain.cancel()
            self._chain = None
        self._lanes.preview.cancel(self.number)
        self._lanes.background.cancel(self.number)

    def _rest(self) -> None:
        """The page may ask again for what already follows: that goes on."""
        if self._chain is None or self._chain.done():
            self._chain = self._keep(self._follow_up())

    async def _follow_up(self) -> None:
        """All that follows once the sliders rest, as long as the design stays."""
        await self._settled()
        if not self._valid:
            return
        with self._lanes.background.held():
            outcome, why = await _ended(self._submit(self._lanes.preview, "preview", "preview", {}))
        if outcome in ("failed", "crashed"):
            self._send("working", self._revision, what="preview", message=why, fraction=None)
        self._lanes.warm()
        for stage in STAGES:
            outcome, why = await _ended(self._submit(self._lanes.background, stage, stage, {}))
            if outcome in ("failed", "crashed"):
                self.fail(stage, why)

    async def _settled(self) -> None:
        """Wait until problems and shape are known; a cell that comes in between asks anew."""
        awaited = None
        while self._changing is not awaited and self._changing is not None:
            awaited = self._changing
            outcome, why = await _ended(awaited)
            if outcome in ("failed", "crashed"):
                self.fail("change", why)

    def _ask(self, what: str, content: Mapping[str, Any]) -> None:
        job = self._submit(self._lanes.background, what, what, content)
        self._keep(self._told_if_failed(job, what, self._revision))

    def _submit(self, lane: Lane, topic: str, task: str, more: Mapping[str, Any]) -> Job:
        revision = self._revision
        content = {**self._design(revision), "store": str(self._lanes.store), **more}

        def heard(event: Event, arrays: Arrays) -> None:
            self._heard(topic, revision, event, arrays)

        return lane.submit(Job(self.number, topic, task, content, heard))

    def _design(self, revision: int) -> dict[str, Any]:
        """What makes the design of a revision."""
        return {"base": self._base, "values": self._values[revision]}

    async def _told_if_failed(self, job: Job, what: str, revision: int) -> Outcome:
        outcome, why = await _ended(job)
        if outcome in ("failed", "crashed"):
            self.fail(what, why, revision)
        return outcome

    def _heard(self, topic: str, revision: int, event: Event, arrays: Arrays) -> None:
        """Pass on what a job found to the page; note what matters here."""
        content = {key: value for key, value in event.items() if key != "kind"}
        kind = event["kind"]
        if kind == "cell":
            self._heard_of_cells(event, arrays)
            return
        if kind == "evaluated":
            anchor = {**self._design(revision), "record": event["record"]}
            self._lanes.take_anchor(anchor, arrays, self._heard_of_cells)
            return
        if kind == "problems" and revision == self._revision:
            self._valid = not content["problems"]
        if kind in ("shape", "shape_follows") and revision == self._revision:
            self._follows = kind == "shape_follows"
        if kind == "working":
            content["what"] = topic
        if kind == "ran":
            content["files"] = self._offered(content)
            content.pop("folder")
        self._send(kind, revision, arrays.get("payload"), **content)

    def _heard_of_cells(self, event: Event, arrays: Arrays) -> None:
        """Give the mesh of a cell to the process that makes shapes; show one that waited for it."""
        if event["kind"] != "cell":
            return
        content = {key: event[key] for key in ("base", "values", "surfaces")}
        self._lanes.take_cell(content, arrays)
        if self._follows:
            self._changing = self._submit(self._lanes.quick, "change", "change", {})

    def _offered(self, ran: Mapping[str, Any]) -> list[dict[str, str]]:
        """The files of an approved part, to be downloaded from here on."""
        name, folder = ran["name"], ran["folder"]
        for file in ran["files"]:
            self.files[f"{name}/{file}"] = (folder, file)
        return [{"name": file, "href": f"/exports/{name}/{file}"} for file in ran["files"]]

    def _send(self, kind: str, revision: int, payload: Any = None, **content: Any) -> None:
        if payload is None:
            message: str | bytes = text_of(kind, revision=revision, **content)
        else:
            message = binary_of(kind, payload.data, revision=revision, **content)
        self.outbox.put(kind, message)

    def _keep(self, work: Any) -> asyncio.Task[Any]:
        """Run in the loop; a reference is kept, as the loop keeps none."""
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task


async def _ended(job: Job) -> tuple[Outcome, str]:
    """What became of a job. Who no longer waits for it does not end it for others."""
    await asyncio.wait([job.outcome])
    return job.outcome.result()
