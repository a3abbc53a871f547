"""Points of `veduta dense` against rendered objects whose surfaces are known.

`python benchmarks dense/objects_truth [--seeds 51,52] [--peer PYTHON] [--keep]`: nine photos of a
vase, a stone, a slatted crate and a painted stool on a table (`made_objects`). Only what is higher
than the table counts. The scores and the peers are those of `synthetic_truth`. Nothing was chosen
by these seeds.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from pathlib import Path

import numpy as np
from made_objects import TABLE_M, ObjectScene, cameras_around
from numpy.typing import NDArray
from record import Row, keep_or_print
from scipy.spatial import cKDTree
from synthetic_truth import (
    FOCAL,
    HEIGHT,
    WIDTH,
    Floats,
    costed,
    finer,
    makers,
    scores,
    write_set,
)  # fmt: skip

from veduta.synthetic.camera import Camera

PHOTOS, AWAY_M = 9, 3.0
REACH_M = (2.0, 5.5)
SAME_M = 0.01
PIXEL_M = 0.003


def shown(cast: ObjectScene, camera: Camera) -> Floats:
    """(n, 3) points of the objects through the pixels' centres."""
    depth = cast.depth_m(camera)
    rows, columns = np.nonzero(np.isfinite(depth))
    rays = camera.rays(np.stack([columns + 0.5, rows + 0.5], axis=1))
    points = camera.position_m + rays * depth[rows, columns][:, None]
    return np.asarray(points[points[:, 2] > TABLE_M])


def truth(cast: ObjectScene, cameras: list[Camera]) -> tuple[Floats, Floats]:
    """The surface half a pixel fine, and a spot for each pixel that two photos see."""
    fine = np.concatenate([shown(cast, finer(one, 2)) for one in cameras])
    spots = np.concatenate([shown(cast, one) for one in cameras[::4]])
    seen = np.zeros(len(spots), dtype=int)
    for camera in cameras:
        pixels, depth = camera.project(spots)
        at = np.floor(np.nan_to_num(pixels, nan=-1.0)).astype(int)
        inside = (at >= 0).all(axis=1) & (at[:, 0] < WIDTH) & (at[:, 1] < HEIGHT)
        first = cast.depth_m(camera)[at[inside, 1], at[inside, 0]]
        seen[np.flatnonzero(inside)] += np.abs(first - depth[inside]) < SAME_M
    return fine, spots[seen >= 2]


def measured(seed: int, peer: Path | None) -> list[Row]:
    """A row for each way to points."""
    cast = ObjectScene(seed)
    cameras = cameras_around(PHOTOS, (WIDTH, HEIGHT), FOCAL, AWAY_M)
    photos: list[NDArray[np.uint8]] = [cast.photo(one, seed + n) for n, one in enumerate(cameras)]
    surface, spots = truth(cast, cameras)
    tree = cKDTree(surface)
    low, high = surface.min(axis=0) - 0.1, surface.max(axis=0) + 0.1
    low[2] = TABLE_M
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "set"
        write_set(folder, cameras, photos)
        ways = makers(folder, cameras, photos, peer, REACH_M, alpha=-1.0)
        for name, make in ways.items():
            points, cost = costed(make)
            rows.append(
                {
                    "seed": seed,
                    "by": name,
                    **scores(points, tree, spots, low, high, PIXEL_M),
                    **cost,
                }
            )
    return rows


def main() -> None:
    """Render, reconstruct, compare, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="51,52")
    parser.add_argument("--peer", type=Path, default=None)
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    rows = [row for seed in given.seeds.split(",") for row in measured(int(seed), given.peer)]
    notes = [
        f"Load at the end: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores, as the seconds say.",
        f"{PHOTOS} photos of {WIDTH} x {HEIGHT} on an arc of 76 degrees, {AWAY_M} m away.",
        f"A pixel is {1000 * PIXEL_M:.0f} mm on the objects. Spots that two photos see count, of"
        " every fourth photo; of each cloud one point in each cell of a pixel's size. Ours has what"
        " two other photos confirm, as a call without options has.",
    ]
    keep_or_print("dense-objects", rows, notes, given.keep)


if __name__ == "__main__":
    main()
