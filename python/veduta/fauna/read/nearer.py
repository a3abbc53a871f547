"""Which leg of a pair is the near one: where both cover each other, the pictures move with it.

Silhouettes do not tell that: where two legs cross they are one. Optical flow inside of them does,
for what is seen there is the near leg's surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats, Limb
from veduta.fauna.read.fit import Fitted
from veduta.fauna.read.windows import Windows

Frames = NDArray[np.uint8]
_EACH = 2
"""Every second pixel is looked at, both ways."""


@dataclass(frozen=True)
class NearerLooks:
    """What counts."""

    apart_px: float = 1.5
    """By so much the motion of two legs must differ where they are compared, frame by frame."""
    inside: float = 0.25
    """A place is a leg's if it is within its outline by this share of its thickness."""
    texture: float = 2.5
    """Grey levels by which neighbouring pixels differ nearby at least, in a picture that is soft by
    `soft_px`: where nothing is to be followed flow is none, which is no leg's that stands.
    """
    soft_px: float = 1.5
    near_px: int = 9
    places: int = 60
    """Of so few nothing is told."""
    sure: float = 0.04
    """Nor where the near leg's motion is nearer to the flow by less than this share of the way
    between both, on the mean.
    """


@dataclass(frozen=True)
class Nearer:
    """Of a pair of legs, by the name of their part. left: by how much the flow is nearer to the
    left one's motion, as a share of the way between both: -1 (all the right one's) to 1. places: so
    many were compared.
    """

    part: str
    left: float
    places: int


def nearer_legs(
    pictures: Frames, fitted: Fitted, windows: Windows, frames: Floats, looks: NearerLooks
) -> list[Nearer]:
    """What the pictures (t, h, w, 3) of the fitted frames say of each pair of legs.

    frames: (t,) their numbers; only frames that follow each other are compared.
    """
    figure = fitted.figure
    joints = windows.in_picture(fitted.joints(), fitted.px_per_length)
    deep = fitted.deep * fitted.px_per_length
    pairs = _pairs(figure)
    votes: dict[str, list[Floats]] = {left.part.name: [] for left, _ in pairs}
    step = float(np.min(np.diff(frames))) if len(frames) > 1 else 0.0
    ways = windows.ways()
    for row in range(len(frames) - 1):
        if frames[row + 1] - frames[row] > step or ways[row] != ways[row + 1]:
            continue
        corner, size = _box(joints[row : row + 2], deep, pictures.shape[1:3])
        grey = [_grey(pictures[k], corner, size) for k in (row, row + 1)]
        followed = _textured(grey[0], looks)
        flow, places = _flow(*grey)[followed], _places(corner, size)[followed]
        for left, right in pairs:
            vote = _votes(figure, left, right, joints[row : row + 2], deep, places, flow, looks)
            # Of an animal that has turned round the other leg is the near one.
            votes[left.part.name].append(vote * windows.faces * ways[row])
    found = []
    for part, each in votes.items():
        whole = np.concatenate(each) if each else np.zeros(0)
        found.append(Nearer(part, float(whole.mean()) if len(whole) else 0.0, len(whole)))
    return found


def _pairs(figure: Figure) -> list[tuple[Limb, Limb]]:
    right = {limb.part.name: limb for limb in figure.feet() if limb.side == "right"}
    return [
        (limb, right[limb.part.name])
        for limb in figure.feet()
        if limb.side == "left" and limb.part.name in right
    ]


