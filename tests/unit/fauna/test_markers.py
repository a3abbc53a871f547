"""Painted markers: found by their colours, followed through gaps, and told apart."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.fauna.pins_recipe import in_frames
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.markers import Marker, MarkerLooks, read_markers, tracked_markers
from veduta.run.errors import InputError, NotFoundError
from veduta.synthetic.animals import Filmed, film_quadruped

PAINT = {"nose": (230, 40, 30), "front_toe_left": (30, 220, 60), "hind_toe_left": (40, 80, 240)}


@pytest.fixture(scope="module")
def filmed() -> Filmed:
    return film_quadruped(8, frames=20)


def _painted(
    film: Filmed, paint: dict[str, tuple[int, int, int]], hidden: slice = slice(0, 0)
) -> NDArray[np.uint8]:
    """The footage with discs on its joints, lit unevenly; hidden: frames without them."""
    frames = film.frames.copy()
    shown = set(range(len(frames))) - set(range(len(frames))[hidden])
    for row in shown:
        for name, colour in paint.items():
            x, y = film.joints[name][row] - 0.5
            lit = tuple(int(c * (0.8 + 0.02 * (row % 10))) for c in colour)
            at = (round(x * 16), round(y * 16))
            cv2.circle(frames[row], at, 4 * 16, lit, -1, cv2.LINE_AA, 4)
    return frames


def _tracked(film: Filmed, frames: NDArray[np.uint8], markers: list[Marker]) -> dict[str, float]:
    rows = np.arange(len(frames))
    found = tracked_markers(frames, film.masks, rows, markers, MarkerLooks(), "film")
    return {
        name: float(np.nanmax(np.linalg.norm(at - film.joints[name], axis=1)))
        for name, at in found.px.items()
    }


def test_markers_are_followed_to_a_pixel(filmed: Filmed) -> None:
    frames = _painted(filmed, PAINT)
    markers = [Marker(name, colour) for name, colour in PAINT.items()]
    assert max(_tracked(filmed, frames, markers).values()) < 1.5


def test_markers_of_one_colour_are_told_apart_by_where_they_were(filmed: Filmed) -> None:
    red = (230, 40, 30)
    names = ("nose", "front_toe_left", "hind_toe_left")
    frames = _painted(filmed, dict.fromkeys(names, red))
    at = {name: filmed.joints[name][7] + 1.0 for name in names}
    markers = [Marker(n, red, (float(at[n][0]), float(at[n][1])), 7) for n in names]
    assert max(_tracked(filmed, frames, markers).values()) < 1.5


def test_a_hidden_marker_is_a_gap_and_is_found_again(filmed: Filmed) -> None:
    frames = _painted(filmed, {"nose": PAINT["nose"]}, hidden=slice(6, 9))
    rows = np.arange(len(frames))
    markers = [Marker("nose", PAINT["nose"]), Marker("hip", (250, 0, 250))]
    found = tracked_markers(frames, filmed.masks, rows, markers, MarkerLooks(), "film")
    assert np.isnan(found.px["nose"][6:9]).all()
    assert np.isfinite(found.px["nose"][[5, 9, 19]]).all()
    assert found.unknown == ("hip",)


def test_without_any_marker_the_footage_is_refused(filmed: Filmed) -> None:
    rows = np.arange(len(filmed.frames))
    with pytest.raises(NotFoundError, match="no frame of film shows"):
        tracked_markers(
            filmed.frames,
            filmed.masks,
            rows,
            [Marker("nose", (250, 0, 250))],
            MarkerLooks(),
            "film",
        )


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "names no marker"),
        ("nose = red", "is no TOML"),
        ('nose = "red"', "has no colour"),
        ('antenna = "#ff0000"', "no such joint"),
        ('nose = "#ff0000"\nhip = "#ff0000"', "several markers of one colour"),
        ('nose = { colour = "#ff0000", at = [1] }', "by something else than"),
        ('nose = { colour = "#ff0000", frame = -1 }', "no number of one"),
        ('nose = { colour = "#ff0000", size = 3 }', "has no colour"),
        (
            'nose = { colour = "#ff0000", at = [1, 2], frame = 3 }\n'
            'hip = { colour = "#ff0000", at = [3, 4], frame = 5 }',
            "nose in frame 3 and hip, of the same colour, in frame 5",
        ),
    ],
)
def test_a_list_of_markers_that_cannot_be_used_is_refused(
    tmp_path: Path, text: str, fault: str
) -> None:
    path = tmp_path / "markers.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        read_markers(path, ("nose", "hip"))


def test_a_list_of_markers_is_read(tmp_path: Path) -> None:
    path = tmp_path / "markers.toml"
    path.write_text('nose = "#ff8000"\nhip = { colour = "#0000ff", at = [3, 4.5], frame = 2 }\n')
    assert read_markers(path, ("nose", "hip")) == (
        Marker("nose", (255, 128, 0)),
        Marker("hip", (0, 0, 255), (3.0, 4.5), 2),
    )


def test_a_marker_is_told_in_a_frame_that_is_read() -> None:
    """Of a long film every other frame is read, and a piece of each."""
    frames = np.zeros((4, 8, 8, 3), dtype=np.uint8)
    footage = Footage(frames, np.array([0, 2, 4, 6]), 0.1, False, corner=(10, 20))
    red, path = (255, 0, 0), Path("markers.toml")
    here = in_frames(Marker("nose", red, (13.0, 24.0), 4), footage, path)
    assert (here.frame, here.at) == (2, (3.0, 4.0))
    assert in_frames(Marker("nose", red), footage, path) == Marker("nose", red)
    for frame in (3, 90):
        with pytest.raises(InputError, match=f"frame {frame}, which is not read") as raised:
            in_frames(Marker("nose", red, (3.0, 4.0), frame), footage, path)
        assert "markers.toml" in str(raised.value)
        assert f"frame {2 if frame == 3 else 6} is the next" in str(raised.value)
