"""The axis of an animal through its frames, however it was found, and the document from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.schema import Animal, Length, Motion, Origin, Source
from veduta.fauna.motion.angles import (
    Complexes,
    Floats,
    angles_of,
    axis_angles,
    axis_of,
    coefficients,
    equal_steps,
)
from veduta.fauna.options import FaunaOptions, Limbless
from veduta.fauna.read.second_view import SecondView
from veduta.fauna.read.slices import body_of
from veduta.fauna.read.usual import USUAL_LENGTH_M
from veduta.run.errors import NotFoundError

SAMPLES = 100
"""Steps along the axis; about as many points as the paper takes."""
_FEWEST_FRAMES = 5
_MOST_STRAY = 0.25
"""A frame whose axis is longer or shorter than the usual by this share is no good frame."""
_SLOWEST = 0.02
"""Slower than so many body lengths a second, the footage shows no way of going."""
_USUAL_SPEED: dict[Limbless, float] = {"snake": 0.4, "worm": 0.25, "fish": 1.0}


@dataclass(frozen=True, eq=False)
class Tracked:
    """points: (t, n, 2) the axis in each used frame, head first, y upwards, in `unit`.

    frame: (t,) numbers of the frames. frame_s: from one to the next. half_widths: (t, m) beside
    equal steps of the axis, NaN where none was measured; None: the record has none.
    """

    points: Floats
    frame: NDArray[np.int64]
    frame_s: float
    unit: Literal["m", "px"]
    half_widths: Floats | None
    left_out: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Described:
    """The document, and what it was made from: the good frames, and their axes in body lengths.

    looks_right: (t,) of an animal that is seen from the side, in each frame; None: from above.
    """

    animal: Animal
    tracked: Tracked
    axes: Floats
    angles: Floats
    states: Complexes
    looks_right: NDArray[np.bool_] | None = None

    @property
    def from_side(self) -> bool:
        """Whether heights were seen; else widths were."""
        return self.looks_right is not None


def describe(
    tracked: Tracked,
    name: str,
    source: Source,
    options: FaunaOptions,
    second: SecondView | None = None,
) -> Described:
    """The document of a tracked animal; NotFoundError where too few frames show it.

    second: what shows how high it is, if there is such a record.
    """
    tracked = _head_first(_without_strays(tracked))
    require_frames(tracked)
    axes = equal_steps(tracked.points, SAMPLES + 1)
    lengths = lengths_of(tracked.points)
    usual = float(np.median(lengths))
    angles = axis_angles(axes)
    states = coefficients(angles)
    again = axis_of(angles_of(states, SAMPLES))
    apart = np.linalg.norm(again - axis_of(angles), axis=2).mean()
    kind = kind_of(options)
    length, of_length = length_of(usual, lengths, tracked.unit, options)
    speed, seen, of_speed = speed_of(tracked, usual, options)
    body, of_body = body_of(tracked.half_widths, usual, kind, second)
    animal = Animal(
        name=name,
        kind=kind,
        source=source.model_copy(update={"used": len(axes), "left_out": list(tracked.left_out)}),
        length=length,
        body=body,
        motion=Motion(
            frame_s=tracked.frame_s,
            states=np.stack([states.real, states.imag], axis=-1).round(9).tolist(),
            frame=tracked.frame.tolist(),
            provenance="measured",
            score=float(np.clip(1.0 - apart, 0.0, 1.0)),
            speed=speed,
            speed_provenance=seen,
        ),
        doubts=[*of_length, *of_speed, *of_body],
    )
    return Described(animal, tracked, axes / usual, angles, states)


def require_frames(tracked: Tracked) -> None:
    """NotFoundError where too few frames show the animal."""
    if len(tracked.points) < _FEWEST_FRAMES:
        raise NotFoundError(
            "the animal's motion",
            f"only {len(tracked.points)} frames show its axis",
            f"Give footage in which at least {_FEWEST_FRAMES} frames show it whole.",
        )


def kind_of(options: FaunaOptions) -> Limbless:
    """The kind; one with limbs has no midline of its own, and is described as a snake's is."""
    return options.animal.limbless or "snake"


def lengths_of(points: Floats) -> Floats:
    """(t,) of axes (t, n, 2)."""
    return np.asarray(np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1))


def _without_strays(tracked: Tracked) -> Tracked:
    """Leave out the frames whose axis is not as long as in the others."""
    lengths = lengths_of(tracked.points)
    usual = float(np.median(lengths)) if len(lengths) else 0.0
    good = np.abs(lengths - usual) <= _MOST_STRAY * usual
    named = [
        f"frame {number}: its axis is {length / usual:.0%} of the usual length"
        for number, length in zip(tracked.frame[~good], lengths[~good], strict=True)
    ]
    half = tracked.half_widths
    return replace(
        tracked, points=tracked.points[good], frame=tracked.frame[good],
        half_widths=None if half is None else half[good],
        left_out=(*tracked.left_out, *named),
    )  # fmt: skip


def _head_first(tracked: Tracked) -> Tracked:
    """Turn the axis round if the animal goes where the last point is: it goes head first."""
    if len(tracked.points) < 2:
        return tracked
    middle = tracked.points.mean(axis=1)
    towards = tracked.points[:, 0] - tracked.points[:, -1]
    ahead = float((np.diff(middle, axis=0) * towards[:-1]).sum())
    if ahead >= 0.0:
        return tracked
    half = tracked.half_widths
    return replace(
        tracked, points=tracked.points[:, ::-1], half_widths=None if half is None else half[:, ::-1]
    )


def length_of(
    usual: float, lengths: Floats, unit: str, options: FaunaOptions
) -> tuple[Length, list[str]]:
    """From head to tail, and the doubt where it was assumed."""
    spread = float(np.median(np.abs(lengths - usual))) / usual
    score = float(np.clip(1.0 - spread, 0.0, 1.0))
    given = options.animal.length_m
    if given is not None:
        return Length(metres=given, provenance="edited", score=1.0), []
    if unit == "m":
        return Length(metres=usual, provenance="measured", score=score), []
    assumed = USUAL_LENGTH_M[kind_of(options)]
    doubt = (
        f"nothing in the footage tells how long the animal is: {assumed:g} m was assumed"
        " (--length-m)"
    )
    return Length(metres=assumed, provenance="invented", score=0.0), [doubt]


def speed_of(
    tracked: Tracked, usual: float, options: FaunaOptions
) -> tuple[float, Origin, list[str]]:
    """Body lengths a second: the way of the body's middle along its course, over the time; and the
    doubt where it was assumed.
    """
    if options.motion.speed is not None:
        return options.motion.speed, "edited", []
    middle = tracked.points.mean(axis=1)
    seconds = float(tracked.frame[-1] - tracked.frame[0]) * tracked.frame_s
    span = max(1, len(middle) // 8)
    way = float(np.linalg.norm(middle[span:] - middle[:-span], axis=1).sum()) / span
    speed = way / seconds / usual
    if speed >= _SLOWEST:
        return speed, "measured", []
    assumed = _USUAL_SPEED[kind_of(options)]
    doubt = (
        f"the animal stays in its place in the footage: {assumed:g} body lengths a second were"
        " assumed (--speed)"
    )
    return assumed, "invented", [doubt]
