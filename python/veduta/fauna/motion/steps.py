"""Where feet are wanted along a path: standing where they came down, swinging from there to the
next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Floats

_ROUNDS = 12
Heights = Callable[[Floats], Floats]
"""(n,) heights of the ground at (n, 2) places; NaN where there is none."""


@dataclass(frozen=True)
class Footing:
    """A foot in its gait. down, up: phases between which it stands. ahead_m, beside_m: where it
    is from the body's middle in the midst of that. lift_m: how high it swings. sole_m: its end
    over the ground.
    """

    name: str
    down: float
    up: float
    ahead_m: float
    beside_m: float
    lift_m: float
    sole_m: float


@dataclass(frozen=True, eq=False)
class Stands:
    """Where a foot stands, one time after the other: from phases begin (k,) to end (k,), at spots
    (k, 2) m.
    """

    begin: Floats
    end: Floats
    spots: Floats

    def of(self, phase: Floats) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """(t,) the last stand that has begun, and whether the foot stands."""
        last = np.searchsorted(self.begin, phase, side="right") - 1
        which = np.clip(last, 0, len(self.begin) - 1)
        return which, np.asarray((phase <= self.end[which]) & (phase >= self.begin[which]))


@dataclass(frozen=True, eq=False)
class Steps:
    """places: (t, 3) m where the foot's end is wanted. stands: (t,)."""

    places: Floats
    stands: NDArray[np.bool_]


def stands_along(
    foot: Footing, first: float, last: float, spots_at: Callable[[Floats], Floats]
) -> Stands:
    """One foot's stands between two phases, strides since the beginning.

    spots_at: (n, 2) m where it stands, by the phases of its stands' middles. A foot that swings
    where the animal starts or stops begins or ends under its body.
    """
    duty = (foot.up - foot.down) % 1.0
    begin, end, middle = _stands(foot, duty, first, last)
    return Stands(begin, end, spots_at(middle))


def within_reach(
    stands: Stands, phase: Floats, hung: Floats, reach_m: float, foot: Footing, ground: Heights
) -> Stands:
    """The same where its leg, which hangs at places (t, 3) and is so long, can reach.

    Each spot is moved as little as it must be; a stand that has none in reach all the time is cut
    at both ends.
    """
    which, now = stands.of(phase)
    spots, begin, end = stands.spots.copy(), stands.begin.copy(), stands.end.copy()
    for _ in range(_ROUNDS):
        off = _out_of_reach(spots, which, hung, reach_m, foot, ground)
        off[~now] = 0.0
        worst = np.zeros(len(spots))
        np.maximum.at(worst, which, np.linalg.norm(off, axis=1))
        if worst.max(initial=0.0) < 1e-6:
            break
        # Towards where the leg is too short the most.
        far = np.linalg.norm(off, axis=1) >= worst[which] - 1e-12
        rows = np.flatnonzero(far & (worst[which] > 0.0))
        spots[which[rows]] += off[rows]
    off = np.linalg.norm(_out_of_reach(spots, which, hung, reach_m, foot, ground), axis=1)
    for row in np.unique(which[now & (off > 1e-3 * reach_m)]):
        good = np.flatnonzero((which == row) & now & (off <= 1e-3 * reach_m))
        if len(good) > 1:
            run = max(np.split(good, np.flatnonzero(np.diff(good) > 1) + 1), key=len)
            begin[row], end[row] = phase[run[0]], phase[run[-1]]
    return Stands(begin, end, spots)


def steps_of(
    stands: Stands, phase: Floats, foot: Footing, ground: Heights,
    leg: tuple[Floats, float] | None = None,
) -> Steps:  # fmt: skip
    """Where the foot is wanted: on its spot, or in an arc from it to the next.

    leg: places (t, 3) where it hangs and how far it reaches (m): the arc stays within that.
    """
    which, now = stands.of(phase)
    height = _on(ground, stands.spots)
    after = np.minimum(which + 1, len(stands.begin) - 1)
    span = np.maximum(stands.begin[after] - stands.end[which], 1e-9)
    share = np.where(now, 0.0, np.clip((phase - stands.end[which]) / span, 0.0, 1.0))
    ease = (share * share * (3.0 - 2.0 * share))[:, None]
    flat = stands.spots[which] * (1.0 - ease) + stands.spots[after] * ease
    if leg is not None:
        rows = np.arange(len(phase))
        for _ in range(3):
            off = _out_of_reach(flat, rows, leg[0], leg[1], foot, ground)
            flat = np.where(now[:, None], flat, flat + off)
    level = height[which] * (1.0 - ease[:, 0]) + height[after] * ease[:, 0]
    rise = np.sin(np.pi * share)
    clear = np.where(now, level, np.maximum(level, _on(ground, flat)))
    z = clear + foot.lift_m * rise + foot.sole_m
    return Steps(np.column_stack([flat, z]), now)


def _out_of_reach(
    spots: Floats, which: NDArray[np.int64], hung: Floats, reach_m: float, foot: Footing,
    ground: Heights,
) -> Floats:  # fmt: skip
    """(t, 2) how far each spot must be moved for the leg to reach it."""
    high = hung[:, 2] - (_on(ground, spots)[which] + foot.sole_m)
    flat = np.sqrt(np.maximum(reach_m**2 - high**2, (0.1 * reach_m) ** 2))
    away = hung[:, :2] - spots[which]
    size = np.linalg.norm(away, axis=1)
    move = np.maximum(size - flat, 0.0) / np.maximum(size, 1e-12)
    return np.asarray(away * move[:, None])


def _stands(foot: Footing, duty: float, first: float, last: float) -> tuple[Floats, Floats, Floats]:
    """Phases at which stands begin and end, and those of their middles; the first and the last are
    there where the animal starts and stops.
    """
    numbers = np.arange(np.floor(first) - 2.0, np.ceil(last) + 2.0)
    begin = numbers + foot.down
    end = begin + duty
    kept = (end > first) & (begin < last)
    begin, end = begin[kept], end[kept]
    middle = begin + 0.5 * duty
    if not len(begin) or begin[0] > first:
        begin, end = np.concatenate([[first], begin]), np.concatenate([[first], end])
        middle = np.concatenate([[first], middle])
    if end[-1] < last:
        begin, end = np.concatenate([begin, [last]]), np.concatenate([end, [last]])
        middle = np.concatenate([middle, [last]])
    return begin, end, middle


def _on(ground: Heights, places: Floats) -> Floats:
    """Heights at places (n, 2); beside the ground that of the nearest that has one."""
    found = np.array(ground(places), dtype=np.float64)
    known = np.isfinite(found)
    if not known.any():
        return np.zeros(len(places))
    order = np.arange(len(found))
    return np.asarray(np.where(known, found, np.interp(order, order[known], found[known])))
