"""A page of an estate agent: a band with a logo, a photo, planks, a watermark, a bar of metres.

Walls are filled in one dark tone; floors are planks and tiles in thin lines, furniture is tinted.
The scale is said by the bar alone. A compass of four points, a logo of solid shapes and small print
stand around the plan.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from shapely.geometry import LineString, Point, Polygon, box

from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free
from veduta.synthetic.plans.foreign.floors import floor_of, leaves_of, slanted, star, turned_leaf
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.hand_papers import smooth_noise
from veduta.synthetic.plans.house import Opening, Room, Storey, Wall
from veduta.synthetic.plans.labels import draw_label, labels_of, with_labels
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (50, 50, 54)
WALLS: tuple[Colour, ...] = ((28, 74, 84), (66, 66, 70), (88, 62, 48), (30, 36, 66))
BRANDS: tuple[Colour, ...] = ((196, 30, 58), (0, 92, 138), (232, 140, 20), (52, 110, 66))
WET = ("bathroom", "toilet", "utility", "kitchen", "sauna")


@dataclass(frozen=True)
class Manner:
    """Of a page: the tones of walls and of the agent, what floors and beams are."""

    wall: Colour
    brand: Colour
    planks: bool
    watermark: bool
    pen_px: float


def listing_page(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The page (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "listing page")
    manner = Manner(
        WALLS[int(rng.integers(len(WALLS)))], BRANDS[int(rng.integers(len(BRANDS)))],
        bool(rng.random() < 0.7), bool(rng.random() < 0.7), float(rng.uniform(1.0, 1.5)),
    )  # fmt: skip
    storey = floor_of(seed, "listing page", "en")
    bounds = whole_walls(storey.walls).bounds
    left, bottom, right, top = bounds
    canvas = Canvas((left - 1.3, bottom - 2.4, right + 1.3, top + 3.6),
                    1.0 / float(rng.uniform(50.0, 76.0)), (255, 255, 255))  # fmt: skip
    for room in storey.rooms:
        _floor(canvas, room, manner)
    canvas.fill(solid_walls(storey), manner.wall)
    for opening in storey.openings:
        _opening(canvas, storey.wall(opening.wall), opening, manner)
    for flight in storey.stairs:
        for step in flight.steps_m or (flight.outline_m,):
            canvas.line(step, manner.pen_px, INK, closed=True)
    _rooms(canvas, storey, manner, rng)
    _around(canvas, storey, bounds, manner, rng)
    picture = canvas.picture()
    if manner.watermark:
        middle = canvas.px_from_m[:2] @ ((left + right) / 2.0, (bottom + top) / 2.0, 1.0)
        spot = (float(middle[0]), float(middle[1]))
        size = round(1.1 / canvas.metres_per_px)
        picture = slanted(picture, "SAMPLE HOMES", spot, size, 28.0, (120, 120, 120), 0.22)
    truth = SheetTruth(
        f"listing-{seed:05d}.png", seed, "listing", "clean", ("listing",), "filled",
        canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return picture, [truth]


def _floor(canvas: Canvas, room: Room, manner: Manner) -> None:
    area = Polygon(room.outline_m)
    left, bottom, right, top = area.bounds
    if room.use in WET:
        canvas.fill(area, (236, 242, 244))
        lines = [LineString([(x, bottom), (x, top)]) for x in np.arange(left, right, 0.3)]
        lines += [LineString([(left, y), (right, y)]) for y in np.arange(bottom, top, 0.3)]
        tone: Colour = (206, 216, 220)
    else:
        canvas.fill(area, (244, 236, 222))
        if not manner.planks:
            return
        lines = [LineString([(left, y), (right, y)]) for y in np.arange(bottom, top, 0.16)]
        tone = (222, 208, 186)
    for line in lines:
        inside = line.intersection(area)
        for part in getattr(inside, "geoms", [inside]):
            if part.length:
                canvas.line(np.array(part.coords), 0.6, tone)


def _opening(canvas: Canvas, wall: Wall, opening: Opening, manner: Manner) -> None:
    place = place_of(wall, opening)
    canvas.fill(opening_area(wall, opening), (255, 255, 255))
    if opening.kind == "window":
        for side in (-place.half_m, place.half_m):
            canvas.line([place.at(0.0, side), place.at(place.width_m, side)], manner.pen_px,
                        manner.wall)  # fmt: skip
    elif opening.type in ("swing", "double", "french"):
        for leaf in leaves_of(opening):
            turned_leaf(canvas, place, leaf, manner.pen_px, manner.wall)
    else:
        DRAWN[opening.type](Pen(canvas, manner.pen_px, manner.wall), opening, place, False)


def _rooms(canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator) -> None:
    style = Style("listing", "unseen", "en", ink=INK, pen_px=manner.pen_px, weight=600)
    busy = kept_free(storey)
    labels = labels_of(rng, canvas, style, storey, busy)
    busy = with_labels(busy, labels)
    things = furnish(rng, storey, 0.85, busy)
    for thing in things:
        canvas.fill(thing.area, (214, 206, 200))
    pale = Style("things", "unseen", "en", ink=(140, 132, 126), pen_px=1.3)
    draw_things(canvas, pale, things)
    for label in labels:
        draw_label(canvas, style, label)


def _around(
    canvas: Canvas, storey: Storey, bounds: tuple[float, float, float, float], manner: Manner,
    rng: np.random.Generator,
) -> None:  # fmt: skip
    """The band above with a logo and a photo, below the bar, the compass and small print."""
    left, bottom, right, top = bounds
    band = box(left - 1.3, top + 1.2, right + 1.3, top + 3.6)
    canvas.fill(band, manner.brand)
    at = (left - 0.2, top + 2.4)
    canvas.fill(Point(at).buffer(0.75), (255, 255, 255))
    canvas.fill(Polygon([(at[0] - 0.5, at[1]), (at[0], at[1] + 0.5), (at[0] + 0.5, at[1])]),
                manner.brand)  # fmt: skip
    canvas.fill(box(at[0] - 0.35, at[1] - 0.45, at[0] + 0.35, at[1]), manner.brand)
    size = 0.42 / canvas.metres_per_px
    middle = (left + right) / 2.0
    canvas.text("Sample Homes", (middle, top + 2.6), size, "sans", (255, 255, 255), 800)
    canvas.text("14 Orchard Lane", (middle, top + 1.9), 0.6 * size, "sans", (255, 255, 255))
    _photo(canvas, box(right - 1.3, top + 1.4, right + 1.1, top + 3.4), rng)
    level = bottom - 1.3
    for metre in range(5):
        piece = box(left + metre, level, left + metre + 1.0, level + 0.14)
        canvas.fill(piece, INK if metre % 2 == 0 else (255, 255, 255))
        canvas.outline(piece, 1.0, INK)
    small = float(np.clip(0.19 / canvas.metres_per_px, 10.5, 15.0))
    for mark, text in ((0, "0"), (1, "1"), (5, "5 m")):
        canvas.text(text, (left + mark, level + 0.36), small, "sans", INK)
    star(canvas, (right - 0.6, bottom - 1.35), 0.45, float(rng.uniform(-1.0, 1.0)), manner.brand)
    words = "Plan for guidance only. Fixtures and fittings are not included."
    canvas.text(words, (middle, bottom - 2.1), 0.8 * small, "sans", (130, 130, 130))


def _photo(canvas: Canvas, frame: Polygon, rng: np.random.Generator) -> None:
    """Something like a picture of a house: sky, a wall with noise, a lawn."""
    left, bottom, right, top = frame.bounds
    canvas.fill(frame, (150, 190, 226))
    canvas.fill(box(left, bottom, right, bottom + 0.5), (96, 140, 70))
    canvas.fill(box(left + 0.5, bottom + 0.4, right - 0.4, top - 0.7), (196, 150, 120))
    rows = [canvas.top_m - top, canvas.top_m - bottom]
    columns = [left - canvas.left_m, right - canvas.left_m]
    per_m = canvas.pixels.shape[1] / (canvas.width_px * canvas.metres_per_px)
    (y0, y1), (x0, x1) = ([round(one * per_m) for one in ends] for ends in (rows, columns))
    part = canvas.pixels[y0:y1, x0:x1]
    noise = smooth_noise((part.shape[0], part.shape[1]), 9.0, rng)[:, :, None]
    part[:] = cv2.convertScaleAbs(part * (0.7 + 0.5 * noise))
