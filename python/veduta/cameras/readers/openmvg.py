"""Cameras of OpenMVG: `sfm_data.json`, with views, intrinsics, extrinsics and structure."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.convention import Seen, require_convention
from veduta.cameras.files import COPY_AGAIN, picture_size, read_json
from veduta.cameras.pictures import LONGEST_NAME, Pictures, near, with_pictures
from veduta.cameras.projection import nearest_turn
from veduta.run.errors import InputError
from veduta.run.names import real_path

Floats = NDArray[np.float64]
DAMAGE = (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError)
_KEYS = {"sfm_data_version", "views", "intrinsics", "extrinsics"}
_FIRST_ID = 2**31
_DEEPEST = 8
"""Folders below one another, of the photos."""


def is_one(record: Any) -> bool:
    """Whether JSON is such a file."""
    return isinstance(record, dict) and set(record) >= _KEYS


def read(found: Path, images: Path | None) -> CameraSet:
    """The posed views, their points and where they were seen."""
    record = read_json(found)
    try:
        lenses = _intrinsics(found, record["intrinsics"])
        poses = {int(one["key"]): _pose(one["value"]) for one in record["extrinsics"]}
        cameras, numbers = _cameras(record["views"], lenses, poses)
        points, colours, visible, seen = _structure(record.get("structure") or [], numbers)
    except DAMAGE as error:
        fault = f"is not as OpenMVG writes it ({type(error).__name__}: {error})"
        raise InputError(found, fault, COPY_AGAIN) from None
    if not cameras:
        raise InputError(found, "has no view with a pose", "Export the reconstruction's result.")
    require_convention(found, cameras, seen)
    pictures = near(found, images)
    if images is None:
        pictures = Pictures([*pictures.folders, *_root(found, record.get("root_path"))])
    return CameraSet(
        cameras=with_pictures(cameras, pictures, found),
        points=points,
        colours=colours,
        visible=visible,
        source=str(found),
    )


def _root(found: Path, said: object) -> list[Path]:
    """The folder of photos that a file names, where that is below the file's own folder.

    An absolute one is of the machine that made the file; what lies there is not looked at.
    """
    if not isinstance(said, str) or not said or "\0" in said:
        return []
    parts = said.encode("utf-8", "replace").split(b"/")
    if max(map(len, parts)) > LONGEST_NAME or len(parts) > _DEEPEST or Path(said).is_absolute():
        return []
    folder = real_path(found.parent)
    root = real_path(folder / said)
    return [root] if root.is_relative_to(folder) else []


def _intrinsics(path: Path, rows: list[Any]) -> dict[int, dict[str, Any]]:
    """Size, focal length, centre and distortion by number. A pointer's data lie in ptr_wrapper."""
    found: dict[int, dict[str, Any]] = {}
    names: dict[int, str] = {}
    for row in rows:
        value = row["value"]
        number = int(value.get("polymorphic_id", 0))
        if "polymorphic_name" in value:
            names[number % _FIRST_ID] = str(value["polymorphic_name"])
        kind = names.get(number % _FIRST_ID, "pinhole")
        data = value["ptr_wrapper"]["data"]
        inner = data.get("value0", data)
        lens = _lens(path, kind, data)
        found[int(row["key"])] = {
            "size": picture_size(path, inner["width"], inner["height"]),
            "focal": _focal(path, float(inner["focal_length"])),
            "centre": _centre(inner["principal_point"]),
            "lens": lens,
        }
    return found


def _focal(path: Path, focal_px: float) -> float:
    if not (np.isfinite(focal_px) and focal_px > 0.0):
        fault = f"has a camera with a focal length of {focal_px} px"
        raise InputError(path, fault, COPY_AGAIN)
    return focal_px


def _centre(said: list[Any]) -> tuple[float, float]:
    """Ours, half a pixel on. ValueError where it is no pair of numbers."""
    x, y = (float(value) + 0.5 for value in said)
    if not (np.isfinite(x) and np.isfinite(y)):
        raise ValueError("a principal point is no place")
    return x, y


def _lens(path: Path, kind: str, data: dict[str, Any]) -> tuple[float, ...]:
    if "fisheye" in kind or "spherical" in kind:
        raise InputError(path, f"has a camera of the kind {kind}", "Undistort the photos first.")
    if "disto_k1" in data:
        return (float(data["disto_k1"][0]), 0.0, 0.0, 0.0)
    if "disto_k3" in data:
        k1, k2, k3 = (float(value) for value in data["disto_k3"])
        return (k1, k2, 0.0, 0.0, k3)
    if "disto_t2" in data:
        k1, k2, k3, t1, t2 = (float(value) for value in data["disto_t2"])
        return (k1, k2, t2, t1, k3)
    return ()


def _pose(value: dict[str, Any]) -> Floats:
    square, centre = np.array(value["rotation"], float), np.array(value["center"], float)
    turn = nearest_turn(square.reshape(3, 3), 1e-3)
    if turn is None or not np.isfinite(centre).all():
        raise ValueError("a rotation is no turn, or a centre no place")
    return np.column_stack([turn, -turn @ centre])


def _cameras(
    views: list[Any], lenses: dict[int, dict[str, Any]], poses: dict[int, Floats]
) -> tuple[tuple[Camera, ...], dict[int, int]]:
    """The cameras of views with a pose, and their places by the views' numbers."""
    cameras: list[Camera] = []
    numbers: dict[int, int] = {}
    for row in views:
        data = row["value"]["ptr_wrapper"]["data"]
        pose, lens = poses.get(int(data["id_pose"])), lenses.get(int(data["id_intrinsic"]))
        if pose is None or lens is None:
            continue
        numbers[int(data["id_view"])] = len(cameras)
        inner = str(data.get("local_path") or "").strip("/")
        name = str(data["filename"])
        cameras.append(
            Camera(
                name=f"{inner}/{name}" if inner else name,
                width_px=lens["size"][0],
                height_px=lens["size"][1],
                focal_px=(lens["focal"], lens["focal"]),
                centre_px=lens["centre"],
                cam_from_world=pose,
                distortion=lens["lens"] if any(lens["lens"]) else (),
            )
        )
    return tuple(cameras), numbers


def _structure(
    rows: list[Any], numbers: dict[int, int]
) -> tuple[
    Floats | None, NDArray[np.uint8] | None, tuple[NDArray[np.intp], ...] | None, dict[int, Seen]
]:
    if not rows:
        return None, None, None, {}
    points = np.array([row["value"]["X"] for row in rows], dtype=np.float64).reshape(-1, 3)
    sights: dict[int, list[tuple[int, float, float]]] = {index: [] for index in numbers.values()}
    for place, row in enumerate(rows):
        for sight in row["value"]["observations"]:
            index = numbers.get(int(sight["key"]))
            if index is not None:
                x, y = sight["value"]["x"]
                sights[index].append((place, float(x) + 0.5, float(y) + 0.5))
    seen, visible = {}, []
    for index in range(len(sights)):
        table = np.array(sights[index], dtype=np.float64).reshape(-1, 3)
        at = table[:, 0].astype(np.intp)
        seen[index] = Seen(points[at], table[:, 1:])
        visible.append(np.unique(at))
    return points, None, tuple(visible), seen
