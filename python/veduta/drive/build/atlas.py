"""One texture for a segment: rows and columns reserve their space, images are warped in (7.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.pictures_of import Seen


_ROWS_AT_ONCE = 64


@dataclass(frozen=True)
class AtlasParameters:
    """in_front_m: what hides a texel is so much nearer than it. steepest: cosine of the angle
    between surface and ray below which an image shows a texel too slantingly.
    differs: difference from the median of all images (of 255) at which one shows something else.
    fewest: images that must show a texel for such a vote. block: texels, seams run between blocks.
    sky: texels where most images show sky are of no wall. largest: texels of a side of the atlas.
    seam_base, seam_slope, seam_most, rounds: costs of seams, and rounds of their search. normal:
    texels over which the surface's direction is taken.
    """

    in_front_m: float = 0.4
    steepest: float = 0.05
    differs: float = 26.0
    fewest: int = 3
    block: int = 6
    largest: int = 8192
    seam_base: float = 0.08
    seam_slope: float = 1.5
    seam_most: float = 1.0
    rounds: int = 10
    normal: int = 25


@dataclass(frozen=True, eq=False)
class Atlas:
    """pixels: (h, w, 3) uint8. seen: (h, w) bool, some image shows the texel. surface: (h, w) bool,
    there is something to texture. row, column: texels of the rows and columns of the depth image,
    first to last, the lowest row at the bottom.
    """

    pixels: NDArray[np.uint8]
    seen: NDArray[np.bool_]
    surface: NDArray[np.bool_]
    row: NDArray[np.float64]
    column: NDArray[np.float64]
    inputs_px: int

    def uv(self, pixel: NDArray[np.float64]) -> NDArray[np.float32]:
        """(v, 2) glTF texture coordinates of (v, 2) rows and columns of the depth image."""
        height, width = self.seen.shape
        rows, columns = np.arange(len(self.row)), np.arange(len(self.column))
        return np.stack(
            [
                np.interp(pixel[:, 1], columns, self.column) / width,
                np.interp(pixel[:, 0], rows, self.row) / height,
            ],
            axis=1,
        ).astype(np.float32)

    def spread(self, values: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """(h, w) what a mask of the depth image (r, c) says of each texel."""
        rows, columns = grid_places(self.row, self.column, self.seen.shape)
        at = np.ix_(np.rint(rows).astype(np.int64), np.rint(columns).astype(np.int64))
        return np.asarray(values[at], dtype=bool)


def grid_places(
    row: NDArray[np.float64],
    column: NDArray[np.float64],
    shape: tuple[int, ...],
    outside: float | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(h,), (w,) the rows and columns of the depth image at the texels' middles, of which `row` and
    `column` say the texels. outside: told beyond its ends; None: the end itself.
    """
    up, sign = -(np.arange(shape[0]) + 0.5), 1.0 if column[-1] > column[0] else -1.0
    across = sign * (np.arange(shape[1]) + 0.5)
    return (
        np.interp(up, -row, np.arange(len(row)), left=outside, right=outside),
        np.interp(across, sign * column, np.arange(len(column)), left=outside, right=outside),
    )


def lay_out(
    depth: NDArray[np.float32], frame: ColumnFrame, texel_m: float, largest: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[int, int]]:
    """Texels at which each row and column stands, and the atlas's height and width."""
    grid = frame.vertices(depth)
    with np.errstate(invalid="ignore"):
        rise = np.linalg.norm(np.diff(grid, axis=0), axis=2)
        run = np.linalg.norm(np.diff(grid, axis=1), axis=2)
    between_rows = _middle(rise, axis=1)
    between_columns = _middle(run, axis=0)
    row = np.concatenate([[0.0], np.cumsum(between_rows)]) / texel_m
    column = np.concatenate([[0.0], np.cumsum(between_columns)]) / texel_m
    shrink = min(1.0, (largest - 2) / max(row[-1], column[-1], 1.0))
    height = int(np.ceil(row[-1] * shrink)) + 2
    width = int(np.ceil(column[-1] * shrink)) + 2
    across = column * shrink + 1.0
    # As one sees it from the street: to the right of the path columns run from right to left.
    across = width - across if frame.side == "right" else across
    return height - 1.0 - row * shrink, across, (height, width)


