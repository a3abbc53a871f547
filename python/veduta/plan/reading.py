"""The recipe of reading: the picture of a storey in, its walls, openings and rooms out.

The order: straighten, tell ink from paper, find solid strokes, follow them into pieces, look for
openings between the pieces, join them into axes, close where those are broken, judge the openings
once more by what lies behind them, let the axes meet, and find rooms.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point

from veduta.plan.clean import ink as inks
from veduta.plan.clean.letterhead import within_letterhead
from veduta.plan.clean.sheet import clean_sheet
from veduta.plan.document import Text
from veduta.plan.drawing_out import drawn_from
from veduta.plan.drawn import Cleaned, Drawn, DrawnStairs
from veduta.plan.openings.along import with_unbroken
from veduta.plan.openings.classify import PLAIN_DOORS, PLAIN_WIDTH, Judged, judge
from veduta.plan.openings.curved_gaps import gaps_on_circles
from veduta.plan.openings.evidence import Views
from veduta.plan.openings.gaps import find_gaps, trimmed
from veduta.plan.openings.jambs import with_jambed
from veduta.plan.openings.labelled import Labels, said_window, window_labels, with_said
from veduta.plan.openings.leaf_pieces import (
    free_leaves,
    hung_leaves,
    leaf_pieces,
    slid,
    slim_panels,
    unproven,
)
from veduta.plan.openings.outdoors import leads_outdoors
from veduta.plan.openings.pockets import with_pockets
from veduta.plan.openings.settle import USUAL_DOOR, settled, usual_door
from veduta.plan.openings.sky import open_sky
from veduta.plan.openings.strip import Sheet
from veduta.plan.openings.ticks import panels_beyond, tick_pieces
from veduta.plan.remarks import PLOT_NOTE
from veduta.plan.rooms.apart import without_apart
from veduta.plan.rooms.labels import room_labels, without_printed
from veduta.plan.rooms.mend import mended
from veduta.plan.stairs.find import find_flights
from veduta.plan.text.sheet_text import moved_texts
from veduta.plan.walls.axes import Axis, axes_of
from veduta.plan.walls.bays import with_bends
from veduta.plan.walls.fence import fence_pieces, ring_pieces
from veduta.plan.walls.find import Found, find_walls
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.ways import Way, known_way, ways_drawn
from veduta.run.errors import NotFoundError

APART = 0.7
"""A reading is believed in which so many rooms have a label, as a part of the labels ..."""

FEWEST_LABELS = 4
"""... where there are so many; otherwise other ways in which walls may be drawn are tried."""

SURE_DOOR = 0.8
"""One or two doors say how wide they are if their leaves are drawn so well."""

SIZINGS = 2
"""More doors are found where their usual width is known, and say it better."""

MOST_WALLS = 250
"""A reading with more stands: each takes a minute, and most of them are noise."""


@dataclass(frozen=True)
class KnownWalls:
    """Of a sheet that was drawn from vectors: `solid` (h, w) is the mask of all wall, or None.

    `settle` lays the axes that were found onto the lines that they were drawn by.
    """

    solid: NDArray[np.bool_] | None
    settle: Callable[[Sequence[Axis]], Sequence[Axis]]


def cleaned_sheet(
    pixels: NDArray[np.uint8], texts: Sequence[Text], subject: str = "the drawing"
) -> tuple[Cleaned, list[Text]]:
    """A sheet (h, w, 3) laid straight, its ink, and its texts in pixels of that.

    What names or measures rooms in a letterhead is left out with it; a scale or a title is not.
    """
    cleaned = clean_sheet(pixels, subject)
    own = without_printed(texts, within_letterhead(pixels))
    return cleaned, moved_texts(own, cleaned.clean_from_scan)


def read_storey(
    pixels: NDArray[np.uint8],
    texts: Sequence[Text] = (),
    subject: str = "the drawing",
) -> Drawn:
    """Walls, openings and rooms of one storey from (h, w, 3) sRGB pixels.

    `texts` are in pixels of the given picture. Sizes count in wall thicknesses.
    Raises NotFoundError where the picture, which it calls `subject`, shows no plan.
    """
    return read_cleaned(*cleaned_sheet(pixels, texts, subject))


def read_cleaned(
    cleaned: Cleaned,
    texts: Sequence[Text] = (),
    known: KnownWalls | None = None,
) -> Drawn:
    """As `read_storey`, of a cleaned sheet; texts are in its pixels.

    `stairs` of the result are all that look like flights: `stairs.find.true_flights` tells which of
    them are, by the scale.

    `known` walls are not looked for in the ink.
    """
    flights = find_flights(inks.marks(cleaned.ink, cleaned.line_px), cleaned.line_px, texts)
    if known is not None and known.solid is not None:
        sheet = Sheeted(cleaned, texts, flights, known, fenced=True)
        return replace(_read(sheet, known_way(known.solid)), stairs=flights)
    return replace(_likeliest_way(Sheeted(cleaned, texts, flights, known)), stairs=flights)


@dataclass(frozen=True)
class Sheeted:
    """What is read: a cleaned sheet, its texts and flights in its pixels, what is known of walls.

    `fenced`: the wall around the plot was taken out of it.
    """

    cleaned: Cleaned
    texts: Sequence[Text]
    flights: Sequence[DrawnStairs]
    known: KnownWalls | None
    fenced: bool = False

    def without(self, found: Found, fence: Sequence[Piece]) -> tuple[Sheeted, Found]:
        """The same without the wall around the plot, and the walls that are left."""
        cleaned, inner = without_fence(self.cleaned, found, fence)
        return replace(self, cleaned=cleaned, fenced=True), inner


def _likeliest_way(sheet: Sheeted) -> Drawn:
    """The reading in the way of drawing walls in which most names have a room of their own."""
    labels = room_labels(sheet.texts, indoors=True)
    tried: list[Way | None] = []

    def readings() -> Iterator[Callable[[float], Drawn]]:
        # Hatched walls of a house within a ring look scribbled, too: that is asked last of all.
        by_hand: list[Way] = []
        for way in ways_drawn(sheet.cleaned, sheet.texts, sheet.flights):
            if way.told == "by hand":
                by_hand.append(way)
                continue
            tried.append(way)
            yield partial(_read, sheet, way)
        first = next((way for way in (*tried, *by_hand) if way is not None), None)
        if not sheet.fenced and first is not None:
            tried.append(None)
            yield partial(_within_ring, sheet, first)
        for way in by_hand:
            tried.append(way)
            yield partial(_read, sheet, way)

    likely, drawn = likeliest(readings(), labels)
    way = tried[likely]
    if sheet.known is None and way is not None and _with_own_rooms(drawn, labels) < 1.0:
        # The least invention: what thin lines close counts once it is known how walls are drawn.
        closed = _read(sheet, way, thin=True)
        # Within a fence the walls may have been read in another way than that.
        drawn = _better(drawn, closed, labels) if PLOT_NOTE in drawn.notes else closed
    return without_apart(drawn, labels)


def _within_ring(sheet: Sheeted, way: Way, most_pieces: float) -> Drawn:
    """The house within a ring of walls that are drawn otherwise; NotFoundError without a ring."""
    found = _found(sheet, way, most_pieces)
    ring = [found.pieces[one] for one in sorted(ring_pieces(found.pieces, found.thin_px))]
    if not ring:
        raise NotFoundError("walls", "no wall stands around the plot", "Give a floor plan.")
    return _noted(_likeliest_way(sheet.without(found, ring)[0]))


def _drawn_otherwise(sheet: Sheeted, way: Way) -> bool:
    """Whether the walls of a sheet look drawn in another way than it was read with its fence."""
    first = next(ways_drawn(sheet.cleaned, sheet.texts, sheet.flights), None)
    return first is not None and first.drawing != way.drawing


def _noted(drawn: Drawn) -> Drawn:
    return replace(drawn, notes=(PLOT_NOTE, *(one for one in drawn.notes if one != PLOT_NOTE)))


def likeliest(
    readings: Iterable[Callable[[float], Drawn]], labels: Sequence[NDArray[np.float64]]
) -> tuple[int, Drawn]:
    """The first reading in which most labels have a room each, or the best of all; with its place.

    `labels` are middles (2,) px. Where there are fewer than FEWEST_LABELS, the first reading
    stands. Each is asked with the number of pieces of wall from which on it is noise: any at first,
    and fewer once noise was read. Raises NotFoundError as the first does, if none is one.
    """
    best: Drawn | None = None
    most, fault, likely, most_pieces = -1.0, None, 0, math.inf
    for place, reading in enumerate(readings):
        try:
            drawn = reading(most_pieces)
        except NotFoundError as error:
            fault, share = fault or error, -1.0
        else:
            share = _with_own_rooms(drawn, labels)
            if len(drawn.walls) > MOST_WALLS:
                most_pieces = MOST_WALLS
            if share > most:
                best, most, likely = drawn, share, place
        large = best is not None and len(best.walls) > MOST_WALLS
        # Noise without a room that is named is no reading yet, but more of it would be none either.
        if share >= APART or len(labels) < FEWEST_LABELS or (large and most > 0.0):
            break
    if best is None:
        raise fault or NotFoundError(
            "walls", "no strokes are thicker than lines", "Give a floor plan."
        )
    return likely, best


def _with_own_rooms(drawn: Drawn, labels: Sequence[NDArray[np.float64]]) -> float:
    """How many rooms have a label, as a part of the labels."""
    points = [Point(*one) for one in labels]
    rooms = [room.polygon() for room in drawn.rooms]
    named = sum(any(room.contains(point) for point in points) for room in rooms)
    return named / max(1, len(points))


def _found(sheet: Sheeted, way: Way, most_pieces: float) -> Found:
    """The walls of a sheet; NotFoundError where they are more pieces than that."""
    found = find_walls(sheet.cleaned, way)
    if len(found.pieces) > most_pieces:
        raise NotFoundError(
            "walls", f"{len(found.pieces)} strokes would be walls", "Give a floor plan."
        )
    return found


def _read(
    sheeted: Sheeted, way: Way, most_pieces: float = math.inf, *, thin: bool = False
) -> Drawn:
    """One reading; thin: rooms with a name are closed along any lines around them."""
    found = _found(sheeted, way, most_pieces)
    fence = [found.pieces[one] for one in sorted(fence_pieces(found.pieces, found.thin_px))]
    if not fence:
        return _read_found(sheeted, found, way, thin)
    within, inner = sheeted.without(found, fence)
    drawn = _noted(_read_found(within, inner, way, thin))
    if sheeted.fenced or thin or not _drawn_otherwise(within, way):
        return drawn
    try:
        other = _noted(_likeliest_way(within))
    except NotFoundError:
        return drawn
    return _better(drawn, other, room_labels(sheeted.texts, indoors=True))


def _better(first: Drawn, second: Drawn, labels: Sequence[NDArray[np.float64]]) -> Drawn:
    """The reading that agrees better with the names on the sheet; the first where both do."""
    return max(first, second, key=lambda one: _by_names(one, labels))


def _by_names(drawn: Drawn, labels: Sequence[NDArray[np.float64]]) -> tuple[float, int]:
    """How well a reading agrees with the names on the sheet: more is better."""
    return _with_own_rooms(drawn, labels), -abs(len(drawn.rooms) - len(labels))


def _read_found(sheeted: Sheeted, found: Found, way: Way, thin: bool) -> Drawn:
    """The openings and rooms of these walls."""
    cleaned, texts, known = sheeted.cleaned, sheeted.texts, sheeted.known
    sheet = Sheet(cleaned.ink, inks.faint_marks(cleaned.ink, cleaned.line_px))
    if known is None:
        found = with_bends(found, sheet.faint)
    views = Views(sheet)
    said = Labels(window_labels(texts), USUAL_DOOR * found.thin_px, cleaned.line_px)
    judged = judge_gaps(found, views, said)
    pen_px = found.thin_px
    for _ in range(SIZINGS):
        if (sized := sized_by_doors(found, judged, pen_px)) is found:
            break
        found = sized
        said = replace(said, door_px=USUAL_DOOR * found.thin_px)
        judged = judge_gaps(found, views, said)
    said = replace(said, door_px=usual_door(judged) or said.door_px)
    leaves = leaf_pieces(found.pieces, judged)
    if known is None:
        leaves |= tick_pieces(found, views)
    if known is None and way.drawing == "filled":
        door_px = usual_door(judged) or USUAL_DOOR * found.thin_px
        leaves |= free_leaves(found.pieces, found.thin_px, door_px)
        leaves |= hung_leaves(found.pieces, judged, found.thin_px)
        leaves |= _panels(found, door_px, views, said)
    if leaves:
        found = without_pieces(found, leaves)
        judged = judge_gaps(found, views, said)
    if known is None:
        judged = [*judged, *panels_beyond(found, views)]
    axes = axes_of([*found.pieces, *found.curved], judged)
    if known is None:
        axes = with_pockets(axes, sheet, usual_door(judged) or USUAL_DOOR * found.thin_px)
    if known is None and way.drawing == "filled":
        axes = unproven(axes, found.thin_px)
    # What a vector file says of its openings goes before what its picture looks like; in walls that
    # are told by their colour, what else is drawn in them is lines of axes.
    told = known is not None or found.by_colour
    whole = mended(axes, found, sheet, texts, by_lines=not told, thin=thin)
    sky = open_sky(whole.axes, found.thin_px, texts)
    axes = whole.axes
    if not told:
        axes = with_jambed(
            with_unbroken(axes, sheet, found.thin_px, sky), sheet, found.thin_px, sky
        )
    axes = with_said(settled(axes, found.thin_px, sky), said, sheet, sky)
    laid = known.settle(axes) if known else axes
    return drawn_from(cleaned, found, laid, texts, whole.notes)


def _panels(found: Found, door_px: float, views: Views, said: Labels) -> set[int]:
    """Indices of pieces that are panels of doors: without them such doors are seen."""
    slim = sorted(slim_panels(found.pieces, found.thin_px, door_px))
    if not slim:
        return set()
    judged = judge_gaps(without_pieces(found, slim), views, said)
    seen = slid([found.pieces[one] for one in slim], judged)
    return {one for one, is_panel in zip(slim, seen, strict=True) if is_panel}


def without_pieces(found: Found, gone: Collection[int]) -> Found:
    """The walls without some of their pieces, whose ink no wall is carried on by any more."""
    solid = found.solid & ~_painted([found.pieces[one] for one in gone], found.solid.shape)
    kept = [one for index, one in enumerate(found.pieces) if index not in gone]
    return replace(found, pieces=kept, solid=solid | (found.solid & _painted(kept, solid.shape)))


def _painted(pieces: Iterable[Piece], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """(h, w) where pieces of wall are, and a little beside them."""
    mask = np.zeros(shape, dtype=np.uint8)
    for one in pieces:
        ends = [tuple(int(value) for value in np.round(end)) for end in (one.start, one.end)]
        cv2.line(mask, ends[0], ends[1], 1, round(1.5 * one.thickness_px) + 2)
    return mask.astype(np.bool_)


def without_fence(cleaned: Cleaned, found: Found, fence: Sequence[Piece]) -> tuple[Cleaned, Found]:
    """The sheet and its walls without those around the plot."""
    paper = _painted(fence, cleaned.ink.shape)
    ink = np.where(paper, np.float32(0.0), cleaned.ink).astype(np.float32)
    names = {id(one) for one in fence}
    kept = [one for one in found.pieces if id(one) not in names]
    return replace(cleaned, ink=ink), replace(found, pieces=kept, solid=found.solid & ~paper)


def sized_by_doors(found: Found, judged: Sequence[Judged], pen_px: float) -> Found:
    """The walls with `thin_px` as the usual door has it, where lines stand for walls.

    How broad these are, at least `pen_px`, says nothing of how wide openings are, which count in
    thin walls. One door that is drawn well says more of it, and three say more than one.
    """
    single = all(one.drawing == "single-line" for one in [*found.pieces, *found.curved])
    sure = [one for one in judged if one.score >= SURE_DOOR]
    door_px = usual_door(judged) or usual_door(sure, fewest=1)
    if not single or door_px is None:
        return found
    thin_px = max(pen_px, door_px / USUAL_DOOR)
    return found if thin_px == found.thin_px else replace(found, thin_px=thin_px, sized=True)


def judge_gaps(found: Found, views: Views, said: Labels) -> list[Judged]:
    """All interruptions of walls that are openings; twice, as what is outdoors depends on them."""
    ahead = [
        *find_gaps(found.pieces, found.curved),
        *gaps_on_circles(found.pieces, found.curved),
    ]
    gaps = [one for gap in ahead if (one := trimmed(gap, found.solid))]
    seen = [views(gap) for gap in gaps]
    plain = PLAIN_DOORS * USUAL_DOOR if found.sized else PLAIN_WIDTH
    first = [
        judge(gap, view, found.thin_px, None, plain) for gap, view in zip(gaps, seen, strict=True)
    ]
    kept = [one.gap for one in first if one is not None]
    walls = [*found.pieces, *found.curved]
    outer = leads_outdoors(gaps, walls, kept, views.sheet.ink.shape)
    second = [
        judge(gap, view, found.thin_px, out, plain)
        for gap, view, out in zip(gaps, seen, outer, strict=True)
    ]
    told = [
        drawn if not out or _speaks(drawn) else said_window(gap, said) or drawn
        for gap, drawn, out in zip(gaps, second, outer, strict=True)
    ]
    return [one for one in told if one is not None]


def _speaks(drawn: Judged | None) -> bool:
    """Whether a drawing says what it is, so that no label is asked: a window, or a leaf."""
    return drawn is not None and (drawn.kind == "window" or drawn.hinge != "none")
