"""Films: the sharpest frame of each stretch, and files that are none."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from veduta.photos.intake.video import (
    MOTION,
    Look,
    choose_frames,
    look_through,
    motion_between,
    video_of,
    write_frames,
)
from veduta.photos.options import VideoOptions
from veduta.run.errors import InputError

RATE, WIDTH, HEIGHT = 12, 320, 240


def wall(seed: int = 0) -> np.ndarray:
    """(300, 1200, 3) spots, for a camera to move along."""
    rng = np.random.default_rng(seed)
    small = rng.integers(0, 256, (30, 120, 3), dtype=np.uint8)
    return cv2.resize(small, (1200, 300), interpolation=cv2.INTER_CUBIC)


def write_film(path: Path, offsets: list[int], sharp: set[int]) -> Path:
    """A frame per offset along the wall (px); those that are not sharp are blurred."""
    code = "MJPG" if path.suffix == ".avi" else "mp4v"
    film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*code), RATE, (WIDTH, HEIGHT))
    assert film.isOpened()
    picture = wall()
    for number, offset in enumerate(offsets):
        frame = np.ascontiguousarray(picture[20 : 20 + HEIGHT, offset : offset + WIDTH])
        film.write(frame if number in sharp else cv2.GaussianBlur(frame, (0, 0), 2.5))
    film.release()
    return path


def look(stretches: list[int], sharpness: list[float], times: list[float] | None = None) -> Look:
    count = len(stretches)
    seconds = np.array(times) if times else np.arange(count) / 10.0
    return Look(
        2 * np.arange(count),
        seconds,
        np.array(sharpness),
        np.array(stretches),
        2 * count,
        2 * count,
    )


@pytest.mark.parametrize("suffix", [".mp4", ".avi"])
def test_the_sharpest_frame_of_each_second(tmp_path: Path, suffix: str) -> None:
    sharp = {5, 16, 30, 47}
    path = write_film(tmp_path / f"my walk{suffix}", [5 * n for n in range(48)], sharp)
    options = VideoOptions(video_interval_s=1.0)
    frames = write_frames(video_of(path), options, tmp_path)
    assert [file.name for file in frames.paths] == [f"my-walk-{n:06d}.jpg" for n in sorted(sharp)]
    assert "4 of 48 frames" in frames.notes[0]
    for file, number in zip(frames.paths, sorted(sharp), strict=True):
        expected = wall()[20 : 20 + HEIGHT, 5 * number : 5 * number + WIDTH].astype(float)
        assert np.abs(cv2.imread(str(file)).astype(float) - expected).mean() < 12.0


def test_standing_still_gives_one_frame(tmp_path: Path) -> None:
    """Half of the time the camera stands; it moves by 1.25 widths in all."""
    offsets = [0] * 60 + [8 * n for n in range(1, 61)]
    path = write_film(tmp_path / "a.mp4", offsets, set(range(120)))
    chosen = choose_frames(look_through(video_of(path)), VideoOptions())
    assert 20 <= len(chosen) <= 32
    assert np.sum(chosen < 60) == 1


def test_how_far_a_picture_moves() -> None:
    grey = cv2.cvtColor(wall(), cv2.COLOR_BGR2GRAY)
    first = np.ascontiguousarray(grey[20:260, 100:420])
    for pixels in (0, 3, 12, 25):
        moved = np.ascontiguousarray(grey[20:260, 100 + pixels : 420 + pixels])
        assert motion_between(first, moved) == pytest.approx(pixels / WIDTH, abs=0.005)
    other = cv2.cvtColor(wall(1), cv2.COLOR_BGR2GRAY)[20:260, 100:420]
    assert motion_between(first, np.ascontiguousarray(other)) > MOTION


def test_the_choice_against_brute_force() -> None:
    rng = np.random.default_rng(1)
    for most in (2, 7, 500):
        stretches = np.cumsum(rng.random(300) < 0.2).tolist()
        sharpness = rng.integers(0, 20, 300).astype(float).tolist()
        chosen = choose_frames(look(stretches, sharpness), VideoOptions(video_frames=most))
        merged = -(-(stretches[-1] + 1) // most)
        best: dict[int, int] = {}
        for row, (stretch, sharp) in enumerate(zip(stretches, sharpness, strict=True)):
            known = best.setdefault(stretch // merged, row)
            if sharp > sharpness[known]:
                best[stretch // merged] = row
        assert chosen.tolist() == [2 * row for row in sorted(best.values())]
        assert len(chosen) <= most


def test_an_interval_is_kept_to_but_for_the_most(tmp_path: Path) -> None:
    still = look([0] * 100, [1.0] * 100)
    assert len(choose_frames(still, VideoOptions(video_interval_s=0.5))) == 20
    assert len(choose_frames(still, VideoOptions(video_interval_s=0.5, video_frames=4))) == 4
    assert len(choose_frames(still, VideoOptions())) == 20
    assert choose_frames(look([0], [1.0]), VideoOptions()).tolist() == [0]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is not a film"),
        (b"#EXTM3U\nhttp://example.org/a.ts\n", "is not a film"),
        (b"\0\0\0\x20ftypisom" + bytes(200), "truncated, damaged"),
        (b"RIFF\x10\0\0\0AVI LIST" + bytes(100), "truncated, damaged"),
    ],
)
def test_what_is_no_film(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "a.mp4"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        look_through(video_of(path))


def test_a_film_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        video_of(tmp_path / "a.mp4")
    with pytest.raises(InputError, match="is a folder"):
        video_of(tmp_path)


def test_a_truncated_film(tmp_path: Path) -> None:
    """An MP4 has its table of contents at the end; an AVI can be read up to where it ends."""
    whole = write_film(tmp_path / "a.mp4", [5 * n for n in range(48)], set(range(48)))
    whole.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    with pytest.raises(InputError, match="truncated, damaged"):
        look_through(video_of(whole))
    film = write_film(tmp_path / "b.avi", [5 * n for n in range(48)], set(range(48)))
    film.write_bytes(film.read_bytes()[: film.stat().st_size // 2])
    frames = write_frames(video_of(film), VideoOptions(video_interval_s=0.5), tmp_path)
    assert 2 <= len(frames.paths) < 6
    assert "could be read" in frames.notes[1]
