"""Arcades: ground floors that are open between piers, with the wall behind them kept.

What lies behind a front and is framed by it would be taken for a room behind glass (section 6.1). An
arcade is told from a shop by its floor: the pavement goes on into it, and of the beams that reach it
hardly one is missing, while a pane takes a part of them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame, ColumnPoints

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]
Mask = NDArray[np.bool_]
_ARCH_ROWS, _BEAM_ROWS = 12, 3
"""By which arches rise over what is usual in them; to the next beam of a coarse scanner."""
_SIGMAS = 3.09
"""One shop in a thousand loses as few beams as that by chance: a street has some hundred panes."""


@dataclass(frozen=True)
class ArcadeParameters:
    """What is an arcade; all but shares in metres.

    nearest_m, farthest_m: of the wall behind, from the front. front_m: so near to the main depth lies
    what is of the front. foot_m, lintel_m: heights at which nothing of it stands in an opening, and
    at which it goes on above. floor_m: so far behind the front lies ground that is of the floor.
    lowest_m: over it, what stands upright. pier_m: openings that are nearer to each other are of one
    arcade. bin_m: of depth. near_m: so near to the wall behind lies what is of it. peak: of the
    pixels at the depth that has most, what makes the nearest wall. closed: share of an opening's
    columns that show that wall; shared: so many are enough where it is that of the opening
    beside. before_m: so far before the front lies pavement with which the
    floor is compared. pane: share of beams that a pane takes at least: 4 % at each of its faces,
    there and back, less what a measurement strays by.
    """

    nearest_m: float = 0.8
    farthest_m: float = 7.0
    front_m: float = 0.4
    foot_m: tuple[float, float] = (0.3, 1.8)
    lintel_m: tuple[float, float] = (2.0, 8.0)
    floor_m: float = 0.3
    lowest_m: float = 0.5
    pier_m: float = 2.5
    bin_m: float = 0.15
    near_m: float = 0.25
    peak: float = 0.35
    closed: float = 0.4
    shared: float = 0.25
    before_m: float = 2.0
    pane: float = 0.12


@dataclass(frozen=True, eq=False)
class Arcades:
    """depth: (c,) of the wall behind the open front (m), NaN in columns without an opening. top: (c,)
    the row in which the front goes on above the opening.
    """

    depth: Floats
    top: Rows

    def inside(self, rows: int) -> Mask:
        """(rows, c) pixels of openings, floors included."""
        below = np.arange(rows)[:, None] < self.top
        return np.asarray(below & np.isfinite(self.depth))

    def behind(
        self, points: ColumnPoints, row: Rows, above: NDArray[np.floating],
        parameters: ArcadeParameters | None = None,
    ) -> Mask:  # fmt: skip
        """(n,) points of the walls behind."""
        chosen = parameters or ArcadeParameters()
        off = points.depth - self.depth[points.column]
        with np.errstate(invalid="ignore"):
            near = (np.abs(off) < chosen.near_m) & (row < self.top[points.column])
        return np.asarray(near & (row >= 0) & (above > chosen.lowest_m / 2))


@dataclass(frozen=True, eq=False)
class _Opening:
    """columns: (c,) without a gap. back: of the wall, behind the front (m). row: (n,) of the points
    that lie on that wall. inside: (k,) indices of all points that are seen through it.
    """

    columns: Rows
    back: float
    row: Rows
    inside: Rows


def find_arcades(
    points: ColumnPoints,
    row: Rows,
    above: NDArray[np.floating],
    on_ground: Mask,
    main: Floats,
    wall: Floats,
    frame: ColumnFrame,
    parameters: ArcadeParameters | None = None,
) -> Arcades:
    """row: (n,) beam of each point, -1: none. above: (n,) over the ground (m). on_ground: (n,). main:
    (c,) depth of the fronts (m), NaN where none is. wall: (c,) the same, behind balconies.
    """
    chosen = parameters or ArcadeParameters()
    off = points.depth - wall[points.column]
    with np.errstate(invalid="ignore"):
        front = np.abs(points.depth - main[points.column]) < chosen.front_m
        front |= np.abs(off) < chosen.front_m
    top = _lintels(points.column, row, above, front, len(main), chosen)
    open_ = (top > 0) & _without_foot(points, above, on_ground, front, off, len(main), chosen)
    with np.errstate(invalid="ignore"):
        below = (row >= 0) & (row < top[points.column]) & (above > chosen.lowest_m)
        below &= (off > chosen.nearest_m) & (off < chosen.farthest_m)
    openings = _openings(points, row, off, below, open_, wall, chosen)
    for _ in range(2):
        _share_walls(openings, points, row, off, frame.spacing_m, chosen)
        openings.reverse()
    with np.errstate(invalid="ignore"):
        before = (off < -chosen.front_m) & ~on_ground
    beams = _Beams.of(points, row, before, frame)
    found = Arcades(np.full(len(main), np.nan), np.zeros(len(main), dtype=np.int64))
    for group in _groups(openings, wall, frame.spacing_m, chosen):
        if _without_pane(beams, group, wall, frame, chosen):
            for one, ends in zip(group, _tops(group, top), strict=True):
                found.depth[one.columns] = wall[one.columns] + one.back
                found.top[one.columns] = ends
    return _closed_up(found, frame.spacing_m)


def _lintels(
    column: NDArray[np.int32], row: Rows, above: NDArray[np.floating], front: Mask, columns: int,
    chosen: ArcadeParameters,
) -> Rows:  # fmt: skip
    """(c,) the lowest row at which the front is seen above what may be an opening; 0: none."""
    low, high = chosen.lintel_m
    front = front & (above > low) & (above < high) & (row >= 0)
    found = np.full(columns, np.iinfo(np.int64).max)
    np.minimum.at(found, column[front], row[front])
    return np.where(found < np.iinfo(np.int64).max, found, 0)


def _without_foot(
    points: ColumnPoints, above: NDArray[np.floating], on_ground: Mask, front: Mask, off: Floats,
    columns: int, chosen: ArcadeParameters,
) -> Mask:  # fmt: skip
    """(c,) columns in which nothing of the front stands on the ground, and ground lies behind it,
    there or in a column beside: what does not come back must not choose the columns.
    """
    low, high = chosen.foot_m
    foot = front & (above > low) & (above < high) & ~on_ground
    with np.errstate(invalid="ignore"):
        floor = on_ground & (off > chosen.floor_m) & (off < chosen.farthest_m)
    stands = np.bincount(points.column[foot], minlength=columns) > 0
    lies = np.bincount(points.column[floor], minlength=columns) > 0
    return np.asarray(~stands & ndimage.binary_dilation(lies, np.ones(3, dtype=bool)))


def _openings(
    points: ColumnPoints, row: Rows, off: Floats, below: Mask, open_: Mask, wall: Floats,
    chosen: ArcadeParameters,
) -> list[_Opening]:  # fmt: skip
    """Runs of open columns with a wall behind that most of them show."""
    columns = np.flatnonzero(open_)
    ends = (np.diff(columns) > 1) | (np.abs(np.diff(wall[columns])) > chosen.front_m)
    found = []
    for own in np.split(columns, np.flatnonzero(ends) + 1):
        if len(own) < 3:
            continue
        inside = np.flatnonzero(below & (points.column >= own[0]) & (points.column <= own[-1]))
        if not len(inside):
            continue
        back = _nearest_wall(row[inside], points.column[inside], off[inside], chosen)
        near = inside[np.abs(off[inside] - back) < chosen.near_m]
        if np.isin(own, points.column[near]).mean() >= chosen.closed:
            found.append(_Opening(own, back, row[near], inside))
    return found


def _share_walls(
    openings: list[_Opening], points: ColumnPoints, row: Rows, off: Floats, spacing_m: float,
    chosen: ArcadeParameters,
) -> None:  # fmt: skip
    """A wall that is mostly glass shows a room behind it more than itself: where the opening beside
    has a nearer one that is seen here, too, it is that.
    """
    for number in range(1, len(openings)):
        one, other = openings[number], openings[number - 1]
        apart = max(one.columns[0] - other.columns[-1], other.columns[0] - one.columns[-1])
        near = one.inside[np.abs(off[one.inside] - other.back) < chosen.near_m]
        seen = float(np.isin(one.columns, points.column[near]).mean())
        if apart * spacing_m <= chosen.pier_m and other.back < one.back and seen >= chosen.shared:
            openings[number] = replace(one, back=other.back, row=row[near])


def _nearest_wall(
    row: Rows, column: NDArray[np.int32], off: Floats, chosen: ArcadeParameters
) -> float:
    """How far behind the front the nearest wall is that closes an opening (m)."""
    bins = int(np.ceil(chosen.farthest_m / chosen.bin_m)) + 1
    # Pixels, not points: scans that are merged have several in one.
    pixel = row * (int(column.max()) + 1) + column.astype(np.int64)
    cell = np.unique(pixel * bins + (off / chosen.bin_m).astype(np.int64))
    count = np.bincount(cell % bins, minlength=bins)
    peak = ndimage.maximum_filter1d(count, 3, mode="constant") == count
    at = int(np.flatnonzero(peak & (count >= chosen.peak * count.max()))[0])
    return float(np.median(off[np.abs(off - (at + 0.5) * chosen.bin_m) < chosen.near_m]))


def _groups(
    openings: list[_Opening], wall: Floats, spacing_m: float, chosen: ArcadeParameters
) -> list[list[_Opening]]:
    """Openings beside each other before one wall."""
    found: list[list[_Opening]] = []
    for one in openings:
        last = found[-1][-1] if found else one
        first, end = int(one.columns[0]), int(last.columns[-1])
        near = 0 < (first - end) * spacing_m <= chosen.pier_m
        step = wall[first] + one.back - wall[end] - last.back
        if near and abs(step) < chosen.front_m:
            found[-1].append(one)
        else:
            found.append([one])
    return found


def _tops(group: list[_Opening], lintels: Rows) -> list[Rows]:
    """The row in which each column of an arcade ends: where the front goes on, but not far above
    what is seen of the wall behind in its opening: a crown before it may hide the front.
    """
    usual = int(np.quantile(lintels[np.concatenate([one.columns for one in group])], 0.75))
    result = []
    for one in group:
        seen = one.row[one.row < usual + _ARCH_ROWS]
        highest = int(seen.max()) + _BEAM_ROWS if len(seen) else usual
        result.append(np.minimum(lintels[one.columns], highest))
    return result


@dataclass(frozen=True, eq=False)
class _Beams:
    """met: (r, c) pixels from which something came back, and those between the beams of a coarse
    scanner. hidden: (r, c) of them those before which something stands. pitch: rows to a beam.
    """

    met: Mask
    hidden: Mask
    pitch: float

    @classmethod
    def of(cls, points: ColumnPoints, row: Rows, before: Mask, frame: ColumnFrame) -> _Beams:
        """before: (n,) points that stand before the front and are no ground."""
        met, hidden = np.zeros(frame.shape, dtype=bool), np.zeros(frame.shape, dtype=bool)
        met[row[row >= 0], points.column[row >= 0]] = True
        before = before & (row >= 0)
        hidden[row[before], points.column[before]] = True
        gaps = np.diff(np.flatnonzero(met.T.ravel()))
        usual = int(np.median(gaps)) if len(gaps) else 1
        pitch = float(gaps[gaps <= 2 * usual].mean()) if len(gaps) else 1.0
        near = np.ones((usual | 1, 1), dtype=bool)
        return cls(
            ndimage.binary_dilation(met, near), ndimage.binary_dilation(hidden, near), pitch
        )


def _without_pane(
    beams: _Beams, group: list[_Opening], wall: Floats, frame: ColumnFrame,
    chosen: ArcadeParameters,
) -> bool:  # fmt: skip
    """Whether so few beams onto the floor are missing that no pane can stand before it."""
    # Beams at the edges of openings meet the piers in part.
    columns = np.concatenate([one.columns[1:-1] for one in group])
    back = np.concatenate([np.full(len(one.columns) - 2, one.back) for one in group])
    down = np.tan(np.minimum(frame.angles_rad, -1e-3))[:, None]
    reach = (frame.road_m - frame.origins[:, 2])[columns] / down
    front = wall[columns]
    free = ~beams.hidden[:, columns]
    floor = free & (reach > front + chosen.floor_m) & (reach < front + back - chosen.floor_m)
    before = free & (reach > front - chosen.before_m) & (reach < front - chosen.floor_m)
    if not floor.any():
        return False
    hits, count = beams.met[:, columns], floor.sum() / beams.pitch
    pavement = float(hits[before].mean()) if before.any() else 1.0
    lost = count * max(pavement - float(hits[floor].mean()), 0.0)
    fewest = chosen.pane * count - _SIGMAS * np.sqrt(chosen.pane * (1.0 - chosen.pane) * count)
    return bool(fewest > 0.0 and lost <= fewest)


def _closed_up(found: Arcades, spacing_m: float) -> Arcades:
    """Columns between two of one opening, before which something stands, are of it."""
    depth, top = found.depth.copy(), found.top.copy()
    known = np.flatnonzero(np.isfinite(depth))
    for one, other in zip(known[:-1].tolist(), known[1:].tolist(), strict=True):
        narrow = 1 < other - one <= max(int(round(0.4 / spacing_m)), 2)
        if narrow and abs(depth[other] - depth[one]) < 0.5:
            depth[one + 1 : other] = (depth[one] + depth[other]) / 2
            top[one + 1 : other] = min(top[one], top[other])
    return Arcades(depth, top)
