"""Marked joints carried from one marked frame to the next by what the pictures show.

Of each joint and each gap between two marks a way is sought that looks at each frame as the marks
do, moves as the optical flow (OpenCV's DIS) does, and ends on both marks: the one of the least cost
over places whose surroundings look most like the marks' (dynamic programming). A. Buchanan,
A. Fitzgibbon, Interactive feature tracking using K-D trees and dynamic programming, CVPR 2006,
follow points so; here flow takes the place of their motion model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.nearer import Frames
from veduta.fauna.read.silhouettes import Masks

_LONGEST_PX = 640
"""Longer pictures are made smaller before."""


@dataclass(frozen=True)
class CarryLooks:
    """How marks are carried. Shares are of the animal's size, the root of its area."""

    longest: int = 24
    """Frames between two marks; over more of them nothing is carried."""
    alone: int = 6
    """Frames before a first mark and after a last one in which it is carried by one end alone."""
    patch: float = 0.11
    """Half the side of what is compared around a place."""
    reach: float = 0.22
    """Between two frames a joint goes so far at most."""
    step: float = 0.015
    """Between the places that are looked at; where they are many it is larger, but about those to
    which the flow leads.
    """
    across: int = 36
    """So many places side by side at most."""
    places: int = 220
    """Of each frame the most alike ones."""
    unlike: float = 30.0
    """Grey levels (rms over a patch) by which surroundings may differ to cost 1."""
    most: float = 4.0
    """What a place, or a step, costs at most."""
    flow: float = 0.03
    """A step that is so far off the flow costs 1; by the square."""
    outside: float = 2.0
    """What a place costs that is beside the silhouette."""
    trusted: float = 1.0
    """A way whose dearest place costs so much is trusted by a half."""
    surest: float = 0.99
    """What is carried is trusted by no more, also over equal frames: 1 is for what was marked."""


@dataclass(frozen=True, eq=False)
class CarriedMarks:
    """px: (t, 2) by joint, marked or carried, NaN elsewhere. trust: (t,) by joint: 1 where it was
    marked, 0 to 1 where it was carried.
    """

    px: dict[str, Floats]
    trust: dict[str, Floats]


def carried_marks(
    pictures: Frames, masks: Masks, pins: Mapping[str, Floats], looks: CarryLooks
) -> CarriedMarks:
    """Marks (t, 2) by joint, and what lies between them.

    pictures: (t, h, w, 3) frames that follow each other; masks: (t, h, w) of the animal, empty
    where it is not known.
    """
    shrink = min(1.0, _LONGEST_PX / max(pictures.shape[1:3]))
    area = float(np.median([mask.sum() for mask in masks if mask.any()] or [0.0]))
    seen = _Seen(pictures, masks, shrink, max(np.sqrt(area) * shrink, 24.0), looks)
    px = {name: at.copy() for name, at in pins.items()}
    trust = {name: np.isfinite(at[:, 0]).astype(np.float64) for name, at in pins.items()}
    for name, first, last in _gaps(pins, looks):
        seen.forget(min(first, last))
        way = 1 if last > first else -1
        rows = np.arange(first + way, last + (0 if np.isfinite(pins[name][last, 0]) else way), way)
        if len(rows):
            found, sure = _between(seen, pins[name][first], pins[name][last], first, rows)
            px[name][rows], trust[name][rows] = found, sure
    return CarriedMarks(px, trust)


def _gaps(pins: Mapping[str, Floats], looks: CarryLooks) -> list[tuple[str, int, int]]:
    """Joint, a marked frame, and the next marked one, in the order of the frames; where there is
    none, or it is too far, the last frame to which the one mark leads.
    """
    found = []
    for name, at in pins.items():
        marked = [int(row) for row in np.flatnonzero(np.isfinite(at[:, 0]))]
        for first, last in zip([None, *marked], [*marked, None], strict=True):
            if first is not None and last is not None and last - first <= looks.longest:
                found += [(name, first, last)] if last - first > 1 else []
                continue
            room = len(at) if first is None or last is None else (last - first + 1) // 2
            if first is not None:
                found.append((name, first, min(first + min(looks.alone, room), len(at) - 1)))
            if last is not None:
                found.append((name, last, max(last - min(looks.alone, room), 0)))
    return sorted(found, key=lambda gap: min(gap[1:]))


