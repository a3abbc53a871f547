"""The footprint of a building of which there is a model in glTF: a level cut through its walls.

A model's outline from above is that of its eaves; its walls stand further in. So it is cut at many
heights, and of each building that cut is taken which has the fewest corners: it runs between
windows and below balconies and roofs. It must be about as large as the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.mesh_glb_read import read_model
from veduta.formats.obj_read import ReadMesh
from veduta.grammar.lot import Lot
from veduta.grammar.lots import Lots
from veduta.place.part import Part
from veduta.run.errors import InputError

SUFFIXES = (".glb", ".gltf")
_REMEDY = "Give a building with closed walls, up along y, in metres; or its footprint as GeoJSON."
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class CutParameters:
    """heights: at so many, from `low` to `high` of the model's height. snap_m: corners so near are
    one. straight_m: what lies so near to a line is on it. large: the least share of the median
    cut's area. least_m2: smaller outlines are none. most: triangles.
    """

    heights: int = 24
    low: float = 0.02
    high: float = 0.9
    snap_m: float = 1e-3
    straight_m: float = 0.02
    large: float = 0.9
    least_m2: float = 4.0
    most: int = 2_000_000


def read_model_lots(path: Path, parameters: CutParameters | None = None) -> Lots:
    """The outlines of a model's walls as lots, the largest first; InputError where it has none."""
    own = parameters or CutParameters()
    corners = _triangles(path, own)
    ground = float(corners[:, :, 2].min())
    outlines = _outlines(corners, own)
    if not outlines:
        raise InputError(path, "has no closed wall at any height", _REMEDY)
    names = ["building"] if len(outlines) == 1 else [str(n) for n in range(1, len(outlines) + 1)]
    return Lots([_lot(n, one, ground) for n, one in zip(names, outlines, strict=True)])


def _triangles(path: Path, own: CutParameters) -> Floats:
    """Corners (n, 3, 3) of the model's triangles: east, north, up."""
    if path.suffix.lower() == ".gltf":
        raise InputError(
            path, "is glTF as text, with its numbers beside it", "Export it as binary glTF (.glb)."
        )
    try:
        model = read_model(path)
        rows = model.triangles.indices if isinstance(model, Part) else model.triangles
        found = np.asarray(model.positions_m, np.float64)[rows]
    except InputError:
        found = _of_faces(read_glb_mesh(path))
    if not len(found) or not np.isfinite(found).all():
        raise InputError(path, "has no triangles with places that are numbers", _REMEDY)
    if len(found) > own.most:
        reason = f"has {len(found):,} triangles, more than {own.most:,}"
        raise InputError(path, reason, "Give a simpler model of the building.")
    return found.reshape(-1, 3, 3)


def _of_faces(mesh: ReadMesh) -> Floats:
    """Fans of the faces of another program's mesh, whose y points up."""
    east, up, south = np.asarray(mesh.points, np.float64).T
    points = np.stack([east, -south, up], axis=1)
    counts = np.diff(mesh.offsets)
    each = np.maximum(counts - 2, 0)
    face = np.repeat(np.arange(len(counts)), each)
    step = np.arange(len(face)) - np.repeat(np.cumsum(each) - each, each)
    first = mesh.offsets[face]
    rows = np.stack([first, first + step + 1, first + step + 2], axis=1)
    return np.asarray(points[mesh.corners[rows]], np.float64)


def _outlines(corners: Floats, own: CutParameters) -> list[shapely.Polygon]:
    """The outline of each building, by the cut of it with the fewest corners; the largest first."""
    low, high = float(corners[:, :, 2].min()), float(corners[:, :, 2].max())
    shares = np.linspace(own.low, own.high, own.heights)
    cuts = [_cut(corners, low + float(share) * (high - low), own) for share in shares]
    places = shapely.get_parts(shapely.union_all([one for cut in cuts for one in cut])).tolist()
    found = [
        _simplest([one for cut in cuts for one in cut if one.intersection(place).area > 0.0], own)
        for place in places
        if isinstance(place, shapely.Polygon)
    ]
    return sorted((one for one in found if one.area >= own.least_m2), key=lambda one: -one.area)


def _simplest(cuts: list[shapely.Polygon], own: CutParameters) -> shapely.Polygon:
    """Of the cuts of one building that are about as large as most the one of fewest corners."""
    median = float(np.median([cut.area for cut in cuts]))
    nearest = min(cuts, key=lambda cut: abs(cut.area - median))
    like = [cut for cut in cuts if own.large <= cut.area / median <= 1.0 / own.large]
    return min(
        like or [nearest],  # of an even number none may be near to the median
        key=lambda cut: (shapely.get_num_coordinates(cut), abs(cut.area - median)),
    )


def _cut(corners: Floats, height_m: float, own: CutParameters) -> list[shapely.Polygon]:
    """What lies inside of the walls at a height."""
    over = corners[:, :, 2] - height_m
    crossed = (over.min(axis=1) < 0.0) & (over.max(axis=1) >= 0.0)
    own_corners, over = corners[crossed], over[crossed]
    after, below = np.roll(own_corners, -1, axis=1), np.roll(over, -1, axis=1)
    is_end = (over < 0.0) != (below < 0.0)  # two of the three sides of each
    share = np.divide(over, over - below, out=np.zeros_like(over), where=is_end)[:, :, None]
    ends = own_corners + share * (after - own_corners)
    places = ends[is_end][:, :2].reshape(-1, 2, 2)
    places = np.round(places / own.snap_m) * own.snap_m
    places = places[(places[:, 0] != places[:, 1]).any(axis=1)]
    if not len(places):
        return []
    lines = shapely.unary_union(shapely.linestrings(places), grid_size=own.snap_m)
    rings = shapely.polygonize(shapely.get_parts(lines))
    inside = shapely.union_all(shapely.get_parts(rings), grid_size=own.snap_m)
    filled = [shapely.Polygon(one.exterior) for one in _polygons(inside)]
    return _polygons(shapely.simplify(shapely.union_all(filled), own.straight_m))


def _polygons(some: shapely.Geometry) -> list[shapely.Polygon]:
    return [one for one in shapely.get_parts(some).tolist() if isinstance(one, shapely.Polygon)]


def _lot(name: str, outline: shapely.Polygon, ground_m: float) -> Lot:
    ring = shapely.get_coordinates(shapely.orient_polygons(outline).exterior)[:-1]
    anchor = ring.mean(axis=0)
    return Lot(name, name, (ring - anchor,), (float(anchor[0]), float(anchor[1]), ground_m))
