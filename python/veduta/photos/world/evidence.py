"""What the walls say for a placement: how much likelier they are so than anywhere by chance.

For each wall the logarithm of a likelihood ratio. Under the placement its plane, its two edges and
its top lie off those of a facade by noise; at random they lie anywhere. Either may be untrue of a
single wall (a hedge; a facade half hidden), so each is a mixture, and no wall alone can forbid a
placement, nor carry it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.facades import Facades
from veduta.photos.world.columns import Complex, Placements, WallColumns, complex_of
from veduta.photos.world.eye_height import Feet
from veduta.photos.world.gauss_newton import BEHIND_M, BEHIND_SD_M

PLANE_SD_M, EDGE_SD_M, TOP_SD_M = 0.25, 0.4, 0.6
EXACT_PLANE_SD_M, EXACT_EDGE_SD_M, EXACT_TOP_SD_M = 0.08, 0.15, 0.15
"""Some walls are mapped and modelled well, others roughly: each deviation holds for half of them.
On rendered streets the planes of walls that are seen well lie .05 m off those of the model, and
half of the tops that are the facades' own .1 m."""
PLANES_PER_M, EDGES_PER_M, TOPS_PER_M = 0.1, 0.12, 0.12
"""How densely planes, edges and tops of facades lie, for a wall that is not one of them."""
IN_MODEL, EDGE_SEEN, TOP_SEEN = 0.85, 0.6, 0.6
"""Share of walls that are facades of the model, and of edges and tops that are the facade's own."""
FACING = 0.97
"""Cosine of the angle between a wall and its facade, at least."""
REACH_M = 3.0
TURN_M = 4.0
"""What a facade's direction counts in the tree, beside its place."""
PLACES = np.array([0.12, 0.5, 0.88])
"""Places along a wall at which facades are looked for: neighbours may be one wall."""
GROUND_M = 1.0
"""How far the feet of a model may lie off the ground of the street: LoD1 ends at the lowest."""
CANDIDATES = 3
AT_ONCE = 4000


@dataclass(frozen=True)
class Matches:
    """What the walls of each of h placements are matched with.

    facade: (h, w, 3) at each of `PLACES`, -1 where there is none. off_m: (h, w, 3) in front of its
    plane, NaN where there is none. edges_m: (h, w, 2) of start and end beyond the facade's.
    lift_m: (h,) the height of the model's zero. evidence: (h, w) nats.
    """

    facade: NDArray[np.int64]
    off_m: NDArray[np.float64]
    edges_m: NDArray[np.float64]
    lift_m: NDArray[np.float64]
    evidence: NDArray[np.float64]

    @property
    def score(self) -> NDArray[np.float64]:
        """(h,) nats, of all walls together."""
        found: NDArray[np.float64] = self.evidence.sum(axis=1)
        return found


@dataclass(frozen=True)
class FacadeIndex:
    """Facades with a tree of places along them."""

    facades: Facades

    @cached_property
    def start(self) -> Complex:
        """(f,)."""
        return complex_of(self.facades.start)

    @cached_property
    def along(self) -> Complex:
        """(f,) unit."""
        return complex_of(self.facades.along)

    @cached_property
    def width(self) -> NDArray[np.float64]:
        """(f,)."""
        return self.facades.width

    @cached_property
    def feet(self) -> Feet:
        """Where the buildings stand."""
        return Feet(self.facades)

    @cached_property
    def _places(self) -> tuple[KDTree, NDArray[np.int64]]:
        places, row = self.facades.samples()
        shown = ~self.facades.hidden[row]
        places, row = places[shown], row[shown]
        along = self.facades.along[row]
        return KDTree(np.column_stack([places, TURN_M * along])), row

    def near(self, places: Complex, along: Complex) -> NDArray[np.int64]:
        """(n, CANDIDATES) the facades nearest to (n,) places that face nearly so; -1: none."""
        tree, row = self._places
        asked = np.column_stack(
            [places.real, places.imag, TURN_M * along.real, TURN_M * along.imag]
        )
        _, found = tree.query(asked, k=CANDIDATES, distance_upper_bound=REACH_M)
        found = np.asarray(found, dtype=np.int64).reshape(len(places), CANDIDATES)
        none = found == len(row)
        return np.where(none, -1, row[np.where(none, 0, found)])


