"""Clips of a skeleton with limbs from strides: turns in the plane that was seen, and root motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.limbed_skeleton import Bones
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.motion.figure import Floats, Limb
from veduta.fauna.motion.joined import Joined
from veduta.fauna.motion.stride import Stride
from veduta.place.skin import Clip, Contact

_LIFT_RAD = 0.35
"""A leg that was seen from above is lifted by so much in its swing: no view shows how far."""


def stride_clip(stride: Stride, bones: Bones, animal: LimbedAnimal) -> Clip:
    """The clip of a cycle: the root goes along x at an even pace, the body over it."""
    way = stride.times_s / stride.times_s[-1] * stride.stride
    clip = _clip(stride.name, stride.times_s, stride, way, bones, animal, loops=True)
    end = float(stride.times_s[-1])
    contacts = [
        _contact(bones, limb, _spans_of(stride.steps[limb.name], end))
        for limb in bones.figure.feet()
        if limb.name in stride.steps
    ]
    return replace(clip, contacts=tuple(contacts))


def joined_clip(joined: Joined, bones: Bones, animal: LimbedAnimal) -> Clip:
    """The clip of several gaits, the root as fast as each of them."""
    stride = joined.stride
    clip = _clip(stride.name, stride.times_s, stride, joined.way, bones, animal, loops=True)
    contacts = [
        _contact(bones, limb, _spans_in(joined.down[:, column], stride.times_s))
        for column, limb in enumerate(bones.figure.feet())
    ]
    return replace(clip, contacts=tuple(contacts))


def _contact(bones: Bones, limb: Limb, spans: list[tuple[float, float]]) -> Contact:
    names, last = bones.figure.segments, limb.segments[-1]
    x, y, z = (round(float(value), 6) for value in bones.end_m[last] - bones.start_m[last])
    leg = tuple(names[segment] for segment in limb.segments)
    return Contact(limb.name, names[last], tuple(spans), leg, (x, y, z))


def _spans_of(step: tuple[float, float], end_s: float) -> list[tuple[float, float]]:
    """When a foot stands in a cycle (s)."""
    down, up = (round(phase * end_s, 6) for phase in step)
    return [(down, up)] if down < up else [(0.0, up), (down, end_s)]


def _spans_in(down: NDArray[np.bool_], times: Floats) -> list[tuple[float, float]]:
    """When a foot stands, from a row for each time."""
    change = np.diff(np.concatenate([[0], down.astype(np.int8), [0]]))
    begin, end = np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1
    return [(float(times[a]), float(times[b])) for a, b in zip(begin, end, strict=True) if b > a]


def footage_clip(animal: LimbedAnimal, bones: Bones, speed: float) -> Clip | None:
    """The footage's own motion; None where it has less than two frames. speed: lengths a second."""
    poses = animal.poses
    if len(poses.frame) < 2:
        return None
    names = bones.figure.segments
    turns = np.zeros((len(poses.frame), len(names)))
    columns = np.array(poses.turns)
    for column, name in enumerate(poses.segments):
        if name in names:
            turns[:, names.index(name)] = columns[:, column]
    times = (np.array(poses.frame, dtype=np.float64) - poses.frame[0]) * poses.frame_s
    stand = np.array(animal.plan.parts[0].points[0])
    root = np.tile(stand, (len(times), 1))
    if animal.plan.view == "side":
        root[:, 1] = np.array(poses.root)[:, 1]
    lift = 1.0 - np.array(poses.down, dtype=np.float64).reshape(len(times), -1)
    seen = Stride("footage", times, turns, root, lift, speed * float(times[-1]), 0.0, {})
    clip = _clip("footage", times, seen, speed * times, bones, animal, loops=False)
    stands = np.array(poses.down, dtype=np.bool_).reshape(len(times), -1)
    contacts = [
        _contact(bones, limb, _spans_in(stands[:, poses.feet.index(limb.name)], times))
        for limb in bones.figure.feet()
        if limb.name in poses.feet
    ]
    return replace(clip, contacts=tuple(contacts))


def _clip(
    name: str, times: Floats, stride: Stride, way: Floats, bones: Bones, animal: LimbedAnimal, *,
    loops: bool,
) -> Clip:  # fmt: skip
    figure, length = bones.figure, bones.length_m
    count, total = len(times), len(figure.start) + 1
    moves = np.zeros((count, total, 3))
    moves[:, 0, 0] = way * length
    hangs = figure.hangs
    hanging = np.flatnonzero(hangs >= 0)
    moves[:, hanging + 1] = bones.start_m[hanging] - bones.start_m[hangs[hanging]]
    first = int(np.flatnonzero(hangs < 0)[0])
    moves[:, first + 1] = bones.start_m[first]
    stand = np.array(animal.plan.parts[0].points[0])
    away = (stride.root - stand) * length
    side = animal.plan.view == "side"
    moves[:, first + 1, 0] += away[:, 0]
    moves[:, first + 1, 2 if side else 1] += away[:, 1]
    turns = np.zeros((count, total, 4))
    turns[..., 3] = 1.0
    half = 0.5 * stride.turns
    turns[:, 1:, 3] = np.cos(half)
    # From x towards z is a turn about -y, from x towards y one about z.
    turns[:, 1:, 1 if side else 2] = np.sin(half) * (-1.0 if side else 1.0)
    if not side:
        _lift(turns, stride, bones)
    return Clip(name, times, moves, turns, loops)


def _lift(turns: Floats, stride: Stride, bones: Bones) -> None:
    """Legs that stand out to the sides are lifted about the body's axis, in place."""
    for column, limb in enumerate(bones.figure.feet()):
        joint = limb.segments[0] + 1
        half = 0.5 * _LIFT_RAD * stride.lift[:, column]
        half = half * (1.0 if limb.side == "left" else -1.0)
        about_x, about_z = np.sin(half), turns[:, joint, 2].copy()
        own = turns[:, joint, 3].copy()
        turns[:, joint, 0] = about_x * own
        turns[:, joint, 1] = -about_x * about_z
        turns[:, joint, 2] = np.cos(half) * about_z
        turns[:, joint, 3] = np.cos(half) * own
