"""Pieces of one wall joined: set upright, and collinear ones with solid ink between made one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from veduta.plan.walls.pieces import Piece

UPRIGHT_RAD = np.radians(2.5)
"""Pieces this close to an axis lie along it: drawings are upright more often than not."""

SAME_DIRECTION_RAD = np.radians(4.0)

SAME_LINE = 0.3
"""Centre lines of one wall are apart by at most this part of its thickness."""

SAME_THICKNESS = 1.45
"""Thicknesses of one wall differ by at most this factor."""


def joined(pieces: list[Piece], solid: NDArray[np.bool_]) -> list[Piece]:
    """Upright, collinear pieces joined where the mask is solid between them; long ones first."""
    waiting = sorted((_upright(one) for one in pieces), key=lambda one: -one.length_px)
    done: list[Piece] = []
    while waiting:
        whole = waiting.pop(0)
        growing = True
        while growing:
            growing = False
            for index, other in enumerate(waiting):
                if _one_wall(whole, other, solid):
                    whole = merged(whole, waiting.pop(index))
                    growing = True
                    break
        done.append(whole)
    return [one for one in done if not _inside_another(one, done)]


def merged(first: Piece, second: Piece) -> Piece:
    """One piece over both, on the longer one's direction, at the mean of their centre lines."""
    longer = first if first.length_px >= second.length_px else second
    direction = longer.direction
    normal = np.array([-direction[1], direction[0]])
    weight = np.array([first.length_px, second.length_px])
    middles = np.array([(one.start + one.end) / 2 for one in (first, second)])
    if abs(direction).max() > 1 - 1e-9:
        offset = float(np.average(middles @ normal, weights=weight))
    else:
        offset = float((longer.start + longer.end) @ normal / 2)
    along = np.array([first.start, first.end, second.start, second.end]) @ direction
    thickness = float(np.average([first.thickness_px, second.thickness_px], weights=weight))
    return replace(
        longer,
        start=direction * along.min() + normal * offset,
        end=direction * along.max() + normal * offset,
        thickness_px=thickness,
    )


def angle_between(first: Piece, second: Piece) -> float:
    """Of their lines, 0 to a quarter turn."""
    cross = float(np.cross(first.direction, second.direction))
    return float(np.arcsin(min(1.0, abs(cross))))


def offset_between(first: Piece, second: Piece) -> float:
    """How far the middle of the shorter lies beside the line of the longer."""
    longer, shorter = (first, second) if first.length_px >= second.length_px else (second, first)
    apart = (shorter.start + shorter.end) / 2 - longer.start
    return float(abs(np.cross(longer.direction, apart)))


def gap_between(first: Piece, second: Piece) -> float:
    """Along the first one's direction, from end to end; negative where they overlap."""
    base = first.start
    one = np.sort([0.0, first.length_px])
    two = np.sort(np.array([second.start - base, second.end - base]) @ first.direction)
    return float(max(two[0] - one[1], one[0] - two[1]))


def solid_share(
    solid: NDArray[np.bool_], start: NDArray[np.float64], end: NDArray[np.float64]
) -> float:
    """The part of a line that lies on the mask."""
    count = max(2, int(np.hypot(*(end - start))) + 1)
    points = np.linspace(start, end, count) - 0.5
    values = map_coordinates(solid.astype(np.uint8), points.T[::-1], order=0, mode="constant")
    return float(values.mean())


def _upright(piece: Piece) -> Piece:
    run = piece.end - piece.start
    for axis in (0, 1):
        other = 1 - axis
        if abs(run[other]) <= np.tan(UPRIGHT_RAD) * abs(run[axis]) + 1e-9:
            middle = (piece.start[other] + piece.end[other]) / 2
            start, end = piece.start.copy(), piece.end.copy()
            start[other] = end[other] = middle
            if start[axis] > end[axis]:
                start, end = end, start
            return replace(piece, start=start, end=end)
    return piece


def _one_wall(whole: Piece, other: Piece, solid: NDArray[np.bool_]) -> bool:
    thick = max(whole.thickness_px, other.thickness_px)
    thin = min(whole.thickness_px, other.thickness_px)
    gap = gap_between(whole, other)
    if gap > 60 * thick or thick > SAME_THICKNESS * thin + 2:
        return False
    if offset_between(whole, other) > max(1.5, SAME_LINE * thin):
        return False
    # The direction of a stub says little.
    allowed = SAME_DIRECTION_RAD if other.length_px > 3 * thick else 3 * SAME_DIRECTION_RAD
    if angle_between(whole, other) > allowed:
        return False
    if gap <= 2:
        return True
    ends = np.array([other.start, other.end])
    mine = np.array([whole.start, whole.end])
    distance = np.linalg.norm(ends[:, None] - mine[None], axis=2)
    which, whose = np.unravel_index(int(np.argmin(distance)), (2, 2))
    return solid_share(solid, ends[which], mine[whose]) > 0.93


def _inside_another(piece: Piece, pieces: list[Piece]) -> bool:
    """Whether a shorter piece lies within the body of a longer one."""
    for other in pieces:
        if other is piece or other.length_px <= piece.length_px:
            continue
        normal = np.array([-other.direction[1], other.direction[0]])
        ends = np.array([piece.start, piece.end]) - other.start
        beside, along = np.abs(ends @ normal), ends @ other.direction
        half = other.thickness_px / 2
        if (beside <= half + 1).all() and along.min() >= -half and along.max() <= (
            other.length_px + half
        ):
            return True
    return False
