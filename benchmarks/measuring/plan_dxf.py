"""`plans/dxf`: a drawn house whose lines are the truth, read as vectors and as a picture."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import ezdxf
import numpy as np
import shapely
from ezdxf import path as dxf_path
from numpy.typing import NDArray
from plan_data import PLANS, picture
from plan_reading import Reading, read_plans
from plan_scores import iou, opening_hits, room_hits
from plan_truth import Affine, Gap, Layout, Space, found_layout
from record import Row
from shapely import maximum_inscribed_circle, unary_union
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import polygonize

INCH_M = 0.0254
PX_PER_M = 90.0
MARGIN_M = 1.0
MOST_WALL_M = 0.4
LEAST_WALLED = 0.8
REACH_M = 0.02
FACES = ("A-WALL", "A-HEADER", "A-FOOTPRINT")
DRAWN = ("A-WALL", "A-HEADER", "A-OPENING", "A-CASE-1", "A-FIXTURE", "A-GARAGE-DOOR")
FINE = 3
Line = NDArray[np.float64]
UNITS_FROM_M = np.diag([1.0 / INCH_M, 1.0 / INCH_M, 1.0])
"""The frame of the file itself: drawing units in place of pixels."""


def lines() -> list[tuple[str, Line]]:
    """Layer (without its prefix) and points in metres of all that the house's drawing shows."""
    drawing = ezdxf.readfile(PLANS / "dxf" / "floorplan.dxf")
    found = []
    for entity in drawing.modelspace():
        layer = entity.dxf.layer.split("$")[-1]
        if layer in DRAWN or layer in FACES:
            found += [(layer, points) for points in _points(entity)]
    return found


def _points(entity: Any) -> Iterator[Line]:
    if entity.dxftype() == "INSERT":
        for part in entity.virtual_entities():
            yield from _points(part)
    elif entity.dxftype() in ("LINE", "ARC", "LWPOLYLINE", "CIRCLE", "ELLIPSE"):
        curve = dxf_path.make_path(entity)
        yield np.array([(at.x, at.y) for at in curve.flattening(0.2)]) * INCH_M


def truth(drawn: list[tuple[str, Line]]) -> Layout:
    """Walls are the faces between their lines that are thin; openings the closed headers.

    Rooms are the other faces, with the openings closed.
    """
    headers = [
        Polygon(points) for layer, points in drawn if layer == "A-HEADER" and len(points) > 3
    ]
    faces = unary_union([LineString(_longer(points)) for layer, points in drawn if layer in FACES])
    holes = unary_union([header.buffer(0.01) for header in headers])
    walls: list[Polygon] = []
    rooms: list[Polygon] = []
    for area in polygonize(faces):
        if maximum_inscribed_circle(area, tolerance=0.01).length > MOST_WALL_M / 2:
            rooms.append(area)
        elif not holes.contains(area.representative_point()):
            walls.append(area)
    solid = unary_union(walls)
    around = unary_union([solid, holes]).buffer(0.02)
    # A porch is closed by lines alone.
    spaces = [Space("unknown", area) for area in rooms if _walled(area, around)]
    gaps = tuple(_gap(header) for header in headers)
    return Layout(solid, solid.union(holes), gaps, tuple(spaces), 1.0 / PX_PER_M)


def _walled(area: Polygon, around: BaseGeometry) -> bool:
    ring = area.exterior
    return bool(ring.intersection(around).length > LEAST_WALLED * ring.length)


def _longer(points: Line) -> Line:
    """An open line with both ends 2 cm longer: some corners are not closed."""
    if np.allclose(points[0], points[-1]):
        return points
    first, last = points[0] - points[1], points[-1] - points[-2]
    start = points[0] + REACH_M * first / np.hypot(*first)
    end = points[-1] + REACH_M * last / np.hypot(*last)
    return np.vstack([start, points[1:-1], end])


def _gap(header: Polygon) -> Gap:
    corners = shapely.get_coordinates(header.minimum_rotated_rectangle)[:4]
    first, second = np.hypot(*(corners[1] - corners[0])), np.hypot(*(corners[2] - corners[1]))
    if first < second:
        corners = np.roll(corners, -1, axis=0)
    ends = np.array([(corners[0] + corners[3]) / 2, (corners[1] + corners[2]) / 2])
    return Gap("opening", "unknown", ends, float(min(first, second)))


def render(drawn: list[tuple[str, Line]], out: Path) -> Affine:
    """The house as a picture of thin lines; the affine from metres to its pixels."""
    shown = [points for layer, points in drawn if layer in DRAWN]
    every = np.vstack(shown)
    low, high = every.min(axis=0) - MARGIN_M, every.max(axis=0) + MARGIN_M
    size = np.ceil((high - low) * PX_PER_M).astype(int)
    sheet = np.full((size[1] * FINE, size[0] * FINE), 255, np.uint8)
    for points in shown:
        px = (
            np.column_stack([points[:, 0] - low[0], high[1] - points[:, 1]]) * PX_PER_M * FINE - 0.5
        )
        cv2.polylines(
            sheet, [np.round(px * 16).astype(np.int32)], False, 0, FINE * 2, cv2.LINE_AA, 4
        )
    small = cv2.resize(sheet, (int(size[0]), int(size[1])), interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(out), small)
    scale = PX_PER_M
    return np.array([[scale, 0, -low[0] * scale], [0, -scale, high[1] * scale], [0, 0, 1.0]])


def rows(jobs: int, pictures: Path | None) -> list[Row]:
    """The file itself, and a picture of it, against its lines."""
    drawn = lines()
    true = truth(drawn)
    with tempfile.TemporaryDirectory() as folder:
        raster = Path(folder) / "dxf-raster.png"
        px_from_m = render(drawn, raster)
        vector, pixels = read_plans([PLANS / "dxf" / "floorplan.dxf", raster], jobs)
        table: list[Row] = []
        for name, reading in (("vectors", vector), ("raster", pixels)):
            found = None
            if reading.storey is not None:
                frame = UNITS_FROM_M if name == "vectors" else px_from_m
                found = found_layout(reading.storey, frame, single_line=False)
            table.append(_row(name, reading, found, true))
            if pictures is not None and name == "raster":
                picture(raster, f"{table[-1]}"[:110], found, true, px_from_m, pictures)
    return table


def _row(name: str, reading: Reading, found: Layout | None, true: Layout) -> Row:
    row: dict[str, str | int | float | bool | None] = {
        "set": "dxf",
        "part": name,
        "not read": int(found is None),
        "seconds": reading.seconds,
    }
    if found is not None:
        row["wall IoU"] = iou(found.solid, true.solid)
        row["wall recall"] = found.solid.intersection(true.solid).area / true.solid.area
        row["of any kind"] = opening_hits(found.gaps, true.gaps, kind=False).f1
        row["rooms F1"] = room_hits(found.spaces, true.spaces, use=False).f1
        size = INCH_M if name == "vectors" else true.metres_per_px
        row["scale error"] = found.metres_per_px / size - 1
    return row
