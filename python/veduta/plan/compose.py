"""From pixels to metres: what was drawn becomes a storey of the document."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import (
    Fitting,
    Junction,
    Opening,
    Origin,
    Point,
    Room,
    RoomUse,
    Scale,
    Sheet,
    Stairs,
    Storey,
    Text,
    Wall,
)
from veduta.plan.drawn import Drawn, DrawnFitting, DrawnOpening, DrawnRoom
from veduta.plan.names.voids import names_void

STOREY_HEIGHT_M = 2.7
DOOR_HEIGHT_M = 2.05
GARAGE_HEIGHT_M = 2.2
WINDOW_SILL_M = 0.9
WINDOW_HEIGHT_M = 1.2


@dataclass(frozen=True)
class Named:
    """What a room is for, how sure that is, how it is known, and its name on the plan."""

    use: RoomUse
    score: float
    name: str = ""
    origin: Origin = "inferred"


def compose_storey(
    drawn: Drawn,
    scale: Scale,
    texts: Sequence[Text] | None = None,
    *,
    file: str,
    sha256: str,
    page: int = 0,
    name: str = "Ground floor",
    elevation_m: float = 0.0,
    height_m: float = STOREY_HEIGHT_M,
    named: Mapping[str, Named] | None = None,
    notes: Sequence[str] = (),
) -> Storey:
    """The storey in metres; `scale.metres_per_px` is of the cleaned image, as all of `drawn` is.

    The plan frame begins at the lower left corner of the walls' junctions. `named` has the uses of
    rooms by their ids; other rooms are of unknown use. Heights are on no plan: `height_m`, sills
    and lintels are usual values.
    """
    frame = _Frame(drawn, scale.metres_per_px)
    width_px, height_px = drawn.size_px
    cleaned = drawn.cleaned
    return Storey(
        name=name,
        elevation_m=elevation_m,
        height_m=height_m,
        sheet=Sheet(
            file=file,
            sha256=sha256,
            page=page,
            width_px=width_px,
            height_px=height_px,
            mirrored=cleaned.mirrored,
            rotation_rad=cleaned.rotation_rad,
            clean_from_scan=[[float(value) for value in row] for row in cleaned.clean_from_scan],
            origin_px=(float(frame.origin[0]), float(frame.origin[1])),
            metres_per_px=scale.metres_per_px,
        ),
        scale=scale,
        junctions=[
            Junction(id=one.id, at_m=frame.point(one.at_px), type=one.type)
            for one in drawn.junctions
        ],
        walls=[
            Wall(
                id=one.id,
                start=one.start,
                end=one.end,
                bulge=one.bulge,
                thickness_m=frame.length(one.thickness_px),
                drawing=one.drawing,
                outer=one.outer,
                score=one.score,
                origin=one.origin,
            )
            for one in drawn.walls
        ],
        openings=[_opening(one, frame) for one in drawn.openings],
        rooms=[_room(one, frame, (named or {}).get(one.id)) for one in drawn.rooms],
        stairs=[
            Stairs(
                id=one.id,
                outline_m=frame.ring(one.outline_px),
                treads=one.treads,
                up=(one.up_px[0], -one.up_px[1]),
                score=one.score,
                steps_m=[frame.ring(step) for step in one.steps_px],
                path_m=[] if one.path_px is None else frame.ring(one.path_px),
            )
            for one in drawn.stairs
        ],
        fittings=[_fitting(one, frame) for one in drawn.fittings],
        texts=list(drawn.texts if texts is None else texts),
        notes=[*drawn.notes, *notes],
    )


class _Frame:
    """Cleaned pixels to metres of the plan frame: y turns over."""

    def __init__(self, drawn: Drawn, metres_per_px: float) -> None:
        points = np.array([one.at_px for one in drawn.junctions] or [(0.0, 0.0)])
        self.origin = np.array([points[:, 0].min(), points[:, 1].max()])
        self.metres_per_px = metres_per_px

    def point(self, at: Sequence[float] | NDArray[np.float64]) -> Point:
        x, y = (np.asarray(at) - self.origin) * self.metres_per_px
        return round(float(x), 5), round(float(-y), 5)

    def ring(self, points: NDArray[np.float64]) -> list[Point]:
        return [self.point(one) for one in points]

    def length(self, px: float) -> float:
        return round(px * self.metres_per_px, 5)


def _fitting(one: DrawnFitting, frame: _Frame) -> Fitting:
    # Its front, in the plan frame: y turns over.
    x, y = -float(one.back[0]), float(one.back[1])
    return Fitting(
        id=one.id,
        kind=one.kind,
        room=one.room,
        at_m=frame.point(one.middle_px),
        turn_rad=round(math.atan2(x, -y), 5),
        size_m=(frame.length(one.width_px), frame.length(one.depth_px)),
        score=one.score,
    )


def _opening(one: DrawnOpening, frame: _Frame) -> Opening:
    sill, height = 0.0, GARAGE_HEIGHT_M if one.type == "garage" else DOOR_HEIGHT_M
    if one.kind == "window":
        sill, height = WINDOW_SILL_M, WINDOW_HEIGHT_M
    return Opening(
        id=one.id,
        wall=one.wall,
        kind=one.kind,
        type=one.type,
        along_m=frame.length(one.along_px),
        width_m=frame.length(one.width_px),
        sill_m=sill,
        height_m=height,
        hinge=one.hinge,
        swing=one.swing,
        score=one.score,
        origin=one.origin,
    )


def _room(one: DrawnRoom, frame: _Frame, named: Named | None) -> Room:
    known = named or Named("unknown", 0.0)
    return Room(
        id=one.id,
        outline_m=frame.ring(one.outline_px),
        holes_m=[frame.ring(hole) for hole in one.holes_px],
        area_m2=round(one.area_px2 * frame.metres_per_px**2, 4),
        use=known.use,
        use_score=known.score,
        use_origin=known.origin,
        name=known.name,
        outdoors=one.outdoors,
        open_below=names_void(known.name),
        walls=list(one.walls),
        openings=list(one.openings),
        mended=one.mended,
        score=one.score,
    )
