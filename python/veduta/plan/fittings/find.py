"""The fittings of a drawing: what its rooms' cells are symbols of, with their backs to walls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point, Polygon

from veduta.plan.clean import ink as inks
from veduta.plan.document import FittingKind, RoomUse
from veduta.plan.drawn import Drawn, DrawnFitting, DrawnRoom
from veduta.plan.fittings.cells import cells_of
from veduta.plan.fittings.symbols import BOWL, Symbol, symbols_in

BY_WALL_M = 0.25
"""Fittings stand this near to a wall with their backs; a bed need not."""
STANDS_FREE: frozenset[FittingKind] = frozenset({"bed"})
TANK_M, BOWL_M = (0.08, 0.36), 0.3
"""So far from the wall is the bowl of a toilet whose tank is not seen, and so wide at least."""
CLEAR_M = 0.15
"""A wall is the one behind an oval if all at its sides are so much farther."""
AT_WALL_M = 0.12
"""So near to a wall an oval is a basin even in a corner."""
SINK_M = 0.35
"""Sinks stand this far off the wall in their worktops."""
FAR_PX = 1e5
OUTSIDE = 0.25
"""No more of a thing lies outside of its room: lines of walls are a little off."""


@dataclass(frozen=True)
class _Placed:
    """A symbol with its back known."""

    kind: FittingKind
    symbol: Symbol
    middle_px: NDArray[np.float64]
    back: NDArray[np.float64]
    shape: Polygon
    width_px: float
    depth_px: float


WET: frozenset[FittingKind] = frozenset({"toilet", "bathtub", "shower"})


WHERE: dict[FittingKind, frozenset[RoomUse]] = {
    "toilet": frozenset({"bathroom", "toilet", "utility"}),
    "basin": frozenset({"bathroom", "toilet", "utility", "sauna"}),
    "bathtub": frozenset({"bathroom", "utility", "sauna"}),
    "shower": frozenset({"bathroom", "toilet", "utility", "sauna"}),
    "washer": frozenset({"bathroom", "toilet", "utility", "kitchen", "technical", "storage"}),
    "hob": frozenset({"kitchen", "living", "dining"}),
    "kitchen-sink": frozenset({"kitchen", "living", "dining", "utility"}),
    "bed": frozenset({"bedroom", "living", "study", "other"}),
}
"""Rooms in which they stand: in one whose name says that it is another, it was no such symbol."""


def fitting_rooms(
    fittings: Iterable[DrawnFitting], written: Mapping[str, RoomUse]
) -> tuple[DrawnFitting, ...]:
    """Those that go with the written names of their rooms; written: uses by ids of rooms."""
    kept = [one for one in fittings if written.get(one.room) in (None, *WHERE[one.kind])]
    return tuple(replace(one, id=f"t{number}") for number, one in enumerate(kept, 1))


def find_fittings(drawn: Drawn, metres_per_px: float) -> tuple[DrawnFitting, ...]:
    """All fittings in the rooms of a drawing, in the order of the rooms, the surest first."""
    mask = inks.marks(drawn.cleaned.ink, drawn.cleaned.line_px)
    found: list[DrawnFitting] = []
    for room in drawn.rooms:
        if room.outdoors:
            continue
        cells = cells_of(room.polygon(), mask, drawn.cleaned.line_px, metres_per_px)
        chosen = _chosen(room, symbols_in(cells, metres_per_px), metres_per_px)
        cooks = _cooks(chosen)
        for one in chosen:
            found.append(
                DrawnFitting(
                    id=f"t{len(found) + 1}",
                    # Who cooks there washes up.
                    kind="kitchen-sink" if cooks and one.kind == "basin" else one.kind,
                    room=room.id,
                    middle_px=one.middle_px,
                    back=one.back,
                    width_px=one.width_px,
                    depth_px=one.depth_px,
                    score=one.symbol.score,
                )
            )
    return tuple(found)


def _cooks(placed: Iterable[_Placed]) -> bool:
    """Whether these are the things of a kitchen."""
    kinds = {one.kind for one in placed}
    return "hob" in kinds and not kinds & WET


def _chosen(room: DrawnRoom, symbols: Sequence[Symbol], metres_per_px: float) -> list[_Placed]:
    """The surest symbols that stand in the room, and in no other's place."""
    floor = room.polygon()
    taken: list[_Placed] = []
    used: set[int] = set()
    for symbol in symbols:
        if symbol.cells & used:
            continue
        placed = _placed(symbol, floor, metres_per_px, cooks=_cooks(taken))
        if placed is None or placed.shape.difference(floor).area > OUTSIDE * placed.shape.area:
            continue
        if any(
            one.shape.intersection(placed.shape).area > 0.2 * placed.shape.area for one in taken
        ):
            continue
        taken.append(placed)
        used |= symbol.cells
    return taken


