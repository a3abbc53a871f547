"""Cameras of a result of `veduta photos`: its first component, in metres where it has them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pydantic import ValidationError

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.files import read_bytes
from veduta.cameras.pictures import Pictures, near, with_pictures
from veduta.cameras.readers import colmap
from veduta.formats.colmap_folder import models_in, read_model
from veduta.place.manifest import Place, PlaceCamera
from veduta.run.errors import InputError

PLACE = "place.json"
SPARSE = "sparse/0"
_AGAIN = "Run `veduta photos` again into this folder."
_UP = (0.0, 0.0, 1.0)


def find(folder: Path) -> Path | None:
    """The folder, where it holds a result."""
    there = (folder / PLACE).is_file() and (folder / SPARSE).is_dir()
    return folder if there else None


def read(found: Path, images: Path | None) -> CameraSet:
    """The pictures without distortion that lie in the result, and their cameras.

    images: the folder of the photos themselves, which are used instead, at their full size.
    """
    try:
        place = Place.model_validate_json(read_bytes(found / PLACE))
    except ValidationError as error:
        fault = f"is no result ({error.error_count()} faults)"
        raise InputError(found / PLACE, fault, _AGAIN) from None
    if not place.cameras:
        raise InputError(found / PLACE, "has no photos", _AGAIN)
    files = models_in(found / SPARSE)[0]
    model = read_model(files)
    cameras = colmap.cameras_of(model, files)
    points, visible, _ = colmap.sight_of(model, cameras)
    masks = {}
    if images is None:
        cameras = _pictured(place.cameras, cameras, found)
    else:
        pictures = near(found, images)
        cameras = with_pictures(cameras, pictures, files.paths[0])
        masks = _masks(cameras, Pictures([images / "masks", images.parent / "masks"]))
    return CameraSet(
        cameras=cameras,
        points=points,
        colours=model.points.colours,
        visible=visible,
        scale="metres" if place.scale == "metres" else "unknown",
        crs=place.crs,
        origin_m=place.origin,
        source=str(found),
        up=_UP,
        masks=masks,
    )


def _pictured(
    shown: list[PlaceCamera], cameras: tuple[Camera, ...], found: Path
) -> tuple[Camera, ...]:
    """The cameras of the pictures, in the order of the photos'."""
    by_name = {camera.name: camera for camera in shown}
    taken = []
    for camera in cameras:
        own = by_name.get(camera.name)
        if own is None:
            continue
        world_from_cam = np.array(own.transform).reshape(4, 4).T
        turn = world_from_cam[:3, :3].T
        picture = found / own.picture
        taken.append(
            replace(
                camera,
                width_px=own.width_px,
                height_px=own.height_px,
                focal_px=own.focal_px,
                centre_px=own.centre_px,
                cam_from_world=np.column_stack([turn, -turn @ world_from_cam[:3, 3]]),
                distortion=(),
                picture=picture if picture.is_file() else None,
            )
        )
    if len(taken) != len(cameras):
        fault = f"has pictures for {len(taken)} of {len(cameras)} photos of {SPARSE}"
        raise InputError(found / PLACE, fault, _AGAIN)
    return tuple(taken)


def _masks(cameras: tuple[Camera, ...], masks: Pictures) -> dict[str, Path]:
    found = {camera.name: masks.find(camera.name) for camera in cameras}
    return {name: path for name, path in found.items() if path is not None}
