"""Door leaves that were taken for walls: slabs of the thickness of thin walls."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.classify import Judged
from veduta.plan.openings.evidence import LEAST_ARC
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaves import Arc
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.pieces import Piece

BESIDE = 0.12
"""A leaf's piece of wall lies beside the leaf by at most this part of the leaf's length."""

LONGER = 1.2
"""And is at most so many times as long."""

SHORTER = 0.35
"""Nor shorter than this part: the rest is too thin to be seen as wall."""

SLANTED = 0.96
"""The larger part of a slanted direction: more than 16 degrees from upright."""

SLIM = 0.8
"""Leaves, and lines of furniture, are thinner than this part of thin walls."""

SQUARE = 0.1
"""The cosine up to which a leaf stands square to its door."""

LIKE = 0.2
"""By this part of its door's width a leaf may be longer or shorter."""

MOSTLY_OPEN = 0.6
"""Of a line that is open for this part of its length, and thin, nothing shows that it is a wall."""

WEAK = 0.6
"""A door with a lower score may be none."""

HANGS = 1.5
"""So near to a wall, in (thin) wall thicknesses, an end hangs on it."""


def leaf_pieces(pieces: Sequence[Piece], judged: Sequence[Judged]) -> set[int]:
    """Indices of pieces of wall that are leaves of doors.

    An arc that is drawn well says where its leaf stands. What stands there, no longer than the
    leaf and no thicker than a wall, is the leaf.
    """
    leaves = [arc for one in judged if one.kind == "door" for arc in _leaves(one)]
    return {
        index for index, piece in enumerate(pieces) if any(_is_leaf(piece, arc) for arc in leaves)
    }


def free_leaves(pieces: Sequence[Piece], thin_px: float, door_px: float) -> set[int]:
    """Indices of slanted pieces that hang on a wall by one end alone, as long as a door is wide.

    Leaves that are drawn without an arc: as walls they would end in a room. Where a leaf begins
    thinner than walls are, its end points at that of the wall that it hangs on.
    """
    ends = np.array([[one.start, one.end] for one in pieces])
    found = set()
    for index, piece in enumerate(pieces):
        slanted = float(np.abs(piece.direction).max()) < SLANTED
        sized = SHORTER * door_px <= piece.length_px <= LONGER * door_px
        if not (slanted and sized) or piece.bulge:
            continue
        others = [one for place, one in enumerate(pieces) if place != index]
        touching = [
            any(_away(end, one) <= HANGS * thin_px + one.thickness_px / 2 for one in others)
            for end in ends[index]
        ]
        rest_px = LONGER * door_px - piece.length_px
        if touching.count(True) == 1 or (
            not any(touching) and _points_at_an_end(piece, others, rest_px, HANGS * thin_px)
        ):
            found.add(index)
    return found


def hung_leaves(pieces: Sequence[Piece], judged: Sequence[Judged], thin_px: float) -> set[int]:
    """Indices of pieces that stand square to a way through at its jamb, as long as it is wide.

    Leaves whose traces are lost among what else is drawn there. They are thinner than walls, and
    end before the next one.
    """
    ways = [one.gap for one in judged if _is_doubtful(one)]
    found = set()
    for index, piece in enumerate(pieces):
        if piece.bulge or piece.thickness_px > SLIM * thin_px:
            continue
        others = [one for place, one in enumerate(pieces) if place != index]
        for near, far in ((piece.start, piece.end), (piece.end, piece.start)):
            free = all(_away(far, one) > one.thickness_px / 2 + thin_px for one in others)
            if free and any(_hangs_in(near, far, gap, thin_px) for gap in ways):
                found.add(index)
    return found


def slim_panels(pieces: Sequence[Piece], thin_px: float, door_px: float) -> set[int]:
    """Indices of pieces that go on from the end of a wall in its line, and are much thinner.

    One of two panels that slide past each other looks so: the other is thinner still.
    """
    walls = [one for one in pieces if one.thickness_px >= SLIM * thin_px and not one.bulge]
    found = set()
    for index, piece in enumerate(pieces):
        sized = SHORTER * door_px <= piece.length_px <= LONGER * door_px
        if piece.bulge or not sized or piece.thickness_px > SLIM * thin_px:
            continue
        if any(_goes_on_from(end, piece, wall) for wall in walls for end in (wall.start, wall.end)):
            found.add(index)
    return found


