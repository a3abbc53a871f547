"""A page of a flat finder: rooms in flat colours, and walls that are what is left white between.

No wall has ink of its own: white bands between colours, at times with a pale rim outdoors, at
times on a tinted page. Furniture is white with a grey rim; doors are gaps in a room's colour.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import opening_area, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free
from veduta.synthetic.plans.foreign.floors import floor_of, leaves_of, turned_leaf
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.house import Storey, Use
from veduta.synthetic.plans.labels import draw_label, labels_of, with_labels
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

GROUPS: Mapping[Use, int] = {
    "living": 0, "dining": 0, "kitchen": 1, "bedroom": 2, "study": 2, "bathroom": 3, "toilet": 3,
    "sauna": 3, "utility": 3, "hall": 4, "corridor": 4, "stairs": 4, "storage": 5, "wardrobe": 5,
    "garage": 5,
}  # fmt: skip
PALETTES: tuple[tuple[Colour, ...], ...] = (
    ((247, 214, 150), (240, 176, 120), (172, 208, 232), (138, 200, 190), (226, 222, 210),
     (206, 200, 214)),
    ((198, 222, 170), (236, 206, 120), (214, 186, 220), (150, 194, 226), (238, 228, 204),
     (200, 204, 196)),
    ((232, 196, 186), (214, 158, 142), (190, 202, 224), (160, 188, 204), (220, 214, 208),
     (188, 184, 180)),
)  # fmt: skip
DARK: Colour = (60, 60, 66)
RIM: Colour = (150, 150, 154)


@dataclass(frozen=True)
class Manner:
    """Of a page: its paper, its colours, whether walls have a rim outdoors."""

    paper: Colour
    colours: tuple[Colour, ...]
    rim: bool
    pen_px: float


def coloured_page(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The page (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "coloured page")
    tinted = bool(rng.random() < 0.5)
    manner = Manner(
        (232, 234, 236) if tinted else (255, 255, 255),
        PALETTES[int(rng.integers(len(PALETTES)))],
        bool(not tinted or rng.random() < 0.4), float(rng.uniform(1.0, 1.5)),
    )  # fmt: skip
    storey = floor_of(seed, "coloured page", "en")
    whole = whole_walls(storey.walls)
    left, bottom, right, top = whole.bounds
    canvas = Canvas((left - 1.4, bottom - 1.4, right + 1.4, top + 1.4),
                    1.0 / float(rng.uniform(46.0, 72.0)), manner.paper)  # fmt: skip
    canvas.fill(whole, (255, 255, 255))
    for room in storey.rooms:
        canvas.fill(Polygon(room.outline_m), _tint(room.use, manner))
    if manner.rim:
        _rim(canvas, whole, manner)
    _openings(canvas, storey, manner)
    for flight in storey.stairs:
        for step in flight.steps_m or (flight.outline_m,):
            canvas.line(step, manner.pen_px, RIM, closed=True)
    style = Style("coloured", "unseen", "en", ink=DARK, pen_px=manner.pen_px, sizes="area",
                  weight=600, furniture=0.8)  # fmt: skip
    busy = kept_free(storey)
    labels = labels_of(rng, canvas, style, storey, busy)
    busy = with_labels(busy, labels)
    things = furnish(rng, storey, style.furniture, busy)
    for thing in things:
        canvas.fill(thing.area, (250, 250, 250))
    draw_things(canvas, Style("things", "unseen", "en", ink=RIM, pen_px=1.3), things)
    for label in labels:
        draw_label(canvas, style, label)
    truth = SheetTruth(
        f"coloured-{seed:05d}.png", seed, "coloured", "clean", ("coloured",), "hollow",
        canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return canvas.picture(), [truth]


def _tint(use: Use, manner: Manner) -> Colour:
    return manner.colours[GROUPS[use]]


def _rim(canvas: Canvas, whole: BaseGeometry, manner: Manner) -> None:
    parts = getattr(whole, "geoms", [whole])
    for part in parts:
        canvas.line(np.array(part.exterior.coords), manner.pen_px, RIM)


def _openings(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    uses = {room.id: room.use for room in storey.rooms}
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        place = place_of(wall, opening)
        if opening.kind == "window":
            canvas.fill(opening_area(wall, opening, 0.0), (168, 206, 234))
            for side in (-place.half_m, place.half_m):
                ends = [place.at(0.0, side), place.at(place.width_m, side)]
                canvas.line(ends, 0.8 * manner.pen_px, RIM)
            continue
        room = wall.left or wall.right or ""
        canvas.fill(opening_area(wall, opening), _tint(uses[room], manner))
        if opening.type in ("swing", "double", "french"):
            for leaf in leaves_of(opening):
                turned_leaf(canvas, place, leaf, manner.pen_px, DARK)
        else:
            DRAWN[opening.type](Pen(canvas, manner.pen_px, DARK), opening, place, False)
