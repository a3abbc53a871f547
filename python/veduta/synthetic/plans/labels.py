"""What is written on a plan: names, sizes and areas of rooms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.synthetic.plans.canvas import Canvas, text_size_px
from veduta.synthetic.plans.house import Room, Storey
from veduta.synthetic.plans.names import FULL, SHORT
from veduta.synthetic.plans.styles import Sizes, Style

FOOT_M = 0.3048
INCH_M = 0.0254
LEAST_SIZED_M2 = 3.5
SQUARE_SHARE = 0.93


@dataclass(frozen=True)
class Label:
    """What is written in a room, and where; `name` is "" where it would not fit."""

    room: str
    name: str
    size: str
    centre_m: tuple[float, float]
    box_m: tuple[float, float, float, float]
    upright: bool = True


def size_text(sizes: Sizes, room: Room, area: Polygon) -> str:
    """The room's size as printed: two sides of a rectangular room, or its area."""
    x0, y0, x1, y1 = area.bounds
    wide, high = x1 - x0, y1 - y0
    square = area.area >= SQUARE_SHARE * wide * high
    if sizes == "none" or room.area_m2 < LEAST_SIZED_M2 or room.use == "stairs":
        return ""
    if sizes == "area":
        return f"{room.area_m2:.1f} m²".replace(".", ",")
    if sizes == "area-point":
        return f"{room.area_m2:.2f} m2"
    if sizes == "area-feet":
        return f"{room.area_m2 / FOOT_M**2:.0f} sq ft"
    if not square:
        return ""
    if sizes == "metres":
        return f"{wide:.2f} x {high:.2f}"
    if sizes == "comma":
        return f"{wide:.2f} x {high:.2f}".replace(".", ",")
    mark = '"' if sizes == "feet-inches" else ""
    return f"{_feet(wide)}{mark} x {_feet(high)}{mark}"


def _feet(metres: float) -> str:
    inches = round(metres / INCH_M)
    return f"{inches // 12}'{inches % 12}"


def labels_of(
    rng: np.random.Generator, canvas: Canvas, style: Style, storey: Storey, busy: BaseGeometry
) -> list[Label]:
    """Labels that fit into their rooms; `busy` is where doors swing and things stand."""
    count = Counter(room.use for room in storey.rooms)
    number: Counter[str] = Counter()
    made = []
    for room in storey.rooms:
        number[room.use] += 1
        if room.use == "stairs":
            continue
        words = FULL[style.language][room.use]
        words = tuple(word for word in words if "{n}" not in word or count[room.use] > 1)
        name = words[int(rng.integers(len(words)))].format(n=number[room.use])
        short = SHORT[style.language].get(room.use, name)
        label = _fit(canvas, style, room, (name, short), busy)
        if label is not None:
            made.append(label)
    return made


def text_height_px(canvas: Canvas) -> float:
    """Of a room's name: about 22 cm, and legible."""
    return float(np.clip(0.22 / canvas.metres_per_px, 12.0, 26.0))


def _fit(
    canvas: Canvas, style: Style, room: Room, names: tuple[str, str], busy: BaseGeometry
) -> Label | None:
    area = Polygon(room.outline_m)
    height = text_height_px(canvas)
    size = size_text(style.sizes, room, area)
    for name, printed in ((names[0], size), (names[1], size), (names[1], "")):
        text = name.upper() if style.capitals else name
        wide = text_size_px(text, height, style.font, style.weight)[0]
        if printed:
            below = text_size_px(printed, 0.85 * height, style.font, style.weight)[0]
            wide = max(wide, below)
        high = height * (2.2 if printed else 1.1)
        sides = (wide * canvas.metres_per_px, high * canvas.metres_per_px)
        for free in (area.difference(busy), area):
            for upright in (True, False):
                spot = spot_within(free, *(sides if upright else sides[::-1]))
                if spot is not None:
                    middle = ((spot[0] + spot[2]) / 2, (spot[1] + spot[3]) / 2)
                    return Label(room.id, text, printed, middle, spot, upright)
    return None


def spot_within(
    area: BaseGeometry, wide: float, high: float
) -> tuple[float, float, float, float] | None:
    """A box of this size within the area, as near to its middle as can be."""
    if area.is_empty:
        return None
    x0, y0, x1, y1 = area.bounds
    centres = [
        (x, y)
        for x in np.linspace(x0 + wide / 2, x1 - wide / 2, 9)
        for y in np.linspace(y0 + high / 2, y1 - high / 2, 9)
    ]
    middle = area.centroid
    centres.sort(key=lambda c: (c[0] - middle.x) ** 2 + (c[1] - middle.y) ** 2)
    pad = 0.06
    spots = [(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2) for x, y in centres]
    boxes = shapely.box(*np.array([(a - pad, b - pad, c + pad, d + pad) for a, b, c, d in spots]).T)
    shapely.prepare(area)
    inside = np.flatnonzero(shapely.contains(area, boxes))
    return spots[int(inside[0])] if inside.size else None


def draw_label(canvas: Canvas, style: Style, label: Label) -> None:
    """The name over the size, centred; in a narrow room both run up the page."""
    height = text_height_px(canvas)
    x, y = label.centre_m
    lift = 0.6 * height * canvas.metres_per_px if label.size else 0.0
    for text, size, off in ((label.name, height, lift), (label.size, 0.85 * height, -lift)):
        at = (x, y + off) if label.upright else (x - off, y)
        if text:
            canvas.text(text, at, size, style.font, style.ink, style.weight, label.upright)


def label_box(label: Label) -> Polygon:
    """What the label covers, in metres."""
    return box(*label.box_m)


def with_labels(
    busy: BaseGeometry, labels: Sequence[Label], margin_m: float = 0.05
) -> BaseGeometry:
    """What is kept free of furniture, and around what is written so far besides."""
    return unary_union([busy, *(label_box(label).buffer(margin_m) for label in labels)])
