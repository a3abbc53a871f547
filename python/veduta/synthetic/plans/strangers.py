"""Two families of sheets as strangers bring them: a house on its plot, and storeys side by side.

`plot`: a wall around the plot with a gate, a parked car, shaded beds, chimney breasts, a line of
writing in a script that no reader of text knows. `storeys`: two storeys on one sheet under their
titles, with the same writing. Words, walls and openings are those of `drawing`; all else is noise
that must not be taken for any of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon, box

from veduta.synthetic.plans.canvas import Image
from veduta.synthetic.plans.drawing import Sheet, draw_sheet
from veduta.synthetic.plans.house import Room, Storey
from veduta.synthetic.plans.layout import make_house
from veduta.synthetic.plans.styles import BY_NAME, Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

Family = Literal["plot", "storeys"]
FAMILIES: tuple[Family, ...] = ("plot", "storeys")
_STYLES = ("plain", "agent", "heavy", "grey")
_GREY = (176, 176, 176)
_TITLES = ("Ground Floor", "First Floor")


@dataclass(frozen=True)
class Noise:
    """Sizes of what is drawn besides the house, in metres."""

    yard: tuple[float, float] = (1.6, 3.2)
    fence: float = 0.2
    gate: float = 3.0
    car: tuple[float, float] = (1.8, 4.4)
    breast: tuple[float, float] = (1.3, 0.55)
    bed: tuple[float, float] = (1.4, 1.9)
    apart: float = 1.2


NOISE = Noise()


def strangers_sheet(seed: int, family: Family) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of each storey on it, the lowest first."""
    rng = stream(seed, f"strangers {family}")
    style = replace(BY_NAME[_STYLES[seed % len(_STYLES)]], title=False, dimension_lines=False)
    house = make_house(seed, style.language, storeys=1 if family == "plot" else 2)
    sheets = [
        draw_sheet(storey, style, stream(seed, f"sheet {storey.number}"))
        for storey in house.storeys
    ]
    if family == "plot":
        return _on_its_plot(seed, sheets[0], style, rng)
    # One sheet has one scale: that of the first drawing.
    scale = np.sqrt(abs(np.linalg.det(sheets[0].px_from_m[:2, :2])))
    same = replace(style, px_per_m=(float(scale), float(scale)))
    upper = draw_sheet(house.storeys[1], same, stream(seed, "sheet 1"))
    return _side_by_side(seed, [sheets[0], upper], style, rng)


def _truth(
    seed: int, family: Family, style: Style, sheet: Sheet, shift: tuple[int, int]
) -> SheetTruth:
    move = np.eye(3)
    move[:2, 2] = shift
    return SheetTruth(
        f"{family}-{seed:05d}-{sheet.storey.number}.png",
        seed, style.name, family, (family,), style.walls,
        move @ sheet.px_from_m, sheet.says_scale, None, sheet.storey,
    )  # fmt: skip


def _on_its_plot(
    seed: int, sheet: Sheet, style: Style, rng: np.random.Generator
) -> tuple[Image, list[SheetTruth]]:
    scale = float(np.sqrt(abs(np.linalg.det(sheet.px_from_m[:2, :2]))))
    height, width = sheet.picture.shape[:2]
    yard = [round(float(rng.uniform(*NOISE.yard)) * scale) for _ in range(4)]
    drive = round((NOISE.car[0] + 1.0) * scale)
    margin = round(0.8 * scale)
    left, upper = margin + yard[0], margin + yard[1]
    total = (upper + height + yard[3] + margin, left + width + yard[2] + drive + margin, 3)
    page = np.full(total, style.paper, dtype=np.uint8)
    picture = sheet.picture.copy()
    _inside(picture, sheet, style, rng, scale)
    page[upper : upper + height, left : left + width] = picture
    pen = max(4, round(NOISE.fence * scale))
    low, high = (margin, margin), (total[1] - margin, total[0] - margin)
    cv2.rectangle(page, low, high, style.wall_fill, pen)
    gate = (total[0] - margin - round((NOISE.gate + 1.0) * scale), round(NOISE.gate * scale))
    page[gate[0] : gate[0] + gate[1], high[0] - pen : high[0] + pen] = style.paper
    car = [round(one * scale) for one in NOISE.car]
    corner = (
        high[0] - pen - car[0] - round(0.5 * scale),
        high[1] - pen - car[1] - round(0.6 * scale),
    )
    cv2.rectangle(page, corner, (corner[0] + car[0], corner[1] + car[1]), _GREY, -1)
    unread_line(page, (margin + pen + 12, high[1] - pen - 30), 22, rng, style.ink)
    return page, [_truth(seed, "plot", style, sheet, (left, upper))]


