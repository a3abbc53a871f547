"""Surfaces: extraction from volumes, simplification, directions, textures from photos."""

from veduta.surfaces.adjacency import neighbours
from veduta.surfaces.extraction import surface_nets
from veduta.surfaces.normals import face_normals, vertex_normals
from veduta.surfaces.simplification import Simplified, simplify
from veduta.surfaces.texturing.options import SurfaceView, TextureOptions, TextureParameters
from veduta.surfaces.texturing.step import TexturedMesh, texture_mesh

__all__ = [
    "Simplified",
    "SurfaceView",
    "TextureOptions",
    "TextureParameters",
    "TexturedMesh",
    "face_normals",
    "neighbours",
    "simplify",
    "surface_nets",
    "texture_mesh",
    "vertex_normals",
]