def match_walls(walls: WallColumns, index: FacadeIndex, placements: Placements) -> Matches:
    """The matches of all placements, some thousand of them at a time."""
    pieces = [
        _matched(
            walls, index, placements.taken(np.arange(low, min(low + AT_ONCE, len(placements))))
        )
        for low in range(0, len(placements), AT_ONCE)
    ]
    return Matches(
        *(
            np.concatenate([getattr(piece, name) for piece in pieces])
            for name in ("facade", "off_m", "edges_m", "lift_m", "evidence")
        )
    )


def _matched(walls: WallColumns, index: FacadeIndex, placements: Placements) -> Matches:
    start, end = placements.moved(walls.start), placements.moved(walls.end)
    facade, off = _supports(index, start, end)
    known = facade >= 0
    first, last = facade[..., 0], facade[..., 2]
    edges = np.stack(
        [
            np.where(
                known[..., 0],
                ((start - index.start[first]) * np.conj(index.along[first])).real,
                np.nan,
            ),
            np.where(
                known[..., 2],
                ((end - index.start[last]) * np.conj(index.along[last])).real - index.width[last],
                np.nan,
            ),
        ],
        axis=-1,
    )
    scale = np.abs(placements.turn)[:, None]
    tops = np.where(known, index.facades.top[facade], -np.inf).max(axis=-1)
    tops = np.where(known.any(axis=-1), tops - scale * walls.top, np.nan)
    lift = _mode(tops)
    if walls.ground is not None:
        feet = np.where(known, index.facades.bottom[facade], np.inf).min(axis=-1)
        lift = _on_the_ground(tops, feet - scale * walls.ground, lift)
    evidence = _evidence(off + _behind(off)[:, None, None], edges, tops - lift[:, None], walls)
    return Matches(facade, off, edges, lift, evidence)