def _inside(
    picture: Image, sheet: Sheet, style: Style, rng: np.random.Generator, scale: float
) -> None:
    """Beds that are shaded, and a chimney breast, clear of words and doors."""
    for room in sheet.storey.rooms:
        if room.use == "bedroom":
            _filled(picture, sheet, _corner(room, NOISE.bed, rng), _GREY)
        elif room.use == "living":
            breast = _breast(room, sheet.storey)
            if breast is not None:
                _filled(picture, sheet, breast, style.wall_fill)


def _corner(room: Room, size_m: tuple[float, float], rng: np.random.Generator) -> Polygon | None:
    """A box in a corner of a room's bounds that lies in the room; None where none does."""
    shape = Polygon(room.outline_m)
    left, bottom, right, top = shape.bounds
    wide, deep = size_m
    for x, y in rng.permutation([(left, bottom), (right - wide, bottom), (left, top - deep)]):
        bed = box(x + 0.1, y + 0.1, x + wide - 0.1, y + deep - 0.1)
        if shape.contains(bed):
            return bed
    return None


def _breast(room: Room, storey: Storey) -> Polygon | None:
    """In the middle of the longest outer wall of a room that has no opening there."""
    shape = Polygon(room.outline_m)
    wide, deep = NOISE.breast
    for wall in sorted(
        storey.walls, key=lambda one: -np.hypot(*np.subtract(one.end_m, one.start_m))
    ):
        if not wall.outer or wall.bulge or any(one.wall == wall.id for one in storey.openings):
            continue
        start, end = np.array(wall.start_m), np.array(wall.end_m)
        way = (end - start) / np.hypot(*(end - start))
        across = np.array([-way[1], way[0]])
        for side in (1.0, -1.0):
            foot = (start + end) / 2.0 + side * across * wall.thickness_m / 2.0
            tip = foot + side * across * deep
            ring = [
                foot - way * wide / 2,
                foot + way * wide / 2,
                tip + way * wide / 2,
                tip - way * wide / 2,
            ]
            body = Polygon(ring)
            if shape.buffer(0.02).contains(body):
                return body
    return None


def _filled(
    picture: Image, sheet: Sheet, shape: Polygon | None, colour: tuple[int, int, int]
) -> None:
    """A shape in metres where the sheet is blank: nothing that is written or drawn is covered."""
    if shape is None:
        return
    points = np.array(shape.exterior.coords)
    pixels = points @ sheet.px_from_m[:2, :2].T + sheet.px_from_m[:2, 2]
    low, high = np.floor(pixels.min(axis=0)).astype(int), np.ceil(pixels.max(axis=0)).astype(int)
    inside = picture[low[1] + 3 : high[1] - 3, low[0] + 3 : high[0] - 3]
    if inside.size and int(inside.max()) - int(inside.min()) < 30:
        cv2.fillPoly(picture, [np.round(pixels).astype(np.int32)], colour)


def _side_by_side(
    seed: int, sheets: list[Sheet], style: Style, rng: np.random.Generator
) -> tuple[Image, list[SheetTruth]]:
    scale = float(np.sqrt(abs(np.linalg.det(sheets[0].px_from_m[:2, :2]))))
    below = round(1.4 * scale)
    gap = round(float(rng.uniform(0.0, NOISE.apart)) * scale)
    high = max(one.picture.shape[0] for one in sheets)
    wide = sum(one.picture.shape[1] for one in sheets) + gap
    page = np.full((high + below, wide, 3), style.paper, dtype=np.uint8)
    # The upper storey may stand on the left.
    order = [0, 1] if rng.random() < 0.6 else [1, 0]
    left, truths = 0, {}
    for place in order:
        sheet = sheets[place]
        height, width = sheet.picture.shape[:2]
        page[:height, left : left + width] = sheet.picture
        title, font = _TITLES[place], cv2.FONT_HERSHEY_SIMPLEX
        size, _ = cv2.getTextSize(title, font, 1.0, 2)
        at = (left + (width - size[0]) // 2, height + round(0.4 * scale))
        cv2.putText(
            page, _TITLES[place], at, cv2.FONT_HERSHEY_SIMPLEX, 1.0, style.ink, 2, cv2.LINE_AA
        )
        unread_line(page, (at[0], at[1] + 14), 20, rng, style.ink)
        truths[place] = _truth(seed, "storeys", style, sheet, (left, 0))
        left += width + gap
    return page, [truths[0], truths[1]]


def unread_line(
    page: NDArray[np.uint8],
    at: tuple[int, int],
    height: int,
    rng: np.random.Generator,
    ink: tuple[int, int, int],
) -> None:
    """A line of signs that are no letters: a few strokes each, on a square body."""
    x, y = at
    for _ in range(int(rng.integers(6, 12))):
        box_px = np.array([x, y])
        for _ in range(int(rng.integers(2, 5))):
            ends = box_px + rng.integers(0, height, (2, 2)) * np.array([0.75, 1.0])
            first, last = (tuple(int(value) for value in end) for end in ends)
            cv2.line(page, first, last, ink, 2, cv2.LINE_AA)
        x += round(0.95 * height)
