"""Whether what was fitted is a facade, or a pattern that repeats as one does.

Bricks, tiles, checkerboards and stripes have level and upright edges and repeat by rows and by
columns, so floors and columns can be fitted to them. They betray themselves afterwards: they repeat
within a storey as well as from storey to storey, what stands out of them is not unlike the rest, or
no row of windows is found. The bounds were set on 183 pictures of facades and 74 of other things,
and held on 239 of 240 other facades (the last is a tower of 35 floors). The least or largest value
of any facade is named with each.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Wall
from veduta.facade.between import Between, are_floors
from veduta.facade.boxes import Box
from veduta.facade.columns_alike import likeness_of_columns
from veduta.facade.dissimilarity import at_offsets
from veduta.facade.evidence import Float
from veduta.facade.floors import MAX_FLOORS, Floors
from veduta.facade.goes_on import goes_on
from veduta.facade.presence import REMEDY
from veduta.facade.rows import Rows
from veduta.run.errors import NotFoundError

# Energy per row at which no storey is like another (facades: at most -0.07).
_NOTHING_ALIKE = -0.04
# Energy per row above which their number is doubtful (as photos of mere parts of facades have it).
_DOUBTFUL = -0.2
# Likeness of floors from side to side under which they are doubtful. Of 67 facades of many styles
# 16 have less, and a mean window F1 of 0.29 (the others 0.57); of 25 of Paris one has.
_IN_COLUMNS = 0.12
# Part of a storey in which a pattern may repeat, and the dissimilarity up to which it does
# (facades: 0.38 and more at their best offset within a storey).
_WITHIN = (0.12, 0.62)
_REPEATS = 0.2
# Dissimilarity of storeys that are copies (facades: 0.18 and more; drawings have less).
_COPIES = 0.15
# Colour distance of windows from the wall (facades: 15.1 and more; a page of text: 13.9; copies:
# 18), and its least ratio to that of what is not window, where storeys are copies (drawings and
# renders: 2 and more).
_UNLIKE = 14.5
_UNLIKE_OF_COPIES = 18.0
_RATIO_OF_COPIES = 1.3

_CHECK = "so check their number, or give --height-m"
HARDLY_ALIKE = f"storeys: they are hardly alike, {_CHECK}"
NOT_PARTED = f"storeys: no wall parts the windows of one from those of the next, {_CHECK}"
NOT_IN_COLUMNS = f"storeys: the windows of one do not stand above those of the next, {_CHECK}"
SINGLE = f"storeys: nothing confirms a single floor above the ground floor, {_CHECK}"
UNENDED = f"storeys: neither a sky nor a ground floor ends them, as in a pattern, {_CHECK}"
STOREY_DOUBTS = (HARDLY_ALIKE, NOT_PARTED, NOT_IN_COLUMNS, SINGLE, UNENDED)


def require_facade(rows: Rows, floors: Floors, wall: Wall, boxes: list[Box]) -> None:
    """Raise NotFoundError where rows, floors or windows (`boxes`) are not those of a facade."""
    # Grid rows in a storey, and how unlike rows are that lie apart.
    storey, unlike = floors.mean_storey / rows.step, _unlike_at_offsets(rows, floors)
    copies = len(floors.boundaries) > 2 and _are_copies(unlike, storey)
    reason = _pattern(floors, unlike, storey) or _no_windows(floors, wall, boxes, copies)
    if reason:
        raise NotFoundError("a facade", reason, REMEDY)


def storey_doubts(rows: Rows, floors: Floors, window: Float, pairs: list[Between]) -> list[str]:
    """Why the floors may be other ones.

    `window` (n, w) are their log-odds by the general cues, `pairs` windows with what lies between
    them. Floors are hardly alike where their energy per row is one that mere parts of facades
    reach; a single floor has none to be like, but its bays can be like one another.
    """
    alike = likeness_of_columns(window, floors)
    found = (
        floors.energy > _DOUBTFUL,
        not are_floors(pairs, floors),
        alike is not None and alike < _IN_COLUMNS,
        alike is None and rows.bay is None,
        goes_on(rows, floors),
    )
    return [reason for reason, holds in zip(STOREY_DOUBTS, found, strict=True) if holds]


def _pattern(floors: Floors, unlike: NDArray[np.float64], storey: float) -> str | None:
    if floors.energy > _NOTHING_ALIKE:
        return "no part of the picture is like the part below it, as storeys are"
    first, last = (round(part * storey) for part in _WITHIN)
    within = [
        k
        for k in range(max(2, first), min(last, len(unlike) - 2) + 1)
        if unlike[k] <= min(unlike[k - 1], unlike[k + 1], _REPEATS)
    ]
    if within:
        times = round(storey / within[0])
        return (
            f"it repeats {times} times in what would be a storey: bricks or tiles do, "
            f"and towers of more than {MAX_FLOORS} floors, which are too many"
        )
    return None


def _no_windows(floors: Floors, wall: Wall, boxes: list[Box], copies: bool) -> str | None:
    mask = np.zeros(wall.unlike.shape, bool)
    for box in boxes:
        if box.kind == "window" and box.floor:
            mask[box.part(floors.eaves)] = True
    if not mask.any():
        return "it shows no window between the eaves and the ground floor"
    windows = float(np.median(wall.unlike[mask]))
    if windows < _UNLIKE:
        return "what could be windows has the colour of what is beside them"
    if copies:
        rest = float(np.median(wall.unlike[~mask])) if not mask.all() else windows
        if windows < _UNLIKE_OF_COPIES or windows < _RATIO_OF_COPIES * rest:
            return "all rows are copies of one pattern, in which nothing stands out as a window"
    return None


def _are_copies(unlike: NDArray[np.float64], storey: float) -> bool:
    about = unlike[int(0.85 * storey) : int(1.15 * storey) + 1]
    return len(about) > 0 and float(about.min()) < _COPIES


def _unlike_at_offsets(rows: Rows, floors: Floors) -> NDArray[np.float64]:
    """Mean dissimilarity (k,) of rows `k` grid rows apart between eaves and ground floor."""
    part = slice(floors.eaves // rows.step, floors.ground_top // rows.step)
    body = rows.distance[part, part]
    # Few pairs are far apart: what they say is chance.
    return at_offsets(body, max(1, round(0.85 * len(body))))
