"""Bands become straight pieces of wall: a centre line with a thickness. `curved` has the others."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import Arc
from veduta.plan.document import WallDrawing
from veduta.plan.walls.tracks import Track

LEAST_ASPECT = 0.6
"""A piece is at least this many times as long as thick: shorter ones are parts of a junction."""

MOST_TURN_PX = 1.5
"""A straight piece's centre strays no more from its line (or 12 % of its thickness)."""

FACET_RAD = np.radians(10.0)
"""By so much straight pieces turn that stand for an arc where only straight ones are known."""


@dataclass(frozen=True)
class Piece:
    """A band from `start` to `end` ((2,) float64, pixels) of a thickness; `bulge` as of `Arc`."""

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    thickness_px: float
    drawing: WallDrawing = "filled"
    bulge: float = 0.0

    @cached_property
    def arc(self) -> Arc:
        """Its centre line."""
        return Arc(self.start, self.end, self.bulge)

    @property
    def length_px(self) -> float:
        """From end to end, on the centre line."""
        return self.arc.length_px

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vector from start to end, straight."""
        return self.arc.direction

    def part(self, low: float, high: float) -> Piece:
        """What of it, or beyond its ends, lies between two places along it."""
        ends = self.arc.at(np.array([low, high]))
        return replace(self, start=ends[0], end=ends[1], bulge=self.arc.bulge_of(low, high))

    def facets(self, step_rad: float) -> list[Piece]:
        """Straight pieces that stand for it, itself where it is straight."""
        if not self.bulge:
            return [self]
        points = self.arc.points(step_rad)
        return [
            replace(self, start=start, end=end, bulge=0.0)
            for start, end in zip(points[:-1], points[1:], strict=True)
        ]


def straight_pieces(
    tracks: list[Track], least_px: float = 0.0, drawing: WallDrawing = "filled"
) -> list[Piece]:
    """The straight pieces of all bands that are at least so thick.

    Each band is parted where its centre line turns.
    """
    found = []
    for track in tracks:
        for first, last in parted(track):
            piece = _fitted(track, first, last, drawing)
            if piece is not None and piece.thickness_px >= least_px:
                found.append(piece)
    return found


def parted(track: Track) -> list[tuple[int, int]]:
    """Index ranges of straight parts (Ramer 1972, Douglas and Peucker 1973)."""
    middle = (track.low + track.high) / 2
    tolerance = max(MOST_TURN_PX, 0.12 * track.breadth())
    done: list[tuple[int, int]] = []
    waiting = [(0, len(middle))]
    while waiting:
        first, last = waiting.pop()
        at = track.along[first:last]
        chord = np.interp(at, [at[0], at[-1]], [middle[first], middle[last - 1]])
        apart = np.abs(middle[first:last] - chord)
        worst = int(np.argmax(apart))
        if apart[worst] <= tolerance or last - first < 6:
            done.append((first, last))
        else:
            cut = first + int(np.clip(worst, 2, last - first - 2))
            waiting += [(first, cut), (cut, last)]
    return sorted(done)


def _fitted(track: Track, first: int, last: int, drawing: WallDrawing) -> Piece | None:
    along = track.along[first:last]
    middle = (track.low[first:last] + track.high[first:last]) / 2
    if len(along) < 3:
        return None
    centred = along - along.mean()
    slope = float(centred @ middle / max(float(centred @ centred), 1e-9))
    offset = float(middle.mean())
    breadth = float(np.median(track.high[first:last] - track.low[first:last]))
    thickness = breadth / float(np.hypot(1, slope))
    span = np.array([along[0] - 0.5, along[-1] + 0.5])
    across = offset + slope * (span - along.mean())
    ends = np.column_stack((across, span) if track.steep else (span, across))
    length = float(np.hypot(*(ends[1] - ends[0])))
    if abs(slope) > 1.1 or length < LEAST_ASPECT * thickness:
        return None
    return Piece(ends[0], ends[1], thickness, drawing)
