"""Feet planted by inverse kinematics: what stands stays where it came down, on the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats, Limb, posed

_ROUNDS = 30
_NEAR = 1e-3
"""A foot so near to its place (lengths) is there."""
_LOWER = 0.03
"""The body comes down by so much at most; then feet stand for less long, but not less than"""
_SHORTEST = 0.25
"""of a cycle."""
_DAMPING = 1e-6
"""In squared lengths: where a leg is stretched its joints do not run wild."""


@dataclass(frozen=True, eq=False)
class Planted:
    """turns: (t, s) corrected. root: (t, 2). worst: the farthest that a foot is from its place.
    steps: the phases at which each foot comes down and goes up, those that are out of reach
    trimmed.
    """

    turns: Floats
    root: Floats
    worst: float
    steps: dict[str, tuple[float, float]]


def phases_down(down: float, up: float, phase: Floats) -> NDArray[np.bool_]:
    """Whether a foot that comes down and goes up at these phases stands."""
    return np.asarray((phase - down) % 1.0 <= (up - down) % 1.0)


def _stands(step: tuple[float, float], count: int) -> bool:
    return bool(phases_down(*step, np.arange(count) / count).any())


def planted_cycle(
    figure: Figure, turns: Floats, root: Floats, stride: float,
    steps: dict[str, tuple[float, float]], *, side: bool,
) -> Planted:  # fmt: skip
    """A cycle in which no standing foot slides or sinks.

    turns: (t, s) of equal steps of a cycle, from how it stands. root: (t, 2), in lengths, without
    the way forwards. steps: the phases of each foot's coming down and going up. side: whether the
    plane's y goes up; else it goes to the left. The body comes down a little if its feet need it.
    A foot that stands at none of the steps is left to swing.
    """
    steps = {name: step for name, step in steps.items() if _stands(step, len(turns))}
    lowered, now, worst = root.copy(), turns.copy(), 0.0
    for _ in range(4):
        now, offs = turns.copy(), [0.0]
        for limb in figure.feet():
            if limb.name in steps:
                step = steps[limb.name]
                now, off = _planted(figure, now, lowered, stride, limb, step, side=side)
                offs.append(float(off.max()))
        worst, down = max(offs), float(root[0, 1] - lowered[0, 1])
        if worst < _NEAR or not side or down >= _LOWER - 1e-9:
            break
        lowered = lowered - np.array([0.0, min(worst, _LOWER - down)])
    if worst < _NEAR:
        return Planted(now, lowered, worst, steps)
    now, worst = turns.copy(), 0.0
    for limb in figure.feet():
        if limb.name in steps:
            now, far, steps[limb.name] = _trimmed(
                figure, now, lowered, stride, limb, steps[limb.name], side=side
            )
            worst = max(worst, far)
    return Planted(now, lowered, worst, steps)


def _planted(
    figure: Figure, turns: Floats, root: Floats, stride: float, limb: Limb,
    step: tuple[float, float], *, side: bool,
) -> tuple[Floats, Floats]:  # fmt: skip
    """turns with one foot planted, and (t,) how far it is from its place while it stands."""
    phase = np.arange(len(turns)) / len(turns)
    wanted = _wanted(figure, turns, root, stride, limb, step, phase, side)
    found, off = reached(figure, turns, root, limb, wanted)
    return found, np.where(phases_down(*step, phase), off, 0.0)


def _trimmed(
    figure: Figure, turns: Floats, root: Floats, stride: float, limb: Limb,
    step: tuple[float, float], *, side: bool,
) -> tuple[Floats, float, tuple[float, float]]:  # fmt: skip
    """As `_planted`; a foot out of its leg's reach comes down later or goes up earlier."""
    down, up = step
    key = 1.0 / len(turns)
    while True:
        found, off = _planted(figure, turns, root, stride, limb, (down, up), side=side)
        duty = (up - down) % 1.0
        if off.max() < _NEAR or duty < _SHORTEST:
            return found, float(off.max()), (down, up)
        since = (float(off.argmax()) * key - down) % 1.0
        if since < 0.5 * duty:
            down = (down + key) % 1.0
        else:
            up = (up - key) % 1.0


def _wanted(
    figure: Figure, turns: Floats, root: Floats, stride: float, limb: Limb,
    step: tuple[float, float], phase: Floats, side: bool,
) -> Floats:  # fmt: skip
    """(t, 2) where the foot is to be, from the figure's origin, which goes with the animal."""
    toe = limb.joints[-1]
    at = _joints(figure, turns, root)[:, toe]
    down, up = step
    duty = (up - down) % 1.0
    since = (phase - down) % 1.0
    stands = since <= duty
    carried = at[:, 0] + stride * since
    sole = float(figure.deep[toe]) if side else float(at[stands, 1].mean())
    spot = np.array([float(carried[stands].mean()), sole])
    there = np.stack([spot[0] - stride * since, np.full(len(phase), spot[1])], axis=1)
    off = there - at
    order = np.argsort(since, kind="stable")
    known = order[stands[order]]
    first, last = off[known[0]], off[known[-1]]
    share = np.clip((since - duty) / max(1.0 - duty, 1e-9), 0.0, 1.0)
    ease = (share * share * (3.0 - 2.0 * share))[:, None]
    wanted = np.where(stands[:, None], there, at + last + (first - last) * ease)
    if side:
        clear = sole + 0.02 * np.sin(np.pi * share)
        wanted[:, 1] = np.where(stands, sole, np.maximum(wanted[:, 1], clear))
    return np.asarray(wanted)


def _joints(figure: Figure, turns: Floats, root: Floats) -> Floats:
    return posed(figure, root, figure.rest + turns, figure.length, figure.apart).joints


def reached(
    figure: Figure, turns: Floats, root: Floats, limb: Limb, wanted: Floats
) -> tuple[Floats, Floats]:
    """turns (t, s) with which a limb's end is at the places wanted (t, 2), and (t,) how far off.

    Damped least squares over the limb's joints; they change as little as they can.
    """
    found, rows = turns.copy(), list(limb.segments)
    starts, toe = list(limb.joints[:-1]), limb.joints[-1]
    for _ in range(_ROUNDS):
        joints = _joints(figure, found, root)
        off = wanted - joints[:, toe]
        arm = joints[:, toe, None] - joints[:, starts]
        moves = np.stack([-arm[..., 1], arm[..., 0]], axis=1)
        square = moves @ moves.transpose(0, 2, 1) + _DAMPING * np.eye(2)
        step = np.linalg.solve(square, off[..., None])
        change = (moves.transpose(0, 2, 1) @ step)[..., 0]
        found[:, rows] += np.clip(change, -0.3, 0.3)
    off = wanted - _joints(figure, found, root)[:, toe]
    return found, np.asarray(np.linalg.norm(off, axis=1))
