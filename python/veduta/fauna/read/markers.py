"""Painted markers on the animal: their colours are found in the frames, and followed."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.joints import MarkedJoints
from veduta.fauna.read.silhouettes import Masks
from veduta.run.errors import InputError, NotFoundError
from veduta.run.inputs import require_file

_MOST_BYTES = 1_000_000
_REMEDY = 'Write a line for each joint, such as `nose = "#ff3020"`; docs/fauna.md says how.'
_ONE_FRAME = "Say where each of them is in one frame: `at = [x, y]`, `frame = 0`."
_UNSEEN = 1e6
"""More than any distance in a picture: what is too far away is not the same marker."""


@dataclass(frozen=True)
class MarkerLooks:
    """What a painted marker is in the frames."""

    colour: float = 26.0
    """So far a pixel's colour may be from the paint's (CIE a, b; lightness counts by `light`)."""
    light: float = 0.25
    """Paint is now lit, now in shadow."""
    least_px: int = 3
    """A smaller spot is noise."""
    beside: float = 0.06
    """A marker lies on the silhouette, or so far beside it, in its size."""
    reach: float = 0.09
    """It moves so far between two frames at most, in the animal's size; each frame in which it was
    hidden adds as much, up to"""
    lost: float = 0.35
    """this."""


@dataclass(frozen=True)
class Marker:
    """joint: of the body plan. colour: sRGB. at: where it is in `frame` (px), if that is told."""

    joint: str
    colour: tuple[int, int, int]
    at: tuple[float, float] | None = None
    frame: int = 0


def read_markers(path: Path, joints: Sequence[str]) -> tuple[Marker, ...]:
    """The markers in a TOML file; InputError where one is of no joint, or two look the same."""
    try:
        require_file(path, _MOST_BYTES)
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(path, f"is no TOML: {error}", _REMEDY) from error
    if not content:
        raise InputError(path, "names no marker", _REMEDY)
    unknown = [name for name in content if name not in joints]
    if unknown:
        listed = ", ".join(joints[:12])
        fault = f"names {unknown[0]!r}, and the body plan has no such joint"
        raise InputError(path, fault, f"Its joints are {listed}, ...")
    markers = tuple(_marker(path, name, told) for name, told in content.items())
    for marker in markers:
        alike = [one for one in markers if one.colour == marker.colour]
        if len(alike) > 1 and any(one.at is None for one in alike):
            fault = f"has several markers of one colour, {marker.joint} and {alike[-1].joint}"
            raise InputError(path, fault, _ONE_FRAME)
        other = next((one for one in alike if one.frame != marker.frame), None)
        if other is not None:
            first = f"has {marker.joint} in frame {marker.frame}"
            fault = f"{first} and {other.joint}, of the same colour, in frame {other.frame}"
            raise InputError(path, fault, _ONE_FRAME)
    return markers


def _marker(path: Path, name: str, told: Any) -> Marker:
    entry = told if isinstance(told, dict) else {"colour": told}
    extra = set(entry) - {"colour", "at", "frame"}
    colour, at, frame = entry.get("colour"), entry.get("at"), entry.get("frame", 0)
    if extra or not isinstance(colour, str) or not re.fullmatch(r"#[0-9a-fA-F]{6}", colour):
        raise InputError(path, f"has no colour such as #ff3020 for {name}", _REMEDY)
    if not isinstance(frame, int) or isinstance(frame, bool) or frame < 0:
        raise InputError(path, f"has a frame for {name} that is no number of one", _REMEDY)
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    place: tuple[float, float] | None = None
    if at is not None:
        if not (isinstance(at, list) and len(at) == 2 and all(_is_number(one) for one in at)):
            raise InputError(path, f"says where {name} is by something else than [x, y]", _REMEDY)
        place = (float(at[0]), float(at[1]))
    return Marker(name, (red, green, blue), place, frame)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


@dataclass(frozen=True, eq=False)
class _Spots:
    """places: (k, 2) px. size: (k,) px of area, each counted by how near its colour is."""

    places: Floats
    size: Floats


def tracked_markers(
    frames: NDArray[np.uint8], masks: Masks, rows: NDArray[np.int64], markers: Sequence[Marker],
    looks: MarkerLooks, name: str,
) -> MarkedJoints:  # fmt: skip
    """Where each marker is: (t, 2) px in all frames (t, h, w, 3), NaN where it is not seen.

    masks: (g, h, w) of the good frames, which are `rows` of all; others are not looked at.
    unknown: the markers that are never seen. NotFoundError where that is each of them.
    """
    size = float(np.sqrt(np.median(masks.sum(axis=(1, 2)))))
    size = max(size, float(np.median(masks.any(axis=1).sum(axis=1))))
    spots: dict[tuple[int, int, int], list[_Spots]] = {one.colour: [] for one in markers}
    wide = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (3, 3))
    for mask, row in zip(masks, rows, strict=True):
        around = max(1, round(looks.beside * size))
        near = cv2.dilate(mask.astype(np.uint8), wide, iterations=around) > 0
        lab = cv2.cvtColor(frames[row].astype(np.float32) / 255.0, cv2.COLOR_RGB2LAB)
        for colour, found in spots.items():
            found.append(_spots(lab, near, colour, looks))
    places: dict[str, Floats] = {}
    for colour, found in spots.items():
        group = [one for one in markers if one.colour == colour]
        for one, track in zip(group, _followed(found, rows, group, size, looks), strict=True):
            whole = np.full((len(frames), 2), np.nan)
            whole[rows] = track
            places[one.joint] = whole
    unseen = tuple(joint for joint, track in places.items() if not np.isfinite(track).any())
    if len(unseen) == len(places):
        raise NotFoundError(
            "markers",
            f"no frame of {name} shows one of their colours on the animal",
            "Take the colours from a frame: light and camera change those of the paint.",
        )
    return MarkedJoints({joint: at for joint, at in places.items() if joint not in unseen}, unseen)


def _spots(
    lab: NDArray[np.float32], near: NDArray[np.bool_], colour: tuple[int, int, int],
    looks: MarkerLooks,
) -> _Spots:  # fmt: skip
    """The spots of a colour; where each is: the mean of its pixels by how near their colour is."""
    paint = cv2.cvtColor(np.array([[colour]], dtype=np.float32) / 255.0, cv2.COLOR_RGB2LAB)[0, 0]
    away = lab - paint
    apart = np.sqrt(away[..., 1] ** 2 + away[..., 2] ** 2 + (looks.light * away[..., 0]) ** 2)
    closeness = np.where(near, np.clip(1.0 - apart / looks.colour, 0.0, 1.0), 0.0)
    count, labels = cv2.connectedComponents((closeness > 0.0).astype(np.uint8), connectivity=8)
    if count < 2:
        return _Spots(np.zeros((0, 2)), np.zeros(0))
    ys, xs = np.nonzero(labels)
    own, weight = labels[ys, xs], closeness[ys, xs].astype(np.float64)
    total = np.bincount(own, weight, count)[1:]
    area = np.bincount(own, minlength=count)[1:]
    x = np.bincount(own, weight * (xs + 0.5), count)[1:] / np.maximum(total, 1e-12)
    y = np.bincount(own, weight * (ys + 0.5), count)[1:] / np.maximum(total, 1e-12)
    kept = area >= looks.least_px
    size: Floats = np.asarray(total[kept], dtype=np.float64)
    return _Spots(np.stack([x, y], axis=1)[kept], size)


def _followed(
    spots: list[_Spots], rows: NDArray[np.int64], group: list[Marker], size: float,
    looks: MarkerLooks,
) -> list[Floats]:  # fmt: skip
    """Tracks (g, 2) of markers of one colour, forwards and backwards from where they are known."""
    first, begun = _begun(spots, rows, group, size, looks)
    tracks = [np.full((len(spots), 2), np.nan) for _ in group]
    for way in (1, -1):
        last, speed = begun.copy(), np.zeros_like(begun)
        hidden = np.zeros(len(group))
        at = first
        while 0 <= at < len(spots):
            wanted = last + speed * (hidden + 1.0)[:, None] * (at != first)
            chosen = _matched(spots[at], wanted, hidden, size, looks)
            for own, spot in chosen.items():
                here = spots[at].places[spot]
                if at != first:
                    gone = (here - last[own]) / (hidden[own] + 1.0)
                    speed[own] = 0.5 * speed[own] + 0.5 * gone
                last[own], tracks[own][at] = here, here
            hidden = np.array(
                [0.0 if own in chosen else hidden[own] + 1.0 for own in range(len(group))]
            )
            at += way
    return tracks


def _begun(
    spots: list[_Spots], rows: NDArray[np.int64], group: list[Marker], size: float,
    looks: MarkerLooks,
) -> tuple[int, Floats]:  # fmt: skip
    """The frame in which markers are known first, and where they are there."""
    told = [one.at for one in group if one.at is not None]
    if len(told) == len(group):
        first = int(np.abs(rows - group[0].frame).argmin())
        return first, np.array(told)
    most = [float(one.size.max()) if len(one.size) else 0.0 for one in spots]
    first = int(np.argmax(most))
    if most[first] <= 0.0:
        return 0, np.full((1, 2), _UNSEEN)
    return first, spots[first].places[[int(spots[first].size.argmax())]].copy()


def _matched(
    spots: _Spots, wanted: Floats, hidden: Floats, size: float, looks: MarkerLooks
) -> dict[int, int]:
    """Which spot each marker is: those that are nearest all together, none out of reach."""
    if not len(spots.places):
        return {}
    apart = np.linalg.norm(wanted[:, None] - spots.places[None], axis=2)
    reach = np.minimum(looks.reach * (hidden + 1.0), looks.lost) * size
    # Of two spots as near the larger one is rather the marker.
    cost = apart - 0.1 * reach[:, None] * np.log(np.maximum(spots.size, 1.0))[None]
    cost = np.where(apart <= reach[:, None], cost, _UNSEEN)
    own, chosen = linear_sum_assignment(cost)
    return {
        int(mine): int(spot)
        for mine, spot in zip(own, chosen, strict=True)
        if apart[mine, spot] <= reach[mine]
    }
