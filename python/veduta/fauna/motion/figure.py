"""The figure of an animal with limbs: its segments in the plane that is seen, and how they hang.

The plane's x goes forwards. Of a figure seen from the side its y goes up, seen from above to the
left. A segment's angle is that to the segment it hangs on; the first one's is that to x.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.plan import BodyPlan, Part, Side

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Limb:
    """A part on one side. joints: rows of the figure's joints from its start on; segments: rows."""

    part: Part
    side: Side
    joints: tuple[int, ...]
    segments: tuple[int, ...]

    @property
    def name(self) -> str:
        """Of its part, and of its side where there are two."""
        return self.part.name if self.side == "middle" else f"{self.part.name}_{self.side}"


@dataclass(frozen=True, eq=False)
class Figure:
    """Segments (s) between joints (j), parents first.

    names: of the joints. start, end: (s,) joints of each segment. hangs: (s,) the segment that it
    turns with, -1 for the first. turns: (s, s) 1 where the row's angle turns the column's segment.
    reaches: (s, j) 1 where the row's segment lies on the way from the root to the joint.
    moved: (m, j) 1 where a limb's start shifts the joint; limb: (s,) the limb of each segment.
    rest: (s,) angles, length: (s,), deep: (j,), and apart: (m, 2) of the limbs' starts, in lengths.
    """

    limbs: tuple[Limb, ...]
    names: tuple[str, ...]
    start: Ints
    end: Ints
    hangs: Ints
    turns: Floats
    reaches: Floats
    moved: Floats
    limb: Ints
    rest: Floats
    length: Floats
    deep: Floats
    apart: Floats

    @property
    def segments(self) -> tuple[str, ...]:
        """Names of the segments: of their limb, and their numbers in it."""
        return tuple(
            f"{limb.name}_{number}" for limb in self.limbs for number in range(len(limb.segments))
        )

    def feet(self) -> tuple[Limb, ...]:
        """The limbs that touch the ground."""
        return tuple(limb for limb in self.limbs if limb.part.ground)


def figure_of(plan: BodyPlan, without: Collection[str] = ()) -> Figure:
    """The figure of a plan, without the named parts. Of a pair the left one comes first."""
    made = _Making([], [], [], [], [], [], [], [], [])
    for part in plan.parts:
        if part.name in without or (part.on is not None and part.on not in made.names):
            continue
        sides: tuple[Side, ...] = ("left", "right") if part.sides else ("middle",)
        for side in sides:
            made.add(part, side, mirrored=side == "right" and plan.view == "top")
    return made.figure()


