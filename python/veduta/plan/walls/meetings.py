"""Where the centre lines of two walls cross, touch, or end at each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree, box
from shapely.geometry import LineString, MultiPoint, Point

from veduta.geometry.arcs import Arc
from veduta.plan.walls.pieces import Piece

MEET_RAD = np.radians(12)
REACH = 0.45
"""A wall ends at another one if so many of its thicknesses are missing, or less."""

BESIDE = 0.6
"""Walls in one line lie beside each other by at most this part of the thicker one's thickness."""

OVERLAP, OVERLAP_CURVED = 0.5, 1.5
"""Ends that touch overlap by so many thicknesses; where an arc begins is not seen sharply."""

FINE_RAD = np.radians(1.0)
TANGENT_RAD = np.radians(25.0)
"""Walls that go on into each other differ by less than this in direction where they touch."""


class Meeting(NamedTuple):
    """A point (2,) that two walls share, and how far along each it is."""

    point: NDArray[np.float64]
    first: float
    second: float


def pairs_in_reach(pieces: Sequence[Piece]) -> list[tuple[int, int]]:
    """Rows of all pairs of walls that may meet, the first before the second, in order.

    What meets a straight wall lies no farther from it than the flattest angle lets it reach. Of
    curved walls all are told.
    """
    low = np.array([np.minimum(one.start, one.end) for one in pieces]).reshape(-1, 2)
    high = np.array([np.maximum(one.start, one.end) for one in pieces]).reshape(-1, 2)
    # Of two walls the thicker one says how far each reaches, as if both were as thick.
    flattest = float(np.sin(MEET_RAD))
    reach = np.array([sum(_reaches(one, one, flattest)) for one in pieces])
    reach[[bool(one.bulge) for one in pieces]] = np.ptp([low, high]) if len(pieces) else 0.0
    low, high = low - reach[:, None], high + reach[:, None]
    around = box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
    first, second = STRtree(around).query(around, predicate="intersects")
    return sorted(zip(*(row[first < second].tolist() for row in (first, second)), strict=True))


def meetings(one: Piece, other: Piece) -> list[Meeting]:
    """Where two walls meet: once at most if both are straight."""
    if one.bulge or other.bulge:
        return _curved(one, other)
    met = crossing(one, other)
    if met is None:
        return end_to_end(one, other)
    reach, reach_other = _reaches(one, other, abs(_sine(one, other)))
    if not -reach <= met.first <= one.length_px + reach:
        return []
    if not -reach_other <= met.second <= other.length_px + reach_other:
        return []
    return [met]


def crossing(one: Piece, other: Piece) -> Meeting | None:
    """Where the lines of two straight walls cross, however far off; None if all but parallel."""
    sine = _sine(one, other)
    if abs(sine) < np.sin(MEET_RAD):
        return None
    apart = other.start - one.start
    along = float((apart[0] * other.direction[1] - apart[1] * other.direction[0]) / sine)
    beyond = float((apart[0] * one.direction[1] - apart[1] * one.direction[0]) / sine)
    return Meeting(one.start + along * one.direction, along, beyond)


def _sine(one: Piece, other: Piece) -> float:
    """Of the angle from one direction to the other."""
    return float(one.direction[0] * other.direction[1] - one.direction[1] * other.direction[0])


def _reaches(one: Piece, other: Piece, sine: float) -> tuple[float, float]:
    """How far beyond its ends each of two walls may go on to meet the other."""
    return (
        (other.thickness_px / 2 + REACH * one.thickness_px) / sine + 2,
        (one.thickness_px / 2 + REACH * other.thickness_px) / sine + 2,
    )


def _curved(one: Piece, other: Piece) -> list[Meeting]:
    """The same where one of them is an arc: both are made longer, and crossed."""
    least = np.sin(MEET_RAD)
    most = _reaches(one, other, float(least))
    first, second = (_longer(piece, reach) for piece, reach in zip((one, other), most, strict=True))
    crossed = LineString(first).intersection(LineString(second))
    points = list(crossed.geoms) if isinstance(crossed, MultiPoint) else [crossed]
    found = []
    for point in points:
        if not isinstance(point, Point) or point.is_empty:
            continue
        at = np.array([point.x, point.y])
        along, beyond = (float(piece.arc.place(at)[0]) for piece in (one, other))
        way, its = one.arc.way(along), other.arc.way(beyond)
        sine = abs(float(way[0] * its[1] - way[1] * its[0]))
        if sine < least:
            continue
        reach, its_reach = _reaches(one, other, sine)
        if -reach <= along <= one.length_px + reach and (
            -its_reach <= beyond <= other.length_px + its_reach
        ):
            found.append(Meeting(at, along, beyond))
    return found or end_to_end(one, other)


def _longer(piece: Piece, by_px: float) -> NDArray[np.float64]:
    """(n, 2) points of its centre line, longer at both ends; no farther round than a circle."""
    arc: Arc = piece.arc
    if piece.bulge:
        by_px = min(by_px, max(0.0, 0.95 * np.pi * arc.radius_px - arc.length_px / 2))
    return piece.part(-by_px, piece.length_px + by_px).arc.points(FINE_RAD)


def end_to_end(one: Piece, other: Piece) -> list[Meeting]:
    """Walls of different thickness or slightly different direction that touch with their ends."""
    thick = max(one.thickness_px, other.thickness_px)
    # No end touches one that is farther off, whatever the walls' directions; most are.
    farthest = max(OVERLAP_CURVED * thick, REACH * thick + 2) + BESIDE * thick
    for mine, along in ((one.start, 0.0), (one.end, one.length_px)):
        for its, beyond in ((other.start, 0.0), (other.end, other.length_px)):
            if abs(its[0] - mine[0]) > farthest or abs(its[1] - mine[1]) > farthest:
                continue
            outward = one.arc.way(along) * (-1.0 if along == 0.0 else 1.0)
            inward = other.arc.way(beyond) * (1.0 if beyond == 0.0 else -1.0)
            curved = bool(one.bulge or other.bulge)
            if curved and float(outward @ inward) < np.cos(TANGENT_RAD):
                continue
            away = its - mine
            ahead = float(away @ outward)
            beside = abs(float(away[0] * outward[1] - away[1] * outward[0]))
            overlap = OVERLAP_CURVED if curved else OVERLAP
            if -overlap * thick <= ahead <= REACH * thick + 2 and beside <= BESIDE * thick:
                longer = mine if one.length_px >= other.length_px else its
                return [Meeting(np.asarray(longer, dtype=float), along, beyond)]
    return []
