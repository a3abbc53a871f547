"""What stands before the front, pixel by pixel, as the learned eyes see it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes import Seen

KINDS = ("nothing", "balcony", "tree", "hedge", "vehicle", "person", "fence", "wire")
"""A pixel of `before.png` is a place in this list."""
ON_THE_GROUND = ("hedge", "vehicle", "person", "fence")

Kinds = NDArray[np.uint8]


@dataclass(frozen=True)
class HiddenParameters:
    """When something is before the front.

    chance: of a pixel, at least. sure: the mean chance of a piece, at least. least: the share of
    the picture that a piece takes, so that single pixels are no thing. low: the lower part of the
    picture, to which what stands on the ground must reach down. (Seen on pictures that the network
    was trained on: what it takes for a vehicle high on a front is dark brick.) grows: what touches
    a piece and has this chance of its kind, or of a vehicle beside another, belongs to it. hull: a
    vehicle is filled up to its convex hull where that is at most so many times as large.
    """

    chance: float = 0.45
    sure: float = 0.6
    least: float = 0.0006
    low: float = 0.12
    grows: float = 0.15
    hull: float = 1.8


def hidden_kinds(seen: Seen, parameters: HiddenParameters | None = None) -> Kinds:
    """(h, w) places in `KINDS`, at the size of the picture that was looked at."""
    p = parameters or HiddenParameters()
    names = KINDS[1:]
    chances = np.stack([seen.chance(name) for name in names])
    best = chances.argmax(axis=0)
    found = np.where(chances.max(axis=0) >= p.chance, best + 1, 0).astype(np.uint8)
    for place, name in enumerate(names, start=1):
        _keep_pieces(found, place, chances[place - 1], name in ON_THE_GROUND, p)
    _grow(found, chances, p)
    _fill_vehicles(found, p)
    size = seen.width_px, seen.height_px
    return np.asarray(cv2.resize(found, size, interpolation=cv2.INTER_NEAREST), np.uint8)


def _grow(found: Kinds, chances: NDArray[np.float32], p: HiddenParameters) -> None:
    """Let each kind that stands on the ground have what touches it and may be of its kind."""
    for name in ON_THE_GROUND:
        place = KINDS.index(name)
        if not (found == place).any():
            continue
        likely = ((found == place) | ((chances[place - 1] >= p.grows) & (found == 0))).astype(
            np.uint8
        )
        _, pieces = cv2.connectedComponents(likely)
        touched = np.unique(pieces[found == place])
        found[np.isin(pieces, touched) & (likely > 0)] = place


def _fill_vehicles(found: Kinds, p: HiddenParameters) -> None:
    """Fill vehicles up to their convex hulls: panes and roofs look as what is behind them does."""
    place = KINDS.index("vehicle")
    mask = (found == place).astype(np.uint8)
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    for contour in contours:
        hull = cv2.convexHull(contour)
        if cv2.contourArea(hull) <= p.hull * max(cv2.contourArea(contour), 1.0):
            filled = cv2.fillConvexPoly(np.zeros_like(mask), hull, 1)
            found[(filled > 0) & (found == 0)] = place


def _keep_pieces(
    found: Kinds, place: int, chance: NDArray[np.float32], stands: bool, p: HiddenParameters
) -> None:
    """Forget the pieces of one kind that are small, unsure, or hang in the air and do not stand."""
    mask = found == place
    count, pieces, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    if count < 2:
        return
    pixels = pieces.ravel()
    area = np.maximum(stats[:, cv2.CC_STAT_AREA], 1)
    mean = np.bincount(pixels, chance.ravel(), minlength=count) / area
    foot = stats[:, cv2.CC_STAT_TOP] + stats[:, cv2.CC_STAT_HEIGHT]
    keep = (mean >= p.sure) & (area >= p.least * mask.size)
    if stands:
        keep &= foot >= (1.0 - p.low) * mask.shape[0]
    keep[0] = False
    found[mask & ~keep[pieces]] = 0
