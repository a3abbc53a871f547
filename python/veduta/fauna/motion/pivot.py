"""A turn on the spot between two curves that meet in a corner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.whole_path import Curve

_LEAD_RAD = 0.5
"""At full pace nose and rump lead and trail so far on a body's length: it looks where it turns."""


@dataclass(frozen=True, eq=False)
class Pivot:
    """The body's line while it turns, as `Curve` has it, its middle at arc 0, at times (t,).

    before: the curve at whose end it turns. after: that at whose beginning it stands then. yaw:
    (t,) where it looks. done: (t,) 0..1 of the turn. lead: (t,) rad by which a metre ahead of the
    middle is turned farther.
    """

    before: Curve
    after: Curve
    yaw: Floats
    done: Floats
    lead: Floats

    def heading(self, arc_m: Floats) -> Floats:
        """(t, ..., 2) unit vectors so far ahead (t, ...)."""
        arc = np.asarray(arc_m, dtype=np.float64)
        own = _over(self.lead, arc) * arc + _over(self.yaw, arc)
        for curve, share, end in self._both(arc):
            there, here = curve.heading(end + arc), curve.heading(np.array(end))
            cross = here[0] * there[..., 1] - here[1] * there[..., 0]
            own = own + share * np.arctan2(cross, there @ here)
        return np.stack([np.cos(own), np.sin(own)], axis=-1)

    def at(self, arc_m: Floats) -> Floats:
        """(t, ..., 2) places so far ahead (t, ...)."""
        arc = np.asarray(arc_m, dtype=np.float64)
        along, aside = np.zeros_like(arc), np.zeros_like(arc)
        for curve, share, end in self._both(arc):
            here = curve.heading(np.array(end))
            away = curve.at(end + arc) - curve.at(np.array(end))
            along += share * (away @ here)
            aside += share * (away @ np.array([-here[1], here[0]]))
        yaw = _over(self.yaw, arc)
        cos, sin = np.cos(yaw), np.sin(yaw)
        moved = np.stack([along * cos - aside * sin, along * sin + aside * cos], axis=-1)
        return np.asarray(self.before.points[-1, :2] + moved)

    def _both(self, arc: Floats) -> list[tuple[Curve, Floats, float]]:
        """Both curves, how much each has to say, and the arc of the corner on it."""
        done = _over(self.done, arc)
        return [(self.before, 1.0 - done, self.before.length_m), (self.after, done, 0.0)]


def pivot_of(before: Curve, after: Curve, done: Floats, pace: Floats, length_m: float) -> Pivot:
    """The turn of a body from a curve's end into the next one's beginning, on the shorter way.

    done: (t,) 0..1 of the turn. pace: (t,) 0..1 how fast.
    """
    turn = turn_between(before, after)
    ahead = before.heading(np.array(before.length_m))
    begin = float(np.arctan2(ahead[1], ahead[0]))
    lead = np.sign(turn) * _LEAD_RAD / length_m * pace
    return Pivot(before, after, begin + turn * done, done, lead)


def turn_between(before: Curve, after: Curve) -> float:
    """How far one turns in the corner (rad), to the left positive; right back is to the left."""
    old, new = before.heading(np.array(before.length_m)), after.heading(np.array(0.0))
    return float(np.arctan2(old[0] * new[1] - old[1] * new[0], old @ new))


def _over(values: Floats, arc: Floats) -> Floats:
    """Values (t,) shaped to go with arcs (t, ...)."""
    return np.asarray(values.reshape(values.shape + (1,) * (arc.ndim - 1)))
