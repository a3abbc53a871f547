"""Where the buildings stand, and where a visitor begins."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.tiles import Box, Tile, union
from veduta.geometry.ecef import Grid, ecef_from_grid, grid_of_crs
from veduta.grammar.first_view import first_view
from veduta.grammar.ground import height_at
from veduta.grammar.ground_part import NAME
from veduta.grammar.joining import GroundFiles, part_id
from veduta.grammar.levels import BOXES_ERROR_M
from veduta.grammar.lots import Lots
from veduta.grammar.report import Whole
from veduta.grammar.squares import Square
from veduta.grammar.town import BOXES
from veduta.place.manifest import IDENTITY, Bounds, PlacePart, Start
from veduta.place.place import Place

EYE_M = 1.7
MAX_DISTANCE_M = 60.0


def place_of(
    lots: Lots, whole: Whole, grounds: Mapping[str, GroundFiles], out: Path, *, tileset: str | None
) -> Place:
    """The place of what was built: a part for each building, or else for each near tile.

    The ground between them follows, a part for each block that has some. All models lie in OUT
    already: the blocks have written them, one after another.
    """
    parts = [_part(lot) for lot in whole.rows] if whole.rows else _tiles(whole)
    origins = {name: summary["origin_m"] for name, summary in whole.blocks}
    fronts = [summary["front"] for _, summary in whole.blocks if summary["front"]]
    parts += [_ground(name, origins[name], files) for name, files in grounds.items()]
    start = _start(lots, fronts, grounds)
    place = Place(crs=lots.crs, origin_m=lots.origin_m, tileset=tileset, start=start)
    for row in parts:
        place.lay(row, out)
    return place


def town_of(
    lots: Lots, blocks: Sequence[Square], whole: Whole, grounds: Mapping[str, GroundFiles]
) -> Tile:
    """The tree over the tiles of all blocks, on the Earth where the place has a known CRS."""
    origin = {block.name: block.origin_m for block in blocks}
    grid = _grid(lots, blocks)
    ground = None if grid is None else _on_earth(grid, lots, (0.0, 0.0, 0.0))
    tiles = []
    boxes = []
    for name, summary in whole.blocks:
        if summary["box"] is None:
            continue
        own = origin[name]
        local: NDArray[np.float64] = np.eye(4)
        local[:3, 3] = own
        if grid is not None and ground is not None:
            local[:] = np.linalg.solve(ground, _on_earth(grid, lots, own))
        low, high = (tuple(corner) for corner in summary["box"])
        # A block is seen from afar before its own tree is asked for.
        inside = Tile((low, high), BOXES_ERROR_M, f"{name}/tiles/tileset.json")
        afar = f"{name}/tiles/{BOXES}"
        tiles.append(Tile((low, high), BOXES_ERROR_M, afar, (inside,), local, own))
        boxes.append(_moved((low, high), local))
        if name in grounds:
            around = grounds[name].box
            tiles.append(Tile(around, 0.0, grounds[name].tile, (), local, own))
            boxes.append(_moved(around, local))
    box = union(boxes)
    size = float(np.linalg.norm(np.array(box[1]) - np.array(box[0])))
    return Tile(box, max(4 * BOXES_ERROR_M, size / 4), None, tuple(tiles), ground, (0.0, 0.0, 0.0))


def placed_how(lots: Lots, blocks: Sequence[Square]) -> str:
    """Where on the Earth the tiles of lots stand, in words."""
    grid = _grid(lots, blocks)
    if grid is not None:
        within = "" if grid.accuracy_m is None else f" (right to {max(grid.accuracy_m, 0.1):g} m)"
        return f"the tiles stand on the Earth by {grid.name}{within}"
    if lots.crs is None:
        what = "the lots name no CRS"
    elif grid_of_crs(lots.crs) is None:
        what = f"{lots.crs} is no known projection in metres"
    else:
        what = f"{lots.crs} has no place where the lots lie"
    return f"{what}: the tiles stand in metres of their own, not on the Earth"


def _grid(lots: Lots, blocks: Sequence[Square]) -> Grid | None:
    """The projection of the lots; None where it is not known, or ends before one of the blocks."""
    grid = grid_of_crs(lots.crs)
    if grid is None:
        return None
    try:
        for place_m in ((0.0, 0.0, 0.0), *(block.origin_m for block in blocks)):
            _on_earth(grid, lots, place_m)
    except ValueError:
        return None
    return grid


def _on_earth(grid: Grid, lots: Lots, place_m: tuple[float, float, float]) -> NDArray[np.float64]:
    x, y, z = (np.array(lots.origin_m) + np.array(place_m)).tolist()
    return ecef_from_grid(grid, (x, y, z))


def _moved(box: Box, matrix: NDArray[np.float64]) -> Box:
    """The box around a box that is moved."""
    corners = np.array(list(itertools.product(*zip(*box, strict=True))))
    moved = corners @ matrix[:3, :3].T + matrix[:3, 3]
    low, high = moved.min(axis=0).tolist(), moved.max(axis=0).tolist()
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def _tiles(whole: Whole) -> list[PlacePart]:
    parts = []
    for name, summary in whole.blocks:
        for number, (model, count, (low, high)) in enumerate(summary["leaves"]):
            transform = list(IDENTITY)
            transform[12:15] = summary["origin_m"]
            parts.append(
                PlacePart(
                    id=f"{name.rpartition('/')[2]}-{number:03d}",
                    name=f"{count} buildings",
                    model=model,
                    transform=tuple(transform),
                    arrangement="single",
                    bounds=Bounds(min=tuple(low), max=tuple(high)),
                )
            )
    return parts


def _part(lot: Mapping[str, Any]) -> PlacePart:
    transform = list(IDENTITY)
    transform[12:15] = lot["anchor_m"]
    low, high = lot["bounds"]
    return PlacePart(
        id=lot["id"],
        name=lot["name"],
        model=lot["model"],
        transform=tuple(transform),
        arrangement="single",
        bounds=Bounds(min=tuple(low), max=tuple(high)),
    )


def _ground(name: str, origin_m: Sequence[float], files: GroundFiles) -> PlacePart:
    transform = list(IDENTITY)
    transform[12:15] = origin_m
    low, high = files.box
    return PlacePart(
        id=part_id(name),
        name=NAME,
        model=files.model or files.tile,
        transform=tuple(transform),
        arrangement="single",
        bounds=Bounds(min=low, max=high),
        ground=True,
    )


def _start(
    lots: Lots, built: Sequence[Mapping[str, Any]], grounds: Mapping[str, GroundFiles]
) -> Start:
    """At a man's height, where the first view of the lots is; south of all where they have none."""
    low = np.array([lot["bounds"][0] for lot in built]) + [lot["anchor_m"] for lot in built]
    high = np.array([lot["bounds"][1] for lot in built]) + [lot["anchor_m"] for lot in built]
    view = first_view(lots.lots, float(np.median(high[:, 2] - low[:, 2])))
    if view is None:
        middle, away = (low.min(axis=0) + high.max(axis=0)) / 2, MAX_DISTANCE_M
        return Start(eye=(middle[0], low[:, 1].min() - away, EYE_M), target=tuple(middle.tolist()))
    target = np.array(view.target_m)
    nearest = int(np.argmin(np.linalg.norm((low + high)[:, :2] / 2 - target, axis=1)))
    height = float(high[nearest, 2] - low[nearest, 2])
    ground = float(lots.lots[view.row].anchor_m[2])
    under = height_at([files.ground for files in grounds.values()], *view.eye_m)
    stand = under if under is not None else 0.0 if grounds else ground
    return Start(
        eye=(*view.eye_m, max(stand, 0.0) + EYE_M),
        target=(*view.target_m, ground + view.up * height),
    )
