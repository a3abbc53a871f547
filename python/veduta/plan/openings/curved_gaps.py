"""Where curved walls are interrupted: on their circle, on to the next wall."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.geometry.arcs import Arc
from veduta.plan.openings.gaps import CROSSING_RAD, FARTHEST, LEAST_PX, Gap
from veduta.plan.walls.curved import same_circle
from veduta.plan.walls.meetings import end_to_end
from veduta.plan.walls.pieces import Piece

WHOLE_RAD = np.radians(330.0)
"""A wall goes no farther round than this."""

SAME_CIRCLE = 0.3
"""Centre lines of one curved wall are apart by at most this part of its thickness."""


def gaps_on_circles(pieces: Sequence[Piece], curved: Sequence[Piece]) -> list[Gap]:
    """The nearest wall ahead of each end of each curved piece, where it is not touching already.

    Pieces are told by their indices in `pieces` and then `curved`.
    """
    found: dict[tuple[object, ...], Gap] = {}
    for number in range(len(curved)):
        for at_end in (False, True):
            gap = _ahead(number, at_end, pieces, curved)
            if gap is None:
                continue
            if gap.to_side:
                found[(gap.piece, at_end)] = gap
            else:
                found.setdefault(tuple(sorted((gap.piece, gap.target))), gap)
    return list(found.values())


def _ahead(
    number: int, at_end: bool, pieces: Sequence[Piece], curved: Sequence[Piece]
) -> Gap | None:
    piece = curved[number]
    if _goes_on(piece, at_end, pieces):
        return None
    arc = piece.arc if at_end else Arc(piece.end, piece.start, -piece.bulge)
    reach = min(FARTHEST * piece.thickness_px, WHOLE_RAD * arc.radius_px - arc.length_px)
    best: tuple[float, int, bool] | None = None
    targets = [*pieces, *curved]
    for index, other in enumerate(targets):
        if index == len(pieces) + number:
            continue
        distance, to_side = _distance(arc, piece, other)
        near = -max(3.0, 0.3 * piece.thickness_px, other.thickness_px)
        if distance is not None and near < distance and (best is None or distance < best[0]):
            best = (distance, index, to_side)
    if best is None:
        return None
    distance, target, to_side = best
    if not max(LEAST_PX, 0.3 * piece.thickness_px) < distance <= reach:
        return None
    low, high = arc.length_px, arc.length_px + distance
    start, end = arc.at(np.array([low, high]))
    return Gap(
        len(pieces) + number, at_end, target, to_side, start, end, piece.thickness_px, end,
        arc.bulge_of(low, high),
    )  # fmt: skip


def _goes_on(piece: Piece, at_end: bool, pieces: Sequence[Piece]) -> bool:
    """Whether a straight wall goes on from this end: its line touches the circle there at most."""
    place = piece.length_px if at_end else 0.0
    return any(one.first == place for other in pieces for one in end_to_end(piece, other))


def _distance(arc: Arc, piece: Piece, other: Piece) -> tuple[float | None, bool]:
    """How far ahead of the arc's end another wall begins, and whether that is its side."""
    near = max(3.0, SAME_CIRCLE * piece.thickness_px)
    if other.bulge and same_circle(arc, other.arc, near):
        along = arc.place(np.stack([other.start, other.end]))[0]
        around = 2 * np.pi * arc.radius_px
        ahead = (along - arc.length_px + near) % around - near
        return float(ahead.min()), False
    crossings = [
        one
        for facet in other.facets(np.radians(2.0))
        for one in _crossings(arc, facet, slack=other.thickness_px)
    ]
    half = [(along, other.thickness_px / 2 / sine) for along, sine in crossings]
    faces = [along - arc.length_px - thick for along, thick in half]
    faces = [one for one in faces if one >= -other.thickness_px - 3]
    return (min(faces), True) if faces else (None, True)


def _crossings(arc: Arc, other: Piece, slack: float) -> list[tuple[float, float]]:
    """Where a straight piece crosses an arc's circle: how far along the arc, and at which sine."""
    way = other.direction
    out = other.start - arc.centre
    half, rest = float(out @ way), float(out @ out) - arc.radius_px**2
    if half**2 <= rest:
        return []
    root = float(np.sqrt(half**2 - rest))
    found = []
    for distance in (-half - root, -half + root):
        if -slack <= distance <= other.length_px + slack:
            point = other.start + distance * way
            along = float(arc.place(point)[0]) % (2 * np.pi * arc.radius_px)
            on = arc.way(along)
            sine = abs(float(on[0] * way[1] - on[1] * way[0]))
            if sine >= np.sin(CROSSING_RAD):
                found.append((along, sine))
    return found
