"""Walls of a cleaned sheet as straight pieces, whatever way they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.document import Text, WallDrawing
from veduta.plan.drawn import Cleaned, DrawnStairs
from veduta.plan.stairs.find import without_flights
from veduta.plan.walls.cells import fill_cells, stroke_length
from veduta.plan.walls.join import joined
from veduta.plan.walls.measure import measured
from veduta.plan.walls.pieces import Piece, straight_pieces
from veduta.plan.walls.solid import Thickness, thick_strokes, wall_thickness
from veduta.plan.walls.tracks import find_tracks
from veduta.run.errors import NotFoundError

MOST_PIECES = 1500
"""More short strokes are a photo or a texture, and would take minutes."""


MORE_WALL = 1.9
"""Hollow walls are believed if filling them makes so many times as much wall as solid ink."""

KNOWN_THINNEST = 0.12
"""Thinnest wall over the thickest common one, where walls need not be told from lines."""

SMALL_MARK = 0.05

PALE = 0.65
"""What has less than this part of the walls' usual ink is no wall."""


@dataclass(frozen=True)
class Found:
    """Pieces of wall, the mask that they were found in, and how thick walls are."""

    pieces: list[Piece]
    solid: NDArray[np.bool_]
    thickness: Thickness
    thin_px: float


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
    if known is None:
        ink = without_texts(inks.marks(cleaned.ink, cleaned.line_px), texts)
        ink = without_flights(ink, flights, cleaned.line_px)
        mask, thickness, drawing = choose_drawing(ink, cleaned.line_px)
    else:
        ink = mask = known
        thickness, drawing = known_thickness(known), "filled"
    solid = thick_strokes(mask, thickness)
    if drawing == "filled" and known is None:
        # Shaded panes are thick strokes, too, but paler than the walls.
        level = float(np.median(cleaned.ink[solid])) if solid.any() else 1.0
        solid = thick_strokes(mask & (cleaned.ink > PALE * level), thickness)
    pieces = straight_pieces(find_tracks(solid), 0.8 * thickness.least_px, drawing)
    if len(pieces) > MOST_PIECES:
        pieces = sorted(pieces, key=lambda one: -one.length_px)[:MOST_PIECES]
    # What was filled in is as solid as ink.
    ink_of_walls = known.astype(np.float32) if known is not None else cleaned.ink
    soft = np.where(mask & ~ink, np.float32(1), ink_of_walls)
    whole = [measured(one, soft) for one in joined(pieces, solid) if _is_wall(one, thickness)]
    if not whole:
        raise NotFoundError("walls", "no thick strokes are straight", "Give a floor plan.")
    return Found(whole, solid, thickness, thin_thickness(whole))


def choose_drawing(
    ink: NDArray[np.bool_], line_px: float
) -> tuple[NDArray[np.bool_], Thickness, WallDrawing]:
    """The mask in which walls are solid: the ink itself, or with narrow cells filled.

    Cells are filled where that makes much more wall than there is solid ink. Raises NotFoundError
    where neither has walls.
    """
    plain = wall_thickness(ink, line_px)
    filled = fill_cells(connected(ink), line_px)
    full = wall_thickness(filled, line_px)
    least = 0.9 * full.least_px if full else 0.0
    solid_length = stroke_length(ink, least) if plain else 0.0
    if full is not None and stroke_length(filled, least) > MORE_WALL * solid_length:
        share = float((filled & ~ink).sum() / max(1, filled.sum()))
        return filled, full, "hollow" if share > 0.45 else "hatched"
    if plain is None:
        raise NotFoundError("walls", "no strokes are thicker than lines", "Give a floor plan.")
    return ink, plain, "filled"


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
