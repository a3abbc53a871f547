"""Synthetic houses as plan documents: what a perfect reading of their drawings would give."""

from __future__ import annotations

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
from veduta.synthetic.plans.house import House
from veduta.synthetic.plans.house import Storey as TrueStorey

HEIGHT_M = 2.8
SILL_M, WINDOW_M, DOOR_M = 0.9, 1.25, 2.05
_PX_M = 0.01


def document_of(house: House) -> PlanDocument:
    """The house with usual heights; scores are 1."""
    return PlanDocument(storeys=[_storey(storey) for storey in house.storeys])


def _storey(storey: TrueStorey) -> Storey:
    number: dict[tuple[float, float], str] = {}
    for wall in storey.walls:
        for end in (wall.start_m, wall.end_m):
            number.setdefault(end, f"j{len(number) + 1}")
    walls = [
        Wall(
            id=wall.id, start=number[wall.start_m], end=number[wall.end_m], bulge=wall.bulge,
            thickness_m=wall.thickness_m, drawing="filled", outer=wall.outer, score=1.0,
        )
        for wall in storey.walls
    ]  # fmt: skip
    openings = [
        Opening(
            id=one.id, wall=one.wall, kind=one.kind, type=one.type, along_m=one.along_m,
            width_m=one.width_m, hinge=one.hinge, swing=one.swing, score=1.0,
            sill_m=SILL_M if one.kind == "window" else 0.0,
            height_m=WINDOW_M if one.kind == "window" else DOOR_M,
        )
        for one in storey.openings
    ]  # fmt: skip
    rooms = [
        Room(
            id=room.id, outline_m=list(room.outline_m), area_m2=room.area_m2, use=room.use,
            use_score=1.0, score=1.0,
        )
        for room in storey.rooms
    ]  # fmt: skip
    return Storey(
        name=f"storey {storey.number + 1}",
        elevation_m=HEIGHT_M * storey.number,
        height_m=HEIGHT_M,
        sheet=_sheet(),
        scale=Scale(metres_per_px=_PX_M, sigma=0.001, basis="evidence"),
        junctions=[Junction(id=name, at_m=at, type="X") for at, name in number.items()],
        walls=walls,
        openings=openings,
        rooms=rooms,
        stairs=[
            Stairs(
                id=f"s{k + 1}", outline_m=list(one.outline_m), treads=one.treads, up=one.up,
                score=1.0,
            )
            for k, one in enumerate(storey.stairs)
        ],
    )  # fmt: skip


def _sheet() -> Sheet:
    return Sheet(
        file="synthetic.png", sha256="0" * 64, width_px=3000, height_px=3000,
        clean_from_scan=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        origin_px=(100.0, 2900.0), metres_per_px=_PX_M,
    )  # fmt: skip
