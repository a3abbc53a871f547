"""Reading a model of COLMAP from its text files."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np

from veduta.formats.colmap_model import (
    COPY_AGAIN,
    ColmapCamera,
    ColmapImage,
    ColmapPoints,
    checked_camera,
    checked_points,
    pose,
    require_few,
)
from veduta.run.errors import InputError


def read_cameras(path: Path, data: bytes) -> dict[int, ColmapCamera]:
    """`cameras.txt`: number, model, width, height, parameters."""
    cameras: dict[int, ColmapCamera] = {}
    for place, line in enumerate(_lines(path, data), 1):
        words = line.split()
        if not words or line.startswith("#"):
            continue
        try:
            number, model, width, height = int(words[0]), words[1], int(words[2]), int(words[3])
            params = tuple(float(word) for word in words[4:])
        except (ValueError, IndexError):
            raise _wrong(path, place) from None
        require_few(path, "cameras", len(cameras) + 1)
        cameras[number] = checked_camera(path, ColmapCamera(model, width, height, params))
    return cameras


def read_images(path: Path, data: bytes) -> tuple[ColmapImage, ...]:
    """`images.txt`: a line with pose and name, and one with what is seen, which may be empty."""
    lines = _lines(path, data)
    images: list[ColmapImage] = []
    place = 0
    while place < len(lines):
        line = lines[place]
        place += 1
        if not line.strip() or line.startswith("#"):
            continue
        words = line.split(maxsplit=9)
        try:
            number, camera, name = int(words[0]), int(words[8]), words[9].strip()
            numbers = np.array(words[1:8], dtype=np.float64)
        except (ValueError, IndexError):
            raise _wrong(path, place) from None
        try:
            seen = np.array(lines[place].split() if place < len(lines) else [], dtype=np.float64)
            seen = seen.reshape(-1, 3)
            points = seen[:, 2].astype(np.int64)
        except ValueError:
            raise _wrong(path, place + 1) from None
        place += 1
        require_few(path, "images", len(images) + 1)
        images.append(
            ColmapImage(
                number=number,
                name=name,
                camera=camera,
                cam_from_world=pose(path, name, numbers[:4], numbers[4:]),
                places_px=seen[:, :2],
                points=points,
            )
        )
    return tuple(images)


def read_points(path: Path, data: bytes) -> ColmapPoints:
    """`points3D.txt`. The tracks are not read: the images say the same."""
    text = "\n".join(_lines(path, data))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that there are no points is for the caller to say
            rows = np.loadtxt(io.StringIO(text), usecols=range(7), ndmin=2, dtype=np.float64)
    except ValueError:
        raise InputError(path, "is truncated or damaged", COPY_AGAIN) from None
    rows = rows.reshape(-1, 7)
    if not np.isfinite(rows).all() or ((rows[:, 4:] < 0) | (rows[:, 4:] > 255)).any():
        raise InputError(path, "has points that cannot be true", COPY_AGAIN)
    points = ColmapPoints(rows[:, 0].astype(np.int64), rows[:, 1:4], rows[:, 4:].astype(np.uint8))
    return checked_points(path, points)


def _lines(path: Path, data: bytes) -> list[str]:
    try:
        return data.decode("utf-8").splitlines()
    except UnicodeDecodeError:
        raise InputError(path, "is not a text file", COPY_AGAIN) from None


def _wrong(path: Path, place: int) -> InputError:
    return InputError(path, f"line {place} is not as COLMAP writes it", COPY_AGAIN)
