"""Veduta turns records of real places into measured, semantic, walkable 3D."""

__version__ = "0.1.0"
