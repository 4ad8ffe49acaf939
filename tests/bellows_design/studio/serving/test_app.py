"""Who is let in, what is handed out, and what a page may say; no process computes here."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType, WSServerHandshakeError, web

from bellows_design.errors import DesignError
from bellows_design.studio.protocol import LARGEST_MESSAGE
from bellows_design.studio.serving.app import MOST_PAGES, Studio, application
from bellows_design.studio.serving.security import HEADERS, Guard, require_loopback
from bellows_design.studio.sessions.lanes import Lanes
from bellows_design.studio.workers.lane import Lane

STUB = "stub_tasks"


@asynccontextmanager
async def serving(folder: Path) -> AsyncIterator[Studio]:
    """A studio whose processes are stubs, on a port of its own."""
    lanes = Lanes(folder / "store", folder / "exports", Lane(STUB), Lane(STUB), Lane(STUB))
    studio = Studio(Guard(0), lanes, {"text": ""})
    runner = web.AppRunner(application(studio))
    await runner.setup()
    site = web.TCPSite(runner, "127.0.0.1", 0)
    await site.start()
    port = runner.addresses[0][1]
    await runner.cleanup()
    studio = Studio(Guard(port), lanes, {"text": ""})
    runner = web.AppRunner(application(studio))
    await runner.setup()
    await web.TCPSite(runner, "127.0.0.1", port).start()
    try:
        yield studio
    finally:
        lanes.close()
        await studio.close()
        await runner.cleanup()


def in_loop(folder: Path, check: Callable[[Studio, ClientSession], Awaitable[None]]) -> None:
    async def whole() -> None:
        async with serving(folder) as studio, ClientSession() as client:
            await asyncio.wait_for(check(studio, client), 60)

    asyncio.run(whole())


def address(studio: Studio, path: str) -> str:
    return f"http://127.0.0.1:{studio.guard.port}{path}"


async def status(client: ClientSession, url: str, **headers: str) -> int:
    async with client.get(url, headers=headers, allow_redirects=False) as answer:
        return answer.status


async def raw(studio: Studio, request: str) -> bytes:
    """The first line of the answer to a request as it stands."""
    reader, writer = await asyncio.open_connection("127.0.0.1", studio.guard.port)
    writer.write(request.encode())
    line = await reader.readline()
    writer.close()
    return line


@pytest.mark.parametrize(
    "path", ["/", "/session", "/assets/viewer.js", "/design.toml", "/exports/a/b", "/nothing"]
)
def test_nothing_is_answered_without_the_token(path: str, tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        assert await status(client, address(studio, path)) == 403
        assert await status(client, address(studio, f"{path}?token=wrong")) == 403
        shorter = studio.guard.token[:-1]
        assert await status(client, address(studio, f"{path}?token={shorter}")) == 403

    in_loop(tmp_path, check)


def test_page_sets_a_cookie_that_opens_the_rest_and_that_scripts_cannot_read(
    tmp_path: Path,
) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        async with client.get(studio.guard.url) as answer:
            assert answer.status == 200
            cookie = answer.headers["Set-Cookie"]
            assert "HttpOnly" in cookie and "SameSite=Strict" in cookie
            assert studio.guard.cookie in cookie
        async with ClientSession(cookies={studio.guard.cookie: studio.guard.token}) as other:
            assert await status(other, address(studio, "/assets/viewer.js")) == 200

    in_loop(tmp_path, check)


def test_answers_forbid_foreign_scripts_frames_and_guesses_of_types(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        for url in (studio.guard.url, address(studio, "/")):
            async with client.get(url) as answer:
                policy = answer.headers["Content-Security-Policy"]
                assert "default-src 'none'" in policy and "frame-ancestors 'none'" in policy
                assert "script-src 'self';" in policy and "unsafe" not in policy
                assert answer.headers["X-Content-Type-Options"] == "nosniff"
                assert answer.headers["Referrer-Policy"] == "no-referrer"
                assert answer.headers["Cache-Control"] == "no-store"

    in_loop(tmp_path, check)


@pytest.mark.parametrize("token", ["right", "wrong"])
@pytest.mark.parametrize("path", ["/", "/session", "/nothing", "/assets/viewer.js"])
def test_headers_are_the_same_whatever_is_answered_and_name_no_software(
    path: str, token: str, tmp_path: Path
) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        given = studio.guard.token if token == "right" else token
        upgrade = {
            "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        }  # fmt: skip
        headers = upgrade if path == "/session" else {}
        url = address(studio, f"{path}?token={given}")
        async with client.get(url, headers=headers) as answer:
            assert "Server" not in answer.headers
            for name, value in HEADERS.items():
                assert answer.headers.getall(name) == [value]
            assert len(answer.headers.getall("Content-Security-Policy")) == 1

    in_loop(tmp_path, check)


def test_a_page_too_many_is_told_so_and_takes_the_place_of_one_that_is_closed(
    tmp_path: Path,
) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        socket = address(studio, f"/session?token={studio.guard.token}")
        pages = [await client.ws_connect(socket) for _ in range(MOST_PAGES)]
        async with client.ws_connect(socket) as refused:
            said = await refused.receive()
            assert said.type is WSMsgType.CLOSE
            assert (said.data, "open already" in str(said.extra)) == (1013, True)
        await pages.pop().close()
        async with client.ws_connect(socket) as page:
            assert (await page.receive_json())["type"] == "start"
        for page in pages:
            await page.close()

    in_loop(tmp_path, check)


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "localhost:1", "127.0.0.1.evil.org"])
def test_other_names_for_this_machine_are_refused(host: str, tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        assert await status(client, studio.guard.url, Host=host) == 403

    in_loop(tmp_path, check)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1", "file://"])
def test_pages_of_other_origins_are_refused_also_at_the_websocket(
    origin: str, tmp_path: Path
) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        assert await status(client, studio.guard.url, Origin=origin) == 403
        socket = address(studio, f"/session?token={studio.guard.token}")
        with pytest.raises(WSServerHandshakeError) as refused:
            await client.ws_connect(socket, origin=origin)
        assert refused.value.status == 403

    in_loop(tmp_path, check)


def test_websocket_of_the_page_itself_is_let_in(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        for host in studio.guard.hosts:
            socket = f"http://{host}/session?token={studio.guard.token}"
            async with client.ws_connect(socket, origin=f"http://{host}") as page:
                assert (await page.receive_json())["type"] == "start"

    in_loop(tmp_path, check)


def test_websocket_of_a_name_led_here_is_refused(tmp_path: Path) -> None:
    """DNS rebinding: the page's own origin and host agree, and are not the studio's."""

    async def check(studio: Studio, _: ClientSession) -> None:
        name = f"evil.example:{studio.guard.port}"
        line = await raw(
            studio,
            f"GET /session?token={studio.guard.token} HTTP/1.1\r\nHost: {name}\r\n"
            f"Origin: http://{name}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n",
        )
        assert b" 403 " in line

    in_loop(tmp_path, check)


def test_requests_without_a_host_or_with_two_are_refused(tmp_path: Path) -> None:
    async def check(studio: Studio, _: ClientSession) -> None:
        start, host = f"GET /?token={studio.guard.token} HTTP/1.1\r\n", studio.guard.hosts[0]
        none = await raw(studio, f"{start}\r\n")
        two = await raw(studio, f"{start}Host: {host}\r\nHost: evil.example\r\n\r\n")
        for line in (none, two):
            assert b" 403 " in line or b" 400 " in line

    in_loop(tmp_path, check)


@pytest.mark.parametrize(
    "path",
    [
        "/assets/../serving/security.py",
        "/assets/%2e%2e/serving/security.py",
        "/assets/page/../../protocol.py",
        "/assets/..%2f..%2f..%2fetc%2fpasswd",
        "/assets//etc/passwd",
        "/assets/page/index.html%00.js",
        "/exports/../../etc/passwd",
        "/exports/%2e%2e/%2e%2e%2fetc%2fpasswd",
        "/exports/a/..%2fb",
    ],
)
def test_no_path_leads_out_of_what_is_handed_out(path: str, tmp_path: Path) -> None:
    async def check(studio: Studio, _: ClientSession) -> None:
        host, token = studio.guard.hosts[0], studio.guard.token
        line = await raw(studio, f"GET {path}?token={token} HTTP/1.1\r\nHost: {host}\r\n\r\n")
        assert b" 404 " in line or b" 400 " in line

    in_loop(tmp_path, check)


def test_files_of_a_run_are_handed_out_by_name_and_links_are_not(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        folder = tmp_path / "exports" / "part"
        folder.mkdir(parents=True)
        (folder / "part.stl").write_bytes(b"solid")
        (folder / "link").symlink_to("/etc/passwd")
        (folder / "secret").write_text("not offered")
        token = studio.guard.token
        async with client.ws_connect(address(studio, f"/session?token={token}")) as page:
            await page.receive()
            session = next(iter(studio.sessions.values()))
            ran = {"name": "part", "folder": str(folder), "files": ["part.stl", "link"]}
            session._offered(ran)
            async with client.get(address(studio, f"/exports/part/part.stl?token={token}")) as file:
                assert file.status == 200 and await file.read() == b"solid"
                assert "attachment" in file.headers["Content-Disposition"]
                assert "Content-Security-Policy" in file.headers
            for name in ("link", "secret"):
                assert (
                    await status(client, address(studio, f"/exports/part/{name}?token={token}"))
                    == 404
                )

    in_loop(tmp_path, check)


async def heard(page: ClientWebSocketResponse, kind: str) -> dict[str, Any]:
    """The next message of a kind."""
    while True:
        message = await page.receive(30)
        assert message.type in (WSMsgType.TEXT, WSMsgType.BINARY), message
        if message.type is WSMsgType.TEXT:
            found = json.loads(message.data)
            if found["type"] == kind:
                return dict(found)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "nonsense",
        "[]",
        '{"type": "eval"}',
        '{"type": "change"}',
        '{"type": "change", "revision": -1, "values": {}}',
        '{"type": "change", "revision": true, "values": {}}',
        '{"type": "change", "revision": 1, "values": []}',
        '{"type": "open", "design": 3}',
        '{"type": "open_toml"}',
        '{"type": "rest", "revision": 1e400}',
        "[" * 100_000,
    ],
)
def test_what_is_no_message_is_answered_by_a_sentence(text: str, tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        socket = address(studio, f"/session?token={studio.guard.token}")
        async with client.ws_connect(socket) as page:
            await page.send_str(text)
            found = await heard(page, "failed")
            assert found["what"] == "message" and found["message"]

    in_loop(tmp_path, check)


def test_messages_beyond_the_limit_end_the_connection_and_not_the_server(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        socket = address(studio, f"/session?token={studio.guard.token}")
        async with client.ws_connect(socket) as page:
            await page.send_str("x" * (LARGEST_MESSAGE + 1))
            while (message := await page.receive(30)).type in (WSMsgType.TEXT, WSMsgType.BINARY):
                pass
            assert message.type in (WSMsgType.CLOSE, WSMsgType.CLOSED)
        assert await status(client, studio.guard.url) == 200

    in_loop(tmp_path, check)


def test_binary_messages_end_the_connection(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        socket = address(studio, f"/session?token={studio.guard.token}")
        async with client.ws_connect(socket) as page:
            await page.send_bytes(b"\x80\x04cos\nsystem\n")
            while (message := await page.receive(30)).type in (WSMsgType.TEXT, WSMsgType.BINARY):
                pass
            assert page.close_code == 1003 or message.type is WSMsgType.CLOSED

    in_loop(tmp_path, check)


def test_design_of_a_revision_is_saved_as_it_was_then(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        token = studio.guard.token
        async with client.ws_connect(address(studio, f"/session?token={token}")) as page:
            start = await heard(page, "start")
            for revision, name in ((1, "length"), (2, "offset")):
                change = {"type": "change", "revision": revision, "values": {name: 1}}
                await page.send_json(change)
            await heard(page, "problems")
            place = f"/design.toml?token={token}&session={start['session']}&revision="
            async with client.get(address(studio, f"{place}1")) as saved:
                assert await saved.text() == "values = ['length']"
                assert 'filename="stub.toml"' in saved.headers["Content-Disposition"]
            for revision, expected in (("9", 409), ("-1", 404), ("x", 404)):
                assert await status(client, address(studio, place + revision)) == expected
            assert await status(client, address(studio, f"/design.toml?token={token}")) == 404

    in_loop(tmp_path, check)


def test_server_goes_on_after_the_last_page_and_ends_when_a_page_asks(tmp_path: Path) -> None:
    async def check(studio: Studio, client: ClientSession) -> None:
        socket = address(studio, f"/session?token={studio.guard.token}")
        async with client.ws_connect(socket) as page:
            await page.receive()
        await asyncio.sleep(0.1)
        assert not studio.sessions and not studio.quit.is_set()
        async with client.ws_connect(socket) as page:
            await page.send_json({"type": "quit"})
            await asyncio.wait_for(studio.quit.wait(), 10)

    in_loop(tmp_path, check)


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.7", "localhost", "", "example.org"])
def test_addresses_that_others_reach_are_not_listened_on(host: str) -> None:
    with pytest.raises(DesignError, match="only"):
        require_loopback(host)


def test_each_run_has_a_token_of_its_own_that_is_long_and_not_shown_by_accident() -> None:
    one, other = Guard(1), Guard(1)
    assert one.token != other.token and len(one.token) >= 43
    assert one.token not in repr(one)
