"""The pictures that cameras took: found by their names, and how large they are."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from veduta.cameras.camera import Camera
from veduta.imaging.read import SUFFIXES, image_size
from veduta.run.errors import InputError

MOST_PICTURES = 200_000
LONGEST_NAME = 255
"""Bytes of a file's name: systems refuse to look for longer ones."""
LONGEST_PATH = 1024
"""Bytes of a name with its folders."""
NEAR = ("images", "image", "pictures", "photos", "visualize", "rgb")
"""Folders beside a file of cameras where its pictures may be."""
SAME_CAMERA = 0.01
"""Of the focal length, by which the calibrations of one camera's photos may differ."""
_GIVE = "Name the folder of the photos, and give them the names that the cameras have."


class Pictures:
    """Pictures in some folders, by the names that cameras give them."""

    def __init__(self, folders: Iterable[Path]) -> None:
        self.folders = tuple(dict.fromkeys(folder for folder in folders if folder.is_dir()))
        self.paths: tuple[Path, ...] = ()
        self._by_name: dict[str, Path] = {}
        self._by_stem: dict[str, Path | None] = {}
        for folder in self.folders:
            self._take(folder)

    def _take(self, folder: Path) -> None:
        found = sorted(
            (path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES),
            key=lambda path: natural_order(path.name),
        )[:MOST_PICTURES]
        self.paths = self.paths or tuple(found)
        for path in found:
            self._by_name.setdefault(path.name.lower(), path)
            stem = path.stem.lower()
            self._by_stem[stem] = None if stem in self._by_stem else path

    def find(self, name: str) -> Path | None:
        """The picture of a name: as a path in a folder, by its last part, then by its stem."""
        inner = Path(name.replace("\\", "/"))
        if max((len(part.encode()) for part in inner.parts), default=0) > LONGEST_NAME:
            return None
        if len(name.encode()) > LONGEST_PATH:
            return None
        if not inner.is_absolute() and ".." not in inner.parts:
            for folder in self.folders:
                if inner.suffix and (folder / inner).is_file():
                    return folder / inner
        found = self._by_name.get(inner.name.lower())
        stem = inner.stem if inner.suffix.lower() in SUFFIXES else inner.name
        return found or self._by_stem.get(stem.lower())


def natural_order(name: str) -> tuple[tuple[int, str], ...]:
    """A key by which picture 2 comes before picture 10."""
    parts = re.split(r"(\d+)", name.lower())
    return tuple((int(part), "") if part.isdigit() else (-1, part) for part in parts)


def near(path: Path, images: Path | None) -> Pictures:
    """The pictures of a file or folder of cameras: where they are said to be, else close by."""
    if images is not None:
        if not images.is_dir():
            fault = "is no folder" if images.exists() else "does not exist"
            raise InputError(images, fault, _GIVE)
        return Pictures([images])
    folder = path if path.is_dir() else path.parent
    beside = [folder, folder.parent] + ([folder.parent.parent] if path.is_dir() else [])
    folders = [folder]
    for place in beside:
        folders += [place / name for name in NEAR]
    return Pictures([*folders, folder.parent])


def at_picture_size(camera: Camera, source: Path) -> Camera:
    """The camera at the size of its picture, where that was made smaller or larger.

    InputError where the picture was cropped: it has not the shape that the camera was made for.
    """
    if camera.picture is None:
        return camera
    width, height = image_size(camera.picture)
    if (width, height) == (camera.width_px, camera.height_px):
        return camera
    across, down = width / camera.width_px, height / camera.height_px
    rounding = 1.0 / min(width, height, camera.width_px, camera.height_px)
    if abs(across / down - 1.0) > max(0.004, 2.0 * rounding):
        fault = (
            f"has {width} x {height} px, but {source.name} gives a camera of "
            f"{camera.width_px} x {camera.height_px} px"
        )
        remedy = "Give the photos as they were taken, or the cameras of these."
        raise InputError(camera.picture, fault, remedy)
    return camera.sized(width, height)


def with_pictures(
    cameras: Iterable[Camera], pictures: Pictures, source: Path
) -> tuple[Camera, ...]:
    """Each camera with its picture, at that one's size."""
    found = (replace(camera, picture=pictures.find(camera.name)) for camera in cameras)
    return tuple(at_picture_size(camera, source) for camera in found)


def require_picture(pictures: Pictures, name: str, source: Path) -> tuple[Path, int, int]:
    """The picture of a name, with its width and height; InputError where it is missing."""
    path = pictures.find(name)
    if path is None:
        fault = f"says no size, and the photo {name} is not there"
        raise InputError(source, fault, _GIVE)
    return path, *image_size(path)


def require_one_size(cameras: Sequence[Camera]) -> None:
    """InputError for a photo that has another size than the others of its camera.

    For sources that state no size, so that the photos must: one that was cropped or made smaller
    would be taken for a camera of its own. A camera is the same where all of its calibration is,
    to one percent of the focal length.
    """
    sizes = Counter((one.width_px, one.height_px) for one in cameras)
    if len(sizes) < 2:
        return
    usual, count = sizes.most_common(1)[0]
    alike = [one for one in cameras if (one.width_px, one.height_px) == usual]
    calibrated = np.median([one.matrix().ravel() for one in alike], axis=0)
    for one in cameras:
        size = (one.width_px, one.height_px)
        off = np.abs(one.matrix().ravel() - calibrated).max() / calibrated[0]
        if size != usual and count > 1 and off < SAME_CAMERA:
            raise InputError(
                one.picture or one.name,
                f"is {size[0]} x {size[1]} px, and the {count} others of its camera are"
                f" {usual[0]} x {usual[1]} px",
                "Give the photos at the size at which they were calibrated.",
            )
