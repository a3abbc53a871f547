"""The ways in which walls may be drawn: the masks in which they are solid, the likeliest first."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.document import Text, WallDrawing
from veduta.plan.drawn import Cleaned, DrawnStairs
from veduta.plan.stairs.find import without_flights
from veduta.plan.walls.cells import Cells, find_cells
from veduta.plan.walls.fill import fill_cells
from veduta.plan.walls.hatching import hatch_strokes, hatched_areas
from veduta.plan.walls.layers import walls_of_a_colour
from veduta.plan.walls.outlined import wall_cells
from veduta.plan.walls.pens import broader_pens
from veduta.plan.walls.scribbled import scribbled_walls
from veduta.plan.walls.solid import SINGLE_LINE, Thickness, stroke_length, wall_thickness
from veduta.plan.walls.tone import toned_areas
from veduta.run.errors import NotFoundError

KNOWN_THINNEST = 0.12
"""Thinnest wall over the thickest common one, where walls need not be told from lines."""

MORE_WALL = 1.9
"""Hollow walls are believed if filling them makes so many times as much wall as solid ink."""

MOSTLY_PAPER = 0.45
"""Layered walls with so much paper in them are hollow; with less, hatched."""

SMALL_MARK = 0.05
"""Marks of less than this part of the drawing are letters and specks."""

AS_HATCHED = 0.5
"""What has this part of the strokes that walls have, or more, is wall."""

LEAST_STROKES = 0.15
"""What has less than this part of them is none, but a window or a bed."""

MOSTLY = 0.3
"""Walls are hatched if there is so much that is hatched, as a part of the insides of walls."""

LEAST_HATCHING = 0.04
"""Strokes of hatching cover at least this part of what lies between the outlines of walls."""

FINE = 2.5
"""Walls that are thinner than so many lines are no thicker than letters."""

THICK = 0.6
"""Thick walls are at least this part of the thickest common ones."""

CUT = 2.5
"""Walls whose ends are not drawn are parted from rooms, which are so many times as broad."""

LEAKS = 1.3
"""That is done where it shows so many times as much wall."""


@dataclass(frozen=True)
class Way:
    """A way in which the walls of a sheet may be drawn.

    `mask` (h, w): where walls are solid, with other strokes; `ink` (h, w): what is drawn, without
    texts and flights. `told`: whether walls are looked for in the ink, are all that has their
    colour or that their pen drew, were scribbled full by a hand, or are known.
    """

    ink: NDArray[np.bool_]
    mask: NDArray[np.bool_]
    thickness: Thickness
    drawing: WallDrawing
    told: Literal["by ink", "by colour", "by pen", "by hand", "known"] = "by ink"


def known_way(solid: NDArray[np.bool_]) -> Way:
    """Of a sheet of which all walls are known; NotFoundError where there are none.

    The thinnest ones count, however thick others are.
    """
    found = wall_thickness(solid, 1.0)
    if found is None:
        raise NotFoundError("walls", "no solid strokes are long", "Give a floor plan.")
    thickness = Thickness(max(2.0, KNOWN_THINNEST * found.most_px), found.most_px)
    return Way(solid, solid, thickness, "filled", "known")


def ways_drawn(
    cleaned: Cleaned, texts: Sequence[Text], flights: Sequence[DrawnStairs]
) -> Iterator[Way]:
    """The ways that a sheet allows, the likeliest first; treads of `flights` are no walls.

    Outlined walls are one where they are much more wall than the solid ink, and go before it.
    """
    line_px = cleaned.line_px
    marks = inks.marks(cleaned.ink, line_px)
    ink = without_texts(marks | toned_areas(cleaned.ink, line_px), texts)
    ink = without_flights(ink, flights, line_px)
    coloured = walls_of_a_colour(cleaned.pixels, ink, line_px)
    full = None if coloured is None else wall_thickness(coloured, line_px)
    if coloured is not None and full is not None:
        yield Way(ink, coloured, full, "hollow", "by colour")
    yield from ways_of_ink(ink, line_px, cleaned.ink)


def ways_of_ink(
    ink: NDArray[np.bool_], line_px: float, soft: NDArray[np.float32] | None = None
) -> Iterator[Way]:
    """As `ways_drawn`, of ink alone; `soft` (h, w) is how dark it is, 0 to 1."""
    lines = connected(ink)
    outlined = _outlined(ink, lines, line_px, ends_open=True)
    if outlined is not None:
        yield outlined
        # Where ends of walls are closed, parting them from rooms may take what is none.
        closed = _outlined(ink, lines, line_px, ends_open=False)
        if closed is not None and not np.array_equal(closed.mask, outlined.mask):
            yield closed
    layered = _layered(ink, lines, line_px)
    plain = wall_thickness(ink, line_px)
    single = plain is None or plain.most_px < SINGLE_LINE * line_px
    # Furniture that is filled in may be more than thick walls are, but not than all walls.
    last = (
        layered is not None
        and plain is not None
        and not single
        and not _exceeds(layered.mask, ink, plain.least_px)
    )
    if layered is not None and not last:
        yield layered
    if single and soft is not None:
        for pen in broader_pens(soft, ink):
            yield Way(ink, pen.mask, pen.thickness, "single-line", "by pen")
    if plain is not None:
        yield Way(ink, ink, plain, "single-line" if single else "filled")
    if layered is not None and last:
        yield layered
    scribbled = scribbled_walls(ink, line_px)
    if scribbled is not None:
        yield Way(ink, scribbled[0], scribbled[1], "hatched", "by hand")


def _layered(ink: NDArray[np.bool_], lines: NDArray[np.bool_], line_px: float) -> Way | None:
    mask = fill_cells(lines, line_px)
    full = _more_wall(mask, ink, line_px)
    if full is None:
        return None
    paper = float((mask & ~ink).sum() / max(1, mask.sum()))
    return Way(ink, mask, full, "hollow" if paper > MOSTLY_PAPER else "hatched")


def _outlined(
    ink: NDArray[np.bool_], lines: NDArray[np.bool_], line_px: float, *, ends_open: bool
) -> Way | None:
    mask, drawing = outlined_walls(lines, line_px, ends_open=ends_open)
    full = _more_wall(mask, ink & ~mask, line_px)
    return None if full is None else Way(ink, mask, full, drawing)


def _more_wall(
    filled: NDArray[np.bool_], solid: NDArray[np.bool_], line_px: float
) -> Thickness | None:
    """How thick the walls of a filled mask are, if they are much more than those of solid ink."""
    full = wall_thickness(filled, line_px)
    if full is None:
        return None
    # Where thin walls are no thicker than letters and double lines, the thick ones are compared.
    fine = full.least_px < FINE * line_px
    least = THICK * full.most_px if fine else 0.9 * full.least_px
    return full if _exceeds(filled, solid, least) else None


def _exceeds(filled: NDArray[np.bool_], solid: NDArray[np.bool_], least_px: float) -> bool:
    """Whether filling makes much more of what is at least so thick."""
    return stroke_length(filled, least_px) > MORE_WALL * stroke_length(solid, least_px)


def outlined_walls(
    ink: NDArray[np.bool_], line_px: float, *, ends_open: bool = True
) -> tuple[NDArray[np.bool_], WallDrawing]:
    """The mask of hollow and hatched walls with their outlines, and which of both they are.

    `ends_open`: whether walls may run out into rooms, with no line across their ends.
    """
    strokes = hatch_strokes(ink, line_px)
    cells = find_cells(ink & ~strokes, line_px)
    walls = wall_cells(cells)
    if ends_open and walls.any():
        cut_px = CUT * float(np.quantile(np.repeat(cells.breadth, _lengths(cells, walls)), 0.9))
        again = find_cells(ink & ~strokes, line_px, cut_px)
        more = wall_cells(again)
        if _lengths(again, more).sum() > LEAKS * _lengths(cells, walls).sum():
            cells, walls = again, more
    inside = walls[cells.labels]
    hatched = hatched_areas(strokes)
    drawing: WallDrawing = "hollow"
    # Where walls have outlines, their hatching lies in these: arcs of doors have strokes, too.
    lie_in_walls = float((strokes & inside).sum()) >= LEAST_HATCHING * float(inside.sum())
    if hatched.any() and lie_in_walls and float(hatched.sum()) > MOSTLY * float(inside.sum()):
        drawing = "hatched"
        inside = hatched | _as_hatched(cells, walls, strokes)[cells.labels]
    return inside | (ink & _grown(inside, 3 * line_px)), drawing


def _lengths(cells: Cells, chosen: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(n,) whole pixels along the middles of the chosen cells; 0 of others."""
    return np.where(chosen, cells.length, 0.0).astype(np.int64)


