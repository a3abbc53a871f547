"""Which wall of an existing building a front is put on: an edge of a polygon in a file of lots.

Read is what `veduta grammar` reads lots from, and a model of a building in glTF. The body is a box
behind the edge, as deep as the footprint is there in the mean.
"""

from __future__ import annotations

import contextlib
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta.facade.model_walls import SUFFIXES, read_model_lots
from veduta.facade.options import FacadeOptions, OntoOptions
from veduta.facade.scale import LARGEST_SIDE_M, SMALLEST_SIDE_M, is_possible
from veduta.facade.wall import Vector, Wall, facing
from veduta.grammar.lot import Lot
from veduta.grammar.lots import Lots, read_lots
from veduta.grammar.options import LotOptions
from veduta.run.errors import InputError

MOST_NAMED = 12
"""Polygons or edges that an error lists."""
SAME_LENGTH = 0.99
"""Edges that have this share of the longest one's length are as long."""
NEAR_M = 1e-6
"""A piece of a ray that begins so near to the edge begins at it, not behind a courtyard (m)."""


def on_wall(options: FacadeOptions) -> FacadeOptions:
    """The options of a photo whose front is put on a wall: with the wall, and what follows of it.

    Its width gives the scale and its footprint the depth, where the options have none. InputError
    where there is no such wall.
    """
    if options.onto.onto is None:
        for name, value in options.onto.model_dump(exclude_defaults=True).items():
            if value is not None:
                raise InputError(
                    f"--{name} {value}",
                    "is of a footprint, and none is named",
                    "Name its file with --onto, or leave it out.",
                )
        return options
    wall = read_wall(options.onto.onto, options.onto)
    model, scale = options.model, options.scale
    if model.depth_m is None:
        model = model.model_copy(update={"depth_m": wall.depth_m})
    if not scale.is_given:
        scale = scale.model_copy(update={"width_m": wall.width_m})
    return options.model_copy(update={"model": model, "scale": scale, "wall": wall})


def read_wall(path: Path, options: OntoOptions) -> Wall:
    """The wall that is asked for, or the one that most looks like a front."""
    with contextlib.closing(_lots(path, options)) as lots:
        lot = _lot(path, lots, options.lot)
    ring = lot.rings_m[0]
    edge, chosen = _edge(path, lot, options.edge)
    start, end = ring[edge], ring[(edge + 1) % len(ring)]
    width = float(np.linalg.norm(end - start))
    if not is_possible(width):
        raise InputError(
            f"--edge {edge}",
            f"is {width:.3g} m wide, not between {SMALLEST_SIDE_M:g} and {LARGEST_SIDE_M:g} m,"
            f" in {path}: {_edges(ring)}",
            "Give another edge.",
        )
    polygon = shapely.Polygon(ring, lot.rings_m[1:])
    depth = _depth_behind(polygon, start, end)
    box = _behind(start, end, depth)
    union = polygon.union(box).area
    if not is_possible(depth):
        raise InputError(
            f"{path}: {lot.name}",
            f"is {depth:.3g} m deep behind edge {edge},"
            f" not between {SMALLEST_SIDE_M:g} and {LARGEST_SIDE_M:g} m",
            f"Give another edge: {_edges(ring)}.",
        )
    return Wall(
        footprint=path.name,
        lot=lot.name,
        edge=edge,
        start_m=_at(start, lot),
        end_m=_at(end, lot),
        depth_m=depth,
        overlap=round(polygon.intersection(box).area / union, 4),
        crs=lots.crs,
        origin_m=lots.origin_m,
        chosen=chosen,
    )


def _lots(path: Path, options: OntoOptions) -> Lots:
    """The polygons of a file of lots, or the outlines of a model's walls."""
    told = options.model_dump(include=set(LotOptions.model_fields), exclude_defaults=True)
    if path.suffix.lower() not in SUFFIXES:
        return read_lots(path, LotOptions.model_validate(told))
    if told:
        raise InputError(
            f"--{next(iter(told))}", f"is of files of lots, and {path} is a model", "Leave it out."
        )
    return read_model_lots(path)


