"""From a folder of cameras, photos and masks to views, lens and faults taken out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from veduta.cameras import Board, Camera, CameraSet, undistorted
from veduta.carve.options import SilhouetteOptions
from veduta.carve.read.background import masks_of_background
from veduta.carve.read.board_masks import without_print
from veduta.carve.read.masks import find_masks, read_mask
from veduta.carve.views import Mask, Pixels, View
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.run.progress import StepProgress, no_progress

Silhouettes = tuple[list[Mask], float]
"""Of each photo, and the threshold that parted them from the background (deviations)."""
Keep = Callable[[Callable[[], Silhouettes]], Silhouettes]
"""Gives what was made before, or makes it."""
SEEDS = {"dark": ((0, 0, 0),), "bright": ((255, 255, 255),)}


@dataclass(frozen=True)
class ViewRule:
    """least_views: fewer do not bound an object. largest_px: photos are brought to this side at
    most: finer than the voxels of most volumes, and 200 of them fit into memory.
    """

    least_views: int = 3
    largest_px: int = 1600


@dataclass(frozen=True, eq=False)
class Record:
    """views: with a silhouette. left_out: photos that have none, with the reason. threshold: of the
    background (deviations); None where there were masks.
    """

    views: tuple[View, ...]
    left_out: tuple[str, ...]
    threshold: float | None


def read_views(
    folder: Path,
    cameras: CameraSet,
    options: SilhouetteOptions,
    rule: ViewRule | None = None,
    progress: StepProgress = no_progress,
    board: Board | None = None,
    keep: Keep = lambda make: make(),
) -> Record:
    """The views of all cameras with a photo, as cameras without distortion.

    board: a printed one, about the origin, on which the object stands. keep: of silhouettes that
    are found from the background, those of a run that was killed. InputError where too few
    have a photo, one has not its camera's size, or masks are asked for and missing.
    """
    rule = rule or ViewRule()
    shown = [camera for camera in cameras.cameras if camera.picture is not None]
    if len(shown) < rule.least_views:
        raise InputError(
            folder,
            f"has {len(cameras)} cameras, but photos of {len(shown)} of them",
            "Put the photos beside the cameras, under the names that the cameras give them.",
        )
    masks = find_masks(folder, cameras)
    wanted = options.background == "masks" or (options.background == "auto" and bool(masks))
    if options.background == "masks" and not masks:
        fault = "has no folder masks with a picture for each photo"
        raise InputError(folder, fault, "Make one, or leave out background.")
    straight, pixels = _read_photos(shown, rule, progress)
    left_out = [f"{c.name}: no photo" for c in cameras.cameras if c.picture is None]
    threshold = None
    if wanted:
        found = [read_mask(masks, camera, to) for camera, to in zip(shown, straight, strict=True)]
    else:
        seeds = SEEDS.get(options.background, ())
        drawn, threshold = keep(
            lambda: _before_background(straight, pixels, seeds, board, progress)
        )
        found = [*drawn]
    views = []
    for camera, photo, mask in zip(straight, pixels, found, strict=True):
        if mask is None:
            left_out.append(f"{camera.name}: no mask")
            continue
        views.append(View(camera, photo, mask, "mask" if wanted else "background"))
    return Record(tuple(views), tuple(left_out), threshold)


def _before_background(
    cameras: Sequence[Camera],
    photos: Sequence[Pixels],
    seeds: Sequence[tuple[int, int, int]],
    board: Board | None,
    progress: StepProgress,
) -> Silhouettes:
    masks, threshold = masks_of_background(photos, seeds, progress=progress)
    if board is None:
        return masks, threshold
    of_each = zip(cameras, photos, masks, strict=True)
    return [without_print(camera, photo, mask, board) for camera, photo, mask in of_each], threshold


def _read_photos(
    cameras: Sequence[Camera], rule: ViewRule, progress: StepProgress
) -> tuple[list[Camera], list[Pixels]]:
    straight, pixels = [], []
    for number, camera in enumerate(cameras):
        photo = _photo(camera)
        plain, photo = undistorted(camera, photo)
        view = View(plain, photo, np.zeros(photo.shape[:2], dtype=bool), "mask")
        if max(plain.width_px, plain.height_px) > rule.largest_px:
            view = view.scaled(rule.largest_px / max(plain.width_px, plain.height_px))
        straight.append(view.camera)
        pixels.append(view.pixels)
        progress("photos", (number + 1) / len(cameras))
    return straight, pixels


def _photo(camera: Camera) -> Pixels:
    path = camera.picture
    if path is None:
        raise InputError(camera.name, "has no photo", "Put it beside the cameras.")
    pixels = read_image(path).pixels
    height, width = pixels.shape[:2]
    if (width, height) != (camera.width_px, camera.height_px):
        raise InputError(
            path,
            f"is {width} x {height} px, but its camera is one of"
            f" {camera.width_px} x {camera.height_px} px",
            "Give the photos at the size at which they were calibrated.",
        )
    return pixels
