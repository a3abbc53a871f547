"""Walls of a cleaned sheet as straight and curved pieces, whatever way they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.plan.drawn import Cleaned
from veduta.plan.walls.blobs import without_blobs
from veduta.plan.walls.breasts import without_breasts
from veduta.plan.walls.curved import curved_pieces, lies_in
from veduta.plan.walls.jogs import jogs
from veduta.plan.walls.join import joined
from veduta.plan.walls.measure import measured
from veduta.plan.walls.outlines import without_half_outline
from veduta.plan.walls.pale import pale_walls
from veduta.plan.walls.pieces import Piece, straight_pieces
from veduta.plan.walls.solid import (
    Thickness,
    thick_strokes,
    wall_thickness,
    without_marks,
)
from veduta.plan.walls.tracks import find_tracks
from veduta.plan.walls.ways import Way
from veduta.run.errors import NotFoundError

MOST_PIECES = 1500
"""More short strokes are a photo or a texture, and would take minutes."""

SINGLE_LEAST = 0.9
"""Leaves of doors are drawn as lines that are thinner than walls by this factor, or more."""

UPRIGHT, SLANTED, SHORT_SLANTED = 0.5, 1.2, 1.0
"""Upright and slanted walls are so many times as long as thick, and sides of bays."""

ALIKE = 0.2
"""Sides of a bay are as thick as the walls beside them but for this part."""

BLOB = 0.75
"""What is shorter than thin walls are thick, and thinner than this part of that, is no wall."""

PALE = 0.65
"""What has less than this part of the walls' usual ink is no wall."""

SHADED, PALE_SHADED = 0.7, 0.5
"""Where things that are too thick for walls take so much of all solid ink, this part suffices."""


@dataclass(frozen=True)
class Found:
    """Straight and curved pieces of wall, the mask of them, and how thick walls are.

    `by_colour`: they were told by the colour of their lines, so that nothing else is in the mask.
    `sized`: `thin_px` is not measured but follows from how wide doors are.
    """

    pieces: list[Piece]
    solid: NDArray[np.bool_]
    thickness: Thickness
    thin_px: float
    curved: list[Piece] = field(default_factory=list)
    by_colour: bool = False
    sized: bool = False


def find_walls(cleaned: Cleaned, way: Way) -> Found:
    """Find the pieces, as they are drawn; NotFoundError where no strokes are walls."""
    drawing = way.drawing
    known = way.told == "known"
    solid, thickness = _solid(cleaned, way)
    least_px = 0.8 * thickness.least_px
    if drawing == "single-line":
        # Tracks are whole pixels wide, which is much of a line; the measured width judges later.
        least_px -= 0.5
    tracks = find_tracks(solid)
    if drawing != "single-line" and not known:
        cleared, count = without_breasts(solid, tracks, thickness)
        if count:
            solid, tracks = cleared, find_tracks(cleared)
    curved, tracks = curved_pieces(tracks, solid, least_px, drawing)
    pieces = straight_pieces(tracks, least_px, drawing)
    if len(pieces) > MOST_PIECES:
        pieces = sorted(pieces, key=lambda one: -one.length_px)[:MOST_PIECES]
    # What was filled in is as solid as ink.
    ink_of_walls = way.mask.astype(np.float32) if known else cleaned.ink
    soft = np.where(way.mask & ~way.ink, np.float32(1), ink_of_walls)
    whole = [measured(one, soft) for one in _walls_among(joined(pieces, solid), thickness)]
    curved = [measured(one, soft) for one in curved]
    whole = [one for one in whole if not any(lies_in(one, arc) for arc in curved)]
    if not known:
        whole = without_half_outline(whole, cleaned.ink, cleaned.line_px)
    if drawing == "single-line":
        whole, curved = (
            [one for one in some if one.thickness_px >= SINGLE_LEAST * thickness.least_px]
            for some in (whole, curved)
        )
    if not known:
        whole = [*whole, *jogs(whole, solid)]
    if not whole and not curved:
        raise NotFoundError("walls", "no thick strokes are straight", "Give a floor plan.")
    thin_px = thin_thickness([*whole, *curved])
    if not known:
        whole = [one for one in whole if not _is_blob(one, thin_px)]
    return Found(whole, solid, thickness, thin_px, curved, way.told == "by colour")


