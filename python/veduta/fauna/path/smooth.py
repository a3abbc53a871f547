"""A smooth curve along the planned way that keeps clear of obstacles.

The way is smoothed, and a cubic spline goes through what is left. It is checked cell by cell: where
it leaves the free cells, or the points that were asked for, it is planned again half as smooth,
until it keeps to them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.ndimage import gaussian_filter1d

from veduta.fauna.motion.angles import Floats, equal_steps
from veduta.fauna.path.limits import SmoothLimits
from veduta.fauna.path.plan import Ways
from veduta.fauna.path.terrain import Terrain
from veduta.run.errors import NotFoundError


def smooth_path(
    terrain: Terrain, ways: Ways, way: Floats, through: Floats, limits: SmoothLimits,
    length_m: float, *, closed: bool,
) -> Floats:  # fmt: skip
    """(n, 3) the path in metres on the ground, in steps of a tenth of the body.

    way: (k, 2) cells. through: (j, 2) cells of the points that it was asked to go through.
    NotFoundError where no curve keeps clear of the obstacles.
    """
    near = max(limits.near * length_m / terrain.cell_m, 1.5)
    sigma = limits.smoothed * length_m / terrain.cell_m
    for halving in range(limits.rounds):
        line = _curve(way, sigma / 2.0**halving, closed=closed)
        if _passes(line, through, near) and _is_free(ways, line):
            return _on_ground(terrain, line, limits, length_m, closed=closed)
    if _is_free(ways, way):
        return _on_ground(terrain, way, limits, length_m, closed=closed)
    raise NotFoundError(
        "a smooth path",
        "the way between the obstacles is too narrow for a curve",
        "Choose points in the open, or a smaller animal.",
    )


def _curve(way: Floats, sigma: float, *, closed: bool) -> Floats:
    """A cubic spline through the way, smoothed over `sigma` cells; its ends stay where they are."""
    count = max(4, len(way))
    even: Floats = np.asarray(equal_steps(way[None], count)[0], dtype=np.float64)
    if sigma < 0.3:
        return even
    if closed:
        smooth = gaussian_filter1d(even[:-1], sigma, axis=0, mode="wrap")
        smooth = np.concatenate([smooth, smooth[:1]])
    else:
        # Odd about both ends: they keep their places and their directions.
        smooth = _with_ends(even, sigma)
    knots = np.unique(np.linspace(0, count - 1, max(4, int(count / max(sigma, 1.0)))).round())
    places = knots.astype(int)
    spline = make_interp_spline(
        knots, smooth[places], k=3, bc_type="periodic" if closed else "natural"
    )
    return np.asarray(spline(np.linspace(0, count - 1, 4 * count)), dtype=np.float64)


def _with_ends(even: Floats, sigma: float) -> Floats:
    reach = min(len(even) - 1, int(4 * sigma) + 1)
    before = 2 * even[0] - even[reach:0:-1]
    after = 2 * even[-1] - even[-2 : -2 - reach : -1]
    longer = np.concatenate([before, even, after])
    smooth = np.array(gaussian_filter1d(longer, sigma, axis=0)[reach : reach + len(even)])
    smooth[0], smooth[-1] = even[0], even[-1]
    return np.asarray(smooth, dtype=np.float64)


def _passes(line: Floats, through: Floats, near: float) -> bool:
    """Whether a line comes near to all points."""
    apart = np.linalg.norm(line[None] - through[:, None], axis=2).min(axis=1)
    return bool((apart <= near).all())


def _is_free(ways: Ways, line: Floats) -> bool:
    """Whether all cells that a line passes are free."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    fine = equal_steps(line[None], max(2, int(4 * steps)))[0]
    cells: NDArray[np.int64] = np.round(fine).astype(np.int64)
    inside = ((cells >= 0) & (cells < np.array(ways.free.shape))).all(axis=1)
    return bool(inside.all()) and bool(ways.free[cells[:, 0], cells[:, 1]].all())


def _on_ground(
    terrain: Terrain, line: Floats, limits: SmoothLimits, length_m: float, *, closed: bool
) -> Floats:
    points = terrain.point_of(line)
    way = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    count = max(4, int(np.ceil(way / (0.1 * length_m))) + 1)
    even = equal_steps(points[None], count)[0]
    heights = terrain.height_at(even)
    sigma = limits.footing * 10.0
    calm = (
        gaussian_filter1d(heights, sigma, mode="wrap")
        if closed
        else gaussian_filter1d(heights, sigma, mode="nearest")
    )
    found = np.column_stack([even, np.where(np.isfinite(calm), calm, heights)])
    if closed:
        found[-1] = found[0]
    return found
