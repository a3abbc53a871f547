"""Street laser scans and images become textured facade meshes without what stood before them.

Frueh, Jain and Zakhor 2005, Data Processing Algorithms for Generating Textured 3D Building Facade
Meshes from Laser Scans and Camera Images.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.drive.command import run_drive
    from veduta.drive.options import DriveOptions

__all__ = ["DriveOptions", "run_drive"]

_LATE = {
    "DriveOptions": "options",
    "run_drive": "command",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
