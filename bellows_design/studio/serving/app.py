"""Pages, files and the websocket."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from aiohttp import WSCloseCode, WSMsgType, web

from bellows_design.errors import BellowsError, DesignError
from bellows_design.studio.protocol import LARGEST_MESSAGE, request_of
from bellows_design.studio.serving.assets import INDEX, Asset, assets
from bellows_design.studio.serving.security import Guard, guarding, with_headers
from bellows_design.studio.sessions.lanes import Lanes
from bellows_design.studio.sessions.session import Session

HEARTBEAT = 20.0
"""s. A page that does not answer for so long is gone."""

MOST_PAGES = 8
"""Open at once; each may keep two processors busy."""

FULL = b"%d pages of this studio are open already: close one of them" % MOST_PAGES

CLOSING = 1.0
"""s. So long an open page may take to say goodbye."""


@dataclass
class Studio:
    """What the handlers share: who may come, who computes, what is opened first, who is here.

    ``quit`` is set when a page asks for the end.
    """

    guard: Guard
    lanes: Lanes
    first: Mapping[str, str | None]
    assets: Mapping[str, Asset] = field(default_factory=assets)
    sessions: dict[str, Session] = field(default_factory=dict)
    quit: asyncio.Event = field(default_factory=asyncio.Event)
    sockets: set[web.WebSocketResponse] = field(default_factory=set)

    async def page(self, _: web.Request) -> web.Response:
        """The page; from now on the browser has the cookie."""
        response = _response(self.assets[INDEX])
        guard = self.guard
        response.set_cookie(guard.cookie, guard.token, httponly=True, samesite="Strict", path="/")
        return response

    async def asset(self, request: web.Request) -> web.Response:
        """A file of the page."""
        found = self.assets.get(request.match_info["name"])
        if found is None:
            raise web.HTTPNotFound
        return _response(found)

    async def design(self, request: web.Request) -> web.Response:
        """The design of a page's revision as TOML."""
        session = self.sessions.get(request.query.get("session", ""))
        revision = request.query.get("revision", "")
        if session is None or not (revision.isascii() and revision.isdigit()):
            raise web.HTTPNotFound
        try:
            saved = await session.toml(int(revision[:16]))
        except DesignError as error:
            return web.Response(status=409, text=f"{error}\n")
        headers = {"Content-Disposition": f'attachment; filename="{saved["name"]}.toml"'}
        return web.Response(text=saved["text"], content_type="application/toml", headers=headers)

    async def export(self, request: web.Request) -> web.StreamResponse:
        """A file of a part that was approved here."""
        wanted = f"{request.match_info['name']}/{request.match_info['file']}"
        for session in self.sessions.values():
            if wanted in session.files:
                folder, file = session.files[wanted]
                return _download(Path(folder) / file)
        raise web.HTTPNotFound

    async def session(self, request: web.Request) -> web.StreamResponse:
        """The websocket of one page."""
        socket = web.WebSocketResponse(
            max_msg_size=LARGEST_MESSAGE, heartbeat=HEARTBEAT, timeout=CLOSING
        )
        await socket.prepare(request)
        if len(self.sessions) >= MOST_PAGES:  # the reason of a refused handshake reaches no page
            await socket.close(code=WSCloseCode.TRY_AGAIN_LATER, message=FULL)
            return socket
        session = Session(self.lanes)
        self.sessions[session.key] = session
        self.sockets.add(socket)
        writer = asyncio.get_running_loop().create_task(_write(socket, session))
        try:
            session.open(self.first.get("name"), self.first.get("text"), 0)
            await self._read(socket, session)
        finally:
            writer.cancel()
            session.close()
            self.sockets.discard(socket)
            del self.sessions[session.key]
        return socket

    async def _read(self, socket: web.WebSocketResponse, session: Session) -> None:
        async for message in socket:
            if message.type is not WSMsgType.TEXT:
                await socket.close(code=WSCloseCode.UNSUPPORTED_DATA, message=b"text only")
                return
            try:
                request = request_of(message.data)
            except BellowsError as error:
                session.fail("message", str(error))
                continue
            if request.kind == "quit":
                self.quit.set()
            else:
                session.receive(request)

    async def close(self) -> None:
        """Say goodbye to the pages."""
        for socket in tuple(self.sockets):
            with suppress(ConnectionError):
                await socket.close(code=WSCloseCode.GOING_AWAY, message=b"the studio ends")


def application(studio: Studio) -> web.Application:
    """All routes behind the guard."""
    app = web.Application(middlewares=[guarding(studio.guard)], client_max_size=LARGEST_MESSAGE)
    app.on_response_prepare.append(with_headers(studio.guard))
    app.add_routes(
        [
            web.get("/", studio.page),
            web.get("/session", studio.session),
            web.get("/design.toml", studio.design),
            web.get("/assets/{name:.+}", studio.asset),
            web.get("/exports/{name}/{file}", studio.export),
        ]
    )
    return app


async def _write(socket: web.WebSocketResponse, session: Session) -> None:
    with suppress(ConnectionError):
        while not socket.closed:
            message = await session.outbox.get()
            if isinstance(message, str):
                await socket.send_str(message)
            else:
                await socket.send_bytes(message)


def _response(asset: Asset) -> web.Response:
    return web.Response(body=asset.content, content_type=asset.kind, charset="utf-8")


def _download(path: Path) -> web.StreamResponse:
    if path.is_symlink() or not path.is_file():
        raise web.HTTPNotFound
    headers = {"Content-Disposition": f'attachment; filename="{path.name}"'}
    return web.FileResponse(path, headers=headers)