@dataclass
class _Making:
    limbs: list[Limb]
    names: list[str]
    points: list[tuple[float, float]]
    deep: list[float]
    start: list[int]
    end: list[int]
    hangs: list[int]
    limb: list[int]
    on: list[int]

    def add(self, part: Part, side: Side, *, mirrored: bool) -> None:
        number = len(self.limbs)
        suffix = "" if side == "middle" else f"_{side}"
        flip = -1.0 if mirrored else 1.0
        joints: list[int] = []
        if part.on is None or part.start is None:
            hung, parent = -1, -1
        else:
            hung = self.names.index(part.on)
            parent = self.end.index(hung) if hung in self.end else 0
            joints.append(self._joint(f"{part.name}{suffix}", part.start, flip, part.deep[0]))
        first = len(part.deep) - len(part.points)
        for name, point, deep in zip(part.joints, part.points, part.deep[first:], strict=True):
            joints.append(self._joint(name + suffix, point, flip, deep))
        segments = []
        for before, after in zip(joints, joints[1:], strict=False):
            segments.append(len(self.start))
            self.start.append(before)
            self.end.append(after)
            self.hangs.append(parent)
            self.limb.append(number)
            parent = len(self.start) - 1
        self.on.append(hung)
        self.limbs.append(Limb(part, side, tuple(joints), tuple(segments)))

    def _joint(self, name: str, point: tuple[float, float], flip: float, deep: float) -> int:
        self.names.append(name)
        self.points.append((point[0], point[1] * flip))
        self.deep.append(deep)
        return len(self.names) - 1

    def figure(self) -> Figure:
        count, joints = len(self.start), len(self.names)
        points = np.array(self.points)
        turns = np.eye(count)
        reaches = np.zeros((count, joints))
        moved = np.zeros((len(self.limbs), joints))
        vectors = points[self.end] - points[self.start]
        apart = np.zeros((len(self.limbs), 2))
        for number, limb in enumerate(self.limbs):
            hung = self.on[number]
            if hung >= 0:
                reaches[:, limb.joints[0]] = reaches[:, hung]
                moved[:, limb.joints[0]] = moved[:, hung]
                moved[number, limb.joints[0]] = 1.0
                apart[number] = points[limb.joints[0]] - points[hung]
            for segment in limb.segments:
                before, after = self.start[segment], self.end[segment]
                reaches[:, after] = reaches[:, before]
                reaches[segment, after] = 1.0
                moved[:, after] = moved[:, before]
                if self.hangs[segment] >= 0:
                    turns[:, segment] += turns[:, self.hangs[segment]]
        absolute = np.arctan2(vectors[:, 1], vectors[:, 0])
        above = np.array(self.hangs)
        rest = np.where(above >= 0, absolute - absolute[above], absolute)
        rest = (rest + np.pi) % (2.0 * np.pi) - np.pi
        return Figure(
            tuple(self.limbs), tuple(self.names), np.array(self.start), np.array(self.end), above,
            turns, reaches, moved, np.array(self.limb), rest,
            np.asarray(np.linalg.norm(vectors, axis=1)), np.array(self.deep), apart,
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Posed:
    """joints: (t, j, 2). vectors: (t, s, 2) along the segments. starts: (t, m, 2) turned starts."""

    joints: Floats
    vectors: Floats
    starts: Floats


def posed(figure: Figure, root: Floats, angles: Floats, length: Floats, apart: Floats) -> Posed:
    """Where the joints are. root: (t, 2). angles: (t, s). length: (s,). apart: (m, 2).

    A limb's start turns with the segment that the limb hangs on.
    """
    absolute = angles @ figure.turns
    vectors = length[:, None] * np.stack([np.cos(absolute), np.sin(absolute)], axis=-1)
    carrier = absolute[:, _carriers(figure)] - _rest_of_carriers(figure)
    cos, sin = np.cos(carrier), np.sin(carrier)
    starts = np.stack(
        [cos * apart[:, 0] - sin * apart[:, 1], sin * apart[:, 0] + cos * apart[:, 1]], axis=-1
    )
    joints = root[:, None] + np.einsum("tsc,sj->tjc", vectors, figure.reaches)
    joints = joints + np.einsum("tmc,mj->tjc", starts, figure.moved)
    return Posed(np.asarray(joints), np.asarray(vectors), starts)


def _carriers(figure: Figure) -> Ints:
    """(m,) the segment with which each limb's start turns; the body's own is its first."""
    first = np.array([limb.segments[0] for limb in figure.limbs])
    return np.asarray(np.maximum(figure.hangs[first], 0))


def _rest_of_carriers(figure: Figure) -> Floats:
    return np.asarray((figure.rest @ figure.turns)[_carriers(figure)])


def back_through(
    figure: Figure, pose: Posed, gradient: Floats, length: Floats
) -> tuple[Floats, Floats, Floats, Floats]:
    """Gradients by root (t, 2), angles (t, s), length (s,) and apart (m, 2) from that by joints."""
    by_vector = np.einsum("tjc,sj->tsc", gradient, figure.reaches)
    by_start = np.einsum("tjc,mj->tmc", gradient, figure.moved)
    turned = np.stack([-pose.vectors[..., 1], pose.vectors[..., 0]], axis=-1)
    by_absolute = (by_vector * turned).sum(axis=-1)
    carriers = _carriers(figure)
    turned_start = np.stack([-pose.starts[..., 1], pose.starts[..., 0]], axis=-1)
    by_carrier = (by_start * turned_start).sum(axis=-1)
    onto = np.zeros((len(carriers), by_absolute.shape[1]))
    onto[np.arange(len(carriers)), carriers] = 1.0
    by_absolute = by_absolute + by_carrier @ onto
    by_length = ((by_vector * pose.vectors).sum(axis=-1) / length).sum(axis=0)
    absolute = np.arctan2(pose.vectors[..., 1], pose.vectors[..., 0])
    carrier = absolute[:, carriers] - _rest_of_carriers(figure)
    cos, sin = np.cos(carrier), np.sin(carrier)
    by_apart = np.stack(
        [
            (cos * by_start[..., 0] + sin * by_start[..., 1]).sum(axis=0),
            (-sin * by_start[..., 0] + cos * by_start[..., 1]).sum(axis=0),
        ],
        axis=-1,
    )
    return gradient.sum(axis=1), by_absolute @ figure.turns.T, by_length, by_apart
