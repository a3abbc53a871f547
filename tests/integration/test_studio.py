"""The studio from outside: `veduta view`, `veduta export`, and what Chromium makes of them."""

from __future__ import annotations

import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from sample_document import sample_document, sample_photo

from veduta.facade.model import build_part
from veduta.formats.gltf import write_glb
from veduta.formats.place_json import write_place
from veduta.place.about import AboutOptions
from veduta.place.manifest import Bounds, Place, PlacePart, Start
from veduta.run.errors import InputError
from veduta.studio.card import CardOptions
from veduta.studio.content import STATIC
from veduta.studio.export import RECORD, export_web

CHROMIUM = Path(os.environ.get("CHROMIUM", "/usr/bin/chromium"))
VIEW = "import sys; from veduta.cli.view import run; sys.exit(run(sys.argv[1:]))"

pytestmark = pytest.mark.skipif(
    not (STATIC / "index.html").is_file(),
    reason="the studio has not been built: run `make studio`",
)
needs_chromium = pytest.mark.skipif(
    not CHROMIUM.is_file(),
    reason=f'no Chromium at {CHROMIUM}: install the package "chromium", or set CHROMIUM',
)


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a place that Veduta's own writers made: the sample building."""
    from PIL import Image

    folder = tmp_path_factory.mktemp("place")
    document = sample_document()
    pixels = sample_photo(document)
    part = build_part(document, pixels, "sample")
    (folder / "sample").mkdir()
    write_glb(part, folder / "sample" / "model.glb")
    Image.fromarray(pixels).save(folder / "sample" / "rectified.jpg")
    low, high = part.bounds_m
    entry = PlacePart(
        id="sample",
        name="Sample",
        model="sample/model.glb",
        photo="sample/rectified.jpg",
        arrangement="single",
        bounds=Bounds(min=low, max=high),
    )
    middle = high[0] / 2
    start = Start(eye=(middle, -12.0, 1.7), target=(middle, 0.0, 3.0))
    write_place(Place(parts=[entry], start=start), folder / "place.json")
    (folder / ".veduta").mkdir()
    (folder / ".veduta" / "secret").write_text("not for visitors")
    return folder


