"""Found walls against those of a simulated street: what is matched, and how far it lies off.

A facade counts as visible where three photos see a stretch of it wider than 4 m, from the first to
the last place seen; an end may be found anywhere between there and the facade's own end. Facades
that lie in one plane end to end are one here: no point tells them apart. Errors hold all that the
structure has, the drift of its poses too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.wall import Wall
from veduta.photos.world.absolute_orientation import absolute_orientation
from veduta.synthetic.streets.simulated import SimulatedStructure
from veduta.synthetic.streets.walls import TrueWall

WIDEST_HIDDEN_M = 4.0
OFFSET_M, ANGLE_DEG, EDGE_M = 0.1, 1.0, 0.3
_SAME_PLANE_M, _SAME_ANGLE_DEG, _END_TO_END_M = 0.05, 0.5, 0.3
_NEAR_M = 1.0


@dataclass(frozen=True)
class Facade:
    """A visible stretch. start, end: (2,) m. before, after: how far the facade goes on beyond it,
    less well seen (m). bottom, top: m.
    """

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    before: float
    after: float
    bottom: float
    top: float

    @property
    def along(self) -> NDArray[np.float64]:
        """(2,) unit."""
        way = self.end - self.start
        return np.asarray(way / np.linalg.norm(way))

    @property
    def outward(self) -> NDArray[np.float64]:
        """(2,) unit."""
        x, y = self.along
        return np.array([y, -x])

    @property
    def width(self) -> float:
        """m."""
        return float(np.linalg.norm(self.end - self.start))


@dataclass(frozen=True)
class Errors:
    """Of the wall that covers most of a facade. All m, but angle_deg; offset_m is the larger one of
    both ends. edges_m: at the left and right; 0 between the last place well seen and the facade's
    own end.
    """

    offset_m: float
    angle_deg: float
    edges_m: tuple[float, float]
    top_m: float
    bottom_m: float

    @property
    def plane_is_right(self) -> bool:
        """Whether plane and angle are within the bounds."""
        return self.offset_m <= OFFSET_M and self.angle_deg <= ANGLE_DEG

    @property
    def height_is_right(self) -> bool:
        """Whether bottom and top are within the bound of edges."""
        return max(self.bottom_m, self.top_m) <= EDGE_M

    @property
    def is_right(self) -> bool:
        """Whether its plane, its angle and all edges along it are."""
        return self.plane_is_right and max(self.edges_m) <= EDGE_M


def visible_facades(walls: Sequence[TrueWall]) -> list[Facade]:
    """The visible stretches, those in one plane joined."""
    found: list[Facade] = []
    for wall in walls:
        if wall.seen_to_m - wall.seen_from_m <= 0.0:
            continue
        way = (wall.end_m - wall.start_m) / wall.width_m
        facade = Facade(
            wall.start_m + wall.seen_from_m * way,
            wall.start_m + wall.seen_to_m * way,
            wall.seen_from_m,
            wall.width_m - wall.seen_to_m,
            wall.bottom_m,
            wall.top_m,
        )
        other = next((item for item in found if _one_plane(item, facade)), None)
        if other is not None:
            found = [item for item in found if item is not other]
            facade = _joined(other, facade)
        found.append(facade)
    return [facade for facade in found if facade.width > WIDEST_HIDDEN_M]


def _one_plane(one: Facade, two: Facade) -> bool:
    angle = np.rad2deg(np.arccos(np.clip(one.outward @ two.outward, -1.0, 1.0)))
    off = np.abs(np.stack([two.start, two.end]) @ one.outward - one.start @ one.outward).max()
    gap = min(np.linalg.norm(one.end - two.start), np.linalg.norm(two.end - one.start))
    return bool(angle < _SAME_ANGLE_DEG and off < _SAME_PLANE_M and gap < _END_TO_END_M)


def _joined(one: Facade, two: Facade) -> Facade:
    first, last = (one, two) if (two.start - one.start) @ one.along > 0.0 else (two, one)
    return Facade(
        first.start,
        last.end,
        first.before,
        last.after,
        min(one.bottom, two.bottom),
        max(one.top, two.top),
    )


def in_world(wall: Wall, simulated: SimulatedStructure) -> Wall:
    """A wall of the simulated structure's own frame, in the world (nearly upright frames only)."""
    scale, turn, shift = simulated.world_from_model
    middle = 0.5 * (wall.bottom + wall.top)
    ends = np.stack([np.append(wall.start, middle), np.append(wall.end, middle)])
    ends = scale * ends @ turn.T + shift
    half = 0.5 * scale * wall.height
    height = float(ends[:, 2].mean())
    return Wall(
        wall.id, ends[0, :2], ends[1, :2], height - half, height + half,
        wall.point_rows, scale * wall.rms,
    )  # fmt: skip


def errors_of(facade: Facade, walls: Sequence[Wall]) -> Errors | None:
    """Of the wall that covers most of a facade; None where none does."""
    best: tuple[float, Wall] | None = None
    for wall in walls:
        ends = np.stack([wall.start, wall.end]) - facade.start
        middle = ends.mean(axis=0) @ facade.outward
        if wall.outward @ facade.outward < np.cos(np.deg2rad(10.0)) or abs(middle) > _NEAR_M:
            continue
        low, high = np.sort(ends @ facade.along)
        overlap = min(high, facade.width) - max(low, 0.0)
        if overlap > 0.25 * facade.width and (best is None or overlap > best[0]):
            best = (float(overlap), wall)
    return None if best is None else _errors(facade, best[1])


def _errors(facade: Facade, wall: Wall) -> Errors:
    ends = np.stack([facade.start, facade.end]) - wall.start
    off = np.abs(ends @ wall.outward)
    low, high = (float(value) for value in ends @ wall.along)
    # How far the found ends lie outside of the facade and inside of what is seen of it.
    left = max(low - facade.before, -low, 0.0)
    right = max(wall.width - high - facade.after, high - wall.width, 0.0)
    angle = np.arccos(np.clip(wall.outward @ facade.outward, -1.0, 1.0))
    return Errors(
        float(off.max()),
        float(np.rad2deg(angle)),
        (left, right),
        abs(wall.top - facade.top),
        abs(wall.bottom - facade.bottom),
    )


def is_false(wall: Wall, truths: Sequence[TrueWall]) -> bool:
    """Whether a wall lies on no wall of the street: more than 0.5 m or 5 degrees off all."""
    for truth in truths:
        ends = np.stack([wall.start, wall.end]) - truth.start_m
        if truth.outward @ wall.outward < np.cos(np.deg2rad(5.0)):
            continue
        if np.abs(ends @ truth.outward).max() > 0.5:
            continue
        low, high = np.sort(ends @ np.array([-truth.outward[1], truth.outward[0]]))
        if min(high, truth.width_m) - max(low, 0.0) > 0.5 * (high - low):
            return False
    return True


def world_from(points: NDArray[np.float64], simulated: SimulatedStructure) -> SimulatedStructure:
    """The simulated structure with the frame of (p, 3) points, which are its own moved."""
    own = absolute_orientation(points, simulated.points)
    scale, world_turn, shift = simulated.world_from_model
    moved = scale * world_turn @ own.shift + shift
    turned = world_turn @ own.rotation
    return replace(simulated, world_from_model=(scale * own.scale, turned, moved))
