"""Door leaves that were taken for walls: slabs of the thickness of thin walls."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.plan.openings.classify import Judged
from veduta.plan.openings.evidence import LEAST_ARC
from veduta.plan.openings.leaves import Arc
from veduta.plan.walls.pieces import Piece

BESIDE = 0.12
"""A leaf's piece of wall lies beside the leaf by at most this part of the leaf's length."""

LONGER = 1.2
"""And is at most so many times as long."""

SHORTER = 0.35
"""Nor shorter than this part: the rest is too thin to be seen as wall."""


def leaf_pieces(pieces: Sequence[Piece], judged: Sequence[Judged]) -> set[int]:
    """Indices of pieces of wall that are leaves of doors.

    An arc that is drawn well says where its leaf stands. What stands there, no longer than the
    leaf and no thicker than a wall, is the leaf.
    """
    leaves = [arc for one in judged if one.kind == "door" for arc in _leaves(one)]
    return {
        index for index, piece in enumerate(pieces) if any(_is_leaf(piece, arc) for arc in leaves)
    }


def _leaves(judged: Judged) -> list[Arc]:
    """The arcs by which a door was judged."""
    if judged.seen is None or judged.type not in ("swing", "double", "french"):
        return []
    share = 1.0 if judged.type == "swing" else 0.5
    good = [arc for arc in judged.seen.arcs if arc.radius_share == share and arc.score >= LEAST_ARC]
    return good[:1] if share == 1.0 else good[:2]


def _is_leaf(piece: Piece, arc: Arc) -> bool:
    run = arc.tip - arc.hinge
    size = float(np.hypot(*run))
    way = run / max(size, 1e-9)
    ends = np.array([piece.start, piece.end]) - arc.hinge
    along = ends @ way
    beside = np.abs(ends[:, 0] * way[1] - ends[:, 1] * way[0])
    if beside.max() > BESIDE * size + piece.thickness_px / 2:
        return False
    slack = 0.5 * piece.thickness_px + 0.1 * size
    inside = along.min() >= -slack - piece.thickness_px and along.max() <= size + slack
    return bool(inside and SHORTER * size <= piece.length_px <= LONGER * size)
