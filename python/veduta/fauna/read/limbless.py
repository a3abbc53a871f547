"""An animal without limbs in footage from above: its axis and its widths in every good frame."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.read.axis import Axis, medial_axis
from veduta.fauna.read.background import (
    Background,
    BackgroundLooks,
    estimated_background,
    given_background,
)
from veduta.fauna.read.footage import Footage, read_masks
from veduta.fauna.read.silhouettes import (
    SilhouetteLooks,
    Silhouettes,
    differing,
    silhouettes_of,
)
from veduta.fauna.read.tracked import SAMPLES, Tracked
from veduta.imaging.read import read_image
from veduta.run.errors import InputError, NotFoundError


@dataclass(frozen=True, eq=False)
class Seen:
    """silhouettes of the good frames, the axis in each (None: it has none), and the background."""

    silhouettes: Silhouettes
    axes: tuple[Axis | None, ...]
    background: Background | None


def silhouettes_in(
    footage: Footage,
    masks: Path | None,
    background: Path | None,
    name: str,
    *,
    with_cut: bool = False,
) -> tuple[Silhouettes, Background | None]:
    """The animal's silhouettes: from masks, against a given background, or an estimated one.

    with_cut: frames in which the border cuts the animal, too.
    """
    looks = SilhouetteLooks()
    if masks is not None:
        given = footage.on_canvas(read_masks(masks, footage))
        return silhouettes_of(given, looks, name, footage.corners(), with_cut=with_cut), None
    if background is not None:
        pixels = footage.piece(read_image(background).pixels)
        if pixels.shape[:2] != footage.size:
            fault = f"is {pixels.shape[1]} x {pixels.shape[0]} px, and the frames are not"
            raise InputError(background, fault, "Give a picture of the frames' size.")
        behind = given_background(footage.frames, pixels)
    else:
        _require_motion(footage, name)
        behind = estimated_background(footage.frames, BackgroundLooks())
    raw = differing(footage.frames, behind, looks)
    return silhouettes_of(raw, looks, name, footage.corners(), with_cut=with_cut), behind


def axes_in(silhouettes: Silhouettes) -> tuple[Axis | None, ...]:
    """The axis of each silhouette, all from the same end."""
    found: list[Axis | None] = []
    before: Axis | None = None
    for mask in silhouettes.masks:
        axis = medial_axis(mask, SAMPLES + 1)
        if axis is not None and before is not None:
            axis = _same_end(axis, before)
        found.append(axis)
        before = axis or before
    return tuple(found)


def tracked_axes(footage: Footage, seen: Seen) -> Tracked:
    """The axes as `describe` takes them: y upwards, pixels."""
    rows = seen.silhouettes.rows
    good = [place for place, axis in enumerate(seen.axes) if axis is not None]
    if not good:
        raise NotFoundError(
            "the animal's axis",
            "none of its silhouettes is long and narrow",
            "Give footage of an animal without limbs from above, or another --kind.",
        )
    axes = [axis for axis in seen.axes if axis is not None]
    points = np.stack([axis.points for axis in axes])
    points[..., 1] = footage.size[0] - points[..., 1]
    left_out = [
        f"frame {footage.number[row]}: {reason}" for row, reason in seen.silhouettes.left_out
    ]
    left_out += [
        f"frame {footage.number[rows[place]]}: its silhouette has no axis"
        for place, axis in enumerate(seen.axes)
        if axis is None
    ]
    return Tracked(
        points=points,
        frame=footage.number[rows[good]],
        frame_s=footage.frame_s,
        unit="px",
        half_widths=np.stack([axis.half_width for axis in axes]),
        left_out=tuple(left_out),
    )


def _require_motion(footage: Footage, name: str) -> None:
    """NotFoundError where all frames are one picture: nothing parts the animal from the rest."""
    rows: NDArray[np.int16] = footage.frames[:, ::4, ::4].astype(np.int16)
    if int(np.abs(rows - rows[0]).max()) <= 2:
        raise NotFoundError(
            "motion",
            f"all frames of {name} are the same picture",
            "Give footage in which the animal moves.",
        )


def _same_end(axis: Axis, before: Axis) -> Axis:
    there = np.linalg.norm(axis.points - before.points, axis=1).sum()
    back = np.linalg.norm(axis.points[::-1] - before.points, axis=1).sum()
    return axis if there <= back else Axis(axis.points[::-1].copy(), axis.half_width[::-1].copy())
