"""Who may talk to the server, and what pages among a place may do."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message

from veduta.studio.app import make_app

HERE = [("host", "127.0.0.1:8000")]


def answer(app: ASGIApp, path: str, headers: list[tuple[str, str]]) -> tuple[int, Headers]:
    """Status and headers of what the application says to a request."""
    name, _, query = path.partition("?")
    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": "GET",
        "scheme": "http",
        "path": name,
        "raw_path": name.encode(),
        "root_path": "",
        "query_string": query.encode(),
        "headers": [(key.encode(), value.encode("latin-1")) for key, value in headers],
        "client": ("127.0.0.1", 1),
        "server": ("127.0.0.1", 8000),
    }
    said: list[Message] = []

    async def receive() -> Message:
        kind = "http.disconnect" if said else "http.request"
        await asyncio.sleep(0)
        return {"type": kind, "body": b"", "more_body": False}

    async def send(message: Message) -> None:
        said.append(message)

    asyncio.run(app(scope, receive, send))
    return said[0]["status"], Headers(raw=said[0]["headers"])


@pytest.fixture
def app(tmp_path: Path) -> ASGIApp:
    static, place = tmp_path / "static", tmp_path / "place"
    (static / "assets").mkdir(parents=True)
    (static / "index.html").write_text("<p>studio")
    place.mkdir()
    (place / "report.html").write_text("<script>alert(1)</script>")
    return make_app(static, place, None)


@pytest.mark.parametrize(
    "host", ["localhost", "LOCALHOST:80", "127.0.0.1", "127.0.0.1:8000", "127.8.9.1", "[::1]:9"]
)
def test_this_machine_by_any_of_its_names(host: str, app: ASGIApp) -> None:
    assert answer(app, "/?place=place/", [("host", host)])[0] == 200


@pytest.mark.parametrize(
    "host",
    [
        "",
        "evil.example",
        "localhost.evil.example",
        "127.0.0.1.evil.example",
        "localhost:evil.example",
        "localhost:80:80",
        "localhost:",
        "localhost@evil.example",
        "[::1",
        "[::1]evil.example",
        "[::1%25evil]",
        "::1",
        "2130706433",
        "0.0.0.0",
        "127.0.0.1 ",
    ],
)
def test_other_hosts_are_refused(host: str, app: ASGIApp) -> None:
    assert answer(app, "/?place=place/", [("host", host)])[0] == 403


def test_two_hosts_are_refused(app: ASGIApp) -> None:
    headers = [("host", "localhost"), ("host", "evil.example")]
    assert answer(app, "/?place=place/", headers)[0] == 403
    assert answer(app, "/?place=place/", [])[0] == 403


def test_pages_among_a_place_run_nothing(app: ASGIApp) -> None:
    policy = answer(app, "/place/report.html", HERE)[1]["content-security-policy"]
    assert "default-src 'none'" in policy
    assert policy.endswith("sandbox")
    assert "script-src" not in policy
    assert "content-security-policy" not in answer(app, "/?place=place/", HERE)[1]
