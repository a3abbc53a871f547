"""Cameras of any source, and how a picture looks without what its lens did.

What is here is brought when it is first asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.cameras.board import Board, SheetName, print_board
    from veduta.cameras.board_cameras import BoardCameras, cameras_of_board
    from veduta.cameras.camera import Camera, CameraSet
    from veduta.cameras.digest import cameras_digest
    from veduta.cameras.lens import shown, straight_camera, undistorted
    from veduta.cameras.projection import Parted, part_projection
    from veduta.cameras.reading import read_cameras
    from veduta.cameras.scale import ScaleOptions, in_metres

__all__ = [
    "Board",
    "BoardCameras",
    "Camera",
    "CameraSet",
    "Parted",
    "ScaleOptions",
    "SheetName",
    "cameras_digest",
    "cameras_of_board",
    "in_metres",
    "part_projection",
    "print_board",
    "read_cameras",
    "shown",
    "straight_camera",
    "undistorted",
]

_LATE = {
    "Board": "board",
    "BoardCameras": "board_cameras",
    "Camera": "camera",
    "CameraSet": "camera",
    "Parted": "projection",
    "ScaleOptions": "scale",
    "SheetName": "board",
    "cameras_digest": "digest",
    "cameras_of_board": "board_cameras",
    "in_metres": "scale",
    "part_projection": "projection",
    "print_board": "board",
    "read_cameras": "reading",
    "shown": "lens",
    "straight_camera": "lens",
    "undistorted": "lens",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
