"""The textured model as files: CityJSON with its pictures, GLBs, tiles, parts of the place.

model.city.json            all buildings; names the pictures
textures/ID-N.jpg          the atlases, and textures/ID-N_mask.png: white is invented
parts/ID.glb               a building that photos show anything of
parts/surroundings-N.glb   up to 2000 of the others, in a plain colour
tileset.json               all of them as 3D Tiles, on the Earth where the CRS is known
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.formats.cityjson_textured import TexturedPart, write_textured
from veduta.formats.tiles import Box, Tile, union, write_tileset
from veduta.geometry.ecef import Grid, ecef_from_grid, grid_of_crs
from veduta.photos.city.model import CityModel
from veduta.photos.texture.part import TexturedBuilding
from veduta.photos.texture.recipe import TexturedModel
from veduta.photos.texture.surroundings import surroundings_of
from veduta.place.manifest import PlacePart
from veduta.place.part import Part
from veduta.place.place import ModelFile, Place, Standing
from veduta.run.atomic import write_bytes
from veduta.run.progress import StepProgress, no_progress

CITY, TEXTURES, PARTS, TILESET = "model.city.json", "textures", "parts", "tileset.json"
JPEG_QUALITY = 90
LEAF = 8
"""Files below one node of the tree of tiles."""
_LONGEST_NAME = 60


@dataclass(frozen=True)
class TextureFiles:
    """What lies in the folder.

    parts: for the place, the textured buildings in the model's order, then the surroundings.
    pictures: the atlases. plain: how many buildings no photo shows.
    """

    parts: tuple[PlacePart, ...]
    pictures: tuple[str, ...]
    plain: int


@dataclass(frozen=True)
class _Leaf:
    """A file below `parts/`, and what the place and the tiles say of it."""

    place: PlacePart
    offset_m: tuple[float, float, float]
    box: Box


def write_texture_files(
    model: TexturedModel,
    folder: Path,
    progress: StepProgress = no_progress,
    made: Callable[[TexturedBuilding], None] = lambda _: None,
) -> TextureFiles:
    """Write all of it into a folder that is there. Each building is told to `made`, and let go."""
    for name in (TEXTURES, PARTS):
        (folder / name).mkdir(exist_ok=True)
    everyone = model.city.buildings
    names = file_names([building.id for building in everyone])
    pictures: list[str] = []
    city: dict[int, TexturedPart] = {}
    leaves: dict[int, _Leaf] = {}
    for building in model.buildings:
        own = _write_atlases(building, names[building.row], folder)
        pictures += own.values()
        leaves[building.row] = _write_part(
            building.part, building.offset_m, names[building.row], folder
        )
        bare = replace(building.part, materials=())
        city[building.row] = TexturedPart(bare, building.offset_m, own, building.polygon_seen)
        made(building)
    progress("texture: write", 0.0)
    plain = [row for row in range(len(everyone)) if row not in city]
    shared = surroundings_of(model.city, plain)
    others = file_names([*names, *(one.part.id for one in shared)])[len(names) :]
    written = [leaves[row] for row in sorted(leaves)]
    for one, name in zip(shared, others, strict=True):
        written.append(_write_part(one.part, one.offset_m, name, folder))
    for row in plain:
        seen = np.zeros(len(everyone[row].part.polygon_feature))
        city[row] = TexturedPart(everyone[row].part, everyone[row].offset_m, {}, seen)
    order = [city[row] for row in range(len(everyone))]
    write_textured(order, model.city.crs, model.city.origin_m, folder / CITY)
    write_tileset(_tile_tree(model.city, written), folder / TILESET)
    return TextureFiles(tuple(leaf.place for leaf in written), tuple(pictures), len(plain))


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


def _write_part(part: Part, offset_m: tuple[float, float, float], name: str, folder: Path) -> _Leaf:
    """Write the part alone: a city has too many to be held together."""
    transform = np.eye(4)
    transform[:3, 3] = offset_m
    told = part.id[:256]
    placed = Place().add(
        part, Standing(told, transform), ModelFile(f"{PARTS}/{name}.glb"), part_id=told
    )
    return _Leaf(placed.save(folder), offset_m, part.bounds_m)


def _tile_tree(city: CityModel, written: Sequence[_Leaf]) -> Tile:
    """A tile per file, few below each node; all shown at once where they are near."""
    grid = grid_of_crs(city.crs)
    earth = None if grid is None else _on_earth(grid, city, (0.0, 0.0, 0.0))
    leaves = []
    for leaf in written:
        local: NDArray[np.float64] = np.eye(4)
        local[:3, 3] = leaf.offset_m
        if grid is not None and earth is not None:
            local[:] = np.linalg.solve(earth, _on_earth(grid, city, leaf.offset_m))
        leaves.append((local, Tile(leaf.box, 0.0, leaf.place.model, (), local, leaf.offset_m)))
    root = _node(leaves)
    return Tile(root.box, root.error_m, None, root.children, earth, (0.0, 0.0, 0.0))


def _on_earth(
    grid: Grid, city: CityModel, place_m: tuple[float, float, float]
) -> NDArray[np.float64]:
    x, y, z = (np.array(city.origin_m) + place_m).tolist()
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
