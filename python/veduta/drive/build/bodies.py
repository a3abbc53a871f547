"""Houses behind the facades: each plane joined to the roof that a surface model has there (LoD2).

The front is a wall of the drive, the roof that of the surface model; the walls at the sides and at
the back stand where its roof ends. A body is a profile of the house moved along its front, so that
it is closed however the roof lies.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.facade_planes import FacadePlane
from veduta.drive.record import HeightGrid

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class BodyParameters:
    """deepest_m: of a house behind its front. standing_m: what is lower is none. step_m: roofs that
    differ by more are of two houses. narrowest_m, shallowest_m: smaller pieces are no houses.
    known: share of cells behind a front that must have a height. better: a roof of two slopes is
    taken where it lies so many times nearer to the surface than one of one slope, steep: and rises
    by so much per metre. edge_m: so much of the roof's rim is not looked at: cells there are mixed.
    near_m: so far behind its front a house's height is taken. reach_m: along the front on each side
    of a step, whose median heights are compared. least_heights: a roof is not fitted to fewer.
    """

    deepest_m: float = 20.0
    standing_m: float = 2.5
    step_m: float = 1.0
    narrowest_m: float = 3.0
    shallowest_m: float = 3.0
    known: float = 0.5
    better: float = 0.7
    steep: float = 0.15
    edge_m: float = 0.7
    near_m: float = 6.0
    reach_m: float = 2.0
    least_heights: int = 3


@dataclass(frozen=True, eq=False)
class Body:
    """A house. front: (2, 3) its lower corners, left and right as seen from the street (m, world).

    profile: (k, 2) how far behind the front, and how high over its foot: the roof from front to
    back (m); the first is at 0, the last at the back. off_m: how far the surface model lies from
    the roof, in the median. inward: (2,) unit, from the street.
    """

    name: str
    front: Floats
    profile: Floats
    inward: Floats
    off_m: float

    def faces(self) -> Iterator[tuple[str, Floats]]:
        """(what it is, (n, 3) corners counter-clockwise from outside) of the closed body: "front",
        "back", "left", "right", "ground", and "roof" for each slope.
        """
        left, right = (self._section(corner) for corner in self.front)
        yield "ground", np.stack([left[0], left[-1], right[-1], right[0]])
        yield "front", np.stack([left[0], right[0], right[1], left[1]])
        yield "back", np.stack([right[-1], left[-1], left[-2], right[-2]])
        yield "left", left
        yield "right", right[::-1]
        for row in range(1, len(left) - 2):
            yield "roof", np.stack([left[row], right[row], right[row + 1], left[row + 1]])

    def _section(self, corner: Floats) -> Floats:
        """(k + 2, 3) the profile with its feet at one end of the front."""
        away = np.concatenate([[0.0], self.profile[:, 0], self.profile[-1:, 0]])
        height = np.concatenate([[0.0], self.profile[:, 1], [0.0]])
        return np.column_stack([corner[:2] + away[:, None] * self.inward, corner[2] + height])


@dataclass(frozen=True, eq=False)
class Bodies:
    """The houses behind a facade plane, from left to right.

    roofless: where along the front (m from its left end) a house stands whose roof the model has no
    heights of.
    """

    found: tuple[Body, ...]
    roofless: tuple[tuple[float, float], ...]


def bodies_of(
    name: str, plane: FacadePlane, grid: HeightGrid, parameters: BodyParameters | None = None
) -> Bodies:
    """The houses behind a facade plane; none where the model has no roof."""
    chosen = parameters or BodyParameters()
    axis = (plane.right[:2] - plane.left[:2]) / max(plane.width_m, 1e-9)
    inward = np.array([-axis[1], axis[0]])
    step = min(grid.cell_m, 1.0)
    across = np.arange(step / 2, plane.width_m, step)
    behind = np.arange(step / 2, chosen.deepest_m, step)
    places = plane.left[:2] + across[:, None, None] * axis + behind[:, None] * inward
    heights = grid.at(places.reshape(-1, 2)).reshape(len(across), len(behind)) - plane.left[2]
    found: list[Body] = []
    roofless: list[tuple[float, float]] = []
    for first, last in _houses(heights, step, chosen):
        piece = heights[first:last]
        deep = _depth(piece, behind, step, chosen)
        wide = (last - first) * step
        if deep is None or wide < chosen.narrowest_m:
            continue
        ends = (first * step, min(last * step, plane.width_m))
        if last == len(heights):
            ends = (ends[0], plane.width_m)
        roof = _roof(piece, behind, deep, chosen)
        if roof is None:
            roofless.append(ends)
            continue
        profile, off = roof
        front = np.array([[*(plane.left[:2] + end * axis), plane.left[2]] for end in ends])
        found.append(Body(f"{name}-{len(found) + 1}", front, profile, inward, off))
    return Bodies(tuple(found), tuple(roofless))


def _houses(
    heights: Floats, step: float, chosen: BodyParameters
) -> Iterator[tuple[int, int]]:
    """First and one past the last column of roofs of one height along the front."""
    near = heights[:, : max(int(chosen.near_m / step), 2)]
    known = np.isfinite(near).mean(axis=1) >= chosen.known
    level = np.full(len(heights), np.nan)
    if known.any():
        level[known] = np.nanmedian(near[known], axis=1)
    stands = known & (np.nan_to_num(level) > chosen.standing_m)
    if not stands.any():
        return
    reach = max(int(round(chosen.reach_m / step)), 1)
    filled = np.interp(np.arange(len(level)), np.flatnonzero(stands), level[stands])
    before = ndimage.median_filter(filled, reach, origin=(reach - 1) // 2, mode="nearest")
    after = ndimage.median_filter(filled, reach, origin=-(reach // 2), mode="nearest")
    jump = np.abs(after[1:] - before[:-1])
    highest = ndimage.maximum_filter1d(jump, 2 * reach + 1) if len(jump) else jump
    cut = np.flatnonzero((jump > chosen.step_m) & (jump == highest)) + 1
    cut = cut[np.diff(cut, prepend=-reach) >= reach]  # of a level top the first
    ends = np.unique(np.concatenate([[0], cut, np.flatnonzero(np.diff(stands)) + 1, [len(level)]]))
    for first, last in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True):
        if stands[first:last].mean() > chosen.known:
            yield first, last


def _depth(piece: Floats, behind: Floats, step: float, chosen: BodyParameters) -> float | None:
    """How far behind the front the roof ends (m): the median over the columns; None: nowhere."""
    with np.errstate(invalid="ignore"):
        open_ = piece < chosen.standing_m
    first = np.where(open_.any(axis=1), np.argmax(open_, axis=1), piece.shape[1])
    deep = float(np.median(behind[np.minimum(first, len(behind)) - 1] + step / 2))
    return deep if deep >= chosen.shallowest_m else None


def _roof(
    piece: Floats, behind: Floats, deep: float, chosen: BodyParameters
) -> tuple[Floats, float] | None:
    """(k, 2) the roof's profile, and how far the surface lies from it (m); None: too few heights.

    One slope, or two with the ridge where they fit best; each by its median residual after a robust
    fit (three rounds of least squares without the worst third).
    """
    inside = (behind > chosen.edge_m) & (behind < deep - chosen.edge_m)
    away = np.broadcast_to(behind, piece.shape)[:, inside].ravel()
    height = piece[:, inside].ravel()
    kept = np.isfinite(height) & (height > chosen.standing_m)
    away, height = away[kept], height[kept]
    if len(height) < chosen.least_heights:
        return None
    one = _fitted(np.column_stack([np.ones_like(away), away]), height)
    ends = np.array([0.0, deep])
    single: Floats = np.column_stack([ends, one[0][0] + ends * one[0][1]])
    best: Floats = single
    off = one[1]
    for ridge in np.arange(0.25, 0.8, 0.05) * deep:
        left, right = np.minimum(away, ridge), np.maximum(away - ridge, 0.0)
        told, error = _fitted(np.column_stack([np.ones_like(away), left, right]), height)
        if told[1] > chosen.steep and told[2] < -chosen.steep and error < chosen.better * off:
            top = told[0] + told[1] * ridge
            sides = [[0.0, told[0]], [ridge, top], [deep, top + told[2] * (deep - ridge)]]
            best = np.array(sides, dtype=np.float64)
            off = error / chosen.better  # the next ridge need not be so much better again
    lowest = chosen.standing_m / 2
    return np.column_stack([best[:, 0], np.maximum(best[:, 1], lowest)]), float(
        off if best is single else off * chosen.better
    )


def _fitted(rows: Floats, values: Floats) -> tuple[Floats, float]:
    """Coefficients, and the median of what they are off."""
    kept = np.ones(len(values), dtype=bool)
    told: Floats = np.zeros(rows.shape[1])
    off: Floats = np.zeros(len(values))
    for _ in range(3):
        solved = np.linalg.lstsq(rows[kept], values[kept], rcond=None)[0]
        told = np.asarray(solved, dtype=np.float64)
        off = np.asarray(np.abs(values - rows @ told), dtype=np.float64)
        kept = off <= np.quantile(off, 0.67)
    return told, float(np.median(off)) if len(off) else 0.0
