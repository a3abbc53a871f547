"""What `view` answers: packed where that is smaller, and kept by the browser by what it holds."""

from __future__ import annotations

import asyncio
import gzip
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from starlette.types import ASGIApp

from veduta.run.errors import InputError
from veduta.studio.app import make_app
from veduta.studio.server import view_of

WORDS = b"const place = 'here';\n" * 200


@dataclass(frozen=True)
class Answer:
    status: int
    headers: dict[str, str]
    content: bytes


@dataclass(frozen=True)
class Client:
    """A browser of this machine that packs and unpacks nothing by itself."""

    app: ASGIApp

    def get(self, path: str, **headers: str) -> Answer:
        told = {"host": "127.0.0.1", "accept-encoding": "gzip"} | {
            name.replace("_", "-"): value for name, value in headers.items()
        }
        scope = {
            "type": "http", "method": "GET", "path": path, "raw_path": path.encode(),
            "root_path": "", "query_string": b"", "scheme": "http", "http_version": "1.1",
            "headers": [(name.encode(), value.encode()) for name, value in told.items()],
        }  # fmt: skip
        sent: list[Any] = []

        async def receive() -> Any:
            await asyncio.Event().wait()  # the browser stays

        async def send(message: Any) -> None:
            sent.append(message)

        asyncio.run(self.app(scope, receive, send))
        heads = {name.decode(): value.decode() for name, value in sent[0]["headers"]}
        body = b"".join(message.get("body", b"") for message in sent[1:])
        return Answer(sent[0]["status"], heads, body)


@pytest.fixture
def client(tmp_path: Path) -> Client:
    static, place = tmp_path / "static", tmp_path / "place"
    (static / "assets").mkdir(parents=True)
    place.mkdir()
    (static / "index.html").write_text("<html></html>")
    (static / "assets" / "three-1234.js").write_bytes(WORDS)
    (place / "place.json").write_bytes(WORDS)
    (place / "photo.jpg").write_bytes(WORDS)
    (place / "short.json").write_text("{}")
    return Client(make_app(static, place, None))


def test_text_is_packed_and_comes_back(client: Client) -> None:
    answer = client.get("/place/place.json")
    assert answer.headers["content-encoding"] == "gzip"
    assert int(answer.headers["content-length"]) == len(answer.content) < len(WORDS) / 10
    assert gzip.decompress(answer.content) == WORDS


@pytest.mark.parametrize("path", ["/place/photo.jpg", "/place/short.json"])
def test_what_does_not_gain_is_sent_as_it_is(client: Client, path: str) -> None:
    assert "content-encoding" not in client.get(path).headers


def test_who_takes_no_gzip_gets_none(client: Client) -> None:
    assert client.get("/place/place.json", accept_encoding="identity").content == WORDS


def test_a_part_of_a_file_is_of_the_file_itself(client: Client) -> None:
    answer = client.get("/place/place.json", range="bytes=0-4")
    assert (answer.status, answer.content) == (206, WORDS[:5])


def test_names_with_digests_are_kept_for_good_and_others_asked_after(client: Client) -> None:
    assert "immutable" in client.get("/assets/three-1234.js").headers["cache-control"]
    assert client.get("/place/place.json").headers["cache-control"] == "no-cache"


def test_a_file_that_the_browser_has_is_not_sent_again(client: Client, tmp_path: Path) -> None:
    tag = client.get("/place/place.json").headers["etag"]
    again = client.get("/place/place.json", if_none_match=tag)
    assert (again.status, again.content) == (304, b"")
    (tmp_path / "place" / "place.json").write_bytes(WORDS[::-1])
    changed = client.get("/place/place.json", if_none_match=tag)
    assert changed.status == 200
    assert changed.headers["etag"] != tag


@pytest.mark.parametrize("name", [".veduta/record.json", "../secret.json"])
def test_what_is_hidden_stays_so(client: Client, tmp_path: Path, name: str) -> None:
    hidden = tmp_path / "place" / name
    hidden.parent.mkdir(exist_ok=True)
    hidden.write_bytes(WORDS)
    assert client.get(f"/place/{name}").status == 404


def test_a_view_is_taken_from_a_link() -> None:
    assert view_of(None) == ""
    assert view_of("mode=walk&eye=1,2,3") == "#mode=walk&eye=1,2,3"
    assert view_of("http://127.0.0.1:1/?place=place/#mode=walk") == "#mode=walk"


@pytest.mark.parametrize("link", ["", "http://127.0.0.1/", "#", "<b>=1", "mode"])
def test_a_link_without_a_view_is_refused(link: str) -> None:
    with pytest.raises(InputError, match="--at"):
        view_of(link)
