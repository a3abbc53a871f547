"""Photos without cameras: of a turntable, or of a board of markers."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.cameras import Camera, CameraSet
from veduta.cameras.pictures import Pictures
from veduta.imaging.read import image_size
from veduta.run.errors import InputError

USUAL_FOCAL = 1.3
"""Of the photo's larger side: an object fills photos of longer lenses, too."""


def bare_cameras(folder: Path) -> CameraSet:
    """The photos of a folder in the order of their names; their cameras stand at no place yet."""
    paths = Pictures([folder]).paths
    if not paths:
        raise InputError(folder, "holds no photos", "Name the folder of the object's photos.")
    pose = np.eye(3, 4)
    cameras = []
    for path in paths:
        width, height = image_size(path)
        focal = USUAL_FOCAL * max(width, height)
        half = (width / 2.0, height / 2.0)
        cameras.append(Camera(path.name, width, height, (focal, focal), half, pose, picture=path))
    return CameraSet(tuple(cameras), source="photos without cameras")
