"""The frames of a film among the photos: kept from run to run, with masks, under own names."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image

from veduta.photos.intake.call import Call, plan_call
from veduta.photos.intake.frames import FRAMES, publish_frames, with_frames
from veduta.photos.intake.given import Given
from veduta.photos.options import PhotosOptions, VideoOptions
from veduta.photos.stages import Stages
from veduta.run.errors import InputError
from veduta.run.outputs import open_out

OPTIONS = PhotosOptions(video=VideoOptions(video_interval_s=1.0))
NAMES = [f"walk-{number:06d}.jpg" for number in (0, 4, 8)]


@pytest.fixture
def given(tmp_path: Path) -> Given:
    film = cv2.VideoWriter(
        str(tmp_path / "walk.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 4, (120, 90)
    )
    rng = np.random.default_rng(0)
    for number in range(12):
        noise = rng.integers(0, 256, (90, 120, 3), dtype=np.uint8)
        film.write(noise if number % 4 == 0 else cv2.blur(noise, (9, 9)))
    film.release()
    (tmp_path / "masks").mkdir()
    Image.new("L", (120, 90), 255).save(tmp_path / "masks" / "walk-000004.png")
    return Given(masks=tmp_path / "masks", video=tmp_path / "walk.avi")


def taken(call: Call, out: Path, options: PhotosOptions = OPTIONS) -> Call:
    with open_out(out, "photos", "key", force=False) as opened:
        stages = Stages(out, call, options)
        stages.open()
        call = with_frames(call, stages)
        publish_frames(call, opened, "key")
        return call


def test_frames_are_photos(given: Given, tmp_path: Path) -> None:
    call = taken(plan_call(None, given), tmp_path / "out")
    assert [source.name for source in call.sources] == NAMES
    assert {source.video for source in call.sources} == {"walk.avi"}
    assert [source.mask is not None for source in call.sources] == [False, True, False]
    assert sorted(path.name for path in (tmp_path / "out" / FRAMES).iterdir()) == NAMES
    assert any("3 of 12 frames" in note for note in call.notes)


def test_a_stopped_run_goes_on_from_its_frames(given: Given, tmp_path: Path) -> None:
    first = taken(plan_call(None, given), tmp_path / "out")
    stamps = [source.path.stat().st_mtime_ns for source in first.sources]
    again = taken(plan_call(None, given), tmp_path / "out")
    assert again == first
    assert [source.path.stat().st_mtime_ns for source in again.sources] == stamps
    other = taken(
        plan_call(None, given), tmp_path / "out", PhotosOptions(video=VideoOptions(video_frames=2))
    )
    assert len(other.sources) == 2


def test_a_mask_of_another_size_is_refused_before_the_film_is_read(
    given: Given, tmp_path: Path
) -> None:
    assert given.masks is not None
    for name in ("walk-000008.png", "Walk-000008.jpg.PNG"):
        Image.new("L", (120, 91), 255).save(given.masks / name)
        with pytest.raises(InputError, match=r"is 120 x 91 px.*000008.jpg 120 x 90 px"):
            plan_call(None, given)
        (given.masks / name).unlink()
    Image.new("L", (9, 9), 255).save(given.masks / "walk-8.png")  # of no frame
    plan_call(None, given)


def test_a_later_call_without_a_film_takes_its_frames_away(given: Given, tmp_path: Path) -> None:
    out = tmp_path / "out"
    taken(plan_call(None, given), out)
    (tmp_path / "photos").mkdir()
    for grey in (50, 60):
        Image.new("L", (99, 99), grey).save(tmp_path / "photos" / f"{grey}.png")
    with open_out(out, "photos", "other", force=True) as opened:
        publish_frames(plan_call(tmp_path / "photos"), opened, "other")
    assert not (out / FRAMES).exists()


def test_a_photo_of_the_name_of_a_frame(given: Given, tmp_path: Path) -> None:
    (tmp_path / "photos").mkdir()
    Image.new("RGB", (99, 99)).save(tmp_path / "photos" / NAMES[1])
    with pytest.raises(InputError, match="name of a frame"):
        taken(plan_call(tmp_path / "photos", given), tmp_path / "out")


def test_the_same_film_gives_the_same_bytes(given: Given, tmp_path: Path) -> None:
    digests = [
        [source.sha256 for source in taken(plan_call(None, given), tmp_path / name).sources]
        for name in ("a", "b")
    ]
    assert digests[0] == digests[1]
