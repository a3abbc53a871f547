"""Gaits of one animal joined into a longer motion: from each to the next while its feet stay
planted.

The phase of the stride goes on through all of it; where one gait becomes the other its turns, its
stride and its feet's phases go over smoothly. Feet that stand keep their spots there, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats, Limb, posed
from veduta.fauna.motion.planting import reached
from veduta.fauna.motion.stride import KEYS, Stride

NAME = "joined"
_CYCLES, _OVER = 3, 1.5
"""Each gait is kept for so many cycles, and goes over into the next in so many."""
_RATE_HZ = 40.0


@dataclass(frozen=True, eq=False)
class Joined:
    """stride: as a clip is made of it, its times those of the whole. way: (t,) lengths gone.
    down: (t, f) which feet stand.
    """

    stride: Stride
    way: Floats
    down: NDArray[np.bool_]


def joined_gaits(figure: Figure, strides: tuple[Stride, ...], *, side: bool) -> Joined | None:
    """All gaits in their order and back to the first; None of fewer than two."""
    if len(strides) < 2:
        return None
    later = _aligned(strides)
    times, phase, share = _course(strides)
    turns = sum(
        part[:, None] * _at(one.turns, phase + shift)
        for one, shift, part in zip(strides, later, share.T, strict=True)
    )
    root = sum(
        part[:, None] * _at(one.root, phase + shift)
        for one, shift, part in zip(strides, later, share.T, strict=True)
    )
    speed = share @ np.array([one.stride / one.times_s[-1] for one in strides])
    steps = np.diff(times) * 0.5 * (speed[1:] + speed[:-1])
    way = np.concatenate([[0.0], np.cumsum(steps)])
    down = np.zeros((len(times), len(figure.feet())), dtype=np.bool_)
    # Three times over: a foot that stands at the end stands on at the beginning.
    count, gone = len(times) - 1, float(way[-1])
    now, rooted = (np.tile(np.asarray(rows)[:-1], (3, 1)) for rows in (turns, root))
    ways = np.concatenate([way[:-1] - gone, way[:-1], way[:-1] + gone])
    middle = np.concatenate([np.arange(count, 2 * count), [count]])
    worst = 0.0
    for column, limb in enumerate(figure.feet()):
        stands = _stands(strides, later, share, phase, limb.name)
        if not stands.any() or stands.all():
            continue
        thrice = np.tile(stands[:-1], 3)
        now, off, good = _planted(figure, now, rooted, ways, limb, thrice, side=side)
        worst, down[:, column] = max(worst, off), good[middle]
    lift = np.where(down, 0.0, 1.0)
    whole = Stride(NAME, times, now[middle], rooted[middle], lift, gone, worst, {})
    return Joined(whole, way, down)


def _course(strides: tuple[Stride, ...]) -> tuple[Floats, Floats, Floats]:
    """times (t,), the phase in cycles (t,), and how much of each gait there is (t, g)."""
    count = len(strides)
    each = _CYCLES + _OVER
    total = each * count
    phase = np.linspace(0.0, round(total), 40 * round(total) + 1)
    place = phase / round(total) * count
    gait = np.minimum(place.astype(np.int64), count - 1)
    part = np.clip((place - gait - _CYCLES / each) / (_OVER / each), 0.0, 1.0)
    ease = part * part * (3.0 - 2.0 * part)
    share = np.zeros((len(phase), count))
    rows = np.arange(len(phase))
    share[rows, gait] += 1.0 - ease
    share[rows, (gait + 1) % count] += ease
    cycle = share @ np.array([one.times_s[-1] for one in strides])
    steps = np.diff(phase) * 0.5 * (cycle[1:] + cycle[:-1])
    seconds = np.concatenate([[0.0], np.cumsum(steps)])
    times = np.linspace(0.0, seconds[-1], max(2, round(seconds[-1] * _RATE_HZ)) + 1)
    even = np.interp(times, seconds, phase)
    shares = np.stack([np.interp(even, phase, column) for column in share.T], axis=1)
    return times, np.asarray(even), shares


def _aligned(strides: tuple[Stride, ...]) -> list[float]:
    """How much later each gait begins its cycle, so that its feet stand most as the first one's
    do.
    """
    at = np.arange(KEYS) / KEYS
    first = _chart(strides[0], at)
    found = [0.0]
    for one in strides[1:]:
        same = [
            sum(
                float((first[name] == chart).mean())
                for name, chart in _chart(one, at + shift).items()
                if name in first
            )
            for shift in at
        ]
        found.append(float(at[int(np.argmax(same))]))
    return found


def _chart(stride: Stride, phase: Floats) -> dict[str, NDArray[np.bool_]]:
    return {
        name: (phase - down) % 1.0 <= (up - down) % 1.0 for name, (down, up) in stride.steps.items()
    }


def _stands(
    strides: tuple[Stride, ...], later: list[float], share: Floats, phase: Floats, name: str
) -> NDArray[np.bool_]:
    """When a foot stands: it comes down and goes up at phases between those of the gaits."""
    known = [(row, one.steps[name]) for row, one in enumerate(strides) if name in one.steps]
    if len(known) < len(strides):
        return np.zeros(len(phase), dtype=np.bool_)
    down = np.array([(step[0] - later[row]) % 1.0 for row, step in known])
    duty = np.array([(step[1] - step[0]) % 1.0 for _, step in known])
    turn = np.exp(2j * np.pi * down)
    mean = np.angle(share @ turn) / (2.0 * np.pi)
    return np.asarray((phase - mean) % 1.0 <= share @ duty)


def _at(rows: Floats, phase: Floats) -> Floats:
    """Rows of a cycle (k + 1, n), the last one the first again, at phases."""
    place = phase % 1.0 * (len(rows) - 1)
    before = np.minimum(place.astype(np.int64), len(rows) - 2)
    part = (place - before)[:, None]
    return np.asarray(rows[before] * (1.0 - part) + rows[before + 1] * part)


def _planted(
    figure: Figure, turns: Floats, root: Floats, way: Floats, limb: Limb,
    stands: NDArray[np.bool_], *, side: bool,
) -> tuple[Floats, float, NDArray[np.bool_]]:  # fmt: skip
    """turns with one foot planted, how far it is from its spots at worst, and when it stands."""
    toe = limb.joints[-1]
    joints = posed(figure, root, figure.rest + turns, figure.length, figure.apart).joints[:, toe]
    sole = float(figure.deep[toe]) if side else float(joints[stands, 1].mean())
    change = np.diff(np.concatenate([[0], stands.astype(np.int8), [0]]))
    begin, end = np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1
    offset = np.full((len(way), 2), np.nan)
    for first, last in zip(begin, end, strict=True):
        rows = slice(first, last + 1)
        spot = float((way[rows] + joints[rows, 0]).mean())
        offset[rows] = np.stack([spot - way[rows], np.full(last + 1 - first, sole)], axis=1)
        offset[rows] -= joints[rows]
    known = np.isfinite(offset[:, 0])
    order = np.arange(len(way), dtype=np.float64)
    for axis in (0, 1):
        offset[:, axis] = np.interp(order, order[known], offset[known, axis])
    wanted = joints + offset
    if side:
        wanted[:, 1] = np.where(stands, sole, np.maximum(wanted[:, 1], sole))
    found, off = reached(figure, turns, root, limb, wanted)
    good = stands & (off < 0.005)
    return found, float(off[good].max(initial=0.0)), good
