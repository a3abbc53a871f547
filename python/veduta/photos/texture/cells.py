"""What each view shows of each face, by cells: colours, how much is seen, how finely.

A face is a grid of square cells; a cell has `SAMPLES` x `SAMPLES` samples. The choice of views and
the levelling work on these; the texture itself is made later at its full size.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb
from veduta.photos.texture.faces import Face
from veduta.photos.texture.halves import Halves, level_of
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.views import (
    PlaneView,
    View,
    density,
    plane_view,
    warped,
)

SAMPLES = 4
"""Samples along each side of a cell."""
CELL_M = 0.25
"""Side of a cell; larger on faces that would have more than `MOST_CELLS`."""
MOST_CELLS = 12_000
MOST_VIEWS = 16
"""Views that a face is made of, at most: those that show some cell best."""
BEST_PER_CELL = 3
_PRUNED_AT = 3 * MOST_VIEWS
"""Views of a face in memory at which those that show no cell best are dropped."""
_LEAST_FACING = 0.12
_LEAST_SHARE = 0.01
LEAST_DENSITY_PX_M2 = 6.0
"""A photo whose pixels are larger than 40 cm shows no texture."""
_LINEAR = linear_of_srgb(np.arange(256) / 255.0).astype(np.float32)


@dataclass(frozen=True)
class Grid:
    """The cells of a face, from its upper left corner."""

    rows: int
    columns: int
    cell_m: float

    @property
    def samples(self) -> tuple[int, int]:
        """Rows and columns of samples."""
        return self.rows * SAMPLES, self.columns * SAMPLES

    @property
    def pitch_m(self) -> float:
        """Between samples."""
        return self.cell_m / SAMPLES


@dataclass(frozen=True)
class Sights:
    """A face by cells, in the k views that show it.

    views: (k,) rows. planes: where each has it. colour: (k, rows S, columns S, 3) uint8 sRGB.
    seen: (k, rows S, columns S) bool. density: (k, rows, columns) pixels per square metre.
    margin: (k, rows, columns) distance to the picture's border, as a share of its smaller side.
    """

    face: Face
    grid: Grid
    views: NDArray[np.int64]
    planes: tuple[PlaneView, ...]
    colour: NDArray[np.uint8]
    seen: NDArray[np.bool_]
    density: NDArray[np.float32]
    margin: NDArray[np.float32]

    def share(self) -> NDArray[np.float32]:
        """(k, rows, columns) how much of each cell is seen."""
        return by_cell(self.seen.astype(np.float32))

    def light(self) -> NDArray[np.float32]:
        """(k, rows, columns, 3) mean linear light of what is seen; NaN where nothing is."""
        light = _LINEAR[self.colour] * self.seen[..., None]
        count = by_cell(self.seen.astype(np.float32))[..., None]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(count > 0, by_cell(light) / count, np.nan).astype(np.float32)


def by_cell(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Means over cells of (k, rows S, columns S) or with channels behind."""
    k, rows, columns = samples.shape[:3]
    split = (k, rows // SAMPLES, SAMPLES, columns // SAMPLES, SAMPLES, *samples.shape[3:])
    return np.asarray(samples.reshape(split).mean(axis=(2, 4)), dtype=np.float32)


def grid_of(face: Face) -> Grid:
    """The cells of a face."""
    width, height = face.size_m
    cell = max(CELL_M, math.sqrt(width * height / MOST_CELLS))
    rows, columns = (max(1, math.ceil(size / cell - 1e-6)) for size in (height, width))
    return Grid(rows, columns, cell)


def sights_of(
    views: Sequence[View],
    shown: Sequence[tuple[Face, NDArray[np.int64]]],
    store: PictureStore,
    progress: Callable[[float], None] = lambda _: None,
) -> list[Sights | None]:
    """What views show of faces, each given with the rows of the views that may show it.

    None for faces that none shows. Of many views of a face those are kept that show some cell best
    (`BEST_PER_CELL`). Each view is looked at once.
    """
    of_view: dict[int, list[int]] = {}
    for number, (_, rows) in enumerate(shown):
        for row in rows.tolist():
            of_view.setdefault(row, []).append(number)
    grids: dict[int, Grid] = {}
    found: list[list[_Sight]] = [[] for _ in shown]
    for turn, row in enumerate(sorted(of_view)):
        progress(turn / len(of_view))
        view = views[row]
        for number in of_view[row]:
            face = shown[number][0]
            plane = plane_view(view, face)
            if plane is None:
                continue
            grid = grids.setdefault(number, grid_of(face))
            mask = store.seen(row, plane, grid.samples, grid.pitch_m)
            mask &= _facing(view, face, grid)
            mask &= _is_fine(view, plane, grid)
            if mask.mean() > _LEAST_SHARE:
                found[number].append(_sight(row, view, store.levels(row), plane, grid, mask))
            if len(found[number]) >= _PRUNED_AT:
                found[number] = _best(found[number])
    return [
        _stacked(shown[number][0], grids[number], _best(sights)) if sights else None
        for number, sights in enumerate(found)
    ]


@dataclass(frozen=True)
class _Sight:
    """One view of one face."""

    view: int
    plane: PlaneView
    colour: NDArray[np.uint8]
    seen: NDArray[np.bool_]
    density: NDArray[np.float32]
    margin: NDArray[np.float32]


def _sight(
    number: int,
    view: View,
    halves: Halves,
    plane: PlaneView,
    grid: Grid,
    seen: NDArray[np.bool_],
) -> _Sight:
    density_of = density(plane, view, (grid.rows, grid.columns), grid.cell_m)
    shown = seen.reshape(grid.rows, SAMPLES, grid.columns, SAMPLES).any(axis=(1, 3))
    # Rather too blurred than with moiré: samples are compared, and not looked at.
    level, pixels = halves.at(level_of(1.5 * float(np.median(density_of[shown])), grid.pitch_m))
    colour = warped(pixels, plane, level, grid.samples, grid.pitch_m)
    return _Sight(number, plane, colour, seen, density_of, _margin(view, plane, grid))


def _is_fine(view: View, plane: PlaneView, grid: Grid) -> NDArray[np.bool_]:
    """(rows S, columns S) whether there are pixels enough to be worth it."""
    fine = density(plane, view, (grid.rows, grid.columns), grid.cell_m) >= LEAST_DENSITY_PX_M2
    return np.asarray(fine.repeat(SAMPLES, axis=0).repeat(SAMPLES, axis=1))


def _facing(view: View, face: Face, grid: Grid) -> NDArray[np.bool_]:
    """(rows S, columns S) whether a face is not seen from too far aside."""
    rows, columns = grid.samples
    x = (np.arange(columns) + 0.5) * grid.pitch_m
    y = (np.arange(rows) + 0.5) * grid.pitch_m
    to_eye = view.eye - face.corner
    across, below = to_eye @ face.right - x, (to_eye @ face.down - y)[:, None]
    out = float(to_eye @ face.normal)
    return np.asarray(out > _LEAST_FACING * np.sqrt(out * out + across**2 + below**2))


def _margin(view: View, plane: PlaneView, grid: Grid) -> NDArray[np.float32]:
    x = (np.arange(grid.columns) + 0.5) * grid.cell_m
    y = ((np.arange(grid.rows) + 0.5) * grid.cell_m)[:, None]
    along, down, depth = (row[0] * x + row[1] * y + row[2] for row in plane.matrix)
    depth = np.maximum(depth, 1e-2)
    width, height = view.camera.width_px, view.camera.height_px
    least = np.minimum.reduce(
        [along / depth, width - along / depth, down / depth, height - down / depth]
    )
    return np.asarray(np.clip(least / min(width, height), 0.0, 1.0), dtype=np.float32)


def _stacked(face: Face, grid: Grid, sights: Sequence[_Sight]) -> Sights:
    return Sights(
        face,
        grid,
        np.array([sight.view for sight in sights], dtype=np.int64),
        tuple(sight.plane for sight in sights),
        np.stack([sight.colour for sight in sights]),
        np.stack([sight.seen for sight in sights]),
        np.stack([sight.density for sight in sights]),
        np.stack([sight.margin for sight in sights]),
    )


def _best(sights: list[_Sight]) -> list[_Sight]:
    """The views that are among the best of some cell, at most `MOST_VIEWS`, in their order."""
    if len(sights) <= MOST_VIEWS:
        return sights
    value = np.stack(
        [sight.density * by_cell(sight.seen[None].astype(np.float32))[0] for sight in sights]
    )
    rank = np.argsort(np.argsort(-value, axis=0, kind="stable"), axis=0)
    wins = ((rank < BEST_PER_CELL) & (value > 0)).sum(axis=(1, 2))
    kept = np.sort(np.argsort(-wins, kind="stable")[:MOST_VIEWS])
    return [sights[row] for row in kept.tolist()]