class _Seen:
    """Small pictures, their flow and masks, made when they are asked for. size: of the animal."""

    def __init__(
        self, pictures: Frames, masks: Masks, shrink: float, size: float, looks: CarryLooks
    ) -> None:
        self._pictures, self._masks, self.shrink = pictures, masks, shrink
        self.size, self.looks = size, looks
        height, width = pictures.shape[1:3]
        self._to = (max(1, round(width * shrink)), max(1, round(height * shrink)))
        self.half = max(3.0, looks.patch * self.size)
        self._small: dict[int, NDArray[np.float32]] = {}
        self._soft: dict[int, NDArray[np.float32]] = {}
        self._wide: dict[int, Masks] = {}
        self._flows: dict[tuple[int, int], NDArray[np.float32]] = {}
        self._search = cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)

    def forget(self, before: int) -> None:
        """Drops what is of earlier frames."""
        self._small = {row: one for row, one in self._small.items() if row >= before}
        self._soft = {row: one for row, one in self._soft.items() if row >= before}
        self._wide = {row: one for row, one in self._wide.items() if row >= before}
        self._flows = {rows: one for rows, one in self._flows.items() if min(rows) >= before}

    def small(self, row: int) -> NDArray[np.float32]:
        """(h, w, 3) CIE L, a, b; colours count twice, for light changes with a limb's turn."""
        if row not in self._small:
            picture = np.ascontiguousarray(self._pictures[row])
            scaled = cv2.resize(picture, self._to, interpolation=cv2.INTER_AREA)
            lab = cv2.cvtColor(scaled, cv2.COLOR_RGB2LAB).astype(np.float32)
            self._small[row] = lab * np.array([1.0, 2.0, 2.0], np.float32)
        return self._small[row]

    def soft(self, row: int) -> NDArray[np.float32]:
        """The same, as soft as what is compared is coarse."""
        if row not in self._soft:
            soft = cv2.GaussianBlur(self.small(row), (0, 0), max(0.6, self.half / 7.0))
            self._soft[row] = np.asarray(soft, dtype=np.float32)
        return self._soft[row]

    def outside(self, row: int, places: Floats) -> NDArray[np.bool_]:
        """(n,) which places are beside the silhouette; none where it is not known."""
        mask = self._masks[row]
        if not mask.any():
            return np.zeros(len(places), dtype=np.bool_)
        at = np.clip((places / self.shrink).astype(int), 0, np.array(mask.shape[::-1]) - 1)
        if row not in self._wide:
            wide = 2 * max(1, round(0.02 * self.size / self.shrink)) + 1
            grown = cv2.dilate(mask.astype(np.uint8), np.ones((wide, wide), np.uint8))
            self._wide[row] = np.asarray(grown > 0)
        return np.asarray(~self._wide[row][at[:, 1], at[:, 0]])

    def flow(self, row: int, other: int, places: Floats) -> Floats:
        """(n, 2) where places of a frame are in the next or the last one."""
        if (row, other) not in self._flows:
            grey = [np.ascontiguousarray(self.small(k)[..., 0].astype(np.uint8))
                    for k in (row, other)]  # fmt: skip
            begin = np.zeros((*grey[0].shape, 2), np.float32)
            self._flows[row, other] = np.asarray(self._search.calc(grey[0], grey[1], begin))
        field = self._flows[row, other]
        x, y = (places - 0.5).astype(np.float32).T
        moved = cv2.remap(field, x[:, None], y[:, None], cv2.INTER_LINEAR,
                          borderMode=cv2.BORDER_REPLICATE)  # fmt: skip
        return np.asarray(places + moved.reshape(-1, 2), dtype=np.float64)


def _between(
    seen: _Seen, begin_px: Floats, end_px: Floats, first: int, rows: NDArray[np.int64]
) -> tuple[Floats, Floats]:
    """(n, 2) px of a joint in rows of frames that follow a marked one, and (n,) how far they are
    to be trusted. end_px: where it is marked in the frame after them; NaN where it is not.
    """
    looks, way = seen.looks, int(rows[0]) - first
    marks = [begin_px * seen.shrink]
    at = [first]
    if np.isfinite(end_px[0]):
        marks.append(end_px * seen.shrink)
        at.append(int(rows[-1]) + way)
    looked = [_patches(seen, row, mark[None])[0] for row, mark in zip(at, marks, strict=True)]
    ways = [_followed(seen, marks[0], first, int(rows[-1]))[1:]]
    if len(marks) == 2:
        ways.append(_followed(seen, marks[1], at[1], int(rows[0]))[:0:-1])
    places, costs = [marks[0][None]], [np.zeros(1)]
    for number, row in enumerate(rows):
        share = (number + 1) / (len(rows) + 1) if len(marks) == 2 else 0.0
        guesses = np.stack([way[number] for way in ways])
        hidden = min(number + 1, len(rows) - number if len(marks) == 2 else number + 1)
        own, cost = _alike(seen, int(row), guesses, marks, looked, share, hidden)
        places.append(own)
        costs.append(cost)
    if len(marks) == 2:
        places.append(marks[1][None])
        costs.append(np.zeros(1))
    steps = [
        _steps(seen, first + way * number, way, places[number], places[number + 1])
        for number in range(len(places) - 1)
    ]
    chosen = _least(costs, steps)
    found = np.array([places[n + 1][chosen[n + 1]] for n in range(len(rows))])
    paid = np.array([costs[n + 1][chosen[n + 1]] for n in range(len(rows))])
    moved = np.array([step[chosen[n], chosen[n + 1]] for n, step in enumerate(steps)])
    # A step that leaves the flow makes all places between it and the nearer mark doubtful.
    doubt = np.cumsum(moved)[: len(rows)]
    if len(marks) == 2:
        doubt = np.minimum(doubt, np.cumsum(moved[::-1])[::-1][1:])
    sure = 1.0 / (1.0 + ((doubt + paid) / looks.trusted) ** 2)
    return found / seen.shrink, np.minimum(sure, looks.surest)


