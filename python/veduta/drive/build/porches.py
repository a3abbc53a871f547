"""Porches: what is built on to a wall, lower than it and before it, and stands on the ground.

The layers of section 5 would take one for foreground; section 8.4 of the paper names them among what
it cannot handle. Here the columns of one get its own front as their main depth, and the wall above
and behind it is kept (as of walls across the path).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from veduta.drive.build.frame import ColumnFrame, ColumnPoints

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PorchParameters:
    """What is a porch; all but shares in metres.

    nearest_m, farthest_m: before the main depth. lowest_m, highest_m: of its top, over the ground.
    narrowest_m, widest_m: along the path. even_m: how far its front and its top stray: twice that
    from one column to the next is another thing. roof_m: thickness. foot_m: up to this height it is
    looked at for what carries it. bin_m: of depth. joined: share of the depths from its front to
    the wall at which something lies at the height of its top. open: share of columns in which one
    sees through, more than below_m below its top: not through cars. carried: share of columns in
    which something stands below its front: below a crown hardly anything does. over_m, over: share
    of columns in which more stands over_m above its top, and off_wall_m before the wall: a crown.
    """

    nearest_m: float = 0.7
    farthest_m: float = 3.5
    lowest_m: float = 2.0
    highest_m: float = 4.5
    narrowest_m: float = 1.5
    widest_m: float = 9.0
    even_m: float = 0.15
    foot_m: float = 1.6
    bin_m: float = 0.3
    roof_m: float = 0.45
    joined: float = 0.7
    open: float = 0.5
    below_m: float = 0.6
    carried: float = 0.08
    over_m: float = 0.4
    over: float = 0.3
    off_wall_m: float = 1.2


def find_porches(
    points: ColumnPoints,
    above: NDArray[np.floating],
    main: Floats,
    frame: ColumnFrame,
    parameters: PorchParameters | None = None,
) -> Floats:
    """(c,) depth of the front of the porch in each column (m), NaN where there is none.

    above: (n,) height of each point over the ground (m). main: (c,) m, NaN where no wall is.
    """
    chosen = parameters or PorchParameters()
    front = np.full(len(main), np.nan)
    before = main[points.column] - points.depth
    with np.errstate(invalid="ignore"):
        candidate = (before > chosen.nearest_m) & (before < chosen.farthest_m)
        candidate &= (above > chosen.lowest_m - chosen.roof_m) & (above < chosen.highest_m)
    nearest, top = np.full(len(main), np.inf), np.full(len(main), -np.inf)
    column = points.column[candidate]
    np.minimum.at(nearest, column, points.depth[candidate].astype(np.float64))
    np.maximum.at(top, column, above[candidate].astype(np.float64))
    some = np.isfinite(nearest) & (top >= chosen.lowest_m)
    for columns in _even_runs(nearest, top, some, 2.0 * chosen.even_m):
        wide = (columns[-1] - columns[0] + 1) * frame.spacing_m
        if not chosen.narrowest_m <= wide <= chosen.widest_m:
            continue
        place = (float(np.median(nearest[columns])), float(np.median(top[columns])))
        if _is_built(points, above, main, columns, place, chosen):
            front[columns[0] : columns[-1] + 1] = place[0]
    return front


def _even_runs(
    nearest: Floats, top: Floats, some: NDArray[np.bool_], most_m: float
) -> list[NDArray[np.int64]]:
    """Columns beside each other in which depth and height of what stands there go on."""
    known = np.flatnonzero(some)
    if not len(known):
        return []
    step = np.maximum(np.abs(np.diff(nearest[known])), np.abs(np.diff(top[known])))
    # A pane, or a beam that is lost, leaves single columns without.
    cuts = np.flatnonzero((np.diff(known) > 2) | (step > most_m)) + 1
    return [run for run in np.split(known, cuts) if len(run) > 1]


def _is_built(
    points: ColumnPoints,
    above: NDArray[np.floating],
    main: Floats,
    columns: NDArray[np.int64],
    place: tuple[float, float],
    chosen: PorchParameters,
) -> bool:
    """Whether something carries it, and it is joined to the wall, or one looks through below.

    place: its front and its top (m).
    """
    depth, level = place
    own = np.isin(points.column, columns)
    wall = float(np.median(main[columns]))
    bins = max(int((wall - depth) / chosen.bin_m), 1)
    roof = own & (np.abs(above - level) < chosen.roof_m)
    at = ((points.depth[roof] - depth) / chosen.bin_m).astype(np.int64)
    covered = np.bincount(at[(at >= 0) & (at < bins)], minlength=bins)
    # As much as one point in each third column.
    joined = float((covered > len(columns) / 3).mean())
    low = own & (np.abs(points.depth - depth) < chosen.roof_m) & (above < chosen.foot_m)
    low &= above > chosen.roof_m
    carried = len(np.unique(points.column[low])) / len(columns)
    through = own & (points.depth > depth + chosen.roof_m) & (above < level - chosen.below_m)
    below = len(np.unique(points.column[through])) / len(columns)
    higher = own & (points.depth < wall - chosen.off_wall_m) & (above > level + chosen.over_m)
    if len(np.unique(points.column[higher])) > chosen.over * len(columns):
        return False
    return carried >= chosen.carried and max(joined / chosen.joined, below / chosen.open) >= 1.0
