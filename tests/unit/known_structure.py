"""A structure whose cameras are known: points in a box, seen from a ring of cameras."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pycolmap
from numpy.typing import NDArray
from photo_scene import Pose

from veduta.photos.structure import Structure

WIDTH_PX, HEIGHT_PX = 1600, 1200


def known_structure(
    model: str = "PINHOLE",
    params: tuple[float, ...] = (1400.0, 1400.0, 800.0, 600.0),
    *,
    focal_steps: tuple[float, ...] = (1.0,),
    photos: int = 10,
    points: int = 450,
    noise_px: float = 0.3,
    seed: int = 0,
) -> Structure:
    """Noisy observations of true points in true poses by cameras of one model.

    focal_steps: what the focal lengths of the photos are multiplied with, in turn.
    """
    rng = np.random.default_rng(seed)
    places = rng.uniform((-3.0, -3.0, 0.0), (3.0, 3.0, 4.0), (points, 3))
    turns = np.linspace(0.0, 1.6 * np.pi, photos, endpoint=False)
    cameras, poses, keypoints, shown = [], [], [], []
    for photo, turn in enumerate(turns):
        height = 1.5 + 2.0 * (photo % 3)
        pose = Pose((9 * float(np.cos(turn)), 9 * float(np.sin(turn)), height), (0.0, 0.0, 2.0))
        focal = focal_steps[photo % len(focal_steps)]
        camera = pycolmap.Camera(
            camera_id=photo + 1,
            model=model,
            width=WIDTH_PX,
            height=HEIGHT_PX,
            params=[focal * value if value > 1000 else value for value in params],
        )
        cam = np.column_stack([pose.rotation, -pose.rotation @ pose.eye])
        seen = camera.img_from_cam(places @ cam[:, :3].T + cam[:, 3])
        seen = seen + noise_px * rng.standard_normal(seen.shape)
        inside = ((seen > 0) & (seen < (WIDTH_PX, HEIGHT_PX))).all(axis=1)
        cameras.append(camera)
        poses.append(cam)
        keypoints.append(seen)
        shown.append(np.flatnonzero(inside))
    return structure_seen(cameras, poses, places, keypoints, shown)


def structure_seen(
    cameras: Sequence[pycolmap.Camera],
    poses: Sequence[NDArray[np.float64]],
    points: NDArray[np.float64],
    keypoints: Sequence[NDArray[np.float64]],
    shown: Sequence[NDArray[np.int64]],
    keypoint_of: Sequence[NDArray[np.int64]] | None = None,
) -> Structure:
    """Photos 1, 2, ..., each with its camera, pose, keypoints (px) and the points that it shows.

    keypoint_of: of each photo, which keypoint each shown point is; that of its own number if None.
    """
    ids = tuple(range(1, len(poses) + 1))
    rows = [np.full(len(own), row) for row, own in enumerate(shown)]
    return Structure(
        cameras={camera.camera_id: camera for camera in cameras},
        camera_of=dict(zip(ids, (camera.camera_id for camera in cameras), strict=True)),
        image_ids=ids,
        names=tuple(f"{image}.jpg" for image in ids),
        cam_from_world=np.array(poses),
        keypoints_px=tuple(keypoints),
        points=points,
        colours=np.zeros((len(points), 3), dtype=np.uint8),
        image_of=np.concatenate(rows).astype(np.int64),
        keypoint_of=np.concatenate(shown if keypoint_of is None else keypoint_of).astype(np.int64),
        point_of=np.concatenate(shown).astype(np.int64),
    )
