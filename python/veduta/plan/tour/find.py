"""The tour of a house: around it, in by its door, through its rooms, and out again.

It is outdoors for a fifth of its time at most, goes into no cupboards, and looks at no wall that is
right before one's eyes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta.place.camera_path import CameraPath
from veduta.plan.house.build import House
from veduta.plan.house.entrance import entrances
from veduta.plan.tour import gaze, pace
from veduta.plan.tour.clear_view import cleared, sights_of
from veduta.plan.tour.free import Ground
from veduta.plan.tour.grid import CELL_M, Cells, Grid
from veduta.plan.tour.outside import Outside, outside_of
from veduta.plan.tour.planned import THROUGH, Plan, planned, shut_notes
from veduta.plan.tour.smooth import STEP_M, lengths_along, resampled, smoothed
from veduta.plan.tour.stops import Stop, short_order
from veduta.plan.tour.stretches import Stretch, outdoor_share, stretches_of

EYE_M = 1.7
FOV_RAD = math.radians(60.0)
SHORT_M = 1.2
"""One stops so far before the middle of a room at most, to see it in front ..."""
SHORT_SHARE = 0.4
"""... and by no more than this share of the way in it."""
ON_FLOOR_M = 0.05
OUTDOORS = 0.2
"""At most so much of the tour is outdoors ..."""
SPARED = 0.8
"""... of which so much is planned: slow turns add to it. Where they add more, so often ..."""
TRIES, LESS = 4, 0.95
"""... less is planned, by a little more than what was too much."""
COMING = 0.7
"""Of the time outdoors so much is for coming, the rest for leaving."""
LEAST_M = 1.0
"""But at least so far before the door one begins and ends."""
INDOORS = "the tour is indoors only: no way in from outside that is wide enough leads to most rooms"
LONG_OUTDOORS = "{:.0%} of the tour is outdoors, where {:.0%} are the most that is aimed at"


@dataclass(frozen=True)
class Tour:
    """The camera's path in the frame of the house, the rooms passed, and what it leaves out.

    shut: the doors that stay closed, as rows of the features of the house; shut_ids: their ids.
    """

    path: CameraPath
    stretches: tuple[Stretch, ...]
    length_m: float
    notes: tuple[str, ...]
    grounds: tuple[Ground, ...]
    shut: tuple[int, ...] = ()
    shut_ids: tuple[str, ...] = ()


@dataclass(frozen=True)
class Leg:
    """A way of the feet (n, 3), and the stop in whose room it ends."""

    points_m: NDArray[np.float64]
    stop: Stop | None


def find_tour(house: House, speed_m_s: float, *, indoors: bool = False) -> Tour | None:
    """The tour; None where there is no room in which one can stand. indoors: of a flat."""
    first = house.spaces[house.ground]
    ways_in = () if indoors else entrances(first)
    outside = outside_of(first, ways_in[0]) if ways_in else None
    plan = planned(house, outside)
    if plan is None:
        return None
    legs = _legs_through(plan.begin.node, plan.found.stops, plan.grid, plan.grounds)
    around = outside if plan.begin.is_outside else None
    timed = _timed(legs, around, plan, first.slab, speed_m_s)
    eyes = timed.feet_m + np.array([0.0, 0.0, EYE_M])
    path = CameraPath("tour", timed.times_s, eyes, timed.directions, FOV_RAD)
    length = float(np.linalg.norm(np.diff(eyes, axis=0), axis=1).sum())
    notes = (
        *coarse_notes(plan.grounds, plan.grid.storeys),
        *plan.found.missed,
        *shut_notes([house.part.features.name[door] for door in plan.shut]),
        *((INDOORS,) if around is None and not indoors else ()),
    )
    ids = tuple(house.part.features.id[door] for door in plan.shut)
    passed = stretches_of(timed, plan.grounds)
    return Tour(path, passed, length, notes, plan.grounds, plan.shut, ids)


def _timed(
    legs: Sequence[Leg], around: Outside | None, plan: Plan, slab: BaseGeometry, speed_m_s: float
) -> pace.Timed:
    """All in its time; less outdoors, where slow turns there made it too much."""
    sights = sights_of(plan.grounds, plan.leaves)
    planned_share = SPARED * OUTDOORS
    for _ in range(TRIES):
        ring, cut = _shared_out(legs, around, slab, speed_m_s, planned_share)
        motions = _motions(cut, ring, slab, speed_m_s)
        timed = pace.timed(motions, lambda feet, yaw: cleared(feet, yaw, sights))
        share = outdoor_share(stretches_of(timed, plan.grounds))
        if around is None or share <= OUTDOORS:
            break
        planned_share *= LESS * OUTDOORS / share
    return timed


def outdoor_notes(stretches: Sequence[Stretch]) -> list[str]:
    """Where more of a tour is outdoors than is aimed at, even after all tries: small houses."""
    share = outdoor_share(stretches)
    return [LONG_OUTDOORS.format(share, OUTDOORS)] if share > OUTDOORS else []


def coarse_notes(grounds: Sequence[Ground], squares: Sequence[Cells]) -> list[str]:
    """Where squares are larger than usual, as narrow doors may be missed there."""
    return [
        f"{ground.space.storey.name} is so large that the tour's way in it was searched on squares"
        f" of {100.0 * cells.side_m:.0f} cm: it may miss narrow doors"
        for ground, cells in zip(grounds, squares, strict=True)
        if cells.side_m > CELL_M
    ]


def _legs_through(
    start: int, stops: Sequence[Stop], grid: Grid, grounds: Sequence[Ground]
) -> list[Leg]:
    """From the start through all stops and back; halls that one passes anyway are no stops."""
    costs = grid.costs([start, *(stop.node for stop in stops)])
    chosen = [row for row, stop in enumerate(stops) if stop.room.use not in THROUGH]
    chosen = chosen or list(range(len(stops)))

    def through(rows: Sequence[int]) -> list[Leg]:
        ends = [0, *(row + 1 for row in rows)]
        some = [stops[row] for row in rows]
        return _legs(start, some, costs[np.ix_(ends, ends)], grid, grounds)

    legs = through(chosen)
    others = (row for row in range(len(stops)) if row not in chosen)
    late = [row for row in others if not _passes(legs, stops[row], grounds)]
    return through([*chosen, *late]) if late else legs


def _passes(legs: Sequence[Leg], stop: Stop, grounds: Sequence[Ground]) -> bool:
    points = np.concatenate([leg.points_m for leg in legs])
    level = points[np.abs(points[:, 2] - grounds[stop.storey].elevation_m) < ON_FLOOR_M]
    return bool(shapely.contains_xy(stop.shape, level[:, 0], level[:, 1]).any())


def _legs(
    start: int,
    stops: Sequence[Stop],
    costs: NDArray[np.float64],
    grid: Grid,
    grounds: Sequence[Ground],
) -> list[Leg]:
    """From the start through these stops and back; `costs` (k, k) from end to end, start first."""
    legs: list[Leg] = []
    here = start
    for row in short_order(costs):
        stop = stops[row - 1]
        squares = _cut_short(grid.way(here, stop.node), stop, grid)
        legs.append(Leg(_way(squares, grid, grounds), stop))
        here = squares[-1]
    legs.append(Leg(_way(grid.way(here, start), grid, grounds), None))
    return legs


def _cut_short(squares: list[int], stop: Stop, grid: Grid) -> list[int]:
    """The way without its last piece in the room."""
    inside = shapely.contains_xy(stop.shape, *grid.places_m[squares].T)
    outside = np.flatnonzero(~inside)
    entered = int(outside[-1]) + 1 if len(outside) else 0
    steps = np.linalg.norm(np.diff(grid.places_m[squares[entered:]], axis=0), axis=1)
    to_end = np.cumsum(steps[::-1])
    if len(to_end) == 0:
        return squares
    cut = min(SHORT_M, SHORT_SHARE * float(to_end[-1]))
    return squares[: len(squares) - int(np.searchsorted(to_end, cut))]


def _way(squares: list[int], grid: Grid, grounds: Sequence[Ground]) -> NDArray[np.float64]:
    """(n, 3) the feet on a way over squares, smoothed in each storey."""
    storeys = grid.storey[squares]
    breaks = np.flatnonzero(np.diff(storeys)) + 1
    pieces: list[NDArray[np.float64]] = []
    last = squares[0]
    for run in np.split(np.array(squares), breaks):
        ground = grounds[grid.storey[run[0]]]
        flat = smoothed(grid.places_m[run], ground.free, ground.grazed)
        level = np.column_stack([flat, np.full(len(flat), ground.elevation_m)])
        if pieces:  # up or down a flight
            low = min(grounds[grid.storey[one]].elevation_m for one in (last, run[0]))
            stairs = grid.climb(last, run[0])[1:-1] + np.array([0.0, 0.0, low])
            line = np.concatenate([pieces[-1][-1:], stairs, level[:1]])
            pieces.append(resampled(line, STEP_M)[1:-1])
        pieces.append(level)
        last = int(run[-1])
    return np.concatenate(pieces)


def _shared_out(
    legs: Sequence[Leg], outside: Outside | None, slab: BaseGeometry, speed_m_s: float, share: float
) -> tuple[NDArray[np.float64] | None, list[Leg]]:
    """The way around the house (n, 2), or what of it there is time for, and the legs, cut likewise.

    Outdoors one is for this share of the tour: first the walk around is shortened to its end, then
    the way from there to the door and back.
    """
    if outside is None or len(legs) < 2:
        return None, list(legs)
    inside_s = 0.0
    for motion in _motions(legs, None, slab, speed_m_s):
        x, y, z = motion.feet_m.T
        indoors = shapely.contains_xy(slab, x, y) | (np.abs(z - motion.feet_m[0, 2]) > ON_FLOOR_M)
        inside_s += pace.SAMPLE_S * float(indoors.sum())
    budget_m = share / (1.0 - share) * inside_s * speed_m_s
    first, last = legs[0], legs[-1]
    come, come_m = _cut_outdoors(first.points_m[::-1], slab, max(COMING * budget_m, LEAST_M))
    leave, leave_m = _cut_outdoors(last.points_m, slab, max((1.0 - COMING) * budget_m, LEAST_M))
    cut = [Leg(come[::-1], first.stop), *legs[1:-1], Leg(leave, last.stop)]
    left_m = budget_m - come_m - leave_m
    if len(come) < len(first.points_m) or left_m < LEAST_M:
        return None, cut
    along = lengths_along(np.column_stack([outside.ring_m, np.zeros(len(outside.ring_m))]))
    return outside.ring_m[along >= along[-1] - left_m], cut


def _cut_outdoors(
    points_m: NDArray[np.float64], slab: BaseGeometry, most_m: float
) -> tuple[NDArray[np.float64], float]:
    """A way (n, 3) out of a house, at most so far beyond its door, and how far that is."""
    within = np.flatnonzero(shapely.contains_xy(slab, points_m[:, 0], points_m[:, 1]))
    door = int(within[-1]) if len(within) else 0
    beyond = lengths_along(points_m[door:])
    kept = max(int(np.searchsorted(beyond, most_m, "right")), 1)
    return points_m[: max(door + kept, 2)], float(beyond[min(kept, len(beyond)) - 1])


def _motions(
    legs: Sequence[Leg],
    ring_m: NDArray[np.float64] | None,
    slab: BaseGeometry,
    speed_m_s: float,
) -> list[pace.Motion]:
    motions: list[pace.Motion] = []
    if ring_m is not None and len(ring_m) > 1:
        height = np.full(len(ring_m), legs[0].points_m[0, 2])
        ring = np.column_stack([ring_m, height])
        centre = np.array(slab.centroid.coords[0])
        motions.append(pace.walk(ring, *gaze.around(ring, centre), speed_m_s))
    views = [gaze.walking(leg.points_m, _middle(leg.stop)) for leg in legs]
    for number, (leg, view) in enumerate(zip(legs, views, strict=True)):
        if len(leg.points_m) > 1:
            motions.append(pace.walk(leg.points_m, *view, speed_m_s))
        if leg.stop is not None and number + 1 < len(legs):
            here = leg.points_m[-1]
            # Who did not have to walk looks where he looked.
            arrive = motions[-1].yaw if motions else view[0]
            leave = views[number + 1][0]
            yaws = gaze.turn(here[:2], leg.stop.shape, float(arrive[-1]), float(leave[0]))
            motions.append(pace.look(here, yaws, gaze.LEVEL_RAD))
    return motions


def _middle(stop: Stop | None) -> NDArray[np.float64] | None:
    return None if stop is None else np.array(stop.shape.centroid.coords[0])
