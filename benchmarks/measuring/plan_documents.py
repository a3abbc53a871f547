"""The truth of a synthetic house as a plan document, as if it had been read without a fault."""

from __future__ import annotations

import numpy as np

from veduta.plan.document import (
    Junction,
    Opening,
    PlanDocument,
    Room,
    Scale,
    Sheet,
    Stairs,
    Storey,
    Wall,
)
from veduta.synthetic.plans import house as true

STOREY_M = 2.8
PIXEL_M = 0.01
_DOOR_M, _GARAGE_M, _SILL_M, _WINDOW_M = 2.05, 2.2, 0.9, 1.25
_GRID_M = 1e-3


def document_of(house: true.House) -> PlanDocument:
    """All storeys of a house."""
    return PlanDocument(storeys=[storey_of(storey) for storey in house.storeys])


def storey_of(storey: true.Storey) -> Storey:
    """One storey; walls that end in the same place meet in a junction."""
    ids: dict[tuple[int, int], str] = {}
    at: dict[str, true.Point] = {}

    def junction(point: true.Point) -> str:
        key = (round(point[0] / _GRID_M), round(point[1] / _GRID_M))
        name = ids.setdefault(key, f"j{len(ids)}")
        at.setdefault(name, point)
        return name

    walls = [
        Wall(
            id=wall.id, start=junction(wall.start_m), end=junction(wall.end_m), bulge=wall.bulge,
            thickness_m=wall.thickness_m, drawing="filled", outer=wall.outer, score=1.0,
        )
        for wall in storey.walls
    ]  # fmt: skip
    points = np.array(list(at.values()))
    low, high = points.min(axis=0), points.max(axis=0)
    width, height = ((high - low) / PIXEL_M + 200.0).round().astype(int).tolist()
    sides = {wall.id: (wall.left, wall.right) for wall in storey.walls}
    return Storey(
        name=("Ground floor", "First floor", "Second floor")[storey.number],
        elevation_m=storey.number * STOREY_M,
        height_m=STOREY_M,
        sheet=Sheet(
            file="plan.png", sha256="0" * 64, width_px=width, height_px=height,
            clean_from_scan=np.eye(3).tolist(), metres_per_px=PIXEL_M,
            origin_px=(100.0 - low[0] / PIXEL_M, 100.0 + high[1] / PIXEL_M),
        ),
        scale=Scale(metres_per_px=PIXEL_M, sigma=0.0, basis="given"),
        junctions=[Junction(id=name, at_m=point, type="L") for name, point in at.items()],
        walls=walls,
        openings=[_opening(one) for one in storey.openings],
        rooms=[
            Room(
                id=room.id, outline_m=list(room.outline_m), area_m2=room.area_m2, use=room.use,
                use_score=1.0, score=1.0,
                openings=[one.id for one in storey.openings if room.id in sides[one.wall]],
            )
            for room in storey.rooms
        ],
        stairs=[
            Stairs(
                id=f"s{number}", outline_m=list(flight.outline_m), treads=flight.treads,
                up=flight.up, score=1.0, steps_m=[list(ring) for ring in flight.steps_m],
                path_m=list(flight.path_m),
            )
            for number, flight in enumerate(storey.stairs)
        ],
    )  # fmt: skip


def _opening(one: true.Opening) -> Opening:
    is_window = one.kind == "window"
    height = _WINDOW_M if is_window else _GARAGE_M if one.type == "garage" else _DOOR_M
    return Opening(
        id=one.id, wall=one.wall, kind=one.kind, type=one.type, along_m=one.along_m,
        width_m=one.width_m, sill_m=_SILL_M if is_window else 0.0, height_m=height,
        hinge=one.hinge, swing=one.swing, score=1.0,
    )  # fmt: skip