def _goes_on_from(end: NDArray[np.float64], piece: Piece, wall: Piece) -> bool:
    """Whether a piece begins at this end of a wall and lies within the wall's faces, ahead."""
    near = min(float(np.hypot(*(one - end))) for one in (piece.start, piece.end))
    if near > HANGS * wall.thickness_px:
        return False
    way = wall.direction
    beside = [abs(float((one - end) @ np.array([-way[1], way[0]]))) for one in
              (piece.start, piece.end)]  # fmt: skip
    middle = (piece.start + piece.end) / 2.0 - (wall.start + wall.end) / 2.0
    ahead = abs(float(middle @ way)) > wall.length_px / 2.0
    return ahead and max(beside) <= wall.thickness_px / 2.0


def slid(gone: Sequence[Piece], judged: Sequence[Judged]) -> list[bool]:
    """Of pieces that were taken out: whether a door of panels was found where each stood."""
    doors = [one.gap for one in judged if one.kind == "door" and one.type == "sliding"]
    return [any(_within(piece, gap) for gap in doors) for piece in gone]


def _within(piece: Piece, gap: Gap) -> bool:
    run = gap.end - gap.start
    size = float(np.hypot(*run))
    away = (piece.start + piece.end) / 2.0 - gap.start
    along = float(away @ run) / max(size, 1e-9)
    beside = abs(float(away[0] * run[1] - away[1] * run[0])) / max(size, 1e-9)
    return 0.0 < along < size and beside <= gap.thickness_px


def _is_doubtful(one: Judged) -> bool:
    """A way through whose kind of leaf nothing tells."""
    return one.kind != "window" and one.type in ("plain", "unknown")


def _hangs_in(
    near: NDArray[np.float64], far: NDArray[np.float64], gap: Gap, thin_px: float
) -> bool:
    run = gap.end - gap.start
    width = float(np.hypot(*run))
    leaf = far - near
    size = float(np.hypot(*leaf))
    square = abs(float(run @ leaf)) <= SQUARE * width * size
    at_jamb = min(float(np.hypot(*(near - jamb))) for jamb in (gap.start, gap.end))
    return square and abs(size - width) <= LIKE * width and at_jamb <= HANGS * thin_px


def unproven(axes: Sequence[Axis], thin_px: float) -> list[Axis]:
    """The axes without those that are no walls but lines of furniture, or tips of leaves.

    They are thinner than walls, and for most of their length they are ways through without leaves,
    or with such as can hardly be seen: what is left stood in one line with something by chance.
    """
    return [one for one in axes if not _by_chance(one, thin_px)]


def _by_chance(axis: Axis, thin_px: float) -> bool:
    line = axis.line
    if not axis.openings or line.bulge or line.thickness_px > SLIM * thin_px:
        return False
    judged = [one.judged for one in axis.openings]
    if not all(_is_doubtful(one) or one.score < WEAK for one in judged):
        return False
    open_px = sum(one.last - one.first for one in axis.openings)
    return open_px >= MOSTLY_OPEN * line.length_px


def _points_at_an_end(
    piece: Piece, others: Sequence[Piece], rest_px: float, near_px: float
) -> bool:
    """Whether an end of a wall lies ahead of one end of a piece, and none ahead of the other."""
    spots = np.array([spot for one in others for spot in (one.start, one.end)])
    if len(spots) == 0:
        return False
    ahead = []
    for end, way in ((piece.start, -piece.direction), (piece.end, piece.direction)):
        along = (spots - end) @ way
        beside = np.abs((spots - end) @ np.array([-way[1], way[0]]))
        ahead.append(bool(((along > 0.0) & (along <= rest_px) & (beside <= near_px)).any()))
    return ahead.count(True) == 1


def _away(point: NDArray[np.float64], piece: Piece) -> float:
    """How far a point is from the centre line of a piece."""
    run = piece.end - piece.start
    share = float(np.clip((point - piece.start) @ run / max(float(run @ run), 1e-9), 0.0, 1.0))
    return float(np.hypot(*(point - piece.start - share * run)))


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
