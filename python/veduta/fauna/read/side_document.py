"""The document of an animal without limbs that was seen from the side."""

from __future__ import annotations

import numpy as np

from veduta.fauna.document.schema import Animal, Motion, Source
from veduta.fauna.motion.angles import Floats, axis_angles, coefficients, equal_steps
from veduta.fauna.options import FaunaOptions, Limbless
from veduta.fauna.read.from_side import Beat, headed, seen_length, shown_whole, tail_beat
from veduta.fauna.read.second_view import SecondView
from veduta.fauna.read.slices import body_of
from veduta.fauna.read.tracked import (
    SAMPLES,
    Described,
    Tracked,
    kind_of,
    length_of,
    lengths_of,
    require_frames,
    speed_of,
)
from veduta.fauna.read.usual import USUAL_BEAT_HZ, usual_angles

_PHASES = 24
"""States of a beat."""
_BEATS = 2
_BENDS = 0.1
"""An axis whose angles vary by more over time (rad) bends up and down."""


def describe_from_side(
    tracked: Tracked,
    areas: Floats,
    name: str,
    source: Source,
    options: FaunaOptions,
    second: SecondView | None = None,
) -> Described:
    """Length and heights as seen, the wave of its kind; NotFoundError where too few frames show it.

    areas: (t,) of its silhouettes, px. second: what shows how wide it is, if there is such a
    record.
    """
    every = tracked.frame
    tracked, looks_right = shown_whole(*headed(tracked))
    require_frames(tracked)
    areas = areas[np.isin(every, tracked.frame)]
    usual = seen_length(tracked)
    kind = kind_of(options)
    seen = np.stack([lengths_of(tracked.points), areas])
    beat = tail_beat(seen, np.asarray(tracked.frame * tracked.frame_s, dtype=np.float64))
    length, of_length = length_of(usual, lengths_of(tracked.points), tracked.unit, options)
    speed, known, of_speed = speed_of(tracked, usual, options)
    body, of_body = body_of(tracked.half_widths, usual, kind, second, from_side=True)
    motion = _wave_of(kind, beat).model_copy(update={"speed": speed, "speed_provenance": known})
    axes = equal_steps(tracked.points, SAMPLES + 1)
    animal = Animal(
        name=name,
        kind=kind,
        source=source.model_copy(update={"used": len(axes), "left_out": list(tracked.left_out)}),
        length=length,
        body=body,
        motion=motion,
        doubts=[*of_length, *of_speed, *_of_motion(kind, beat, axes), *of_body],
    )
    states = motion.columns()
    angles = usual_angles(kind, np.arange(len(states)) / _PHASES, SAMPLES)
    return Described(animal, tracked, axes / usual, angles, states, looks_right)


def _wave_of(kind: Limbless, beat: Beat | None) -> Motion:
    """Two beats of the kind's wave as states."""
    hertz = USUAL_BEAT_HZ[kind] if beat is None else beat.frequency_hz
    phase = np.arange(_BEATS * _PHASES + 1) / _PHASES
    states = coefficients(usual_angles(kind, phase, SAMPLES))
    return Motion(
        frame_s=1.0 / (hertz * _PHASES),
        states=np.stack([states.real, states.imag], axis=-1).round(9).tolist(),
        frame=list(range(len(states))),
        provenance="invented" if beat is None else "inferred",
        score=0.0 if beat is None else min(1.0, beat.share),
        speed=1.0,
        speed_provenance="invented",
    )


def _of_motion(kind: Limbless, beat: Beat | None, axes: Floats) -> list[str]:
    often = (
        f"no beat was seen, and {USUAL_BEAT_HZ[kind]:g} a second were assumed"
        if beat is None
        else f"{beat.frequency_hz:.2g} beats a second are by how much shorter it seems in each"
    )
    told = [
        f"from the side one does not see how far it swings: its wave is that of a {kind}; {often}"
    ]
    angles = axis_angles(axes)
    bends = angles - angles.mean(axis=1, keepdims=True)
    if float(bends.std(axis=0).mean()) > _BENDS:
        told.append("it bends up and down in the footage, which was left out")
    return told
