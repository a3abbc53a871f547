"""A plan made by hand: two rooms, a front door, a door between them, and windows."""

from __future__ import annotations

from typing import Any

from veduta.plan.document import (
    Junction,
    Opening,
    PlanDocument,
    Room,
    Scale,
    Sheet,
    Storey,
    Wall,
)

OUTER_M, INNER_M = 0.30, 0.12
WIDTH_M, DEPTH_M, MIDDLE_M = 8.0, 5.0, 5.0
HEIGHT_M = 2.8
PIXEL_M = 0.01
MARGIN_PX = 60.0


def sheet() -> Sheet:
    """A clean drawing with a margin around the house."""
    return Sheet(
        file="plan.png",
        sha256="0" * 64,
        width_px=int(WIDTH_M / PIXEL_M + 2 * MARGIN_PX),
        height_px=int(DEPTH_M / PIXEL_M + 2 * MARGIN_PX),
        clean_from_scan=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        origin_px=(MARGIN_PX, DEPTH_M / PIXEL_M + MARGIN_PX),
        metres_per_px=PIXEL_M,
    )


def wall(name: str, start: str, end: str, *, outer: bool = True, **more: Any) -> Wall:
    """A wall that was drawn filled."""
    thickness = OUTER_M if outer else INNER_M
    values: dict[str, Any] = {"thickness_m": thickness, "drawing": "filled", "outer": outer}
    return Wall(id=name, start=start, end=end, score=0.9, **(values | more))


def opening(name: str, on: str, along_m: float, width_m: float, **more: Any) -> Opening:
    """A door, unless it is said otherwise."""
    values: dict[str, Any] = {"kind": "door", "type": "swing", "height_m": 2.05, "score": 0.9}
    return Opening(id=name, wall=on, along_m=along_m, width_m=width_m, **(values | more))


def window(name: str, on: str, along_m: float, width_m: float, **more: Any) -> Opening:
    """A window at the usual height."""
    values: dict[str, Any] = {
        "kind": "window", "type": "double-line", "sill_m": 0.9, "height_m": 1.25
    }  # fmt: skip
    return opening(name, on, along_m, width_m, **(values | more))


def room(id_: str, outline_m: list[tuple[float, float]], **more: Any) -> Room:
    """A room by its inner faces."""
    area = 0.5 * abs(
        sum(
            a[0] * b[1] - b[0] * a[1]
            for a, b in zip(outline_m, [*outline_m[1:], outline_m[0]], strict=True)
        )
    )
    values: dict[str, Any] = {"use": "living", "use_score": 0.9, "score": 0.9}
    return Room(id=id_, outline_m=outline_m, area_m2=area, **(values | more))


def rectangle(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, float]]:
    """Counter-clockwise."""
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def sample_storey(**changes: Any) -> Storey:
    """One storey: 8 x 5 m between centre lines, a wall between at 5 m."""
    half, inner = OUTER_M / 2, INNER_M / 2
    junctions = [
        Junction(id=name, at_m=at, type=kind)
        for name, at, kind in (
            ("a", (0.0, 0.0), "L"),
            ("b", (MIDDLE_M, 0.0), "T"),
            ("c", (WIDTH_M, 0.0), "L"),
            ("d", (WIDTH_M, DEPTH_M), "L"),
            ("e", (MIDDLE_M, DEPTH_M), "T"),
            ("f", (0.0, DEPTH_M), "L"),
        )
    ]
    walls = [
        wall("south-1", "a", "b"),
        wall("south-2", "b", "c"),
        wall("east", "c", "d"),
        wall("north-2", "d", "e"),
        wall("north-1", "e", "f"),
        wall("west", "f", "a"),
        wall("middle", "b", "e", outer=False),
    ]
    openings = [
        opening("front", "south-1", 0.6, 1.0, hinge="start", swing="left"),
        opening("inner", "middle", 1.0, 0.9, hinge="end", swing="right"),
        window("w1", "south-1", 2.6, 1.8),
        window("w2", "north-2", 0.9, 1.2),
    ]
    living = rectangle(half, half, MIDDLE_M - inner, DEPTH_M - half)
    bath = rectangle(MIDDLE_M + inner, half, WIDTH_M - half, DEPTH_M - half)
    values: dict[str, Any] = {
        "name": "ground floor",
        "elevation_m": 0.0,
        "height_m": HEIGHT_M,
        "sheet": sheet(),
        "scale": Scale(metres_per_px=PIXEL_M, sigma=0.01, basis="evidence"),
        "junctions": junctions,
        "walls": walls,
        "openings": openings,
        "rooms": [
            room("living", living, name="Living", openings=["front", "inner", "w1"]),
            room("bath", bath, use="bathroom", name="Bath", openings=["inner", "w2"]),
        ],
    }
    return Storey(**(values | changes))


def sample_plan(*storeys: Storey) -> PlanDocument:
    """A house of the given storeys, or of the sample's."""
    return PlanDocument(storeys=list(storeys or (sample_storey(),)))
