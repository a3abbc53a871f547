"""Surfaces: extraction, simplification, directions, distances, textures from photos, holes.

What is here is brought when it is first asked for: who fills holes waits for no cameras.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.surfaces.adjacency import neighbours
    from veduta.surfaces.distances import distances_from_mesh
    from veduta.surfaces.extraction import surface_nets
    from veduta.surfaces.filling.options import FillParameters, RepeatParameters
    from veduta.surfaces.filling.repeating import Repeated, fill_by_repeats
    from veduta.surfaces.filling.step import Filled, fill_holes
    from veduta.surfaces.normals import face_normals, vertex_normals
    from veduta.surfaces.pieces import compact, vertex_pieces
    from veduta.surfaces.simplification import Simplified, simplify
    from veduta.surfaces.texturing.carried import CarryParameters, carry_texture
    from veduta.surfaces.texturing.islands import own_texture
    from veduta.surfaces.texturing.options import SurfaceView, TextureOptions, TextureParameters
    from veduta.surfaces.texturing.photos import surface_views
    from veduta.surfaces.texturing.step import TexturedMesh, texture_mesh

__all__ = [
    "CarryParameters",
    "FillParameters",
    "Filled",
    "RepeatParameters",
    "Repeated",
    "Simplified",
    "SurfaceView",
    "TextureOptions",
    "TextureParameters",
    "TexturedMesh",
    "carry_texture",
    "compact",
    "distances_from_mesh",
    "face_normals",
    "fill_by_repeats",
    "fill_holes",
    "neighbours",
    "own_texture",
    "simplify",
    "surface_nets",
    "surface_views",
    "texture_mesh",
    "vertex_normals",
    "vertex_pieces",
]

_LATE = {
    "CarryParameters": "texturing.carried",
    "FillParameters": "filling.options",
    "Filled": "filling.step",
    "RepeatParameters": "filling.options",
    "Repeated": "filling.repeating",
    "Simplified": "simplification",
    "SurfaceView": "texturing.options",
    "TextureOptions": "texturing.options",
    "TextureParameters": "texturing.options",
    "TexturedMesh": "texturing.step",
    "carry_texture": "texturing.carried",
    "compact": "pieces",
    "distances_from_mesh": "distances",
    "face_normals": "normals",
    "fill_by_repeats": "filling.repeating",
    "fill_holes": "filling.step",
    "neighbours": "adjacency",
    "own_texture": "texturing.islands",
    "simplify": "simplification",
    "surface_nets": "extraction",
    "surface_views": "texturing.photos",
    "texture_mesh": "texturing.step",
    "vertex_normals": "normals",
    "vertex_pieces": "pieces",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
