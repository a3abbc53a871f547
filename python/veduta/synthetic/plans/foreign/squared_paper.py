"""A sketch on squared paper, made straight by a phone: two strokes for a wall, scribble between.

The squares are printed pale and are half a metre. Strokes waver and overshoot at corners;
sizes are written by hand along walls. The phone has evened light and colours.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from shapely.geometry import LineString, Polygon, box

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.bodies import solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free
from veduta.synthetic.plans.foreign.floors import clear_size, floor_of, leaves_of
from veduta.synthetic.plans.hand_papers import smooth_noise
from veduta.synthetic.plans.house import Opening, Storey, Wall
from veduta.synthetic.plans.labels import draw_label, labels_of, spot_within, with_labels
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

SQUARE_M = 0.5
PENS: tuple[Colour, ...] = ((32, 44, 120), (30, 30, 34), (70, 70, 74))
SQUARES: tuple[Colour, ...] = ((176, 204, 226), (208, 208, 208), (196, 220, 196))


@dataclass(frozen=True)
class Manner:
    """Of a sketch: its pen, the paper's squares, whether walls are scribbled full."""

    ink: Colour
    squares: Colour
    pen_px: float
    scribbled: bool


def squared_sketch(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "squared sketch")
    manner = Manner(
        PENS[int(rng.integers(len(PENS)))], SQUARES[int(rng.integers(len(SQUARES)))],
        float(rng.uniform(1.6, 2.4)), bool(rng.random() < 0.5),
    )  # fmt: skip
    storey = floor_of(seed, "squared sketch", "en")
    left, bottom, right, top = whole_walls(storey.walls).bounds
    bounds = (left - 1.5, bottom - 1.5, right + 1.5, top + 1.5)
    canvas = Canvas(bounds, 1.0 / float(rng.uniform(52.0, 76.0)), (252, 252, 250))
    for x in np.arange(bounds[0] + 0.2, bounds[2], SQUARE_M):
        canvas.line([(x, bounds[1]), (x, bounds[3])], 0.8, manner.squares)
    for y in np.arange(bounds[1] + 0.2, bounds[3], SQUARE_M):
        canvas.line([(bounds[0], y), (bounds[2], y)], 0.8, manner.squares)
    _walls(canvas, storey, manner, rng)
    for opening in storey.openings:
        _opening(canvas, storey.wall(opening.wall), opening, manner)
    for flight in storey.stairs:
        for step in flight.steps_m or (flight.outline_m,):
            canvas.line(step, 0.7 * manner.pen_px, manner.ink, closed=True)
    _words(canvas, storey, manner, rng)
    truth = SheetTruth(
        f"squared-{seed:05d}.png", seed, "squared", "sketched", ("squared",),
        "filled" if manner.scribbled else "hollow", canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return _wavered(canvas.picture(), rng), [truth]


def _walls(canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator) -> None:
    """Strokes along the faces, each a little too long; a zigzag between them, or nothing."""
    solid = solid_walls(storey)
    for part in getattr(solid, "geoms", [solid]):
        for ring in (part.exterior, *part.interiors):
            corners = np.array(ring.coords)
            for start, end in zip(corners[:-1], corners[1:], strict=True):
                size = float(np.hypot(*(end - start)))
                way = (end - start) / max(size, 1e-9)
                over = rng.uniform(0.0, 0.06, 2) if size > 0.6 else np.zeros(2)
                ends = [start - over[0] * way, end + over[1] * way]
                canvas.line(ends, manner.pen_px, manner.ink)
    if not manner.scribbled:
        return
    for wall in storey.walls:
        size = curves.wall_length(wall)
        steps = max(2, round(size / 0.05))
        half = 0.4 * wall.thickness_m
        shares = np.linspace(0.0, 1.0, steps)
        points = [
            curves.at(wall.start_m, wall.end_m, wall.bulge, np.array([share]),
                      half * (1.0 if number % 2 else -1.0) * float(rng.uniform(0.7, 1.1)))[0]
            for number, share in enumerate(shares)
        ]  # fmt: skip
        inside = LineString(points).intersection(solid)
        for piece in getattr(inside, "geoms", [inside]):
            if piece.length:
                canvas.line(np.array(piece.coords), 0.8 * manner.pen_px, manner.ink)


def _opening(canvas: Canvas, wall: Wall, opening: Opening, manner: Manner) -> None:
    place = place_of(wall, opening)
    pen = 0.8 * manner.pen_px
    if opening.kind == "window":
        for side in (-place.half_m, 0.0, place.half_m):
            ends = [place.at(-0.02, side), place.at(place.width_m + 0.02, side)]
            canvas.line(ends, pen, manner.ink)
    elif opening.type in ("swing", "double", "french"):
        for hinge, length, side in leaves_of(opening):
            base = side * place.half_m
            tip = place.at(hinge, base + side * abs(length))
            canvas.line([place.at(hinge, base), tip], pen, manner.ink)
            canvas.line(place.sweep((hinge, base), length, side, 16), 0.8 * pen, manner.ink)
    else:
        DRAWN[opening.type](Pen(canvas, pen, manner.ink), opening, place, False)


def _words(canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator) -> None:
    """Names in italics, and the two sides of rectangular rooms along their walls."""
    style = Style("squared", "unseen", "en", ink=manner.ink, font="italic")
    busy = kept_free(storey)
    labels = labels_of(rng, canvas, style, storey, busy)
    for label in labels:
        draw_label(canvas, style, label)
    busy = with_labels(busy, labels)
    height = float(np.clip(0.19 / canvas.metres_per_px, 11.0, 15.0))
    high = 1.1 * height * canvas.metres_per_px
    for room in storey.rooms:
        size = clear_size(room)
        if size is None or room.area_m2 < 4.0:
            continue
        left, bottom, right, top = Polygon(room.outline_m).bounds
        strips = (
            (box(left, bottom, right, bottom + 0.4), 0.6, high, True, size[0]),
            (box(left, bottom, left + 0.4, top), high, 0.6, False, size[1]),
        )
        for strip, wide, tall, upright, metres in strips:
            spot = spot_within(strip.difference(busy), wide, tall)
            if spot is not None:
                at = ((spot[0] + spot[2]) / 2.0, (spot[1] + spot[3]) / 2.0)
                text = f"{metres:.2f}"
                canvas.text(text, at, height, "italic", manner.ink, 400, upright)


def _wavered(picture: Image, rng: np.random.Generator) -> Image:
    """Strokes that waver by a pixel and press unevenly, after light has been made even."""
    height, width = picture.shape[:2]
    shifts = [1.1 * (2.0 * smooth_noise((height, width), 26.0, rng) - 1.0) for _ in "xy"]
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    moved = cv2.remap(
        picture, (x + shifts[0]).astype(np.float32), (y + shifts[1]).astype(np.float32),
        cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)  # fmt: skip
    press = 0.75 + 0.25 * smooth_noise((height, width), 11.0, rng)[:, :, None]
    drawn = 252.0 + (moved - 252.0) * press
    return np.asarray(np.clip(drawn + rng.normal(0.0, 2.0, (height, width, 1)), 0, 255), np.uint8)
