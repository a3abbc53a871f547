"""`veduta photos --rig`: two cameras fixed to each other, a photo of which shows nothing."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pycolmap
import pytest
from PIL import Image
from rig_scene import BASE_M, TURNED_DEG, write_rig

from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions, WallOptions
from veduta.photos.pipeline import run_photos
from veduta.run.progress import Progress

OPTIONS = PhotosOptions(
    match=MatchOptions(max_features=900),
    camera=CameraOptions(rig=True, lens="pinhole", principal_point="middle"),
    walls=WallOptions(no_walls=True),
)
FRAMES = 6
BLANK = "right/03.png"


@pytest.fixture(scope="module")
def photos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The photos of the rig; one is of a lens under a cloth."""
    folder = tmp_path_factory.mktemp("rig")
    write_rig(folder, FRAMES)
    pixels = cv2.GaussianBlur(np.asarray(Image.open(folder / BLANK)), None, 30.0)
    Image.fromarray(pixels).save(folder / BLANK)
    return folder


def ties(out: Path) -> np.ndarray:
    """(f, 3, 4) the right camera from the left one, in each frame."""
    model = pycolmap.Reconstruction(out / "sparse" / "0")
    poses = {image.name: image.cam_from_world().matrix() for image in model.images.values()}
    found = []
    for frame in range(FRAMES):
        left, right = (poses[f"{name}/{frame:02d}.png"] for name in ("left", "right"))
        turn = right[:, :3] @ left[:, :3].T
        found.append(np.column_stack([turn, right[:, 3] - turn @ left[:, 3]]))
    return np.array(found)


def test_a_rig_places_what_shows_nothing(photos: Path, tmp_path: Path) -> None:
    result = run_photos(photos, tmp_path / "out", OPTIONS, Progress(quiet=True))
    assert result.failure is None
    assert result.measures["placed_without_rig"] == 2 * FRAMES - 1
    assert result.measures["placed_with_rig"] == 2 * FRAMES
    assert result.measures["calibrated"] == 2 * FRAMES
    assert result.left == []
    assert "right/03.png: too little to see" in (tmp_path / "out" / "report.json").read_text()
    found = ties(tmp_path / "out")
    np.testing.assert_allclose(found, found[:1].repeat(FRAMES, axis=0), atol=1e-7)
    turn = np.rad2deg(np.arccos((np.trace(found[0, :, :3]) - 1.0) / 2.0))
    assert turn == pytest.approx(TURNED_DEG, abs=0.2)
    centre = -found[0, :, :3].T @ found[0, :, 3]
    np.testing.assert_allclose(centre / np.linalg.norm(centre), (1.0, 0.0, 0.0), atol=0.02)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "The rig" in page
    names = json.loads((tmp_path / "out" / "place.json").read_text())["cameras"]
    assert len(names) == 2 * FRAMES


def test_what_a_file_says_of_the_rig_stays(photos: Path, tmp_path: Path) -> None:
    turn = np.deg2rad(TURNED_DEG)
    told = [
        {"image_prefix": "left/", "ref_sensor": True},
        {
            "image_prefix": "right/",
            "cam_from_rig_rotation": [np.cos(turn / 2), 0.0, -np.sin(turn / 2), 0.0],
            "cam_from_rig_translation": [-BASE_M * np.cos(turn), 0.0, -BASE_M * np.sin(turn)],
        },
    ]
    (photos / "rig.json").write_text(json.dumps([{"cameras": told}]))
    try:
        result = run_photos(photos, tmp_path / "out", OPTIONS, Progress(quiet=True))
    finally:
        (photos / "rig.json").unlink()
    assert result.measures["rig_given"] is True
    assert result.measures["placed_with_rig"] == 2 * FRAMES
    found = ties(tmp_path / "out")
    turned = np.rad2deg(np.arccos((np.trace(found[0, :, :3]) - 1.0) / 2.0))
    assert turned == pytest.approx(TURNED_DEG, abs=1e-4)
