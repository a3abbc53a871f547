"""Stereo views along a path become a walk on which geometry and texture morph from view to view."""

from veduta.walk.command import Sources, run_walk
from veduta.walk.options import (
    BoardOptions,
    MorphOptions,
    PhotoOptions,
    PlayOptions,
    TakeOptions,
    WalkOptions,
)

__all__ = [
    "BoardOptions",
    "MorphOptions",
    "PhotoOptions",
    "PlayOptions",
    "Sources",
    "TakeOptions",
    "WalkOptions",
    "run_walk",
]
