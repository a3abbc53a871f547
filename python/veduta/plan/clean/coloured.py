"""Rooms in flat colours with walls left light between them: drawn anew, the walls in black.

Such a sheet has no ink where its walls are. Floors are broad fields of one tone; a light band that
lies directly beside them is a wall, where furniture, as light, has a line around it. A narrow field
between two pieces of wall is an opening: of the tone of a room beside it a door, else a window.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

LIGHT = 240
"""Walls are at least so light in every channel (0 to 255) ..."""

TINT = 12
"""... and floors darker than they are, in one channel, by so much ..."""

DARK = 110
"""... but lighter than this in one."""

FLAT = 10
"""Within a field neighbours differ by so little in each channel."""

LINE = 22
"""A line is darker than both of its sides by so much."""

BROAD = 0.035
"""Rooms are broader than this part of the drawing's longer side: walls and windows are not."""

LEAST_ROOM, FEWEST = 0.002, 4
"""A room covers this part of the sheet at least, and there are so many of them."""

TOUCHING, TOUCHING_OUTDOORS = 0.15, 0.05
"""A light piece is wall if so much of its edge lies directly at a floor, or at a window where it
lies outdoors, ..."""

LEAST_SIDE_PX = 6
"""... of at least two of them, so long at each ..."""

SPECK = 1e-5
"""... and it covers more than this part of the sheet."""

BOUNDED = 0.3
"""So much of the outlines of all rooms lies at light walls or windows (.47 to .60 on eight such
sheets, 0 on eleven of strangers); else they have drawn walls."""

ALIKE = 9
"""Fields whose channels differ by no more than this are of one tone."""

REACH_PX, OUTDOORS_PX = 4, 12
"""Edges of fields are blurred over so many pixels, and so far beyond an outline it is outdoors."""

SEEN_PX, STROKE = 1500, 0.015
"""Colours are looked for on a sheet of this side; no letter has strokes of that part of it."""


@dataclass(frozen=True)
class _Fields:
    """Fields of one tone: `labels` (h, w), 0 elsewhere; of each the area, the tone (n, 3)."""

    labels: NDArray[np.int32]
    area: NDArray[np.int64]
    tone: NDArray[np.float64]


def with_black_walls(pixels: NDArray[np.uint8]) -> NDArray[np.uint8] | None:
    """The sheet (h, w, 3) drawn anew in black on white; None where walls are drawn otherwise."""
    light = pixels.min(axis=2) >= LIGHT
    fields = _fields(pixels, light)
    broad, page = _rooms(fields)
    rooms = np.unique(fields.labels[broad])
    if len(rooms) < FEWEST:
        return None
    lines = _lines(pixels)
    wall = _walls(light, fields, rooms, page, lines)
    narrow = _narrow(fields, rooms, page, wall)
    if _share_at(broad, wall | narrow) < BOUNDED:
        return None
    outdoors = _reaching_edge(light) | page[fields.labels]
    return _drawn(pixels, wall, lines, _windows(fields, rooms, narrow, outdoors))


