"""`veduta photos --lens fisheye`: photos that show half around, drawn in a room of ten metres."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from noise_room import fisheye_rays, room, seen
from photos_truth import centre_errors
from PIL import Image

from veduta.formats.place_json import read_place
from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions, WallOptions
from veduta.photos.pipeline import run_photos
from veduta.run.progress import Progress

SIDE_PX, FOCAL_PX = 640, 200.0
PLACES_M = np.array(
    [[x, y, 0.1 * (k % 3)] for k, (x, y) in enumerate(np.ndindex(3, 3))], dtype=float
) * (0.7, 0.7, 1.0) - (0.7, 0.7, 0.2)


def write_fisheyes(folder: Path) -> dict[str, np.ndarray]:
    """Nine photos from places that differ, each a little turned; their places by their names."""
    folder.mkdir()
    textures, truth = room(3), {}
    for number, place in enumerate(PLACES_M):
        rays = fisheye_rays(SIDE_PX, FOCAL_PX, 0.12 * (number % 4))
        name = f"eye{number}.png"
        Image.fromarray(seen(textures, place, rays)).save(folder / name)
        truth[name] = place
    return truth


@pytest.mark.slow
def test_fisheyes_that_show_half_around_are_placed(tmp_path: Path) -> None:
    truth = write_fisheyes(tmp_path / "photos")
    options = PhotosOptions(
        match=MatchOptions(max_features=1500),
        camera=CameraOptions(lens="fisheye", cameras="shared", principal_point="middle"),
        walls=WallOptions(no_walls=True),
    )
    out = tmp_path / "out"
    result = run_photos(tmp_path / "photos", out, options, Progress(quiet=True))
    assert result.failure is None
    assert len(read_place(out / "place.json").cameras) == len(truth)
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    found = {image.name: image.projection_center() for image in model.images.values()}
    # Metres, after the similarity that fits best: the scale is not known.
    assert centre_errors(found, truth).max() < 0.003
    (camera,) = model.cameras.values()
    assert camera.model == pycolmap.CameraModelId.OPENCV_FISHEYE
    assert camera.mean_focal_length() == pytest.approx(FOCAL_PX, rel=0.02)
