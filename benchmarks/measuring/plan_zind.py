"""`plans/zind-000`: one house whose rooms, doors and windows are known as vectors."""

from __future__ import annotations

import json
import math
import statistics
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from plan_data import PLANS, picture
from plan_reading import read_plans
from plan_scores import iou, matched, opening_hits, room_hits
from plan_truth import Affine, Gap, Layout, Space, found_layout
from record import Row
from shapely.geometry import Polygon

FLOOR = "floor_01"
WALL_M = 0.12
SAME_DOOR_M = 0.35


def truth() -> tuple[Path, Affine, Layout]:
    """The drawing, its affine from metres to pixels, and what is on it.

    A door between two rooms is listed for both, on the face of the wall: the two become one on its
    centre line. The drawing's y runs down; the metres' runs up.
    """
    folder = PLANS / "zind-000"
    fields = json.loads((folder / "zind_data.json").read_text())
    to_redraw = fields["floorplan_to_redraw_transformation"][FLOOR]
    angle, scale = math.radians(to_redraw["rotation"]), float(to_redraw["scale"])
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    metres_per_px = scale * float(fields["scale_meters_per_coordinate"][FLOOR])

    def metres(points: Sequence[Sequence[float]]) -> NDArray[np.float64]:
        px = (np.asarray(points, float) - to_redraw["translation"]) @ turn / scale
        return np.asarray(px * [metres_per_px, -metres_per_px])

    rooms = [room for name, room in fields["redraw"][FLOOR].items() if name.startswith("room")]
    spaces = tuple(
        Space(_label(room), Polygon(metres(room["vertices"]))) for room in _indoors(rooms)
    )
    doors = _once([metres(door) for room in rooms for door in room["doors"]])
    windows = [metres(window) for room in rooms for window in room["windows"]]
    gaps = [Gap("door", "unknown", ends, WALL_M) for ends in doors]
    gaps += [Gap("window", "unknown", ends, WALL_M) for ends in windows]
    px_from_m = np.diag([1.0 / metres_per_px, -1.0 / metres_per_px, 1.0])
    layout = Layout(Polygon(), Polygon(), tuple(gaps), spaces, metres_per_px)
    return folder / "floor_01.png", px_from_m, layout


def _label(room: dict[str, Any]) -> str:
    pins = room["pins"]
    return str(pins[0]["label"]) if pins else ""


def _indoors(rooms: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Rooms but for the patio: its outline shares no side within a wall's width but one."""
    areas = [Polygon(room["vertices"]) for room in rooms]
    kept = []
    for index, room in enumerate(rooms):
        others = [area for other, area in enumerate(areas) if other != index]
        near = [areas[index].exterior.intersection(area.buffer(0.06)).length for area in others]
        if sum(near) > 0.35 * areas[index].length:
            kept.append(room)
    return kept


def _once(doors: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
    """Doors on both faces of a wall as one each, in the middle between them."""
    single: list[NDArray[np.float64]] = []
    for door in doors:
        for index, other in enumerate(single):
            far = float(np.hypot(*(door.mean(axis=0) - other.mean(axis=0))))
            if far < SAME_DOOR_M:
                same_way = np.dot(door[1] - door[0], other[1] - other[0]) > 0
                single[index] = (other + (door if same_way else door[::-1])) / 2
                break
        else:
            single.append(door)
    return single


def rows(jobs: int, pictures: Path | None) -> list[Row]:
    """Asked for: rooms F1 0.9, doors and windows F1 0.80, areas within 3 %."""
    path, px_from_m, true = truth()
    reading = read_plans([path], jobs)[0]
    found = None
    row: dict[str, str | int | float | bool | None] = {
        "set": "zind",
        "part": "000",
        "not read": 1,
        "seconds": reading.seconds,
    }
    if reading.storey is not None:
        found = found_layout(reading.storey, px_from_m, single_line=False)
        row |= measures(found, true)
    if pictures is not None:
        picture(path, f"zind {row}"[:110], found, true, px_from_m, pictures)
    return [row]


def measures(found: Layout, true: Layout) -> dict[str, str | int | float | bool | None]:
    """The set's figures. Gaps count as doors: the drawing shows both as white."""
    found_gaps = [
        Gap("door" if gap.kind == "gap" else gap.kind, gap.type, gap.ends_m, gap.wall_thickness_m)
        for gap in found.gaps
    ]
    doors, windows = (
        opening_hits(
            [gap for gap in found_gaps if gap.kind == kind],
            [gap for gap in true.gaps if gap.kind == kind],
        )
        for kind in ("door", "window")
    )
    ratio = found.metres_per_px / true.metres_per_px
    pairs = matched(found.spaces, true.spaces, lambda a, b: max(iou(a.area, b.area) - 0.5, 0.0))
    errors = [
        abs(found.spaces[i].area.area * ratio**2 / true.spaces[j].area.area - 1) for i, j in pairs
    ]
    return {
        "not read": 0,
        "rooms F1": room_hits(found.spaces, true.spaces, use=False).f1,
        "doors F1": doors.f1,
        "windows F1": windows.f1,
        "openings F1": (doors + windows).f1,
        "scale error": ratio - 1,
        "area error (median)": statistics.median(errors) if errors else None,
    }
