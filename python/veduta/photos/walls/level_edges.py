"""Which way a wall goes, by its own level edges: courses, sills, heads of windows, balconies.

Points on reliefs and balconies, unevenly spread, turn the line through them by degrees. The plane
through a camera and a level edge holds the edge's direction, which is the wall's own: most edges
on a wall agree on it to a fraction of a degree, however far they stand out of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.segments import Segments
from veduta.photos.cameras.vertical_edges import SegmentsOf, looked_at, rays_of
from veduta.photos.structure import Structure
from veduta.photos.walls.ends import with_closed_corners, without_overshoot
from veduta.photos.walls.find_walls import CORNER
from veduta.photos.walls.point_quality import typical_reach
from veduta.photos.walls.wall import Wall

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LevelEdges:
    """When edges turn a wall.

    slope: of an edge on the wall, at most, to be taken for a level one. most_rad: how far a wall is
    turned at most. agree_rad: edges that agree lie within this of their middle. share: of the
    weight of all within most_rad, that must agree. fewest: edges that agree. flat_rad: a wall whose
    points lie nearer to its plane than this part of its width goes the way that they say. most_off:
    a wall is not turned where its points would lie so many times as far off.
    """

    slope: float = 0.2
    most_rad: float = float(np.deg2rad(6.0))
    agree_rad: float = float(np.deg2rad(0.5))
    share: float = 0.4
    fewest: int = 20
    flat_rad: float = 0.006
    most_off: float = 1.5


LEVEL_EDGES = LevelEdges()


def turned_to_edges(
    walls: Sequence[Wall],
    structure: Structure,
    segments_of: SegmentsOf,
    rule: LevelEdges = LEVEL_EDGES,
) -> tuple[Wall, ...]:
    """The walls, each turned about its middle to go as its level edges do, and their corners closed
    again.
    """
    unsure = [wall for wall in walls if wall.rms > rule.flat_rad * wall.width]
    if not unsure:
        return tuple(walls)
    seen = [_seen(structure, row, segments_of(row)) for row in looked_at(structure)]
    angles = {wall.id: _turns(wall, seen, rule) for wall in unsure}
    found = []
    for wall in walls:
        angle = angles.get(wall.id, 0.0)
        turned = _turned(wall, angle, structure.points) if angle else wall
        found.append(turned if turned.rms <= rule.most_off * wall.rms else wall)
    if all(now is before for now, before in zip(found, walls, strict=True)):
        return tuple(walls)
    reach = CORNER * typical_reach(structure)
    return tuple(without_overshoot(with_closed_corners(found, reach), reach))


@dataclass(frozen=True, eq=False)
class _Seen:
    """The edges of a photo. eye: (3,). first, last: (n, 3) unit rays to their ends."""

    eye: Floats
    first: Floats
    last: Floats


def _seen(structure: Structure, row: int, segments: Segments) -> _Seen:
    first, last = (rays_of(structure, row, end) for end in (segments.start, segments.end))
    return _Seen(structure.centres()[row], first, last)


def _turns(wall: Wall, seen: Sequence[_Seen], rule: LevelEdges) -> float:
    """How far a wall is to be turned, counter-clockwise from above (rad); 0: nothing tells."""
    found = [*_edges(wall, seen, rule)]
    angles = np.concatenate([np.zeros(0), *(one for one, _ in found)])
    weights = np.concatenate([np.zeros(0), *(one for _, one in found)])
    near = np.abs(angles) <= rule.most_rad
    angles, weights = angles[near], weights[near]
    if len(angles) < rule.fewest:
        return 0.0
    order = np.argsort(angles)
    angles, total = angles[order], np.concatenate([[0.0], np.cumsum(weights[order])])
    ends = np.searchsorted(angles, angles + 2.0 * rule.agree_rad, side="right")
    firsts = np.arange(len(angles))
    best = int(np.argmax(total[ends] - total[firsts]))
    first, end = best, int(ends[best])
    if end - first < rule.fewest or total[end] - total[first] < rule.share * total[-1]:
        return 0.0
    half = (total[first] + total[end]) / 2.0
    return float(angles[np.clip(np.searchsorted(total, half) - 1, first, end - 1)])


def _edges(wall: Wall, seen: Sequence[_Seen], rule: LevelEdges) -> Iterator[tuple[Floats, Floats]]:
    """Of each photo: the turns (rad) that level edges on the wall ask for, and their weights."""
    outward, along = np.append(wall.outward, 0.0), np.append(wall.along, 0.0)
    aside = np.array([-wall.along[1], wall.along[0], 0.0])
    foot = np.append(wall.start, 0.0)
    for photo in seen:
        before = float((photo.eye - foot) @ outward)
        if before <= 0.0:
            continue
        # Where both ends of each edge would be on the wall: along it, and up. NaN beside it.
        places = []
        for ray in (photo.first, photo.last):
            into = -(ray @ outward)
            place = photo.eye + (before / np.where(into > 1e-6, into, np.nan))[:, None] * ray
            places.append(np.column_stack([(place - foot) @ along, place[:, 2]]))
        low, high = np.array([0.0, wall.bottom]), np.array([wall.width, wall.top])
        on = np.logical_and.reduce([((one > low) & (one < high)).all(axis=1) for one in places])
        across, up = np.abs(places[1] - places[0]).T
        on &= up < rule.slope * across
        normal = np.cross(photo.first[on], photo.last[on])
        span = np.linalg.norm(normal, axis=1)
        normal /= np.maximum(span, 1e-12)[:, None]
        # The direction in the horizontal plane that the edge's plane holds; at the eye's own
        # height that plane is level, and holds all.
        told = np.hypot(normal[:, 0], normal[:, 1])
        angle = np.arctan2(-(normal @ along), normal @ aside)
        angle = (angle + np.pi / 2) % np.pi - np.pi / 2
        yield angle, told * np.minimum(span, 0.1)


def _turned(wall: Wall, angle_rad: float, points: Floats) -> Wall:
    """A wall turned about its middle, half of its points before it."""
    middle = (wall.start + wall.end) / 2.0
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    along = np.array([c * wall.along[0] - s * wall.along[1], s * wall.along[0] + c * wall.along[1]])
    outward = np.array([along[1], -along[0]])
    off = (points[wall.point_rows, :2] - middle) @ outward
    middle = middle + np.median(off) * outward
    half = wall.width / 2.0 * along
    rms = float(np.sqrt(np.mean((off - np.median(off)) ** 2)))
    return replace(wall, start=middle - half, end=middle + half, rms=rms)
