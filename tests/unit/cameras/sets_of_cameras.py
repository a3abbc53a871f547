"""A ring of cameras around some points, and its files as other software writes them."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import scipy.io
from numpy.typing import NDArray

from veduta.cameras import Camera

WIDTH, HEIGHT = 64, 48
POINTS = np.random.default_rng(3).normal(0.0, 0.4, (40, 3))
Floats = NDArray[np.float64]


def ring(count: int = 4) -> list[Camera]:
    """Cameras three units from the origin that look at it, with pictures named a0.png and on."""
    cameras = []
    for number in range(count):
        angle = 0.7 * number
        centre = 3.0 * np.array([np.cos(angle), np.sin(angle), 0.3])
        forward = -centre / np.linalg.norm(centre)
        right = np.cross(forward, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        turn = np.array([right, np.cross(forward, right), forward])
        pose = np.column_stack([turn, -turn @ centre])
        cameras.append(Camera(f"a{number}.png", WIDTH, HEIGHT, (70.0, 71.0), (31.0, 24.5), pose))
    return cameras


def write_pictures(folder: Path, count: int = 4, size: tuple[int, int] = (WIDTH, HEIGHT)) -> None:
    """Grey pictures with the cameras' names."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(count):
        cv2.imwrite(str(folder / f"a{number}.png"), np.full((size[1], size[0], 3), 90, np.uint8))


def corner_matrix(camera: Camera) -> Floats:
    """K of software whose first pixel's middle is (0, 0)."""
    matrix = camera.matrix()
    matrix[:2, 2] -= 0.5
    return matrix


def corner_projection(camera: Camera) -> Floats:
    """P of such software."""
    return corner_matrix(camera) @ camera.cam_from_world


def write_strecha(folder: Path, cameras: list[Camera], factor: float = 1.0) -> None:
    """`.camera` files, of pictures so many times larger."""
    folder.mkdir(parents=True, exist_ok=True)
    for camera in cameras:
        matrix = camera.matrix()
        matrix[:2] *= factor
        matrix[:2, 2] -= 0.5
        turn = camera.cam_from_world[:, :3]
        rows = [*matrix, np.zeros(3), *turn.T, camera.centre()]
        rows.append(np.array([WIDTH * factor, HEIGHT * factor]))
        text = "\n".join(" ".join(f"{value:.12g}" for value in row) for row in rows)
        (folder / f"{camera.name}.camera").write_text(text)


def write_middlebury(folder: Path, cameras: list[Camera]) -> None:
    """`ring_par.txt`."""
    lines = [str(len(cameras))]
    for camera in cameras:
        turn, shift = camera.cam_from_world[:, :3], camera.cam_from_world[:, 3]
        values = [*corner_matrix(camera).ravel(), *turn.ravel(), *shift]
        lines.append(f"{camera.name} " + " ".join(f"{value:.12g}" for value in values))
    (folder / "ring_par.txt").write_text("\n".join(lines))


def write_mat(folder: Path, matrices: list[Floats], **more: object) -> None:
    """`P.mat` with a cell array."""
    cells = np.empty((1, len(matrices)), dtype=object)
    for number, matrix in enumerate(matrices):
        cells[0, number] = matrix
    scipy.io.savemat(folder / "P.mat", {"P": cells, **more})


def write_opencv(folder: Path, cameras: list[Camera], lens: list[float]) -> None:
    """One YAML for all, as OpenCV's calibration example writes it."""
    storage = cv2.FileStorage(str(folder / "calibration.yml"), cv2.FILE_STORAGE_WRITE)
    storage.write("image_width", WIDTH)
    storage.write("image_height", HEIGHT)
    storage.write("camera_matrix", corner_matrix(cameras[0]))
    storage.write("distortion_coefficients", np.array(lens)[:, None])
    rows = [
        np.concatenate(
            [cv2.Rodrigues(one.cam_from_world[:, :3])[0].ravel(), one.cam_from_world[:, 3]]
        )
        for one in cameras
    ]
    storage.write("extrinsic_parameters", np.array(rows))
    storage.release()


