"""Doors and gaps: a way from the entrance to every room, and a few more."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import DoorType, Hinge, Opening, OpeningKind, Swing, Use, Wall

CLEAR_M = 0.24
THROUGH_COST: Mapping[Use, float] = {
    "corridor": 0.0, "hall": 0.0, "stairs": 6.0, "living": 1.0, "dining": 2.0, "kitchen": 3.0,
    "study": 8.0, "bedroom": 8.0, "utility": 9.0, "storage": 20.0, "wardrobe": 20.0,
    "bathroom": 12.0, "toilet": 30.0, "sauna": 30.0, "garage": 12.0,
}  # fmt: skip
"""What it costs to reach a room through another of this use: few people cross a bathroom."""

LANDINGS: frozenset[Use] = frozenset({"hall", "corridor", "living"})
"""Where stairs may begin and end without a detour."""

WIDTHS: Mapping[DoorType, tuple[float, float]] = {
    "swing": (0.7, 0.95), "double": (1.3, 1.8), "sliding": (0.8, 1.6), "pocket": (0.7, 0.95),
    "folding": (0.8, 1.6), "french": (1.3, 1.9), "garage": (2.4, 2.9), "plain": (0.85, 1.6),
}  # fmt: skip
LEAST_ENTRANCE_M = 0.95
ENTRANCES: tuple[Use, ...] = ("hall", "corridor", "living", "kitchen")


def straight_room(wall: Wall) -> tuple[float, float]:
    """Between which places along the wall an opening may be, in metres; its ends keep clear."""
    return CLEAR_M, curves.wall_length(wall) - CLEAR_M


def way_to_all(
    walls: Sequence[Wall], uses: Mapping[str, Use], root: str
) -> list[tuple[str, Wall]] | None:
    """For each room but the root the wall through which it is entered; None if one is cut off.

    Dijkstra's shortest ways from the root, where passing a room costs by its use.
    """
    links: dict[str, list[tuple[str, Wall]]] = {name: [] for name in uses}
    for wall in walls:
        low, high = straight_room(wall)
        if wall.left and wall.right and wall.bulge == 0.0 and high - low >= 0.75:
            links[wall.left].append((wall.right, wall))
            links[wall.right].append((wall.left, wall))
    queue: list[tuple[float, str, int]] = [(0.0, root, -1)]
    entered: dict[str, Wall | None] = {}
    while queue:
        cost, name, index = heapq.heappop(queue)
        if name in entered:
            continue
        entered[name] = walls[index] if index >= 0 else None
        onward = cost + 0.5 + THROUGH_COST[uses[name]]
        for other, wall in links[name]:
            if other not in entered:
                length = curves.wall_length(wall)
                pair = {uses[name], uses[other]}
                odd = 15.0 if "stairs" in pair and not pair & LANDINGS else 0.0
                heapq.heappush(queue, (onward + odd + 0.3 / length, other, walls.index(wall)))
    if len(entered) < len(uses):
        return None
    return [(name, wall) for name, wall in entered.items() if wall is not None]


def inner_type(rng: np.random.Generator, first: Use, second: Use) -> DoorType:
    """A door's type by what it parts."""
    pair = {first, second}
    if "stairs" in pair:
        return "plain" if rng.random() < 0.7 else "swing"
    if "wardrobe" in pair:
        return _pick(rng, {"folding": 0.4, "sliding": 0.4, "swing": 0.2})
    if pair & {"bathroom", "toilet", "utility", "storage", "sauna"}:
        return _pick(rng, {"swing": 0.85, "pocket": 0.1, "sliding": 0.05})
    if pair <= {"living", "dining", "kitchen", "hall", "corridor"}:
        return _pick(
            rng, {"swing": 0.3, "plain": 0.36, "double": 0.12, "sliding": 0.1, "french": 0.12}
        )
    return _pick(rng, {"swing": 0.9, "sliding": 0.05, "pocket": 0.05})


def _pick(rng: np.random.Generator, weights: Mapping[DoorType, float]) -> DoorType:
    names = list(weights)
    return names[int(rng.choice(len(names), p=np.array(list(weights.values()))))]


def place_door(
    rng: np.random.Generator, wall: Wall, kind: DoorType, into: str | None, number: int
) -> Opening | None:
    """A door of this type somewhere in the wall, or None where it does not fit.

    Most doors stand near an end of their wall, as in houses. `into` is the room to which it swings.
    """
    low, high = straight_room(wall)
    least, most = WIDTHS[kind]
    if kind == "pocket":
        most = min(most, (high - low) / 2)  # the leaf slides into the wall beside it
    most = min(most, high - low)
    if most < least:
        return None
    width = round(rng.uniform(least, most), 2)
    free = high - low - width
    pocket_room = width if kind == "pocket" else 0.0
    share = rng.beta(0.35, 0.35)
    hinge: Hinge = "start" if share < 0.5 else "end"
    if kind in ("double", "french"):
        hinge = "both"
    elif kind in ("sliding", "plain", "garage"):
        hinge = "none"
    elif kind == "pocket":
        share = (pocket_room + share * (free - pocket_room)) / max(free, 1e-9)
        hinge = "start"
    swing: Swing = "none"
    if kind in ("swing", "double", "french", "folding"):
        swing = "left" if into is not None and wall.left == into else "right"
    what: OpeningKind = "gap" if kind == "plain" else "door"
    along = round(low + share * free, 3)
    return Opening(f"d{number}", wall.id, what, kind, along, width, hinge, swing)


def entrance_wall(rng: np.random.Generator, walls: Sequence[Wall], room: str) -> Wall | None:
    """A straight outer wall of the room, long enough for a front door."""
    fitting = [
        wall
        for wall in walls
        if wall.outer and room in (wall.left, wall.right) and wall.bulge == 0.0
        and straight_room(wall)[1] - straight_room(wall)[0] > LEAST_ENTRANCE_M
    ]  # fmt: skip
    return fitting[int(rng.integers(len(fitting)))] if fitting else None


def entrance(
    rng: np.random.Generator, walls: Sequence[Wall], uses: Mapping[str, Use]
) -> tuple[str, Wall] | None:
    """The room into which one comes from outside, and the wall of the front door."""
    for use in ENTRANCES:
        for name in [name for name, of in uses.items() if of == use]:
            wall = entrance_wall(rng, walls, name)
            if wall is not None:
                return name, wall
    return None
