"""What a set of cameras is, for keys of results: its numbers, pictures, masks and points."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.cameras.camera import Camera, CameraSet
from veduta.run.digests import file_digest


def cameras_digest(cameras: CameraSet, used: Iterable[Camera] | None = None) -> JsonValue:
    """Changes with anything that a result of these cameras depends on.

    used: those that take part; all of them where it is None. OSError where a picture has gone.
    """
    rows: list[JsonValue] = []
    for one in cameras.cameras if used is None else used:
        numbers = [*one.focal_px, *one.centre_px, *one.cam_from_world.ravel(), *one.distortion]
        told = [float(number) for number in (*numbers, one.skew_px, one.width_px, one.height_px)]
        picture = None if one.picture is None else file_digest(one.picture)
        rows.append([one.name, picture, *told])
    masks: list[JsonValue] = [
        [name, file_digest(path)] for name, path in sorted(cameras.masks.items())
    ]
    origin = [float(value) for value in cameras.origin_m]
    points = [_of(cameras.points), _of(cameras.colours)]
    seen = [_of(rows_seen) for rows_seen in cameras.visible or ()]
    up: list[JsonValue] = [] if cameras.up is None else [*map(float, cameras.up)]
    return [rows, masks, cameras.scale, cameras.crs, [*origin], [*points], [*seen], up]


def _of(values: NDArray[np.generic] | None) -> str | None:
    if values is None:
        return None
    return hashlib.sha256(np.ascontiguousarray(values).tobytes()).hexdigest()
