"""Building lots from CityJSON: the outlines of what buildings stand on.

https://www.cityjson.org/specs/2.0.1/ - a building's ground is its GroundSurface where it says so,
else the faces that look down; where a prism (LoD1) has no bottom, its top stands for it. Faces that
share an edge are one lot. The first edge of a lot, its front, is the one nearest to a road where
the file has roads, and else the longest.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.formats.cityjson_read import epsg_of
from veduta.geometry.polygon import signed_area
from veduta.grammar.outline import Attribute, Found, Outline, Outlines, plain_attributes
from veduta.grammar.rings import MAX_VERTICES, RingFault
from veduta.run.errors import InputError

BUILDINGS = {"Building", "BuildingPart"}
ROADS = {"Road", "TransportSquare"}
LEVEL = 0.9
"""A face whose unit normal's z is beyond this looks up (or down)."""
MIN_FRONT_M = 2.0
"""A shorter edge is no front."""
Loop = NDArray[np.int64]


def city_outlines(path: Path, document: dict[str, Any], found: Found) -> Outlines:
    """The lots of all buildings; what was wrong with those that give none goes to `found`."""
    found.epsg = epsg_of(document)
    points = vertices_of(path, document)
    objects = document.get("CityObjects")
    if not isinstance(objects, dict):
        raise InputError(path, "has no CityObjects", "Save it as CityJSON.")
    rings = [ring for one in objects.values() for ring in road_rings(one, len(points))]
    roads = road_corners(points[np.unique(np.concatenate(rings))] if rings else None)
    for name, city_object in objects.items():
        yield from building_outlines(f"{path}: {name}", name, city_object, points, roads, found)


def building_outlines(
    subject: str,
    name: str,
    city_object: Any,
    points: NDArray[np.float64],
    roads: KDTree | None,
    found: Found,
) -> Outlines:
    """The lots of a city object: none where it is no building, or where its parts have them."""
    if not isinstance(city_object, dict) or _type_of(city_object) not in BUILDINGS:
        return
    if not city_object.get("geometry"):
        return
    try:
        polygons, height = _lots_of(points, city_object)
        attributes: dict[str, Attribute] = {"height": height}
        attributes |= plain_attributes(city_object.get("attributes"))
        for number, rings in enumerate(polygons, 1):
            own = name if len(polygons) == 1 else f"{name}-{number}"
            rings = [_with_front(rings[0], roads), *rings[1:]]
            yield Outline(subject, own[:200], rings, attributes)
    except RingFault as fault:
        found.fail(subject, str(fault))


def vertices_of(path: Path, document: dict[str, Any]) -> NDArray[np.float64]:
    """(n, 3) in the file's CRS."""
    transform = document.get("transform")
    try:
        points = np.array(document["vertices"])
        move = (
            transform if isinstance(transform, dict) else {"scale": [1] * 3, "translate": [0] * 3}
        )
        scale, translate = np.array(move["scale"]), np.array(move["translate"])
    except (KeyError, ValueError) as error:
        raise InputError(path, "has no vertices that can be read", "Check the file.") from error
    sound = points.ndim == 2 and points.shape[1] == 3 and scale.shape == translate.shape == (3,)
    if not sound or any(part.dtype.kind not in "iuf" for part in (points, scale, translate)):
        raise InputError(path, "has no vertices that can be read", "Check the file.")
    found: NDArray[np.float64] = points.astype(np.float64) * scale + translate
    if not np.isfinite(found).all():
        raise InputError(path, "has vertices that are not finite", "Check the file.")
    return found


def _lots_of(
    points: NDArray[np.float64], city_object: dict[str, Any]
) -> tuple[list[list[NDArray[np.float64]]], float]:
    """The polygons that a building stands on, and its height (m)."""
    faces = list(_faces(city_object, len(points)))
    if not faces:
        raise RingFault("has no surfaces")
    every = np.concatenate([ring for rings, _ in faces for ring in rings])
    heights = points[every, 2]
    ground = [rings for rings, kind in faces if kind == "GroundSurface"]
    ground = ground or [rings for rings, _ in faces if _up(points, rings[0]) < -LEVEL]
    top = [] if ground else [rings for rings, _ in faces if _up(points, rings[0]) > LEVEL]
    if top and float(np.ptp(points[np.concatenate([r for rings in top for r in rings]), 2])) > 0.01:
        raise RingFault("has no surface that it stands on, and no roof of one height")
    if not (ground or top):
        raise RingFault("has no surface that it stands on")
    loops = [points[loop] for loop in border(points, ground or top, seen_from_below=bool(ground))]
    for loop in loops:
        loop[:, 2] = heights.min()
    return polygons_of(loops), float(np.ptp(heights))


def _faces(city_object: dict[str, Any], count: int) -> Iterator[tuple[list[Loop], str]]:
    """The rings of each face of the first geometry, and what the face says that it is."""
    geometries = city_object["geometry"]
    geometry = geometries[0] if isinstance(geometries, list) else None
    if not isinstance(geometry, dict):
        raise RingFault("its geometry is no object")
    boundaries, values, kinds = geometry.get("boundaries"), None, []
    semantics = geometry.get("semantics")
    if isinstance(semantics, dict) and isinstance(semantics.get("surfaces"), list):
        values = semantics.get("values")
        kinds = [s.get("type") if isinstance(s, dict) else None for s in semantics["surfaces"]]
    if geometry.get("type") == "Solid":
        boundaries = boundaries[0] if isinstance(boundaries, list) and boundaries else None
        values = values[0] if isinstance(values, list) and values else None
    elif geometry.get("type") not in ("MultiSurface", "CompositeSurface"):
        raise RingFault(f"its geometry is a {str(geometry.get('type'))[:40]}, which is not read")
    if not isinstance(boundaries, list):
        raise RingFault("its geometry has no surfaces")
    for number, face in enumerate(boundaries):
        kind = None
        if isinstance(values, list) and number < len(values):
            value = values[number]
            kind = kinds[value] if isinstance(value, int) and 0 <= value < len(kinds) else None
        yield _rings(face, count), str(kind)


