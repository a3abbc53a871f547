"""The textured model as files: CityJSON with its pictures, a GLB per building, tiles, parts.

model.city.json       all buildings; names the pictures
textures/ID-N.jpg     the atlases, and textures/ID-N_mask.png: white is invented
parts/ID.glb          a building
tileset.json          the buildings as 3D Tiles, on the Earth where the CRS is known
"""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.formats.cityjson_textured import TexturedPart, write_textured
from veduta.formats.gltf import write_glb
from veduta.formats.tiles import Box, Tile, union, write_tileset
from veduta.geometry.ecef import Grid, ecef_from_grid, grid_of_crs
from veduta.photos.texture.part import TexturedBuilding
from veduta.photos.texture.recipe import TexturedModel
from veduta.place.manifest import IDENTITY, Bounds, PlacePart
from veduta.run.atomic import write_bytes
from veduta.run.progress import StepProgress, no_progress

CITY, TEXTURES, PARTS, TILESET = "model.city.json", "textures", "parts", "tileset.json"
JPEG_QUALITY = 90
LEAF = 8
"""Buildings below one node of the tree of tiles."""
_LONGEST_NAME = 60


@dataclass(frozen=True)
class TextureFiles:
    """What lies in the folder. parts: for `place.json`, in the order of the buildings."""

    parts: tuple[PlacePart, ...]
    pictures: tuple[str, ...]


def write_texture_files(
    model: TexturedModel, folder: Path, progress: StepProgress = no_progress
) -> TextureFiles:
    """Write all of it into a folder that is there."""
    for name in (TEXTURES, PARTS):
        (folder / name).mkdir(exist_ok=True)
    names = file_names([building.id for building in model.buildings])
    pictures: list[str] = []
    city, parts = [], []
    for number, (building, name) in enumerate(zip(model.buildings, names, strict=True)):
        progress("texture: write", number / len(names))
        own = _write_atlases(building, name, folder)
        pictures += own.values()
        write_glb(building.part, folder / PARTS / f"{name}.glb")
        city.append(TexturedPart(building.part, building.offset_m, own, building.polygon_seen))
        parts.append(_place_part(building, name))
    write_textured(city, model.city.crs, model.city.origin_m, folder / CITY)
    write_tileset(tile_tree(model, names), folder / TILESET)
    return TextureFiles(tuple(parts), tuple(pictures))


def file_names(ids: Sequence[str]) -> list[str]:
    """A name for each id that every system takes; ids that become the same get numbers."""
    found: list[str] = []
    taken: set[str] = set()
    for one in ids:
        plain = re.sub(r"[^A-Za-z0-9._-]+", "-", one).strip("-.")[:_LONGEST_NAME] or "building"
        name, number = plain, 1
        while name.lower() in taken:
            number += 1
            name = f"{plain}-{number}"
        taken.add(name.lower())
        found.append(name)
    return found


def _write_atlases(building: TexturedBuilding, name: str, folder: Path) -> dict[int, str]:
    """The pictures by the numbers of their materials."""
    found = {}
    for row in range(building.atlases):
        texture = building.part.materials[row].texture
        if texture is None:
            continue
        found[row] = f"{TEXTURES}/{name}-{row}.jpg"
        write_bytes(folder / found[row], _encoded(texture.pixels, "JPEG"))
        mask = texture.invented.astype(np.uint8) * 255
        write_bytes(folder / TEXTURES / f"{name}-{row}_mask.png", _encoded(mask, "PNG"))
    return found


def _encoded(pixels: NDArray[np.uint8], kind: str) -> bytes:
    file = io.BytesIO()
    if kind == "JPEG":
        Image.fromarray(pixels).save(file, kind, quality=JPEG_QUALITY, optimize=True)
    else:
        Image.fromarray(pixels).convert("1").save(file, kind, optimize=True)
    return file.getvalue()


def _place_part(building: TexturedBuilding, name: str) -> PlacePart:
    transform = list(IDENTITY)
    transform[12:15] = building.offset_m
    low, high = building.part.bounds_m
    return PlacePart(
        id=building.id[:256],
        name=building.id[:256],
        model=f"{PARTS}/{name}.glb",
        transform=tuple(transform),
        arrangement="single",
        bounds=Bounds(min=low, max=high),
    )


def tile_tree(model: TexturedModel, names: Sequence[str]) -> Tile:
    """A tile per building, few below each node; all shown at once where they are near."""
    grid = grid_of_crs(model.city.crs)
    earth = None if grid is None else _on_earth(grid, model, (0.0, 0.0, 0.0))
    leaves = []
    for building, name in zip(model.buildings, names, strict=True):
        local: NDArray[np.float64] = np.eye(4)
        local[:3, 3] = building.offset_m
        if grid is not None and earth is not None:
            local[:] = np.linalg.solve(earth, _on_earth(grid, model, building.offset_m))
        box = building.part.bounds_m
        content = f"{PARTS}/{name}.glb"
        leaves.append((local, Tile(box, 0.0, content, (), local, building.offset_m)))
    root = _node(leaves)
    return Tile(root.box, root.error_m, None, root.children, earth, (0.0, 0.0, 0.0))


def _on_earth(
    grid: Grid, model: TexturedModel, place_m: tuple[float, float, float]
) -> NDArray[np.float64]:
    x, y, z = (np.array(model.city.origin_m) + place_m).tolist()
    return ecef_from_grid(grid, (x, y, z))


def _node(leaves: Sequence[tuple[NDArray[np.float64], Tile]]) -> Tile:
    """Halved along the longer side of the places until few are left."""
    box = union(_moved(tile.box, local) for local, tile in leaves)
    size = float(np.linalg.norm(np.subtract(box[1], box[0])))
    if len(leaves) <= LEAF:
        return Tile(box, size / 4, None, tuple(tile for _, tile in leaves))
    places = np.array([local[:2, 3] for local, _ in leaves])
    axis = int(np.ptp(places, axis=0).argmax())
    order = np.argsort(places[:, axis], kind="stable").tolist()
    half = len(order) // 2
    children = tuple(_node([leaves[row] for row in rows]) for rows in (order[:half], order[half:]))
    return Tile(box, size / 4, None, children)


def _moved(box: Box, local: NDArray[np.float64]) -> Box:
    corners = np.array([[x, y, z] for x, y, z in _corners(box)])
    moved = corners @ local[:3, :3].T + local[:3, 3]
    low, high = moved.min(axis=0).tolist(), moved.max(axis=0).tolist()
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def _corners(box: Box) -> list[tuple[float, float, float]]:
    (x0, y0, z0), (x1, y1, z1) = box
    return [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
