"""How far an animal is on its path through time: it starts, goes at its gait's pace, and stops."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.motion.figure import Floats


@dataclass(frozen=True, eq=False)
class Curve:
    """A path on the ground by its arc length, up and down too. points: (n, 3) m. arcs: (n,) m."""

    points: Floats
    arcs: Floats
    closed: bool

    @property
    def length_m(self) -> float:
        """All of it."""
        return float(self.arcs[-1])

    def at(self, arc_m: Floats) -> Floats:
        """(..., 2) x, y after so many metres; beyond an open path's ends it goes straight on."""
        arc = np.asarray(arc_m)
        if self.closed:
            arc = arc % self.length_m
        inside = np.clip(arc, 0.0, self.length_m)
        found = np.stack(
            [np.interp(inside, self.arcs, self.points[:, axis]) for axis in (0, 1)], axis=-1
        )
        return np.asarray(found + (arc - inside)[..., None] * self.heading(inside))

    def heading(self, arc_m: Floats) -> Floats:
        """(..., 2) unit vectors along it, over a short way: it turns without kinks."""
        arc, way = np.asarray(arc_m), max(self.length_m / (len(self.arcs) - 1), 1e-9)
        if self.closed:
            ends = [np.stack([np.interp((arc + sign * way) % self.length_m, self.arcs,
                                        self.points[:, axis]) for axis in (0, 1)], axis=-1)
                    for sign in (-1.0, 1.0)]  # fmt: skip
        else:
            near = [np.clip(arc + sign * way, 0.0, self.length_m) for sign in (-1.0, 1.0)]
            ends = [np.stack([np.interp(one, self.arcs, self.points[:, axis]) for axis in (0, 1)],
                             axis=-1) for one in near]  # fmt: skip
        ahead = ends[1] - ends[0]
        size = np.linalg.norm(ahead, axis=-1, keepdims=True)
        return np.asarray(ahead / np.maximum(size, 1e-12))


def curve_of(path_m: Floats, *, closed: bool) -> Curve:
    """The curve through points (n, 3)."""
    apart = np.linalg.norm(np.diff(path_m[:, :2], axis=0), axis=1)
    kept = np.concatenate([[True], apart > 1e-9])
    points = path_m[kept]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return Curve(points, np.concatenate([[0.0], np.cumsum(steps)]), closed)


@dataclass(frozen=True)
class Pace:
    """How it goes. speed_m_s: of its gait. ease_s: so long it needs to come to that, and to stand.
    rest_s: it stands before and after. rate_hz: of the keys.
    """

    speed_m_s: float
    ease_s: float = 0.8
    rest_s: float = 0.4
    rate_hz: float = 30.0


def going(way_m: float, pace: Pace) -> tuple[Floats, Floats, Floats]:
    """times (t,), how far it is (t,), and (t,) 0..1 how much of its pace it has.

    The pace rises and falls as a smooth step; the way is its integral, exactly so long.
    """
    speed = max(pace.speed_m_s, 1e-6)
    ease = min(pace.ease_s, way_m / speed)
    seconds = way_m / speed + ease
    count = max(2, round((seconds + 2.0 * pace.rest_s) * pace.rate_hz) + 1)
    times = np.arange(count) / pace.rate_hz
    since = np.clip(times - pace.rest_s, 0.0, seconds)
    up, down = np.clip(since / ease, 0.0, 1.0), np.clip((seconds - since) / ease, 0.0, 1.0)

    def risen(share: Floats) -> Floats:
        return np.asarray(share**3 - 0.5 * share**4)

    flat = np.clip(since - ease, 0.0, max(seconds - 2.0 * ease, 0.0))
    way = speed * (ease * risen(up) + flat + ease * (0.5 - risen(down)))
    share = np.minimum(up * up * (3.0 - 2.0 * up), down * down * (3.0 - 2.0 * down))
    return times, np.asarray(way), np.asarray(share)
