"""Whether tours keep what they promise, over many houses: every room, no wall, no quick turn.

    python benchmarks plan/plan_tour [--seeds A..B]

The houses are those of `veduta.synthetic.plans`, as documents without a fault; half of them get
boxes for furniture. The way is checked against the model as it is written: rays of Embree from
three heights of the visitor's body, all around, every 5 cm, into house.glb as trimesh reads it.
"""

from __future__ import annotations

import argparse
import io
import time
from dataclasses import dataclass, replace

import numpy as np
import shapely
import trimesh
from numpy.typing import NDArray
from plan_documents import document_of
from plan_sets import seeds
from record import Row, keep_or_print
from shapely.geometry import LineString, Polygon, box

from veduta.formats.gltf import glb_bytes
from veduta.plan.document import Furniture, PlanDocument, Storey
from veduta.plan.house.build import House, build_house
from veduta.plan.options import HouseOptions
from veduta.plan.tour.clear_view import before_eyes
from veduta.plan.tour.find import EYE_M, Tour, find_tour
from veduta.plan.tour.leaves import leaves_as_toured, with_shut
from veduta.plan.tour.stops import is_cupboard
from veduta.plan.tour.stretches import OUTSIDE
from veduta.synthetic.plans.layout import make_house
from veduta.synthetic.seeds import stream

SEEDS = range(20_000, 20_100)
HEIGHTS_M = (0.4, 1.0, 1.65)
"""Of the rays, above the feet."""
DIRECTIONS = 24
EVERY_M = 0.05
REACH_M = 1.0
"""What is further away than this is not in the way."""
SPEED_M_S = 1.2
NEAR_M = 1.0
"""One shall look at no wall that is nearer."""
FAR_M = 5.0
LOOK_S = 0.2
NOTES = (
    "Asked for: all rooms, never through a wall or an object, no more than 60 degrees per second at"
    " 1.2 m/s, no look at a wall nearer than a metre, a fifth outdoors at most.",
    "Looks: how often (every 0.2 s) a wall, an open leaf or tall furniture is nearer than that in"
    " the middle of the gaze; the mean over houses, and that of the worst house.",
    "Clearance: from the middle of the visitor to the nearest surface of house.glb (doors open), or"
    " to the nearest piece of furniture; the visitor is planned with a radius of 0.2 m, or 0.14 m"
    " where that leads to more rooms.",
    "Houses of two storeys have one of six kinds of stairs, which the tour climbs.",
)


@dataclass(frozen=True)
class Judged:
    """One tour, checked. rooms: of all storeys. visited: those in which the visitor stands once."""

    rooms: int
    visited: int
    missed: tuple[str, ...]
    clear_m: float
    turn_deg_s: float
    speed_m_s: float
    length_m: float
    duration_s: float
    near_share: float
    outdoor_share: float


def judge(house: House, tour: Tour) -> Judged:
    """Check a tour against the house as it is written."""
    path = tour.path
    feet = path.eyes_m - np.array([0.0, 0.0, EYE_M])
    steps = np.diff(path.times_s)
    cosines = (path.directions[1:] * path.directions[:-1]).sum(axis=1)
    turns = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    ways = np.linalg.norm(np.diff(feet, axis=0), axis=1)
    visited = {
        (space.storey.name, room.id)
        for space in house.spaces
        for room, shape in space.rooms
        if not is_cupboard(room) and _stands_in(shape, feet, space.storey)
    }
    return Judged(
        rooms=sum(not is_cupboard(room) for space in house.spaces for room, _ in space.rooms),
        visited=len(visited),
        missed=tour.notes,
        clear_m=min(_to_model(house, feet), _to_furniture(house, feet)),
        turn_deg_s=float((turns / steps).max()),
        speed_m_s=float((ways / steps).max()),
        length_m=float(ways.sum()),
        duration_s=float(path.times_s[-1]),
        near_share=float((looks(house, tour) < NEAR_M).mean()),
        outdoor_share=float(
            sum(one.end_s - one.start_s for one in tour.stretches if one.title == OUTSIDE)
            / path.times_s[-1]
        ),
    )


