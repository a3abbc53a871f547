"""Curved pieces of wall: bands that an arc explains better than straight lines do.

A band that turns is parted by `pieces.parted` into lines that stray from it by a tolerance. Where
one circle runs through several of these, both are compared by the Bayesian information criterion
(Schwarz 1978): how far the band's middle lies from each, and how many numbers each needs. Other
bands that lie on a circle that was accepted are then taken to it, over windows too, so that all
parts of one curved wall have the same circle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import Arc, bulge_through
from veduta.geometry.circle import Circle, fit_circle
from veduta.plan.document import WallDrawing
from veduta.plan.walls.join import SAME_THICKNESS, solid_share
from veduta.plan.walls.pieces import LEAST_ASPECT, MOST_TURN_PX, Piece, parted
from veduta.plan.walls.tracks import Track

LEAST_TURN_RAD = np.radians(15.0)
"""A band that turns less is a straight wall on a sheet that is not flat."""

CORNER_TURN_RAD = np.radians(30.0)
"""Two lines alone are a corner, unless they turn by so much and it is round all the same."""

NOISE_PX = 0.35
"""Middles of bands are known no better: their sides lie on whole pixels."""

ALIKE_PX = 4.0
"""Places nearer than this on a band have their errors in common."""

SHARPEST = 0.75
"""A wall's circle has at least so many of its thicknesses as radius."""

LEAST_LENGTH = 3.0
"""And is so many of them long: what is shorter is a rounded corner of a blob."""

DEEP = 0.6
"""And bows by so many of them: what does not lies within a straight wall."""

MOST_SEEDS = 60
MOST_TRACKS = 1500
"""More bands are a photo or a texture: the longest are looked at."""

PATIENCE = 6
"""So many longer chains that are no arc in a row: the arc has ended."""


@dataclass(frozen=True)
class Stretch:
    """A part of a track that is straight, or nearly: places from `first` up to before `last`."""

    track: int
    first: int
    last: int
    points: NDArray[np.float64]
    """(n, 2) of its centre line."""

    runs: NDArray[np.float64]
    """(n,) how long it is across, along x or y."""

    steep: bool

    def thickness_on(self, circle: Circle) -> float:
        """Across the circle's line."""
        out = self.points - circle.centre
        across = np.abs(out[:, 0 if self.steep else 1]) / np.maximum(np.hypot(*out.T), 1e-9)
        return float(np.median(self.runs * across))


