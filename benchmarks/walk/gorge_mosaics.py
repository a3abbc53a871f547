"""A gorge of 15 key positions with 3 views each: what it takes to prepare it, and how good it is.

`python benchmarks walk/gorge_mosaics [--draft] [--keys 15]` keeps
`benchmarks/results/walk-gorge-mosaics.md`.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print
from scipy.spatial.transform import Rotation

from veduta.synthetic.walks.record import GorgeWalk, shoot_walk
from veduta.synthetic.walks.shoot import WalkCamera
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.mosaic import Mosaic, make_mosaic
from veduta.walk.build.way import find_way
from veduta.walk.rig import Rig, StereoPair


def jump(mosaic: Mosaic, walk: GorgeWalk) -> tuple[float, float]:
    """Steps of the inverse depth (%), middle over the rows: at the front view's borders, and
    elsewhere.
    """
    inverse = 1.0 / mosaic.model.depth_m.astype(np.float64)
    steps = np.abs(np.diff(inverse, axis=1)) / np.minimum(inverse[:, 1:], inverse[:, :-1])
    half = np.arctan(0.5 * walk.width_px / walk.focal_px)
    screen = mosaic.model.screen
    ends = [round(screen.centre_px[0] + sign * half * screen.focal_px[0]) for sign in (-1, 1)]
    at = max(float(np.median(steps[:, end - 3 : end + 4].max(axis=1))) for end in ends)
    windows = np.lib.stride_tricks.sliding_window_view(steps, 7, axis=1).max(axis=-1)
    return 100.0 * at, 100.0 * float(np.median(windows))


def measured(walk: GorgeWalk) -> Row:
    """All of it for one gorge."""
    cameras, pairs = shoot_walk(walk)
    middle = (0.5 * walk.width_px, 0.5 * walk.height_px)
    focal = (walk.focal_px, walk.focal_px)
    rig = Rig(walk.width_px, walk.height_px, focal, middle, walk.baseline_m)
    begin = time.process_time()
    mosaics: list[Mosaic] = []
    for key in range(walk.keys):
        views = pairs[key * walk.views : (key + 1) * walk.views]
        models = [
            build_local_model(StereoPair(str(key), str(n), left.image, right.image), rig)
            for n, (left, right) in enumerate(views)
        ]
        mosaics.append(make_mosaic(models))
    joined = time.process_time()
    kept: list[LocalModel] = [one.model for one in mosaics]
    ways = [find_way(one, other, rig) for one, other in zip(kept, kept[1:], strict=False)]
    ended = time.process_time()
    turned = [
        np.rad2deg(Rotation.from_matrix(true.T @ found).magnitude())
        for key, mosaic in enumerate(mosaics)
        for true, found in zip(
            _turns(walk, cameras, key), mosaic.turns.front_from_view, strict=True
        )
    ]
    steps = np.array([jump(mosaic, walk) for mosaic in mosaics])
    lengths: list[float] = [way.distance_m for way in ways]
    true_m = [
        float(np.linalg.norm(_centre(cameras, walk, n + 1) - _centre(cameras, walk, n)))
        for n in range(walk.keys - 1)
    ]
    verdicts = [way.verdict for way in ways if way.verdict is not None]
    return {
        "views": len(pairs), "pixels": f"{walk.width_px} x {walk.height_px}",
        "found": int(sum(one.turns.found.sum() for one in mosaics)),
        "turned off deg": float(np.mean(turned)), "gap %": 100.0 * max(one.gap for one in mosaics),
        "step at seams %": float(steps[:, 0].mean()), "elsewhere %": float(steps[:, 1].mean()),
        "morphs": sum(way.kind == "morph" for way in ways), "of": len(ways),
        "length off %": 100.0 * abs(sum(lengths) - sum(true_m)) / sum(true_m),
        "predicted dB": float(np.mean([one.score_db for one in verdicts])),
        "unmoved dB": float(np.mean([one.unmoved_db for one in verdicts])),
        "mosaics s": joined - begin, "transitions s": ended - joined,
    }  # fmt: skip


def _turns(walk: GorgeWalk, cameras: list[WalkCamera], key: int) -> list[NDArray[np.float64]]:
    """The true front_from_view."""
    views = cameras[key * walk.views : (key + 1) * walk.views]
    front = views[walk.views // 2].world_from_camera[:3, :3]
    return [front.T @ view.world_from_camera[:3, :3] for view in views]


def _centre(cameras: list[WalkCamera], walk: GorgeWalk, key: int) -> NDArray[np.float64]:
    return np.asarray(cameras[key * walk.views].world_from_camera[:3, 3])


def main() -> None:
    """Measure the paper's 45 views."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--draft", action="store_true")
    parser.add_argument("--keys", type=int, default=15)
    called = parser.parse_args()
    walk = GorgeWalk(
        keys=called.keys, views=3, width_px=256, height_px=176, step_m=3.0, drift=1.02, seed=2
    )
    notes = [
        "Times are of the processor. What the paper's 45 views of a megapixel take as a whole is"
        " measured by walk/preparing.",
        "step at seams: largest relative step of inverse depth among seven columns about the border"
        " of the front view, middle over the rows; elsewhere: the same of any seven columns.",
    ]
    keep_or_print("walk-gorge-mosaics", [measured(walk)], notes, not called.draft)


if __name__ == "__main__":
    main()