def _solid(cleaned: Cleaned, way: Way) -> tuple[NDArray[np.bool_], Thickness]:
    """The mask of what is wall for its thickness and its tone, and how thick walls are."""
    drawing, thickness = way.drawing, way.thickness
    # Of what is known, short piers between openings count, too; a pen's strokes may be thin.
    alone = way.told in ("known", "by pen")
    solid = way.mask if alone else thick_strokes(way.mask, thickness)
    if way.told == "by pen":
        return without_marks(solid, way.mask, thickness), thickness
    if way.told == "known" or drawing not in ("filled", "single-line"):
        return solid, thickness
    # Shaded panes are thick strokes, too, but paler than the walls.
    solid = without_marks(solid, way.mask, thickness)
    slim = without_blobs(solid, thickness) if drawing == "filled" else solid
    shaded = drawing == "filled" and int(slim.sum()) < SHADED * int(solid.sum())
    level = float(np.median(cleaned.ink[slim])) if slim.any() else 1.0
    # Beside large shaded things walls that are thin and pale are walls all the same.
    dark = way.mask & (cleaned.ink > (PALE_SHADED if shaded else PALE) * level)
    if drawing == "single-line":
        # The edges of lines are as pale as panes: without them all lines are thinner.
        thickness = wall_thickness(dark, cleaned.line_px) or thickness
    every = solid
    solid = without_marks(thick_strokes(dark, thickness), dark, thickness)
    if drawing == "filled":
        solid = solid | pale_walls(every, solid, thickness)
    return (without_blobs(solid, thickness) if drawing == "filled" else solid), thickness


def thin_thickness(pieces: Sequence[Piece]) -> float:
    """The thickness of thin walls: a quarter of the length of all walls is no thicker."""
    thick = np.array([one.thickness_px for one in pieces])
    length = np.array([one.length_px for one in pieces])
    order = np.argsort(thick)
    total = np.cumsum(length[order])
    return float(thick[order][np.searchsorted(total, 0.25 * total[-1])])


def _is_blob(piece: Piece, thin_px: float) -> bool:
    """Whether a piece is no more than the place where lines of furniture meet at a wall."""
    return piece.length_px < thin_px and piece.thickness_px < BLOB * thin_px


def _walls_among(pieces: Sequence[Piece], thickness: Thickness) -> list[Piece]:
    """The pieces that are long enough for walls.

    Corners of blobs look like short slanted strokes. Those that are hardly longer than thick are
    sides of a bay if they lead from the end of one wall to that of another.
    """
    sure: list[Piece] = []
    short: list[Piece] = []
    for one in pieces:
        slanted = float(np.abs(one.direction).max()) <= 1 - 1e-9
        if one.length_px < thickness.least_px:
            continue
        if one.length_px >= (SLANTED if slanted else UPRIGHT) * one.thickness_px:
            sure.append(one)
        elif slanted and one.length_px >= SHORT_SLANTED * one.thickness_px:
            short.append(one)
    return [*sure, *(one for one in short if _leads_on(one, sure))]


def _leads_on(piece: Piece, walls: Sequence[Piece]) -> bool:
    """Whether walls as thick as it end at both of its ends, one at each."""
    alike = [one for one in walls if abs(one.thickness_px / piece.thickness_px - 1) <= ALIKE]
    at = []
    for end in (piece.start, piece.end):
        near = (
            index
            for index, one in enumerate(alike)
            if min(np.hypot(*(one.start - end)), np.hypot(*(one.end - end))) <= piece.thickness_px
        )
        at.append(next(near, None))
    return None not in at and at[0] != at[1]
