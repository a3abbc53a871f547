"""Photos with silhouettes become a closed, coloured object: `veduta carve`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.carve.command import run_carve
    from veduta.carve.options import CarveOptions, ColourOptions, SilhouetteOptions, VolumeOptions

__all__ = ["CarveOptions", "ColourOptions", "SilhouetteOptions", "VolumeOptions", "run_carve"]

_LATE = {
    "CarveOptions": "options",
    "ColourOptions": "options",
    "SilhouetteOptions": "options",
    "VolumeOptions": "options",
    "run_carve": "command",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
