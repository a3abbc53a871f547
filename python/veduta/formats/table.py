"""The one table of what places are read from and written to, by suffix."""

from __future__ import annotations

from veduta.formats.mesh_glb_read import read_model
from veduta.formats.place_folder import load_place, save_place
from veduta.place.registry import PlaceFolders, register_folders

register_folders(PlaceFolders(save=save_place, load=load_place, read_model=read_model))
