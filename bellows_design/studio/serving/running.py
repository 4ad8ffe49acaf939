"""The studio from its first to its last moment: bound, told of, open until it is ended."""

from __future__ import annotations

import asyncio
import socket
import tempfile
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from aiohttp import web

from bellows_design.errors import DesignError
from bellows_design.studio.serving.app import Studio, application
from bellows_design.studio.serving.security import LOOPBACK, Guard, require_loopback
from bellows_design.studio.sessions.lanes import Lanes

if TYPE_CHECKING:
    from bellows_design.design.design import Design

HIGHEST_PORT = 65535

Told = Callable[[str], None]
"""Is given the address of the page once it can be opened."""


@dataclass(frozen=True)
class Options:
    """How the studio is run.

    Attributes:
        design: The design that is opened first.
        port: 0 for any that is free.
        host: The address that is listened on; any but that of this machine alone is refused.
        browser: Whether a browser is opened.
        output: Folder of approved models.
    """

    design: Design
    port: int = 0
    host: str = LOOPBACK
    browser: bool = True
    output: Path = Path("exports")


def serve(options: Options, told: Told = print) -> None:
    """Serve the page until it is ended: by a signal, or by a page that asks for it.

    Raises ``DesignError`` for an address that others reach or a port that cannot be had.
    """
    with _listening(options) as listener, _store() as store:
        asyncio.run(_serve(options, listener, store, told))


async def _serve(options: Options, listener: socket.socket, store: Path, told: Told) -> None:
    guard = Guard(listener.getsockname()[1])
    lanes = Lanes(store, options.output.absolute())
    studio = Studio(guard, lanes, {"text": options.design.to_toml()})
    runner = web.AppRunner(application(studio), access_log=None, handle_signals=False)
    try:
        lanes.start()
        await runner.setup()
        await web.SockSite(runner, listener).start()
        told(guard.url)
        if options.browser:
            await asyncio.to_thread(webbrowser.open, guard.url)
        await studio.quit.wait()
    finally:
        lanes.close()
        await studio.close()
        await runner.cleanup()


@contextmanager
def _listening(options: Options) -> Iterator[socket.socket]:
    """A socket of this machine alone."""
    require_loopback(options.host)
    if not 0 <= options.port <= HIGHEST_PORT:
        raise DesignError(f"--port is {options.port} but must be 0 to {HIGHEST_PORT}.")
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listener:
        try:
            listener.bind((options.host, options.port))
        except OSError as error:
            raise DesignError(
                f"port {options.port} cannot be had: {error.strerror or error}; leave --port out "
                "for any that is free."
            ) from None
        yield listener


@contextmanager
def _store() -> Iterator[Path]:
    """The user's folder of results; where there is none, one that goes with the studio."""
    from bellows_design.store import NoPlace, cache_folder

    try:
        yield cache_folder()
    except NoPlace:
        with tempfile.TemporaryDirectory(prefix="bellows-studio-") as folder:
            yield Path(folder)
