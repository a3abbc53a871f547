"""A gait of the document as poses through a cycle: bounded swings, springs, planted feet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.document.limbed import LimbedAnimal, LimbedGait, Swing
from veduta.fauna.motion.figure import Figure, Floats
from veduta.fauna.motion.planting import planted_cycle

KEYS = 48


@dataclass(frozen=True)
class Spring:
    """What an ear or a beard hangs on: it swings by itself so fast, and comes to rest."""

    hertz: float = 2.6
    damping: float = 0.25
    """Of the critical one."""
    drive: float = 0.6
    """How far its root's turning carries it along, of a stiff one."""


@dataclass(frozen=True, eq=False)
class Stride:
    """times_s: (t,) of a cycle, the last of them its end. turns: (t, s). root: (t, 2) in lengths,
    without the way. lift: (t, f) 0..1, how far in its swing each foot is, 0 while it stands.
    stride: lengths in the cycle. slides: how far a standing foot is from its place, at worst.
    steps: the phases between which each foot stands.
    """

    name: str
    times_s: Floats
    turns: Floats
    root: Floats
    lift: Floats
    stride: float
    slides: float
    steps: dict[str, tuple[float, float]]


def stride_of(
    animal: LimbedAnimal, figure: Figure, gait: LimbedGait, spring: Spring | None = None
) -> Stride:
    """The cycle of a gait, with its feet planted."""
    phase = np.arange(KEYS) / KEYS
    names = figure.segments
    turns = np.zeros((KEYS, len(names)))
    for swing in gait.swings:
        if swing.segment in names:
            turns[:, names.index(swing.segment)] = swung(swing, phase)
    _hang(figure, turns, gait.cycle_s, spring or Spring())
    side = animal.plan.view == "side"
    stand = animal.plan.parts[0].points[0]
    root = np.tile(np.array(stand), (KEYS, 1))
    root[:, 1] += swung(gait.rise, phase)
    steps = {step.limb: (step.down, step.up) for step in gait.feet}
    planted = planted_cycle(figure, turns, root, gait.stride, steps, side=side)
    lift = np.zeros((KEYS, len(figure.feet())))
    for column, limb in enumerate(figure.feet()):
        if limb.name in planted.steps:
            down, up = planted.steps[limb.name]
            share = ((phase - up) % 1.0) / max((down - up) % 1.0, 1e-9)
            lift[:, column] = np.where(share < 1.0, np.sin(np.pi * np.clip(share, 0.0, 1.0)), 0.0)
    times = np.linspace(0.0, gait.cycle_s, KEYS + 1)
    again = np.concatenate([np.arange(KEYS), [0]])
    return Stride(
        gait.name, times, planted.turns[again], planted.root[again], lift[again], gait.stride,
        planted.worst, planted.steps,
    )  # fmt: skip


def swung(swing: Swing, phase: Floats) -> Floats:
    """(t,) a segment's turn at phases (t,), never beyond its bounds."""
    turn = 2.0 * np.pi * phase[:, None] * np.arange(1, len(swing.cos) + 1)
    sum_ = np.cos(turn) @ np.array(swing.cos) + np.sin(turn) @ np.array(swing.sin)
    return np.asarray(np.clip(sum_, swing.low, swing.high))


def _hang(figure: Figure, turns: Floats, cycle_s: float, spring: Spring) -> None:
    """What swings and is small is no matter of silhouettes: a damped spring moves it, in place.

    The periodic answer of x'' + 2 z w x' + w^2 x = -(the root's turning)'', harmonic by harmonic.
    """
    absolute = turns @ figure.turns
    own = 2.0 * np.pi * spring.hertz
    omega = 2.0 * np.pi * np.fft.rfftfreq(len(turns), d=cycle_s / len(turns))
    answer = spring.drive * omega**2 / (own**2 - omega**2 + 2j * spring.damping * own * omega)
    for limb in figure.limbs:
        if limb.part.swings and len(limb.segments) <= 2:
            carrier = absolute[:, figure.hangs[limb.segments[0]]]
            moved = np.fft.irfft(answer * np.fft.rfft(carrier - carrier.mean()), n=len(turns))
            turns[:, list(limb.segments)] = moved[:, None] / len(limb.segments)
