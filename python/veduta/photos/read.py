"""What the photos are: their sizes, focal lengths, cameras, times and places.

The pixels are read again where they are needed, so that a thousand photos need the memory of one.
A file that cannot be read is set aside with the reason, and the others are used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.imaging.shot import Position
from veduta.photos.call import Source
from veduta.run.errors import InputError
from veduta.run.progress import StepProgress, no_progress

SMALLEST_SIDE_PX = 64
UNKNOWN_FOCAL = 1.2
"""Focal length over the longest side where EXIF is silent: a field of view of 45 degrees."""
_THUMB_PX = 32
_SAME_PICTURE = 1.0
"""Mean difference (of 255) up to which two thumbnails show the same picture, saved twice."""


@dataclass(frozen=True)
class PhotoRecord:
    """A photo that can be used, upright.

    image_id: 1 and on, in the order of the names. focal_px: from EXIF; None where it says nothing
    that can be true. group: number of the camera that may have taken it, by size, make and focal
    length.
    """

    image_id: int
    name: str
    path: Path
    sha256: str
    width_px: int
    height_px: int
    focal_px: float | None
    camera: str | None
    time: datetime | None
    position: Position | None
    group: int
    notes: tuple[str, ...]


@dataclass(frozen=True)
class ReadPhotos:
    """The photos, and those set aside as (name, reason)."""

    photos: tuple[PhotoRecord, ...]
    set_aside: tuple[tuple[str, str], ...]


def read_photos(sources: Sequence[Source], progress: StepProgress = no_progress) -> ReadPhotos:
    """Read each photo once, one at a time."""
    records: list[PhotoRecord] = []
    set_aside: list[tuple[str, str]] = []
    groups: dict[tuple[object, ...], int] = {}
    thumbs = np.empty((len(sources), 3 * _THUMB_PX**2), dtype=np.float32)
    for number, source in enumerate(sources):
        progress("read", number / len(sources))
        try:
            photo = read_image(source.path)
        except InputError as error:
            set_aside.append((source.name, error.fault))
            continue
        height, width = photo.pixels.shape[:2]
        if min(width, height) < SMALLEST_SIDE_PX:
            set_aside.append((source.name, f"is only {width} x {height} px"))
            continue
        thumb = _thumbnail(photo.pixels)
        apart = np.abs(thumbs[: len(records)] - thumb).mean(axis=1)
        if len(apart) and float(apart.min()) <= _SAME_PICTURE:
            same = records[int(np.argmin(apart))].name
            set_aside.append((source.name, f"shows the same picture as {same}"))
            continue
        thumbs[len(records)] = thumb
        focal = None if photo.focal_px is None else round(photo.focal_px, 3)
        kind = (width, height, photo.shot.camera, focal)
        records.append(
            PhotoRecord(
                image_id=len(records) + 1,
                name=source.name,
                path=source.path,
                sha256=source.sha256,
                width_px=width,
                height_px=height,
                focal_px=photo.focal_px,
                camera=photo.shot.camera,
                time=photo.shot.time,
                position=photo.shot.position,
                group=groups.setdefault(kind, len(groups) + 1),
                notes=photo.notes,
            )
        )
    return ReadPhotos(tuple(records), tuple(set_aside))


def _thumbnail(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Means of blocks, in a row: the same for one picture in different sizes and qualities."""
    small = cv2.resize(pixels, (_THUMB_PX, _THUMB_PX), interpolation=cv2.INTER_AREA)
    return small.astype(np.float32).reshape(-1)
