"""Footage of an animal becomes a living 3D animal in the place (`veduta fauna`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.fauna.command import run_fauna
    from veduta.fauna.options import FaunaOptions
    from veduta.fauna.recipe import Record

__all__ = ["FaunaOptions", "Record", "run_fauna"]

_LATE = {
    "FaunaOptions": "options",
    "Record": "recipe",
    "run_fauna": "command",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
