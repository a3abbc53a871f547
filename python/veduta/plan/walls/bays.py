"""Bays that are mostly window: three straight sides before a broken wall.

As with bows, what is solid of a bay are corners that are too short to be followed. So the sides are
looked for from one end of a broken wall to the other, along which wall or both faces of a window
are drawn all the way: square, or slanted alike at both ends. The trapezium whose faces are nearest
to ink is taken (chamfer matching, Barrow et al. 1977).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import Arc
from veduta.plan.walls.bows import (
    BESIDE_FACES,
    CAP_PX,
    COVERED,
    NEAR_PX,
    STRAIGHT,
    Broken,
    Nearness,
    broken_walls,
    covered,
    filled_along,
    look,
    nearness,
    spans,
    with_bows,
)
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece

SLIDES = np.linspace(-0.6, 0.9, 4)
"""Sides begin so many thicknesses inward from the end of the wall: at its end or at its corner."""

DEPTHS = np.arange(2.0, 24.0, 0.5)
"""Bays come so many thicknesses before the wall."""

INSETS = np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0, 1.2, 1.4])
"""Their sides slant inward by so much of that: from square to a slant of 54 degrees."""

DEEPEST = 0.6
"""They come no farther before the wall than this part of their width."""

FRONT = 3.0
"""The side before the wall is so many thicknesses long."""

PLACES = 12
"""On each side, so many places are looked at."""

FARTHEST_PX = 2.6
"""The nearest trapezium of many is not so far from ink on the average."""

CHOSEN = 6
"""So many of all trapezia are looked at closely."""

MOST_SOLID = 0.7
"""Bays of which more is solid have walls that are followed."""

STRAY = 0.35
"""At most so much of what lies beside the sides is ink: not among furniture or hatching."""

END = 0.5
"""So many thicknesses of a side are wall at its ends."""

Line = NDArray[np.float64]
_TURNS = np.array([[1.0, 0, 0, -1, 0], [0, 1, 0, 0, -1], [0, 0, 1, 1, 1]])
_MOVES = np.concatenate([np.eye(5), -np.eye(5), _TURNS, -_TURNS])
"""Each alone, and where only the foot of a slanted side moves, or all of a bay goes farther out."""


def with_bends(found: Found, faint: NDArray[np.bool_]) -> Found:
    """The walls with what is solid of bows, and then of bays; `faint` (h, w) are the thin lines."""
    ink = nearness(found, faint)
    broken = [*broken_walls(found)]
    bowed = with_bows(found, ink, broken)
    # Where there are no bows the same walls are broken as before.
    return with_bays(bowed, ink, broken if bowed is found else [*broken_walls(bowed)])


def with_bays(found: Found, ink: Nearness, broken: Sequence[Broken]) -> Found:
    """The walls with what is solid of bays before those that are broken."""
    bays: list[Line] = []
    for one in broken:
        if any(spans(one, Piece(bay[0], bay[-1], one.thickness_px)) for bay in bays):
            continue
        bay = _bay(one, ink)
        if bay is None:
            continue
        bays.append(bay)
        sides = [Piece(start, end, one.thickness_px, one.drawing) for start, end in pairwise(bay)]
        kept = [piece for piece in found.pieces if not any(_lies_in(piece, x) for x in sides)]
        stubs = [stub for side in sides for stub in _stubs(side, ink)]
        found = replace(found, pieces=[*kept, *stubs])
    return found


def _bay(one: Broken, ink: Nearness) -> Line | None:
    """The four corners (4, 2) of the sides that are drawn before a broken wall; None without."""
    if covered(Arc(one.first, one.second), one.thickness_px, ink) > STRAIGHT:
        return None
    size = float((one.second - one.first) @ one.way)
    params = _params(size, one.thickness_px)
    if len(params) == 0:
        return None
    cost = _cost(params, one, size, ink, PLACES)
    order = np.argsort(cost)[:CHOSEN]
    near = [_refined(params[place], one, size, ink) for place in order if cost[place] < FARTHEST_PX]
    if not near:
        return None
    corners = _corners(np.stack(near), one, size)
    best = int(np.argmin(_away(corners, one.thickness_px, ink, 3 * PLACES).mean(axis=(1, 2))))
    return corners[best] if _is_drawn(corners[best], one.thickness_px, ink) else None


def _params(size: float, thick: float) -> Line:
    """(n, 5) in pixels: slide of the first and of the last side, depth, inset of both."""
    slide, depth, inset = np.meshgrid(
        SLIDES * thick, DEPTHS[DEPTHS * thick <= DEEPEST * size] * thick, INSETS, indexing="ij"
    )
    beside, far = slide.ravel(), (inset * depth).ravel()
    front = size - 2 * (beside + far)
    found = np.column_stack([beside, beside, depth.ravel(), far, far])
    return np.asarray(found[front >= FRONT * thick])


def _corners(params: Line, one: Broken, size: float) -> Line:
    """(n, 4, 2) corners in pixels."""
    first, last, depth, inset, other = params.T
    zero = np.zeros_like(first)
    along = np.stack([first, first + inset, size - last - other, size - last], axis=1)
    before = np.stack([zero, depth, depth, zero], axis=1)
    out = one.side * np.array([-one.way[1], one.way[0]])
    return np.asarray(one.first + along[..., None] * one.way + before[..., None] * out)


def _cost(params: Line, one: Broken, size: float, ink: Nearness, count: int) -> Line:
    """(n,) how far ink is on the average from where the sides have it."""
    corners = _corners(params, one, size)
    return np.asarray(_away(corners, one.thickness_px, ink, count).mean(axis=(1, 2)))


def _away(corners: Line, thick: float, ink: Nearness, count: int) -> Line:
    """(n, 3, count) distances from ink along each side: on the farther face, as windows have it."""
    run = np.diff(corners, axis=1)
    length = np.maximum(np.hypot(run[..., 0], run[..., 1]), 1e-9)[..., None]
    right = np.stack([-run[..., 1], run[..., 0]], axis=-1) / length
    shares = ((np.arange(count) + 0.5) / count)[:, None]
    middle = corners[:, :-1, None] + shares * run[:, :, None]
    faces = [
        look(ink.away, middle + half * right[:, :, None], CAP_PX)
        for half in (-thick / 2 + 0.5, thick / 2 - 0.5)
    ]
    return np.asarray(np.maximum(*faces), np.float64)


def _refined(params: Line, one: Broken, size: float, ink: Nearness) -> Line:
    """The trapezium nearby with the least cost: a search by steps that are halved."""
    best = float(_cost(params[None], one, size, ink, 3 * PLACES)[0])
    step = 0.4 * one.thickness_px
    while step > 0.2:
        tried = params + step * _MOVES
        tried[:, 2] = np.maximum(tried[:, 2], DEPTHS[0] * one.thickness_px)
        tried[:, 3:] = np.maximum(tried[:, 3:], 0.0)
        cost = _cost(tried, one, size, ink, 3 * PLACES)
        if float(cost.min()) < best:
            best, params = float(cost.min()), tried[int(np.argmin(cost))]
        else:
            step /= 2
    return params


def _is_drawn(bay: Line, thick: float, ink: Nearness) -> bool:
    """Whether each side is drawn on both faces nearly all along, with paper beside it."""
    near = _away(bay[None], thick, ink, 60)[0] <= NEAR_PX
    if float(near.mean(axis=1).min()) < COVERED:
        return False
    solid, stray = [], []
    for start, end in pairwise(bay):
        side = Arc(start, end)
        along = np.arange(0.5, side.length_px, 1.0)
        solid.append(look(ink.solid, side.at(along), 0.0))
        middle = along[np.abs(along / side.length_px - 0.5) < 0.3]
        beside = np.concatenate([-BESIDE_FACES, BESIDE_FACES]) * thick / 2
        stray.append(look(ink.drawn, side.at(middle[:, None], beside[None, :]), 0.0).ravel())
    return bool(
        np.concatenate(solid).mean() <= MOST_SOLID and np.concatenate(stray).mean() <= STRAY
    )


def _stubs(side: Piece, ink: Nearness) -> list[Piece]:
    """What is solid of a side, from its ends on: all of it, or two pieces with a window between."""
    filled = filled_along(side, ink.solid)
    reach = max(1, int(END * side.thickness_px))
    filled[:reach] = filled[len(filled) - reach :] = True
    free = np.flatnonzero(~filled)
    if len(free) == 0:
        return [side]
    return [side.part(0.0, float(free[0])), side.part(float(free[-1]) + 1.0, side.length_px)]


def _lies_in(piece: Piece, side: Piece) -> bool:
    """Whether a short piece of wall is a part of a side."""
    along, across = side.arc.place(np.stack([piece.start, piece.end]))
    half = side.thickness_px / 2
    inside = along.min() >= -half and along.max() <= side.length_px + half
    return bool(inside and np.abs(across).max() <= half)
