"""Points of `veduta dense` against rendered facades whose surfaces are known.

python benchmarks dense/synthetic_truth [--seeds 41,42] [--peer PYTHON] [--keep]: five photos of
each facade are rendered by ray casting (`veduta.synthetic`, which shares no function with what is
measured). Accuracy is the share of the points that lie within 5, 10 and 20 mm of the true surface,
completeness the share of the true surface that at least two photos see with a point that near, F1
their harmonic mean. Beside, on the same cameras: OpenCV's StereoSGBM over neighbouring photos, and,
where --peer names a Python that has it, the PatchMatch of pyarchinit-photogrammetry-core (GPL: run
in a process of its own). Nothing was chosen by these seeds.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from peak_memory import grown
from PIL import Image
from record import Row, keep_or_print
from scipy.spatial import cKDTree
from sgbm_chain import sgbm_points

from veduta.dense.command import run_dense
from veduta.dense.options import DenseOptions, DepthOptions, SurfaceOptions
from veduta.synthetic.build import build
from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.layout import STYLES
from veduta.synthetic.light import daylight
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import measure, render
from veduta.synthetic.scene import RayScene
from veduta.synthetic.styles import design

Floats = NDArray[np.float64]
WIDTH, HEIGHT, FOCAL, PHOTOS = 800, 600, 900.0, 5
AWAY_M, APART_M = 7.0, 0.7
WITHIN_M = (0.005, 0.010, 0.020)
PIXEL_M = 0.008
PEER = Path(__file__).with_name("peer_patchmatch.py")


def scene(seed: int) -> tuple[RayScene, list[Camera], list[NDArray[np.uint8]]]:
    """A facade, five cameras before it, and their photos."""
    layout = design(STYLES[seed % len(STYLES)], seed)
    built = build(layout, seed, ())
    cast = RayScene([(to_part(built, "facade"), np.eye(4))], mirrors(built, "facade"))
    middle, front = 0.5 * layout.width_m, 0.0
    cameras = [
        look_at(
            (middle + APART_M * (number - 2), front - AWAY_M, 2.4 + 0.1 * (number % 2)),
            (middle + 0.4 * APART_M * (number - 2), front, 3.6),
            (WIDTH, HEIGHT),
            FOCAL,
        )
        for number in range(PHOTOS)
    ]
    light = daylight(seed, True, 3.6, 0.8)
    lens = Lens(0.4, 0.1, 0.01, 95)
    photos = [
        develop(render(cast, camera, light, 2, seed + number), lens, seed + number)
        for number, camera in enumerate(cameras)
    ]
    return cast, cameras, photos


def finer(camera: Camera, times: int) -> Camera:
    """The same view with more pixels."""
    x, y = camera.centre_px
    return Camera(
        camera.width_px * times,
        camera.height_px * times,
        camera.focal_px * times,
        (x * times, y * times),
        camera.cam_from_world,
    )


def shown(cast: RayScene, camera: Camera) -> Floats:
    """(n, 3) points of the surface through the pixels' centres."""
    depth = measure(cast, camera).depth_m
    rows, columns = np.nonzero(np.isfinite(depth))
    rays = camera.rays(np.stack([columns + 0.5, rows + 0.5], axis=1))
    return np.asarray(camera.position_m + rays * depth[rows, columns][:, None])


def truth(cast: RayScene, cameras: list[Camera]) -> tuple[Floats, Floats]:
    """The surface half a pixel fine, and a spot for each pixel that two photos see."""
    fine = np.concatenate([shown(cast, finer(one, 2)) for one in cameras[1:4:2]])
    spots = shown(cast, cameras[2])
    seen = np.zeros(len(spots), dtype=int)
    for camera in cameras:
        pixels, depth = camera.project(spots)
        at = np.floor(np.nan_to_num(pixels, nan=-1.0)).astype(int)
        inside = (at >= 0).all(axis=1) & (at[:, 0] < WIDTH) & (at[:, 1] < HEIGHT)
        first = measure(cast, camera).depth_m[at[inside, 1], at[inside, 0]]
        seen[np.flatnonzero(inside)] += np.abs(first - depth[inside]) < 0.03
    return np.concatenate([fine, spots]), spots[seen >= 2]


