"""Each segment in levels of detail: far off fewer triangles and a smaller picture (3D Tiles)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.lighter import lighten
from veduta.drive.build.outcome import Outcome, placed_meshes
from veduta.drive.build.segment import Textured
from veduta.formats.part_tile import mesh_tile
from veduta.formats.tiles import Box, Tile, union, write_tileset
from veduta.place.mesh import Mesh
from veduta.run.atomic import write_bytes

FOLDER, TILESET = "tiles", "tileset.json"


@dataclass(frozen=True)
class LevelParameters:
    """errors_m: of the coarser levels' surfaces, finest first. smaller: how many times smaller
    their pictures are along both axes, so that a texel is about as large as the error.
    """

    errors_m: tuple[float, ...] = (0.12, 0.5)
    smaller: tuple[int, ...] = (4, 16)


def coarser(textured: Textured, error_m: float, smaller: int) -> tuple[Textured, float]:
    """A segment with fewer triangles and a smaller atlas, and its error (m)."""
    surface, reached = lighten(textured.surface, error_m)
    height, width = textured.atlas.seen.shape
    size = (max(width // smaller, 1), max(height // smaller, 1))

    def mask(given: NDArray[np.bool_]) -> NDArray[np.bool_]:
        share = cv2.resize(given.astype(np.float32), size, interpolation=cv2.INTER_AREA)
        return np.asarray(share > 0.5)

    def picture(given: NDArray[np.uint8]) -> NDArray[np.uint8]:
        small: NDArray[Any] = cv2.resize(given, size, interpolation=cv2.INTER_AREA)
        return np.asarray(small, dtype=np.uint8)

    atlas = replace(
        textured.atlas,
        pixels=picture(textured.atlas.pixels),
        seen=mask(textured.atlas.seen),
        surface=mask(textured.atlas.surface),
        row=textured.atlas.row * size[1] / height,
        column=textured.atlas.column * size[0] / width,
    )
    made = replace(
        textured,
        surface=surface,
        atlas=atlas,
        pixels=picture(textured.pixels),
        invented=mask(textured.invented),
        plain=mask(textured.plain),
    )
    return made, max(reached, error_m)


def write_levels(
    outcomes: Sequence[Outcome],
    lift_m: float,
    folder: Path,
    parameters: LevelParameters | None = None,
) -> int:
    """The tree in `folder`, a branch for the walls and one for the ground of each segment; how many
    tiles it has. lift_m: how much higher segments stand in the place than in the drive.
    """
    chosen = parameters or LevelParameters()
    (folder / FOLDER).mkdir()
    branches: list[Tile] = []
    count = 0
    for one in outcomes:
        textured = one.load()
        levels = [(textured, 0.0)]
        for error_m, smaller in zip(chosen.errors_m, chosen.smaller, strict=True):
            levels.append(coarser(textured, error_m, smaller))
        made = [
            {mesh.id: (mesh, standing.transform) for mesh, standing in placed_meshes(level, lift_m)}
            for level, _ in levels
        ]
        errors = [error for _, error in levels]
        for name in made[0]:
            rows = [(*level[name], error) for level, error in zip(made, errors, strict=True) if name in level]
            branches.append(_branch(name, rows, folder / FOLDER))
            count += len(rows)
    if branches:
        box = union(_moved(branch) for branch in branches)
        error = 2.0 * max(branch.error_m for branch in branches)
        write_tileset(Tile(box, error, None, tuple(branches)), folder / FOLDER / TILESET)
    return count


def _branch(
    name: str, levels: Sequence[tuple[Mesh, NDArray[np.float64], float]], folder: Path
) -> Tile:
    """One below the other, the coarsest at the top; each stands about its own middle."""
    tile: Tile | None = None
    boxes: list[Box] = []
    finest = levels[0][1]
    for number, (mesh, transform, error) in enumerate(levels):
        file = f"{name}-{number}.glb"
        shift = (transform - finest)[:3, 3]
        own = replace(mesh, positions_m=(mesh.positions_m + shift).astype(np.float32))
        write_bytes(folder / file, mesh_tile(own, name))
        boxes.append(own.bounds_m)
        tile = Tile(union(boxes), error, file, () if tile is None else (tile,))
    if tile is None:
        raise ValueError(f"{name} has no levels")
    x, y, z = finest[:3, 3].tolist()
    return replace(tile, transform=finest, world_m=(x, y, z))


def _moved(tile: Tile) -> Box:
    """A branch's box in the place."""
    by = np.zeros(3) if tile.transform is None else tile.transform[:3, 3]
    low, high = np.array(tile.box[0]) + by, np.array(tile.box[1]) + by
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])
