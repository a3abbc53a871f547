"""A print of an American working drawing: rows of sizes run through rooms, walls and names.

Walls are two lines, the outer ones with a sheathing line or dots between. Rows of sizes in feet and
inches cross the whole house, with dots or arrows at the middles of walls; lights hang on dashed
wires from switches; windows bear their sizes outdoors. It is a scan: grey, grained, a little askew.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from shapely import unary_union
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free
from veduta.synthetic.plans.foreign.floors import chain, crossings, feet, floor_of, outward
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.hand_papers import smooth_noise
from veduta.synthetic.plans.house import Storey
from veduta.synthetic.plans.labels import (
    draw_label,
    label_box,
    labels_of,
    spot_within,
    with_labels,
)
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (36, 36, 40)
PAPER: Colour = (238, 236, 230)


@dataclass(frozen=True)
class Manner:
    """Of a drawing: its pen, what ends its rows of sizes, what is between the faces of walls."""

    pen_px: float
    ends: str
    between: str
    wires: bool


def print_drawing(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "print drawing")
    manner = Manner(
        float(rng.uniform(1.2, 1.7)), str(rng.choice(["dot", "arrow", "tick"])),
        str(rng.choice(["nothing", "sheathing", "dots"])), bool(rng.random() < 0.6),
    )  # fmt: skip
    storey = floor_of(seed, "print drawing", "en")
    left, bottom, right, top = whole_walls(storey.walls).bounds
    canvas = Canvas((left - 2.6, bottom - 2.6, right + 2.6, top + 2.6),
                    1.0 / float(rng.uniform(58.0, 80.0)), PAPER)  # fmt: skip
    _walls(canvas, storey, manner)
    _openings(canvas, storey, manner)
    for flight in storey.stairs:
        for step in flight.steps_m or (flight.outline_m,):
            canvas.line(step, 0.7 * manner.pen_px, INK, closed=True)
    style = Style("print", "unseen", "en", ink=INK, pen_px=0.8 * manner.pen_px, capitals=True,
                  weight=400, furniture=0.35)  # fmt: skip
    busy = kept_free(storey)
    labels = labels_of(rng, canvas, style, storey, busy)
    busy = with_labels(busy, labels)
    for label in labels:
        draw_label(canvas, style, label)
    draw_things(canvas, style, furnish(rng, storey, style.furniture, busy))
    written = unary_union([label_box(label) for label in labels])
    _sizes(canvas, storey, manner, written)
    if manner.wires:
        _wires(canvas, storey, manner, rng, busy)
    picture, turn = _scanned(canvas.picture(), rng)
    truth = SheetTruth(
        f"print-{seed:05d}.png", seed, "print", "scanned", ("print",), "hollow",
        turn @ canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return picture, [truth]


def _walls(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    solid = solid_walls(storey)
    canvas.fill(solid, PAPER)
    if manner.between == "dots":
        canvas.hatch(solid, 0.05, 0.4 * manner.pen_px, (150, 150, 150), crossed=True)
    canvas.outline(solid, manner.pen_px, INK)
    if manner.between == "sheathing":
        outer = tuple(one for one in storey.walls if one.outer)
        holes = [opening_area(storey.wall(one.wall), one) for one in storey.openings]
        for wall in outer:
            shift = outward(wall) * (wall.thickness_m / 2.0 - 0.05)
            way = np.subtract(wall.end_m, wall.start_m)
            if wall.bulge or not np.hypot(*way):
                continue
            left = np.array([-way[1], way[0]]) / np.hypot(*way)
            ends = [np.array(wall.start_m) + shift * left, np.array(wall.end_m) + shift * left]
            canvas.line(ends, 0.6 * manner.pen_px, INK)
        for hole in holes:
            canvas.fill(hole.buffer(-0.021), PAPER)


def _openings(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        place = place_of(wall, opening)
        if opening.kind != "window":
            DRAWN[opening.type](Pen(canvas, 0.9 * manner.pen_px, INK), opening, place, True)
            continue
        for side in (-place.half_m, 0.0, place.half_m):
            ends = [place.at(0.0, side), place.at(place.width_m, side)]
            canvas.line(ends, 0.7 * manner.pen_px, INK)
        inches = round(place.width_m / 0.0254 / 2.0) * 2
        text = f"{inches // 12}/{inches % 12} x 4/6"
        spot = place.at(place.width_m / 2.0, outward(wall) * (place.half_m + 0.2))
        upright = abs(place.along[0]) > abs(place.along[1])
        canvas.text(text, (float(spot[0]), float(spot[1])), 9.5, "sans", INK, 400, upright)


def _sizes(canvas: Canvas, storey: Storey, manner: Manner, written: BaseGeometry) -> None:
    """Rows through the house, two each way, and around it, from face to middle to face.

    Those within run where they meet least of what is `written` already.
    """
    left, bottom, right, top = whole_walls(storey.walls).bounds
    height = float(np.clip(0.17 / canvas.metres_per_px, 10.0, 14.0))
    pen = 0.6 * manner.pen_px
    common: dict[str, Any] = {"pen": pen, "ink": INK, "written": feet, "height_px": height,
                              "ends": manner.ends, "gap_m": 0.7}  # fmt: skip
    spans = {0: (left, right), 1: (bottom, top)}
    for axis in (0, 1):
        low, high = spans[1 - axis]
        for shares in ((0.2, 0.26, 0.32, 0.38, 0.44), (0.58, 0.64, 0.7, 0.76, 0.82)):
            levels = [low + share * (high - low) for share in shares]
            level = min(levels, key=lambda one: _met(one, axis, spans[axis], written))
            cuts = crossings(storey, axis, level)
            if len(cuts) > 2:
                ends = [
                    face if abs(cut - face) < 0.3 else cut
                    for face, cut in zip(spans[axis], (cuts[0], cuts[-1]), strict=True)
                ]
                places = [ends[0], *cuts[1:-1], ends[1]]
                chain(canvas, places, level, axis == 0, **common)
        for away in (0.75, 1.4):
            level = low - away
            places = [spans[axis][0], *(
                crossings(storey, axis, low + 0.6)[1:-1] if away < 1.0 else []
            ), spans[axis][1]]  # fmt: skip
            chain(canvas, places, level, axis == 0, **common)
            for place in places:
                drop = [(place, low - 0.15), (place, level - 0.1)]
                canvas.line(drop if axis == 0 else [end[::-1] for end in drop], pen, INK)


def _met(level: float, axis: int, span: tuple[float, float], written: BaseGeometry) -> float:
    """How much of what is written a row and its numbers at a level would cover, in m2."""
    low, high = level - 0.1, level + 0.3
    strip = box(span[0], low, span[1], high) if axis == 0 else box(low, span[0], high, span[1])
    return float(strip.intersection(written).area)


def _wires(
    canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator, busy: BaseGeometry
) -> None:
    """A light in each room, and a dashed curve from it to a switch at a wall."""
    for room in storey.rooms:
        area = Polygon(room.outline_m)
        spot = spot_within(area.difference(busy), 0.3, 0.3)
        if spot is None:
            continue
        middle = box(*spot).centroid
        canvas.outline(Point(middle).buffer(0.11), 0.7 * manner.pen_px, INK)
        edge = area.exterior.interpolate(float(rng.random()), normalized=True)
        ends = np.array([[middle.x, middle.y], [edge.x, edge.y]])
        bow = 0.25 * np.array([-(ends[1] - ends[0])[1], (ends[1] - ends[0])[0]])
        share = np.linspace(0.05, 0.95, 29)[:, None]
        path = (1 - share) * ends[0] + share * ends[1] + np.sin(math.pi * share) * bow
        for low in range(0, 28, 2):
            canvas.line(path[low : low + 2], 0.6 * manner.pen_px, INK)
        canvas.text("S", tuple(0.92 * ends[1] + 0.08 * ends[0]), 9.0, "sans", INK)


def _scanned(picture: Image, rng: np.random.Generator) -> tuple[Image, np.ndarray]:
    """Askew by less than a degree, unevenly grey, grained, a little soft."""
    height, width = picture.shape[:2]
    turn = cv2.getRotationMatrix2D((width / 2.0, height / 2.0), float(rng.uniform(-0.8, 0.8)), 1.0)
    moved = cv2.warpAffine(picture, turn, (width, height), flags=cv2.INTER_CUBIC,
                           borderMode=cv2.BORDER_CONSTANT, borderValue=PAPER)  # fmt: skip
    light = 1.0 - 0.1 * smooth_noise((height, width), 180.0, rng)
    grain = rng.normal(0.0, 4.0, (height, width))
    grey = cv2.cvtColor(moved, cv2.COLOR_RGB2GRAY) * light + grain
    soft = cv2.GaussianBlur(np.clip(grey, 0.0, 255.0), (0, 0), float(rng.uniform(0.5, 0.9)))
    # OpenCV turns about the centres of pixels, which lie at 0.5 in the truth's frame.
    shift = np.array([[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]])
    whole = shift @ np.vstack([turn, [0.0, 0.0, 1.0]]) @ np.linalg.inv(shift)
    return np.repeat(soft.astype(np.uint8)[:, :, None], 3, axis=2), whole
