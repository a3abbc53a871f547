"""Footage from a camera that pans becomes footage of one that stands still."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.fauna.document.plan import load_plan
from veduta.fauna.options import FaunaOptions, FootageOptions
from veduta.fauna.pins_recipe import pins_of
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.limbless import silhouettes_in
from veduta.fauna.read.registered import CameraLooks, stilled
from veduta.fauna.read.silhouettes import SilhouetteLooks, silhouettes_of
from veduta.fauna.recipe import Record
from veduta.run.errors import NotFoundError
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, Work, run_verb


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


def test_given_silhouettes_go_onto_the_canvas_with_their_frames(tmp_path: Path) -> None:
    footage, places = _pan(12.0)
    dark = (footage.frames.max(axis=3) < 40) & (np.arange(200)[None, :, None] // 30 == 3)
    still = stilled(footage, CameraLooks(), "pan", dark)
    (tmp_path / "masks").mkdir()
    for row, mask in enumerate(dark):
        cv2.imwrite(str(tmp_path / "masks" / f"{row:02d}.png"), mask.astype(np.uint8) * 255)
    found, _ = silhouettes_in(still, tmp_path / "masks", None, "pan")
    middles = np.array([np.argwhere(mask).mean(axis=0)[::-1] for mask in found.masks])
    wanted = np.array([places[int(row)] for row in found.rows])
    assert np.abs(middles - wanted - (middles - wanted).mean(axis=0)).max() < 1.5


def test_places_in_frames_go_onto_the_canvas_and_back() -> None:
    footage, places = _pan(12.0)
    still = stilled(footage, CameraLooks(), "pan")
    in_frames = np.array([[[x - 12.0 * row, y]] for row, (x, y) in enumerate(places)])
    in_frames[3] = np.nan
    laid = still.at_canvas(in_frames)
    assert np.isnan(laid[3]).all()
    np.testing.assert_allclose(still.from_canvas(laid), in_frames, atol=1e-6)
    steps = np.diff(laid[[0, 5, 10, 15], 0, 0])
    np.testing.assert_allclose(steps, 70.0, atol=1.5)


@pytest.mark.parametrize("degrees", [0.0, 12.0])
def test_an_animal_that_the_moving_frame_cuts_is_left_out(degrees: float) -> None:
    turn = cv2.getRotationMatrix2D((150.0, 90.0), degrees, 1.0)
    frame = np.array([[40.5, 20.5], [259.5, 20.5], [259.5, 159.5], [40.5, 159.5]])
    corners = frame @ turn[:, :2].T + turn[:, 2]
    shown = np.zeros((180, 320), np.uint8)
    cv2.fillConvexPoly(shown, np.round((corners - 0.5) * 16).astype(np.int32), 1, shift=4)
    raw = np.zeros((6, 180, 320), dtype=np.bool_)
    for row in range(6):
        body = np.zeros((180, 320), np.uint8)
        middle = np.array([80.0 + 32.0 * row, 90.0]) @ turn[:, :2].T + turn[:, 2]
        cv2.ellipse(body, (middle, (52.0, 26.0), -degrees), 1, -1)
        raw[row] = (body > 0) & (shown > 0)
    found = silhouettes_of(raw, SilhouetteLooks(), "pan", np.tile(corners, (6, 1, 1)))
    assert list(found.rows) == [0, 1, 2, 3, 4]
    assert found.left_out == ((5, "the frame's border cuts the animal"),)
    whole = silhouettes_of(raw, SilhouetteLooks(), "pan")
    assert len(whole.rows) == 6 or "as large" in whole.left_out[0][1]


def test_joints_in_the_pictures_of_a_moving_camera_go_with_them(tmp_path: Path) -> None:
    footage, _ = _pan(12.0)
    still = stilled(footage, CameraLooks(), "pan")
    joints = tmp_path / "joints.csv"
    rows = "".join(f"{row},{100 + row},20\n" for row in range(16))
    joints.write_text("bodyparts,nose,nose\ncoords,x,y\n" + rows)
    record = Record(tmp_path, joints=joints)
    plan = load_plan("quadruped")
    found, _ = silhouettes_in(still, None, None, "pan")
    at: list[NDArray[np.float64]] = []

    def make(work: Work) -> None:
        at.append(pins_of(work, record, still, found, plan, FootageOptions()).px["nose"])

    call = VerbCall("fauna", "0", "pan", FaunaOptions(), [])
    run_verb(call, tmp_path / "out", make, Progress(quiet=True))
    np.testing.assert_allclose(np.diff(at[0][:, 0]), 13.0, atol=0.5)
    told = (tmp_path / "out" / "joints.csv").read_text().splitlines()
    assert told[5].startswith("2,102.00,20.00")


def test_a_camera_that_stands_still_is_left_alone() -> None:
    footage, _ = _pan(0.0)
    assert stilled(footage, CameraLooks(), "still") is footage
    noise = np.random.default_rng(2).normal(0.0, 4.0, footage.frames.shape)
    noisy = _footage(np.clip(footage.frames + noise, 0, 255).astype(np.uint8))
    assert stilled(noisy, CameraLooks(), "still") is noisy


def test_a_moving_camera_with_nothing_to_follow_is_refused() -> None:
    random = np.random.default_rng(1)
    levels = random.integers(30, 220, size=8)
    frames = np.stack([np.full((120, 160, 3), level, np.uint8) for level in levels])
    with pytest.raises(NotFoundError, match="nothing that can be followed"):
        stilled(_footage(frames), CameraLooks(), "fog")
