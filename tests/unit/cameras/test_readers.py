"""Each source's files, written by the rules of that source, give the cameras they were made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from cameras import sets_of_cameras as made

from veduta.cameras import CameraSet, read_cameras

Writer = Callable[[Path], None]


def same(found: CameraSet, *, focal_of_x: bool = False, most: float = 1e-6) -> None:
    """The found cameras see the points where the ring does."""
    assert len(found) == 4
    for own, camera in zip(made.ring(), found.cameras, strict=True):
        expected = own.project(made.POINTS)[0]
        if focal_of_x:
            expected[:, 1] = (expected[:, 1] - 24.5) * 70.0 / 71.0 + 24.5
        np.testing.assert_allclose(camera.project(made.POINTS)[0], expected, atol=most)
        assert camera.picture is not None
        assert camera.picture.name == own.name


@pytest.mark.parametrize(
    "write",
    [
        lambda folder: made.write_strecha(folder / "cameras", made.ring()),
        lambda folder: made.write_strecha(folder / "cameras", made.ring(), 2.0),
        lambda folder: made.write_middlebury(folder, made.ring()),
        lambda folder: made.write_mat(folder, [made.corner_projection(c) for c in made.ring()]),
        lambda folder: made.write_mat(
            folder, [-2 * made.corner_projection(c) for c in made.ring()]
        ),
        lambda folder: made.write_opencv(folder, made.ring(), [0.0] * 5),
        lambda folder: made.write_opensfm(folder, made.ring()),
        lambda folder: made.write_colmap(folder / "sparse" / "0", made.ring()),
    ],
)
def test_the_cameras_are_found_again(write: Writer, tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    write(tmp_path)
    same(read_cameras(tmp_path))


def test_openmvg_has_one_focal_length(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    made.write_openmvg(tmp_path, [replace(c, focal_px=(70.0, 70.0)) for c in made.ring()])
    found = read_cameras(tmp_path / "sfm_data.json")
    same(found, focal_of_x=True)
    assert found.points is not None
    assert found.visible is not None
    np.testing.assert_array_equal(found.visible[2], np.arange(len(made.POINTS)))


@pytest.mark.parametrize("form", ["lines of 12", "lines of 4", "a file each", "CONTOUR"])
def test_matrices_as_text(form: str, tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    matrices = [made.corner_projection(camera) for camera in made.ring()]
    rows = [[" ".join(f"{value:.14g}" for value in row) for row in matrix] for matrix in matrices]
    if form == "lines of 12":
        (tmp_path / "p.txt").write_text("\n".join(" ".join(row) for row in rows))
    elif form == "lines of 4":
        (tmp_path / "p.txt").write_text("\n\n".join("\n".join(row) for row in rows))
    else:
        head = "CONTOUR\n" if form == "CONTOUR" else ""
        for number, row in enumerate(rows):
            suffix = "txt" if head else "P"
            (tmp_path / f"a{number}.{suffix}").write_text(head + "\n".join(row))
    same(read_cameras(tmp_path))


def test_a_left_handed_world_is_turned_over_and_told(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    mirror = np.diag([1.0, 1.0, -1.0, 1.0])
    made.write_mat(tmp_path, [made.corner_projection(camera) @ mirror for camera in made.ring()])
    found = read_cameras(tmp_path)
    same(found)
    assert "left-handed" in found.notes[0]


@pytest.mark.parametrize(
    ("names", "keys"),
    [
        (("image_2", "image_3"), True),
        (("image_l", "image_r"), False),
        (("image_0", "image_1"), True),
        (("image_l", "image_r"), True),
    ],
)
def test_kitti_in_its_layouts(names: tuple[str, str], keys: bool, tmp_path: Path) -> None:
    made.write_kitti(tmp_path, made.ring(), names, keys=keys)
    found = read_cameras(tmp_path)
    assert [camera.name for camera in found.cameras[:2]] == [f"{n}/000000.png" for n in names]
    for own, left, right in zip(made.ring(), found.cameras[::2], found.cameras[1::2], strict=True):
        np.testing.assert_allclose(
            left.project(made.POINTS)[0], own.project(made.POINTS)[0], atol=1e-6
        )
        aside = own.centre() + 0.5 * own.cam_from_world[0, :3]
        np.testing.assert_allclose(right.centre(), aside, atol=1e-8)
    assert found.scale == "metres"
    assert found.up == (0.0, -1.0, 0.0)


def test_opencv_lens_and_a_file_for_each_photo(tmp_path: Path) -> None:
    made.write_pictures(tmp_path)
    for camera in made.ring():
        storage = cv2.FileStorage(
            str(tmp_path / f"{Path(camera.name).stem}.yaml"), cv2.FILE_STORAGE_WRITE
        )
        storage.write("K", made.corner_matrix(camera))
        storage.write("D", np.array([0.1, 0.01, 0.0, 0.0]))
        storage.write("R", camera.cam_from_world[:, :3])
        storage.write("t", camera.cam_from_world[:, 3])
        storage.release()
    found = read_cameras(tmp_path)
    assert [camera.distortion for camera in found.cameras] == [(0.1, 0.01, 0.0, 0.0)] * 4
    np.testing.assert_allclose(found.cameras[3].centre(), made.ring()[3].centre())


def test_colmap_tells_what_each_camera_sees(tmp_path: Path) -> None:
    made.write_colmap(tmp_path, made.ring())
    found = read_cameras(tmp_path)
    assert found.points is not None
    assert found.visible is not None
    assert found.colours is not None
    np.testing.assert_allclose(found.points, made.POINTS)
    assert all(len(rows) == len(made.POINTS) for rows in found.visible)
    assert found.cameras[0].picture is None


def test_photos_elsewhere_are_named(tmp_path: Path) -> None:
    made.write_colmap(tmp_path / "model", made.ring())
    made.write_pictures(tmp_path / "far" / "away", size=(32, 24))
    found = read_cameras(tmp_path / "model", tmp_path / "far" / "away")
    assert (found.cameras[0].width_px, found.cameras[0].focal_px) == (32, (35.0, 35.5))
