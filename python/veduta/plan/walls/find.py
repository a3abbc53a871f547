"""Walls of a cleaned sheet as straight and curved pieces, whatever way they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.document import Text, WallDrawing
from veduta.plan.drawn import Cleaned, DrawnStairs
from veduta.plan.stairs.find import without_flights
from veduta.plan.walls.cells import Cells, find_cells
from veduta.plan.walls.curved import curved_pieces, lies_in
from veduta.plan.walls.fill import fill_cells
from veduta.plan.walls.hatching import hatch_strokes, hatched_areas
from veduta.plan.walls.jogs import jogs
from veduta.plan.walls.join import joined
from veduta.plan.walls.layers import walls_of_a_colour
from veduta.plan.walls.measure import measured
from veduta.plan.walls.outlined import wall_cells
from veduta.plan.walls.outlines import without_half_outline
from veduta.plan.walls.pieces import Piece, straight_pieces
from veduta.plan.walls.solid import (
    SINGLE_LINE,
    Thickness,
    stroke_length,
    thick_strokes,
    wall_thickness,
    without_marks,
)
from veduta.plan.walls.tone import toned_areas
from veduta.plan.walls.tracks import find_tracks
from veduta.run.errors import NotFoundError

MOST_PIECES = 1500
"""More short strokes are a photo or a texture, and would take minutes."""


MORE_WALL = 1.9
"""Hollow walls are believed if filling them makes so many times as much wall as solid ink."""

MOSTLY_PAPER = 0.45
"""Layered walls with so much paper in them are hollow; with less, hatched."""

KNOWN_THINNEST = 0.12
"""Thinnest wall over the thickest common one, where walls need not be told from lines."""

SMALL_MARK = 0.05

AS_HATCHED = 0.5
"""What has this part of the strokes that walls have, or more, is wall."""

SINGLE_LEAST = 0.9
"""Leaves of doors are drawn as lines that are thinner than walls by this factor, or more."""

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

PALE = 0.65
"""What has less than this part of the walls' usual ink is no wall."""


@dataclass(frozen=True)
class Found:
    """Straight and curved pieces of wall, the mask of them, and how thick walls are.

    `by_colour`: they were told by the colour of their lines, so that nothing else is in the mask.
    """

    pieces: list[Piece]
    solid: NDArray[np.bool_]
    thickness: Thickness
    thin_px: float
    curved: list[Piece] = field(default_factory=list)
    by_colour: bool = False


def find_walls(
    cleaned: Cleaned,
    texts: Sequence[Text] = (),
    known: NDArray[np.bool_] | None = None,
    flights: Sequence[DrawnStairs] = (),
) -> Found:
    """Find the pieces; NotFoundError where no strokes are walls.

    `known` is the (h, w) mask of all that is wall, where that is known and not looked for. Treads
    of `flights` are no walls.
    """
    by_colour = False
    drawing: WallDrawing = "filled"
    if known is None:
        marks = inks.marks(cleaned.ink, cleaned.line_px)
        ink = without_texts(marks | toned_areas(cleaned.ink, cleaned.line_px), texts)
        ink = without_flights(ink, flights, cleaned.line_px)
        coloured = walls_of_a_colour(cleaned.pixels, ink, cleaned.line_px)
        full = None if coloured is None else wall_thickness(coloured, cleaned.line_px)
        if coloured is not None and full is not None:
            mask, thickness, drawing, by_colour = coloured, full, "hollow", True
        else:
            mask, thickness, drawing = choose_drawing(ink, cleaned.line_px)
    else:
        ink = mask = known
        thickness = known_thickness(known)
    # Of what is known, short piers between openings count, too.
    solid = thick_strokes(mask, thickness) if known is None else known
    if known is None and drawing in ("filled", "single-line"):
        # Shaded panes are thick strokes, too, but paler than the walls.
        solid = without_marks(solid, mask, thickness)
        level = float(np.median(cleaned.ink[solid])) if solid.any() else 1.0
        dark = mask & (cleaned.ink > PALE * level)
        if drawing == "single-line":
            # The edges of lines are as pale as panes: without them all lines are thinner.
            thickness = wall_thickness(dark, cleaned.line_px) or thickness
        solid = without_marks(thick_strokes(dark, thickness), dark, thickness)
    least_px = 0.8 * thickness.least_px
    if drawing == "single-line":
        # Tracks are whole pixels wide, which is much of a line; the measured width judges later.
        least_px -= 0.5
    curved, tracks = curved_pieces(find_tracks(solid), solid, least_px, drawing)
    pieces = straight_pieces(tracks, least_px, drawing)
    if len(pieces) > MOST_PIECES:
        pieces = sorted(pieces, key=lambda one: -one.length_px)[:MOST_PIECES]
    # What was filled in is as solid as ink.
    ink_of_walls = known.astype(np.float32) if known is not None else cleaned.ink
    soft = np.where(mask & ~ink, np.float32(1), ink_of_walls)
    whole = [measured(one, soft) for one in joined(pieces, solid) if _is_wall(one, thickness)]
    curved = [measured(one, soft) for one in curved]
    whole = [one for one in whole if not any(lies_in(one, arc) for arc in curved)]
    if known is None:
        whole = without_half_outline(whole, cleaned.ink, cleaned.line_px)
    if drawing == "single-line":
        whole, curved = (
            [one for one in some if one.thickness_px >= SINGLE_LEAST * thickness.least_px]
            for some in (whole, curved)
        )
    if known is None:
        whole = [*whole, *jogs(whole, solid)]
    if not whole and not curved:
        raise NotFoundError("walls", "no thick strokes are straight", "Give a floor plan.")
    return Found(whole, solid, thickness, thin_thickness([*whole, *curved]), curved, by_colour)


