"""When the visitor is where: never walking faster than asked, nor turning faster than one sees."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from veduta.plan.tour.smooth import lengths_along

TURN_RAD_S = math.radians(60.0)
"""No faster does the view ever turn."""
EASY_RAD_S = math.radians(45.0)
"""Looking around in a room."""
START_M_S2 = 1.0
"""From standing to walking, and back."""
SAMPLE_S = 0.1
CALM_S = 0.4
"""Standard deviation of the filter over the wished directions: heads do not jerk."""
STEADY_S = 0.2
"""The same, over those that see past walls: a wider one would bring walls before the eyes again."""
MARGIN = 0.9
"""Of the limit is aimed at, for what is lost between the keys."""
KEY_S = 1.0
"""Keys are no further apart: half a turn between two would be ambiguous."""
KEY_M = 0.01
KEY_RAD = math.radians(0.5)


Look = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True)
class Motion:
    """Samples at equal times. feet_m: (n, 3). yaw, pitch: (n,) radians."""

    feet_m: NDArray[np.float64]
    yaw: NDArray[np.float64]
    pitch: NDArray[np.float64]


@dataclass(frozen=True)
class Timed:
    """Keys of a tour. times_s: (n,). feet_m: (n, 3). directions: (n, 3) unit vectors."""

    times_s: NDArray[np.float64]
    feet_m: NDArray[np.float64]
    directions: NDArray[np.float64]


def walk(
    points_m: NDArray[np.float64],
    yaw: NDArray[np.float64],
    pitch: NDArray[np.float64],
    speed_m_s: float,
) -> Motion:
    """Along a way (n, 3) from standing to standing."""
    along = lengths_along(points_m)
    at = travelled(float(along[-1]), speed_m_s)
    feet = np.stack([np.interp(at, along, column) for column in points_m.T], axis=1)
    return Motion(feet, np.interp(at, along, yaw), np.interp(at, along, pitch))


def travelled(length_m: float, speed_m_s: float) -> NDArray[np.float64]:
    """(n,) how far one is at equal times, with an even start and an even stop."""
    reach = speed_m_s**2 / START_M_S2  # of start and stop together
    top = speed_m_s if length_m >= reach else math.sqrt(length_m * START_M_S2)
    start_s = top / START_M_S2
    even_s = (length_m - top * start_s) / top if top > 0.0 else 0.0
    total = 2.0 * start_s + even_s
    times = np.linspace(0.0, total, max(2, math.ceil(total / SAMPLE_S) + 1))
    first = 0.5 * START_M_S2 * np.minimum(times, start_s) ** 2
    middle = top * np.clip(times - start_s, 0.0, even_s)
    braked = np.clip(times - start_s - even_s, 0.0, start_s)
    at: NDArray[np.float64] = first + middle + top * braked - 0.5 * START_M_S2 * braked**2
    return np.clip(at, 0.0, length_m)


def look(at_m: NDArray[np.float64], yaws: list[float], pitch: float) -> Motion:
    """Standing at a place (3,), turn through some yaws."""
    pieces = []
    for first, last in zip(yaws, yaws[1:], strict=False):
        count = max(2, math.ceil(abs(last - first) / (EASY_RAD_S * SAMPLE_S)))
        pieces.append(np.linspace(first, last, count))
    yaw = np.concatenate(pieces)
    return Motion(np.repeat(at_m[None], len(yaw), axis=0), yaw, np.full(len(yaw), pitch))


def timed(motions: list[Motion], look_past: Look | None = None) -> Timed:
    """All motions after each other: calm, never turning too fast, as few keys.

    look_past: changes yaws (n,) at places (n, 3) so that one sees more. Where the view would turn
    faster than the limit, all goes slower there.
    """
    feet = np.concatenate([motion.feet_m for motion in motions])
    calm = CALM_S / SAMPLE_S
    yaw = gaussian_filter1d(_joined([motion.yaw for motion in motions]), calm, mode="nearest")
    if look_past is not None:
        yaw = gaussian_filter1d(look_past(feet, yaw), STEADY_S / SAMPLE_S, mode="nearest")
    pitch = np.concatenate([motion.pitch for motion in motions])
    pitch = gaussian_filter1d(pitch, calm, mode="nearest")
    needed = np.hypot(np.diff(yaw), np.diff(pitch)) / (MARGIN * TURN_RAD_S * SAMPLE_S)
    eased = gaussian_filter1d(maximum_filter1d(np.maximum(needed, 1.0), 7), 2.0, mode="nearest")
    steps = SAMPLE_S * np.maximum(eased, needed)
    times = np.concatenate([[0.0], np.cumsum(steps)])
    kept = _keys(times, np.column_stack([feet / KEY_M, yaw / KEY_RAD, pitch / KEY_RAD]))
    level = np.cos(pitch[kept])
    directions = np.stack(
        [np.cos(yaw[kept]) * level, np.sin(yaw[kept]) * level, np.sin(pitch[kept])], axis=1
    )
    return Timed(times[kept], feet[kept], directions)


def _joined(yaws: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """One after the other, each turned by whole turns to where the one before ends."""
    joined: list[NDArray[np.float64]] = []
    for yaw in yaws:
        turns = 0.0
        if joined:
            turns = round((joined[-1][-1] - yaw[0]) / (2.0 * math.pi)) * 2.0 * math.pi
        joined.append(yaw + turns)
    return np.concatenate(joined)


def _keys(times: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.int64]:
    """The rows between which straight lines stay within 1 of all values (n, k).

    Ramer, Douglas and Peucker, over time.
    """
    kept = {0, len(times) - 1}
    spans = [(0, len(times) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        share = (times[first + 1 : last] - times[first]) / (times[last] - times[first])
        line = values[first] + share[:, None] * (values[last] - values[first])
        off = np.abs(values[first + 1 : last] - line).max(axis=1)
        worst = first + 1 + int(off.argmax())
        if off.max() <= 1.0:
            if times[last] - times[first] <= KEY_S:
                continue
            worst = (first + last) // 2
        kept.add(worst)
        spans += [(first, worst), (worst, last)]
    return np.array(sorted(kept), dtype=np.int64)
