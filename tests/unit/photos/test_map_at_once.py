"""Mapping all photos at once, on photos whose places are known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from photo_scene import ARC, FOCAL_PX
from photos_truth import centre_errors

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.at_once import map_at_once, require_focal_lengths
from veduta.photos.mapping.doubt import Doubt, database_without
from veduta.run.errors import InputError

IDS = tuple(range(1, len(ARC) + 1))


class StoppedError(Exception):
    """Stands for Ctrl-C."""


@pytest.fixture
def with_focal(arc_matches: Path, tmp_path: Path) -> Path:
    """The matches of the arc's photos, whose focal length is known."""
    target = tmp_path / "known.db"
    database_without(arc_matches, [], target)
    with pycolmap.Database.open(target) as opened:
        for camera in opened.read_all_cameras():
            camera.focal_length, camera.has_prior_focal_length = FOCAL_PX, True
            opened.update_camera(camera)
    return target


def test_the_photos_are_where_they_were_taken(with_focal: Path, tmp_path: Path) -> None:
    told: list[float] = []
    before = with_focal.read_bytes()
    mapped = map_at_once(with_focal, tmp_path / "map", IDS, 0, lambda _, share: told.append(share))
    assert with_focal.read_bytes() == before, "the engine writes into a copy"
    (model,) = mapped.models
    assert mapped.starts == ()
    found = {str(image): model.images[image].projection_center() for image in IDS}
    true = {str(image): np.array(pose.eye) for image, pose in zip(IDS, ARC, strict=True)}
    assert 0.0 < centre_errors(found, true).mean() < 0.02, "of an arc of 6 m"
    assert told == sorted(told)
    assert 0.0 < told[0] < told[-1] < 1.0


def test_photos_of_two_places_become_two_components(with_focal: Path, tmp_path: Path) -> None:
    across = [Doubt(first, second, 0, "") for first in IDS[:3] for second in IDS[3:]]
    database_without(with_focal, across, tmp_path / "apart.db")
    mapped = map_at_once(tmp_path / "apart.db", tmp_path / "map", IDS, 0)
    assert [sorted(model.reg_image_ids()) for model in mapped.models] == [[1, 2, 3], [4, 5, 6]]


def test_it_can_be_stopped(with_focal: Path, tmp_path: Path) -> None:
    def stop(step: str, share: float) -> None:
        raise StoppedError

    with pytest.raises(StoppedError):
        map_at_once(with_focal, tmp_path / "map", IDS, 0, stop)


def photo(name: str, focal_px: float | None) -> PhotoRecord:
    return PhotoRecord(
        image_id=1, name=name, path=Path(name), sha256="", width_px=900, height_px=600,
        focal_px=focal_px, camera=None, time=None, position=None, group=1, notes=(),
    )  # fmt: skip


def test_photos_without_a_focal_length_are_named() -> None:
    require_focal_lengths([photo("a.jpg", 900.0), photo("b.jpg", 1.0)])
    without = [photo(f"{number}.jpg", None) for number in range(5)]
    with pytest.raises(InputError, match=r"5 of 6 photos is not known \(0.jpg, 1.jpg, 2.jpg, …\)"):
        require_focal_lengths([photo("a.jpg", 900.0), *without])