def scores(
    points: Floats, surface: cKDTree, spots: Floats, low: Floats, high: Floats, pixel_m: float
) -> Row:
    """Accuracy, completeness and F1 of points near the true ones, one in each cell of a pixel's
    size: else a spot would count as often as there are photos of it, in clouds that have each
    depth map whole.
    """
    near = points[((points > low) & (points < high)).all(axis=1)]
    cells = np.floor(near / pixel_m).astype(np.int64)
    near = near[np.unique(cells, axis=0, return_index=True)[1]]
    off, _ = surface.query(near, distance_upper_bound=0.1)
    gap, _ = cKDTree(near).query(spots, distance_upper_bound=0.1)
    row: dict[str, str | int | float | bool | None] = {"points": len(near)}
    for within in WITHIN_M:
        accurate, complete = float(np.mean(off <= within)), float(np.mean(gap <= within))
        name = f"{1000 * within:.0f} mm"
        row[f"accuracy {name}"] = round(accurate, 3)
        row[f"completeness {name}"] = round(complete, 3)
        both = accurate + complete
        row[f"F1 {name}"] = round(2.0 * accurate * complete / both if both else 0.0, 3)
    return row


def write_set(folder: Path, cameras: list[Camera], photos: list[NDArray[np.uint8]]) -> None:
    """`.camera` files and photos; such files have the first pixel's centre at 0."""
    (folder / "cameras").mkdir(parents=True)
    (folder / "images").mkdir()
    for number, (camera, photo) in enumerate(zip(cameras, photos, strict=True)):
        Image.fromarray(photo).save(folder / "images" / f"view{number}.png")
        matrix = camera.intrinsics.copy()
        matrix[:2, 2] -= 0.5
        turn = camera.cam_from_world[:3, :3].T
        blocks = [matrix, np.zeros((1, 3)), turn, camera.position_m[None], [[WIDTH, HEIGHT]]]
        text = "\n".join(
            " ".join(repr(float(one)) for one in row)
            for block in blocks
            for row in np.asarray(block)
        )
        (folder / "cameras" / f"view{number}.camera").write_text(text)


def ours(folder: Path, out: Path, method: str) -> Floats:
    """The cloud of the verb."""
    options = DenseOptions(
        depth=DepthOptions.model_validate({"method": method}),
        surface=SurfaceOptions(no_mesh=True),
    )
    run_dense(folder, out, options)
    head, _, body = (out / "cloud.ply").read_bytes().partition(b"end_header\n")
    count = int(head.split(b"element vertex ")[1].split()[0])
    rows = np.frombuffer(body, np.dtype([("xyz", "<f4", 6), ("more", "u1", 4)]), count)
    return np.asarray(rows["xyz"][:, :3], dtype=np.float64)


def peers(
    python: Path,
    folder: Path,
    cameras: list[Camera],
    photos: list[NDArray[np.uint8]],
    reach_m: tuple[float, float],
) -> Floats:
    """The peer's points: pixels whose depths a neighbour has, too, within 1 %."""
    given, found = folder / "peer.npz", folder / "peer-depths.npz"
    grey = [cv2.cvtColor(one, cv2.COLOR_RGB2GRAY) / np.float32(255.0) for one in photos]
    poses = np.stack([one.cam_from_world for one in cameras])
    middle = np.array([*(one - 0.5 for one in cameras[0].centre_px)])
    k = np.array([FOCAL, FOCAL, *middle])
    np.savez(given, grey=np.stack(grey), poses=poses, k=k, depths=np.array(reach_m))
    subprocess.run([python, PEER, given, found], check=True)
    depths = np.load(found)["depths"]
    return agreed_points(cameras, depths)


