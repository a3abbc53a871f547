"""Several storeys on one sheet: where each is drawn, in which order they stand in the house.

A plan has walls all around: no straight strip of paper crosses it. Drawings on one sheet are
therefore parted by strips without ink, along both sides of the sheet in turn (the XY cut of Nagy
and Seth 1984), whatever the gap between them is in metres.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned
from veduta.plan.names.storeys import StoreyName, storey_name

Box = tuple[int, int, int, int]
"""Left, upper, right, lower: pixels, the last two beyond the end."""


@dataclass(frozen=True)
class Parting:
    """How drawings on a sheet are told apart; shares are of the sheet's long side, or as said.

    ink: what is darker is drawn, panes of windows too. strip: a blank strip is so broad. speck:
    shorter ink counts for nothing. frame: ink that reaches over so much of both sides of the sheet,
    and covers little of it (frame_ink), is its frame. least: a plan has so much of the area of the
    largest. alike: sides of storeys without titles differ by no more than this ratio. joined: what
    has no title belongs to the plan with one that is so near. most: more drawings than these are a
    catalogue.
    """

    ink: float = 0.15
    strip: float = 0.008
    speck: float = 0.03
    frame: float = 0.85
    frame_ink: float = 0.03
    least: float = 0.25
    alike: float = 1.6
    joined: float = 0.08
    most: int = 6


PARTING = Parting()


@dataclass(frozen=True)
class StoreyDrawing:
    """One of several plans on a sheet: the sheet without the others, in the same pixels."""

    cleaned: Cleaned
    texts: tuple[Text, ...]
    title: StoreyName | None


def storeys_drawn(
    cleaned: Cleaned, texts: Sequence[Text], parting: Parting = PARTING
) -> list[StoreyDrawing]:
    """The storeys that a sheet shows, the lowest first; one alone where it shows no more.

    Texts are in pixels of `cleaned`. Plans are storeys where titles say so (`Ground Floor`,
    `1. OG`), each its own, or where they are about as large as each other: then the order is
    that of reading, as nothing says another.
    """
    whole = [StoreyDrawing(cleaned, tuple(texts), None)]
    boxes = plans_on(_ink_without(cleaned.ink, texts, parting), parting)
    if not 2 <= len(boxes) <= parting.most:
        return whole
    owners = _nearest(boxes, cleaned.ink.shape)
    groups: list[list[Text]] = [[] for _ in boxes]
    for text in texts:
        column, row = np.mean(text.box_px, axis=0).astype(int)
        height, width = owners.shape
        at = owners[int(np.clip(row, 0, height - 1)), int(np.clip(column, 0, width - 1))]
        groups[int(at)].append(text)
    titles = [storey_name(group) for group in groups]
    chosen = _storeys(boxes, titles, parting)
    if len(chosen) < 2:
        return whole
    reach = parting.joined * max(cleaned.ink.shape)
    home = [_home(index, boxes, chosen, reach) for index in range(len(boxes))]
    own = [[index for index, at in enumerate(home) if at == one] for one in chosen]
    return [
        StoreyDrawing(
            _alone(cleaned, np.isin(owners, members)),
            tuple(text for index in members for text in groups[index]),
            titles[one],
        )
        for one, members in zip(chosen, own, strict=True)
    ]


def order_note(found: Sequence[StoreyDrawing]) -> list[str]:
    """What is to be said of several storeys on a sheet: by what they are told, and their order."""
    if len(found) < 2:
        return []
    if all(one.title for one in found):
        named = ", ".join(repr(one.title.name) for one in found if one.title)
        return [f"{len(found)} plans lie on this sheet: {named}, by their titles."]
    return [
        f"{len(found)} plans lie on this sheet without titles: taken for storeys in the order of"
        " reading, the first one lowest. If that is wrong, give a picture of each."
    ]


def plans_on(mask: NDArray[np.bool_], parting: Parting = PARTING) -> list[Box]:
    """Boxes around the plans of a mask (h, w) of ink, in the order of reading."""
    gap = max(5, round(parting.strip * max(mask.shape)))
    blocks = _cut(mask, (0, 0, mask.shape[1], mask.shape[0]), gap)
    largest = max((_area(one) for one in blocks), default=0)
    return [one for one in blocks if _area(one) >= parting.least * largest]


def _cut(mask: NDArray[np.bool_], box: Box, gap: int) -> list[Box]:
    """The box, shrunk to its ink, or what blank strips part it into."""
    left, upper, right, lower = box
    inside = mask[upper:lower, left:right]
    for axis in (0, 1):
        runs = _runs(np.asarray(inside.any(axis=axis)), gap)
        if not runs:
            return []
        if len(runs) > 1:
            across = axis == 0
            parts = [
                (left + a, upper, left + b, lower)
                if across
                else (left, upper + a, right, upper + b)
                for a, b in runs
            ]
            return [found for part in parts for found in _cut(mask, part, gap)]
    ((a, b),), ((c, d),) = (_runs(np.asarray(inside.any(axis=axis)), gap) for axis in (0, 1))
    return [(left + a, upper + c, left + b, upper + d)]


def _runs(inked: NDArray[np.bool_], gap: int) -> list[tuple[int, int]]:
    """Stretches with ink that are parted by at least `gap` without."""
    at = np.flatnonzero(inked)
    if not len(at):
        return []
    breaks = np.flatnonzero(np.diff(at) > gap)
    starts = [at[0], *at[breaks + 1]]
    ends = [*at[breaks], at[-1]]
    return [(int(a), int(b) + 1) for a, b in zip(starts, ends, strict=True)]


def _ink_without(
    ink: NDArray[np.float32], texts: Sequence[Text], parting: Parting
) -> NDArray[np.bool_]:
    """The ink of drawings: without writing, specks and the frame of the sheet."""
    mask = (ink > parting.ink).astype(np.uint8)
    for text in texts:
        cv2.fillPoly(mask, [np.round(text.box_px).astype(np.int32)], 0)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=8)
    height, width = mask.shape
    wide, high = stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]
    thin = stats[:, cv2.CC_STAT_AREA] < parting.frame_ink * wide * high
    frame = (wide > parting.frame * width) & (high > parting.frame * height) & thin
    kept = (np.maximum(wide, high) >= parting.speck * max(mask.shape)) & ~frame
    kept[0] = False
    drawn: NDArray[np.bool_] = kept[labels]
    return drawn


def _nearest(boxes: Sequence[Box], shape: tuple[int, ...]) -> NDArray[np.intp]:
    """For each pixel (h, w) the box that is nearest to it."""
    rows, columns = np.arange(shape[0])[:, None], np.arange(shape[1])[None, :]
    away = [
        np.maximum(np.maximum(left - columns, columns - right), 0) ** 2
        + np.maximum(np.maximum(upper - rows, rows - lower), 0) ** 2
        for left, upper, right, lower in boxes
    ]
    nearest: NDArray[np.intp] = np.argmin(np.stack(away), axis=0)
    return nearest


def _storeys(
    boxes: Sequence[Box], titles: Sequence[StoreyName | None], parting: Parting
) -> list[int]:
    """Which of the plans are storeys, from the lowest up."""
    named = {index: one for index, one in enumerate(titles) if one is not None}
    if len({one.name.casefold() for one in named.values()}) == len(named) >= 2:
        return sorted(named, key=lambda index: named[index].rank)
    sides = [(right - left, lower - upper) for left, upper, right, lower in boxes]
    alike = all(
        max(one[axis], other[axis]) <= parting.alike * min(one[axis], other[axis])
        for one, other in combinations(sides, 2)
        for axis in (0, 1)
    )
    return list(range(len(boxes))) if alike else []


def _home(index: int, boxes: Sequence[Box], chosen: Sequence[int], reach: float) -> int | None:
    """The storey that a box is of: its own, or the one near it, or none."""
    if index in chosen:
        return index

    def apart(other: int) -> float:
        one, two = boxes[index], boxes[other]
        x = max(one[0] - two[2], two[0] - one[2], 0)
        y = max(one[1] - two[3], two[1] - one[3], 0)
        return float(np.hypot(x, y))

    nearest = min(chosen, key=apart)
    return nearest if apart(nearest) <= reach else None


def _alone(cleaned: Cleaned, own: NDArray[np.bool_]) -> Cleaned:
    """The sheet with paper where another plan is drawn."""
    paper = (
        np.median(cleaned.pixels[cleaned.ink < 0.1], axis=0) if (cleaned.ink < 0.1).any() else 255
    )
    pixels = np.where(own[..., None], cleaned.pixels, np.asarray(paper, dtype=np.uint8))
    ink = np.where(own, cleaned.ink, np.float32(0.0))
    return replace(cleaned, pixels=pixels.astype(np.uint8), ink=ink.astype(np.float32))


def _area(box: Box) -> int:
    return (box[2] - box[0]) * (box[3] - box[1])