def looks(house: House, tour: Tour) -> NDArray[np.float64]:
    """(n,) at each fifth of a second, how far (m) one sees before a wall, a leaf or a wardrobe.

    By exact lines at the height of the eyes, `FAR_M` at most; on stairs one sees far.
    """
    path = tour.path
    times = np.arange(0.0, path.times_s[-1], LOOK_S)
    eyes = np.stack([np.interp(times, path.times_s, x) for x in path.eyes_m.T], axis=1)
    ways = np.stack([np.interp(times, path.times_s, x) for x in path.directions.T], axis=1)
    ways = ways[:, :2] / np.linalg.norm(ways[:, :2], axis=1)[:, None]
    rays = shapely.linestrings(np.stack([eyes[:, :2], eyes[:, :2] + FAR_M * ways], axis=1))
    leaves = leaves_as_toured(house.part, tour.shut)
    away = np.full(len(times), FAR_M)
    for space in house.spaces:
        here = np.abs(eyes[:, 2] - EYE_M - space.storey.elevation_m) < 0.05
        met = shapely.intersection(np.asarray(rays)[here], before_eyes(space, leaves))
        far = shapely.distance(met, shapely.points(eyes[here, :2]))
        away[here] = np.where(np.isnan(far), FAR_M, far)
    return away


def _stands_in(shape: Polygon, feet: NDArray[np.float64], storey: Storey) -> bool:
    on = feet[np.abs(feet[:, 2] - storey.elevation_m) < 0.05]
    return bool(shapely.contains_xy(shape, on[:, 0], on[:, 1]).any())


def _to_model(house: House, feet: NDArray[np.float64]) -> float:
    """The smallest distance to a surface (m), at most `REACH_M`."""
    scene = trimesh.load_scene(io.BytesIO(glb_bytes(house.part)), file_type="glb")
    mesh = scene.to_mesh()
    way = _every(feet)
    angles = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    # glTF is y-up: (x, y, z) of the plan is (x, z, -y) there.
    rays = np.stack([np.cos(angles), np.zeros(DIRECTIONS), -np.sin(angles)], axis=1)
    places = np.concatenate([way + np.array([0.0, 0.0, height]) for height in HEIGHTS_M])
    places = np.stack([places[:, 0], places[:, 2], -places[:, 1]], axis=1)
    origins = np.repeat(places, DIRECTIONS, axis=0)
    hits, rows, _ = mesh.ray.intersects_location(
        origins, np.tile(rays, (len(places), 1)), multiple_hits=False
    )
    away = np.linalg.norm(hits - origins[rows], axis=1)
    return float(min(away.min(initial=REACH_M), REACH_M))


def _to_furniture(house: House, feet: NDArray[np.float64]) -> float:
    nearest = REACH_M
    for space in house.spaces:
        on = feet[np.abs(feet[:, 2] - space.storey.elevation_m) < 0.05]
        if len(on) < 2:
            continue
        way = LineString(on[:, :2])
        for item in space.storey.furniture or ():
            half = np.array(item.size_m[:2]) / 2.0
            turn = np.array(
                [
                    [np.cos(item.turn_rad), -np.sin(item.turn_rad)],
                    [np.sin(item.turn_rad), np.cos(item.turn_rad)],
                ]
            )
            corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half
            nearest = min(nearest, way.distance(Polygon(corners @ turn.T + item.at_m)))
    return float(nearest)


