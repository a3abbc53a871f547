"""`house.x3d`: the house as AV3D has it: doors that open, lamps that switch on, views to jump to.

AV3D, 3D Geometry Generation: collision, and proximity sensors for doors and lamps. No scripts: all
that moves is done by sensors, followers and routes, which every player of X3D's Immersive profile
with followers has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import STRtree
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.formats.x3d import X3dScene, look_from, place_of
from veduta.place.flatten import flattened
from veduta.place.manifest import Start, Tour, Vector
from veduta.place.part import Part
from veduta.plan.document import Room
from veduta.plan.house.build import House
from veduta.plan.house.space import Space, pieces_of
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.x3d_doors import add_doors
from veduta.plan.outputs.x3d_lamps import RoomLamps
from veduta.plan.outputs.x3d_tour import add_tour
from veduta.plan.surroundings.daylight import daylight_of, toward_light
from veduta.plan.surroundings.site import Site

STEP_M = 0.05
"""From a surface to the place in whose room it is."""
EYE_M = 1.6
AVATAR_M = (0.2, 1.6, 0.45)
"""How near one comes to a wall, from the eyes to the floor, and the highest step."""
SPEED = 1.4
FIELD_OF_VIEW = 1.05
_FROM_WALL_M = 0.45
_SKY_ANGLE = (1.15, 1.55)
_EARTH = ((0.42, 0.46, 0.33), (0.62, 0.66, 0.56))
_EARTH_ANGLE = (1.5,)
_SUN_STRENGTH, _SUN_AROUND = 0.45, 0.4
_SKY_LIGHT = (("sky light", (-0.5, -0.4, -0.3), 0.22), ("ground light", (0.1, -0.2, 1.0), 0.3))
"""Strengths of the sun, and how much of it comes from all around; names, directions and strengths
of the others. No light of X3D throws a shadow without being asked to: the sun shines into rooms,
too."""
_FROM_DOOR_M = 0.4
"""Beside an open leaf."""


@dataclass(frozen=True)
class View:
    """A place to look from (m, in the frame of the place)."""

    name: str
    eye: Vector
    target: Vector


@dataclass(frozen=True)
class RoomOf:
    """Which room each polygon of the house is seen from.

    rooms: with their storeys. number: (p,) index of the room, -1 for outdoors.
    """

    rooms: tuple[tuple[Space, Room, Polygon], ...]
    number: NDArray[np.int64]


def house_x3d(
    house: House,
    options: HouseOptions,
    start: Start,
    views: Sequence[View] = (),
    tours: Sequence[Tour] = (),
    others: Sequence[Part] = (),
    site: Site | None = None,
    backdrop: Part | None = None,
) -> bytes:
    """The file's content.

    start: where the visitor begins. views: further places to look from. tours: each a viewpoint
    that walks. others: what stands around the house. All in the frame of the place. site: the sun.
    backdrop: a picture around all of it, into which nobody bumps.
    """
    part = flattened(house.part)
    up_m = options.plinth - house.spaces[house.ground].storey.elevation_m
    ceilings = {s.storey.name: s.storey.height_m - options.slab for s in house.spaces}
    scene = X3dScene("House from a floor plan")
    _add_surroundings(scene, site or Site())
    _add_views(scene, house, up_m, start, views)
    for tour in tours:
        add_tour(scene, tour, FIELD_OF_VIEW)
    whole = scene.node(scene.scene, "Transform", "house", translation=place_of((0.0, 0.0, up_m)))
    seen_from = room_of_polygons(part, house.spaces, ceilings)
    still = np.ones(len(part.polygon_feature), dtype=np.bool_)
    for mover in part.movers:
        still[mover.polygons] = False
    for name, numbers in _pieces(seen_from).items():
        group = scene.node(whole, "Group", name)
        lamps = RoomLamps(scene, part, name)
        chosen = still & np.isin(seen_from.number, numbers)
        space = seen_from.rooms[numbers[0]][0]
        region = MultiPolygon([seen_from.rooms[number][2] for number in numbers])
        lamps.add(group, region, space, ceilings[space.storey.name], chosen)
        scene.shapes(group, part, chosen & ~lamps.glass)
    outside = scene.node(whole, "Group", "outside")
    scene.shapes(outside, part, still & (seen_from.number < 0))
    add_doors(scene, whole, part, house.spaces)
    for other in others:
        group = scene.node(scene.scene, "Group", other.id)
        plain = flattened(other)
        scene.shapes(group, plain, np.ones(len(plain.polygon_feature), dtype=np.bool_))
    if backdrop is not None:
        open_air = scene.node(scene.scene, "Collision", backdrop.id, enabled=False)
        scene.shapes(open_air, backdrop, np.ones(len(backdrop.polygon_feature), dtype=np.bool_))
    return scene.content()


def room_of_polygons(part: Part, spaces: Sequence[Space], ceilings_m: dict[str, float]) -> RoomOf:
    """Of each polygon, the room before it: a step along its normal from its largest triangle."""
    rooms = tuple(
        (space, room, piece)
        for space in spaces
        for room, region in space.floors
        if room is not None
        for piece in pieces_of(region)
    )
    number = np.full(len(part.polygon_feature), -1, dtype=np.int64)
    if not rooms:
        return RoomOf(rooms, number)
    triangles = part.triangles
    corners = part.positions_m.astype(np.float64)[triangles.indices]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(sides, axis=1)
    order = np.argsort(size, kind="stable")
    largest = np.zeros(len(number), dtype=np.int64)
    largest[triangles.polygon[order]] = order
    before = corners[largest].mean(axis=1) + STEP_M * triangles.polygon_normal
    tree = STRtree([piece for _, _, piece in rooms])
    points, found = tree.query(shapely.points(before[:, :2]), predicate="intersects")
    for point, room in zip(points.tolist(), found.tolist(), strict=True):
        storey = rooms[room][0].storey
        height = before[point, 2] - storey.elevation_m
        if -STEP_M <= height <= ceilings_m[storey.name] + STEP_M:
            number[point] = room
    return RoomOf(rooms, number)


def _pieces(seen_from: RoomOf) -> dict[str, list[int]]:
    """The pieces of each room by its storey and id: a wall may part a floor."""
    found: dict[str, list[int]] = {}
    for number, (space, room, _) in enumerate(seen_from.rooms):
        found.setdefault(f"{space.storey.name} {room.id}", []).append(number)
    return found


def _add_surroundings(scene: X3dScene, site: Site) -> None:
    """How one moves, the sky, and daylight: the sun's, or the moon's by night."""
    light = daylight_of(site.sun)
    middle = [(top + low) / 2.0 for top, low in zip(light.zenith, light.horizon, strict=True)]
    earth = [[light.shown[k] * colour[k] for k in range(3)] for colour in _EARTH]
    scene.node(
        scene.scene, "NavigationInfo", "navigation", type=["WALK", "EXAMINE", "FLY", "ANY"],
        avatarSize=AVATAR_M, speed=SPEED, headlight=False,
    )  # fmt: skip
    scene.node(
        scene.scene, "Background", "sky", skyColor=[light.zenith, middle, light.horizon],
        skyAngle=_SKY_ANGLE, groundColor=earth, groundAngle=_EARTH_ANGLE,
    )  # fmt: skip
    away = -np.array(toward_light(site))
    scene.node(
        scene.scene, "DirectionalLight", "sun", direction=place_of(away), color=light.colour,
        intensity=_SUN_STRENGTH * light.strength, ambientIntensity=_SUN_AROUND, global_=True,
    )  # fmt: skip
    for name, way, strength in _SKY_LIGHT:
        scene.node(
            scene.scene, "DirectionalLight", name, direction=place_of(way), color=light.colour,
            intensity=strength * light.around, ambientIntensity=0.0, global_=True,
        )  # fmt: skip


def _add_views(
    scene: X3dScene, house: House, up_m: float, start: Start, views: Sequence[View]
) -> None:
    """Where one can jump to: before the door, into each room, and what else is asked for."""
    every = [View("Entrance", start.eye, start.target), *views]
    for space in house.spaces:
        for room, region in space.floors:
            view = None if room is None else room_view(space, room, region, up_m)
            every += [view] if view is not None else []
    for view in every:
        scene.node(
            scene.scene, "Viewpoint", f"view {view.name}", description=view.name,
            position=place_of(view.eye), orientation=look_from(view.eye, view.target),
            fieldOfView=FIELD_OF_VIEW,
        )  # fmt: skip


def room_view(space: Space, room: Room, region: BaseGeometry, up_m: float) -> View | None:
    """From the corner of a room that is furthest from its middle, to its middle."""
    whole = max(pieces_of(region), key=lambda piece: piece.area)
    inner = whole.buffer(-_FROM_WALL_M, join_style="mitre")
    if inner.is_empty:
        return None
    middle = np.array(whole.representative_point().coords[0])
    corners = shapely.get_coordinates(inner)
    seen = [at for at in corners if whole.covers(shapely.linestrings([at, middle]))]
    if not seen:
        return None
    doors = [hole for hole in space.holes if hole.reaches_floor]

    def rank(at: NDArray[np.float64]) -> tuple[bool, float]:
        here = shapely.Point(at)
        free = all(hole.outline.distance(here) > hole.width_m + _FROM_DOOR_M for hole in doors)
        return free, float(np.hypot(*(at - middle)))

    eye = max(seen, key=rank)
    floor = up_m + space.storey.elevation_m
    name = f"{room.name or room.use} ({space.storey.name})"
    return View(
        name,
        (float(eye[0]), float(eye[1]), floor + EYE_M),
        (float(middle[0]), float(middle[1]), floor + EYE_M - 0.25),
    )
