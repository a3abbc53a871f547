"""Whether images agree where geometry was filled: a wall that is not there looks different in each.

A point on the true surface has one colour in all images that see it; a point beside it shows what
lies behind, which moves from image to image (photo-consistency, Kutulakos and Seitz 2000).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Background, Source
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.pictures_of import Seen


@dataclass(frozen=True)
class ConsistencyParameters:
    """in_front_m: what hides a point is so much nearer. every: of so many pixels one is looked at.
    fewest: images that must see it. times: colours that differ by more than so many times what they
    do on measured walls (the median there) contradict. least: and by more than this (of 255).
    """

    in_front_m: float = 0.4
    every: int = 2
    fewest: int = 3
    times: float = 3.0
    least: float = 15.0


@dataclass(frozen=True, eq=False)
class Consistency:
    """contradicted: (r, c) bool, filled pixels where images disagree. looked: how many were seen by
    enough images, and could be held against measured ones; share: of those that are contradicted,
    NaN where none was.
    """

    contradicted: NDArray[np.bool_]
    looked: int
    share: float


def check_filled(
    background: Background,
    frame: ColumnFrame,
    seen: Sequence[Seen],
    parameters: ConsistencyParameters | None = None,
) -> Consistency:
    """Compares filled walls with measured ones in the images."""
    chosen = parameters or ConsistencyParameters()
    empty = np.zeros(background.depth.shape, dtype=bool)
    wall = background.wall & np.isfinite(background.depth)
    rows, columns = np.nonzero(wall)
    kept = (rows % chosen.every == 0) & (columns % chosen.every == 0)
    rows, columns = rows[kept], columns[kept]
    if len(seen) < chosen.fewest or not len(rows):
        return Consistency(empty, 0, float("nan"))
    points = frame.vertices(background.depth)[rows, columns]
    spread = _spread(points, seen, chosen)
    source = background.source[rows, columns]
    measured = (source == Source.MEASURED) & np.isfinite(spread)
    filled = (source == Source.FILLED) & np.isfinite(spread)
    if not measured.any() or not filled.any():
        return Consistency(empty, 0, float("nan"))
    usual = float(np.median(spread[measured]))
    bad = filled & (spread > max(chosen.times * usual, chosen.least))
    empty[rows[bad], columns[bad]] = True
    return Consistency(empty, int(filled.sum()), float(bad.sum() / filled.sum()))


def _spread(
    points: NDArray[np.float64], seen: Sequence[Seen], chosen: ConsistencyParameters
) -> NDArray[np.float64]:
    """(n,) median distance of a point's colours from their median; NaN where too few see it."""
    colours = np.full((len(seen), len(points), 3), np.nan)
    for row, one in enumerate(seen):
        soft = cv2.blur(one.pixels, (5, 5))
        pixels, depth = one.shot.project(points)
        height, width = one.hidden_m.shape
        at = np.floor(np.clip(pixels, -1.0, 1e6)).astype(np.int64)
        inside = (depth > 1.0) & (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
        at = np.where(inside[:, None], at, 0)
        inside &= one.hidden_m[at[:, 1], at[:, 0]] > depth - chosen.in_front_m
        inside &= ~(one.sky | one.leaves)[at[:, 1], at[:, 0]]
        colours[row, inside] = soft[at[inside, 1], at[inside, 0]]
    count = np.isfinite(colours[..., 0]).sum(axis=0)
    some = count >= chosen.fewest
    found = np.full(len(points), np.nan)
    own = colours[:, some]
    middle = np.nanmedian(own, axis=0)
    found[some] = np.nanmedian(np.abs(own - middle).max(axis=2), axis=0)
    return found
