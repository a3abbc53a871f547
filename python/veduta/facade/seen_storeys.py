"""Which storeys a front has, by its rows of windows and by what is alike in it; or a plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.facade.above_eaves import Surfaces, is_wall_above
from veduta.facade.document import RoofKind
from veduta.facade.evidence import Evidence, Float
from veduta.facade.extent import Skyline, row_histograms
from veduta.facade.eyes import SeenElement
from veduta.facade.floors import Floors, split_floors
from veduta.facade.gable import Gable, GableParameters, find_gable, is_wall
from veduta.facade.options import FacadeOptions
from veduta.facade.rows import gather_rows
from veduta.facade.seen_foot import is_too_deep, without_strip
from veduta.facade.seen_rows import (
    RowParameters,
    WindowRow,
    agrees,
    are_sure,
    floors_of_rows,
    is_even,
    odd_row,
    window_rows,
    without_cellar,
    without_roof,
)
from veduta.facade.set_back import with_set_back
from veduta.run.errors import NotFoundError

_PLANE = "storeys: doubtful, so the front is a plane with openings and has no floors"
_UNEVEN = "storeys: the rows of windows are not evenly apart"
_ONE_ROW = "storeys: there is one row of windows at most"
_UNSURE = "storeys: most windows are not sure"
_FOOT = "storeys: what lies below the lowest of them is as high as several"


@dataclass(frozen=True)
class StoreyParameters:
    """When what lies above the eaves is a storey, and when an outline is the building's.

    `as_many`, `as_large`: where no sky is seen, the share of the fullest row's windows, and of the
    usual area, from which on a row above the eaves is a storey.
    `level`: from which row, as a share of the picture's height, a column of the photo begins below
    its upper edge. `unknown`: the share of such columns, which end at the outline, from which on it
    is that of a rectified photo and tells of no gable.
    `dormers`: from so many windows above the eaves on they are those of a roof, unless there are
    as many as in the fullest row and this share of the usual area (`usual`) large.
    `windows`: window heights in a storey, where no second row tells how high one is.
    All are set by hand: what they were tried on is not kept.
    """

    as_many: float = 0.6
    as_large: float = 0.5
    level: float = 0.02
    unknown: float = 0.15
    dormers: int = 2
    usual: float = 0.8
    windows: float = 2.0


_STOREYS = StoreyParameters()


@dataclass(frozen=True)
class Storeys:
    """Floors, why they are doubtful, and what ends the front above them.

    none: elements that are none: windows in a row of reliefs or signs, shops in a strip.
    """

    floors: Floors
    doubts: list[str]
    gable: Gable | None = None
    roof: RoofKind = "mansard"
    none: tuple[SeenElement, ...] = ()


def storeys_of(
    evidence: Evidence,
    skyline: Skyline,
    elements: list[SeenElement],
    surfaces: Surfaces,
    options: FacadeOptions,
) -> Storeys:
    """The storeys of what is between the sides of a front: all are of that part, in its pixels."""
    under = _under_gable(evidence, skyline, elements, surfaces.wall)
    found = under or _storeys(evidence, skyline, elements, surfaces, options)
    if is_too_deep(found.floors, evidence.height):
        rows, _ = _rows_of([e for e in elements if e.kind == "window"], RowParameters())
        return Storeys(_plane(rows, skyline, elements), [_PLANE, _FOOT])
    floors, shops = without_strip(found.floors, elements, evidence.height)
    return replace(found, floors=floors, none=(*found.none, *shops))


def _storeys(
    evidence: Evidence,
    skyline: Skyline,
    elements: list[SeenElement],
    surfaces: Surfaces,
    options: FacadeOptions,
) -> Storeys:
    """Floors by what is alike, where the rows of windows agree; else by these; else none.

    What lies above the eaves and is wall is no roof.
    """
    parameters = RowParameters()
    windows = [e for e in elements if e.kind == "window"]
    rows, has_cellar = _rows_of(windows, parameters)
    plain = _plain_floors(evidence, skyline, options)
    top, bottom = float(skyline.level), evidence.height
    eaves = float(plain.eaves) if plain is not None else None

    def is_wall(found: Floors) -> bool:
        """Whether there is wall above the eaves."""
        eaves, storey = found.eaves, found.mean_storey
        above = sum(0.5 * (e.y0 + e.y1) < eaves for e in windows)
        dormers = above >= _STOREYS.dormers and not _is_storey_above(
            windows, rows, eaves, _STOREYS.usual
        )
        return is_wall_above(evidence, skyline, eaves, storey, surfaces, dormers=dormers)

    if plain is not None and (
        is_wall(plain)
        or (
            bool(skyline.reason) and _is_storey_above(windows, rows, plain.eaves, _STOREYS.as_large)
        )
    ):
        eaves = top
        plain = without_roof(plain, skyline.level, rows)
    odd = odd_row(rows, [e.score for e in windows], eaves, parameters)
    none = () if odd is None else tuple(windows[i] for i in odd.members)
    rows = [row for row in rows if row is not odd]
    if not are_sure(windows, parameters):
        return Storeys(_plane(rows, skyline, elements), [_PLANE, _UNSURE])
    balconies = [e for e in elements if e.kind == "balcony"]
    if plain is not None and agrees(plain, rows, parameters):
        return Storeys(with_set_back(plain, rows, balconies, evidence.width), [], none=none)
    floors = floors_of_rows(rows, eaves, top, bottom, parameters, has_cellar=has_cellar)
    if floors is not None and is_even(rows, eaves, parameters):
        if is_wall(floors):
            floors = without_roof(floors, skyline.level, rows) or floors
        return Storeys(with_set_back(floors, rows, balconies, evidence.width), [], none=none)
    reason = _UNEVEN if len(rows) > 1 else _ONE_ROW
    return Storeys(_plane(rows, skyline, elements), [_PLANE, reason])


def _rows_of(
    windows: Sequence[SeenElement], parameters: RowParameters
) -> tuple[list[WindowRow], bool]:
    """The rows of windows above a cellar, and whether there is a row of a cellar's."""
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in windows]).reshape(-1, 4)
    every = window_rows(boxes, parameters)
    rows = without_cellar(every, parameters)
    return rows, len(rows) < len(every)


