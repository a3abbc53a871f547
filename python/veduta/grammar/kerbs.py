"""Streets before the houses: carriageways along road lines, and pavements with kerbs beside them.

All of it is invented from the lines and their widths. It is laid where the lots stand on one level,
and in towns that are no larger than `MOST_LOTS`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta import _core
from veduta.formats.ground_glb import ground_glb
from veduta.formats.tile_glb import BuildingRow
from veduta.formats.tiles import Tile, union
from veduta.grammar.ground import is_level
from veduta.grammar.lot import Lot, anchors_of, boxes_of
from veduta.grammar.outline import Road
from veduta.grammar.surfaces.catalogue import PREFIX, sizes_m
from veduta.grammar.textures import Textures
from veduta.place.features import feature_table
from veduta.place.material import Colour, Material
from veduta.place.mesh import Mesh
from veduta.place.part import PLANE_TOLERANCE_M
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.atomic import write_bytes

MOST_LOTS = 5_000
ID, NAME = "streets", "Streets"


@dataclass(frozen=True)
class KerbParameters:
    """Sizes of streets in metres, as towns usually have them.

    pavement_m: width of a pavement where there is room. kerb_m: how high it lies. least_m2: smaller
    pieces of pavement are left out. reach_m: roads farther from all lots are not laid. above_m: the
    carriageway lies so far above the plane of the lots that the ground does not shine through.
    """

    pavement_m: float = 3.0
    kerb_m: float = 0.12
    least_m2: float = 1.0
    reach_m: float = 30.0
    above_m: float = 0.01


@dataclass(frozen=True)
class _Surface:
    """A surface of the streets: what it is called, its texture and its colour (sRGB)."""

    name: str
    texture: str
    colour: Colour


CARRIAGEWAY = _Surface("Carriageway", f"{PREFIX}asphalt", (0.34, 0.34, 0.35))
PAVEMENT = _Surface("Pavement", f"{PREFIX}paving", (0.66, 0.64, 0.61))
KERB = _Surface("Kerb", f"{PREFIX}stone", (0.58, 0.57, 0.55))
SURFACES = (CARRIAGEWAY, PAVEMENT, KERB)
WHITE: Colour = (1.0, 1.0, 1.0)
"""Of the part, whose textures have the colours; tiles have no textures."""


def streets_of(
    lots: Sequence[Lot], roads: Sequence[Road], parameters: KerbParameters | None = None
) -> Mesh | None:
    """The streets about the origin of the lots; None where nothing is laid.

    roads: metres from the origin of all lots; paths are left as they are.
    """
    parameters = parameters or KerbParameters()
    drives = [road for road in roads if not road.is_path]
    if not drives or not 0 < len(lots) <= MOST_LOTS or not is_level(anchors_of(lots)):
        return None
    low, high = boxes_of(lots)
    reach = parameters.reach_m
    around = shapely.box(*(low.min(axis=0) - reach), *(high.max(axis=0) + reach))
    ribbons = [
        shapely.LineString(road.points[:, :2]).buffer(road.width_m / 2, cap_style="flat")
        for road in drives
    ]
    houses = shapely.union_all([_outline(lot) for lot in lots])
    carriageway = shapely.intersection(shapely.union_all(ribbons), around).difference(houses)
    beside = carriageway.buffer(parameters.pavement_m, join_style="mitre", mitre_limit=1.5)
    pavement = beside.difference(carriageway).difference(houses).intersection(around)
    kept = [one for one in polygons_of(pavement) if one.area >= parameters.least_m2]
    base = float(anchors_of(lots)[:, 2].min()) + parameters.above_m
    pieces = [
        _level(polygons_of(carriageway), base, 0),
        _level(kept, base + parameters.kerb_m, 1),
        _sides(kept, base, parameters.kerb_m, 2),
    ]
    pieces = [piece for piece in pieces if len(piece[1])]
    return _mesh(pieces) if pieces else None


def with_streets(town: Tile, streets: Mesh, work: Path) -> Tile:
    """The tree of tiles with the streets in it: a tile of one colour for each of their surfaces.

    work: the folder of the tree, into which the tiles are written.
    """
    folder = work / ID
    folder.mkdir(exist_ok=True)
    tiles, boxes = [], [town.box]
    colours = {surface.name: surface.colour for surface in SURFACES}
    for row, name in enumerate(streets.features.name):
        used, triangles = np.unique(
            streets.triangles[streets.triangle_feature == row], return_inverse=True
        )
        points = streets.positions_m[used].astype(np.float64)
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        box = (low[0], low[1], low[2]), (high[0], high[1], high[2])
        file = f"{ID}/{name.lower()}.glb"
        told = BuildingRow(ID, name)
        faces = triangles.reshape(-1, 3).astype(np.int32)
        write_bytes(work / file, ground_glb(points, faces, told, colours[name]))
        tiles.append(Tile(box, 0.0, file, (), np.eye(4), (0.0, 0.0, 0.0)))
        boxes.append(box)
    return replace(town, box=union(boxes), children=(*town.children, *tiles))


def polygons_of(shape: shapely.Geometry) -> list[shapely.Polygon]:
    """The polygons of a shape that have an area."""
    parts = shapely.get_parts(shape)
    return [one for one in parts if one.geom_type == "Polygon" and one.area > 1e-4]


def _outline(lot: Lot) -> shapely.Polygon:
    rings = [ring + lot.anchor_m[:2] for ring in lot.rings_m]
    polygon = shapely.Polygon(rings[0], rings[1:])
    return polygon if polygon.is_valid else polygon.buffer(0.0)


_Piece = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64], int]
"""Points (n, 3), triangles (m, 3), texture coordinates in metres (n, 2), place in `SURFACES`."""


def _level(polygons: Sequence[shapely.Polygon], height_m: float, surface: int) -> _Piece:
    rings = [
        np.asarray(ring.coords)[:-1, :2]
        for polygon in polygons
        for ring in (polygon.exterior, *polygon.interiors)
    ]
    turned = [
        ring if _turns_left(ring) == is_outline else ring[::-1]
        for ring, is_outline in zip(rings, _outlines(polygons), strict=True)
    ]
    if not turned:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros((0, 2)), surface
    flat = np.concatenate(turned)
    points = np.column_stack([flat, np.full(len(flat), height_m)])
    ends = np.concatenate([[0], np.cumsum([len(ring) for ring in turned])]).astype(np.int64)
    counts = [1 + len(polygon.interiors) for polygon in polygons]
    of_polygon = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    triangles, _, _, _ = _core.triangulate_polygons(points, ends, of_polygon, PLANE_TOLERANCE_M)
    return points, triangles.reshape(-1, 3).astype(np.int64), flat, surface


def _outlines(polygons: Sequence[shapely.Polygon]) -> list[bool]:
    """Of each ring whether it is an outline."""
    return [number == 0 for polygon in polygons for number in range(1 + len(polygon.interiors))]


def _turns_left(ring: NDArray[np.float64]) -> bool:
    following = np.roll(ring, -1, axis=0)
    return bool((ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]).sum() > 0.0)


def _sides(
    polygons: Sequence[shapely.Polygon], base_m: float, high_m: float, surface: int
) -> _Piece:
    """Upright faces along all borders, which look away from the polygons."""
    starts, ends, along = [], [], []
    for polygon in polygons:
        rings = [polygon.exterior, *polygon.interiors]
        for number, ring in enumerate(rings):
            flat = np.asarray(ring.coords)[:, :2]
            if _turns_left(flat[:-1]) != (number == 0):
                flat = flat[::-1]
            lengths = np.linalg.norm(np.diff(flat, axis=0), axis=1)
            starts.append(flat[:-1])
            ends.append(flat[1:])
            along.append(np.column_stack([np.cumsum(lengths) - lengths, np.cumsum(lengths)]))
    if not starts:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros((0, 2)), surface
    start, end, reach = (np.concatenate(each) for each in (starts, ends, along))
    low, top = np.full(len(start), base_m), np.full(len(start), base_m + high_m)
    corners = [
        np.column_stack([start, low]),
        np.column_stack([end, low]),
        np.column_stack([end, top]),
        np.column_stack([start, top]),
    ]
    points = np.stack(corners, axis=1).reshape(-1, 3)
    zero, height = np.zeros(len(start)), np.full(len(start), high_m)
    uv = np.stack(
        [
            np.column_stack([reach[:, 0], zero]),
            np.column_stack([reach[:, 1], zero]),
            np.column_stack([reach[:, 1], height]),
            np.column_stack([reach[:, 0], height]),
        ],
        axis=1,
    ).reshape(-1, 2)
    first = 4 * np.arange(len(start))[:, None]
    halves = np.array([[0, 1, 2], [0, 2, 3]])
    triangles = (first[:, None] + halves).reshape(-1, 3)
    return points, triangles, uv, surface


def _mesh(pieces: Sequence[_Piece]) -> Mesh:
    textures = Textures({})
    used = [SURFACES[surface] for _, _, _, surface in pieces]
    rows = [(SemanticClass.GROUND, Provenance.INVENTED, one.name) for one in used]
    offsets = np.cumsum([0, *[len(piece[0]) for piece in pieces]])
    counts = [len(piece[1]) for piece in pieces]
    sizes = sizes_m()
    uv = [
        np.column_stack([piece[2][:, 0] / size[0], -piece[2][:, 1] / size[1]])
        for piece, size in zip(pieces, (sizes[one.texture] for one in used), strict=True)
    ]
    number = np.repeat(np.arange(len(pieces), dtype=np.int32), counts)
    return Mesh(
        id=ID,
        positions_m=np.concatenate([piece[0] for piece in pieces]).astype(np.float32),
        triangles=np.concatenate(
            [piece[1] + offset for piece, offset in zip(pieces, offsets, strict=False)]
        ).astype(np.uint32),
        features=feature_table(ID, rows),
        materials=tuple(
            Material(one.name.lower(), WHITE, 0.95, texture=textures[one.texture]) for one in used
        ),
        triangle_feature=number,
        triangle_material=number.copy(),
        normals=np.concatenate([_normals(piece) for piece in pieces]).astype(np.float32),
        uv=np.concatenate(uv).astype(np.float32),
        notes=("streets are invented along the road lines",),
    )


def _normals(piece: _Piece) -> NDArray[np.float64]:
    """(n, 3) of the points: each belongs to faces that look alike."""
    points, triangles, _, _ = piece
    a, b, c = (points[triangles[:, k]] for k in range(3))
    own = np.cross(b - a, c - a)
    own /= np.maximum(np.linalg.norm(own, axis=1), 1e-12)[:, None]
    normals = np.zeros_like(points)
    normals[triangles.reshape(-1)] = np.repeat(own, 3, axis=0)
    return normals
