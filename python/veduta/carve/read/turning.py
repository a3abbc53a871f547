"""A turntable before one camera: where a ray through one outline misses the other silhouettes.

Frame of the table: its axis is z, the object turns about it, and the camera stands at distance 1
from it. What one photo's outline shows is a point of the object on each ray, which must lie within
all other silhouettes: by so many pixels as it cannot, the angles or the camera are wrong (the
silhouette coherence of Hernandez, Schmitt and Cipolla, 2007).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError

Floats = NDArray[np.float64]
Field = NDArray[np.float32]
Mask = NDArray[np.bool_]
_NEVER = np.float32(-1e6)
"""Px; what holds nothing off."""


@dataclass(frozen=True, eq=False)
class Table:
    """A camera over a turntable.

    focal_px. tilt, roll: of the axis against the photo's upright (rad); tilt is how far the camera
    looks down. aside: the axis's distance from the optical axis, of the distance to it.
    angles: (n,) rad, how far the object has turned in each photo, counter-clockwise from above.
    """

    focal_px: float
    tilt: float
    roll: float
    aside: float
    angles: Floats

    def turn(self) -> Floats:
        """(3, 3) the camera's frame from the table's at angle 0."""
        sine, cosine = np.sin(self.tilt), np.cos(self.tilt)
        level = np.array([[1.0, 0.0, 0.0], [0.0, -sine, -cosine], [0.0, cosine, -sine]])
        roll = np.array(
            [
                [np.cos(self.roll), -np.sin(self.roll), 0.0],
                [np.sin(self.roll), np.cos(self.roll), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )
        return np.asarray(roll @ level)

    def shift(self) -> Floats:
        """(3,) where the table's origin is in the camera's frame."""
        return np.array([self.aside * np.cos(self.roll), self.aside * np.sin(self.roll), 1.0])

    def poses(self) -> Floats:
        """(n, 3, 4) of a camera that goes round an object at rest: camera from table."""
        return np.array(
            [np.column_stack([self.turn() @ about_z(one), self.shift()]) for one in self.angles]
        )


def about_z(angle: float) -> Floats:
    """(3, 3) a turn about z."""
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True, eq=False)
class Outlines:
    """Silhouettes as this needs them, all of one size.

    fields: distances to the outline (px, less than 0 inside). middle: the photo's (px).
    points: (m, 2) px on the outlines, from the middle; of: (m,) of which photo. reach_px: how far
    from the middle the object is seen at most.
    """

    fields: tuple[Field, ...]
    middle: Floats
    points: Floats
    of: NDArray[np.intp]
    reach_px: float


def outlines_of(masks: Sequence[Mask], count: int, largest_px: int) -> tuple[Outlines, float]:
    """Outlines with `count` points each, photos made as small as `largest_px`; by what factor.

    InputError where a silhouette vanishes in so small a photo.
    """
    height, width = masks[0].shape
    factor = min(1.0, largest_px / max(height, width))
    size = (round(width * factor), round(height * factor))
    fields, points, of = [], [], []
    for number, mask in enumerate(masks):
        soft = cv2.resize(mask.astype(np.float32), size, interpolation=cv2.INTER_AREA)
        small = (soft > 0.5).astype(np.uint8)
        if not small.any():
            fault = f"photo {number + 1} shows no silhouette at {max(size)} px"
            remedy = "Take photos in which the object is larger, or crop all of them alike."
            raise InputError("--turntable", fault, remedy)
        inner = cv2.distanceTransform(small, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        outer = cv2.distanceTransform(1 - small, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        fields.append(np.where(small > 0, 0.5 - inner, outer - 0.5).astype(np.float32))
        lines, _ = cv2.findContours(small, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        line = max(lines, key=len)[:, 0].astype(np.float64) + 0.5
        line = line[~_at_border(line, size)]
        chosen = np.linspace(0, len(line), min(count, len(line)), endpoint=False).astype(int)
        points.append(line[chosen])
        of.append(np.full(len(chosen), number))
    middle = np.array(size) / 2.0
    spots = np.concatenate(points) - middle
    reach = float(np.abs(spots).max(initial=1.0))
    return Outlines(tuple(fields), middle, spots, np.concatenate(of), reach), factor


def _at_border(line: Floats, size: tuple[int, int]) -> NDArray[np.bool_]:
    low, high = line.min(axis=1) < 2.0, (line > np.array(size) - 2.0).any(axis=1)
    return np.asarray(low | high, dtype=bool)


@dataclass(frozen=True, eq=False)
class Misses:
    """Of each ray: miss_px (m,), above 0 where it misses. depth: (m,) where it comes nearest.

    photos: (m, 2) the two silhouettes that hold it off there. weights: (m, 2) that balance them, so
    that moving along the ray changes nothing.
    """

    miss_px: Floats
    depth: Floats
    photos: NDArray[np.intp]
    weights: Floats


def misses(table: Table, lines: Outlines, samples: int = 48, rounds: int = 2) -> Misses:
    """How far each ray misses what the other silhouettes leave, and which ones hold it off."""
    reach = min(1.3 * lines.reach_px / table.focal_px, 0.9)
    step = 2.0 * reach / samples
    depth = np.linspace(1.0 - reach, 1.0 + reach, samples + 1)[None].repeat(len(lines.of), axis=0)
    for again in range(rounds + 1):
        worst = np.full(depth.shape, _NEVER, dtype=np.float32)
        for photo in range(len(lines.fields)):
            np.maximum(worst, _of_others(table, lines, depth, photo), out=worst)
        at = depth[np.arange(len(depth)), worst.argmin(axis=1)]
        if again < rounds:
            depth = at[:, None] + np.linspace(-step, step, 9)
            step /= 4.0
    ends = at[:, None] + np.array([-1.0, 0.0, 1.0]) * step
    photos = range(len(lines.fields))
    return _balanced(np.stack([_of_others(table, lines, ends, n) for n in photos], axis=1), at)


def _of_others(table: Table, lines: Outlines, depth: Floats, photo: int) -> Field:
    """(m, s) distances (px) to the silhouette of a photo, of places at depths (m, s) along the rays
    of all others.
    """
    every = np.arange(len(lines.of))
    turned = table.angles[photo] - table.angles[lines.of]
    found = look(table, lines, every, depth, turned, photo)
    found[lines.of == photo] = _NEVER
    return found


def _balanced(each: Field, depth: Floats) -> Misses:
    """each: (m, n, 3) distances just before, at, and just after the nearest place."""
    rows = np.arange(len(depth))
    first = each[:, :, 1].argmax(axis=1)
    slopes = each[:, :, 2] - each[:, :, 0]
    own = slopes[rows, first]
    # The one that holds it off on the other side: the worst whose slope has the other sign.
    other = np.where(slopes * own[:, None] < 0.0, each[:, :, 1], 2.0 * _NEVER)
    second = other.argmax(axis=1)
    steep = slopes[rows, second]
    has = (other[rows, second] > _NEVER) & (steep != own)
    second = np.where(has, second, first)
    share = np.where(has, steep / np.where(has, steep - own, 1.0), 1.0)
    weights = np.stack([share, 1.0 - share], axis=1)
    photos = np.stack([first, second], axis=1)
    values = (weights * each[rows[:, None], photos, 1]).sum(axis=1)
    return Misses(np.asarray(values, np.float64), depth, photos, np.asarray(weights, np.float64))


def held(table: Table, lines: Outlines, found: Misses, which: int, more: float = 0.0) -> Floats:
    """(m,) px: the first or second silhouette's distance once more, of another table or where that
    photo's object has turned by so much more (rad).
    """
    values = np.zeros(len(lines.of))
    photos = found.photos[:, which]
    for photo in range(len(lines.fields)):
        rows = np.flatnonzero(photos == photo)
        if len(rows):
            turned = table.angles[photo] - table.angles[lines.of[rows]] + more
            values[rows] = look(table, lines, rows, found.depth[rows, None], turned, photo)[:, 0]
    return values


def look(
    table: Table,
    lines: Outlines,
    rows: NDArray[np.intp],
    depth: Floats,
    turned: Floats,
    photo: int,
) -> Field:
    """(r, s) distances (px) to a photo's silhouette, of places at depths (r, s) along some rays,
    when the object has turned by (r,) rad since.
    """
    points, field = lines.points[rows], lines.fields[photo]
    turn, shift = table.turn(), table.shift()
    ahead = np.column_stack([points / table.focal_px, np.ones(len(points))])
    sine, cosine = np.sin(turned)[:, None], np.cos(turned)[:, None]

    def moved(vectors: Floats) -> Floats:
        x, y, z = vectors[:, 0:1], vectors[:, 1:2], vectors[:, 2:3]
        return np.concatenate([cosine * x - sine * y, sine * x + cosine * y, z], axis=1) @ turn.T

    # A place is s * ahead - shift about the table's origin: turned, and back before the camera.
    slope = moved(ahead @ turn).astype(np.float32)
    start = moved(np.broadcast_to(-shift @ turn, ahead.shape)) + shift
    x, y, z = (
        slope[:, [n]] * depth.astype(np.float32) + np.float32(start[:, [n]]) for n in range(3)
    )
    scale = np.float32(table.focal_px) / np.maximum(z, np.float32(1e-3))
    x = x * scale + np.float32(lines.middle[0] - 0.5)
    y = y * scale + np.float32(lines.middle[1] - 0.5)
    found = cv2.remap(field, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    # Beyond the photo's border the distance goes on growing, and a silhouette that it cuts goes on.
    height, width = field.shape
    beyond = np.maximum(np.maximum(-x, x - (width - 1)), np.maximum(-y, y - (height - 1)))
    return np.asarray(np.where(found < 0.0, found, found + np.maximum(beyond, 0.0)), np.float32)
