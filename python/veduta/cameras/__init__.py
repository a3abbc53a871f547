"""Cameras of any source, and how a picture looks without what its lens did."""

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
