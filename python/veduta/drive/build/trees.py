"""Segments that are mostly trees, which are left as they were scanned (section 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Background, Source
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.layers import Layers


@dataclass(frozen=True)
class TreeParameters:
    """Thresholds of the recognition.

    over_m: only what is higher over the road counts: cars and hedges stand before facades, too.
    turn_m: a step of less between two beams is noise (3 sigma of a scanner with 3.5 cm).
    most: share of direction changes above which a segment is trees; walls with balconies stay below
    a tenth, crowns exceed a third. fewest: steps that must be there to tell. joined: beams or
    columns between two that met the same thing, whose depths differ by less than alike_m 10 m away.
    """

    over_m: float = 2.2
    turn_m: float = 0.12
    most: float = 0.3
    fewest: int = 300
    joined: int = 5
    alike_m: float = 0.3


def direction_changes(
    first: NDArray[np.float32], frame: ColumnFrame, parameters: TreeParameters | None = None
) -> float:
    """Share of steps in columns and rows of a depth image (r, c) that turn back (fractal surfaces).

    NaN where there are too few steps to tell.
    """
    chosen = parameters or TreeParameters()
    height = frame.vertices(first)[..., 2] - frame.road_m
    with np.errstate(invalid="ignore"):
        depth = np.where(height > chosen.over_m, first, np.nan).astype(np.float64)
    changes, steps = 0, 0
    for axis in (0, 1):
        step = np.diff(depth, axis=axis)
        one = step[:-1] if axis == 0 else step[:, :-1]
        two = step[1:] if axis == 0 else step[:, 1:]
        known = np.isfinite(one) & np.isfinite(two)
        with np.errstate(invalid="ignore"):
            back = (np.minimum(np.abs(one), np.abs(two)) > chosen.turn_m) & (one * two < 0.0)
        changes += int((back & known).sum())
        steps += int(known.sum())
    return changes / steps if steps >= chosen.fewest else float("nan")


def as_scanned(
    layers: Layers, main: NDArray[np.float64], parameters: TreeParameters | None = None
) -> Background:
    """The nearest points as they are: nothing is taken out, nothing filled.

    Beams between two of the scanner's that met the same thing are joined, and told as filled: scans
    are coarser than the depth image.
    """
    chosen = parameters or TreeParameters()
    depth = _between_beams(_between_beams(layers.first, 0, chosen), 1, chosen)
    known = np.isfinite(depth)
    source = np.where(known, Source.FILLED, Source.NOTHING).astype(np.uint8)
    source[np.isfinite(layers.first)] = Source.MEASURED
    ground = np.isfinite(layers.background) & ~layers.wall
    ground &= np.abs(depth - layers.background) < chosen.alike_m
    foot = np.argmax(known & ~ground, axis=0)
    return Background(depth, source, known & ~ground, main, foot)


def _between_beams(
    depth: NDArray[np.float32], axis: int, chosen: TreeParameters
) -> NDArray[np.float32]:
    """Short gaps along columns (0) or rows (1) whose ends are alike, by straight lines."""
    lines = np.moveaxis(depth, axis, 1)
    known = np.isfinite(lines)
    place = np.broadcast_to(np.arange(lines.shape[1]), lines.shape)
    before = np.maximum.accumulate(np.where(known, place, -1), axis=1)
    after = np.where(known, place, lines.shape[1])[:, ::-1]
    after = np.minimum.accumulate(after, axis=1)[:, ::-1]
    inside = (before >= 0) & (after < lines.shape[1]) & ~known
    inside &= after - before <= chosen.joined + 1
    low, high = np.maximum(before, 0), np.minimum(after, lines.shape[1] - 1)
    one, two = np.take_along_axis(lines, low, axis=1), np.take_along_axis(lines, high, axis=1)
    share = (place - before) / np.maximum(after - before, 1)
    with np.errstate(invalid="ignore"):
        inside &= np.abs(one - two) < chosen.alike_m * (1.0 + np.nan_to_num(one) / 10.0)
    joined = np.where(inside, one + share * (two - one), lines)
    return np.ascontiguousarray(np.moveaxis(joined, 1, axis).astype(np.float32))
