"""A walking cat rendered from rings of cameras: its hull beside one that is computed otherwise.

`python benchmarks carve/cat [--data FOLDER] [--no-keep]` renders silhouettes of a mesh, carves
them, and counts the voxels whose centres every silhouette has, one look at a pixel each, in numpy:
no octree, no distances. It keeps `benchmarks/results/carve-cat.md`.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh
from record import Row, keep_or_print

from veduta import _core
from veduta.cameras import Camera
from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.hull import Root, carve_hull, root_of
from veduta.carve.build.measures import measure_mesh
from veduta.carve.views import Floats, View, camera_rows

HERE = Path(__file__).parent

DATA = HERE.parents[1].parent / "shared" / "data" / "animals" / "walking-cat"
SIZE = 600


def ring(middle: Floats, size: float, count: int, height: float) -> list[Camera]:
    """Cameras about the y axis of the mesh that look at its middle."""
    cameras = []
    for number in range(count):
        angle = 2.0 * np.pi * number / count
        back = np.array(
            [np.cos(angle) * np.cos(height), np.sin(height), np.sin(angle) * np.cos(height)]
        )
        right = np.cross(-back, [0.0, 1.0, 0.0])
        right /= np.linalg.norm(right)
        turn = np.array([right, np.cross(-back, right), -back])
        pose = np.column_stack([turn, -turn @ (middle + 3.0 * size * back)])
        focal = 2.6 * SIZE
        name = f"{height:.1f}-{number}"
        half = (SIZE / 2, SIZE / 2)
        cameras.append(Camera(name, SIZE, SIZE, (focal, focal), half, pose))
    return cameras


def counted(views: Sequence[View], root: Root) -> float:
    """The volume of the voxels whose centres all silhouettes have."""
    count, voxel = 2**root.levels, root.voxel_m
    axis = (np.arange(count) + 0.5) * voxel
    inside = 0
    for x in axis:
        grid = np.stack(np.meshgrid([x], axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        left = grid + root.low_m
        for view in views:
            pixels, _ = view.camera.project(left)
            at = np.floor(pixels).astype(int).clip(0, SIZE - 1)
            left = left[view.mask[at[:, 1], at[:, 0]]]
            if not len(left):
                break
        inside += len(left)
    return inside * voxel**3


def main() -> None:
    """Measure, and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    path = sorted(given.data.rglob("*.obj"))[0]
    mesh = trimesh.load_mesh(path, process=False)
    if not isinstance(mesh, trimesh.Trimesh):
        raise SystemExit(f"{path} is no mesh")
    positions = np.asarray(mesh.vertices, dtype=np.float64)
    triangles = np.asarray(mesh.faces, dtype=np.uint32)
    middle, size = positions.mean(axis=0), float(np.linalg.norm(np.ptp(positions, axis=0)))
    rows: list[Row] = []
    for rings in (((24, 0.2),), ((24, 0.2), (12, 0.9), (12, -0.5))):
        cameras = [one for count, height in rings for one in ring(middle, size, count, height)]
        rendered = _core.seen_triangles(
            camera_rows(cameras), [(SIZE, SIZE)] * len(cameras), positions, triangles
        )
        blank = np.zeros((SIZE, SIZE, 3), dtype=np.uint8)
        views = [View(c, blank, one >= 0, "mask") for c, one in zip(cameras, rendered, strict=True)]
        for levels in (7, 8):
            root = root_of(find_bounds(views), levels)
            began = time.perf_counter()
            hull = carve_hull(views, root).surface()
            seconds = time.perf_counter() - began
            ours = measure_mesh(*hull, views).volume
            other = counted(views, root)
            rows.append(
                {
                    "views": len(views),
                    "voxels": 2**levels,
                    "volume": ours,
                    "counted otherwise": other,
                    "difference %": 100.0 * (ours / other - 1.0),
                    "triangles": len(hull[1]),
                    "s": seconds,
                }
            )
    keep_or_print("carve-cat", rows, [f"{path.name}, in the mesh's unit, cubed"], not given.no_keep)


if __name__ == "__main__":
    main()
