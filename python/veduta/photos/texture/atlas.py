"""Rectangles packed into few square pictures, on shelves: the tallest first."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

GUTTER = 4
"""Texels around each rectangle that go on with its edge: halves of the picture mix neighbours."""


@dataclass(frozen=True)
class Spot:
    """Where a rectangle lies: which atlas, and its upper left texel there."""

    atlas: int
    x: int
    y: int


@dataclass(frozen=True)
class Packing:
    """A spot per rectangle, and width and height of each atlas."""

    spots: tuple[Spot, ...]
    sizes: tuple[tuple[int, int], ...]


def packed(sizes: Sequence[tuple[int, int]], most_px: int) -> Packing:
    """Places for rectangles (width, height), none larger than `most_px` with its gutter.

    Next-fit decreasing height (Coffman et al. 1980): on a shelf from left to right, the next shelf
    below, the next atlas where none fits. The width is about that of a square for all.
    """
    grown = [(width + 2 * GUTTER, height + 2 * GUTTER) for width, height in sizes]
    if not grown:
        return Packing((), ())
    widest = max(width for width, _ in grown)
    if widest > most_px or max(height for _, height in grown) > most_px:
        raise ValueError(f"a rectangle is larger than the atlas ({most_px})")
    area = sum(width * height for width, height in grown)
    across = min(most_px, max(widest, math.ceil(1.05 * math.sqrt(area))))
    spots: dict[int, Spot] = {}
    ends: list[tuple[int, int]] = []
    x = y = shelf = right = 0
    order = sorted(range(len(grown)), key=lambda row: (-grown[row][1], -grown[row][0], row))
    for row in order:
        width, height = grown[row]
        if x + width > across:
            x, y, shelf = 0, y + shelf, 0
        if y + height > most_px:
            ends.append((right, y + shelf))
            x = y = shelf = right = 0
        spots[row] = Spot(len(ends), x + GUTTER, y + GUTTER)
        x, shelf = x + width, max(shelf, height)
        right = max(right, x)
    ends.append((right, y + shelf))
    return Packing(tuple(spots[row] for row in range(len(grown))), tuple(ends))


def filled(
    packing: Packing, images: Sequence[NDArray[np.uint8]], background: int | tuple[int, ...]
) -> list[NDArray[np.uint8]]:
    """The atlases with the images (h, w) or (h, w, 3) in their spots, gutters filled."""
    channels = images[0].shape[2:] if images else ()
    atlases = []
    for width, height in packing.sizes:
        atlas = np.empty((height, width, *channels), dtype=np.uint8)
        atlas[:] = background
        atlases.append(atlas)
    around = [(GUTTER, GUTTER), (GUTTER, GUTTER), *((0, 0) for _ in channels)]
    for spot, image in zip(packing.spots, images, strict=True):
        grown = np.pad(image, around, mode="edge")
        y, x = spot.y - GUTTER, spot.x - GUTTER
        atlases[spot.atlas][y : y + grown.shape[0], x : x + grown.shape[1]] = grown
    return atlases
