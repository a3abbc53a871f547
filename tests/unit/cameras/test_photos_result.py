"""A result of `veduta photos` gives its pictures, or the photos it was made of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cameras import sets_of_cameras as made

from veduta.cameras import read_cameras
from veduta.place.manifest import Place, PlaceCamera, Start
from veduta.run.errors import InputError


def write_result(folder: Path) -> None:
    """Pictures at half the size; the model has the cameras of the photos."""
    made.write_colmap(folder / "sparse" / "0", made.ring())
    made.write_pictures(folder / "pictures", size=(32, 24))
    shown = []
    for number, camera in enumerate(made.ring()):
        half = camera.scaled(0.5)
        matrix = np.eye(4)
        matrix[:3, :3] = camera.cam_from_world[:, :3].T
        matrix[:3, 3] = camera.centre()
        shown.append(
            PlaceCamera(
                id=f"photo-{number}",
                name=camera.name,
                picture=f"pictures/a{number}.png",
                width_px=half.width_px,
                height_px=half.height_px,
                focal_px=half.focal_px,
                centre_px=half.centre_px,
                transform=tuple(matrix.T.ravel().tolist()),
            )
        )
    place = Place(
        parts=[],
        cameras=shown,
        crs="EPSG:25832",
        origin=(10.0, 20.0, 30.0),
        scale="metres",
        start=Start(eye=(0.0, 0.0, 0.0), target=(1.0, 0.0, 0.0)),
    )
    (folder / "place.json").write_text(place.model_dump_json(by_alias=True))


def test_its_pictures_and_its_place_in_the_world(tmp_path: Path) -> None:
    write_result(tmp_path)
    found = read_cameras(tmp_path)
    assert (found.scale, found.crs, found.origin_m) == ("metres", "EPSG:25832", (10.0, 20.0, 30.0))
    assert found.up == (0.0, 0.0, 1.0)
    assert found.points is not None
    for own, camera in zip(made.ring(), found.cameras, strict=True):
        assert (camera.name, camera.width_px) == (own.name, 32)
        assert camera.picture is not None
        expected = 0.5 * own.project(made.POINTS)[0]
        np.testing.assert_allclose(camera.project(made.POINTS)[0], expected, atol=1e-6)


def test_the_photos_themselves_and_their_masks(tmp_path: Path) -> None:
    write_result(tmp_path / "result")
    made.write_pictures(tmp_path / "photos")
    made.write_pictures(tmp_path / "masks", 2)
    found = read_cameras(tmp_path / "result" / "place.json", tmp_path / "photos")
    assert found.cameras[0].width_px == made.WIDTH
    assert found.cameras[0].picture == tmp_path / "photos" / "a0.png"
    assert sorted(found.masks) == ["a0.png", "a1.png"]


def test_a_result_that_was_cut(tmp_path: Path) -> None:
    write_result(tmp_path)
    place = Place.model_validate_json((tmp_path / "place.json").read_bytes())
    fewer = place.model_copy(update={"cameras": place.cameras[:2]})
    (tmp_path / "place.json").write_text(fewer.model_dump_json(by_alias=True))
    with pytest.raises(InputError, match="pictures for 2 of 4 photos"):
        read_cameras(tmp_path)
    (tmp_path / "place.json").write_text("{}")
    with pytest.raises(InputError, match=r"is no result"):
        read_cameras(tmp_path)


def test_a_camera_without_its_picture_says_so(tmp_path: Path) -> None:
    write_result(tmp_path)
    (tmp_path / "pictures" / "a1.png").unlink()
    found = read_cameras(tmp_path)
    assert [camera.picture is None for camera in found.cameras] == [False, True, False, False]