def _rings(face: Any, count: int) -> list[Loop]:
    """The rings of a face as numbers of vertices that are there."""
    if not isinstance(face, list) or not face:
        raise RingFault("a surface has no rings")
    rings = []
    for ring in face:
        if not isinstance(ring, list) or not 3 <= len(ring) <= MAX_VERTICES:
            raise RingFault("a ring is no list of three vertices and more")
        try:
            numbers = np.array(ring)
        except ValueError as error:
            raise RingFault("a ring is no list of numbers") from error
        if numbers.ndim != 1 or numbers.dtype.kind != "i":
            raise RingFault("a ring is no list of numbers")
        if numbers.min() < 0 or numbers.max() >= count:
            raise RingFault("names a vertex that is not there")
        rings.append(numbers.astype(np.int64))
    return rings


def _up(points: NDArray[np.float64], ring: Loop) -> float:
    """The z of the unit normal; 0 where there is none."""
    corners = points[ring] - points[ring[0]]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    length = float(np.linalg.norm(normal))
    return float(normal[2]) / length if length > 0 else 0.0


def border(
    points: NDArray[np.float64], faces: list[list[Loop]], *, seen_from_below: bool
) -> list[Loop]:
    """The edges that only one of the faces has, as closed loops; the faces lie left of them.

    Faces that look down are turned round for that.
    """
    used = np.concatenate([ring for rings in faces for ring in rings])
    _, first, same = np.unique(points[used], axis=0, return_index=True, return_inverse=True)
    one_of = dict(zip(used.tolist(), used[first][same.reshape(-1)].tolist(), strict=True))
    edges: set[tuple[int, int]] = set()
    for rings in faces:
        for ring in rings:
            numbers = [one_of[number] for number in ring.tolist()]
            if seen_from_below:
                numbers.reverse()
            for start, end in zip(numbers, numbers[1:] + numbers[:1], strict=True):
                if (end, start) in edges:
                    edges.remove((end, start))
                elif start != end:
                    edges.add((start, end))
    return _loops(edges)


def _loops(edges: set[tuple[int, int]]) -> list[Loop]:
    after: defaultdict[int, list[int]] = defaultdict(list)
    for start, end in sorted(edges, reverse=True):
        after[start].append(end)
    loops = []
    for start in sorted(after):
        while after[start]:
            loop, at = [start], after[start].pop()
            while at != start:
                if not after[at]:
                    raise RingFault("the border of its ground is not closed")
                loop.append(at)
                at = after[at].pop()
            if len(loop) >= 3:
                loops.append(np.array(loop, dtype=np.int64))
    return loops


def polygons_of(loops: list[NDArray[np.float64]]) -> list[list[NDArray[np.float64]]]:
    """Outlines with the holes that lie in them."""
    outlines = [[loop] for loop in loops if ring_area(loop) > 0]
    if not outlines:
        raise RingFault("its ground encloses nothing")
    for loop in loops:
        if ring_area(loop) < 0:
            around = [rings for rings in outlines if _is_in(loop[0], rings[0])]
            (around or outlines)[0].append(loop)
    return outlines


def ring_area(loop: NDArray[np.float64]) -> float:
    """Positive counter-clockwise from above; about the first corner, as coordinates are large."""
    return signed_area(loop[:, :2] - loop[0, :2])


def _is_in(point: NDArray[np.float64], loop: NDArray[np.float64]) -> bool:
    """By the even-odd rule."""
    x, y = (loop[:, :2] - point[:2]).T
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    crosses = (y > 0) != (y1 > 0)
    rise = np.where(crosses, y1 - y, 1.0)
    return bool((crosses & (x - y * (x1 - x) / rise > 0)).sum() % 2)


def _type_of(city_object: dict[str, Any]) -> str:
    """The kind of a city object; "" where it is no word."""
    kind = city_object.get("type")
    return kind if isinstance(kind, str) else ""


def road_rings(city_object: Any, count: int) -> list[Loop]:
    """The rings of a road among `count` vertices; none of what is no road, or cannot be read."""
    if not isinstance(city_object, dict) or _type_of(city_object) not in ROADS:
        return []
    try:
        return [ring for rings, _ in _faces(city_object, count) for ring in rings]
    except (RingFault, KeyError):
        return []  # a road that cannot be read is none to look at


def road_corners(corners: NDArray[np.float64] | None) -> KDTree | None:
    """The (n, 3) corners of all roads, to look for the nearest one; None where there are none."""
    return None if corners is None else KDTree(corners[:, :2])


def _with_front(outline: NDArray[np.float64], roads: KDTree | None) -> NDArray[np.float64]:
    """The outline with the edge nearest to a road as its first, or with the longest."""
    flat = outline[:, :2]
    edges = np.roll(flat, -1, axis=0) - flat
    lengths = np.linalg.norm(edges, axis=1)
    if roads is None:
        return np.roll(outline, -int(np.argmax(lengths)), axis=0)
    outward = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.maximum(lengths, 1e-9)[:, None]
    distances, _ = roads.query(flat + edges / 2 + 2.0 * outward)
    distances = np.where(lengths >= min(MIN_FRONT_M, float(lengths.max())), distances, np.inf)
    return np.roll(outline, -int(np.argmin(distances)), axis=0)
