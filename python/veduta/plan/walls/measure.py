"""Where the faces of a wall are, to a part of a pixel: half-way crossings of its mean profile."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.profile import profile_across

STEP_PX = 0.25
MOST_MOVED = 0.3
"""A face is looked for within this part of the thickness (and two pixels) of where it was."""


def measured(piece: Piece, soft: NDArray[np.float32]) -> Piece:
    """The piece with its centre line and thickness by the (h, w) ink, 0 to 1, of solid walls.

    The profile across the wall is the median of many along it, so that what touches the wall in
    some places does not count. Unchanged where no face is found.
    """
    half, reach = piece.thickness_px / 2, MOST_MOVED * piece.thickness_px + 2
    across = np.arange(-half - reach, half + reach + STEP_PX / 2, STEP_PX)
    profile = profile_across(piece, soft, across)
    inside = float(np.median(profile[np.abs(across) < 0.5 * half]))
    low = _face(profile[::-1], -across[::-1], inside, half, reach)
    high = _face(profile, across, inside, half, reach)
    if low is None or high is None or low + high < 0.5 * piece.thickness_px:
        return piece
    ends = piece.arc.at(np.array([0.0, piece.length_px]), (high - low) / 2)
    return replace(piece, start=ends[0], end=ends[1], thickness_px=high + low)


def _face(
    profile: NDArray[np.float64],
    across: NDArray[np.float64],
    inside: float,
    half: float,
    reach: float,
) -> float | None:
    """How far out the profile falls to half-way between inside and the least beyond it."""
    beyond = across >= half - reach
    places, values = across[beyond], profile[beyond]
    outside = float(values[places > half].min())
    if inside - outside < 0.2:
        return None
    level = (inside + outside) / 2
    below = np.flatnonzero(values < level)
    if len(below) == 0 or below[0] == 0:
        return None
    last = below[0] - 1
    share = (values[last] - level) / max(values[last] - values[last + 1], 1e-9)
    return float(places[last] + share * STEP_PX)