def _every(feet: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) places on the way, no further apart than `EVERY_M`."""
    pieces = [feet[:1]]
    for first, last in zip(feet, feet[1:], strict=False):
        count = max(1, int(np.ceil(np.linalg.norm(last - first) / EVERY_M)))
        share = np.arange(1, count + 1)[:, None] / count
        pieces.append(first + share * (last - first))
    return np.concatenate(pieces)


def furnished(document: PlanDocument, seed: int) -> PlanDocument:
    """The house with boxes along the walls and in the middle of rooms: invented, for the test."""
    rng = stream(seed, "boxes")
    storeys = [
        storey.model_copy(update={"furniture": _boxes(storey, rng)}) for storey in document.storeys
    ]
    return document.model_copy(update={"storeys": storeys})


def _boxes(storey: Storey, rng: np.random.Generator) -> list[Furniture]:
    """In rooms of 8 m² and more: a table near the middle, that leaves a way around it."""
    found: list[Furniture] = []
    for room in storey.rooms:
        shape = Polygon(room.outline_m)
        if room.area_m2 < 8.0 or room.use in {"hall", "corridor", "stairs", "garage"}:
            continue
        middle = np.array(shape.centroid.coords[0]) + rng.uniform(-0.3, 0.3, 2)
        size = (float(rng.uniform(0.6, 1.2)), float(rng.uniform(0.5, 0.8)), 0.75)
        around = box(*(middle - 1.5), *(middle + 1.5))
        if shape.buffer(0.2).covers(around.buffer(-0.6)):
            found.append(
                Furniture(
                    id=f"t{len(found)}",
                    object="dining-table-white",
                    room=room.id,
                    at_m=(float(middle[0]), float(middle[1])),
                    turn_rad=float(rng.uniform(0.0, np.pi)),
                    size_m=size,
                )
            )
    return found


def row_of(seed: int) -> Row:
    """One house."""
    document = document_of(make_house(seed))
    has_boxes = seed % 2 == 1
    house = build_house(furnished(document, seed) if has_boxes else document, HouseOptions())
    begin = time.perf_counter()
    tour = find_tour(house, SPEED_M_S)
    seconds = time.perf_counter() - begin
    if tour is None:
        return {"seed": seed, "tour": "none"}
    # As the house is written: with those doors closed that the tour keeps so.
    found = judge(replace(house, part=with_shut(house.part, tour.shut)), tour)
    return {
        "seed": seed,
        "storeys": len(house.spaces),
        "rooms": found.rooms,
        "visited": found.visited,
        "clearance m": found.clear_m,
        "turn deg/s": found.turn_deg_s,
        "speed m/s": found.speed_m_s,
        "length m": found.length_m,
        "lasts s": found.duration_s,
        "looks nearer than 1 m": found.near_share,
        "outdoors": found.outdoor_share,
        "doors kept closed": len(tour.shut),
        "found in s": seconds,
        "left out": "; ".join(found.missed),
    }


def main() -> None:
    """Check the tours of all seeds; only a run over all is kept."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    parser.add_argument("--each", action="store_true", help="print a row for each house")
    asked = parser.parse_args()
    rows = []
    for seed in asked.seeds:
        rows.append(row_of(seed))
        if asked.each:
            print(rows[-1], flush=True)
    keep_or_print("plan-tour", [summary(rows)], NOTES, keep=list(asked.seeds) == list(SEEDS))


def summary(rows: list[Row]) -> Row:
    """All houses in a row."""
    toured = [row for row in rows if "visited" in row]

    def column(name: str) -> NDArray[np.float64]:
        return np.array([float(row[name]) for row in toured])  # type: ignore[arg-type]

    return {
        "houses": len(rows),
        "with a tour": len(toured),
        "rooms": int(column("rooms").sum()),
        "visited": int(column("visited").sum()),
        "houses with all rooms": int((column("visited") == column("rooms")).sum()),
        "least clearance m": float(column("clearance m").min()),
        "most turn deg/s": float(column("turn deg/s").max()),
        "most speed m/s": float(column("speed m/s").max()),
        "median length m": float(np.median(column("length m"))),
        "median lasts s": float(np.median(column("lasts s"))),
        "looks nearer than 1 m": float(np.mean(column("looks nearer than 1 m"))),
        "most of a house": float(column("looks nearer than 1 m").max()),
        "outdoors at most": float(column("outdoors").max()),
        "doors kept closed": int(column("doors kept closed").sum()),
        "median found in s": float(np.median(column("found in s"))),
        "most found in s": float(column("found in s").max()),
    }


if __name__ == "__main__":
    main()
