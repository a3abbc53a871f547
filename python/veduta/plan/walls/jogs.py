"""Where the line of a wall steps aside: two parallel walls that touch with their ends.

Outer walls become thicker or thinner, and hand-drawn ones miss each other. Their centre lines never
meet; a short piece of wall from one to the other lets them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.plan.walls.join import solid_share
from veduta.plan.walls.meetings import BESIDE, MEET_RAD
from veduta.plan.walls.pieces import Piece

COMMON = 0.2
"""The ends of both walls touch over this part of the thinner one's thickness, at least."""

APART = 0.5
"""One begins where the other ends, up to this part of the thicker one's thickness."""

SOLID = 0.85
"""From the middle of one end to that of the other it is solid for this part of the way."""

INWARD_PX = 2.0
THICK = 0.5
"""The piece is so thick, as a part of the thinner wall."""


def jogs(pieces: Sequence[Piece], solid: NDArray[np.bool_]) -> list[Piece]:
    """Short pieces across, one for each two straight walls that touch so; `solid` (h, w) is wall.

    Walls that lie in one line but for a little need none: `meetings` joins these.
    """
    mask = solid.astype(np.uint8)
    found = (_jog(pieces[one], pieces[other], mask) for one, other in _near(pieces))
    return [one for one in found if one is not None]


def _near(pieces: Sequence[Piece]) -> list[tuple[int, int]]:
    """Pairs of pieces, two ends of which are near enough to touch."""
    if not pieces:
        return []
    ends = np.array([end for piece in pieces for end in (piece.start, piece.end)])
    thickest = max(piece.thickness_px for piece in pieces)
    reach = float(np.hypot(APART * thickest + 2, thickest))
    close = cKDTree(ends).query_pairs(reach, output_type="ndarray") // 2
    return sorted({(int(a), int(b)) for a, b in np.sort(close, axis=1) if a != b})


def _jog(one: Piece, other: Piece, mask: NDArray[np.uint8]) -> Piece | None:
    way = one.direction
    if abs(float(way[0] * other.direction[1] - way[1] * other.direction[0])) > np.sin(MEET_RAD):
        return None
    thin, thick = sorted((one.thickness_px, other.thickness_px))
    normal = np.array([-way[1], way[0]])
    for mine, outward in ((one.start, -way), (one.end, way)):
        for its, inward in ((other.start, other.direction), (other.end, -other.direction)):
            away = its - mine
            if float(inward @ outward) < 0.0 or abs(float(away @ outward)) > APART * thick + 2:
                continue
            beside = float(away @ normal)
            if not BESIDE * thick < abs(beside) <= (thin + thick) / 2 - COMMON * thin:
                continue
            # Within the walls: their very ends may lie just beside each other.
            if solid_share(mask, mine - INWARD_PX * outward, its + INWARD_PX * inward) < SOLID:
                continue
            start = mine + float(away @ outward) / 2 * outward
            return Piece(start, start + beside * normal, THICK * thin, one.drawing)
    return None
