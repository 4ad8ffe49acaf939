"""Who may talk to the studio: only this machine's browser, with the token of this run.

A page of another site can make a browser send requests to this machine. It knows no token, cannot
read the cookie and does not get one sent (``SameSite=Strict``), and names itself in ``Origin``. One
whose name is made to lead here (DNS rebinding) gives that name in ``Host``. All are refused.
"""

from __future__ import annotations

import secrets
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

from aiohttp import web

from bellows_design.errors import DesignError

LOOPBACK = "127.0.0.1"
"""The one address that is listened on."""

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


@dataclass(frozen=True)
class Guard:
    """The token and the port of a run."""

    port: int
    token: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)

    @property
    def url(self) -> str:
        """The address of the page, token included."""
        return f"http://{LOOPBACK}:{self.port}/?token={self.token}"

    @property
    def cookie(self) -> str:
        """Name of the cookie. Browsers share cookies among the ports of a machine."""
        return f"bellows_studio_{self.port}"

    @property
    def hosts(self) -> tuple[str, ...]:
        """What ``Host`` may be."""
        return f"{LOOPBACK}:{self.port}", f"localhost:{self.port}"

    def refusal(self, request: web.Request) -> str:
        """Why a request is refused; empty if it is not."""
        if request.headers.getall("Host", []) not in [[host] for host in self.hosts]:
            return "this address is not the studio's"
        origins = request.headers.getall("Origin", [])
        if any(origin not in [f"http://{host}" for host in self.hosts] for origin in origins):
            return "requests of other pages are refused"
        if not self._knows_token(request):
            return "the token is missing or wrong: open the address that bellows studio printed"
        return ""

    def _knows_token(self, request: web.Request) -> bool:
        given = [*request.query.getall("token", []), request.cookies.get(self.cookie, "")]
        return any(secrets.compare_digest(_bytes(each), _bytes(self.token)) for each in given)


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def require_loopback(host: str) -> None:
    """Raise ``DesignError`` for any other address: other machines may reach it."""
    if host != LOOPBACK:
        raise DesignError(
            f"the studio listens on {LOOPBACK} only, not on {host[:60]!r}: other machines would "
            "reach it; use a tunnel (ssh -L) from there."
        )


def guarding(guard: Guard) -> Callable[..., Awaitable[web.StreamResponse]]:
    """Middleware that refuses what ``guard`` refuses; errors of handlers are plain text."""

    @web.middleware
    async def guarded(request: web.Request, handler: Handler) -> web.StreamResponse:
        why = guard.refusal(request)
        if why:
            return web.Response(status=403, text=f"Refused: {why}.\n")
        try:
            return await handler(request)
        except web.HTTPException as error:
            return web.Response(status=error.status, text=f"{error.reason}\n")

    return guarded


def with_headers(
    guard: Guard,
) -> Callable[[web.Request, web.StreamResponse], Awaitable[None]]:
    """What sets the headers of every answer, that of the websocket included, before it is sent."""
    headers = HEADERS | {"Content-Security-Policy": _content_policy(guard)}

    async def set_headers(_: web.Request, response: web.StreamResponse) -> None:
        response.headers.update(headers)
        response.headers.pop("Server", None)

    return set_headers


def _content_policy(guard: Guard) -> str:
    """Scripts, styles and connections of this server alone."""
    sockets = " ".join(f"ws://{host}" for host in guard.hosts)
    return "; ".join(
        (
            "default-src 'none'",
            "script-src 'self'",
            "style-src 'self'",
            "img-src 'self' data: blob:",
            "font-src 'self'",
            f"connect-src 'self' {sockets}",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        )
    )


HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Of every answer."""
