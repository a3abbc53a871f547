"""Surfaces: extraction, simplification, directions, distances, textures from photos, holes."""

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
