"""Reading a model of COLMAP from its binary files (little-endian, without padding)."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.colmap_model import (
    COPY_AGAIN,
    MODELS,
    ColmapCamera,
    ColmapImage,
    ColmapPoints,
    checked_camera,
    checked_points,
    pose,
    require_few,
)
from veduta.run.errors import InputError

LONGEST_NAME = 4096
_CAMERA = "<iiQQ"
_IMAGE = "<i7di"
_PLACE = np.dtype([("x", "<f8"), ("y", "<f8"), ("point", "<i8")])
_POINT = np.dtype(
    [
        ("number", "<i8"),
        ("place", "<f8", 3),
        ("colour", "u1", 3),
        ("error", "<f8"),
        ("length", "<u8"),
    ]
)
_TRACK_ITEM = 8
_AT_ONCE = 1 << 18
"""Points that are taken out of their records at once: the places of their bytes take eight times
the memory that these do."""


@dataclass
class _Bytes:
    """A file's bytes, read from the front; InputError where they end too early."""

    path: Path
    data: bytes
    at: int = 0

    def unpack(self, form: str) -> tuple[Any, ...]:
        self.need(struct.calcsize(form))
        found = struct.unpack_from(form, self.data, self.at)
        self.at += struct.calcsize(form)
        return found

    def array(self, dtype: np.dtype[Any], count: int) -> NDArray[Any]:
        self.need(count * dtype.itemsize)
        found = np.frombuffer(self.data, dtype, count, self.at)
        self.at += count * dtype.itemsize
        return found

    def count(self, smallest: int) -> int:
        """How many records follow, each of at least so many bytes."""
        (count,) = self.unpack("<Q")
        self.need(count * smallest)
        return int(count)

    def name(self) -> str:
        end = self.data.find(b"\0", self.at, self.at + LONGEST_NAME)
        if end < 0:
            raise self.damaged()
        found = self.data[self.at : end].decode("utf-8", "replace")
        self.at = end + 1
        return found

    def need(self, size: int) -> None:
        if size > len(self.data) - self.at:
            raise self.damaged()

    def damaged(self) -> InputError:
        return InputError(self.path, "is truncated or damaged", COPY_AGAIN)


def read_cameras(path: Path, data: bytes) -> dict[int, ColmapCamera]:
    """`cameras.bin`."""
    file = _Bytes(path, data)
    cameras = {}
    count = file.count(struct.calcsize(_CAMERA))
    require_few(path, "cameras", count)
    for _ in range(count):
        number, model, width, height = file.unpack(_CAMERA)
        if not 0 <= model < len(MODELS):
            raise InputError(path, f"has a camera of an unknown model ({model})", COPY_AGAIN)
        name, size = MODELS[model]
        camera = ColmapCamera(name, width, height, file.unpack(f"<{size}d"))
        cameras[number] = checked_camera(path, camera)
    return cameras


def read_images(path: Path, data: bytes) -> tuple[ColmapImage, ...]:
    """`images.bin`."""
    file = _Bytes(path, data)
    images = []
    count = file.count(struct.calcsize(_IMAGE) + 9)
    require_few(path, "images", count)
    for _ in range(count):
        number, *numbers, camera = file.unpack(_IMAGE)
        name = file.name()
        seen = file.array(_PLACE, file.count(_PLACE.itemsize))
        images.append(
            ColmapImage(
                number=number,
                name=name,
                camera=camera,
                cam_from_world=pose(path, name, np.array(numbers[:4]), np.array(numbers[4:])),
                places_px=np.column_stack([seen["x"], seen["y"]]),
                points=seen["point"].astype(np.int64),
            )
        )
    return tuple(images)


def read_points(path: Path, data: bytes) -> ColmapPoints:
    """`points3D.bin`. The tracks are not read: the images say the same."""
    file = _Bytes(path, data)
    count = file.count(_POINT.itemsize)
    starts = _starts(file, count)
    points = ColmapPoints(np.empty(count, "i8"), np.empty((count, 3)), np.empty((count, 3), "u1"))
    content, offsets = np.frombuffer(data, np.uint8), np.arange(_POINT.itemsize)
    for first in range(0, count, _AT_ONCE):
        some = slice(first, first + _AT_ONCE)
        rows = content[starts[some, None] + offsets].reshape(-1).view(_POINT)
        points.numbers[some], points.places[some] = rows["number"], rows["place"]
        points.colours[some] = rows["colour"]
    return checked_points(path, points)


def _starts(file: _Bytes, count: int) -> NDArray[np.int64]:
    """(count,) where each point's record begins: its length is known when the last one's is."""
    starts = np.empty(count, dtype=np.int64)
    length_of = struct.Struct("<Q").unpack_from
    at, fixed, end = file.at, _POINT.itemsize, len(file.data)
    for row in range(count):
        if at + fixed > end:
            raise file.damaged()
        starts[row] = at
        at += fixed + _TRACK_ITEM * length_of(file.data, at + fixed - 8)[0]
    if at > end:
        raise file.damaged()
    return starts
