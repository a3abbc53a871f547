"""What the learned eyes saw, as the boxes of a document: on floors and in columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.eyes import SeenElement

# Widths of a median window that part two columns.
_NEXT_COLUMN = 0.5
# The mean chance of shop in a window beside shops from which it is a shop's pane. On 48 pictures of
# CMP's training part (every fifth up to b0240) 0.1 is the lowest that costs nothing: F1 of shops
# 0.543 from there up to 1, 0.531 with 0.05, 0.472 with 0. The eyes know these pictures by heart and
# leave no pane to be turned, so that nothing there tells what is best elsewhere.
_PANE_CHANCE = 0.1
# The same of a pane alone, and how much wider it is than the windows above: set before they were
# measured; on those 48 pictures all from 0.1 and from 1.15 up are alike.
_LONE_CHANCE, _WIDE_PANE = 0.2, 1.3
# Share of the width of a shop below which there are windows and doors: it is their sign.
_UNDER_SIGN = 0.4
# Of a storey: a shop is as high as a door. Of five false ones on 25 fronts of CMP, which were
# looked at, two are lower (0.13), three are a sign, a van and a shutter with a sign. A third of a
# storey leaves out the sign and true panes, too (F1 0.349 on CMP's 60, where it was 0.392).
_LEAST_SHOP = 0.2


def in_crop(
    elements: Sequence[SeenElement], scale: float, left: int, size: tuple[int, int]
) -> list[SeenElement]:
    """Elements in pixels of the analysis, of which at least half lies in the crop.

    `scale`: analysis pixels per pixel that was looked at; the crop begins at column `left` and is
    `size` (width, height) large.
    """
    width, height = size
    found = []
    for e in elements:
        moved = replace(
            e,
            x0=max(0.0, e.x0 * scale - left),
            y0=max(0.0, e.y0 * scale),
            x1=min(float(width), e.x1 * scale - left),
            y1=min(float(height), e.y1 * scale),
        )
        kept = max(0.0, moved.width) * max(0.0, moved.height)
        if kept >= 0.5 * e.width * e.height * scale**2 and min(moved.width, moved.height) >= 2:
            found.append(moved)
    return found


def on_their_floors(
    elements: Sequence[SeenElement], boundaries: Sequence[int]
) -> list[SeenElement]:
    """The elements, of which shops and doors are on the ground floor alone.

    A shop above it is an awning or a sign, and left out, and so is one with windows and doors below
    it, or one lower than a fifth of a storey (a vehicle's sign, the foot of the wall); a door
    above it is a window down to the floor. A front without floors (one boundary), or without any
    opening on its ground floor, keeps both wherever they are.
    """
    ground = boundaries[-1]
    on_ground = any(e.kind != "balcony" and 0.5 * (e.y0 + e.y1) >= ground for e in elements)
    if len(boundaries) < 2 or not on_ground:
        return list(elements)

    def is_above(e: SeenElement) -> bool:
        return (
            e.kind in ("shop", "door")
            and 0.5 * (e.y0 + e.y1) < ground
            and e.y1 < ground + 0.25 * e.height
        )

    storey = (ground - boundaries[0]) / (len(boundaries) - 1)

    def is_none(e: SeenElement) -> bool:
        return is_above(e) or is_sign(e, elements) or e.height < _LEAST_SHOP * storey

    kept = [e for e in elements if e.kind != "shop" or not is_none(e)]
    return [replace(e, kind="window") if is_above(e) else e for e in kept]


def with_panes_of_shops(
    elements: Sequence[SeenElement], boundaries: Sequence[int], shop: NDArray[np.float32]
) -> list[SeenElement]:
    """The elements, of which windows on the ground floor that look like shops are such.

    Beside a shop, in its rows and not in it; or alone, where they are wide and look more like one.
    shop: (h, w) the chance of shop in the crop.
    """
    if len(boundaries) < 2:
        return list(elements)
    above = [e.width for e in elements if e.kind == "window" and e.y1 < boundaries[-1]]
    wide = _WIDE_PANE * float(np.median(above)) if above else np.inf
    found = [
        replace(e, kind="shop")
        if _is_below(e, boundaries) and e.width > wide and _chance_in(e, shop) > _LONE_CHANCE
        else e
        for e in elements
    ]
    shops = [e for e in found if e.kind == "shop"]

    def is_beside(e: SeenElement) -> bool:
        x, y = 0.5 * (e.x0 + e.x1), 0.5 * (e.y0 + e.y1)
        rows = [one for one in shops if one.y0 < y < one.y1]
        return bool(rows) and not any(one.x0 < x < one.x1 for one in rows)

    return [
        replace(e, kind="shop")
        if _is_below(e, boundaries) and is_beside(e) and _chance_in(e, shop) > _PANE_CHANCE
        else e
        for e in found
    ]


def _is_below(e: SeenElement, boundaries: Sequence[int]) -> bool:
    """Whether it is a window of the ground floor."""
    return e.kind == "window" and 0.5 * (e.y0 + e.y1) >= boundaries[-1]


def _chance_in(e: SeenElement, chance: NDArray[np.float32]) -> float:
    """The mean of chances (h, w) in an element."""
    part = chance[int(e.y0) : int(e.y1) + 1, int(e.x0) : int(e.x1) + 1]
    return float(part.mean()) if part.size else 0.0


def is_sign(shop: SeenElement, elements: Sequence[SeenElement]) -> bool:
    """Whether windows and doors stand below a shop along most of it: then it is what is above them.

    Those that begin within its lower quarter or less than its height below it.
    """
    low, far = shop.y1 - 0.25 * shop.height, shop.y1 + shop.height
    under = [
        (max(e.x0, shop.x0), min(e.x1, shop.x1))
        for e in elements
        if e.kind in ("window", "door") and low <= e.y0 <= far
    ]
    return sum(max(0.0, b - a) for a, b in under) > _UNDER_SIGN * shop.width


def boxes_of(
    elements: Sequence[SeenElement], boundaries: Sequence[int], columns: Columns
) -> list[Box]:
    """Boxes in the order in which they are painted: shops, doors, windows, balconies.

    `boundaries` are the floors' from the eaves down; what lies above is in the roof, what lies
    below on the ground floor.
    """
    order = ("shop", "door", "window", "balcony")
    boxes = []
    for e in sorted(elements, key=lambda e: (order.index(e.kind), e.y0, e.x0)):
        x, y = round(e.x0), round(e.y0)
        size = max(1, round(e.x1) - x), max(1, round(e.y1) - y)
        column = _column(e, columns) if e.kind == "window" else None
        floor = 0 if e.kind in ("shop", "door") else floor_at(0.5 * (e.y0 + e.y1), boundaries)
        boxes.append(Box(e.kind, x, y, *size, floor, column, e.score))
    return boxes


def floor_at(y: float, boundaries: Sequence[int]) -> int | None:
    """The floor at a row of pixels: 0 is the ground floor, None the roof."""
    if y < boundaries[0]:
        return None
    return len(boundaries) - 1 - sum(y >= b for b in boundaries[1:])


def columns_of(elements: Sequence[SeenElement]) -> Columns:
    """Stripes of windows that stand above each other, from left to right."""
    windows = sorted((e for e in elements if e.kind == "window"), key=lambda e: e.x0 + e.x1)
    if not windows:
        return Columns([], 0.0, {}, 0)
    middles = np.array([0.5 * (e.x0 + e.x1) for e in windows])
    step = _NEXT_COLUMN * float(np.median([e.width for e in windows]))
    cuts = [0, *(np.flatnonzero(np.diff(middles) > step) + 1).tolist(), len(windows)]
    stripes = []
    for a, b in zip(cuts, cuts[1:], strict=False):
        part = windows[a:b]
        left, right = (
            round(float(np.median(v))) for v in zip(*((e.x0, e.x1) for e in part), strict=True)
        )
        stripes.append((left, max(1, right - left)))
    return Columns(stripes, 0.0, {}, 0)


def _column(element: SeenElement, columns: Columns) -> int:
    middle = 0.5 * (element.x0 + element.x1)
    apart = [abs(x + 0.5 * width - middle) for x, width in columns.stripes]
    return int(np.argmin(apart))
