"""The one table of what places are read from and written to, by suffix.

A row names the function that writes, as `module:function`: what a format needs is imported when it
is asked for, not before.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from veduta.formats.mesh_glb_read import read_model
from veduta.formats.place_folder import load_place, save_part, save_place
from veduta.place.holding import (
    ANIMALS,
    CAMERAS,
    CLASSES,
    COLOURED_CORNERS,
    COLOURS,
    LAMPS,
    LEAVES,
    MOTION,
    POINTS,
    SURFACES,
    TEXTURES,
    TOURS,
    WALKS,
)
from veduta.place.registry import (
    PlaceFolders,
    PlaceFormat,
    register_folders,
    register_format,
    register_reader,
)

if TYPE_CHECKING:
    from veduta.place.place import Place

Write = Callable[["Place", Path], None]

_AROUND = (POINTS, CAMERAS, WALKS, ANIMALS)
_SCENE = (LEAVES, LAMPS, MOTION, TOURS, *_AROUND)
_USD = tuple(kind for kind in _SCENE if kind != MOTION)
_PLAIN = (TEXTURES, *_SCENE)
_CITY = (COLOURS, *_PLAIN)
_MAP = (SURFACES, TOURS, *_AROUND)
_POINTS = (SURFACES, CLASSES, TOURS, CAMERAS, WALKS, ANIMALS)
ROWS: tuple[tuple[str, str, str, str, tuple[str, ...]], ...] = (
    # suffix, name for --to, what it is, who writes it, what it has no word for
    (".glb", "glb", "glTF 2.0, one file", "place_glb:write_place_glb", _AROUND),
    (".obj", "obj", "Wavefront OBJ with MTL and textures", "place_obj:write_obj", _SCENE),
    (".stl", "stl", "STL", "place_stl:write_stl", (CLASSES, *_CITY)),
    (".usda", "usda", "USD as text, textures beside", "place_usd:write_usd", _USD),
    (".usdc", "usdc", "USD, binary, textures beside", "place_usd:write_usd", _USD),
    (".usd", "usd", "USD, textures beside", "place_usd:write_usd", _USD),
    (".usdz", "usdz", "USD with its textures in one file", "place_usd:write_usd", _USD),
    (
        ".dae",
        "dae",
        "COLLADA 1.4, textures beside",
        "place_dae:write_dae",
        (COLOURED_CORNERS, *_SCENE),
    ),
    (".geojson", "geojson", "GeoJSON of the outlines", "place_vector:write_geojson", _MAP),
    (".gpkg", "gpkg", "GeoPackage of the outlines", "place_vector:write_gpkg", _MAP),
    (".gml", "citygml", "CityGML 2.0", "place_citygml:write_citygml2", _CITY),
    (".3.gml", "citygml3", "CityGML 3.0", "place_citygml:write_citygml3", _CITY),
    (
        ".city.json",
        "cityjson",
        "CityJSON 2.0, textures beside",
        "place_cityjson:write_place_cityjson",
        (COLOURED_CORNERS, *_SCENE),
    ),
    (".ply", "ply", "PLY mesh with colours", "place_ply:write_ply", _PLAIN),
    (".x3d", "x3d", "X3D 4.0, textures in the file", "place_x3d:write_x3d", _SCENE),
    (".laz", "laz", "LAZ 1.4 of the points", "place_laz:write_place_laz", _POINTS),
)


READERS = {
    ".glb": "place_read:read_glb_place",
    ".obj": "place_read:read_obj_place",
    ".dae": "place_read:read_dae_place",
    ".stl": "place_read:read_trimesh_place",
    ".ply": "place_read:read_trimesh_place",
    ".gml": "city_place:read_city_place",
    ".3.gml": "city_place:read_city_place",
    ".city.json": "city_place:read_city_place",
}


READERS_ALONE = {
    ".tif": "raster_place:read_raster_place",
    ".tiff": "raster_place:read_raster_place",
}
"""Of formats that no place is written in."""


def _late(target: str) -> Write:
    module, name = target.split(":")

    def write(place: Place, path: Path) -> None:
        getattr(importlib.import_module(f"veduta.formats.{module}"), name)(place, path)

    return write


def _late_read(target: str) -> Callable[[Path], Place]:
    module, name = target.split(":")

    def read(path: Path) -> Place:
        found: Place = getattr(importlib.import_module(f"veduta.formats.{module}"), name)(path)
        return found

    return read


def _untiled(place: Place) -> Place:
    if place.tileset is None:
        return place
    from veduta.formats.tiled_town import untiled  # what reads city models takes a while to load

    return untiled(place)


register_folders(
    PlaceFolders(
        save=save_place,
        save_part=save_part,
        load=load_place,
        read_model=read_model,
        untiled=_untiled,
    )
)
for _suffix, _reader in READERS_ALONE.items():
    register_reader(_suffix, _late_read(_reader))
for _suffix, _name, _title, _target, _left_out in ROWS:
    _read = _late_read(READERS[_suffix]) if _suffix in READERS else None
    register_format(
        PlaceFormat(
            _suffix, _name, _late(_target), _title, _left_out, _read, points_alone=_suffix == ".ply"
        )
    )
