"""Cameras of OpenSfM: `reconstruction.json`, the first (largest) reconstruction.

Lengths are in shares of the photo's longer side, about its middle; the rotation is an axis times an
angle, camera from world. The world's z points up, in metres, where the photos had positions.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.files import COPY_AGAIN, picture_size, read_json
from veduta.cameras.pictures import near, with_pictures
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
DAMAGE = (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError, cv2.error)
_KEYS = {"cameras", "shots"}
_FOLLOWED = ("perspective", "brown", "simple_radial", "radial")


def is_one(record: Any) -> bool:
    """Whether JSON is such a file: a list of reconstructions."""
    first = record[0] if isinstance(record, list) and record else None
    return isinstance(first, dict) and set(first) >= _KEYS


def read(found: Path, images: Path | None) -> CameraSet:
    """The shots of the largest reconstruction, and its points."""
    records = read_json(found)
    try:
        record = max(records, key=lambda one: len(one["shots"]))
        cameras = tuple(
            _shot(found, name, shot, record["cameras"][shot["camera"]])
            for name, shot in sorted(record["shots"].items())
        )
        rows = list((record.get("points") or {}).values())
        points = np.array([row["coordinates"] for row in rows], float).reshape(-1, 3)
        colours = np.array([row.get("color", (255, 255, 255)) for row in rows], float)
    except DAMAGE as error:
        fault = f"is not as OpenSfM writes it ({type(error).__name__}: {error})"
        raise InputError(found, fault, COPY_AGAIN) from None
    if not cameras:
        raise InputError(found, "has no shot", "Export the reconstruction's result.")
    others = len(records) - 1
    note = f"the largest of {len(records)} reconstructions is used"
    return CameraSet(
        cameras=with_pictures(cameras, near(found, images), found),
        points=points if len(points) else None,
        colours=np.clip(colours.reshape(-1, 3), 0, 255).astype(np.uint8) if len(points) else None,
        source=str(found),
        up=(0.0, 0.0, 1.0),
        notes=(note,) if others else (),
    )


def _shot(path: Path, name: str, shot: dict[str, Any], lens: dict[str, Any]) -> Camera:
    kind = str(lens["projection_type"])
    if kind not in _FOLLOWED:
        fault = f"has a camera of the kind {kind}"
        raise InputError(path, fault, "Undistort the photos first (`opensfm undistort`).")
    width, height = picture_size(path, lens["width"], lens["height"])
    side = float(max(width, height))
    across = float(lens.get("focal_x", lens.get("focal", 0.0)))
    down = float(lens.get("focal_y", across))
    if not (across > 0.0 and down > 0.0):
        raise ValueError("a camera has no positive focal length")
    turn = cv2.Rodrigues(np.array(shot["rotation"], dtype=np.float64))[0]
    shift = np.array(shot["translation"], dtype=np.float64).reshape(3)
    k1, k2, k3, p1, p2 = (float(lens.get(key, 0.0)) for key in ("k1", "k2", "k3", "p1", "p2"))
    bends = (k1, k2, p1, p2, k3)
    return Camera(
        name=name,
        width_px=width,
        height_px=height,
        focal_px=(across * side, down * side),
        centre_px=(
            float(lens.get("c_x", 0.0)) * side + 0.5 * width,
            float(lens.get("c_y", 0.0)) * side + 0.5 * height,
        ),
        cam_from_world=np.column_stack([turn, shift]),
        distortion=bends if any(bends) else (),
    )
