"""Cameras and points of a COLMAP model that is given, in place of matching and mapping.

The cameras, poses and points stay as they are, but for the frame: it is turned upright and scaled
as that of our own models, because neither says where the place lies. Images are found by their
names among the photos; with folders in a name the last part counts, where the whole is not found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np
import pycolmap
from scipy import sparse

from veduta.formats.colmap_folder import ModelFiles, read_model
from veduta.formats.colmap_model import ColmapCamera, ColmapImage, ColmapModel
from veduta.photos.cameras.component import Component
from veduta.photos.cameras.lens import MODELS, CameraKind, LensChoice
from veduta.photos.cameras.orient import oriented
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.matching.match import PairRecord
from veduta.photos.options import Lens
from veduta.photos.structure import Structure, without_outliers
from veduta.run.errors import InputError

HOW = "nothing: the model was given. A pair's number is that of the points that both photos see"
MOST_NAMED = 5
_MIDDLE_PX = 1.0
"""So far from the middle of the photo a principal point is still said to lie there."""
_LENSES: Mapping[str, Lens] = {
    "SIMPLE_PINHOLE": "pinhole",
    **{name: lens for lens, name in MODELS.items()},
}
_TURNED = {2, 3, 4}
"""EXIF orientations that leave the size: of these nothing tells which way the model has them."""


@dataclass(frozen=True)
class GivenModel:
    """The components, that with most photos first.

    keypoints: of each photo, 0 where no component has it. left: photos without a pose, as (name,
    reason). notes: what else is to be told.
    """

    components: tuple[Component, ...]
    pairs: tuple[PairRecord, ...]
    keypoints: tuple[int, ...]
    left: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]


def given_model(files: Sequence[ModelFiles], photos: Sequence[PhotoRecord]) -> GivenModel:
    """The components of the files that photos are there of; InputError where there are none."""
    by_name = {photo.name: photo for photo in photos}
    waiting = set(by_name)
    reasons: dict[str, str] = {}
    missing: list[str] = []
    structures: list[Structure] = []
    for own in files:
        model = read_model(own)
        found = {image.number: _photo_of(image, by_name) for image in model.images}
        missing += [image.name for image in model.images if found[image.number] is None]
        rows = []
        for image in model.images:
            photo = found[image.number]
            if photo is None or photo.name not in waiting:
                continue
            reason = _misfit(photo, model.cameras[image.camera])
            if reason:
                reasons[photo.name] = reason
            else:
                rows.append((photo, image))
                waiting.remove(photo.name)
        if len(rows) >= 2:
            structures.append(_structure(own.paths[2], model, rows))
    if not structures:
        raise _nothing(files[0], len(photos), missing, reasons)
    structures.sort(key=lambda structure: -len(structure.names))
    components = tuple(_component(structure) for structure in structures)
    placed = {image for structure in structures for image in structure.image_ids}
    return GivenModel(
        components,
        tuple(pair for component in components for pair in _pairs(component.structure)),
        _keypoints(photos, structures),
        tuple(
            (photo.name, reasons.get(photo.name, "is not in the COLMAP model"))
            for photo in photos
            if photo.image_id not in placed
        ),
        _notes(missing),
    )


def _photo_of(image: ColmapImage, photos: Mapping[str, PhotoRecord]) -> PhotoRecord | None:
    last = PurePosixPath(image.name.replace("\\", "/")).name
    return photos.get(image.name) or photos.get(last)


def _misfit(photo: PhotoRecord, camera: ColmapCamera) -> str | None:
    """Why a photo cannot be the one that the model was made of."""
    size, wanted = (photo.width_px, photo.height_px), (camera.width_px, camera.height_px)
    if photo.orientation in _TURNED:
        return (
            f"is stored turned (EXIF orientation {photo.orientation}), and nothing tells whether"
            " the COLMAP model was made of it upright: save it upright"
        )
    if size == wanted:
        return None
    turned = ", turned as it is stored" if size == wanted[::-1] and photo.orientation > 1 else ""
    return (
        f"is {size[0]} x {size[1]} px, and its camera in the COLMAP model"
        f" {wanted[0]} x {wanted[1]} px{turned}: give the photos that the model was made of"
    )


def _structure(
    path: Path, model: ColmapModel, rows: Sequence[tuple[PhotoRecord, ColmapImage]]
) -> Structure:
    """The columns of one component; points that fewer than two of the photos see are left out."""
    rows = sorted(rows, key=lambda row: row[0].image_id)
    images = [image for _, image in rows]
    seen = [np.flatnonzero(image.points >= 0) for image in images]
    numbers = [image.points[own] for image, own in zip(images, seen, strict=True)]
    structure = Structure(
        cameras={
            number: _camera(number, model.cameras[number])
            for number in sorted({image.camera for image in images})
        },
        camera_of={photo.image_id: image.camera for photo, image in rows},
        image_ids=tuple(photo.image_id for photo, _ in rows),
        names=tuple(photo.name for photo, _ in rows),
        cam_from_world=np.array([image.cam_from_world for image in images]),
        keypoints_px=tuple(image.places_px for image in images),
        points=model.points.places,
        colours=model.points.colours,
        image_of=np.repeat(np.arange(len(images)), [len(own) for own in seen]),
        keypoint_of=np.concatenate(seen).astype(np.int64),
        point_of=np.searchsorted(model.points.numbers, np.concatenate(numbers)),
    )
    # Whatever the model's own errors are, a point behind a camera was not seen by it.
    structure = without_outliers(structure, float(np.finfo(np.float64).max))
    if not len(structure.points):
        raise InputError(
            path,
            "holds no points that two of the photos see",
            "Have COLMAP triangulate points, or leave out --from-colmap.",
        )
    return structure


def _camera(number: int, camera: ColmapCamera) -> pycolmap.Camera:
    return pycolmap.Camera(
        camera_id=number,
        model=camera.model,
        width=camera.width_px,
        height=camera.height_px,
        params=list(camera.params),
    )


def _component(structure: Structure) -> Component:
    upright = oriented(structure)
    return Component(upright.structure, LensChoice(_kind(structure), ()), upright.level_deg)


def _kind(structure: Structure) -> CameraKind:
    cameras = list(structure.cameras.values())
    lenses = {_LENSES.get(camera.model.name, "other") for camera in cameras}
    middle = all(
        abs(camera.principal_point_x - camera.width / 2) <= _MIDDLE_PX
        and abs(camera.principal_point_y - camera.height / 2) <= _MIDDLE_PX
        for camera in cameras
    )
    return CameraKind(
        lens=lenses.pop() if len(lenses) == 1 else "other",
        sharing="shared" if len(cameras) < len(structure.names) else "per-photo",
        principal_point="middle" if middle else "free",
    )


def _pairs(structure: Structure) -> list[PairRecord]:
    """The pairs of photos that see points in common, with their number."""
    shape = len(structure.image_ids), len(structure.points)
    ones = np.ones(len(structure.image_of), dtype=np.int64)
    seen = sparse.csr_array((ones, (structure.image_of, structure.point_of)), shape=shape)
    seen.data[:] = 1  # a point may be seen twice in a photo
    common = sparse.triu(seen @ seen.T, k=1).tocoo()
    return [
        PairRecord(structure.image_ids[a], structure.image_ids[b], count, count, planar=False)
        for a, b, count in zip(
            common.row.tolist(), common.col.tolist(), common.data.tolist(), strict=True
        )
    ]


def _keypoints(photos: Sequence[PhotoRecord], structures: Sequence[Structure]) -> tuple[int, ...]:
    counts = {
        image: len(places)
        for structure in structures
        for image, places in zip(structure.image_ids, structure.keypoints_px, strict=True)
    }
    return tuple(counts.get(photo.image_id, 0) for photo in photos)


def _notes(missing: Sequence[str]) -> tuple[str, ...]:
    notes = ["cameras, poses and points are those of the given COLMAP model, not adjusted"]
    if missing:
        named = ", ".join(missing[:MOST_NAMED]) + (" ..." if len(missing) > MOST_NAMED else "")
        notes.append(f"{len(missing)} images of the COLMAP model are not among the photos: {named}")
    return tuple(notes)


def _nothing(
    files: ModelFiles, photos: int, missing: Sequence[str], reasons: Mapping[str, str]
) -> InputError:
    fault = f"its images are not the {photos} photos"
    if missing:
        fault += f" (such as {missing[0]}, which is not there)"
    elif reasons:
        name, reason = next(iter(reasons.items()))
        fault += f" ({name} {reason})"
    return InputError(files.paths[1], fault, "Give the photos that the model was made of as DIR.")
