"""A folder of photos: where each was taken, which way it looks, and the points that they show.

python examples/04_photos_to_cameras.py photos points.ply
"""

from __future__ import annotations

import sys

import numpy as np

import veduta

folder, target = sys.argv[1:3]
place = veduta.locate_photos(folder)
for camera in place.cameras:
    world_from_camera = np.array(camera.transform).reshape(4, 4).T
    at, ahead = world_from_camera[:3, 3], world_from_camera[:3, 2]
    print(f"{camera.name}: at {at.round(2)}, looks along {ahead.round(2)}")
for cloud in place.clouds:
    print(f"{cloud.id}: {len(cloud.points_m)} points")
place.write(target)
