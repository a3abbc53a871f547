"""Metric pictures of the walls: each piece from the photo that shows it best, levelled.

What no photo shows stays transparent: nothing is made up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.photos.levelling import photo_gains
from veduta.photos.structure import Structure
from veduta.photos.walls.choice import chosen_photos
from veduta.photos.walls.grid import WallGrid, wall_grids
from veduta.photos.walls.views import WallView, cell_points, cell_size_px, wall_views
from veduta.photos.walls.wall import Wall
from veduta.run.progress import StepProgress, no_progress

Pixels = NDArray[np.uint8]
ReadPhoto = Callable[[int], Pixels]
"""Gives the (h, w, 3) sRGB pixels of a photo, by its row in the structure."""
FEATHER_CELLS = 0.6
"""Photos pass into each other over about so many cells."""


@dataclass(frozen=True)
class WallPicture:
    """pixels: (h, w, 4) uint8 sRGB and alpha, 0 where no photo shows the wall.

    photos: rows of the structure that it is made of. seen: share of its pixels that any shows.
    """

    grid: WallGrid
    pixels: Pixels
    photos: tuple[int, ...]
    seen: float


@dataclass
class _Work:
    """A wall while its picture is made. colours: (v, r, c, 3) linear light of the cells."""

    grid: WallGrid
    views: list[WallView]
    colours: NDArray[np.float64]
    chosen: NDArray[np.int64]
    sums: NDArray[np.float32]


def wall_pictures(
    structure: Structure,
    walls: Sequence[Wall],
    read_photo: ReadPhoto,
    longest_px: int,
    relief: float,
    progress: StepProgress = no_progress,
) -> tuple[WallPicture, ...]:
    """A picture for each wall. Every photo is read twice, and one at a time.

    relief: what lies nearer than this to a wall belongs to it, and does not stand before it.
    """
    works = []
    for grid in wall_grids(structure, walls, longest_px):
        views = wall_views(structure, grid, walls, relief)
        shape = (len(views), *cell_points(grid).shape[:2], 3)
        empty = np.zeros((0, 0, 4), dtype=np.float32)
        works.append(_Work(grid, views, np.zeros(shape), np.zeros(shape[1:3], np.int64), empty))
    photos = sorted({view.photo for work in works for view in work.views})
    for number, photo in enumerate(photos):
        progress("walls", 0.5 * number / len(photos))
        _sample_cells(works, photo, read_photo(photo))
    gains = _gains(works, len(structure.names))
    for work in works:
        _choose(work, gains)
    for number, photo in enumerate(photos):
        progress("walls", 0.5 + 0.5 * number / len(photos))
        if any(_is_used(work, photo) for work in works):
            levelled = _levelled(read_photo(photo), gains[photo])
            for work in works:
                _paint(work, structure, photo, levelled)
    return tuple(_finished(work) for work in works)


def _sample_cells(works: Sequence[_Work], photo: int, pixels: Pixels) -> None:
    """Mean light of each cell in a photo, about: of the photo made as coarse as the cells."""
    coarser: dict[int, Pixels] = {}
    for work in works:
        for number, view in enumerate(work.views):
            if view.photo == photo:
                cell = cell_size_px(work.grid) * work.grid.pixel
                quality = view.quality[view.quality > 0.0]
                halvings = max(0, int(np.log2(max(1.0, float(np.median(quality)) * cell))))
                if halvings not in coarser:
                    coarser[halvings] = _shrunk(pixels, 0.5**halvings)
                small = coarser[halvings]
                places = view.places_px * (np.array(small.shape[1::-1]) / pixels.shape[1::-1])
                values = _sampled(small, places)
                work.colours[number] = linear_of_srgb(values.astype(np.float64) / 255.0)


def _gains(works: Sequence[_Work], photos: int) -> NDArray[np.float64]:
    """(photos, 3) what makes the photos alike, by the cells of all walls."""
    light, photo, place = [np.zeros((0, 3))], [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    first = 0
    for work in works:
        cells = work.chosen.size
        for number, view in enumerate(work.views):
            seen = np.flatnonzero(view.quality.ravel() > 0.0)
            light.append(work.colours[number].reshape(-1, 3)[seen])
            photo.append(np.full(len(seen), view.photo))
            place.append(first + seen)
        first += cells
    return photo_gains(np.concatenate(light), np.concatenate(photo), np.concatenate(place), photos)


def _choose(work: _Work, gains: NDArray[np.float64]) -> None:
    """Choose each cell's photo; open the canvas."""
    if not work.views:
        work.chosen -= 1
    else:
        rows = [view.photo for view in work.views]
        light = np.clip(work.colours * gains[rows][:, None, None, :], 0.0, 1.0)
        work.chosen = chosen_photos(work.views, srgb_of_linear(light))
    work.sums = np.zeros((work.grid.height_px, work.grid.width_px, 4), dtype=np.float32)


