"""Files that are no cameras, or mean something else: refused with the file, the fault, a remedy."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cameras import sets_of_cameras as made

from veduta.cameras import read_cameras
from veduta.run.errors import InputError


def refused(path: Path, fault: str, images: Path | None = None) -> InputError:
    with pytest.raises(InputError, match=fault) as caught:
        read_cameras(path, images)
    assert caught.value.remedy
    return caught.value


def test_nothing_there(tmp_path: Path) -> None:
    refused(tmp_path / "none", "does not exist")
    refused(tmp_path, "holds no cameras")
    (tmp_path / "a.json").write_text("{}")
    refused(tmp_path / "a.json", "holds no cameras")
    made.write_colmap(tmp_path / "m", made.ring())
    refused(tmp_path / "m", "does not exist", tmp_path / "nowhere")


def test_two_kinds_in_one_folder(tmp_path: Path) -> None:
    made.write_pictures(tmp_path)
    made.write_middlebury(tmp_path, made.ring())
    made.write_strecha(tmp_path, made.ring())
    refused(tmp_path, "two kinds")


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (np.diag([-1.0, 1.0, 1.0]), "left and right"),
        (np.diag([1.0, -1.0, 1.0]), "up and down"),
    ],
)
def test_a_model_of_another_convention(change: np.ndarray, fault: str, tmp_path: Path) -> None:
    places = []
    for camera in made.ring():
        local = made.POINTS @ camera.cam_from_world[:, :3].T + camera.cam_from_world[:, 3]
        local = local @ change.T
        places.append(local[:, :2] / local[:, 2:] * camera.focal_px + np.array(camera.centre_px))
    made.write_colmap(tmp_path, made.ring(), places)
    error = refused(tmp_path, fault)
    assert error.subject.endswith("images.txt")


def test_a_model_of_opengl(tmp_path: Path) -> None:
    places = [camera.project(made.POINTS)[0] for camera in made.ring()]
    turned = np.diag([1.0, -1.0, -1.0])
    flipped = [replace(one, cam_from_world=turned @ one.cam_from_world) for one in made.ring()]
    made.write_colmap(tmp_path, flipped, places)
    refused(tmp_path, "OpenGL")


def test_a_model_of_inverted_poses(tmp_path: Path) -> None:
    inverted = []
    for camera in made.ring():
        turn = camera.cam_from_world[:, :3].T
        inverted.append(replace(camera, cam_from_world=np.column_stack([turn, camera.centre()])))
    places = [camera.project(made.POINTS)[0] for camera in made.ring()]
    made.write_colmap(tmp_path, inverted, places)
    refused(tmp_path, "world-from-camera")


def test_a_model_of_larger_pictures_and_one_that_fits_nothing(tmp_path: Path) -> None:
    places = [2.0 * camera.project(made.POINTS)[0] for camera in made.ring()]
    made.write_colmap(tmp_path / "a", made.ring(), places)
    refused(tmp_path / "a", "another size")
    wrong = [place[::-1] for place in places]
    made.write_colmap(tmp_path / "b", made.ring(), wrong)
    refused(tmp_path / "b", "not where its cameras saw them")


def test_photos_of_another_shape(tmp_path: Path) -> None:
    made.write_colmap(tmp_path, made.ring())
    made.write_pictures(tmp_path / "images", size=(64, 40))
    refused(tmp_path, "64 x 40 px")


def test_a_lens_that_is_not_followed(tmp_path: Path) -> None:
    made.write_colmap(tmp_path, made.ring())
    (tmp_path / "cameras.txt").write_text("1 OPENCV_FISHEYE 64 48 70 70 32 24 0 0 0 0\n")
    error = refused(tmp_path, "OPENCV_FISHEYE")
    assert "image_undistorter" in error.remedy


def test_damaged_camera_files(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    made.write_strecha(tmp_path, made.ring())
    path = tmp_path / "a1.png.camera"
    whole = path.read_text()
    for text, fault in [
        (whole[:60], "numbers, not 26"),
        (whole.replace("70", "seventy", 1), "no numbers"),
        (whole.replace("70", "nan", 1), "not finite"),
        (whole.replace("70", "-70", 1), "not positive"),
    ]:
        path.write_text(text)
        assert refused(tmp_path, fault).subject == str(path)
    path.write_bytes(b"\xff\xfe\x00" * 9)
    refused(tmp_path, "not a text file")


def test_damaged_lists(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    made.write_middlebury(tmp_path, made.ring())
    path = tmp_path / "ring_par.txt"
    lines = path.read_text().split("\n")
    path.write_text("\n".join(lines[:-1]))
    refused(tmp_path, "says 4 photos and has 3")
    path.write_text("\n".join([*lines[:-1], " ".join(lines[-1].split()[:-2])]))
    refused(tmp_path, "has 19 numbers, not 21")
    path.write_text("\n".join([*lines[:-1], lines[-1].replace("a3", "b3")]))
    refused(tmp_path, "b3.png is not there")


def test_damaged_matrices(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images", 3)
    projections = [made.corner_projection(camera) for camera in made.ring()]
    made.write_mat(tmp_path, projections)
    refused(tmp_path, "4 matrices, but there are 3 photos")
    made.write_mat(tmp_path, [projections[0], np.ones((3, 4))])
    refused(tmp_path, "matrix 2 is no camera's")
    path = tmp_path / "P.mat"
    path.write_bytes(path.read_bytes()[:150])
    refused(path, "truncated or damaged|no projection matrices")


def test_damaged_sequences(tmp_path: Path) -> None:
    made.write_kitti(tmp_path, made.ring(), ("image_2", "image_3"), keys=True)
    poses = (tmp_path / "poses.txt").read_text()
    (tmp_path / "poses.txt").write_text(poses.split("\n")[0])
    refused(tmp_path, "none for frame 1")
    (tmp_path / "poses.txt").unlink()
    refused(tmp_path, "does not exist")
    (tmp_path / "poses.txt").write_text(poses)
    (tmp_path / "calib.txt").write_text("S_02: 1 2\n")
    refused(tmp_path, "no matrix P0 to P3")


@pytest.mark.parametrize("name", ["sfm_data.json", "reconstruction.json"])
def test_damaged_json(name: str, tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    (made.write_openmvg if name == "sfm_data.json" else made.write_opensfm)(tmp_path, made.ring())
    path = tmp_path / name
    text = path.read_text()
    path.write_text(text[: len(text) // 2])
    refused(path, "no JSON")
    path.write_text("[" * 100_000)
    refused(path, "nested too deep|no JSON")
    record = json.loads(text)
    if name == "sfm_data.json":
        record["extrinsics"][0]["value"]["rotation"] = [[1.0, 2.0]]
    else:
        record[0]["shots"]["a0.png"]["rotation"] = "none"
    path.write_text(json.dumps(record))
    refused(path, "not as Open")


def test_damaged_yaml(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    made.write_opencv(tmp_path, made.ring(), [0.1] * 7)
    refused(tmp_path, "7 distortion coefficients")
    path = tmp_path / "calibration.yml"
    path.write_text(path.read_text()[:300] + "\n  x: [")
    refused(path, "not as OpenCV writes it|no pose")


def test_sizes_that_no_picture_has(tmp_path: Path) -> None:
    made.write_pictures(tmp_path / "images")
    made.write_opencv(tmp_path, made.ring(), [0.0] * 5)
    path = tmp_path / "calibration.yml"
    whole = path.read_text()
    for width in (".Inf", "-3", "200000"):
        path.write_text(whole.replace("image_width: 64", f"image_width: {width}"))
        refused(tmp_path, "has a camera of")


def test_a_name_that_no_file_has(tmp_path: Path) -> None:
    made.write_colmap(tmp_path, made.ring())
    path = tmp_path / "images.txt"
    path.write_text(path.read_text().replace("a2.png", "a" * 3000 + ".png"))
    assert read_cameras(tmp_path).cameras[-1].picture is None


def test_photos_outside_of_the_folder_are_not_looked_at(tmp_path: Path) -> None:
    model = tmp_path / "model" / "sparse"
    model.mkdir(parents=True)
    elsewhere = tmp_path / "elsewhere"
    made.write_pictures(elsewhere)
    made.write_openmvg(model, made.ring())
    path = model / "sfm_data.json"
    record = json.loads(path.read_text())
    (model / "linked").symlink_to(elsewhere)
    for root in (str(elsewhere), "../../elsewhere", "linked", "a" * 3000, "a/" * 3000, "a\0b", 7):
        path.write_text(json.dumps(record | {"root_path": root}))
        assert [one.picture for one in read_cameras(path).cameras] == [None] * 4
    made.write_pictures(model / "taken" / "first")
    path.write_text(json.dumps(record | {"root_path": "taken/first"}))
    assert read_cameras(path).cameras[0].picture == model / "taken" / "first" / "a0.png"
    path.write_text(json.dumps(record))
    assert read_cameras(path, elsewhere).cameras[0].picture == elsewhere / "a0.png"


@pytest.mark.parametrize("focal", ["0.0", "-70.0", "NaN", "Infinity"])
def test_openmvg_without_a_focal_length(focal: str, tmp_path: Path) -> None:
    made.write_openmvg(tmp_path, made.ring())
    path = tmp_path / "sfm_data.json"
    record = json.loads(path.read_text())
    inner = record["intrinsics"][0]["value"]["ptr_wrapper"]["data"]
    inner["focal_length"] = float(focal.replace("Infinity", "inf"))
    path.write_text(json.dumps(record))
    assert refused(path, "a focal length of").subject == str(path)


def test_texts_that_are_no_files(tmp_path: Path) -> None:
    (tmp_path / "gone.txt").symlink_to(tmp_path / "nowhere")
    (tmp_path / "folder.txt").mkdir()
    (tmp_path / "deep.P").mkdir()
    refused(tmp_path, "holds no cameras")
    projections = [made.corner_projection(camera) for camera in made.ring()]
    rows = "\n".join(" ".join(map(str, one.ravel().tolist())) for one in projections)
    (tmp_path / "all.txt").write_text(rows)
    made.write_pictures(tmp_path / "images")
    assert len(read_cameras(tmp_path).cameras) == 4


@pytest.mark.parametrize("centre", [[40.0, 30.0, 1.0], [40.0], [float("nan"), 30.0], []])
def test_openmvg_with_a_principal_point_that_is_no_place(
    centre: list[float], tmp_path: Path
) -> None:
    made.write_openmvg(tmp_path, made.ring())
    path = tmp_path / "sfm_data.json"
    record = json.loads(path.read_text())
    record["intrinsics"][0]["value"]["ptr_wrapper"]["data"]["principal_point"] = centre
    path.write_text(json.dumps(record))
    assert refused(path, "not as OpenMVG writes it").subject == str(path)
