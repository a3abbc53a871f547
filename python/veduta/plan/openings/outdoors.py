"""Which openings lead outdoors: what can be reached from the sheet's border."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.gaps import Gap
from veduta.plan.walls.pieces import FACET_RAD, Piece

SHRINK = 2
"""Flooding needs no finer grid."""


def leads_outdoors(
    gaps: Sequence[Gap], pieces: Sequence[Piece], closed: Sequence[Gap], shape: tuple[int, ...]
) -> list[bool]:
    """For each gap, whether one of its sides is outdoors once the `closed` gaps are walls."""
    outside = outdoors(pieces, closed, shape)
    found = []
    for gap in gaps:
        away = gap.thickness_px * 0.5 + 6
        beside = gap.arc.at(gap.width_px / 2, np.array([away, -away]))
        found.append(any(_at(outside, point) for point in beside))
    return found


def outdoors(
    pieces: Sequence[Piece], closed: Sequence[Gap], shape: tuple[int, ...]
) -> NDArray[np.bool_]:
    """The mask, reduced by SHRINK, of what is reached from the border."""
    height, width = shape[0] // SHRINK + 3, shape[1] // SHRINK + 3
    walls = np.zeros((height, width), np.uint8)
    strokes: list[Piece | Gap] = [*pieces, *closed]
    for one in (facet for stroke in strokes for facet in _facets(stroke)):
        run = (one.end - one.start) / max(float(np.hypot(*(one.end - one.start))), 1e-9)
        more = 0.6 * one.thickness_px * run
        start, end = (one.start - more) / SHRINK + 1, (one.end + more) / SHRINK + 1
        thick = max(1, round(one.thickness_px / SHRINK))
        cv2.line(walls, _int(start), _int(end), 255, thick)
    flood = cv2.copyMakeBorder(walls, 1, 1, 1, 1, cv2.BORDER_CONSTANT, value=0)
    cv2.floodFill(flood, None, (0, 0), 128)
    return np.asarray(flood[1:-1, 1:-1] == 128, dtype=np.bool_)


def _facets(stroke: Piece | Gap) -> list[Piece]:
    return Piece(stroke.start, stroke.end, stroke.thickness_px, bulge=stroke.bulge).facets(
        FACET_RAD
    )


def _at(mask: NDArray[np.bool_], point: NDArray[np.float64]) -> bool:
    x, y = np.round(point / SHRINK + 1).astype(int)
    inside = 0 <= y < mask.shape[0] and 0 <= x < mask.shape[1]
    return bool(mask[y, x]) if inside else True


def _int(point: NDArray[np.float64]) -> tuple[int, int]:
    return round(float(point[0])), round(float(point[1]))
