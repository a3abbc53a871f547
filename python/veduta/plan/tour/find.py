"""The tour of a house: once around it, in by its door, through all rooms, and out again."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.place.camera_path import CameraPath
from veduta.plan.house.build import House
from veduta.plan.house.entrance import entrances
from veduta.plan.tour import gaze, pace
from veduta.plan.tour.free import Ground, ground_of
from veduta.plan.tour.grid import Grid, cells_of
from veduta.plan.tour.leaves import open_leaves
from veduta.plan.tour.outside import Outside, outside_of
from veduta.plan.tour.smooth import smoothed
from veduta.plan.tour.stops import Stop, short_order, stops_of, title_of

EYE_M = 1.7
FOV_RAD = math.radians(60.0)
OUTSIDE = "Outside"
SHORT_M = 1.2
"""One stops so far before the middle of a room at most, to see it in front ..."""
SHORT_SHARE = 0.4
"""... and by no more than this share of the way in it."""


@dataclass(frozen=True)
class Stretch:
    """When the visitor is in a room (or outside: None)."""

    room: str | None
    title: str
    start_s: float
    end_s: float


@dataclass(frozen=True)
class Tour:
    """The camera's path in the frame of the house, the rooms passed, and what was left out."""

    path: CameraPath
    stretches: tuple[Stretch, ...]
    length_m: float
    missed: tuple[str, ...]
    grounds: tuple[Ground, ...]


@dataclass(frozen=True)
class Leg:
    """A way of the feet (n, 3), and the stop in whose room it ends."""

    points_m: NDArray[np.float64]
    stop: Stop | None


def find_tour(house: House, speed_m_s: float) -> Tour | None:
    """The tour; None where there is nowhere to walk."""
    first = house.spaces[0]
    ways_in = entrances(first)
    outside = outside_of(first, ways_in[0]) if ways_in else None
    grounds = _grounds(house, outside)
    grid = Grid([cells_of(ground) for ground in grounds])
    start = _start(grid, grounds, outside)
    if start is None:
        return None
    found = stops_of(grounds, grid, start)
    legs = _legs(start, found.stops, grid, grounds)
    motions = _motions(legs, outside, first.slab, speed_m_s)
    if not motions:
        return None
    timed = pace.timed(motions)
    eyes = timed.feet_m + np.array([0.0, 0.0, EYE_M])
    path = CameraPath("tour", timed.times_s, eyes, timed.directions, FOV_RAD)
    length = float(np.linalg.norm(np.diff(eyes, axis=0), axis=1).sum())
    return Tour(path, _stretches(timed, grounds), length, found.missed, tuple(grounds))


def _grounds(house: House, outside: Outside | None) -> list[Ground]:
    leaves = open_leaves(house.part)
    around = Polygon() if outside is None else outside.region
    return [
        ground_of(space, leaves, around if number == 0 else Polygon(), ())
        for number, space in enumerate(house.spaces)
    ]


def _start(grid: Grid, grounds: Sequence[Ground], outside: Outside | None) -> int | None:
    """Before the house; where no way leads in, the square from which most rooms are reached."""
    begin = None if outside is None else grid.nearest(0, outside.ring_m[0])
    if begin is not None and stops_of(grounds, grid, begin).stops:
        return begin
    return None


def _legs(
    start: int, stops: Sequence[Stop], grid: Grid, grounds: Sequence[Ground]
) -> list[Leg]:
    """From the start through all stops and back to it."""
    nodes = [start, *(stop.node for stop in stops)]
    costs = np.array([grid.costs(node, nodes) for node in nodes])
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
    pieces = []
    for run in np.split(np.array(squares), breaks):
        ground = grounds[grid.storey[run[0]]]
        flat = smoothed(grid.places_m[run], ground.free)
        pieces.append(np.column_stack([flat, np.full(len(flat), ground.elevation_m)]))
    return np.concatenate(pieces)


def _motions(
    legs: Sequence[Leg], outside: Outside | None, slab: Polygon, speed_m_s: float
) -> list[pace.Motion]:
    motions: list[pace.Motion] = []
    if outside is not None:
        height = np.full(len(outside.ring_m), legs[0].points_m[0, 2])
        ring = np.column_stack([outside.ring_m, height])
        centre = np.array(slab.centroid.coords[0])
        motions.append(pace.walk(ring, *gaze.around(ring, centre), speed_m_s))
    views = [gaze.walking(leg.points_m, _middle(leg.stop)) for leg in legs]
    for number, (leg, view) in enumerate(zip(legs, views, strict=True)):
        if len(leg.points_m) > 1:
            motions.append(pace.walk(leg.points_m, *view, speed_m_s))
        if leg.stop is not None and number + 1 < len(legs):
            here = leg.points_m[-1]
            yaws = gaze.turn(
                here[:2], leg.stop.shape, float(motions[-1].yaw[-1]), float(views[number + 1][0][0])
            )
            motions.append(pace.look(here, yaws, gaze.LEVEL_RAD))
    return motions


def _middle(stop: Stop | None) -> NDArray[np.float64] | None:
    return None if stop is None else np.array(stop.shape.centroid.coords[0])


def _stretches(timed: pace.Timed, grounds: Sequence[Ground]) -> tuple[Stretch, ...]:
    """When the visitor is in which room."""
    rooms = [_room_at(feet, grounds) for feet in timed.feet_m]
    found: list[Stretch] = []
    for room, title, time in (
        (*name, float(time)) for name, time in zip(rooms, timed.times_s, strict=True)
    ):
        if found and found[-1].room == room and found[-1].title == title:
            last = found.pop()
            found.append(Stretch(room, title, last.start_s, time))
        else:
            if found:
                last = found.pop()
                found.append(Stretch(last.room, last.title, last.start_s, time))
            found.append(Stretch(room, title, time, time))
    return tuple(found)


def _room_at(feet: NDArray[np.float64], grounds: Sequence[Ground]) -> tuple[str | None, str]:
    ground = min(grounds, key=lambda one: abs(one.elevation_m - feet[2]))
    room = ground.space.room_at(feet[:2])
    return (None, OUTSIDE) if room is None else (room.id, title_of(room))
