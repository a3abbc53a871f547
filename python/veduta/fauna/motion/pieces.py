"""The pieces of a way: curves that are gone, and turns on the spot in the corners between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.pivot import Pivot, pivot_of, turn_between
from veduta.fauna.motion.steps import Footing
from veduta.fauna.motion.whole_path import Curve, Pace, curve_of, going

_PAUSE_S = 0.15
"""So long it stands before and after a turn."""


@dataclass(frozen=True, eq=False)
class Piece:
    """One piece through time, at times (t,).

    line: what the body lies on. way: (t,) m of its middle on that. phase: (t,) strides since the
    animal began. pace: (t,) 0..1 of its speed.
    """

    line: Curve | Pivot
    times: Floats
    way: Floats
    phase: Floats
    pace: Floats

    def spots(self, foot: Footing, middle: Floats) -> Floats:
        """(n, 2) where a foot stands whose stand has its middle at phases (n,)."""
        if isinstance(self.line, Pivot):
            done = np.interp(middle, self.phase, self.line.done)
            yaw = np.interp(done, self.line.done, self.line.yaw)
            ahead = np.stack([np.cos(yaw), np.sin(yaw)], axis=1)
            left = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
            corner = self.line.before.points[-1, :2]
            return np.asarray(corner + foot.ahead_m * ahead + foot.beside_m * left)
        stride = (self.way[-1] - self.way[0]) / max(float(self.phase[-1] - self.phase[0]), 1e-9)
        inside = np.clip(middle, self.phase[0], self.phase[-1]) - self.phase[0]
        arcs = self.way[0] + stride * inside + foot.ahead_m
        ahead = self.line.heading(arcs)
        left = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
        return np.asarray(self.line.at(arcs) + foot.beside_m * left)


def pieces_of(
    path_m: Floats, corners: Sequence[int], pace: Pace, stride_m: float, length_m: float, *,
    closed: bool,
) -> tuple[Piece, ...]:  # fmt: skip
    """The pieces of a path (n, 3) with corners at some of its points, one after the other.

    The whole body stands on an open path at both ends; in a corner its middle does, and the ends
    of the body go about it as fast as it walks.
    """
    cuts = [0, *corners, len(path_m) - 1]
    curves = [
        curve_of(path_m[a : b + 1], closed=closed and not corners)
        for a, b in zip(cuts, cuts[1:], strict=False)
    ]
    inner = replace(pace, rest_s=_PAUSE_S)
    found: list[Piece] = []
    for number, curve in enumerate(curves):
        begin, end = 0.0, curve.length_m
        half = min(0.5 * length_m, 0.25 * curve.length_m)
        if number == 0 and not curve.closed:
            begin = half
        if number == len(curves) - 1 and not curve.closed:
            end -= half
        if number:
            before = curves[number - 1]
            turn = abs(turn_between(before, curve)) * 0.5 * length_m
            times, way, share = going(turn, inner)
            pivot = pivot_of(before, curve, way / max(turn, 1e-9), share, length_m)
            _append(found, Piece(pivot, times, np.zeros_like(way), way / stride_m, share))
        times, way, share = going(end - begin, inner if corners else pace)
        _append(found, Piece(curve, times, begin + way, way / stride_m, share))
    return tuple(found)


def spots_on(pieces: tuple[Piece, ...], foot: Footing, middle: Floats) -> Floats:
    """(n, 2) where a foot stands whose stands have their middles at phases (n,), in any piece."""
    ends = np.array([float(piece.phase[-1]) for piece in pieces])
    which = np.clip(np.searchsorted(ends, middle), 0, len(pieces) - 1)
    found = np.zeros((len(middle), 2))
    for number, piece in enumerate(pieces):
        own = which == number
        if own.any():
            found[own] = piece.spots(foot, middle[own])
    return found


def _append(found: list[Piece], piece: Piece) -> None:
    """Times and phases go on where the piece before ends; the key that both have is its."""
    if found:
        last = found[-1]
        line = piece.line
        if isinstance(line, Pivot):
            line = replace(line, yaw=line.yaw[1:], done=line.done[1:], lead=line.lead[1:])
        piece = Piece(
            line, piece.times[1:] + last.times[-1], piece.way[1:],
            piece.phase[1:] + last.phase[-1], piece.pace[1:],
        )  # fmt: skip
    found.append(piece)
