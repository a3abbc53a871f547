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
from veduta.formats.place_folder import load_place, save_place
from veduta.place.registry import PlaceFolders, PlaceFormat, register_folders, register_format

if TYPE_CHECKING:
    from veduta.place.place import Place

Write = Callable[["Place", Path], None]

_SURFACES = "colours and textures"
_MOTION = "what moves, shines or is walked through (tours)"
ROWS: tuple[tuple[str, str, str, str, str], ...] = (
    # suffix, name for --to, what it is, who writes it, what it has no word for
    (".glb", "glb", "glTF 2.0, one file", "place_glb:write_place_glb", ""),
    (".obj", "obj", "Wavefront OBJ with MTL and textures", "place_obj:write_obj", _MOTION),
    (".stl", "stl", "STL", "place_stl:write_stl", f"classes, {_SURFACES}, {_MOTION}"),
    (".ply", "ply", "PLY mesh with colours", "place_ply:write_ply", f"textures, {_MOTION}"),
)


def _late(target: str) -> Write:
    module, name = target.split(":")

    def write(place: Place, path: Path) -> None:
        getattr(importlib.import_module(f"veduta.formats.{module}"), name)(place, path)

    return write


register_folders(PlaceFolders(save=save_place, load=load_place, read_model=read_model))
for _suffix, _name, _title, _target, _left_out in ROWS:
    register_format(PlaceFormat(_suffix, _name, _late(_target), _title, _left_out))
