"""What goes wrong with records, each said with what is wrong and what to do."""

from __future__ import annotations

import base64
import json
import re
import shutil
from io import BytesIO
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image

from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.run.verb import VerbResult
from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.walk import command
from veduta.walk.build.way import find_way
from veduta.walk.command import run_walk
from veduta.walk.options import PlayOptions, WalkOptions

SMALL = {"width_px": 256, "height_px": 160}


@pytest.fixture(scope="module")
def gorge(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three key positions in a gorge, 2 m apart."""
    folder = tmp_path_factory.mktemp("gorge")
    write_walk(folder, GorgeWalk(keys=3, step_m=2.0, **SMALL))
    return folder


@pytest.fixture
def record(gorge: Path, tmp_path: Path) -> Path:
    """A copy that a test may spoil."""
    return Path(shutil.copytree(gorge, tmp_path / "record"))


def _walk(folder: Path, out: Path) -> VerbResult:
    return run_walk(folder, out, WalkOptions(), Progress(quiet=True))


def test_a_walk_of_a_gorge(gorge: Path, tmp_path: Path) -> None:
    options = WalkOptions(play=PlayOptions(video=True, speed_m_s=10.0))
    result = run_walk(gorge, tmp_path / "out", options, Progress(quiet=True))
    assert result.exit_code == 0
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    assert [one["kind"] for one in told["transitions"]] == ["morph", "morph"]
    for one in told["transitions"]:
        assert one["distance_m"] == pytest.approx(2.0, rel=0.05)
        assert one["energy_bound"] - 1e-3 <= one["energy"] <= one["energy_icm"] + 1e-3
        assert one["score_db"] > one["unmoved_db"]
    place = json.loads((tmp_path / "out" / "place.json").read_text())
    (walk,) = place["walks"]
    named = [key["picture"] for key in walk["keys"]]
    named += [way[end] for way in walk["transitions"] for end in ("forth", "back")]
    assert all((tmp_path / "out" / name).is_file() for name in named)
    film = cv2.VideoCapture(str(tmp_path / "out" / "walk.mp4"))
    assert (
        film.get(cv2.CAP_PROP_FRAME_COUNT) == 11
    )  # 4 m at 10 m/s and 25 frames a second, and the end
    code = int(film.get(cv2.CAP_PROP_FOURCC)).to_bytes(4, "little")
    assert code in (b"vp09", b"VP90")  # what browsers play
    still, frame = film.read()
    assert still
    assert (
        np.abs(
            frame[..., ::-1].astype(float) - np.asarray(Image.open(gorge / "left" / "000.png"))
        ).mean()
        < 8
    )


def test_exchanged_pictures_are_recognised(record: Path, tmp_path: Path) -> None:
    (record / "left").rename(record / "was-left")
    (record / "right").rename(record / "left")
    (record / "was-left").rename(record / "right")
    with pytest.raises(InputError, match="seems to be the right picture") as raised:
        _walk(record, tmp_path / "out")
    assert "Exchange the folders" in raised.value.remedy


def test_a_calibration_that_does_not_fit_is_refused(record: Path, tmp_path: Path) -> None:
    for path in (record / "right").iterdir():
        pixels = np.asarray(Image.open(path))
        Image.fromarray(np.roll(pixels, 4, axis=0)).save(path)
    with pytest.raises(InputError, match=r"matches are [34]\.\d px off their rows") as raised:
        _walk(record, tmp_path / "out")
    assert "calibrate the two cameras again" in raised.value.remedy


def test_how_far_matches_lie_off_their_rows_is_reported(record: Path, tmp_path: Path) -> None:
    told = _walk(record, tmp_path / "out")
    assert told.exit_code == 0
    assert told.measures["largest_rows_off_px"] < 0.5
    path = record / "right" / "001.png"
    pixels = np.asarray(Image.open(path))
    Image.fromarray(np.roll(pixels, 1, axis=0)).save(path)
    told = _walk(record, tmp_path / "shifted")
    assert told.measures["largest_rows_off_px"] == pytest.approx(1.0, abs=0.4)


def test_other_sizes_later_on_are_named(record: Path, tmp_path: Path) -> None:
    for side in ("left", "right"):
        path = record / side / "001.png"
        Image.open(path).resize((200, 160)).save(path)
    with pytest.raises(InputError, match="is 200 x 160, and the first picture 256 x 160"):
        _walk(record, tmp_path / "out")


def test_one_key_position_is_no_walk(record: Path, tmp_path: Path) -> None:
    for name in ("001.png", "002.png"):
        for side in ("left", "right"):
            (record / side / name).unlink()
    result = _walk(record, tmp_path / "out")
    assert result.exit_code == 3
    assert result.failure is not None
    assert "there is one key position" in result.failure.reason


def test_nothing_in_common_becomes_a_marked_cut(record: Path, tmp_path: Path) -> None:
    write_walk(tmp_path / "other", GorgeWalk(keys=1, seed=9, **SMALL))
    for side in ("left", "right"):
        shutil.copy(tmp_path / "other" / side / "000.png", record / side / "002.png")
    result = _walk(record, tmp_path / "out")
    assert result.exit_code == 0
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    assert [one["kind"] for one in told["transitions"]] == ["morph", "cut"]
    assert any(doubt.startswith("001 to 002: a cut") for doubt in result.doubts)
    page = (tmp_path / "out" / "report.html").read_text()
    pictured = r'src="data:image/jpeg;base64,([^"]+)" alt="001 to 002, a cut"'
    (shown,) = re.findall(pictured, page)
    both = np.asarray(Image.open(BytesIO(base64.b64decode(shown))))
    sides = [np.asarray(Image.open(record / "left" / f"00{n}.png")) for n in (1, 2)]
    assert both.shape[1] == 2 * sides[0].shape[1]
    for picture, side in zip(np.split(both, 2, axis=1), sides, strict=True):
        assert np.abs(picture.astype(float) - side).mean() < 8


def test_snow_without_texture_is_cut_and_said(record: Path, tmp_path: Path) -> None:
    for side in ("left", "right"):
        for path in (record / side).iterdir():
            Image.new("RGB", (256, 160), (250, 250, 252)).save(path)
    result = _walk(record, tmp_path / "out")
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    assert [one["kind"] for one in told["transitions"]] == ["cut", "cut"]
    assert any("too little texture" in doubt for doubt in result.doubts)


def test_a_path_that_turns_back_is_walked_backwards(record: Path, tmp_path: Path) -> None:
    for side in ("left", "right"):
        shutil.copy(record / side / "000.png", record / side / "002.png")
    _walk(record, tmp_path / "out")
    keys = json.loads((tmp_path / "out" / "walk.json").read_text())["keys"]
    first, last = (np.array(keys[n]["transform"])[12:15] for n in (0, 2))
    assert np.linalg.norm(first - last) < 0.1


def test_a_killed_run_goes_on_where_it_was(
    gorge: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def stopped(*args: object, **named: object) -> object:
        calls.append(1)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return find_way(*args, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(command, "find_way", stopped)
    with pytest.raises(KeyboardInterrupt):
        _walk(gorge, tmp_path / "out")
    result = _walk(gorge, tmp_path / "out")
    assert result.exit_code == 0
    assert len(calls) == 3
