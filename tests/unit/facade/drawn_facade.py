"""Facades that the tests draw, head on: flat colours, an irregular grid of windows, a shadow."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.facade.analyse_plain import analyse_plain
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.options import FacadeOptions, RectifyOptions, ScaleOptions
from veduta.facade.rectify import Rectified, rectify
from veduta.imaging.read import Photo

SKY, ROOF, WALL = (175, 205, 235), (85, 90, 105), (214, 196, 160)
GLASS, FRAME, SIGN, LEDGE = (52, 60, 72), (240, 238, 232), (40, 92, 70), (180, 160, 126)
# Columns as parts of the width: (left, right), neither equally wide nor equally far apart.
COLUMNS = ((0.07, 0.17), (0.26, 0.35), (0.48, 0.60), (0.67, 0.76), (0.85, 0.94))


@dataclass(frozen=True)
class DrawnFacade:
    """What was drawn, in pixels; `boundaries` from the eaves down to the ground floor's top.

    `windows` are (x, y, width, height), floor by floor from the eaves and from left to right.
    """

    pixels: NDArray[np.uint8]
    ridge: int
    boundaries: list[int]
    stripes: list[tuple[int, int]]
    windows: list[tuple[int, int, int, int]]

    @property
    def storeys(self) -> int:
        """The ground floor and the floors above it."""
        return len(self.boundaries)


def draw_facade(
    floors: int = 5,
    columns: tuple[tuple[float, float], ...] = COLUMNS,
    shadow: bool = False,
    seed: int = 0,
    width: int = 420,
    roof: float = 0.6,
    ground: float = 1.15,
) -> DrawnFacade:
    """`floors` above a ground floor, of heights within 10 % of each other; about 620 px high.

    `roof` and `ground` are heights in storeys. With `shadow` the left half is in the shade.
    """
    rng = np.random.default_rng(seed)
    storey = 620 / (floors + 3)
    heights = [round(storey * f) for f in rng.uniform(0.95, 1.05, floors)]
    ridge, eaves = round(0.7 * storey), round((0.7 + roof) * storey)
    boundaries = np.cumsum([eaves, *heights]).tolist()
    height = boundaries[-1] + round(ground * storey)
    image = np.empty((height, width, 3))
    image[:ridge], image[ridge:eaves], image[eaves:] = SKY, ROOF, WALL
    stripes = [(round(a * width), round(b * width) - round(a * width)) for a, b in columns]
    windows = []
    for top, bottom in pairwise(boundaries):
        image[bottom - 3 : bottom] = LEDGE
        y, h = top + round(0.28 * (bottom - top)), round(0.55 * (bottom - top))
        for x, w in stripes:
            _window(image, x, y, w, h)
            windows.append((x, y, w, h))
    _shops(image, boundaries[-1], storey)
    _slates(image, ridge, eaves)
    if shadow:
        rows, at = np.arange(ridge, height)[:, None], np.arange(width)[None] + 0.5
        edge = (0.3 + 0.4 * (rows - ridge) / (height - ridge)) * width
        light = np.clip(0.8 + (at - edge) / (0.1 * width) * 0.2, 0.6, 1.0)
        image[ridge:] *= light[:, :, None]
    image += rng.normal(0, 2.0, image.shape)
    pixels = np.clip(image.round(), 0, 255).astype(np.uint8)
    return DrawnFacade(pixels, ridge, boundaries, stripes, windows)


def _window(image: NDArray[np.float64], x: int, y: int, w: int, h: int) -> None:
    image[y : y + h, x : x + w] = FRAME
    bar = max(1, w // 12)
    image[y + bar : y + h - bar, x + bar : x + w - bar] = GLASS
    middle = x + w // 2
    image[y : y + h, middle - bar // 2 : middle - bar // 2 + bar] = FRAME


def _shops(image: NDArray[np.float64], top: int, storey: float) -> None:
    """A sign over shop windows between pillars."""
    image[top:] = (70, 66, 62)
    image[top : top + round(0.3 * storey)] = SIGN
    lintel, width = top + round(0.35 * storey), image.shape[1]
    for i in range(7):
        x = round((i + 0.15) * width / 7)
        image[lintel : -round(0.1 * storey), x : x + width // 10] = (150, 160, 165)


def _slates(image: NDArray[np.float64], ridge: int, eaves: int) -> None:
    for i, y in enumerate(range(ridge + 3, eaves, 5)):
        image[y] *= 0.8
        image[y : min(y + 5, eaves), 4 * (i % 2) :: 8] *= 0.85


def photo_of(pixels: NDArray[np.uint8]) -> Photo:
    """The picture as if it had been read."""
    return Photo(pixels, "0" * 64, None, None, Path("drawn.png"))


def rectified_of(pixels: NDArray[np.uint8]) -> Rectified:
    """The picture, which is fronto-parallel."""
    return rectify(photo_of(pixels), RectifyOptions(rectified=True))


def analysed(pixels: NDArray[np.uint8], scale: ScaleOptions | None = None) -> FacadeDocument:
    """What the analysis says about a fronto-parallel picture."""
    height, width = pixels.shape[:2]
    source = Source(image="drawn.png", sha256="0" * 64, width_px=width, height_px=height)
    options = FacadeOptions(rectify=RectifyOptions(rectified=True), scale=scale or ScaleOptions())
    return analyse_plain(rectified_of(pixels), source, options)[0]
