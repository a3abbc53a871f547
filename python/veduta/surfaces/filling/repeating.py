"""Holes filled by what stands at offsets that are known beforehand.

Who knows by which offsets a facade repeats itself (its windows tell) need not search for them. To
these come steps as long as each hole. Which offset serves where is decided on a small copy of the
picture, by how like the known pixels around are to those at the offset; what is copied has full
size. Beside it stand what is above the hole, carried down, and an interpolation: the three are
weighed by the error that is to be expected of each.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.carrying import carried_down
from veduta.surfaces.filling.choosing import Choice, Offsets, Spoilt, choose, refined
from veduta.surfaces.filling.options import FillParameters, RepeatParameters
from veduta.surfaces.filling.windows import level_with_rim

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
_SURE = np.float32(1.0)
_NEVER = np.float32(1e9)


@dataclass(frozen=True, eq=False)
class Repeated:
    """pixels (h, w, 3) uint8, no hole left; copied (h, w) float32: the share of copies, 0..1.

    The rest of a hole is interpolated: nothing on the facade is like what is around it.
    """

    pixels: NDArray[np.uint8]
    copied: Floats


def fill_by_repeats(
    pixels: NDArray[np.uint8],
    holes: Mask,
    offsets: Offsets,
    reach_px: float,
    zones: NDArray[np.int64] | None = None,
    parameters: RepeatParameters | None = None,
) -> Repeated:
    """Fill the holes (h, w) of a picture (h, w, 3), by what stands at offsets (k, 2), x y, first.

    reach_px: the size of what repeats, about that of a storey. zones: (h,) rows of different
    numbers never serve each other (a ground floor is no upper floor). The same comes out for the
    same input. ValueError where the shapes differ or nothing is known.
    """
    chosen = parameters or RepeatParameters()
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.shape[:2] != holes.shape:
        raise ValueError(f"pixels {pixels.shape} and holes {holes.shape} do not belong together")
    if holes.all():
        raise ValueError("nothing of the picture is known")
    if not holes.any():
        return Repeated(pixels, np.zeros(holes.shape, dtype=np.float32))
    height, width = holes.shape
    spoilt = Spoilt(pixels, holes, np.zeros(height, np.int64) if zones is None else zones)
    scale = min(1.0, chosen.longest_px / max(holes.shape))
    steps = np.concatenate([offsets.reshape(-1, 2), _own_steps(holes, chosen)])
    small = spoilt.small(scale)
    choice = choose(small, np.rint(steps * scale).astype(np.int64), reach_px * scale, chosen)
    steps = refined(spoilt, choice, steps, max(4, round(0.3 * reach_px)), chosen)
    taken, there = _copied(spoilt, steps, choice)
    taken += _light(pixels, taken, there & ~holes, scale)
    cost = cv2.resize(choice.cost, (width, height), interpolation=cv2.INTER_LINEAR)
    cost = np.where(there, np.minimum(cost, 255.0**2), _NEVER)
    # At the picture's border the interpolation takes up what is in the hole.
    usual = np.median(pixels[~holes], axis=0).astype(np.uint8)
    bare = np.where(holes[..., None], usual, pixels)
    smooth = cv2.inpaint(bare, holes.astype(np.uint8), chosen.telea_px, cv2.INPAINT_TELEA)
    down = carried_down(spoilt, reach_px, chosen)
    ways = [
        (taken, cost),
        (down.pixels, down.cost),
        (smooth.astype(np.float32), _smooth_cost(spoilt, chosen.smooth * reach_px, chosen.beside)),
    ]
    weights = np.stack([(1.0 / np.maximum(each, _SURE)) ** chosen.sharp for _, each in ways])
    weights /= weights.sum(axis=0)
    mixed = sum(weight[..., None] * way for weight, (way, _) in zip(weights, ways, strict=True))
    made = np.where(holes[..., None], np.clip(np.rint(mixed), 0, 255), pixels).astype(np.uint8)
    return Repeated(made, np.where(holes, 1.0 - weights[2], 0.0).astype(np.float32))


def _own_steps(holes: Mask, parameters: RepeatParameters) -> Offsets:
    """Steps (k, 2) that lead out of the largest holes: up, down, left, right, whole and half."""
    _, _, stats, _ = cv2.connectedComponentsWithStats(holes.astype(np.uint8))
    areas = stats[1:, cv2.CC_STAT_AREA]
    steps = set()
    for number in np.argsort(-areas, kind="stable")[: parameters.largest] + 1:
        wide, high = (int(stats[number, k]) for k in (cv2.CC_STAT_WIDTH, cv2.CC_STAT_HEIGHT))
        # Holes of about one size share their steps.
        x, half_x, y, half_y = (6 * (int(v + 3) // 6 + 1) for v in (wide, wide / 2, high, high / 2))
        steps |= {(0, -y), (0, y), (x, 0), (-x, 0), (0, -half_y), (half_x, 0), (-half_x, 0)}
    return np.array(sorted(steps), dtype=np.int64).reshape(-1, 2)


def _copied(spoilt: Spoilt, offsets: Offsets, choice: Choice) -> tuple[Floats, Mask]:
    """What lies at the offset that was chosen for each pixel, and where that is known."""
    height, width = spoilt.holes.shape
    number = cv2.resize(choice.number, (width, height), interpolation=cv2.INTER_NEAREST)
    rows, columns = np.indices(number.shape, dtype=np.int64)
    by = offsets[np.maximum(number, 0)]
    y, x = rows + by[..., 1], columns + by[..., 0]
    inside = (number >= 0) & (y >= 0) & (y < height) & (x >= 0) & (x < width)
    y, x = np.where(inside, y, 0), np.where(inside, x, 0)
    inside &= (spoilt.zones[y] == spoilt.zones[rows]) & ~spoilt.holes[y, x]
    return spoilt.pixels[y, x].astype(np.float32), inside


def _light(given: NDArray[np.uint8], taken: Floats, known: Mask, scale: float) -> Floats:
    """(h, w, 3) what to add to copied pixels so that they are as bright as what is beside them."""
    height, width = known.shape
    size = max(1, round(width * scale)), max(1, round(height * scale))
    there = cv2.resize(known.astype(np.float32), size, interpolation=cv2.INTER_AREA)
    one, other = (
        np.asarray(
            cv2.resize(
                np.where(known[..., None], picture, 0).astype(np.float32),
                size,
                interpolation=cv2.INTER_AREA,
            )
            / np.maximum(there, 1e-3)[..., None],
            np.float32,
        )
        for picture in (given, taken)
    )
    level = level_with_rim(one, other, np.asarray(there > 0.5), FillParameters().light)
    return np.asarray(cv2.resize(level, (width, height), interpolation=cv2.INTER_LINEAR))


def _smooth_cost(spoilt: Spoilt, near_px: float, beside: float) -> Floats:
    """(h, w) mean square error that is to be expected of an interpolation.

    It grows with the distance from what is known to how much that varies.
    """
    known = (~spoilt.holes).astype(np.float32)
    grey = cv2.cvtColor(spoilt.pixels, cv2.COLOR_RGB2GRAY).astype(np.float32) * known
    side = 2 * max(1, round(4.0 * near_px)) + 1
    weight = cv2.boxFilter(known, -1, (side, side)) + 1e-3
    mean = cv2.boxFilter(grey, -1, (side, side)) / weight
    square = cv2.boxFilter(grey * grey, -1, (side, side)) / weight
    varies = np.maximum(square - mean * mean, 0.0)
    away = cv2.distanceTransform(spoilt.holes.astype(np.uint8), cv2.DIST_L2, 3)
    smooth = varies * (1.0 - np.exp(-away / max(near_px, 1.0))) + beside
    return np.asarray(smooth, np.float32)