def _is_used(work: _Work, photo: int) -> bool:
    return any(
        view.photo == photo and bool((work.chosen == number).any())
        for number, view in enumerate(work.views)
    )


def _paint(work: _Work, structure: Structure, photo: int, pixels: Pixels) -> None:
    """Add what the wall takes of a photo to its canvas."""
    for number, view in enumerate(work.views):
        if view.photo != photo or not (work.chosen == number).any():
            continue
        grid, cell = work.grid, cell_size_px(work.grid)
        own = (work.chosen == number).astype(np.float32)
        soft = cv2.GaussianBlur(own, (0, 0), FEATHER_CELLS, borderType=cv2.BORDER_REPLICATE)
        soft *= view.quality > 0.0
        size = (own.shape[1] * cell, own.shape[0] * cell)
        weight = cv2.resize(soft, size, interpolation=cv2.INTER_LINEAR)
        weight = weight[: grid.height_px, : grid.width_px]
        rows, columns = (np.flatnonzero((weight > 1e-3).any(axis=axis)) for axis in (1, 0))
        if not len(rows):
            continue
        down, across = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        points = grid.points(
            np.arange(grid.width_px)[across] + 0.5, np.arange(grid.height_px)[down] + 0.5
        )
        quality = float(np.median(view.quality[own > 0.0]))
        source = _shrunk(pixels, min(1.0, 1.0 / (quality * grid.pixel)))
        places = _places(structure, photo, points)
        inside = ((places > 0.5) & (places < np.array(pixels.shape[1::-1]) - 0.5)).all(axis=-1)
        places = places * (np.array(source.shape[1::-1]) / pixels.shape[1::-1])
        part = np.where(inside, weight[down, across], 0.0).astype(np.float32)
        canvas = work.sums[down, across]
        canvas[..., :3] += part[..., None] * _sampled(source, places)
        canvas[..., 3] += part


def _places(structure: Structure, photo: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(r, c, 2) where (r, c, 3) points lie in a photo, -1 behind it."""
    pose = structure.cam_from_world[photo]
    seen = points.reshape(-1, 3) @ pose[:, :3].T + pose[:, 3]
    places = np.full((len(seen), 2), -1.0)
    ahead = seen[:, 2] > 0.0
    places[ahead] = structure.camera(photo).img_from_cam(seen[ahead])
    found: NDArray[np.float64] = np.nan_to_num(places, nan=-1.0).reshape(*points.shape[:2], 2)
    return found


def _sampled(pixels: Pixels, places: NDArray[np.float64]) -> Pixels:
    """Pixels at (r, c, 2) places; OpenCV puts the centre of the first pixel at 0."""
    at = np.ascontiguousarray((places - 0.5).astype(np.float32))
    found = cv2.remap(
        pixels,
        at[..., 0].copy(),
        at[..., 1].copy(),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return found.astype(np.uint8)


def _shrunk(pixels: Pixels, part: float) -> Pixels:
    """The photo made smaller, each pixel the mean of those that it replaces."""
    if part > 0.75:
        return pixels
    size = (max(1, round(part * pixels.shape[1])), max(1, round(part * pixels.shape[0])))
    return cv2.resize(pixels, size, interpolation=cv2.INTER_AREA).astype(np.uint8)


def _levelled(pixels: Pixels, gain: NDArray[np.float64]) -> Pixels:
    light = linear_of_srgb(np.arange(256) / 255.0)[:, None] * gain
    table = np.round(255.0 * srgb_of_linear(np.clip(light, 0.0, 1.0))).astype(np.uint8)
    return cv2.LUT(pixels, table[:, None, :].reshape(1, 256, 3)).astype(np.uint8)


def _finished(work: _Work) -> WallPicture:
    weight = work.sums[..., 3:]
    shown = weight[..., 0] > 1e-3
    pixels = np.zeros(work.sums.shape, dtype=np.uint8)
    colours = np.round(work.sums[..., :3] / np.maximum(weight, 1e-6))
    pixels[..., :3][shown] = colours[shown].astype(np.uint8)
    pixels[..., 3] = np.where(shown, 255, 0)
    used = np.unique(work.chosen[work.chosen >= 0])
    photos = tuple(work.views[number].photo for number in used.tolist())
    work.sums = np.zeros((0, 0, 4), dtype=np.float32)
    return WallPicture(work.grid, pixels, photos, float(shown.mean()))
