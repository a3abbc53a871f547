"""`--tiles`: the mesh as 3D Tiles beside its place, which the studio fetches as it needs them."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from veduta.dense.build.levels import Level, LevelParameters, levels_of
from veduta.formats.part_tile import mesh_tile
from veduta.formats.place_json import name_tileset
from veduta.formats.tiles import Box, Tile, write_tileset
from veduta.place.mesh import Mesh
from veduta.place.place import PlacedPart
from veduta.run.atomic import write_bytes
from veduta.run.work import Work
from veduta.surfaces import carry_texture, own_texture
from veduta.surfaces.texturing.charts import TooLargeError

FOLDER, TILESET = "tiles", "tileset.json"
QUALITY = 88
MOST_WEBP_PX = 16_383


def write_tiles(work: Work, placed: PlacedPart, parameters: LevelParameters | None = None) -> None:
    """Write the levels of a mesh of the place in the work's folder; its manifest names them."""
    mesh = placed.content
    if not isinstance(mesh, Mesh):
        return
    with work.step("tiles") as step:
        folder = work.folder / FOLDER
        folder.mkdir(exist_ok=True)
        rule = parameters or LevelParameters()
        tree = levels_of(mesh, rule)
        every = list(tree.all())
        for number, level in enumerate(every):
            work.progress("tiles", number / len(every))
            try:
                content = content_of(mesh, level, rule)
            except TooLargeError as error:
                step.rejected.append(f"{level.name}: coloured without a picture: {error}")
                content = level.plain or replace(part_of(mesh, level.triangles), uv=None)
            content = _beside(folder, level.name, content)
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


def content_of(mesh: Mesh, level: Level, parameters: LevelParameters) -> Mesh:
    """What a piece shows: its triangles, with a picture of its own where the mesh has a texture.

    That of a plainer piece is at most `picture_px` a side: of four pieces it has the same spots
    with half of the pixels along a side. TooLargeError where the picture has no room for them.
    """
    if mesh.uv is None or mesh.materials[0].texture is None:
        return level.plain or part_of(mesh, level.triangles)
    piece = part_of(mesh, level.triangles)
    if level.plain is None:
        return own_texture(piece, 1.0, MOST_WEBP_PX)
    shown = carry_texture(piece, level.plain.positions_m, level.plain.triangles)
    return own_texture(shown, 1.0, parameters.picture_px)


def _beside(folder: Path, name: str, mesh: Mesh) -> Mesh:
    """The mesh with its texture as a file beside it."""
    texture = mesh.materials[0].texture
    if texture is None:
        return mesh
    data = io.BytesIO()
    Image.fromarray(texture.pixels).save(data, "WEBP", quality=QUALITY)
    write_bytes(folder / f"{name}.webp", data.getvalue())
    material = replace(mesh.materials[0], texture=None)
    return replace(mesh, materials=(material,), pictures={material.name: f"{name}.webp"})


def _tile(level: Level) -> Tile:
    low, high = level.box.tolist()
    box: Box = (tuple(low), tuple(high))
    children = tuple(map(_tile, level.children))
    return Tile(box, level.error_m, f"{level.name}.glb", children)