def _as_hatched(
    cells: Cells, walls: NDArray[np.bool_], strokes: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """(n,) which narrow cells have strokes in them as walls do, and which walls have some.

    Nothing else is hatched so; but strokes may be lost where they are drawn too finely.
    """
    count = len(cells.area)
    share = np.bincount(cells.labels[strokes], minlength=count) / np.maximum(cells.area, 1.0)
    if not walls.any():
        return walls
    usual = float(np.median(np.repeat(share[walls], cells.length[walls].astype(int) + 1)))
    more = cells.narrow & (share > AS_HATCHED * usual)
    return np.asarray((walls & (share > LEAST_STROKES * usual)) | more, dtype=np.bool_)


def _grown(mask: NDArray[np.bool_], by_px: float) -> NDArray[np.bool_]:
    """A mask and what is around it, by half of `by_px`."""
    reach = 2 * round(by_px / 2) + 1
    square = np.ones((reach, reach), np.uint8)
    return np.asarray(cv2.dilate(mask.astype(np.uint8), square), dtype=np.bool_)


def connected(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The ink of the house: without marks that are smaller than a twentieth of the drawing."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    size = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    keep = size >= SMALL_MARK * (size[1:].max() if len(size) > 1 else 1)
    keep[0] = False
    return np.asarray(keep[labels], dtype=np.bool_)


def without_texts(mask: NDArray[np.bool_], texts: Sequence[Text]) -> NDArray[np.bool_]:
    """The mask without connected ink that lies in boxes of text."""
    if not texts:
        return mask
    boxes = np.zeros(mask.shape, np.uint8)
    for text in texts:
        cv2.fillPoly(boxes, [np.round(np.array(text.box_px)).astype(np.int32)], 1)
    count, labels = cv2.connectedComponents(mask.astype(np.uint8), connectivity=8)
    total = np.bincount(labels.ravel(), minlength=count)
    inside = np.bincount(labels[boxes > 0], minlength=count)
    letters = inside > 0.8 * total
    letters[0] = False
    return np.asarray(mask & ~letters[labels], dtype=np.bool_)