def curved_pieces(
    tracks: Sequence[Track],
    solid: NDArray[np.bool_],
    least_px: float,
    drawing: WallDrawing = "filled",
) -> tuple[list[Piece], list[Track]]:
    """The curved pieces of all bands that are at least so thick, and the bands without them."""
    others: Sequence[Track] = ()
    if len(tracks) > MOST_TRACKS:
        ordered = sorted(tracks, key=lambda track: -len(track.along))
        tracks, others = ordered[:MOST_TRACKS], ordered[MOST_TRACKS:]
    stretches = _stretches(tracks)
    samples = np.array([one.points[[0, len(one.points) // 2, -1]] for one in stretches])
    taken: set[int] = set()
    found: list[Piece] = []
    seeds = sorted(_seeds(tracks, stretches), key=lambda seed: -len(seed[1]))
    for members, points in seeds[:MOST_SEEDS]:
        if taken & set(members):
            continue
        seed = fit_circle(points)
        thickness = None if seed is None else _thickness(members, stretches, seed)
        if seed is None or thickness is None or thickness < least_px:
            continue
        if seed.radius_px < SHARPEST * thickness or len(points) < LEAST_LENGTH * thickness:
            continue
        if _depth(points) < DEEP * thickness:
            continue
        whole, more = _grown(seed, thickness, members, (stretches, samples), taken)
        made = _runs(whole, thickness, [stretches[index] for index in more], solid, drawing)
        if made:
            taken |= set(more)
            found += made
    return found, [*_rest(tracks, [stretches[index] for index in sorted(taken)]), *others]


def _stretches(tracks: Sequence[Track]) -> list[Stretch]:
    found = []
    for number, track in enumerate(tracks):
        centre = track.centre()
        for first, last in parted(track):
            runs = (track.high - track.low)[first:last]
            found.append(Stretch(number, first, last, centre[first:last], runs, track.steep))
    return found


def _seeds(
    tracks: Sequence[Track], stretches: Sequence[Stretch]
) -> list[tuple[list[int], NDArray[np.float64]]]:
    """Neighbouring stretches of one track that an arc explains better, with their points."""
    of: dict[int, list[int]] = {}
    for index, one in enumerate(stretches):
        of.setdefault(one.track, []).append(index)
    found = []
    for number, mine in of.items():
        tolerance = max(MOST_TURN_PX, 0.12 * tracks[number].breadth())
        first = 0
        while first < len(mine) - 1:
            best = None
            for last in range(first + 2, len(mine) + 1):
                chosen = [stretches[index] for index in mine[first:last]]
                if _is_arc(chosen, tolerance):
                    best = last
                elif last - (best or first + 2) >= PATIENCE:
                    break
            if best is None:
                first += 1
            else:
                points = np.concatenate([stretches[index].points for index in mine[first:best]])
                found.append((mine[first:best], points))
                first = best
    return found


def _is_arc(chosen: Sequence[Stretch], tolerance: float) -> bool:
    """Whether one circle explains these stretches better than a line for each does."""
    points = np.concatenate([one.points for one in chosen])
    circle = fit_circle(points)
    if circle is None or float(np.abs(circle.away(points)).max()) > 1.5 * tolerance:
        return False
    turns = np.unwrap(circle.turns(points))
    turn = float(abs(turns[-1] - turns[0]))
    if turn < (CORNER_TURN_RAD if len(chosen) == 2 else LEAST_TURN_RAD):
        return False
    by_arc = float((circle.away(points) ** 2).sum())
    by_lines = sum(_off_line(one.points) for one in chosen)
    return information(by_arc, 3, len(points)) < information(by_lines, 2 * len(chosen), len(points))


def information(squares: float, numbers: int, count: int) -> float:
    """Of Schwarz's criterion: less is better.

    `squares` is the sum over `count` places on a band, of which neighbours err alike; `numbers` are
    the parameters.
    """
    free = max(count / ALIKE_PX, 2.0)
    error = float(np.sqrt(squares / max(count, 1) + NOISE_PX**2))
    return 2.0 * free * float(np.log(error)) + numbers * float(np.log(free))


def _off_line(points: NDArray[np.float64]) -> float:
    """Sum of squared distances from the best line."""
    own = points - points.mean(axis=0)
    return float(np.linalg.svd(own, compute_uv=False)[-1] ** 2)


def _depth(points: NDArray[np.float64]) -> float:
    """How far points of a band stray from the line between its ends."""
    run = points[-1] - points[0]
    away = points - points[0]
    across = run[0] * away[:, 1] - run[1] * away[:, 0]
    return float(np.abs(across).max() / max(float(np.hypot(*run)), 1e-9))


def _thickness(
    members: Sequence[int], stretches: Sequence[Stretch], circle: Circle
) -> float | None:
    chosen = [stretches[index] for index in members]
    lengths = np.array([len(one.points) for one in chosen], dtype=float)
    values = np.array([one.thickness_on(circle) for one in chosen])
    return float(np.average(values, weights=lengths)) if len(values) else None


def _grown(
    circle: Circle,
    thickness: float,
    members: Sequence[int],
    known: tuple[Sequence[Stretch], NDArray[np.float64]],
    taken: set[int],
) -> tuple[Circle, list[int]]:
    """The circle through all stretches that lie on it, and which these are.

    known: the stretches, and three points (n, 3, 2) of each.
    """
    stretches, samples = known
    more = list(members)
    tolerance = max(MOST_TURN_PX, 0.12 * thickness)
    for _ in range(3):
        away = np.abs(circle.away(samples.reshape(-1, 2))).reshape(-1, 3).max(axis=1)
        fitting = [
            int(index)
            for index in np.flatnonzero(away <= 1.5 * tolerance)
            if int(index) not in taken
            and _lies_on(stretches[int(index)], circle, thickness, tolerance)
        ]
        fitting = sorted({*fitting, *members})
        again = fit_circle(np.concatenate([stretches[index].points for index in fitting]))
        if again is None or fitting == more:
            break
        circle, more = again, fitting
    return circle, more


def _lies_on(one: Stretch, circle: Circle, thickness: float, tolerance: float) -> bool:
    """Whether a stretch follows the circle: near it all along, and as thick."""
    if float(np.abs(circle.away(one.points)).max()) > 1.5 * tolerance:
        return False
    own = one.thickness_on(circle)
    return max(own, thickness) <= SAME_THICKNESS * min(own, thickness) + 2


def _runs(
    circle: Circle,
    thickness: float,
    members: Sequence[Stretch],
    solid: NDArray[np.bool_],
    drawing: WallDrawing,
) -> list[Piece]:
    """Pieces on the circle, each over what is solid without a break."""
    spans = sorted(_span(circle, one) for one in members)
    # Begin after the widest part of the circle without any.
    starts = np.array([low for low, _ in spans])
    ends = np.maximum.accumulate([high for _, high in spans])
    free = np.append(starts[1:], starts[0] + 2 * np.pi) - ends
    cut = int(np.argmax(free)) + 1
    spans = [*spans[cut:], *((low + 2 * np.pi, high + 2 * np.pi) for low, high in spans[:cut])]
    joined: list[list[float]] = []
    for low, high in spans:
        if joined and (low <= joined[-1][1] or _is_solid(circle, joined[-1][1], low, solid)):
            joined[-1][1] = max(joined[-1][1], high)
        else:
            joined.append([low, high])
    found = []
    for low, high in joined:
        if (high - low) * circle.radius_px >= LEAST_ASPECT * thickness:
            start, middle, end = circle.at(np.array([low, (low + high) / 2, high]))
            found.append(Piece(start, end, thickness, drawing, bulge_through(start, middle, end)))
    return found


def _span(circle: Circle, one: Stretch) -> tuple[float, float]:
    """From which to which angle a stretch goes."""
    turns = np.unwrap(circle.turns(one.points))
    low, high = float(turns.min()), float(turns.max())
    # Places are the middles of pixels.
    half = 0.5 / circle.radius_px
    around = 2 * np.pi * np.floor((low + np.pi) / (2 * np.pi))
    return low - around - half, high - around + half


def _is_solid(circle: Circle, low: float, high: float, solid: NDArray[np.bool_]) -> bool:
    count = max(2, int((high - low) * circle.radius_px) + 1)
    points = circle.at(np.linspace(low, high, count))
    shares = [
        solid_share(solid, one, other) for one, other in zip(points[:-1], points[1:], strict=True)
    ]
    return float(np.mean(shares)) > 0.93


def _rest(tracks: Sequence[Track], taken: Sequence[Stretch]) -> list[Track]:
    """The tracks without what was taken; what is left of one may be several."""
    keep = [np.ones(len(track.along), np.bool_) for track in tracks]
    for one in taken:
        keep[one.track][one.first : one.last] = False
    found = []
    for track, mask in zip(tracks, keep, strict=True):
        if mask.all():
            found.append(track)
            continue
        edges = np.flatnonzero(np.diff(np.pad(mask.astype(np.int8), 1)))
        for low, high in zip(edges[::2], edges[1::2], strict=True):
            if high - low >= 3:
                part = slice(int(low), int(high))
                found.append(
                    Track(track.along[part], track.low[part], track.high[part], track.steep)
                )
    return found


def same_circle(first: Arc, second: Arc, near_px: float) -> bool:
    """Whether two arcs lie on one circle, to a tolerance."""
    if not first.bulge or not second.bulge:
        return False
    places = second.at(np.linspace(0.0, second.length_px, 5))
    return float(np.abs(first.place(places)[1]).max()) <= near_px


def lies_in(piece: Piece, curved: Piece) -> bool:
    """Whether a straight piece is a part of a curved one."""
    places = piece.arc.at(np.linspace(0.0, piece.length_px, 5))
    along, across = curved.arc.place(places)
    half = curved.thickness_px / 2
    inside = along.min() >= -half and along.max() <= curved.length_px + half
    return bool(inside and np.abs(across).max() <= half + 1 and piece.length_px < curved.length_px)
