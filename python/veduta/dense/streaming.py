"""`--tiles`: the mesh as 3D Tiles beside its place, which the studio fetches as it needs them."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
from PIL import Image

from veduta.dense.build.levels import Level, levels_of
from veduta.formats.part_tile import mesh_tile
from veduta.formats.place_json import name_tileset
from veduta.formats.tiles import Box, Tile, write_tileset
from veduta.place.mesh import Mesh
from veduta.place.place import PlacedPart
from veduta.run.atomic import write_bytes
from veduta.run.work import Work

FOLDER, TILESET, ATLAS = "tiles", "tileset.json", "atlas.webp"
QUALITY = 88
MOST_WEBP_PX = 16_383


def write_tiles(work: Work, placed: PlacedPart) -> None:
    """Write the levels of a mesh of the place in the work's folder; its manifest names them."""
    mesh = placed.content
    if not isinstance(mesh, Mesh):
        return
    with work.step("tiles") as step:
        folder = work.folder / FOLDER
        folder.mkdir(exist_ok=True)
        fine = _with_picture(work, mesh)
        tree = levels_of(mesh)
        every = list(tree.all())
        for level in every:
            content = level.plain or part_of(fine, level.triangles)
            write_bytes(folder / f"{level.name}.glb", mesh_tile(content, placed.id))
        root = replace(_tile(tree), transform=placed.standing.transform)
        write_tileset(root, folder / TILESET)
        name_tileset(work.folder / "place.json", f"{FOLDER}/{TILESET}")
        step.counts.update(tiles=len(every), finest=sum(not one.children for one in every))
        work.measure("coarsest_tile_within_m", round(tree.error_m, 4))
    work.file(f"{FOLDER}/", "the mesh in levels of detail (3D Tiles 1.1): what the studio fetches")


def part_of(mesh: Mesh, chosen: np.ndarray[tuple[int, ...], np.dtype[np.intp]]) -> Mesh:
    """Some triangles of a mesh, and the vertices that they have."""
    used, place = np.unique(mesh.triangles[chosen], return_inverse=True)
    return replace(
        mesh,
        positions_m=mesh.positions_m[used],
        triangles=place.reshape(-1, 3).astype(np.uint32),
        triangle_feature=mesh.triangle_feature[chosen],
        triangle_material=mesh.triangle_material[chosen],
        normals=mesh.vertex_normals[used],
        uv=None if mesh.uv is None else mesh.uv[used],
        colours=None if mesh.colours is None else mesh.colours[used],
    )


def _with_picture(work: Work, mesh: Mesh) -> Mesh:
    """The mesh with its texture in a file that all tiles share."""
    texture = mesh.materials[0].texture
    if texture is None or max(texture.pixels.shape) > MOST_WEBP_PX:
        return mesh
    data = io.BytesIO()
    Image.fromarray(texture.pixels).save(data, "WEBP", quality=QUALITY)
    write_bytes(work.folder / FOLDER / ATLAS, data.getvalue())
    material = replace(mesh.materials[0], texture=None)
    return replace(mesh, materials=(material,), pictures={material.name: ATLAS})


def _tile(level: Level) -> Tile:
    low, high = level.box.tolist()
    box: Box = (tuple(low), tuple(high))
    children = tuple(map(_tile, level.children))
    return Tile(box, level.error_m, f"{level.name}.glb", children)