def _placed(symbol: Symbol, floor: Polygon, metres_per_px: float, *, cooks: bool) -> _Placed | None:
    """With its back to a wall, as its kind and its symbol say; None where it is not."""
    if symbol.score <= BOWL:
        return _bowl(symbol, floor, metres_per_px, cooks=cooks)
    given = symbol.back
    side = np.array([-given[1], given[0]])
    deep, wide = symbol.depth_m, symbol.width_m
    ways = [(given, wide, deep), (-given, wide, deep)]
    if symbol.kind == "toilet" or symbol.kind in STANDS_FREE:
        ways = ways[:1]
    elif symbol.width_m < 1.3 * symbol.depth_m:
        ways += [(side, deep, wide), (-side, deep, wide)]
    gaps = [
        _reach(floor, symbol.middle_px, back) * metres_per_px - depth / 2 for back, _, depth in ways
    ]
    nearest = int(np.argmin(gaps))
    if symbol.kind not in STANDS_FREE and gaps[nearest] > BY_WALL_M:
        return None
    back, width, depth = ways[nearest]
    return _made(symbol.kind, symbol, symbol.middle_px, back, (width, depth), metres_per_px)


def _bowl(symbol: Symbol, floor: Polygon, metres_per_px: float, *, cooks: bool) -> _Placed | None:
    """Of an oval alone: it lies along the nearest wall, or stands off it with a tank between."""
    across = symbol.back
    along = np.array([-across[1], across[0]])
    ways = [across, -across, along, -along]
    halves = [symbol.depth_m / 2] * 2 + [symbol.width_m / 2] * 2
    gaps = [
        _reach(floor, symbol.middle_px, back) * metres_per_px - half
        for back, half in zip(ways, halves, strict=True)
    ]
    nearest = int(np.argmin(gaps))
    back, gap = ways[nearest], max(gaps[nearest], 0.0)
    # In a corner nobody can tell, but where one cooks.
    clear = min(gaps[2:] if nearest < 2 else gaps[:2]) > gap + CLEAR_M
    along_wall = nearest < 2 and gap < (BY_WALL_M if clear else AT_WALL_M)
    if along_wall or cooks:
        size = (symbol.width_m, symbol.depth_m) if nearest < 2 else (symbol.depth_m, symbol.width_m)
        return (
            _made("basin", symbol, symbol.middle_px, back, size, metres_per_px)
            if gap < SINK_M
            else None
        )
    if nearest < 2 or not clear or not TANK_M[0] <= gap <= TANK_M[1] or symbol.depth_m < BOWL_M:
        return None
    middle = symbol.middle_px + back * gap / 2 / metres_per_px
    return _made(
        "toilet", symbol, middle, back, (symbol.depth_m, symbol.width_m + gap), metres_per_px
    )


def _reach(floor: Polygon, start: NDArray[np.float64], way: NDArray[np.float64]) -> float:
    """How far it is from a point to the wall (px); infinite from outside of the room."""
    ray = LineString([start, start + FAR_PX * way])
    met = floor.exterior.intersection(ray)
    return float("inf") if met.is_empty else float(met.distance(Point(start)))


def _made(
    kind: FittingKind,
    symbol: Symbol,
    middle: NDArray[np.float64],
    back: NDArray[np.float64],
    size_m: tuple[float, float],
    metres_per_px: float,
) -> _Placed:
    across = np.array([-back[1], back[0]])
    wide, deep = (one / metres_per_px for one in size_m)
    corners = [
        middle + u * wide / 2 * across + v * deep / 2 * back
        for u, v in ((-1, 1), (1, 1), (1, -1), (-1, -1))
    ]
    return _Placed(kind, symbol, middle, back, Polygon(corners), wide, deep)
