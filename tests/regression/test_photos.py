"""Bounds on real photos whose cameras are known; quick settings, so looser than the benchmark's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from photos_truth import centre_errors, fountain_centres
from PIL import Image

from veduta.formats.place_json import read_place
from veduta.photos.options import MatchOptions, PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.photos.walls.document import WallsDocument
from veduta.run.progress import Progress

pytestmark = pytest.mark.regression
QUICK = PhotosOptions(match=MatchOptions(max_side_px=768, max_features=3000))


@pytest.mark.slow
def test_fountain_is_placed(veduta_data: Path, tmp_path: Path) -> None:
    folder = veduta_data / "photos" / "fountain-P11"
    if not folder.is_dir():
        pytest.skip(f"no photos/fountain-P11 in {veduta_data}")
    result = run_photos(folder / "images", tmp_path / "out", QUICK, Progress(quiet=True))
    assert result.failure is None
    assert (result.measures["photos"], result.measures["calibrated"]) == (11, 11)
    assert result.left == []
    assert 0.05 < result.measures["error_px"] < 1.0
    assert 1500 < result.measures["points"] < 12_000
    # The truth is one ideal lens whose axis misses the middle by 8 and 9 pixels.
    assert result.measures["cameras"] == "shared"
    assert result.measures["principal_point"] == "free"
    cameras = read_place(tmp_path / "out" / "place.json").cameras
    found = {camera.name: np.array(camera.transform[12:15]) for camera in cameras}
    errors_mm = 1000 * centre_errors(found, fountain_centres(folder / "cameras"))
    assert 0.5 < float(errors_mm.mean()) < 12.0
    _check_walls(tmp_path / "out")


def _check_walls(out: Path) -> None:
    """The wall behind the fountain is straight left and right of it; its pictures are whole."""
    document = WallsDocument.model_validate_json((out / "walls.json").read_bytes())
    assert 3 <= len(document.walls) <= 25
    one, two = document.walls[:2]
    assert min(one.points, two.points) > 100
    assert float(np.dot(one.outward, two.outward)) > np.cos(np.deg2rad(4.0))
    for wall in (one, two):
        assert 0.0 < wall.rms < 0.02 * wall.width
        assert wall.picture is not None
        assert wall.picture.seen > 0.6
        with Image.open(out / wall.picture.file) as picture:
            assert picture.size == (wall.picture.width_px, wall.picture.height_px)
