"""An architect's sketch plan: one thin pen for walls, doors, furniture and names alike.

Walls are single hair lines, windows short boxes over them, doors leaves with their arcs. Nothing
is heavier than anything else.
"""

from __future__ import annotations

from shapely.geometry import Polygon

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.bodies import whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free, with_thin_walls
from veduta.synthetic.plans.foreign.floors import floor_of, leaves_of, turned_leaf
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.house import Opening, Wall
from veduta.synthetic.plans.labels import draw_label, labels_of, with_labels
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INKS: tuple[Colour, ...] = ((20, 20, 20), (70, 70, 74), (40, 50, 90))


def hairline_sheet(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "hairline")
    ink = INKS[int(rng.integers(len(INKS)))]
    pen, metres_per_px = float(rng.uniform(1.1, 1.8)), 1.0 / float(rng.uniform(48.0, 80.0))
    storey = with_thin_walls(floor_of(seed, "hairline", "en"), pen * metres_per_px)
    left, bottom, right, top = whole_walls(storey.walls).bounds
    canvas = Canvas((left - 1.2, bottom - 1.2, right + 1.2, top + 1.2), metres_per_px,
                    (255, 255, 255))  # fmt: skip
    for wall in storey.walls:
        _line(canvas, wall, [one for one in storey.openings if one.wall == wall.id], pen, ink)
    for opening in storey.openings:
        _opening(canvas, storey.wall(opening.wall), opening, pen, ink)
    for flight in storey.stairs:
        canvas.outline(Polygon(flight.outline_m), pen, ink)
        for step in flight.steps_m:
            canvas.line(step, pen, ink, closed=True)
    style = Style("hairline", "unseen", "en", ink=ink, pen_px=pen / 0.75, sizes="area",
                  furniture=float(rng.choice([0.4, 0.9])))  # fmt: skip
    busy = kept_free(storey)
    labels = labels_of(rng, canvas, style, storey, busy)
    busy = with_labels(busy, labels)
    for label in labels:
        draw_label(canvas, style, label)
    draw_things(canvas, style, furnish(rng, storey, style.furniture, busy))
    truth = SheetTruth(
        f"hairline-{seed:05d}.png", seed, "hairline", "clean", ("hairline",), "single-line",
        canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return canvas.picture(), [truth]


def _line(canvas: Canvas, wall: Wall, own: list[Opening], pen: float, ink: Colour) -> None:
    """The wall's one line, which ends at doors and runs on under windows."""
    size, start = curves.wall_length(wall), 0.0
    doors = sorted((one for one in own if one.kind != "window"), key=lambda one: one.along_m)
    for door in doors:
        canvas.line(curves.line(wall, start / size, door.along_m / size), pen, ink)
        start = door.along_m + door.width_m
    canvas.line(curves.line(wall, start / size, 1.0), pen, ink)


def _opening(canvas: Canvas, wall: Wall, opening: Opening, pen: float, ink: Colour) -> None:
    place = place_of(wall, opening)
    if opening.kind == "window":
        canvas.outline(place.box(0.0, place.width_m, -0.06, 0.06), pen, ink)
    elif opening.type in ("swing", "double", "french"):
        for leaf in leaves_of(opening):
            turned_leaf(canvas, place, leaf, pen, ink)
    elif opening.type in ("sliding", "pocket"):
        low = 0.0 if opening.type == "sliding" else -0.3 * place.width_m
        for shift, from_m, to_m in ((0.04, low, 0.55), (-0.04, 0.45, 1.0)):
            if opening.type == "pocket" and shift < 0.0:
                continue
            ends = [place.at(from_m * place.width_m, shift), place.at(to_m * place.width_m, shift)]
            canvas.line(ends, pen, ink)
    else:
        DRAWN[opening.type](Pen(canvas, pen, ink), opening, place, False)
