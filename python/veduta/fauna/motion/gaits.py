"""Motions of an axis over time, each on a straight course: the footage's own, and new ones.

All are given as angles against the course and the way of the body's middle, in body lengths.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.motion.angles import Complexes, Floats, angles_of
from veduta.fauna.motion.follow import follow_head, own_share
from veduta.fauna.motion.graph import closed_walk, interpolated, motion_graph
from veduta.fauna.motion.states import StateSampling, draw_states, largest_step, without_turn
from veduta.fauna.motion.wave import Wave

SAMPLES = 100
_RATE_HZ = 30.0
_LEAST_STEP = 1e-3
"""Angles that hardly moved in the footage may move by so much in a frame (rad)."""


@dataclass(frozen=True, eq=False)
class Gait:
    """times_s: (t,) from 0. angles: (t, n) rad, against x. middle: (t, 2) lengths, of the body's
    middle. stride: lengths along x from the first time to the last. loops: the last pose is the
    first. states, refused: of the graph that it was walked in; none else.
    """

    name: str
    times_s: Floats
    angles: Floats
    middle: Floats
    stride: float
    loops: bool
    states: int = 0
    refused: int = 0
    threshold: float = 0.0


def seen_gait(name: str, states: Complexes, times_s: Floats, speed: float) -> Gait:
    """The footage's motion, on a straight course at an even pace. states: (t, 8)."""
    angles = angles_of(without_turn(states), SAMPLES)
    return _evenly(name, times_s - times_s[0], angles, speed, loops=False)


def waved_gait(name: str, wave: Wave, speed: float) -> Gait:
    """One period of a swimmer's wave."""
    period = 1.0 / wave.frequency_hz
    count = max(24, round(period * _RATE_HZ))
    phase = np.linspace(0.0, 1.0, count + 1)
    angles = wave.at(phase)
    return _evenly(name, phase * period, angles - angles.mean(), speed, loops=True)


def roamed_gait(
    name: str, states: Complexes, frame_s: float, sampling: StateSampling, seed: int,
    seconds: float, speed: float, *, follows: bool,
) -> Gait:  # fmt: skip
    """A new motion through the motion graph, closed so that it can be played again and again.

    follows: whether the tail follows the head (9), and the body slides in the head's track.
    """
    seen = without_turn(states)
    drawn = draw_states(seen, sampling, seed)
    graph = motion_graph(np.concatenate([seen, drawn.states]))
    most = np.maximum(largest_step(seen, SAMPLES), _LEAST_STEP)
    start = int(np.random.default_rng(seed).integers(len(seen)))
    steps = 4
    while True:
        frames = interpolated(graph.states, closed_walk(graph, start, steps), most, seed)
        if (len(frames) - 1) * frame_s >= seconds:
            break
        steps *= 2
    angles = angles_of(frames, SAMPLES)
    times = frame_s * np.arange(len(frames), dtype=np.float64)
    if follows:
        gait = _followed(name, times, angles, seen, speed)
    else:
        gait = _resampled(_evenly(name, times, angles, speed, loops=True))
    return Gait(
        gait.name, gait.times_s, gait.angles, gait.middle, gait.stride, gait.loops,
        len(graph.states), drawn.refused, graph.threshold,
    )  # fmt: skip


def _evenly(name: str, times_s: Floats, angles: Floats, speed: float, *, loops: bool) -> Gait:
    """The body's middle goes along x at an even pace."""
    along = speed * times_s
    middle = np.stack([along, np.zeros_like(along)], axis=1)
    return Gait(name, times_s, angles, middle, float(along[-1]), loops)


def _followed(name: str, times_s: Floats, angles: Floats, seen: Complexes, speed: float) -> Gait:
    """The same with the tail after the head, slowly enough that no bend is sharper than was seen.

    In a step of time the body goes on by one point's distance: what is behind the neck slides in
    the neck's track, and the head looks about before it. A head that turns fast bends the body
    behind it sharply: time is then drawn out.
    """
    bends = np.abs(np.diff(angles_of(seen, SAMPLES), axis=1)).max()
    duration = float(times_s[-1])
    found = _after_head(angles, duration * speed)
    for _ in range(4):
        sharper = float(np.abs(np.diff(found, axis=1)).max() / bends)
        if sharper <= 1.0:
            break
        duration *= 1.05 * sharper
        found = _after_head(angles, duration * speed)
    count = len(found)
    heading = np.stack([np.cos(found), np.sin(found)], axis=-1)
    neck = int(np.count_nonzero(own_share(SAMPLES)))
    steps = np.concatenate([heading[1:, neck], heading[:1, neck]])
    way = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)]) / SAMPLES
    closed = np.concatenate([found, found[:1]])
    every = np.concatenate([heading, heading[:1]])
    back = (np.cumsum(every, axis=1) - 0.5 * every) / SAMPLES
    head = way + every[:, :neck].sum(axis=1) / SAMPLES
    middle = head - back.mean(axis=1)
    middle -= middle[0]
    course = float(np.arctan2(middle[-1, 1], middle[-1, 0]))
    turn = np.array([[np.cos(course), np.sin(course)], [-np.sin(course), np.cos(course)]])
    middle = middle @ turn.T
    middle[:, 1] -= middle[:, 1].mean()
    times = np.linspace(0.0, duration, count + 1)
    stride = float(middle[-1, 0])
    return _resampled(Gait(name, times, closed - course, middle, stride, True))


def _after_head(angles: Floats, way: float) -> Floats:
    """A cycle's angles with the tail after the head, a row for each point's distance of the way."""
    count = max(2, round(way * SAMPLES))
    shares = np.linspace(0.0, 1.0, count, endpoint=False) * (len(angles) - 1)
    return follow_head(_rows_at(angles, shares), periodic=True)


def _resampled(gait: Gait) -> Gait:
    """At an even rate that players show, both ends kept."""
    count = max(2, round(float(gait.times_s[-1]) * _RATE_HZ) + 1)
    times = np.linspace(0.0, float(gait.times_s[-1]), count)
    shares = np.interp(times, gait.times_s, np.arange(len(gait.times_s)))
    return Gait(
        gait.name, times, _rows_at(gait.angles, shares), _rows_at(gait.middle, shares),
        gait.stride, gait.loops,
    )  # fmt: skip


def _rows_at(rows: Floats, shares: Floats) -> Floats:
    """Rows at fractional places (t,), on straight lines between their neighbours."""
    before = np.minimum(shares.astype(np.int64), len(rows) - 2)
    part = (shares - before)[:, None]
    return np.asarray(rows[before] * (1.0 - part) + rows[before + 1] * part, dtype=np.float64)
