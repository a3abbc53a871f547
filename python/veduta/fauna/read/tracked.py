"""The axis of an animal through its frames, however it was found, and the document from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.schema import Animal, Body, Length, Motion, Origin, Slice, Source
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
from veduta.fauna.read.second_view import SecondLooks, SecondView, thickness
from veduta.fauna.read.usual import USUAL_LENGTH_M, usual_slices
from veduta.run.errors import NotFoundError

SAMPLES = 100
"""Steps along the axis; about as many points as the paper takes."""
_FEWEST_FRAMES = 5
_MOST_STRAY = 0.25
"""A frame whose axis is longer or shorter than the usual by this share is no good frame."""
_SLOWEST = 0.02
"""Slower than so many body lengths a second, the footage shows no way of going."""
_THINNEST = 5e-4
"""Half of how thick a slice is at least, in lengths."""
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
    """The document, and what it was made from: the good frames, and their axes in body lengths."""

    animal: Animal
    tracked: Tracked
    axes: Floats
    angles: Floats
    states: Complexes


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
    if len(tracked.points) < _FEWEST_FRAMES:
        raise NotFoundError(
            "the animal's motion",
            f"only {len(tracked.points)} frames show its axis",
            f"Give footage in which at least {_FEWEST_FRAMES} frames show it whole.",
        )
    axes = equal_steps(tracked.points, SAMPLES + 1)
    lengths = _lengths(tracked.points)
    usual = float(np.median(lengths))
    angles = axis_angles(axes)
    states = coefficients(angles)
    again = axis_of(angles_of(states, SAMPLES))
    apart = np.linalg.norm(again - axis_of(angles), axis=2).mean()
    kind = _kind(options)
    length, of_length = _length(usual, lengths, tracked.unit, options)
    speed, seen, of_speed = _speed(tracked, usual, options)
    body, of_body = _body(tracked, usual, kind, second)
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


def _kind(options: FaunaOptions) -> Limbless:
    """The kind; one with limbs has no midline of its own, and is described as a snake's is."""
    return options.animal.limbless or "snake"


def _lengths(points: Floats) -> Floats:
    return np.asarray(np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1))


def _without_strays(tracked: Tracked) -> Tracked:
    """Leave out the frames whose axis is not as long as in the others."""
    lengths = _lengths(tracked.points)
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


def _length(
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
    assumed = USUAL_LENGTH_M[_kind(options)]
    doubt = (
        f"nothing in the footage tells how long the animal is: {assumed:g} m was assumed"
        " (--length-m)"
    )
    return Length(metres=assumed, provenance="invented", score=0.0), [doubt]


def _speed(
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
    assumed = _USUAL_SPEED[_kind(options)]
    doubt = (
        f"the animal stays in its place in the footage: {assumed:g} body lengths a second were"
        " assumed (--speed)"
    )
    return assumed, "invented", [doubt]


def _body(
    tracked: Tracked, usual: float, kind: Limbless, second: SecondView | None
) -> tuple[Body, list[str]]:
    """Elliptic slices: widths and heights as measured where they are, else by the kind's shape;
    and doubts of what was not.
    """
    doubts: list[str] = []
    slices = usual_slices(kind)
    places = np.array([piece.at for piece in slices])
    width = np.array([piece.half_width for piece in slices])
    ratio = np.array([piece.half_height / piece.half_width for piece in slices])
    widths: Origin = "invented"
    heights: Origin = "invented"
    score = 0.0
    half = tracked.half_widths
    if half is None or not np.isfinite(half).any():
        doubts.append("the record has no widths: the slices are those of the kind")
    else:
        seen = np.isfinite(half).any(axis=0)
        steps = _even(half.shape[1])
        median = np.interp(steps, steps[seen], np.nanmedian(half[:, seen], axis=0) / usual)
        apart = np.nanmedian(np.abs(half[:, seen] / usual - median[seen]), axis=0).mean()
        score = float(np.clip(1.0 - apart / max(median.mean(), 1e-9), 0.0, 1.0))
        width = np.maximum(np.interp(places, _even(len(median)), median), _THINNEST)
        widths = "measured"
    height = width * ratio
    if second is not None:
        across = thickness(second, np.interp(_even(SAMPLES), places, width), SecondLooks())
        height = np.maximum(np.interp(places, _even(len(across.half)), across.half), _THINNEST)
        heights = "measured"
        score = across.score if widths == "invented" else min(score, across.score)
        if not across.is_sure:
            doubts.append("which end of the second view is the head is not clear")
    elif widths == "measured":
        doubts.append(
            "one view does not show how high the animal is: the kind's shape was taken"
            " (--second-view)"
        )
    found = [
        Slice(at=float(at), half_width=float(wide), half_height=float(high))
        for at, wide, high in zip(places, width, height, strict=True)
    ]
    return Body(slices=found, widths=widths, heights=heights, score=score), doubts


def _even(count: int) -> Floats:
    """So many equal steps from head to tail."""
    return np.linspace(0.0, 1.0, count)