def _middle(lengths: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """The median of the known lengths of each row or column; 0 where nothing is."""
    known = np.isfinite(lengths).any(axis=axis)
    found = np.zeros(lengths.shape[1 - axis])
    if known.any():
        chosen = lengths[known] if axis == 1 else lengths[:, known]
        found[known] = np.nanmedian(chosen, axis=axis)
    return found


def build_atlas(
    depth: NDArray[np.float32],
    frame: ColumnFrame,
    seen: Sequence[Seen],
    texel_m: float,
    parameters: AtlasParameters | None = None,
) -> Atlas:
    """The best image of each block of texels, what others show instead outvoted."""
    chosen = parameters or AtlasParameters()
    row, column, shape = lay_out(depth, frame, texel_m, chosen.largest)
    place, normal = _texels(depth, frame, row, column, shape, chosen.normal)
    surface = np.isfinite(place[..., 0])
    views = [_view(one, place, normal, surface, chosen) for one in seen]
    inputs = sum(one.pixels.shape[0] * one.pixels.shape[1] for one in seen)
    empty = np.full((*shape, 3), 128, dtype=np.uint8)
    if not len(views):
        return Atlas(empty, np.zeros(shape, dtype=bool), surface, row, column, inputs)
    colour = np.stack([view[0] for view in views])
    score = np.stack([view[1] for view in views])
    believed = _undisturbed(colour, score, chosen)
    label = _chosen(colour, np.where(believed, score, 0.0), chosen)
    usable = np.where(believed, score, 0.0)
    best = np.where(
        np.take_along_axis(usable, label[None], axis=0)[0] > 0.0, label, usable.argmax(axis=0)
    )
    shown = usable.max(axis=0) > 0.0
    pixels = np.take_along_axis(colour, best[None, ..., None], axis=0)[0]
    pixels = np.where(shown[..., None], pixels, 128).astype(np.uint8)
    return Atlas(pixels, shown & surface, surface, row, column, inputs)


def _texels(
    depth: NDArray[np.float32],
    frame: ColumnFrame,
    row: NDArray[np.float64],
    column: NDArray[np.float64],
    shape: tuple[int, int],
    over: int,
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """(h, w, 3) world points of the texels' middles, NaN outside, and their unit normals."""
    origin = frame.origins[len(frame.origins) // 2]
    grid = (frame.vertices(depth) - origin).astype(np.float32)
    rows, columns = grid_places(row, column, shape, outside=-1.0)
    at = np.meshgrid(columns.astype(np.float32), rows.astype(np.float32))
    place: NDArray[Any] = cv2.remap(
        grid, at[0], at[1], cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_CONSTANT, borderValue=(np.nan,) * 3,
    )  # fmt: skip
    smooth = _smooth(place, (over, over))
    cross: NDArray[Any] = np.cross(np.gradient(smooth, axis=1), np.gradient(smooth, axis=0))
    length = np.linalg.norm(cross, axis=2, keepdims=True)
    normal = (cross / np.maximum(length, 1e-9)).astype(np.float32)
    return np.asarray(place + origin, dtype=np.float64), normal


def _smooth(place: NDArray[Any], size: tuple[int, int]) -> NDArray[Any]:
    """The texels' places averaged over those around that are there: normals without noise."""
    known = np.isfinite(place[..., 0]).astype(np.float32)
    weight = np.maximum(cv2.blur(known, size), 1e-6)
    return np.asarray(cv2.blur(np.nan_to_num(place), size) / weight[..., None])


def _view(
    one: Seen,
    place: NDArray[np.float64],
    normal: NDArray[np.float32],
    surface: NDArray[np.bool_],
    chosen: AtlasParameters,
) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """(h, w, 3) the texels as an image shows them, and (h, w) how well, 0 where it does not."""
    shape = surface.shape
    projected, away = one.shot.project(np.nan_to_num(place).reshape(-1, 3))
    pixels = (projected - 0.5).astype(np.float32).reshape(*shape, 2)
    depth = away.astype(np.float32).reshape(shape)
    height, width = one.sky.shape
    inside = surface & (depth > 1.0) & (pixels >= 1.0).all(axis=2)
    inside &= (pixels[..., 0] < width - 2) & (pixels[..., 1] < height - 2)
    at = (np.where(inside, pixels[..., 0], 0.0), np.where(inside, pixels[..., 1], 0.0))
    maps = (at[0].astype(np.float32), at[1].astype(np.float32))
    colour = np.asarray(cv2.remap(one.pixels, *maps, cv2.INTER_LINEAR), dtype=np.uint8)
    hidden = cv2.remap(one.hidden_m, *maps, cv2.INTER_NEAREST) < depth - chosen.in_front_m
    other = (one.sky | one.leaves).astype(np.uint8)
    sky = cv2.remap(other, *maps, cv2.INTER_NEAREST) > 0
    ray = np.nan_to_num(place) - one.shot.world_from_cam[:3, 3]
    distance = np.maximum(np.linalg.norm(ray, axis=2), 1e-6)
    cosine = np.abs((ray * normal).sum(axis=2)) / distance
    good = inside & ~hidden & ~sky & (cosine > chosen.steepest)
    score = np.where(good, cosine * one.shot.focal_px[0] / np.maximum(depth, 1.0), 0.0)
    return colour, score.astype(np.float32)


def _undisturbed(
    colour: NDArray[np.uint8], score: NDArray[np.float32], chosen: AtlasParameters
) -> NDArray[np.bool_]:
    """(k, h, w) which images show what most do: parallax moves trees, not the facade (7.1)."""
    seen = score > 0.0
    middle = _median_seen(colour, seen)
    soft = cv2.blur(middle, (3, 3))
    many = seen.sum(axis=0) >= chosen.fewest
    believed = seen.copy()
    for row in range(len(colour)):
        off = np.abs(cv2.blur(colour[row], (3, 3)).astype(np.float32) - soft).max(axis=2)
        other = (many & seen[row] & (off > chosen.differs)).astype(np.uint8)
        other = cv2.morphologyEx(other, cv2.MORPH_OPEN, np.ones((2, 2), np.uint8))
        other = cv2.dilate(other, np.ones((3, 3), np.uint8))
        believed[row] &= other == 0
    return believed


def _median_seen(colour: NDArray[np.uint8], seen: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w, 3) the middle of what the images that see a texel show; 0 where none does."""
    middle = np.empty(colour.shape[1:], dtype=np.float32)
    for top in range(0, colour.shape[1], _ROWS_AT_ONCE):  # many images of large atlases
        rows = slice(top, top + _ROWS_AT_ONCE)
        some = np.where(seen[:, rows, :, None], colour[:, rows].astype(np.int16), 999)
        some.sort(axis=0)
        at = np.maximum((seen[:, rows].sum(axis=0) - 1) // 2, 0)
        found = np.take_along_axis(some, at[None, ..., None], axis=0)[0]
        middle[rows] = np.where(found == 999, 0, found)
    return middle


def _chosen(
    colour: NDArray[np.uint8], score: NDArray[np.float32], chosen: AtlasParameters
) -> NDArray[np.int64]:
    """(h, w) the image of each texel: by blocks, the finest one, with few seams."""
    count, height, width = score.shape
    size = (max(width // chosen.block, 1), max(height // chosen.block, 1))
    fine = np.stack([cv2.resize(layer, size, interpolation=cv2.INTER_AREA) for layer in score])
    tone = np.stack([cv2.resize(layer, size, interpolation=cv2.INTER_AREA) for layer in colour])
    unseen = fine <= 0.0
    most = np.maximum(fine.max(axis=0), 1e-6)
    cost = np.where(unseen, 50.0, 2.0 * (1.0 - fine / most)).astype(np.float32)
    cost[:, unseen.all(axis=0)] = 0.0
    tones = np.where(unseen[..., None], np.nan, tone / 255.0).astype(np.float32)
    cells = size[0] * size[1]
    label = _core.label_cells(
        np.ascontiguousarray(np.moveaxis(cost, 0, -1).reshape(cells, count)),
        np.ascontiguousarray(np.moveaxis(tones, 0, 2).reshape(cells, -1)),
        (size[1], size[0]),
        base=chosen.seam_base, slope=chosen.seam_slope, most=chosen.seam_most,
        rounds=chosen.rounds,
    )  # fmt: skip
    grown = cv2.resize(label.astype(np.float32), (width, height), interpolation=cv2.INTER_NEAREST)
    return np.asarray(grown, dtype=np.int64)