def agreed_points(cameras: list[Camera], depths: NDArray[np.float32]) -> Floats:
    """Points of depth maps (0 where unknown) that at least one other map confirms within 1 %."""
    kept = []
    for number, camera in enumerate(cameras):
        rows, columns = np.nonzero(depths[number] > 0.0)
        rays = camera.rays(np.stack([columns + 0.5, rows + 0.5], axis=1))
        points = camera.position_m + rays * depths[number][rows, columns][:, None]
        votes = np.zeros(len(points), dtype=int)
        for other, beside in enumerate(cameras):
            if other == number:
                continue
            pixels, away = beside.project(points)
            at = np.floor(np.nan_to_num(pixels, nan=-1.0)).astype(int)
            inside = (at >= 0).all(axis=1) & (at[:, 0] < WIDTH) & (at[:, 1] < HEIGHT)
            there = depths[other][at[inside, 1], at[inside, 0]]
            votes[np.flatnonzero(inside)] += np.abs(there - away[inside]) < 0.01 * away[inside]
        kept.append(points[votes >= 1])
    return np.concatenate(kept)


def makers(
    folder: Path,
    cameras: list[Camera],
    photos: list[NDArray[np.uint8]],
    peer: Path | None,
    reach_m: tuple[float, float] = (4.0, 14.0),
    alpha: float = 0.0,
) -> dict[str, Callable[[], Floats]]:
    """The ways to points of a written set, by name. reach_m, alpha: those of `sgbm_points`."""
    found: dict[str, Callable[[], Floats]] = {
        "veduta dense": lambda: ours(folder, folder.parent / "a", "patchmatch"),
        "veduta dense --method linking": lambda: ours(folder, folder.parent / "b", "linking"),
        "OpenCV StereoSGBM": lambda: sgbm_points(cameras, photos, reach_m, alpha),
    }
    if peer is not None:
        found["pyarchinit-photogrammetry-core"] = lambda: peers(
            peer, folder, cameras, photos, reach_m
        )
    return found


def costed(make: Callable[[], Floats]) -> tuple[Floats, Row]:
    """The points of a way, and what they cost: time, and memory beyond what was taken before."""
    began, used = time.perf_counter(), _used_s()
    with grown() as peak:
        points = make()
    cost: Row = {
        "processor s": round(_used_s() - used, 1),
        "seconds": round(time.perf_counter() - began, 1),
        "peak MB": round(peak.pss / 1e6),
    }
    return points, cost


def _used_s() -> float:
    """Of the processor, by this process and those that it started and that have ended."""
    return sum(
        used.ru_utime + used.ru_stime
        for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


def main() -> None:
    """Render, reconstruct, compare, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="41,42")
    parser.add_argument("--peer", type=Path, default=None)
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    rows: list[Row] = []
    for seed in map(int, given.seeds.split(",")):
        cast, cameras, photos = scene(seed)
        surface, spots = truth(cast, cameras)
        tree = cKDTree(surface)
        low, high = surface.min(axis=0) - 0.5, surface.max(axis=0) + 0.5
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch) / "set"
            write_set(folder, cameras, photos)
            for name, make in makers(folder, cameras, photos, given.peer).items():
                points, cost = costed(make)
                row = scores(points, tree, spots, low, high, PIXEL_M)
                rows.append({"facade": seed, "by": name, **row, **cost})
    notes = [
        f"Load at the end: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores, as the seconds say.",
        f"{PHOTOS} photos of {WIDTH} x {HEIGHT}, {AWAY_M} m away, {APART_M} m apart, with noise.",
        f"A pixel is {1000 * PIXEL_M:.0f} mm on the wall. Of each cloud one point in each cell of"
        " that size counts; ours has what two other photos confirm, as a call without options has.",
    ]
    keep_or_print("dense-synthetic", rows, notes, given.keep)


if __name__ == "__main__":
    main()