def _lot(path: Path, lots: Lots, asked: str | None) -> Lot:
    """The only polygon, or the one of this name or id."""
    found = [lot for lot in lots.lots if asked is None or asked in (lot.id, lot.name)]
    if len(found) == 1:
        return found[0]
    names = [lot.id for lot in (found or lots.lots)]
    told = ", ".join(names[:MOST_NAMED]) + (", ..." if len(names) > MOST_NAMED else "")
    if asked is not None and not found:
        raise InputError(f"--lot {asked}", f"is no polygon of {path}", f"It has: {told}.")
    raise InputError(
        path, f"has {len(names)} polygons that may be meant", f"Give --lot with one of: {told}."
    )


def _edge(path: Path, lot: Lot, asked: int | None) -> tuple[int, str]:
    """The number of the edge, and why it is this one."""
    ring = lot.rings_m[0]
    if asked is not None:
        if not 0 <= asked < len(ring):
            raise InputError(
                f"--edge {asked}",
                f"but {lot.name} in {path} has {len(ring)} edges: {_edges(ring)}",
                f"Give one of 0 to {len(ring) - 1}.",
            )
        return asked, "as asked"
    if "streetDistance" in lot.attributes:
        return 0, "the one on the street; --edge takes another"  # where `read_lots` has it begin
    steps = np.roll(ring, -1, axis=0) - ring
    lengths = np.linalg.norm(steps, axis=1)
    longest = np.flatnonzero(lengths >= SAME_LENGTH * lengths.max())
    southern = longest[np.argmax((steps[:, 0] / lengths)[longest])]
    why = "the longest" if len(longest) == 1 else "of the longest the one most to the south"
    return int(southern), f"{why}; --edge takes another"


def _edges(ring: NDArray[np.float64]) -> str:
    """The edges with their lengths and where they look."""
    told = []
    for number, start in enumerate(ring[:MOST_NAMED]):
        end = ring[(number + 1) % len(ring)]
        way = facing((*start.tolist(), 0.0), (*end.tolist(), 0.0))
        told.append(f"{number} ({np.linalg.norm(end - start):.1f} m, {way})")
    return ", ".join(told) + (", ..." if len(ring) > MOST_NAMED else "")


def _depth_behind(
    polygon: shapely.Polygon, start: NDArray[np.float64], end: NDArray[np.float64]
) -> float:
    """Mean way from the edge straight inwards to where the footprint ends first (m).

    From corner to corner, seen along the edge, it changes evenly: that in the middle is the mean.
    """
    corners = shapely.get_coordinates(polygon)
    width = float(np.linalg.norm(end - start))
    along = (end - start) / width
    reach = 2.0 * float(np.ptp(corners, axis=0).sum())
    inwards = reach * np.array([-along[1], along[0]])
    places = np.clip((corners - start) @ along, 0.0, width)
    bounds = np.unique(np.concatenate([[0.0, width], places]))
    feet = start + np.outer((bounds[:-1] + bounds[1:]) / 2.0, along)
    rays = shapely.linestrings(np.stack([feet, feet + inwards], axis=1))
    pieces, ray_of = shapely.get_parts(shapely.intersection(rays, polygon), return_index=True)
    first = shapely.distance(pieces, shapely.points(feet[ray_of])) <= NEAR_M
    ways = np.zeros(len(feet))
    np.maximum.at(ways, ray_of[first], shapely.length(pieces[first]))
    return float(ways @ np.diff(bounds)) / width


def _behind(
    start: NDArray[np.float64], end: NDArray[np.float64], depth_m: float
) -> shapely.Polygon:
    """The rectangle behind an edge; the inside of the footprint lies left of it."""
    east, north = (end - start) / np.linalg.norm(end - start)
    inwards = depth_m * np.array([-north, east])
    return shapely.Polygon([start, end, end + inwards, start + inwards])


def _at(corner: NDArray[np.float64], lot: Lot) -> Vector:
    x, y, z = lot.anchor_m
    return (float(corner[0]) + x, float(corner[1]) + y, z)
