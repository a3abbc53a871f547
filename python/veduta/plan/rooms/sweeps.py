"""Doors in an outline: where paper ends at a leaf and the quarter circle that its tip describes.

Where an outer wall is a thin line, its door is a gap in that line with the leaf and the trace drawn
beside it. The paper of the room ends at these two, or flows through the gap up to them, so that its
outline goes from the hinge along the leaf and along the trace to the other jamb. The wall goes
straight from the hinge to the jamb, and the door is in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.walls.axes import OnAxis
from veduta.plan.walls.pieces import Piece

DOOR_WIDTHS = (0.55, 1.7)
"""Leaves differ from the usual door of the sheet by these factors at most."""

SWEPT_RAD = (np.radians(72.0), np.radians(100.0))
"""A trace turns so far about its hinge."""

STRAY = 0.05
"""It strays from a circle by this part of the leaf, or by STRAY_PX ..."""

STRAY_PX = 2.0

CORNER_PX = 1.5
"""Corners of an outline are told up to this."""

LEAF_CORNERS = 3
"""A leaf that is drawn as a slab has two corners at its tip, a jamb another."""

HINGES = 7
"""The hinge lies on either face of a wall or between them: so many places are tried."""

BESIDE = 1.5
"""The door of a wall has its hinge and its jamb within so many thicknesses of its middle."""

DRAWN_SCORE = 0.8
"""A leaf with a whole trace, found by them alone."""

Mask = NDArray[np.bool_]
Points = NDArray[np.float64]


@dataclass(frozen=True)
class Sweep:
    """What a leaf sweeps: pixels (2,) of its hinge, of the jamb it shuts against, of its tip."""

    hinge: Points
    jamb: Points
    tip: Points

    def moved(self, by: float) -> Sweep:
        """The same in a frame whose origin is elsewhere on both axes."""
        return Sweep(self.hinge + by, self.jamb + by, self.tip + by)


def without_sweeps(room: Mask, door_px: float, thick_px: float) -> tuple[Mask, list[Sweep]]:
    """A room (h, w) whose outline passes doors straight, and what leaves sweep beside it.

    `door_px` is the width of the usual door, `thick_px` how thick walls are at most in which a
    leaf may hang at the far face. Sweeps are in pixels of the mask, whose centres are at halves.
    """
    whole = room.astype(np.uint8)
    found: list[Sweep] = []
    outlines, _ = cv2.findContours(whole, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    for outline in outlines:
        points = outline[:, 0].astype(np.float64)
        for way in (points, points[::-1]):
            for sweep, part in _along(way, door_px, thick_px):
                if any(np.hypot(*(one.tip - sweep.tip)) < door_px / 2 for one in found):
                    continue
                swept = _within(part, room.shape)
                if not swept.any():
                    continue
                inside = float(room[swept].mean())
                # The line that is passed straight is the outline's: a leaf that opens outwards
                # leaves its sweep with the room, where the threshold is not drawn.
                cv2.fillPoly(whole, [part.astype(np.int32)], int(inside < 0.5))
                found.append(sweep)
    _, labels = cv2.connectedComponents(whole, connectivity=4)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    largest = np.asarray(labels == int(sizes.argmax()), dtype=np.bool_)
    return largest, [one.moved(0.5) for one in found]


def doors_in(piece: Piece, sweeps: Sequence[Sweep]) -> tuple[OnAxis, ...]:
    """The doors of a straight piece of wall whose leaves hang in it."""
    found = []
    for one in sweeps:
        along, across = piece.arc.place(np.stack([one.hinge, one.jamb]))
        low, high = max(0.0, float(along.min())), min(piece.length_px, float(along.max()))
        wide = float(np.hypot(*(one.jamb - one.hinge)))
        beside = float(np.abs(across).max()) > BESIDE * piece.thickness_px
        if beside or high - low < 0.8 * wide:
            continue
        part = piece.part(low, high)
        gap = Gap(-1, True, -1, False, part.start, part.end, piece.thickness_px, part.end)
        # Positive to the right of who goes along, as seen on the page.
        right = float(piece.arc.place(one.tip[None])[1][0]) > 0
        found.append(
            OnAxis(
                Judged(
                    gap, "door", "swing", "start" if along[0] < along[1] else "end",
                    "right" if right else "left", DRAWN_SCORE,
                ),
                low, high, along=True,
            )
        )  # fmt: skip
    return tuple(found)


def _along(points: Points, door_px: float, thick_px: float) -> Iterator[tuple[Sweep, Points]]:
    """Sweeps that an outline (n, 2) passes leaf first, each with its part of the outline."""
    low, high = DOOR_WIDTHS[0] * door_px, DOOR_WIDTHS[1] * door_px
    corners = _corners(points)
    for place, first in enumerate(corners):
        for ahead in range(1, LEAF_CORNERS + 1):
            tip = corners[(place + ahead) % len(corners)]
            leaf = _between(points, first, tip)
            size, _ = _way(leaf)
            if not low - thick_px <= size <= high or not _straight(leaf):
                continue
            best = max(
                (
                    _trace(points, tip, leaf, size + more)
                    for more in np.linspace(0.0, thick_px, HINGES)
                    if low <= size + more <= high
                ),
                key=lambda one: one[0],
                default=None,
            )
            if best is None or not SWEPT_RAD[0] <= best[0] <= SWEPT_RAD[1]:
                continue
            _, hinge, arc = best
            yield Sweep(hinge, arc[-1], leaf[-1]), np.concatenate([leaf, arc])
            break


def _trace(points: Points, tip: int, leaf: Points, radius: float) -> tuple[float, Points, Points]:
    """How far the outline turns on from a tip about a hinge so far from it, the hinge, that part.

    The hinge lies on the leaf's line.
    """
    _, way = _way(leaf)
    hinge = leaf[-1] - radius * way
    ahead = np.arange(tip, tip + min(int(2 * radius), len(points)))
    on = points.take(ahead, axis=0, mode="wrap")
    apart = on - hinge
    off = np.abs(np.hypot(*apart.T) - radius) > max(STRAY_PX, STRAY * radius)
    count = int(off.argmax()) if off.any() else len(on)
    if count < radius / 2:
        return 0.0, hinge, on[:1]
    turned = np.arctan2(apart @ np.array([-way[1], way[0]]), apart @ way)
    # Past the jamb the outline runs beside the circle for a while: a quarter is all.
    angles = np.abs(turned[:count])
    count = int(np.argmax(angles > np.pi / 2)) if (angles > np.pi / 2).any() else count
    return float(angles[:count].max(initial=0.0)), hinge, on[: max(count, 1)]


def _corners(points: Points) -> list[int]:
    """Places of the corners of a closed outline."""
    kept = cv2.approxPolyDP(points.astype(np.int32)[:, None], CORNER_PX, closed=True)[:, 0]
    places = {tuple(one): place for place, one in enumerate(points.astype(int).tolist())}
    return sorted(places[tuple(one)] for one in kept.tolist())


def _between(points: Points, first: int, last: int) -> Points:
    """The part of a closed outline from one place to another, with both."""
    if first <= last:
        return points[first : last + 1]
    return np.concatenate([points[first:], points[: last + 1]])


def _way(leaf: Points) -> tuple[float, Points]:
    """How long a leaf (n, 2) is from its hinge to its tip, and the unit vector (2,) there."""
    along = leaf[-1] - leaf[0]
    size = float(np.hypot(*along))
    return size, along / max(size, 1e-9)


def _straight(leaf: Points) -> bool:
    """Whether a part of an outline is a straight line, but for what a slab's tip adds."""
    size, way = _way(leaf)
    across = np.abs((leaf - leaf[0]) @ np.array([-way[1], way[0]]))
    return bool(across.max() <= max(STRAY_PX, STRAY * size) and len(leaf) <= 1.5 * size + 4)


def _within(part: Points, shape: tuple[int, ...]) -> Mask:
    """The pixels of a polygon."""
    mask = np.zeros(shape[:2], np.uint8)
    cv2.fillPoly(mask, [part.astype(np.int32)], 1)
    cv2.polylines(mask, [part.astype(np.int32)], True, 0, 3)
    return mask.astype(np.bool_)
