"""Walls that are drawn with an outline end in the middle of its line, whatever is inside.

A pen draws along the face of a wall: half of the line lies outdoors. Of walls that are filled with
the colour of their outline nothing shows that, and they end where the ink does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.profile import profile_across

STEP_PX = 0.25

LEAST_DEPTH = 0.22
"""An outline is darker than the wall's inside and than what lies beyond, by so much of full ink."""

MOST_WALLS = 0.5
"""The walls of a sheet are outlined if this part of their length shows it."""

LINES_WIDE = 3.0
"""A face is looked for within so many line widths of where the ink ends."""


@dataclass(frozen=True)
class _Insets:
    """How far within the ink's two edges the outline's middle lies, in pixels; None: not seen."""

    low: float | None
    high: float | None

    def known(self) -> list[float]:
        return [one for one in (self.low, self.high) if one is not None]


def without_half_outline(
    pieces: Sequence[Piece], ink: NDArray[np.float32], line_px: float
) -> list[Piece]:
    """The pieces, whose faces are where ink ends, with those that lie in the middle of outlines.

    `ink` (h, w) is 0 on paper to 1. Where an outline cannot be seen on a sheet that has them, as
    between two lines that run together, it is as wide as that of the others. On a sheet where
    less than half of the walls are outlined the pieces stay as they are.
    """
    seen = [_insets(one, ink, line_px) for one in pieces]
    length = np.array([one.length_px for one in pieces])
    shown = np.array([len(one.known()) / 2 for one in seen])
    if len(pieces) == 0 or float(shown @ length) < MOST_WALLS * float(length.sum()):
        return list(pieces)
    usual = float(np.median([value for one in seen for value in one.known()]))
    return [_inset(piece, one, usual) for piece, one in zip(pieces, seen, strict=True)]


def _inset(piece: Piece, seen: _Insets, usual: float) -> Piece:
    low = usual if seen.low is None else seen.low
    high = usual if seen.high is None else seen.high
    thickness = piece.thickness_px - low - high
    if thickness < 0.3 * piece.thickness_px:
        return piece
    normal = np.array([-piece.direction[1], piece.direction[0]])
    moved = (low - high) / 2 * normal
    return replace(piece, start=piece.start + moved, end=piece.end + moved, thickness_px=thickness)


def _insets(piece: Piece, ink: NDArray[np.float32], line_px: float) -> _Insets:
    """By the median over the length, so that what touches the wall here and there is nothing."""
    half = piece.thickness_px / 2
    across = np.arange(-half - 2.5, half + 2.5 + STEP_PX / 2, STEP_PX)
    profile = profile_across(piece, ink, across)
    inside = np.abs(across) < max(0.25 * half, half - LINES_WIDE * line_px)
    level = float(np.median(profile[inside]))
    return _Insets(
        _one_side(profile[::-1], across, half, level, line_px),
        _one_side(profile, across, half, level, line_px),
    )


def _one_side(
    profile: NDArray[np.float64],
    across: NDArray[np.float64],
    half: float,
    level: float,
    line_px: float,
) -> float | None:
    """How far within `half` the middle of the line at the upper end of a profile lies."""
    near = (across > max(0.0, half - LINES_WIDE * line_px)) & (across < half + 2.5)
    place, value = across[near], profile[near]
    peak = int(np.argmax(value))
    beyond = float(value[peak:].min())
    base = max(level, beyond)
    if value[peak] - base < LEAST_DEPTH:
        return None
    over = np.clip(value - (base + value[peak]) / 2, 0, None)
    first, last = peak, peak
    while first > 0 and over[first - 1] > 0:
        first -= 1
    while last + 1 < len(over) and over[last + 1] > 0:
        last += 1
    line = slice(first, last + 1)
    inset = half - float(np.average(place[line], weights=over[line]))
    return float(np.clip(inset, 0.0, 1.5 * line_px))
