"""From frames to silhouettes and axes, and each way in which footage can be bad."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from drawn_footage import band_axis, band_footage, band_frame

from veduta.fauna.read.axis import medial_axis
from veduta.fauna.read.background import BackgroundLooks, estimated_background
from veduta.fauna.read.footage import Footage, read_footage
from veduta.fauna.read.limbless import Seen, axes_in, silhouettes_in, tracked_axes
from veduta.fauna.read.overlap import drawn_body, overlap
from veduta.run.errors import InputError, NotFoundError


def _footage(frames: np.ndarray) -> Footage:
    return Footage(frames, np.arange(len(frames)), 0.04, assumed=False)


def _save(frames: np.ndarray, folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for number, frame in enumerate(frames):
        cv2.imwrite(str(folder / f"{number:03d}.png"), frame[..., ::-1])
    return folder


def _apart(found: np.ndarray, true: np.ndarray) -> np.ndarray:
    return np.linalg.norm(found[:, None] - true[None], axis=2).min(axis=1)


@pytest.mark.parametrize("shadow", [False, True])
def test_the_axis_is_found_under_noise_and_shadow(shadow: bool) -> None:
    footage = _footage(band_footage(shadow=shadow))
    silhouettes, _ = silhouettes_in(footage, None, None, "it")
    assert len(silhouettes.rows) >= 22
    tracked = tracked_axes(footage, Seen(silhouettes, axes_in(silhouettes), None))
    for points, frame in zip(tracked.points, tracked.frame, strict=True):
        shown = np.stack([points[:, 0], 240.0 - points[:, 1]], axis=1)
        assert _apart(shown[5:-5], band_axis(int(frame)) + 0.5).max() < 0.02 * 140.0


def test_an_animal_that_stays_is_not_taken_for_the_background() -> None:
    frames = np.stack([band_frame([band_axis(k, drift=0.0)], seed=k) for k in range(20)])
    background = estimated_background(frames, BackgroundLooks())
    empty = band_frame([], seed=99, noise=0.0)
    apart = np.abs(background.pixels.astype(int) - empty).max(axis=2)
    assert np.mean(apart > 40) < 0.003
    assert not background.given


def test_the_axis_of_an_arc_is_its_arc() -> None:
    canvas = np.zeros((300, 300), np.uint8)
    cv2.ellipse(canvas, (150, 150), (100, 100), 0.0, 20.0, 200.0, 1, 24)
    axis = medial_axis(canvas > 0, 101)
    assert axis is not None
    radius = np.linalg.norm(axis.points - 150.5, axis=1)
    assert np.abs(radius[5:-5] - 100.0).max() < 1.5
    assert np.abs(axis.half_width[10:-10] - 12.0).max() < 1.5


def test_spurs_are_left_aside() -> None:
    canvas = np.zeros((120, 400), np.uint8)
    cv2.line(canvas, (40, 60), (360, 60), 1, 25)
    cv2.circle(canvas, (200, 46), 6, 1, -1)
    axis = medial_axis(canvas > 0, 101)
    assert axis is not None
    assert np.abs(axis.points[3:-3, 1] - 60.5).max() < 4.0
    assert abs(np.ptp(axis.points[:, 0]) - 344.0) < 8.0


def test_a_drawn_body_covers_what_it_was_drawn_from() -> None:
    axis = band_axis(0, count=100)
    mask = np.zeros((240, 400), np.uint8)
    cv2.polylines(mask, [np.round(axis * 16).astype(np.int32)], False, 1, 15, shift=4)
    again = drawn_body(axis + 0.5, np.full(100, 7.5), (240, 400))
    assert overlap(again, mask > 0) > 0.85
    assert overlap(mask > 0, mask > 0) == 1.0


def test_given_masks_and_background(tmp_path: Path) -> None:
    frames = band_footage(8)
    empty = tmp_path / "empty.png"
    cv2.imwrite(str(empty), band_frame([], seed=50))
    found, background = silhouettes_in(_footage(frames), None, empty, "it")
    assert len(found.rows) == 8
    assert background is not None
    assert background.given
    white = np.repeat(found.masks[..., None], 3, axis=3).astype(np.uint8) * 255
    again, _ = silhouettes_in(_footage(frames), _save(white, tmp_path / "m"), None, "it")
    assert min(map(overlap, again.masks, found.masks)) > 0.95


def test_no_animal() -> None:
    frames = np.stack([band_frame([], seed=k) for k in range(8)])
    with pytest.raises(NotFoundError, match="nothing in it differs"):
        silhouettes_in(_footage(frames), None, None, "it")


def test_two_animals() -> None:
    frames = np.stack(
        [
            band_frame([band_axis(k), band_axis(k) + np.array([40.0, 60.0])], seed=k)
            for k in range(16)
        ]
    )
    with pytest.raises(NotFoundError, match="two things of nearly the same size"):
        silhouettes_in(_footage(frames), None, None, "it")


def test_an_animal_that_the_border_cuts_in_all_frames() -> None:
    frames = np.stack(
        [band_frame([band_axis(k) + np.array([230.0, 0.0])], seed=k) for k in range(12)]
    )
    with pytest.raises(NotFoundError, match="the border of the frame cuts it"):
        silhouettes_in(_footage(frames), None, None, "it")


def test_a_still_image() -> None:
    with pytest.raises(NotFoundError, match="the same picture"):
        silhouettes_in(_footage(np.repeat(band_footage(1), 8, axis=0)), None, None, "it")


def test_masks_of_another_size(tmp_path: Path) -> None:
    masks = _save(np.zeros((8, 100, 100, 3), np.uint8), tmp_path / "masks")
    with pytest.raises(InputError, match="100 x 100 px, and its frame is not"):
        silhouettes_in(_footage(band_footage(8)), masks, None, "it")


def test_too_few_masks(tmp_path: Path) -> None:
    masks = _save(np.zeros((3, 240, 400, 3), np.uint8), tmp_path / "masks")
    with pytest.raises(InputError, match="holds 3 masks for 8 frames"):
        silhouettes_in(_footage(band_footage(8)), masks, None, "it")


def test_a_background_of_another_size(tmp_path: Path) -> None:
    path = tmp_path / "empty.png"
    cv2.imwrite(str(path), np.zeros((10, 10, 3), np.uint8))
    with pytest.raises(InputError, match="10 x 10 px, and the frames are not"):
        silhouettes_in(_footage(band_footage(5)), None, path, "it")


def test_folders_of_frames(tmp_path: Path) -> None:
    folder = _save(band_footage(6), tmp_path / "frames")
    found = read_footage(folder, None)
    assert found.frames.shape == (6, 240, 400, 3)
    assert found.assumed
    assert read_footage(folder, 10.0).frame_s == pytest.approx(0.1)
    (folder / "002.png").unlink()
    cv2.imwrite(str(folder / "002.png"), np.zeros((50, 60, 3), np.uint8))
    with pytest.raises(InputError, match="60 x 50 px, and the first frame is not"):
        read_footage(folder, None)
    with pytest.raises(InputError, match="holds no pictures"):
        read_footage(tmp_path, None)


def test_few_frames_and_broken_videos(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="has 3 frames"):
        read_footage(_save(band_footage(3), tmp_path / "three"), None)
    video = tmp_path / "broken.mp4"
    video.write_bytes(b"no video")
    with pytest.raises(InputError, match="is no video that can be read"):
        read_footage(video, None)
