"""What the fronts of a synthetic street look like: plaster or bricks, windows with curtains.

The colours are those in the light of the street; a picture of a front straight on is the truth that
textures are measured by.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives.street import Street

Colours = NDArray[np.float32]
Box = tuple[float, float, float, float]
TEXEL_M = 0.015
_LEVELS = 4
_HELD = 24
"""Fronts in memory at once."""
_PLASTERS = ((222, 202, 160), (176, 186, 178), (214, 172, 140), (232, 222, 196))
_BRICKS = ((178, 98, 76), (150, 92, 74))
_STONE, _LIGHT_STONE, _FRAME = (126, 120, 112), (236, 232, 222), (244, 243, 238)
_GLASS, _CURTAIN = (44, 54, 66), (186, 178, 162)


@dataclass(frozen=True, eq=False)
class House:
    """A house's front: the plane x = front_m, from low_m to high_m along the street, up to top_m.

    panes: (p, 4) of its windows: from y, to y, from z, to z (m). wall: (3,) its plain colour.
    """

    front_m: float
    low_m: float
    high_m: float
    top_m: float
    panes: NDArray[np.float64]
    wall: NDArray[np.float32]
    bricks: bool
    seed: int


class Fronts:
    """The fronts of a street. houses: in their order along it."""

    def __init__(self, street: Street, seed: int) -> None:
        own = street.walls[street.walls[:, 0, 2] == 0.0]
        self.houses = tuple(
            _house(box, street.panes, seed * 1009 + number) for number, box in enumerate(own)
        )
        self._ends = np.array([house.high_m for house in self.houses])
        self._painted = lru_cache(maxsize=_HELD)(lambda number: _pyramid(self.houses[number]))

    def number_at(self, y: NDArray[np.float64]) -> NDArray[np.int64]:
        """(n,) the house that stands at places along the street; the next one where none does."""
        return np.minimum(np.searchsorted(self._ends, y), len(self.houses) - 1)

    def colours(
        self, y: NDArray[np.float64], z: NDArray[np.float64], footprint_m: NDArray[np.float64]
    ) -> Colours:
        """(n, 3) 0..255 of the fronts at (n,) places along the street and heights (m).

        footprint_m: (n,) how much of the front one pixel sees there: finer detail is averaged.
        """
        found = np.zeros((len(y), 3), dtype=np.float32)
        number = self.number_at(y)
        level = np.log2(np.maximum(footprint_m, TEXEL_M) / TEXEL_M)
        level = np.minimum(np.rint(level), _LEVELS - 1).astype(np.int64)
        for which in np.unique(number).tolist():
            for row in np.unique(level[number == which]).tolist():
                mine = np.flatnonzero((number == which) & (level == row))
                house, painted = self.houses[which], self._painted(which)[row]
                texel = TEXEL_M * 2.0**row
                across = (y[mine] - house.low_m) / texel - 0.5
                down = (house.top_m - z[mine]) / texel - 0.5
                found[mine] = _sampled(painted, across, down)
        return found


def _sampled(picture: Colours, across: NDArray[np.float64], down: NDArray[np.float64]) -> Colours:
    """Bilinear, a strip at a time: OpenCV takes no more than 32,767 columns."""
    found = np.empty((len(across), 3), dtype=np.float32)
    for first in range(0, len(across), 30_000):
        rows = slice(first, first + 30_000)
        maps = (across[None, rows].astype(np.float32), down[None, rows].astype(np.float32))
        strip = cv2.remap(picture, *maps, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        found[rows] = strip[0]
    return found


def _house(box: NDArray[np.float64], panes: NDArray[np.float64], seed: int) -> House:
    (_, low, _), (front, high, top) = box.tolist()
    middle = panes[:, :, 1].mean(axis=1)
    own = panes[(middle > low) & (middle < high)]
    random = np.random.default_rng((seed, 7))
    tones = (*_PLASTERS, *_BRICKS)
    kind = int(random.integers(len(tones)))
    rectangles = np.stack([own[:, 0, 1], own[:, 1, 1], own[:, 0, 2], own[:, 1, 2]], axis=1)
    wall = np.array(tones[kind], dtype=np.float32)
    return House(front, low, high, top, rectangles, wall, kind >= len(_PLASTERS), seed)


def _pyramid(house: House) -> list[Colours]:
    levels = [_paint(house)]
    while len(levels) < _LEVELS:
        height, width = levels[-1].shape[:2]
        size = (max(width // 2, 1), max(height // 2, 1))
        smaller = cv2.resize(levels[-1], size, interpolation=cv2.INTER_AREA)
        levels.append(np.asarray(smaller, dtype=np.float32))
    return levels


def _paint(house: House) -> Colours:
    """(h, w, 3) the front straight on, top row first."""
    random = np.random.default_rng((house.seed, 11))
    height = int(np.ceil(house.top_m / TEXEL_M))
    width = int(np.ceil((house.high_m - house.low_m) / TEXEL_M))
    picture = np.broadcast_to(house.wall, (height, width, 3)).copy()
    if house.bricks:
        picture *= _bricks(height, width, random)[..., None]
    else:
        picture *= 1.0 + 0.02 * random.normal(size=(height, width, 1)).astype(np.float32)
    picture *= _stains(height, width, random)[..., None]

    sheet = _Sheet(house, picture)
    sheet.fill((house.low_m, house.high_m, 0.0, 0.45), _STONE, 1.0)
    for course in np.arange(3.1, house.top_m - 1.0, 3.1):
        sheet.fill((house.low_m, house.high_m, course + 0.1, course + 0.26), _LIGHT_STONE, 0.93)
    cornice = (house.low_m, house.high_m, house.top_m - 0.45, house.top_m)
    sheet.fill(cornice, _LIGHT_STONE, 0.88)
    for y0, y1, z0, z1 in house.panes.tolist():
        sheet.fill((y0 - 0.12, y1 + 0.12, z1, z1 + 0.22), _LIGHT_STONE, 0.9)
        sheet.fill((y0 - 0.15, y1 + 0.15, z0 - 0.1, z0), _LIGHT_STONE, 1.0)
        sheet.fill((y0, y1, z0, z1), _FRAME, 1.0)
        _glaze(sheet, (y0, y1, z0, z1), random)
    return np.clip(picture, 0, 255)


@dataclass(frozen=True, eq=False)
class _Sheet:
    """A front's picture that is painted on in metres."""

    house: House
    picture: Colours

    def fill(self, box: Box, colour: tuple[int, ...], light: float) -> None:
        """From y to y, from z to z (m)."""
        y0, y1, z0, z1 = box
        left, right = (int((y - self.house.low_m) / TEXEL_M) for y in (y0, y1))
        top, bottom = (int((self.house.top_m - z) / TEXEL_M) for z in (z1, z0))
        tone = np.array(colour, dtype=np.float32) * np.float32(light)
        self.picture[max(top, 0) : bottom, max(left, 0) : right] = tone