def _supports(
    index: FacadeIndex, start: Complex, end: Complex
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """At each place of each wall the facade of the nearest plane, and how far in front of it."""
    edge = end - start
    along = edge / np.abs(edge)
    places = start[..., None] + PLACES * edge[..., None]
    ways = np.broadcast_to(along[..., None], places.shape)
    near = index.near(places.ravel(), ways.ravel()).reshape(*places.shape, CANDIDATES)
    local = (places[..., None] - index.start[near]) * np.conj(index.along[near])
    facing = (along[..., None, None] * np.conj(index.along[near])).real
    beside = (local.real > -0.5) & (local.real < index.width[near] + 0.5)
    fits = (near >= 0) & (facing > FACING) & beside & (np.abs(local.imag) < REACH_M)
    cost = np.where(fits, np.abs(local.imag), np.inf)
    best = cost.argmin(axis=-1)[..., None]
    found = np.take_along_axis(fits, best, axis=-1)[..., 0]
    facade = np.where(found, np.take_along_axis(near, best, axis=-1)[..., 0], -1)
    # Outward is to the right of the way from start to end: the negative imaginary axis.
    off = np.where(found, -np.take_along_axis(local.imag, best, axis=-1)[..., 0], np.nan)
    return facade, off


def _mode(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """(h,) of (h, w) values that about which most lie; zero where there are none."""
    apart = values[:, :, None] - values[:, None, :]
    weight = np.nan_to_num(np.exp(-0.5 * (apart / TOP_SD_M) ** 2))
    votes = weight.sum(axis=2)
    best = votes.argmax(axis=1)
    row = np.arange(len(values))
    near = weight[row, best]
    total = np.maximum(near.sum(axis=1), 1e-12)
    found: NDArray[np.float64] = (near * np.nan_to_num(values)).sum(axis=1) / total
    return found


def _on_the_ground(
    tops: NDArray[np.float64], feet: NDArray[np.float64], lift: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(h,) lifts from (h, w) tops and feet: tops have a say only where the ground lets them.

    feet: infinite where a wall has no facade.
    """
    told = np.isfinite(feet)
    count = told.sum(axis=1)
    order = np.sort(np.where(told, feet, np.inf), axis=1)
    at = np.maximum(count - 1, 0) // 2
    ground = np.where(count > 0, order[np.arange(len(feet)), at], lift)
    near = np.where(np.abs(tops - ground[:, None]) < GROUND_M, tops, np.nan)
    by_tops = np.where(np.isfinite(near).any(axis=1), _mode(near), ground)
    found: NDArray[np.float64] = by_tops
    return found


def _behind(off: NDArray[np.float64]) -> NDArray[np.float64]:
    """(h,) how far walls lie behind their facades, by the median of (h, w, 3) and what is usual.

    Points of windows and reveals draw all walls of a street back by as much (`gauss_newton`).
    """
    middle = off[..., 1]
    near = np.abs(middle) < 3.0 * PLANE_SD_M
    count = near.sum(axis=1)
    order = np.sort(np.where(near, middle, np.inf), axis=1)
    at = np.maximum(count - 1, 0)
    row = np.arange(len(off))
    median = np.where(count > 0, (order[row, at // 2] + order[row, (at + 1) // 2]) / 2.0, 0.0)
    seen, known = count / EXACT_PLANE_SD_M**2, 1.0 / BEHIND_SD_M**2
    found: NDArray[np.float64] = (known * BEHIND_M - seen * median) / (known + seen)
    return found


def _evidence(
    off: NDArray[np.float64],
    edges: NDArray[np.float64],
    tops: NDArray[np.float64],
    walls: WallColumns | None = None,
) -> NDArray[np.float64]:
    """(h, w) nats: the plane at three places, the edges, the top.

    Where only the view ends (`walls`), that the facade goes on is no evidence against it.
    """
    found = _planes(off)
    on = np.abs(off) < 3.0 * PLANE_SD_M
    near = _mixed(edges, EXACT_EDGE_SD_M, EDGE_SD_M)
    edge = np.log(EDGE_SEEN * near / EDGES_PER_M + 1.0 - EDGE_SEEN)
    if walls is not None and walls.cut_edges is not None:
        edge = np.where(walls.cut_edges, np.maximum(edge, 0.0), edge)
    found += np.where(on[..., [0, 2]], edge, 0.0).sum(axis=-1)
    high = _mixed(tops, EXACT_TOP_SD_M, TOP_SD_M)
    top = np.log(TOP_SEEN * high / TOPS_PER_M + 1.0 - TOP_SEEN)
    if walls is not None and walls.cut_tops is not None:
        top = np.where(walls.cut_tops, np.maximum(top, 0.0), top)
    found += np.where(on.any(axis=-1), top, 0.0)
    return found


def plane_nats(matches: Matches) -> NDArray[np.float64]:
    """(h, w) what of the evidence the planes of the walls say."""
    return _planes(matches.off_m + _behind(matches.off_m)[:, None, None])


def _planes(off: NDArray[np.float64]) -> NDArray[np.float64]:
    planes = _mixed(off, EXACT_PLANE_SD_M, PLANE_SD_M)
    found: NDArray[np.float64] = np.log(IN_MODEL * planes / PLANES_PER_M + 1.0 - IN_MODEL).mean(-1)
    return found


def _mixed(values: NDArray[np.float64], exact_sd: float, sd: float) -> NDArray[np.float64]:
    """The density of which one half has each deviation."""
    return 0.5 * (_normal(values, exact_sd) + _normal(values, sd))


def _normal(values: NDArray[np.float64], sd: float) -> NDArray[np.float64]:
    """The normal density; zero where there is no value."""
    density = np.exp(-0.5 * (values / sd) ** 2) / (sd * np.sqrt(2.0 * np.pi))
    found: NDArray[np.float64] = np.nan_to_num(density)
    return found