def choose_drawing(
    ink: NDArray[np.bool_], line_px: float
) -> tuple[NDArray[np.bool_], Thickness, WallDrawing]:
    """The mask in which walls are solid: the ink itself, or the insides of outlined walls.

    The latter where they are much more wall than the solid ink beside them. Raises NotFoundError
    where neither has walls.
    """
    lines = connected(ink)
    plain = wall_thickness(ink, line_px)
    outlined, drawing = outlined_walls(lines, line_px)
    full = _more_wall(outlined, ink & ~outlined, line_px)
    if full is not None:
        return outlined, full, drawing
    layered = fill_cells(lines, line_px)
    full = _more_wall(layered, ink, line_px)
    if full is not None:
        paper = float((layered & ~ink).sum() / max(1, layered.sum()))
        return layered, full, "hollow" if paper > MOSTLY_PAPER else "hatched"
    if plain is None:
        raise NotFoundError("walls", "no strokes are thicker than lines", "Give a floor plan.")
    return ink, plain, "single-line" if plain.most_px < SINGLE_LINE * line_px else "filled"


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
    more = stroke_length(filled, least) > MORE_WALL * stroke_length(solid, least)
    return full if more else None


def outlined_walls(ink: NDArray[np.bool_], line_px: float) -> tuple[NDArray[np.bool_], WallDrawing]:
    """The mask of hollow and hatched walls with their outlines, and which of both they are."""
    strokes = hatch_strokes(ink, line_px)
    cells = find_cells(ink & ~strokes, line_px)
    walls = wall_cells(cells)
    if walls.any():
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


def known_thickness(solid: NDArray[np.bool_]) -> Thickness:
    """Of walls that are known: the thinnest ones count, however thick others are."""
    found = wall_thickness(solid, 1.0)
    if found is None:
        raise NotFoundError("walls", "no solid strokes are long", "Give a floor plan.")
    return Thickness(max(2.0, KNOWN_THINNEST * found.most_px), found.most_px)


def connected(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The ink of the house: without marks that are smaller than a twentieth of the drawing."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    size = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    keep = size >= SMALL_MARK * (size[1:].max() if len(size) > 1 else 1)
    keep[0] = False
    return np.asarray(keep[labels], dtype=np.bool_)


def thin_thickness(pieces: Sequence[Piece]) -> float:
    """The thickness of thin walls: a quarter of the length of all walls is no thicker."""
    thick = np.array([one.thickness_px for one in pieces])
    length = np.array([one.length_px for one in pieces])
    order = np.argsort(thick)
    total = np.cumsum(length[order])
    return float(thick[order][np.searchsorted(total, 0.25 * total[-1])])


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


def _is_wall(piece: Piece, thickness: Thickness) -> bool:
    # Corners of blobs look like short slanted strokes.
    upright = float(np.abs(piece.direction).max()) > 1 - 1e-9
    aspect = 0.5 if upright else 1.2
    return piece.length_px >= max(aspect * piece.thickness_px, thickness.least_px)
