"""Stereo views along a path become a walk on which geometry and texture morph from view to view."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
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

_LATE = {
    "BoardOptions": "options",
    "MorphOptions": "options",
    "PhotoOptions": "options",
    "PlayOptions": "options",
    "Sources": "command",
    "TakeOptions": "options",
    "WalkOptions": "options",
    "run_walk": "command",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
