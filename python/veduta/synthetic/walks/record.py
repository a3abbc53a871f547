"""A walk through a gorge as a record: pairs of pictures, the rig's calibration, and the truth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.synthetic.walks.gorge import Gorge, ground_m, make_gorge
from veduta.synthetic.walks.more import with_mover, with_pool
from veduta.synthetic.walks.shoot import GorgeScene, WalkCamera, WalkShot

Floats = NDArray[np.float64]
_EYE_M = 1.6
_POOL_AHEAD_M, _POOL_M = 4.0, 0.35
_BOULDER_AHEAD_M = 7.0


@dataclass(frozen=True)
class GorgeWalk:
    """step_m: between key positions. turning_rad, rolling_rad: how much the camera turns aside and
    rolls from key position to key position, at most. drift: by which factor the exposure changes
    with each. fov_rad: the horizontal angle of view. views: at each key position, turned by
    view_turn_rad from one to the next about the left camera, the middle one ahead. pool: still
    water on the floor, from 4 m ahead of the first key position on. mover: a boulder that rolls
    across the path, elsewhere at each key position. samples: squared, of each pixel.
    """

    keys: int = 5
    step_m: float = 3.0
    width_px: int = 640
    height_px: int = 360
    fov_rad: float = 1.2
    baseline_m: float = 0.5
    turning_rad: float = 0.0
    rolling_rad: float = 0.0
    drift: float = 1.0
    seed: int = 0
    views: int = 1
    view_turn_rad: float = 0.7
    pool: bool = False
    mover: bool = False
    samples: int = 2

    @property
    def focal_px(self) -> float:
        """Of the pictures."""
        return 0.5 * self.width_px / float(np.tan(0.5 * self.fov_rad))


def cameras_of(walk: GorgeWalk, gorge: Gorge) -> list[WalkCamera]:
    """The left cameras along the path."""
    rng = np.random.default_rng(walk.seed + 100)
    cameras = []
    for number in range(walk.keys):
        y = number * walk.step_m
        pose = np.eye(4)
        turn = walk.turning_rad * np.sin(0.9 * number)
        roll = walk.rolling_rad * rng.uniform(-1.0, 1.0)
        level = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
        pose[:3, :3] = Rotation.from_euler("z", turn).as_matrix() @ level
        pose[:3, :3] = pose[:3, :3] @ Rotation.from_euler("z", roll).as_matrix()
        x = 1.2 * np.sin(y / 11.0)
        pose[:3, 3] = [x, y, ground_m(gorge, x, y) + _EYE_M]
        cameras.append(WalkCamera(walk.width_px, walk.height_px, walk.focal_px, pose))
    return cameras


def views_of(walk: GorgeWalk, camera: WalkCamera) -> list[WalkCamera]:
    """The left cameras of one key position, from the leftmost view to the rightmost."""
    middle = 0.5 * (walk.views - 1)
    views = []
    for number in range(walk.views):
        pose = camera.world_from_camera.copy()
        turn = Rotation.from_euler("y", (number - middle) * walk.view_turn_rad)
        pose[:3, :3] = pose[:3, :3] @ turn.as_matrix()
        views.append(WalkCamera(camera.width_px, camera.height_px, camera.focal_px, pose))
    return views


def beside(camera: WalkCamera, baseline_m: float) -> WalkCamera:
    """The right camera of a rig."""
    pose = camera.world_from_camera.copy()
    pose[:3, 3] += pose[:3, 0] * baseline_m
    return WalkCamera(camera.width_px, camera.height_px, camera.focal_px, pose)


def shoot_walk(walk: GorgeWalk) -> tuple[list[WalkCamera], list[tuple[WalkShot, WalkShot]]]:
    """All pairs, and the left cameras; the exposure drifts from view to view."""
    gorge = make_gorge(walk.keys * walk.step_m, walk.seed)
    if walk.pool:
        gorge = with_pool(gorge, _POOL_AHEAD_M, walk.keys * walk.step_m + 40.0, _POOL_M)
    scene = GorgeScene(gorge)
    cameras: list[WalkCamera] = []
    pairs: list[tuple[WalkShot, WalkShot]] = []
    for number, camera in enumerate(cameras_of(walk, gorge)):
        if walk.mover:
            scene = GorgeScene(_with_boulder(walk, gorge, number))
        for view in views_of(walk, camera):
            shown = (view, beside(view, walk.baseline_m))
            left, right = (
                scene.shoot(one, walk.drift ** len(cameras), walk.samples) for one in shown
            )
            cameras.append(view)
            pairs.append((left, right))
    return cameras, pairs


def _with_boulder(walk: GorgeWalk, gorge: Gorge, number: int) -> Gorge:
    """The boulder rolls from the left wall to the right one, as far from the walker each time."""
    across = -2.2 + 4.4 * number / max(1, walk.keys - 1)
    home = np.array([-2.2, _BOULDER_AHEAD_M, 0.9])
    place = np.array([across, number * walk.step_m + _BOULDER_AHEAD_M, 0.9])
    return with_mover(gorge, place, 0.9, home)


def write_walk(folder: Path, walk: GorgeWalk) -> list[WalkCamera]:
    """Write left/ and right/ (or views/), walk.toml, and the truth: depth/ and poses.txt, of each
    view; the left cameras.
    """
    cameras, pairs = shoot_walk(walk)
    (folder / "depth").mkdir(parents=True, exist_ok=True)
    for number, pair in enumerate(pairs):
        for side, shot in zip(("left", "right"), pair, strict=True):
            file = folder / side / f"{number:03d}.png"
            if walk.views > 1:
                key, view = divmod(number, walk.views)
                file = folder / "views" / f"{key:03d}" / f"{view}_{side}.png"
            file.parent.mkdir(parents=True, exist_ok=True)
            Image.fromarray(shot.image).save(file)
        np.save(folder / "depth" / f"{number:03d}.npy", pair[0].depth_m.astype(np.float32))
    toml = (
        f"focal_px = {walk.focal_px:.6f}\ncentre_px = [{walk.width_px / 2:.1f},"
        f" {walk.height_px / 2:.1f}]\nbaseline_m = {walk.baseline_m:.6f}\n"
    )
    (folder / "walk.toml").write_text(toml, encoding="utf-8")
    rows = [camera.world_from_camera[:3].ravel() for camera in cameras]
    np.savetxt(folder / "poses.txt", rows)
    return cameras
