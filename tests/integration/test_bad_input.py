"""Input that cannot become a building: named, with the reason, and nothing invented for it."""

from __future__ import annotations

import os
import struct
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest
from command_line import command, facade, read_json, refused, veduta
from PIL import Image


def png_header(width: int, height: int) -> bytes:
    """A PNG that says how large it is and holds next to nothing."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", zlib.compress(b"\0" * 64))


def bad_file(kind: str, folder: Path, photo: Path) -> Path:
    path = folder / f"{kind}.jpg"
    if kind == "not-an-image":
        path.write_text("this is a letter, not an image\n" * 50)
    elif kind == "truncated":
        Image.open(photo).convert("RGB").save(path, quality=90)
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    elif kind == "one-pixel":
        Image.new("RGB", (1, 1)).save(path)
    elif kind == "huge-header":
        path = path.with_suffix(".png")
        path.write_bytes(png_header(30_000, 30_000))
    elif kind == "other-format":  # a DDS texture of no known pixel format
        path.write_bytes(struct.pack("<4s7I44xI4x48x", b"DDS ", 124, 4111, 40, 40, 120, 0, 0, 32))
    elif kind == "empty":
        path.touch()
    return path


@pytest.mark.parametrize(
    ("kind", "fault"),
    [
        ("not-an-image", "not an image"),
        ("truncated", "truncated"),
        ("one-pixel", "1 x 1"),
        ("huge-header", "megapixels"),
        ("other-format", "not an image that can be read"),
        ("empty", "empty"),
    ],
)
def test_unreadable(tmp_path: Path, photo: Path, kind: str, fault: str) -> None:
    path = bad_file(kind, tmp_path, photo)
    done = refused("facade", "--rectified", path, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert f"error: {path}: " in done.stderr
    assert fault in done.stderr
    assert "Traceback" not in done.stderr
    assert not list((tmp_path / "out").rglob("*.glb"))
    assert not (tmp_path / "out" / "place.json").exists()
    failure = read_json(tmp_path / "out" / "report.json")["failures"][0]
    assert failure["subject"] == str(path)
    assert fault in failure["reason"]


def test_the_others_of_a_call_are_done(tmp_path: Path, photo: Path) -> None:
    kinds = ("truncated", "other-format", "huge-header")
    bad = [bad_file(kind, tmp_path, photo) for kind in kinds]
    done = facade(*bad, photo, "-o", tmp_path / "out")
    assert done.returncode == 3
    for path in bad:
        assert f"error: {path}: " in done.stderr
    assert "1 of 4" in done.stdout
    place = read_json(tmp_path / "out" / "place.json")
    assert [part["id"] for part in place["parts"]] == [photo.stem]
    again = facade(*bad, photo, "-o", tmp_path / "out")
    assert again.returncode == 3
    assert "up to date" in again.stdout


@pytest.mark.parametrize("mode", [["--rectified"], []])
@pytest.mark.parametrize("name", ["noise", "meadow"])
def test_no_facade(
    tmp_path: Path, name: str, mode: list[str], request: pytest.FixtureRequest
) -> None:
    path = request.getfixturevalue(name)
    done = refused("facade", path, *mode, "-o", tmp_path / "out")
    assert done.returncode == 3, done.stdout
    assert f"error: {path}: " in done.stderr
    assert "not found" in done.stderr
    left = {file.name for file in (tmp_path / "out" / path.stem).iterdir()}
    assert left == {"report.json", "report.html"}
    report = read_json(tmp_path / "out" / path.stem / "report.json")
    assert (report["state"], report["failures"][0]["kind"]) == ("failed", "not-found")
    assert not (tmp_path / "out" / "place.json").exists()


def test_a_strip_of_a_picture(tmp_path: Path) -> None:
    path = tmp_path / "panorama.png"
    pixels = np.random.default_rng(3).integers(0, 256, (11, 667, 3), dtype=np.uint8)
    Image.fromarray(pixels).resize((4000, 66), Image.Resampling.NEAREST).save(path)
    done = refused("facade", "--rectified", path, "-o", tmp_path / "out")
    assert done.returncode == 3, done.stderr
    assert "not found" in done.stderr


def test_nothing_there(tmp_path: Path) -> None:
    for path in (tmp_path / "none.jpg", tmp_path):
        done = refused("facade", "--rectified", path, "-o", tmp_path / "out")
        assert done.returncode == 2
        assert done.stderr.startswith(f"error: {path}: ")
        assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["a.jpg", "facade.json", "rectified.jpg"])
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_what_is_no_file_is_not_waited_for(tmp_path: Path, name: str, kind: str) -> None:
    bad = tmp_path / name
    if kind == "pipe":
        os.mkfifo(bad)
    else:
        bad.symlink_to("/dev/zero")
    given = bad
    if name == "rectified.jpg":
        given = tmp_path / "facade.json"
        given.write_text("{}")
    done = subprocess.run(
        command("facade", given, "-o", tmp_path / "out"),
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 2
    assert f"error: {bad}: is a {kind}, not a file" in done.stderr
    assert not (tmp_path / "out").exists()


def test_two_images_of_one_name(tmp_path: Path, photo: Path) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "x.png").write_bytes(photo.read_bytes())
    done = refused(
        "facade",
        "--rectified",
        tmp_path / "a" / "x.png",
        tmp_path / "b" / "x.png",
        "-o",
        tmp_path / "out",
    )
    assert done.returncode == 2
    assert str(tmp_path / "a" / "x.png") in done.stderr
    assert str(tmp_path / "b" / "x.png") in done.stderr


@pytest.mark.parametrize("name", ["report.json.png", "a:b.png", ".hidden.png", "back\\slash.png"])
def test_names_that_cannot_be_a_folder(tmp_path: Path, photo: Path, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(photo.read_bytes())
    done = refused("facade", "--rectified", path, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "Rename" in done.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["--no-such-option"],
        ["--height-m", "-3"],
        ["--height-m", "tall"],
        ["--height-m", "1e9"],
        ["--height-m", "1_9"],
        ["--corners", "1", "2", "3"],
        ["--setback-m", "7"],
        ["--jobs", "0"],
        ["--storey-m", "3,2"],
        ["--corners", "10,20,30,40,50,60,70,80"],
    ],
)
def test_bad_use(tmp_path: Path, photo: Path, arguments: list[str]) -> None:
    done = refused("facade", "--rectified", photo, "-o", tmp_path / "out", *arguments)
    assert done.returncode == 2
    assert arguments[0] in done.stderr
    assert "Traceback" not in done.stderr
    if len(arguments) > 1:
        assert done.stderr.startswith(f"error: {arguments[0]}: ")
        assert done.stderr.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_bad_verbs() -> None:
    done = veduta("facde")
    assert done.returncode == 2
    assert "Did you mean `veduta facade`?" in done.stderr
    assert veduta("facade").returncode == 2
    assert veduta().returncode == 2


def test_out_that_cannot_be_written(tmp_path: Path, photo: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    for out in (tmp_path / "file", tmp_path / "file" / "out", Path("/proc/veduta/out")):
        done = refused("facade", "--rectified", photo, "-o", out)
        assert done.returncode == 2
        assert done.stderr.startswith(f"error: {out}: ")
    assert (tmp_path / "file").read_text() == "in the way"


def test_corners_of_one_facade_for_two_photos(tmp_path: Path, photo: Path) -> None:
    other = tmp_path / "other.png"
    other.write_bytes(photo.read_bytes())
    corners = ["--corners", 10, 10, 200, 10, 200, 300, 10, 300]
    done = refused("facade", photo, other, *corners, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "--corners: are those of one facade, but 2 photos are named" in done.stderr
    assert not (tmp_path / "out").exists()
