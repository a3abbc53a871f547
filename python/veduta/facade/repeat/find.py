"""Find what repeats in the plan of a building."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from typing import TypeVar

import numpy as np

from veduta.facade.layout import Opening
from veduta.facade.plan import Band, Plan
from veduta.facade.rectangles import Rectangle
from veduta.facade.repeat.pattern import (
    Balconies,
    Bay,
    Columns,
    Dormers,
    Floor,
    GroundCell,
    OpeningKind,
    Pattern,
    Tolerances,
)
from veduta.facade.repeat.series import series
from veduta.facade.shape import head_rise_m

T = TypeVar("T")
# Of the columns, so many must have a window on a floor (or a dormer above it, or a balcony) for
# the others to follow.
FOLLOW_SHARE = 0.5
# A balcony that is so many columns wide serves more than one window.
LONG_COLUMNS = 1.6
_KINDS: dict[str, OpeningKind] = {"window": "window", "door": "door", "shop": "shop"}
_ALONE = "{} of floor {} stand alone: they are in cells.cga, not in rules.cga"


def find_pattern(plan: Plan, tolerances: Tolerances | None = None) -> Pattern | None:
    """The pattern of a plan; None where no floor above the ground floor has windows in columns."""
    own = tolerances or Tolerances()
    upper = [band for band in plan.bands if band.floor > 0]
    windows = [o.rectangle for band in upper for o in _windows(band)]
    columns = find_columns(windows, plan.width_m, own)
    if columns is None:
        return None
    notes: list[str] = []
    floors = [_floor(band, plan, columns, own, notes) for band in upper]
    first = plan.bands[0]
    ground_m = first.top_m - first.foot_m if first.floor == 0 else 0.0
    ground = _ground(first, plan.width_m) if first.floor == 0 else []
    return Pattern(
        columns=columns,
        ground_m=ground_m,
        ground=series(
            ground,
            lambda cells: _all_pairs(cells, lambda a, b: _cells_alike(a, b, own)),
            _mean_cell,
            lambda cell: cell.kind != "door",
        ),
        floors=series(
            floors,
            lambda some: _all_pairs(some, lambda a, b: _floors_alike(a, b, own)),
            _mean_floor,
        ),
        dormers=_dormers(plan, columns, own),
        notes=tuple(notes),
    )


def find_columns(
    openings: Sequence[Rectangle], width_m: float, tolerances: Tolerances
) -> Columns | None:
    """The columns of openings in a front of this width; None where there are none."""
    groups: list[list[Rectangle]] = []
    for one in sorted(openings, key=lambda r: r.x0 + r.x1):
        middle = 0.5 * (one.x0 + one.x1)
        if groups and middle < float(np.median([r.x1 for r in groups[-1]])):
            groups[-1].append(one)
        else:
            groups.append([one])
    if not groups:
        return None
    spans = [
        (float(np.median([r.x0 for r in g])), float(np.median([r.x1 for r in g]))) for g in groups
    ]
    left, bays, right = _bays(spans, width_m)
    runs = series(bays, lambda some: _one_rule(some, tolerances), _mean_bay)
    return Columns(left, runs, right, tuple(bays))


def _bays(spans: Sequence[tuple[float, float]], width_m: float) -> tuple[float, list[Bay], float]:
    """Wall, bays and wall of openings; borders lie in the middle between two openings.

    The outer ones have as much wall outside as inside, as far as there is.
    """
    gaps = [max(0.0, b[0] - a[1]) for a, b in pairwise(spans)]
    first = 0.5 * gaps[0] if gaps else min(spans[0][0], width_m - spans[0][1])
    last = 0.5 * gaps[-1] if gaps else first
    before = [min(first, spans[0][0]), *(0.5 * gap for gap in gaps)]
    after = [*(0.5 * gap for gap in gaps), min(last, width_m - spans[-1][1])]
    bays = [Bay(b, x1 - x0, a) for b, (x0, x1), a in zip(before, spans, after, strict=True)]
    left = spans[0][0] - before[0]
    return left, bays, max(0.0, width_m - spans[-1][1] - after[-1])


def _windows(band: Band) -> list[Opening]:
    return [o for o in band.openings if o.element.class_ == "window"]


def _floor(
    band: Band, plan: Plan, columns: Columns, tolerances: Tolerances, notes: list[str]
) -> Floor:
    """A floor by its windows; one without any is as its neighbours are, and nothing of it read."""
    height, places = band.top_m - band.foot_m, [o.rectangle for o in _windows(band)]
    if not places:
        unread = tuple(range(len(columns.bays)))
        return Floor(height, 0.25 * height, 0.55 * height, None, unread)
    sill = float(np.median([r.z0 for r in places])) - band.foot_m
    high = float(np.median([r.height for r in places]))
    own, unread = _matched(places, columns, plan.width_m, tolerances)
    balconies = _balconies(band, plan, own or columns, notes)
    rise = float(np.median([head_rise_m(o.element) for o in _windows(band)]))
    low = max(0.0, sill)
    return Floor(height, low, min(high, height - low), balconies, unread, own, rise)


def _matched(
    places: Sequence[Rectangle], columns: Columns, width_m: float, tolerances: Tolerances
) -> tuple[Columns | None, tuple[int, ...]]:
    """The columns that openings have for themselves, and which of them are not read."""
    centres = np.array(columns.centres_m)
    widths = np.array([bay.wide_m for bay in columns.bays])
    at = np.array([0.5 * (r.x0 + r.x1) for r in places])
    nearest = np.abs(at[:, None] - centres).argmin(axis=1)
    fits = bool((np.abs(at - centres[nearest]) < 0.4 * widths[nearest]).all())
    seen = set(nearest.tolist())
    if fits and len(seen) == len(places) and len(seen) >= FOLLOW_SHARE * len(centres):
        return None, tuple(k for k in range(len(centres)) if k not in seen)
    return find_columns(places, width_m, tolerances), ()


def _balconies(band: Band, plan: Plan, columns: Columns, notes: list[str]) -> Balconies | None:
    """Those that begin in the lower half of the floor, or hang a little below it."""
    reach = 0.5 * (band.top_m - band.foot_m)
    found = [
        b.rectangle
        for b in plan.balconies
        if band.foot_m - 0.5 * reach <= b.rectangle.z0 < band.foot_m + reach
    ]
    if not found:
        return None
    foot = float(np.median([r.z0 for r in found])) - band.foot_m
    high = float(np.median([r.height for r in found]))
    pitch = float(np.median([bay.width_m for bay in columns.bays]))
    if max(r.width for r in found) > LONG_COLUMNS * pitch:
        ends = min(r.x0 for r in found), plan.width_m - max(r.x1 for r in found)
        return Balconies("long", foot, high, max(0.0, float(np.mean(ends))))
    if len(found) < FOLLOW_SHARE * len(columns.bays):
        notes.append(_ALONE.format("balconies", band.floor))
        return None
    wide = float(np.median([bay.wide_m for bay in columns.bays]))
    return Balconies("each", foot, high, 0.5 * (float(np.median([r.width for r in found])) - wide))


def _ground(band: Band, width_m: float) -> list[GroundCell]:
    openings = sorted(
        (o for o in band.openings if o.element.class_ in _KINDS), key=lambda o: o.rectangle.x0
    )
    if not openings:
        return [GroundCell(None, Bay(0.0, width_m, 0.0))]
    spans: list[tuple[float, float]] = []
    for place in (o.rectangle for o in openings):
        spans.append((max(place.x0, spans[-1][1] if spans else 0.0), place.x1))
    left, bays, right = _bays(spans, width_m)
    bays[0] = Bay(left + bays[0].before_m, bays[0].wide_m, bays[0].after_m)
    bays[-1] = Bay(bays[-1].before_m, bays[-1].wide_m, bays[-1].after_m + right)
    return [
        GroundCell(
            _KINDS[o.element.class_],
            bay,
            max(0.0, o.rectangle.z0 - band.foot_m),
            o.rectangle.height,
        )
        for o, bay in zip(openings, bays, strict=True)
    ]


def _dormers(plan: Plan, columns: Columns, tolerances: Tolerances) -> Dormers | None:
    places = [d.front for d in plan.dormers]
    if not places:
        return None
    own, _ = _matched(places, columns, plan.width_m, tolerances)
    return Dormers(
        up_m=float(np.median([r.z0 for r in places])) - plan.eaves_m,
        wide_m=float(np.median([r.width for r in places])),
        high_m=float(np.median([r.height for r in places])),
        own=own,
    )


def _all_pairs(some: Sequence[T], alike: Callable[[T, T], bool]) -> bool:
    return all(alike(a, b) for a, b in combinations(some, 2))


def _one_rule(bays: Sequence[Bay], own: Tolerances) -> bool:
    """Whether bays are alike, and openings that stand evenly would stand about where these do."""
    if not _all_pairs(bays, lambda a, b: _bays_alike(a, b, own)):
        return False
    mean, at = _mean_bay(bays), 0.0
    for place, bay in enumerate(bays):
        if (
            abs(at + bay.before_m - place * mean.width_m - mean.before_m)
            > own.drift_share * mean.wide_m
        ):
            return False
        at += bay.width_m
    return True


def _bays_alike(a: Bay, b: Bay, own: Tolerances) -> bool:
    sizes = ((a.before_m, b.before_m), (a.wide_m, b.wide_m), (a.after_m, b.after_m))
    return all(abs(x - y) <= own.across_m for x, y in sizes)


def _mean_bay(bays: Sequence[Bay]) -> Bay:
    before, wide, after = np.mean([(b.before_m, b.wide_m, b.after_m) for b in bays], axis=0)
    return Bay(float(before), float(wide), float(after))


def _cells_alike(a: GroundCell, b: GroundCell, own: Tolerances) -> bool:
    up = max(abs(a.sill_m - b.sill_m), abs(a.high_m - b.high_m))
    across = 2.0 * own.across_m if a.kind == "shop" else own.across_m
    wider = Tolerances(across_m=across)
    return a.kind == b.kind and up <= own.up_m and _bays_alike(a.bay, b.bay, wider)


def _mean_cell(cells: Sequence[GroundCell]) -> GroundCell:
    sill, high = np.mean([(c.sill_m, c.high_m) for c in cells], axis=0)
    return GroundCell(cells[0].kind, _mean_bay([c.bay for c in cells]), float(sill), float(high))


def _floors_alike(a: Floor, b: Floor, own: Tolerances) -> bool:
    if (a.balconies is None) != (b.balconies is None) or a.own is not None or b.own is not None:
        return False
    if a.balconies is not None and b.balconies is not None:
        one, other = a.balconies, b.balconies
        apart = max(abs(one.foot_m - other.foot_m), abs(one.high_m - other.high_m))
        if one.kind != other.kind or apart > own.up_m:
            return False
    if (a.rise_m > 0.0) != (b.rise_m > 0.0):
        return False
    up = max(abs(a.sill_m - b.sill_m), abs(a.high_m - b.high_m))
    taller = max(a.height_m, b.height_m)
    return up <= own.up_m and abs(a.height_m - b.height_m) <= own.floor_share * taller


def _mean_floor(floors: Sequence[Floor]) -> Floor:
    """A column is unread where it is on any of the floors: one rule tells it for all."""
    height, sill, high = np.mean([(f.height_m, f.sill_m, f.high_m) for f in floors], axis=0)
    balconies = [f.balconies for f in floors if f.balconies is not None]
    mean = None
    if balconies:
        foot, tall, beside = np.mean([(b.foot_m, b.high_m, b.beside_m) for b in balconies], axis=0)
        mean = Balconies(balconies[0].kind, float(foot), float(tall), float(beside))
    unread = tuple(sorted({k for f in floors for k in f.unread}))
    rise = float(np.mean([f.rise_m for f in floors]))
    return Floor(float(height), float(sill), float(high), mean, unread, floors[0].own, rise)
