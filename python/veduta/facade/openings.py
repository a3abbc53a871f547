"""The windows of each floor and column, and the balconies in front of them.

Stripes, rows and what windows look like depend on each other, so they are read in turn: stripes
and rows by the general cues, then the image's own look of windows and railings from these, then
stripes and rows again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Scores, Wall, where_seen
from veduta.facade.bare_floors import bare_floors, without_railings
from veduta.facade.boxes import Box, score
from veduta.facade.columns import Columns, split_columns
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.opening_rows import FloorRows, Stripes, read_floors
from veduta.facade.own_look import find_kinds, look_again
from veduta.facade.railings import find_railings
from veduta.facade.twin_windows import part_twins
from veduta.facade.window_sides import refine_sides

# Mean log-odds under which a cell of the grid is blank.
_BLANK = -0.5
# Share of a box that must be photo, not outside of it.
_SEEN = 0.5


def read_columns(
    evidence: Evidence, floors: Floors, wall: Wall, scores: Scores
) -> tuple[Columns, Scores]:
    """The stripes of windows, and scores by the look that windows and railings have here.

    Floors whose railings do not stand out are read again as having none.
    """
    kinds = find_kinds(evidence, wall, floors)
    columns, own, boxes = _read_twice(evidence, floors, kinds, scores)
    bare = bare_floors(boxes, evidence, floors, scores)
    if bare:
        scores = without_railings(scores, floors, bare)
        columns, own, _ = _read_twice(evidence, floors, kinds, scores)
        own = without_railings(own, floors, bare)
    return columns, own


def _read_twice(
    evidence: Evidence, floors: Floors, kinds: NDArray[np.int64], scores: Scores
) -> tuple[Columns, Scores, list[Box]]:
    """Stripes, and rows in them, by the general cues and then by the image's own look."""
    rows = floors.eaves, floors.ground_top
    columns, own = split_columns(evidence, *rows, floors.mean_storey, scores), scores
    for again in (True, False):
        read = read_floors(evidence, floors, columns.stripes, own)
        boxes = _boxes(read, columns.stripes, floors)
        labels = _labels(boxes, evidence, floors)
        own = look_again(kinds, scores, labels, floors.mean_storey)
        own = where_seen(own, evidence, floors.eaves)
        if again:
            columns = split_columns(evidence, *rows, floors.mean_storey, own)
    return columns, own, boxes


def find_openings(
    evidence: Evidence, floors: Floors, columns: Columns, scores: Scores, cues: Scores
) -> list[Box]:
    """Windows and balconies of every floor above the ground floor, eaves first.

    `scores` are those by the image's own look, `cues` the general ones.
    """
    read = read_floors(evidence, floors, columns.stripes, scores)
    gx, storey = evidence.gx[floors.eaves : floors.ground_top], floors.mean_storey
    masks = [_window_rows(read, c, floors) for c in range(len(columns.stripes))]
    parts = part_twins(columns.stripes, cues.window, gx, masks, storey)
    stripes = [stripe for several in parts for stripe in several]
    masks = [mask for mask, several in zip(masks, parts, strict=True) for _ in several]
    stripes = refine_sides(stripes, scores.window, gx, masks, storey)
    read = read_floors(evidence, floors, stripes, scores)
    return _boxes(read, stripes, floors)


def only_seen(boxes: list[Box], evidence: Evidence, skyline: Skyline) -> list[Box]:
    """The boxes of which at least half lies in the photo and below the sky."""
    seen = evidence.valid & (np.arange(evidence.height)[:, None] >= skyline.rows[None])
    return [box for box in boxes if seen[box.part()].sum() >= _SEEN * box.width * box.height]


def _boxes(read: list[FloorRows], stripes: Stripes, floors: Floors) -> list[Box]:
    boxes: list[Box] = []
    for i, floor in enumerate(read):
        number = len(read) - i
        for c, ((x, w), (t, k, _)) in enumerate(zip(stripes, floor.cells, strict=True)):
            sure = float(floor.window[t:k, x : x + w].mean()) if k > t else _BLANK
            if sure > _BLANK:
                boxes.append(Box("window", x, floor.top + t, w, k - t, number, c, score(sure)))
        for x, end, k, b in find_railings(floor, stripes, floors.mean_storey):
            sure = float(floor.railing[k:b, x:end].mean())
            boxes.append(
                Box("balcony", x, floor.top + k, end - x, b - k, number, None, score(sure))
            )
    return boxes


def _labels(boxes: list[Box], evidence: Evidence, floors: Floors) -> NDArray[np.uint8]:
    """0 wall, 1 window, 2 railing, 3 no photo for each pixel of the floors."""
    seen = evidence.valid[floors.eaves : floors.ground_top]
    labels = np.zeros(seen.shape, np.uint8)
    for box in boxes:
        labels[box.part(floors.eaves)] = 1 if box.kind == "window" else 2
    labels[~seen] = 3
    return labels


def _window_rows(read: list[FloorRows], column: int, floors: Floors) -> NDArray[np.bool_]:
    """Mask of the rows, from the eaves down, in which a column's windows are."""
    mask = np.zeros(floors.ground_top - floors.eaves, bool)
    for floor in read:
        t, k, _ = floor.cells[column]
        mask[floor.top - floors.eaves + t : floor.top - floors.eaves + k] = True
    return mask