def _is_storey_above(
    windows: Sequence[SeenElement], rows: Sequence[WindowRow], eaves: float, large: float
) -> bool:
    """Whether a row above the eaves has as many and as large windows as those below: no dormers.

    large: the least share of the usual area.
    """
    above = [r for r in rows if 0.5 * (r.top + r.bottom) < eaves]
    below = [r for r in rows if r not in above]
    if not above or not below:
        return False
    most = max(len(r.members) for r in below)
    usual = np.median([windows[i].width * windows[i].height for r in below for i in r.members])
    return any(
        len(r.members) >= _STOREYS.as_many * most
        and np.median([windows[i].width * windows[i].height for i in r.members]) >= large * usual
        for r in above
    )


def _under_gable(
    evidence: Evidence, skyline: Skyline, elements: list[SeenElement], wall: Float
) -> Storeys | None:
    """Floors below the eaves of a gable or a hipped roof; None where the outline shows none.

    wall: (h, w) the chance of wall.
    """
    gable = None if _is_cut_off(evidence, skyline) else find_gable(skyline)
    parameters = RowParameters()
    windows = [e for e in elements if e.kind == "window"]
    if gable is None or not are_sure(windows, parameters):
        return None
    eaves = round(gable.eaves)
    below = [e for e in windows if 0.5 * (e.y0 + e.y1) > eaves]
    if any(_is_over_slopes(e, gable, len(skyline.rows)) for e in windows if e not in below):
        return None
    rows, has_cellar = _rows_of(below, parameters)
    bottom = evidence.height
    floors = floors_of_rows(rows, eaves, eaves, bottom, parameters, has_cellar=has_cellar)
    kind: RoofKind = "gable" if is_wall(gable, wall, skyline, GableParameters().wall) else "hip"
    if floors is None or not is_even(rows, eaves, parameters):
        return None
    return Storeys(replace(floors, boundaries=[eaves, *floors.boundaries[1:]]), [], gable, kind)


def _is_cut_off(evidence: Evidence, skyline: Skyline) -> bool:
    """Whether the outline is that of the photo, which leans, and not the building's."""
    first = evidence.valid.argmax(axis=0)
    unknown = (first > _STOREYS.level * evidence.height) & (skyline.rows <= first + 2)
    return float(unknown.mean()) > _STOREYS.unknown


def _is_over_slopes(window: SeenElement, gable: Gable, width: int) -> bool:
    """Whether a window above the eaves has its middle beside a gable, where there is sky then."""
    middle, reach = 0.5 * (window.x0 + window.x1) - 0.5 * width, 0.5 * width
    high = (1.0 - abs(middle) / reach) * (gable.eaves - gable.top)
    return 0.5 * (window.y0 + window.y1) < gable.eaves - high


def _plain_floors(evidence: Evidence, skyline: Skyline, options: FacadeOptions) -> Floors | None:
    lines = gather_rows(evidence, skyline, row_histograms(evidence, skyline))
    try:
        return split_floors(lines, options.scale.height_m)
    except NotFoundError:
        return None


def _plane(rows: list[WindowRow], skyline: Skyline, elements: list[SeenElement]) -> Floors:
    """A front without floors; the scale takes a storey from the height of its openings."""
    heights = [e.height for e in elements if e.kind == "window"] or [e.height for e in elements]
    storey = _STOREYS.windows * float(np.median(heights))
    top = min(float(skyline.level), min((row.top for row in rows), default=np.inf))
    return Floors([max(0, round(top))], storey, 0.0, {}, 0)