def write_openmvg(folder: Path, cameras: list[Camera]) -> None:
    """`sfm_data.json` with one focal length and points."""
    centre = [value - 0.5 for value in cameras[0].centre_px]
    data = {
        "width": WIDTH,
        "height": HEIGHT,
        "focal_length": cameras[0].focal_px[0],
        "principal_point": centre,
    }
    structure = []
    for number, point in enumerate(POINTS):
        sights = []
        for key, camera in enumerate(cameras):
            place = camera.project(point)[0][0] - 0.5
            sights.append({"key": key, "value": {"id_feat": number, "x": place.tolist()}})
        structure.append({"key": number, "value": {"X": point.tolist(), "observations": sights}})
    record = {
        "sfm_data_version": "0.3",
        "root_path": "",
        "views": [
            {
                "key": key,
                "value": {
                    "ptr_wrapper": {
                        "data": {
                            "local_path": "",
                            "filename": camera.name,
                            "id_view": key,
                            "id_intrinsic": 0,
                            "id_pose": key,
                        }
                    }
                },
            }
            for key, camera in enumerate(cameras)
        ],
        "intrinsics": [
            {
                "key": 0,
                "value": {
                    "polymorphic_id": 2147483649,
                    "polymorphic_name": "pinhole",
                    "ptr_wrapper": {"id": 2147483649, "data": data},
                },
            }
        ],
        "extrinsics": [
            {
                "key": key,
                "value": {
                    "rotation": camera.cam_from_world[:, :3].tolist(),
                    "center": camera.centre().tolist(),
                },
            }
            for key, camera in enumerate(cameras)
        ],
        "structure": structure,
    }
    (folder / "sfm_data.json").write_text(json.dumps(record))


def write_opensfm(folder: Path, cameras: list[Camera]) -> None:
    """`reconstruction.json` of a Brown camera."""
    first = cameras[0]
    side = max(WIDTH, HEIGHT)
    lens = {
        "projection_type": "brown",
        "width": WIDTH,
        "height": HEIGHT,
        "focal_x": first.focal_px[0] / side,
        "focal_y": first.focal_px[1] / side,
        "c_x": (first.centre_px[0] - 0.5 * WIDTH) / side,
        "c_y": (first.centre_px[1] - 0.5 * HEIGHT) / side,
    }
    shots = {
        one.name: {
            "camera": "v1",
            "rotation": cv2.Rodrigues(one.cam_from_world[:, :3])[0].ravel().tolist(),
            "translation": one.cam_from_world[:, 3].tolist(),
        }
        for one in cameras
    }
    points = {
        str(number): {"coordinates": point.tolist(), "color": [10, 20, 30]}
        for number, point in enumerate(POINTS)
    }
    record = [{"cameras": {"v1": lens}, "shots": shots, "points": points}]
    (folder / "reconstruction.json").write_text(json.dumps(record))


def write_colmap(folder: Path, cameras: list[Camera], places: list[Floats] | None = None) -> None:
    """A text model with all points seen by all cameras, at the given places (px)."""
    folder.mkdir(parents=True, exist_ok=True)
    first = cameras[0]
    intrinsics = " ".join(f"{value}" for value in (*first.focal_px, *first.centre_px))
    (folder / "cameras.txt").write_text(f"1 PINHOLE {WIDTH} {HEIGHT} {intrinsics}\n")
    lines = []
    for number, camera in enumerate(cameras):
        turn = camera.cam_from_world[:, :3]
        w = 0.5 * np.sqrt(1.0 + np.trace(turn))
        x, y, z = (turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1])
        pose = [w, x / (4 * w), y / (4 * w), z / (4 * w), *camera.cam_from_world[:, 3]]
        lines.append(f"{number + 1} " + " ".join(map(repr, map(float, pose))) + f" 1 {camera.name}")
        seen = camera.project(POINTS)[0] if places is None else places[number]
        lines.append(" ".join(f"{x} {y} {n}" for n, (x, y) in enumerate(seen)))
    (folder / "images.txt").write_text("\n".join(lines) + "\n")
    rows = [f"{n} {p[0]} {p[1]} {p[2]} 10 20 30 0.1 1 1" for n, p in enumerate(POINTS)]
    (folder / "points3D.txt").write_text("\n".join(rows) + "\n")


def write_kitti(folder: Path, cameras: list[Camera], names: tuple[str, str], *, keys: bool) -> None:
    """A sequence whose first camera made the given poses, and a second one half a metre right."""
    first = cameras[0]
    matrix = corner_matrix(first)
    baseline = np.column_stack([np.eye(3), [-0.5, 0.0, 0.0]])
    rows = [matrix @ np.eye(3, 4), matrix @ baseline]
    if names[0] == "image_2":
        rows = [rows[0], rows[0], *rows]
    lines = [" ".join(f"{value:.12e}" for value in row.ravel()) for row in rows]
    if keys:
        lines = [f"P{number}: {line}" for number, line in enumerate(lines)] + ["Tr: " + lines[0]]
    poses = []
    for camera in cameras:
        turn = camera.cam_from_world[:, :3].T
        poses.append(np.column_stack([turn, camera.centre()]).ravel())
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "calib.txt").write_text("\n".join(lines))
    text = "\n".join(" ".join(f"{value:.12e}" for value in pose) for pose in poses)
    (folder / "poses.txt").write_text(text)
    for name in names:
        (folder / name).mkdir()
        for number in range(len(cameras)):
            picture = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
            cv2.imwrite(str(folder / name / f"{number:06d}.png"), picture)