def on_white(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Of such a sheet (h, w, 3) what is drawn and written, on white; others stay as given.

    Letters on a colour have less contrast than text is looked for with. On three sheets with pale
    floors between drawn walls it found no more, and lost a mark of inches.
    """
    longer = max(pixels.shape[:2])
    shrink = min(1.0, SEEN_PX / longer)
    small = cv2.resize(pixels, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    if with_black_walls(np.asarray(small, np.uint8)) is None:
        return pixels
    reach = np.ones((2 * round(0.5 * STROKE * longer) + 1,) * 2, np.uint8)
    ground = np.maximum(cv2.morphologyEx(pixels, cv2.MORPH_CLOSE, reach), 1).astype(np.float32)
    share = (pixels / ground).min(axis=2)
    return np.asarray(np.repeat(np.round(255.0 * share)[..., None], 3, axis=2), np.uint8)


def _fields(pixels: NDArray[np.uint8], light: NDArray[np.bool_]) -> _Fields:
    square = np.ones((3, 3), np.uint8)
    step = (cv2.dilate(pixels, square) - cv2.erode(pixels, square)).max(axis=2)
    seen = (step <= FLAT) & ~light & (pixels.max(axis=2) >= DARK)
    seen &= pixels.min(axis=2) <= 255 - TINT
    # Middles of broad lines are flat, too.
    least = np.ones((REACH_PX + 1,) * 2, np.uint8)
    seen = cv2.morphologyEx(seen.astype(np.uint8), cv2.MORPH_OPEN, least) > 0
    count, found = cv2.connectedComponents(seen.astype(np.uint8), connectivity=4)
    labels = np.asarray(found, np.int32)
    area = np.bincount(labels.ravel(), minlength=count)
    tone = np.stack(
        [np.bincount(labels.ravel(), pixels[..., one].ravel(), minlength=count) for one in range(3)]
    )
    return _Fields(labels, area, np.asarray((tone / np.maximum(area, 1)).T))


def _rooms(fields: _Fields) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Where fields are as broad as rooms (h, w), and which fields (n,) are the page around."""
    labels = fields.labels
    page = np.zeros(len(fields.area), np.bool_)
    page[_at_border(labels)] = True
    page[0] = False
    inner = (labels > 0) & ~page[labels]
    rows, columns = np.flatnonzero(inner.any(axis=1)), np.flatnonzero(inner.any(axis=0))
    if len(rows) == 0:
        return inner, page
    side = max(3, round(BROAD * max(np.ptp(rows), np.ptp(columns))))
    # What is written in a room makes no small ones of it.
    whole = np.zeros(inner.shape, np.uint8)
    outlines, _ = cv2.findContours(inner.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(whole, outlines, -1, 1, cv2.FILLED)
    opened = cv2.morphologyEx(whole, cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    broad = inner & (opened > 0)
    own = np.bincount(labels[broad], minlength=len(fields.area))
    large = own >= LEAST_ROOM * labels.size
    return broad & large[labels], page


def _lines(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w) by how much each pixel is darker than both of its sides."""
    reach = np.ones((2 * REACH_PX + 1,) * 2, np.uint8)
    return np.asarray(cv2.morphologyEx(pixels, cv2.MORPH_BLACKHAT, reach).max(axis=2), np.uint8)


def _walls(
    light: NDArray[np.bool_],
    fields: _Fields,
    rooms: NDArray[np.int32],
    page: NDArray[np.bool_],
    lines: NDArray[np.uint8],
) -> NDArray[np.bool_]:
    """The light pieces that part fields, or one from outdoors, with no line between.

    What stands in a room has that alone around it. Faces outdoors have a line at times.
    """
    count, labels = cv2.connectedComponents(light.astype(np.uint8), connectivity=4)
    paper = _reaching_edge(light)
    edge = light & (cv2.erode(light.astype(np.uint8), np.ones((3, 3), np.uint8)) == 0)
    inner = np.where(page[fields.labels], 0, fields.labels)
    beside = _nearest(inner)
    direct = edge & (beside > 0) & ~_near(lines > LINE, 2)
    free = edge & _near(paper | page[fields.labels], OUTDOORS_PX)
    total = np.bincount(labels[edge & (direct | ~free)], minlength=count)
    touching = np.bincount(labels[direct], minlength=count)
    area = np.bincount(labels.ravel(), minlength=count)
    sides = _sides(labels[direct], beside[direct], count, fields, rooms)
    outer = np.bincount(labels[free], minlength=count) >= LEAST_SIDE_PX
    sides += outer
    least = np.where(outer, TOUCHING_OUTDOORS, TOUCHING)
    wall = (touching > least * total) & (area > SPECK * light.size) & (sides >= 2)
    wall[_at_border(np.asarray(labels, np.int32))] = False
    wall[0] = False
    return np.asarray(wall[labels], np.bool_)


def _sides(
    pieces: NDArray[np.int32],
    beside: NDArray[np.int32],
    count: int,
    fields: _Fields,
    rooms: NDArray[np.int32],
) -> NDArray[np.int64]:
    """(count,) at how many fields each piece lies; `pieces`, `beside` (n,) are labels at edges.

    A part of a room that furniture cuts off is no other field.
    """
    pairs, often = np.unique(np.stack([pieces, beside]), axis=1, return_counts=True)
    pairs = pairs[:, often >= LEAST_SIDE_PX]
    sides = np.zeros(count, np.int64)
    for piece in np.unique(pairs[0]):
        own = pairs[1][pairs[0] == piece]
        large, small = own[np.isin(own, rooms)], own[~np.isin(own, rooms)]
        off = np.abs(fields.tone[small][:, None] - fields.tone[large][None]).max(axis=2)
        sides[piece] = len(large) + int((off > ALIKE).all(axis=1).sum())
    return sides


def _at_border(labels: NDArray[np.int32]) -> NDArray[np.int32]:
    """The labels along the edge of the sheet."""
    return np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))


def _reaching_edge(light: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The light pieces at the edge of the sheet, which are its paper."""
    _, labels = cv2.connectedComponents(light.astype(np.uint8), connectivity=4)
    border = _at_border(np.asarray(labels, np.int32))
    return np.asarray(np.isin(labels, border[border > 0]), np.bool_)


def _nearest(labels: NDArray[np.int32]) -> NDArray[np.int32]:
    """(h, w) a label within reach of each pixel; 0 without one."""
    square = np.ones((2 * REACH_PX + 1,) * 2, np.uint8)
    return np.asarray(cv2.dilate(labels.astype(np.float32), square), np.float32).astype(np.int32)


def _narrow(
    fields: _Fields, rooms: NDArray[np.int32], page: NDArray[np.bool_], wall: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Fields in gaps of walls: what closing them would cover, and is no room."""
    own = np.zeros(len(fields.area), np.bool_)
    own[rooms] = True
    count = len(fields.area)
    beside = np.bincount(fields.labels[_near(wall)], minlength=count)
    chosen = (beside > 0) & ~own & ~page & (fields.area > SPECK * wall.size)
    chosen[0] = False
    return np.asarray(chosen[fields.labels], np.bool_)


def _windows(
    fields: _Fields,
    rooms: NDArray[np.int32],
    narrow: NDArray[np.bool_],
    outdoors: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Those of the narrow fields that lie outdoors, or have not the tone of a room beside them."""
    windows = np.zeros_like(narrow)
    outer = np.unique(fields.labels[narrow & _near(outdoors, OUTDOORS_PX)])
    for label in np.unique(fields.labels[narrow]):
        alike = np.abs(fields.tone[rooms] - fields.tone[label]).max(axis=1) <= ALIKE
        here = fields.labels == label
        around = np.unique(fields.labels[_near(here, 2 * REACH_PX)])
        if label in outer or not np.isin(rooms[alike], around).any():
            windows |= here
    return windows


def _share_at(broad: NDArray[np.bool_], bounds: NDArray[np.bool_]) -> float:
    """How much of the edge of the rooms lies at what bounds them."""
    whole = np.zeros(broad.shape, np.uint8)
    outlines, _ = cv2.findContours(broad.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(whole, outlines, -1, 1, 1)
    edge = whole > 0
    return float(_near(bounds, 2 * REACH_PX)[edge].mean())


def _drawn(
    pixels: NDArray[np.uint8],
    wall: NDArray[np.bool_],
    lines: NDArray[np.uint8],
    windows: NDArray[np.bool_],
) -> NDArray[np.uint8]:
    """Walls black, windows as two lines in their gap, all lines as dark as they stand out."""
    dark = np.where(pixels.max(axis=2) < DARK, 255 - pixels.min(axis=2), lines)
    dark = np.where(dark > LINE, dark, 0).astype(np.uint8)
    grown = cv2.dilate(wall.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    panes = cv2.dilate(windows.astype(np.uint8), np.ones((3, 3), np.uint8))
    rim = (cv2.dilate(panes, np.ones((5, 5), np.uint8)) > 0) & (panes == 0)
    dark = np.where(grown | rim, np.uint8(255), dark)
    return np.asarray(np.repeat((255 - dark)[..., None], 3, axis=2), np.uint8)


def _near(mask: NDArray[np.bool_], reach_px: int = REACH_PX) -> NDArray[np.bool_]:
    square = np.ones((2 * reach_px + 1,) * 2, np.uint8)
    return np.asarray(cv2.dilate(mask.astype(np.uint8), square) > 0, np.bool_)
