"""Cameras of COLMAP's models, text and binary."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.convention import Seen, require_convention
from veduta.cameras.pictures import near, with_pictures
from veduta.formats.colmap_folder import ModelFiles, models_in, read_model
from veduta.formats.colmap_model import ColmapCamera, ColmapImage, ColmapModel
from veduta.run.errors import InputError

NAMES = ("cameras.bin", "cameras.txt")
_LENSES = {
    "SIMPLE_PINHOLE": (),
    "PINHOLE": (),
    "SIMPLE_RADIAL": (3,),
    "RADIAL": (3, 4),
    "OPENCV": (4, 5, 6, 7),
    "FULL_OPENCV": tuple(range(4, 12)),
}
"""The lens models that are read, and where the numbers of their distortion stand."""


def find(folder: Path) -> Path | None:
    """The folder of a model: itself, its `sparse`, or the first numbered one of these."""
    for place in (folder, folder / "0", folder / "sparse", folder / "sparse/0"):
        if any((place / name).is_file() for name in NAMES):
            return place
    return None


def read(found: Path, images: Path | None) -> CameraSet:
    """The model of a folder, with the photos that are found beside it."""
    files = models_in(found)[0]
    model = read_model(files)
    cameras = cameras_of(model, files)
    source = files.paths[0]
    named = with_pictures(cameras, near(found, images), source)
    points, visible, seen = sight_of(model, cameras)
    require_convention(files.paths[1], cameras, seen)
    return CameraSet(
        cameras=named,
        points=points,
        colours=model.points.colours,
        visible=visible,
        source=str(found),
    )


def cameras_of(model: ColmapModel, files: ModelFiles) -> tuple[Camera, ...]:
    """The images' cameras, by their names. InputError where there are none."""
    if not model.images:
        remedy = "Export a model in which photos have poses."
        raise InputError(files.paths[1], "has no image", remedy)
    ordered = sorted(model.images, key=lambda image: (image.name, image.number))
    return tuple(_camera(image, model.cameras[image.camera], files.paths[0]) for image in ordered)


def sight_of(
    model: ColmapModel, cameras: tuple[Camera, ...]
) -> tuple[NDArray[np.float64], tuple[NDArray[np.intp], ...], dict[int, Seen]]:
    """Points (n, 3), the rows that each camera sees, and where."""
    by_name = {image.name: image for image in model.images}
    visible, seen = [], {}
    for index, camera in enumerate(cameras):
        image = by_name[camera.name]
        there = image.points >= 0
        rows = np.searchsorted(model.points.numbers, image.points[there])
        visible.append(np.unique(rows).astype(np.intp))
        seen[index] = Seen(model.points.places[rows], image.places_px[there])
    return model.points.places, tuple(visible), seen


def _camera(image: ColmapImage, camera: ColmapCamera, path: Path) -> Camera:
    if camera.model not in _LENSES:
        fault = f"has a camera of the model {camera.model}, which bends more than is followed"
        remedy = "Undistort the photos first (`colmap image_undistorter`), and give that model."
        raise InputError(path, fault, remedy)
    one_focal = camera.model.startswith(("SIMPLE", "RADIAL"))
    focal = (camera.params[0], camera.params[0 if one_focal else 1])
    at = 1 if one_focal else 2
    lens = tuple(camera.params[place] for place in _LENSES[camera.model])
    return Camera(
        name=image.name,
        width_px=camera.width_px,
        height_px=camera.height_px,
        focal_px=focal,
        centre_px=(camera.params[at], camera.params[at + 1]),
        cam_from_world=image.cam_from_world,
        distortion=lens + (0.0,) * (4 - len(lens)) if any(lens) else (),
    )
