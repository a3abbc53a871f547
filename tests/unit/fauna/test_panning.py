"""Footage from a camera that pans becomes footage of one that stands still."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.fauna import Record, run_fauna
from veduta.fauna.options import AnimalOptions, FaunaOptions
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.limbless import silhouettes_in
from veduta.fauna.read.registered import CameraLooks, stilled
from veduta.run.errors import InputError, NotFoundError
from veduta.run.progress import Progress


def _footage(frames: NDArray[np.uint8]) -> Footage:
    return Footage(frames, np.arange(len(frames)), 0.04, assumed=False)


def _pan(step: float, textured: bool = True) -> tuple[Footage, list[tuple[float, float]]]:
    """A dark worm that crosses a mottled ground, and a camera that goes with it, a bit slower."""
    random = np.random.default_rng(0)
    ground = cv2.GaussianBlur(random.normal(150.0, 90.0, (200, 520, 3)), (0, 0), 3.0)
    if not textured:
        ramp = np.linspace(0.0, 1.0, 520)[None, :, None]
        ground = np.broadcast_to(40.0 + 200.0 * ramp, (200, 520, 3)).copy()
    frames, places = [], []
    for row in range(16):
        x, y = 130.0 + 14.0 * row, 100.0
        picture = np.clip(ground, 0, 255).astype(np.uint8).copy()
        cv2.ellipse(picture, (round(x), round(y)), (26, 6), 0, 0, 360, (20, 16, 12), -1)
        left = round(step * row)
        frames.append(picture[:, left : left + 300])
        places.append((x, y))
    return _footage(np.stack(frames)), places


def test_a_panning_camera_is_stilled_and_the_animal_found_where_it_went() -> None:
    footage, places = _pan(12.0)
    still = stilled(footage, CameraLooks(), "pan")
    assert still.size[1] == pytest.approx(300 + 12 * 15, abs=6)
    found, _ = silhouettes_in(still, None, None, "pan")
    assert len(found.rows) >= 14
    middles = np.array([np.argwhere(mask).mean(axis=0)[::-1] for mask in found.masks])
    wanted = np.array([places[int(row)] for row in found.rows])
    offset = (middles - wanted).mean(axis=0)
    assert np.abs(middles - wanted - offset).max() < 3.0


def test_joints_in_the_pictures_of_a_moving_camera_are_refused(tmp_path: Path) -> None:
    footage, _ = _pan(12.0)
    (tmp_path / "frames").mkdir()
    for row, frame in enumerate(footage.frames):
        cv2.imwrite(str(tmp_path / "frames" / f"{row:02d}.png"), frame[..., ::-1])
    joints = tmp_path / "joints.csv"
    joints.write_text("bodyparts,nose,nose\ncoords,x,y\n0,10,20\n")
    record = Record(tmp_path / "frames", joints=joints)
    options = FaunaOptions(animal=AnimalOptions(kind="quadruped"))
    with pytest.raises(InputError, match=r"the camera of these moves.*--masks"):
        run_fauna(record, tmp_path / "out", options, Progress(quiet=True))


def test_a_camera_that_stands_still_is_left_alone() -> None:
    footage, _ = _pan(0.0)
    assert stilled(footage, CameraLooks(), "still") is footage


def test_a_moving_camera_with_nothing_to_follow_is_refused() -> None:
    random = np.random.default_rng(1)
    levels = random.integers(30, 220, size=8)
    frames = np.stack([np.full((120, 160, 3), level, np.uint8) for level in levels])
    with pytest.raises(NotFoundError, match="nothing that can be followed"):
        stilled(_footage(frames), CameraLooks(), "fog")
