"""What the photos are: their sizes, focal lengths, cameras, times and places.

The pixels are read again where they are needed, so that a thousand photos need the memory of one.
A file that cannot be read is set aside with the reason, and the others are used.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from veduta.imaging.exif import FocalSource
from veduta.imaging.read import Photo, image_size, read_image
from veduta.imaging.shot import Position
from veduta.photos.intake.duplicates import Pictures
from veduta.photos.intake.masks import read_mask
from veduta.photos.intake.source import Mount, Source, View
from veduta.run.errors import InputError
from veduta.run.progress import StepProgress, no_progress

SMALLEST_SIDE_PX = 64
UNKNOWN_FOCAL = 1.2
"""Focal length over the longest side where EXIF is silent: a field of view of 45 degrees."""


@dataclass(frozen=True)
class PhotoRecord:
    """A photo that can be used, upright.

    image_id: 1 and on, in the order of the names, frames of a film after photos. focal_px: from
    EXIF; None where it says nothing that can be true. group: number of the camera that may have
    taken it, by size, make and focal length, or film. orientation: as EXIF says that it is stored.
    pitch_deg: how far it looked up, by the gimbal that held it. mount: where its camera is one of
    a rig. view: where it was cut out of a panorama; its lens is then known.
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
    focal_source: FocalSource | None = None
    orientation: int = 1
    mask: Path | None = None
    mask_sha256: str | None = None
    video: str | None = None
    pitch_deg: float | None = None
    mount: Mount | None = None
    view: View | None = None

    @property
    def one_camera(self) -> bool:
        """Whether all photos of its group are known to be of one camera."""
        known = self.focal_px is not None or self.video is not None
        return known or self.mount is not None


@dataclass(frozen=True)
class ReadPhotos:
    """The photos, and those set aside as (name, reason)."""

    photos: tuple[PhotoRecord, ...]
    set_aside: tuple[tuple[str, str], ...]


def read_photos(sources: Sequence[Source], progress: StepProgress = no_progress) -> ReadPhotos:
    """Read each photo once, one at a time.

    InputError where a mask cannot be read, or has not the size of its photo.
    """
    set_aside: list[tuple[str, str]] = []
    found: list[tuple[int, PhotoRecord]] = []
    pictures = Pictures(len(sources))
    sizes: dict[str, tuple[int, int]] = {}
    for number, source in enumerate(sources):
        progress("read", number / len(sources))
        try:
            photo = read_image(source.path)
        except InputError as error:
            set_aside.append((source.name, error.fault))
            continue
        reason = _unusable(source, photo) or _of_another_size(source, photo, sizes)
        if reason:
            set_aside.append((source.name, reason))
            continue
        # Frames of a rig that show one blank wall are no copies of each other.
        same = None if source.mount is not None else pictures.same_as(photo)
        if same is None:
            found.append((number, _record(source, photo)))
            pictures.add(photo)
        elif pictures.is_better(photo, same):
            set_aside.append((found[same][1].name, f"shows the same picture as {source.name}"))
            found[same] = number, _record(source, photo)
            pictures.add(photo, same)
        else:
            first = found[same][1].name
            set_aside.append((source.name, f"shows the same picture as {first}"))
    in_order = [record for _, record in sorted(found, key=lambda entry: entry[0])]
    return ReadPhotos(_numbered(in_order), tuple(set_aside))


def with_focal(photos: Sequence[PhotoRecord], focal_px: float) -> tuple[PhotoRecord, ...]:
    """The photos with a focal length that is known; InputError where they have several sizes."""
    sizes = {(photo.width_px, photo.height_px): photo for photo in photos}
    if len(sizes) > 1:
        first, second, *_ = (f"{one.name} {w} x {h} px" for (w, h), one in sizes.items())
        raise InputError(
            "--focal-px", f"is of one camera, and the photos have several sizes: {first}, {second}",
            "Leave it out, or give photos of one camera, all held the same way.",
        )  # fmt: skip
    known = [replace(photo, focal_px=focal_px, focal_source=None) for photo in photos]
    return _numbered(known)


def sizes_of(sources: Sequence[Source]) -> dict[str, tuple[int, int]]:
    """Width and height (px) of the upright photos by name; without those that cannot be read."""
    sizes: dict[str, tuple[int, int]] = {}
    for source in sources:
        with contextlib.suppress(InputError):
            sizes[source.name] = image_size(source.path)
    return sizes


def _unusable(source: Source, photo: Photo) -> str | None:
    """Why a photo that can be read cannot be used."""
    height, width = photo.pixels.shape[:2]
    if min(width, height) < SMALLEST_SIDE_PX:
        return f"is only {width} x {height} px"
    if source.mask and not read_mask(source.mask, source.name, (width, height)).any():
        return f"is hidden by its mask ({source.mask.name}), which is black everywhere"
    return None


def _of_another_size(source: Source, photo: Photo, sizes: dict[str, tuple[int, int]]) -> str | None:
    """Why a photo cannot be of its rig's camera; `sizes` of the cameras is added to."""
    if source.mount is None:
        return None
    height, width = photo.pixels.shape[:2]
    own = sizes.setdefault(source.mount.camera, (width, height))
    if own == (width, height):
        return None
    return f"has {width} x {height} px, and the first photo of its camera {own[0]} x {own[1]}"


def _record(source: Source, photo: Photo) -> PhotoRecord:
    """What is kept of a photo; numbers are given when all are read."""
    height, width = photo.pixels.shape[:2]
    return PhotoRecord(
        image_id=0,
        name=source.name,
        path=source.path,
        sha256=source.sha256,
        width_px=width,
        height_px=height,
        focal_px=photo.focal_px,
        camera=photo.shot.camera,
        time=photo.shot.time,
        position=photo.shot.position,
        group=0,
        notes=photo.notes,
        focal_source=photo.focal_source,
        orientation=photo.orientation,
        mask=source.mask,
        mask_sha256=source.mask_sha256,
        video=source.video,
        pitch_deg=photo.shot.pitch_deg,
        mount=source.mount,
        view=source.view,
    )


def _numbered(records: Sequence[PhotoRecord]) -> tuple[PhotoRecord, ...]:
    """The photos with their numbers, and those of the cameras that may have taken them."""
    groups: dict[tuple[object, ...], int] = {}
    numbered = []
    for number, photo in enumerate(records, 1):
        focal = None if photo.focal_px is None else round(photo.focal_px, 3)
        kind: tuple[object, ...] = (photo.width_px, photo.height_px, photo.camera, focal)
        kind = (*kind, photo.video) if photo.mount is None else ("of a rig", photo.mount.camera)
        group = groups.setdefault(kind, len(groups) + 1)
        numbered.append(replace(photo, image_id=number, group=group))
    return tuple(numbered)