def _box(
    joints: Floats, deep: Floats, shape: tuple[int, int]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The corner and the size (x, y) of what is looked at, px."""
    margin = float(deep.max()) + 8.0
    low = np.floor(joints.min(axis=(0, 1)) - margin).astype(np.int64)
    high = np.ceil(joints.max(axis=(0, 1)) + margin).astype(np.int64)
    low = np.clip(low, 0, np.array(shape[::-1]) - 16)
    high = np.clip(high, low + 16, np.array(shape[::-1]))
    return low, high - low


def _places(corner: NDArray[np.int64], size: NDArray[np.int64]) -> Floats:
    """(n, 2) the middles of every second pixel of a box."""
    x = corner[0] + np.arange(0, size[0], _EACH) + 0.5
    y = corner[1] + np.arange(0, size[1], _EACH) + 0.5
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def _grey(picture: Frames, corner: NDArray[np.int64], size: NDArray[np.int64]) -> Frames:
    (x, y), (width, height) = corner, size
    piece = np.ascontiguousarray(picture[y : y + height, x : x + width])
    return np.asarray(cv2.cvtColor(piece, cv2.COLOR_RGB2GRAY), dtype=np.uint8)


def _textured(grey: Frames, looks: NearerLooks) -> NDArray[np.bool_]:
    """(n,) whether there is something to follow at every second pixel."""
    soft = cv2.GaussianBlur(grey.astype(np.float32), (0, 0), looks.soft_px)
    rows, columns = np.gradient(soft)
    steep = np.hypot(rows, columns).astype(np.float32)
    around = cv2.dilate(steep, np.ones((looks.near_px, looks.near_px), np.uint8))
    return np.asarray(around[::_EACH, ::_EACH] > looks.texture).reshape(-1)


def _flow(first: Frames, second: Frames) -> Floats:
    """(n, 2) where every second pixel goes in the next picture, px."""
    search = cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)
    flow = search.calc(first, second, np.zeros((*first.shape, 2), np.float32))
    return np.asarray(flow[::_EACH, ::_EACH], dtype=np.float64).reshape(-1, 2)


def _votes(
    figure: Figure, left: Limb, right: Limb, joints: Floats, deep: Floats, places: Floats,
    flow: Floats, looks: NearerLooks,
) -> Floats:  # fmt: skip
    """(n,) by how much the flow is the left leg's where both legs and nothing else are."""
    both = [limb for limb in figure.limbs if limb in (left, right)]
    others = [s for limb in figure.limbs if limb not in both for s in limb.segments]
    at = np.arange(len(places))
    ways: list[Floats] = []
    for limb in both:
        own = _carried(figure, limb.segments, joints, deep, places[at])
        kept = own.depth > looks.inside
        at = at[kept]
        ways = [*(way[kept] for way in ways), own.way[kept]]
    apart = np.linalg.norm(ways[0] - ways[1], axis=1)
    rest = _carried(figure, tuple(others), joints, deep, places[at])
    kept = (apart > looks.apart_px) & (rest.depth < 0.0)
    off = [np.linalg.norm(flow[at] - way, axis=1)[kept] for way in ways]
    return np.asarray(np.clip((off[1] - off[0]) / apart[kept], -1.0, 1.0))


@dataclass(frozen=True, eq=False)
class _Carried:
    """depth: (p,) how far within a limb's outline, as a share of its thickness; below 0 outside.
    way: (p, 2) where the limb takes each place in the next frame, px.
    """

    depth: Floats
    way: Floats


def _carried(
    figure: Figure, segments: tuple[int, ...], joints: Floats, deep: Floats, places: Floats
) -> _Carried:
    """Each place goes with the segment it is deepest in. joints: (2, j, 2) in a frame and the next
    one.
    """
    depth, way = np.full(len(places), -1.0), np.zeros((len(places), 2))
    for segment in segments:
        start, end = figure.start[segment], figure.end[segment]
        (first, then), (after, last) = joints[:, start], joints[:, end]
        along = after - first
        square = max(float(along @ along), 1e-9)
        share = np.clip((places - first) @ along / square, 0.0, 1.0)[:, None]
        off = places - first - share * along
        half = deep[start] * (1.0 - share[:, 0]) + deep[end] * share[:, 0]
        own = 1.0 - np.linalg.norm(off, axis=1) / np.maximum(half, 1e-9)
        new = last - then
        turn = np.arctan2(new[1], new[0]) - np.arctan2(along[1], along[0])
        spin = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        moved = then + share * new + off @ spin
        better = own > depth
        depth = np.where(better, own, depth)
        way = np.where(better[:, None], moved - places, way)
    return _Carried(depth, way)
