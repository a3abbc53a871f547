"""Surfaces from volumes: extraction, simplification, textures."""

from veduta.surfaces.extraction import surface_nets

__all__ = ["surface_nets"]
