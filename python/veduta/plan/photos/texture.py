"""A block of whole tiles, rectified: a texture that continues itself when it is repeated."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography
from veduta.geometry.homography import Matrix
from veduta.imaging.warp import warp
from veduta.plan.photos.lattice import Bond, Lattice, origins
from veduta.plan.photos.rectangles import Pixels

MOST_TILES = 4
"""A block has at most so many along each side."""
SHARP_PX = 48.0
"""A tile that is seen this large is as good as a larger one."""
SIDE_PX = (24, 256)
"""The longer side of a tile in the texture."""


@dataclass(frozen=True)
class Block:
    """A rectangle of whole tiles. start: its upper left corner, tiles: to the right and down."""

    start: tuple[float, float]
    tiles: tuple[int, int]

    @property
    def corners(self) -> NDArray[np.float64]:
        """(4, 2) clockwise from the upper left, in tiles."""
        (x, y), (width, height) = self.start, self.tiles
        return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def best_block(lattice: Lattice) -> Block | None:
    """The largest block of tiles that were all found, and that are seen sharply.

    The rows of a bond repeat after two of them.
    """
    low, filled = _half_cells(lattice)
    sums = np.pad(filled.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    best: tuple[float, Block] | None = None
    step_x, step_y = _period(lattice.bond)
    for height in range(step_y, MOST_TILES + 1, step_y):
        for width in range(step_x, MOST_TILES + 1, step_x):
            h, w = 2 * height, 2 * width
            if h > filled.shape[0] or w > filled.shape[1]:
                continue
            inside = sums[h:, w:] - sums[:-h, w:] - sums[h:, :-w] + sums[:-h, :-w]
            rows, columns = np.nonzero((inside == h * w)[::2, ::2])
            if not len(rows):
                continue
            starts = np.stack([columns, rows], axis=1) + low
            worth = width * height * _sharpness(lattice, starts + np.array([width, height]) / 2.0)
            at = int(worth.argmax())
            if best is None or worth[at] > best[0]:
                x, y = starts[at].tolist()
                best = float(worth[at]), Block((float(x), float(y)), (width, height))
    return None if best is None else best[1]


def block_texture(pixels: Pixels, photo_from_tiles: Matrix, block: Block, shape: float) -> Pixels:
    """(h, w, 3) the block as seen from straight before it, evenly lit.

    shape: a tile's width by its height.
    photo_from_tiles: for these pixels.
    """
    middle = block.corners.mean(axis=0, keepdims=True)
    area = abs(float(homography.area_scale(photo_from_tiles, middle)[0]))
    longer = np.sqrt(area * max(shape, 1.0 / shape))
    side = float(np.clip(longer, *SIDE_PX))
    tile = np.array([side, side / shape] if shape > 1.0 else [side * shape, side])
    width, height = np.maximum((tile * block.tiles).round().astype(int), 2).tolist()
    target = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
    seen = homography.apply(photo_from_tiles, block.corners)
    flat, _ = warp(pixels, homography.from_points(seen, target), width, height)
    return evenly_lit(flat)


def evenly_lit(pixels: Pixels) -> Pixels:
    """Without the gradient of light across it, which would show at each repetition."""
    height, width = pixels.shape[:2]
    light = np.log(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float64) + 1.0)
    x = np.linspace(-1.0, 1.0, width)
    y = np.linspace(-1.0, 1.0, height)
    # x and y are about 0 and independent: each slope is a plain regression.
    slope_x = float((light.mean(axis=0) @ x) / (x @ x))
    slope_y = float((light.mean(axis=1) @ y) / (y @ y))
    even = pixels * np.exp(-slope_x * x[None, :, None] - slope_y * y[:, None, None])
    return even.round().clip(0, 255).astype(np.uint8)


def _period(bond: Bond) -> tuple[int, int]:
    return {"none": (1, 1), "rows": (1, 2), "columns": (2, 1)}[bond]


def _half_cells(lattice: Lattice) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The first corner, in whole tiles, and (h, w) which halves of tiles were found from there."""
    at = origins(lattice.cells, lattice.bond)
    low = np.floor(at.min(axis=0))
    halves = ((at - low) * 2.0).round().astype(np.int64)
    filled = np.zeros((halves[:, 1].max() + 2, halves[:, 0].max() + 2), dtype=np.int64)
    for x in (0, 1):
        for y in (0, 1):
            filled[halves[:, 1] + y, halves[:, 0] + x] = 1
    return low, filled


def _sharpness(lattice: Lattice, middles: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) 0 to 1: how large tiles are seen at points of the lattice."""
    area = np.abs(homography.area_scale(lattice.photo_from_tiles, middles))
    sharp: NDArray[np.float64] = np.minimum(np.sqrt(area) / SHARP_PX, 1.0)
    return sharp
