"""Pairs of photos whose fundamental matrix is known, and true matches of them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.photos.matching.features import Features, find_features
from veduta.photos.options import MatchOptions

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data")) / "photos"
PHOTOS = {"fountain-P11": (2, 3, 5, 8), "lund-door": (1, 3, 6, 11)}
"""Rows, in the order of names: neighbours, and some that are further apart."""
TRUE_PX = 3.0
"""Matches nearer than this to the true epipolar lines, both distances added, are taken as true."""
LOOK = MatchOptions(max_side_px=1536, max_features=2500)
SIZE_PX = (1600.0, 1200.0)
FOCAL_PX = 1400.0

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Pair:
    """True matches, (n, 2) each in pixels without distortion, and the size of the second photo."""

    name: str
    first: Points
    second: Points
    size_px: tuple[float, float]


@dataclass(frozen=True)
class View:
    """A photo whose camera is known: K, cam_from_world (3, 4), and its lens where it has one."""

    path: Path
    calibration: Points
    pose: Points
    lens: pycolmap.Camera | None


def synthetic(seed: int, count: int = 400, noise_px: float = 0.5) -> Pair:
    """Points in a box, seen from two places by one camera, with normal noise."""
    rng = np.random.default_rng(seed)
    calibration = np.array(
        [[FOCAL_PX, 0.0, SIZE_PX[0] / 2], [0.0, FOCAL_PX, SIZE_PX[1] / 2], [0.0, 0.0, 1.0]]
    )
    axis = rng.standard_normal(3)
    turn = pycolmap.Rotation3d(np.deg2rad(rng.uniform(4, 15)) * axis / np.linalg.norm(axis))
    rotation = turn.matrix()
    centre = np.array([0.0, 0.0, 10.0])
    shift = centre - rotation @ centre + rng.normal(0.0, (1.5, 0.8, 0.5))
    points = rng.uniform((-5.0, -4.0, 7.0), (5.0, 4.0, 14.0), (8 * count, 3))
    first = _seen(points, calibration)
    second = _seen(points @ rotation.T + shift, calibration)
    inside = [((own > 0) & (own < SIZE_PX)).all(axis=1) for own in (first, second)]
    rows = np.flatnonzero(inside[0] & inside[1])[:count]
    noise = noise_px * rng.standard_normal((2, len(rows), 2))
    return Pair(f"synthetic {seed}", first[rows] + noise[0], second[rows] + noise[1], SIZE_PX)


def _seen(points: Points, calibration: Points) -> Points:
    found = points @ calibration.T
    return found[:, :2] / found[:, 2:]


def real(name: str) -> list[Pair]:
    """Neighbours among some photos of a set, matched and held to their true cameras."""
    views = _fountain(DATA / name) if name == "fountain-P11" else _colmap(DATA / name)
    chosen = [views[row] for row in PHOTOS[name]]
    features = [find_features(read_image(view.path), LOOK) for view in chosen]
    rows = [(0, 1), (1, 2), (2, 3), (0, 2)]
    return [_true_pair(name, (chosen[a], chosen[b]), (features[a], features[b])) for a, b in rows]


def _true_pair(name: str, views: tuple[View, View], features: tuple[Features, Features]) -> Pair:
    descriptors = [found.descriptors.astype(np.float32) for found in features]
    matches = _mutual(*descriptors)
    points = [
        _straight(view, found.keypoints[matches[:, side], :2].astype(np.float64))
        for side, (view, found) in enumerate(zip(views, features, strict=True))
    ]
    near = distances(true_matrix(*views), points[0], points[1]) < TRUE_PX
    width, height = 2.0 * views[1].calibration[:2, 2]
    label = f"{name} {views[0].path.stem} {views[1].path.stem}"
    return Pair(label, points[0][near], points[1][near], (width, height))


def _mutual(first: NDArray[np.float32], second: NDArray[np.float32]) -> NDArray[np.int64]:
    """Rows that are each other's nearest, clearly before the second nearest."""
    first = first / np.linalg.norm(first, axis=1, keepdims=True)
    second = second / np.linalg.norm(second, axis=1, keepdims=True)
    like = first @ second.T
    order = np.argsort(-like, axis=1)[:, :2]
    rows = np.arange(len(first))
    apart = np.sqrt(np.maximum(2 - 2 * like[rows[:, None], order], 0))
    back = like.argmax(axis=0)
    kept = (apart[:, 0] < 0.8 * apart[:, 1]) & (back[order[:, 0]] == rows)
    return np.column_stack([rows[kept], order[kept, 0]])


def _straight(view: View, points: Points) -> Points:
    if view.lens is None:
        return points
    rays = np.array(view.lens.cam_from_img(points), dtype=np.float64)
    return _seen(np.column_stack([rays, np.ones(len(rays))]), view.calibration)


def true_matrix(first: View, second: View) -> Points:
    """F of two known cameras (Hartley and Zisserman 2003, 9.2)."""
    rotation = second.pose[:, :3] @ first.pose[:, :3].T
    x, y, z = second.pose[:, 3] - rotation @ first.pose[:, 3]
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    found: Points = (
        np.linalg.inv(second.calibration).T @ cross @ rotation @ np.linalg.inv(first.calibration)
    )
    return found


def distances(f: Points, first: Points, second: Points) -> Points:
    """(n,) distances from the epipolar lines of both photos, added (Q_F of 2.4.3.4)."""
    ones = np.ones((len(first), 1))
    homogeneous = np.hstack([first, ones]), np.hstack([second, ones])
    lines = homogeneous[1] @ f, homogeneous[0] @ f.T
    error = np.abs((homogeneous[1] * lines[1]).sum(axis=1))
    sizes = [np.linalg.norm(own[:, :2], axis=1) for own in lines]
    found: Points = error / sizes[0] + error / sizes[1]
    return found


def _fountain(folder: Path) -> list[View]:
    views = []
    for path in sorted((folder / "images").iterdir()):
        numbers = np.array((folder / "cameras" / f"{path.name}.camera").read_text().split(), float)
        calibration = numbers[:9].reshape(3, 3).copy()
        calibration[:2] *= 0.5  # the photos are half the size of the cameras' files
        rotation, centre = numbers[12:21].reshape(3, 3).T, numbers[21:24]
        pose = np.column_stack([rotation, -rotation @ centre])
        views.append(View(path, calibration, pose, None))
    return views


def _colmap(folder: Path) -> list[View]:
    model = pycolmap.Reconstruction()
    model.read_text(folder / "colmap_ground_truth")
    views = []
    for image in sorted(model.images.values(), key=lambda one: one.name):
        lens = model.cameras[image.camera_id]
        pose = image.cam_from_world().matrix()
        own = pycolmap.Camera(lens.todict())
        path = folder / "images" / image.name
        views.append(View(path, lens.calibration_matrix(), pose, own))
    return views