def _glaze(sheet: _Sheet, box: Box, random: np.random.Generator) -> None:
    """Four panes between bars; behind them curtains, or not, and a part of the sky in them."""
    y0, y1, z0, z1 = box
    middle, bar = (y0 + y1) / 2, z0 + 0.62 * (z1 - z0)
    drawn = random.uniform(0.0, 0.45) if random.uniform() < 0.6 else 0.0
    sky = random.uniform(0.85, 1.5)
    edge = drawn * (y1 - y0) * 0.5
    left, right = (y0 + 0.08, middle - 0.03), (middle + 0.03, y1 - 0.08)
    curtains = (left[0], min(left[0] + edge, left[1])), (max(right[1] - edge, right[0]), right[1])
    for low, high, light in ((z0 + 0.08, bar - 0.03, sky), (bar + 0.03, z1 - 0.08, 1.2 * sky)):
        for pane, curtain in zip((left, right), curtains, strict=True):
            sheet.fill((*pane, low, high), _GLASS, light)
            if drawn > 0.0:
                sheet.fill((*curtain, low, high), _CURTAIN, 0.62)


def _bricks(height: int, width: int, random: np.random.Generator) -> NDArray[np.float32]:
    """(h, w) factors: courses of 75 mm, bricks of 240 mm with joints, each of its own tone."""
    down = (np.arange(height) * TEXEL_M)[:, None]
    course = (down / 0.075).astype(np.int64)
    across = (np.arange(width) * TEXEL_M)[None] + 0.12 * (course % 2)
    number = (across / 0.24).astype(np.int64)
    tones = 1.0 + 0.07 * random.normal(size=(course.max() + 1, number.max() + 1))
    joint = (np.mod(down, 0.075) < TEXEL_M) | (np.mod(across, 0.24) < TEXEL_M)
    return np.where(joint, 1.22, tones[course, number]).astype(np.float32)


def _stains(height: int, width: int, random: np.random.Generator) -> NDArray[np.float32]:
    """(h, w) factors about 1 that change over metres."""
    size = (max(height // 100, 2), max(width // 100, 2))
    coarse = (1.0 + 0.04 * random.normal(size=size)).astype(np.float32)
    return np.asarray(cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC))