@contextmanager
def viewed(place: Path, *arguments: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run `veduta view`; gives the process and the address that it prints."""
    command = [sys.executable, "-c", VIEW, str(place), "--no-browser", *arguments]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        url = re.search(r"http://\S+", process.stdout.readline())
        assert url is not None
        yield process, url.group()
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate(timeout=10)


def get(
    url: str, path: str, headers: dict[str, str] | None = None, method: str = "GET"
) -> tuple[int, dict[str, str], bytes]:
    """Ask for a path exactly as it is written, without anybody tidying it."""
    host, port = url.split("/")[2].rsplit(":", 1)
    connection = http.client.HTTPConnection(host.strip("[]"), int(port), timeout=10)
    connection.request(method, path, headers=headers or {})
    response = connection.getresponse()
    body = response.read()
    connection.close()
    return response.status, {k.lower(): v for k, v in response.getheaders()}, body


def show_in_chromium(
    repository: Path, test: str, variable: str, url: str, timeout_s: int = 240
) -> None:
    """Run the studio's browser test of this name, which finds the address in the variable."""
    npm = shutil.which("npm")
    assert npm is not None, "npm is missing"
    done = subprocess.run(
        [npm, "run", "--silent", "test:browser", "--", test],
        cwd=repository / "studio",
        env={**os.environ, variable: url, "CHROMIUM": str(CHROMIUM)},
        capture_output=True,
        text=True,
        timeout=timeout_s,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 passed" in done.stdout, done.stdout


class TestView:
    """`veduta view`."""

    def test_serves_the_page_and_the_place(self, place: Path) -> None:
        with viewed(place) as (_, url):
            assert url.startswith("http://127.0.0.1:")
            status, headers, body = get(url, "/?place=place/")
            assert (status, headers["x-content-type-options"]) == (200, "nosniff")
            assert b"veduta-studio" in body
            assert b"default-src &#39;self&#39;" in body or b"default-src 'self'" in body
            status, headers, body = get(url, "/place/sample/model.glb")
            assert (status, headers["content-type"]) == (200, "model/gltf-binary")
            assert body == (place / "sample" / "model.glb").read_bytes()
            status, headers, _ = get(url, "/")
            assert (status, headers["location"]) == (307, "/?place=place/")

    def test_cannot_be_led_out_of_the_place(self, place: Path, tmp_path: Path) -> None:
        (tmp_path / "secret.txt").write_text("secret")
        link = place / "sample" / "link.txt"
        link.symlink_to(tmp_path / "secret.txt")
        paths = [
            "/place/../secret.txt",
            "/place/..%2f..%2fsecret.txt",
            "/place/%2e%2e/%2e%2e/etc/passwd",
            "/place//etc/passwd",
            "/place/%2fetc/passwd",
            "/place/sample/..\\..\\secret.txt",
            "/place/sample/link.txt",
            "/place/.veduta/secret",
            "/place/%2eveduta/secret",
            "/place/sample/model.glb%00.json",
            "/../../../../etc/passwd",
            "/place/",
            "/docs",
            "/openapi.json",
        ]
        try:
            with viewed(place) as (_, url):
                for path in paths:
                    status, _, body = get(url, path)
                    assert status in (400, 404), path
                    assert b"secret" not in body
                    assert b"root:" not in body
        finally:
            link.unlink()

    def test_only_reads(self, place: Path) -> None:
        with viewed(place) as (_, url):
            for method in ("POST", "PUT", "DELETE", "PATCH"):
                status, _, _ = get(url, "/place/place.json", method=method)
                assert status == 405

    def test_answers_this_machine_only(self, place: Path) -> None:
        with viewed(place) as (_, url):
            assert get(url, "/place/place.json", {"Host": "localhost:80"})[0] == 200
            assert get(url, "/place/place.json", {"Host": "evil.example"})[0] == 403
            assert get(url, "/place/place.json", {"Host": "127.0.0.1.evil.example"})[0] == 403

    def test_asks_others_for_the_token(self, place: Path) -> None:
        with viewed(place, "--host", "0.0.0.0") as (_, url):
            token = url.partition("token=")[2]
            assert len(token) >= 32
            local = f"http://127.0.0.1:{url.split('/')[2].rsplit(':', 1)[1]}/"
            assert get(local, "/place/place.json")[0] == 401
            assert get(local, "/?place=place/&token=wrong")[0] == 401
            status, headers, _ = get(local, f"/?place=place/&token={token}")
            assert (status, headers["location"]) == (303, "/?place=place/")
            assert "httponly" in headers["set-cookie"].lower()
            cookie = {"Cookie": headers["set-cookie"].partition(";")[0]}
            assert get(local, "/place/place.json", cookie)[0] == 200
            status, headers, _ = get(local, f"//evil.example/?token={token}")
            assert not headers["location"].startswith("//")

    def test_ends_on_ctrl_c(self, place: Path) -> None:
        with viewed(place) as (process, url):
            assert get(url, "/place/place.json")[0] == 200
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=10)
            assert process.returncode == 0
            assert "Stopped" in output

    def test_says_what_is_wrong(self, place: Path, tmp_path: Path) -> None:
        from veduta.cli.view import run

        with pytest.raises(InputError, match="no place"):
            run([str(tmp_path), "--no-browser"])
        with pytest.raises(InputError, match="no such folder"):
            run([str(tmp_path / "nowhere"), "--no-browser"])
        with viewed(place) as (_, url):
            port = url.split(":")[2].partition("/")[0]
            with pytest.raises(InputError, match="another program listens there"):
                run([str(place), "--no-browser", "--port", port])
        with pytest.raises(InputError, match="no address of this machine"):
            run([str(place), "--no-browser", "--host", "203.0.113.7"])

    @pytest.mark.browser
    @needs_chromium
    def test_is_seen_in_chromium(self, place: Path, repository: Path) -> None:
        with viewed(place) as (_, url):
            show_in_chromium(repository, "served", "VEDUTA_STUDIO_URL", url)


class TestExport:
    """`veduta export`."""

    def test_holds_the_studio_and_the_place(self, place: Path, tmp_path: Path) -> None:
        web = tmp_path / "web"
        result = export_web(place, web)
        assert result.written
        names = {path.relative_to(web).as_posix() for path in web.rglob("*") if path.is_file()}
        assert {"index.html", "place.json", "sample/model.glb", "sample/rectified.jpg"} <= names
        assert not any(".veduta" in name for name in names)
        recorded = json.loads((web / RECORD).read_text())["files"]
        assert set(recorded) == names - {RECORD}
        assert not export_web(place, web).written

    def test_says_what_is_given_of_the_place(self, place: Path, tmp_path: Path) -> None:
        web, picture = tmp_path / "web", place / "sample" / "rectified.jpg"
        about = AboutOptions(title="The square", licence="CC0-1.0")
        export_web(place, web, about=about, card=CardOptions(picture=picture))
        manifest = json.loads((web / "place.json").read_text())
        assert (manifest["title"], manifest["licence"]) == ("The square", "CC0-1.0")
        assert "title" not in json.loads((place / "place.json").read_text())
        page = (web / "index.html").read_text()
        assert "<title>The square · Veduta</title>" in page
        assert 'content="card.jpg"' in page
        assert "Content-Security-Policy" in page
        assert (web / "card.jpg").stat().st_size > 1000
        assert "card.jpg" in json.loads((web / RECORD).read_text())["files"]

    def test_refuses_a_folder_of_others(self, place: Path, tmp_path: Path) -> None:
        (tmp_path / "thesis.txt").write_text("years of work")
        for force in (False, True):
            with pytest.raises(InputError, match="not empty"):
                export_web(place, tmp_path, force=force)
        assert (tmp_path / "thesis.txt").read_text() == "years of work"

    def test_replaces_its_own_only_when_told(self, place: Path, tmp_path: Path) -> None:
        other = tmp_path / "other"
        shutil.copytree(place, other)
        (other / "sample" / "rectified.jpg").write_bytes(b"another photo")
        web = tmp_path / "web"
        export_web(place, web)
        with pytest.raises(InputError, match="--force"):
            export_web(other, web)
        assert export_web(other, web, force=True).written
        assert (web / "sample" / "rectified.jpg").read_bytes() == b"another photo"
        assert sorted(path.name for path in tmp_path.iterdir()) == ["other", "web"]

    def test_never_replaces_what_was_edited(self, place: Path, tmp_path: Path) -> None:
        web = tmp_path / "web"
        export_web(place, web)
        (web / "index.html").write_text("my own page")
        with pytest.raises(InputError, match=r"index\.html"):
            export_web(place, web, force=True)
        assert (web / "index.html").read_text() == "my own page"

    def test_a_failed_replacement_leaves_the_old_one(
        self, place: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        other = tmp_path / "other"
        shutil.copytree(place, other)
        (other / "sample" / "rectified.jpg").write_bytes(b"another photo")
        web = tmp_path / "web"
        export_web(place, web)

        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(shutil, "copyfile", full)
        with pytest.raises(OSError, match="No space"):
            export_web(other, web, force=True)
        monkeypatch.undo()
        assert not export_web(place, web).written
        assert sorted(path.name for path in tmp_path.iterdir()) == ["other", "web"]

    def test_refuses_to_publish_what_a_link_leads_to(self, place: Path, tmp_path: Path) -> None:
        other = tmp_path / "other"
        shutil.copytree(place, other)
        (tmp_path / "secret").write_text("secret")
        (other / "sample" / "rectified.jpg").unlink()
        (other / "sample" / "rectified.jpg").symlink_to(tmp_path / "secret")
        with pytest.raises(InputError, match="outside"):
            export_web(other, tmp_path / "web")

    @pytest.mark.parametrize("inner", ["web", "."])
    def test_refuses_a_folder_in_the_place(self, place: Path, inner: str) -> None:
        with pytest.raises(InputError, match="in one another"):
            export_web(place, place / inner)

    def test_names_a_model_that_is_missing(self, place: Path, tmp_path: Path) -> None:
        other = tmp_path / "other"
        shutil.copytree(place, other)
        (other / "sample" / "model.glb").unlink()
        with pytest.raises(InputError, match=r"model\.glb"):
            export_web(other, tmp_path / "web")

    @pytest.mark.browser
    @needs_chromium
    def test_is_seen_in_chromium_from_a_plain_server(
        self, place: Path, tmp_path: Path, repository: Path
    ) -> None:
        web = tmp_path / "below" / "web"
        web.parent.mkdir()
        export_web(place, web)
        handler = partial(SimpleHTTPRequestHandler, directory=str(tmp_path))
        with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            try:
                show_in_chromium(
                    repository,
                    "served",
                    "VEDUTA_STUDIO_URL",
                    f"http://127.0.0.1:{server.server_address[1]}/below/web/",
                )
            finally:
                server.shutdown()


def test_types_are_up_to_date(repository: Path) -> None:
    """The TypeScript types are those of the Python models."""
    node = shutil.which("node")
    if node is None or not (repository / "studio" / "node_modules").is_dir():
        pytest.skip("Node or studio/node_modules is missing: run `make studio`")
    done = subprocess.run(
        [node, "scripts/generate-types.mjs", "--check"],
        cwd=repository / "studio",
        env={**os.environ, "VEDUTA_PYTHON": sys.executable},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
