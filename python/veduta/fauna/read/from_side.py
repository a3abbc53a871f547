"""An animal without limbs that is seen from the side: where it is, and how often its tail beats.

It swings towards the camera and away, which the pictures do not show: how far it swings is that of
its kind. What they show is how long it seems: the more it is bent, the shorter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.fauna.read.axis import Axis, main_axes
from veduta.fauna.read.tracked import SAMPLES, Tracked, lengths_of
from veduta.run.errors import NotFoundError

LONGEST = 0.9
"""The animal is as long as it seems where it seems longest, in this share of the frames it is not;
what is over that is noise."""
TURNED = 0.8
"""Seen shorter than so much of its length, it has turned towards the camera or from it."""
_TOO_LONG = 1.25
_BOW = 3
"""The middle between back and belly is a curve of this degree: its fins are not to bend it."""
_SMOOTH = 9
"""Frames over which it is seen which way it goes."""
_FEWEST_BEATS = 2.0
_CLEAR = 0.3
"""A beat that explains less of what varies is none; noise alone comes to a fifth."""
_AS_GOOD = 0.93
"""Half of a frequency is taken where it explains so much of what that does."""


@dataclass(frozen=True, eq=False)
class Beat:
    """frequency_hz: swings to both sides and back, a second. share: of the variance explained."""

    frequency_hz: float
    share: float


def straight_axes(masks: NDArray[np.bool_]) -> tuple[Axis, ...]:
    """The axis and half heights of an animal that is straight as seen in each mask (t, h, w).

    A medial axis ends in a corner of the tail's fin; here it goes along the silhouette's main axis,
    in the middle between back and belly.
    """
    return tuple(_straight(mask) for mask in masks)


def _straight(mask: NDArray[np.bool_]) -> Axis:
    y, x = np.nonzero(mask)
    points = np.stack([x, y], axis=1) + 0.5
    middle, axes = main_axes(points)
    along, across = (points - middle) @ axes[0], (points - middle) @ axes[1]
    first = float(along.min()) - 0.5
    column = np.minimum((along - first).astype(np.int64), int(along.max() + 0.5 - first))
    counts = np.bincount(column)
    kept = counts > 0
    places = first + np.flatnonzero(kept) + 0.5
    centre = np.bincount(column, across)[kept] / counts[kept]
    ends = np.linspace(first, float(along.max()) + 0.5, SAMPLES + 1)
    bow = np.polynomial.polynomial.Polynomial.fit(places, centre, _BOW, w=np.sqrt(counts[kept]))
    line = middle + ends[:, None] * axes[0] + bow(ends)[:, None] * axes[1]
    return Axis(line, np.interp(ends, places, 0.5 * counts[kept]))


def headed(tracked: Tracked) -> tuple[Tracked, NDArray[np.bool_]]:
    """The axes with the head where each frame's animal goes; and whether it looks to the right."""
    middle = tracked.points.mean(axis=1)[:, 0]
    span = min(_SMOOTH, len(middle)) // 2
    ahead = np.array(
        [
            middle[min(row + span, len(middle) - 1)] - middle[max(row - span, 0)]
            for row in range(len(middle))
        ]
    )
    length = float(np.median(lengths_of(tracked.points)))
    still = np.abs(ahead) < 0.01 * length
    usual = float(np.sign(ahead[~still].sum())) if (~still).any() else 1.0
    looks_right = np.where(still, usual or 1.0, ahead) > 0.0
    first_is_right = tracked.points[:, 0, 0] > tracked.points[:, -1, 0]
    turn = first_is_right != looks_right
    points, half = tracked.points.copy(), tracked.half_widths
    points[turn] = points[turn, ::-1]
    if half is not None:
        half = half.copy()
        half[turn] = half[turn, ::-1]
    return replace(tracked, points=points, half_widths=half), looks_right


def shown_whole(
    tracked: Tracked, looks_right: NDArray[np.bool_]
) -> tuple[Tracked, NDArray[np.bool_]]:
    """What is left without frames in which it has turned to the camera, or that show too much."""
    lengths = lengths_of(tracked.points)
    usual = seen_length(tracked)
    good = (lengths >= TURNED * usual) & (lengths <= _TOO_LONG * usual)
    if not good.any():
        raise NotFoundError(
            "the animal from the side",
            "its length is another one in every frame",
            "Give footage in which it goes across the picture.",
        )
    named = [
        f"frame {number}: it seems {length / usual:.0%} as long as it is"
        for number, length in zip(tracked.frame[~good], lengths[~good], strict=True)
    ]
    half = tracked.half_widths
    kept = replace(
        tracked, points=tracked.points[good], frame=tracked.frame[good],
        half_widths=None if half is None else half[good],
        left_out=(*tracked.left_out, *named),
    )  # fmt: skip
    return kept, looks_right[good]


def seen_length(tracked: Tracked) -> float:
    """Its length in the tracked unit: where it seems longest it is least foreshortened."""
    return float(np.quantile(lengths_of(tracked.points), LONGEST))


def tail_beat(seen: Floats, times_s: Floats) -> Beat | None:
    """How often it swings, by what of its silhouette varies (k, t); None where that is not clear.

    seen: such as its length and its area. A swing to either side makes them smaller, which is seen
    twice in a beat; where it goes obliquely to the camera, one side's swing turns it towards the
    camera, which is seen once. So a frequency is sought that together with its double explains
    them; where only one shows, it is the double.
    """
    duration = float(times_s[-1] - times_s[0])
    step = duration / max(len(times_s) - 1, 1)
    swings = np.stack([_swing(row, times_s) for row in seen])
    low, high = _FEWEST_BEATS / duration, 0.22 / step
    if high <= low:
        return None
    best, share = _best(swings, times_s, np.arange(low, high, 0.05 / duration))
    while best / 2.0 > low:
        near = best / 2.0 + np.linspace(-0.1, 0.1, 9) / duration
        half, lower = _best(swings, times_s, near)
        if lower < _AS_GOOD * share:
            break
        best, share = half, lower
    return Beat(best, share) if share >= _CLEAR else None


def _swing(values: Floats, times_s: Floats) -> Floats:
    """What varies fast, of unit size."""
    trend = np.polynomial.polynomial.Polynomial.fit(times_s, values, 3)
    swing = values - trend(times_s)
    return np.asarray(swing / max(float(np.linalg.norm(swing)), 1e-9))


def _best(swings: Floats, times_s: Floats, tried: Floats) -> tuple[float, float]:
    """Which frequency explains the most, and how much of all."""
    shares = []
    for frequency in tried:
        turn = 2.0 * np.pi * times_s[:, None] * np.array([frequency, 2.0 * frequency])
        design = np.concatenate([np.ones((len(turn), 1)), np.cos(turn), np.sin(turn)], axis=1)
        left = swings.T - design @ np.linalg.lstsq(design, swings.T, rcond=None)[0]
        shares.append(1.0 - float((left**2).sum()) / len(swings))
    row = int(np.argmax(shares))
    return float(tried[row]), shares[row]