def _steps(seen: _Seen, row: int, way: int, here: Floats, there: Floats) -> Floats:
    """(n, m) what it costs to go from places of a frame to those of the next one."""
    off = ((seen.flow(row, row + way, here)[:, None] - there) ** 2).sum(axis=2)
    back = ((seen.flow(row + way, row, there) - here[:, None]) ** 2).sum(axis=2)
    size = seen.looks.flow * seen.size
    return np.asarray(np.minimum(np.minimum(off, back) / size**2, seen.looks.most))


def _least(costs: list[Floats], steps: list[Floats]) -> list[int]:
    """The place of each frame on the way of the least cost."""
    best, came = costs[0], []
    for step, cost in zip(steps, costs[1:], strict=True):
        whole = best[:, None] + step
        came.append(whole.argmin(axis=0))
        best = whole.min(axis=0) + cost
    chosen = [int(best.argmin())]
    for back in came[::-1]:
        chosen.append(int(back[chosen[-1]]))
    return chosen[::-1]


def _followed(seen: _Seen, begin: Floats, first: int, last: int) -> Floats:
    """(n, 2) where the flow alone takes a place, both ends with it."""
    way = 1 if last > first else -1
    found = [begin]
    for row in range(first, last, way):
        found.append(seen.flow(row, row + way, found[-1][None])[0])
    return np.array(found)


def _alike(
    seen: _Seen, row: int, guesses: Floats, marks: list[Floats],
    looked: list[NDArray[np.float32]], share: float, hidden: int,
) -> tuple[Floats, Floats]:  # fmt: skip
    """(n, 2) the places of a frame that look most like the marks, and what each costs.

    share: of the way from the first mark to the second. hidden: frames from the nearer mark.
    """
    looks = seen.looks
    middle = marks[0] * (1.0 - share) + marks[-1] * share if len(marks) == 2 else guesses[0]
    reach = seen.size * min(looks.reach * (0.5 + hidden), 0.8)
    step = max(1.0, looks.step * seen.size)
    grid = np.concatenate([
        guesses,
        _grid(middle, reach, max(step, 2.0 * reach / looks.across)),
        *(_grid(guess, 4.0 * step, step) for guess in guesses),
    ])  # fmt: skip
    height, width = seen.small(row).shape[:2]
    inside = ((grid > 0.0) & (grid < [width, height])).all(axis=1)
    grid = grid[inside | (np.arange(len(grid)) < len(guesses))]
    patches = _patches(seen, row, grid)
    apart = [((patches - one) ** 2).mean(axis=(1, 2)) / looks.unlike**2 for one in looked]
    cost = (1.0 - share) * apart[0] + share * apart[-1]
    cost = np.minimum(np.minimum(cost, 1.5 * np.minimum(apart[0], apart[-1])), looks.most)
    cost = cost + looks.outside * seen.outside(row, grid)
    likest = np.argsort(cost, kind="stable")[: looks.places]
    kept = np.unique(np.concatenate([np.arange(len(guesses)), likest]))
    return grid[kept], cost[kept]


def _grid(middle: Floats, reach: float, step: float) -> Floats:
    line = np.arange(-reach, reach + 0.5 * step, step)
    return np.asarray(middle + np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2))


def _patches(seen: _Seen, row: int, places: Floats) -> NDArray[np.float32]:
    """(n, 49, 3) the surroundings of places, soft: seven by seven looks, nearer ones count more."""
    half, soft = seen.half, seen.soft(row)
    line = np.linspace(-half, half, 7)
    offsets = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    at = (places[:, None] + offsets - 0.5).astype(np.float32)
    found = cv2.remap(soft, at[..., 0], at[..., 1], cv2.INTER_LINEAR,
                      borderMode=cv2.BORDER_REPLICATE)  # fmt: skip
    weight = np.exp(-0.5 * (offsets**2).sum(axis=1) / (0.6 * half) ** 2)
    weight = np.sqrt(weight / weight.mean()).astype(np.float32)
    return np.asarray(found.reshape(len(places), -1, 3) * weight[:, None])
