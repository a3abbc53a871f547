"""The flow between two key positions of a synthetic gorge beside the exact one, by scale factor.

`python benchmarks walk/gorge_flow [--keys 15] [--draft]` keeps
`benchmarks/results/walk-gorge-flow.md`: the
paper's figure 4, for one scale and for ten.
"""

from __future__ import annotations

import argparse
import itertools
import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print

from veduta.synthetic.walks.record import GorgeWalk, shoot_walk
from veduta.synthetic.walks.shoot import WalkCamera, WalkShot
from veduta.walk.build.flow import FlowSettings, find_flow
from veduta.walk.build.local_model import build_local_model
from veduta.walk.build.matches import match_features
from veduta.walk.build.pose import relative_pose
from veduta.walk.rig import Rig, StereoPair

TEN = tuple(1.0 / (1.0 - 0.1 * n) for n in range(10))
"""The paper's scales: 1, 1/0.9, ... 1/0.1."""
BINS = ((1.0, 1.25), (1.25, 1.5), (1.5, 2.0), (2.0, 2.5))
WITHIN_PX = 2.0
PLAIN = GorgeWalk(keys=2, step_m=6.0, seed=4)
VARIANTS = {
    "as it is": PLAIN,
    "turning path": replace(PLAIN, turning_rad=0.12),
    "rolling camera": replace(PLAIN, rolling_rad=0.1),
    "drifting exposure": replace(PLAIN, drift=1.25),
}
Floats = NDArray[np.float64]


def exact_flow(
    first: tuple[WalkCamera, WalkShot], second: tuple[WalkCamera, WalkShot]
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """(h, w, 2) where each pixel lies in the second picture, how much larger it is there, and
    whether it is seen in both. From depths and cameras of the renderer alone.
    """
    (one, shot), (other, there) = first, second
    rows, columns = np.indices(shot.depth_m.shape)
    plane = np.stack(
        [
            (columns + 0.5 - 0.5 * one.width_px) / one.focal_px,
            (rows + 0.5 - 0.5 * one.height_px) / one.focal_px,
            np.ones(shot.depth_m.shape),
        ],
        axis=-1,
    )
    world = plane * shot.depth_m[..., None] @ one.world_from_camera[:3, :3].T
    world += one.world_from_camera[:3, 3]
    local = (world - other.world_from_camera[:3, 3]) @ other.world_from_camera[:3, :3]
    ahead = np.where(local[..., 2] > 0.1, local[..., 2], np.nan)
    x = local[..., 0] / ahead * other.focal_px + 0.5 * other.width_px
    y = local[..., 1] / ahead * other.focal_px + 0.5 * other.height_px
    inside = (x > 1) & (y > 1) & (x < other.width_px - 1) & (y < other.height_px - 1)
    at = np.where(inside, y, 0).astype(int), np.where(inside, x, 0).astype(int)
    seen = inside & (np.abs(there.depth_m[at] - ahead) < 0.03 * ahead)
    return np.stack([x, y], axis=-1), shot.depth_m / ahead, seen


class Shares:
    """How many pixels lie within two of their true place, by how much larger they become."""

    def __init__(self) -> None:
        self.near = np.zeros(len(BINS))
        self.all = np.zeros(len(BINS))
        self.seconds = 0.0

    def add(
        self, off: NDArray[np.floating], scale: Floats, seen: NDArray[np.bool_], seconds: float
    ) -> None:
        """Count the pixels of one transition; seconds: what it took."""
        for number, (low, high) in enumerate(BINS):
            chosen = seen & (scale >= low) & (scale < high)
            self.near[number] += int((off[chosen] < WITHIN_PX).sum())
            self.all[number] += int(chosen.sum())
        self.seconds += seconds


def rows_of(name: str, walk: GorgeWalk) -> list[Row]:
    """A row for each number of scales, and one for what geometry predicts, over all transitions."""
    cameras, pairs = shoot_walk(walk)
    size = (walk.width_px, walk.height_px)
    middle = (0.5 * size[0], 0.5 * size[1])
    rig = Rig(size[0], size[1], (walk.focal_px, walk.focal_px), middle, walk.baseline_m)
    models = [
        build_local_model(StereoPair(str(n), "0", left.image, right.image), rig)
        for n, (left, right) in enumerate(pairs)
    ]
    found = {label: Shares() for label in ("none", "1", "8", "10")}
    for number, (first, second) in enumerate(itertools.pairwise(models)):
        pose = relative_pose(first, second, rig, match_features(first, second)).second_from_first
        true, scale, seen = exact_flow(
            (cameras[number], pairs[number][0]), (cameras[number + 1], pairs[number + 1][0])
        )
        for scales, label in (((1.0,), "1"), (FlowSettings().scales, "8"), (TEN, "10")):
            begin = time.process_time()
            flow = find_flow(first, second, pose, replace(FlowSettings(), scales=scales))
            seconds = time.process_time() - begin
            if label == "1":
                off = np.linalg.norm(flow.predicted - true, axis=-1)
                found["none"].add(off, scale, seen, 0.0)
            off = np.linalg.norm(flow.target - true, axis=-1)
            found[label].add(off, scale, seen, seconds)
    rows: list[Row] = []
    for label, shares in found.items():
        told: dict[str, float | None] = {
            f"{low:g} to {high:g} %": 100.0 * near / every if every else None
            for (low, high), near, every in zip(BINS, shares.near, shares.all, strict=True)
        }
        steps = len(models) - 1
        rows.append(
            {"gorge": name, "transitions": steps, "scales": label,
             "processor s each": shares.seconds / steps, **told}
        )  # fmt: skip
    return rows


def main() -> None:
    """Measure the gorge as it is, and where each assumption is broken."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--draft", action="store_true")
    parser.add_argument("--keys", type=int, default=2, help="key positions of the way as it is")
    called = parser.parse_args()
    walks = {**VARIANTS, "as it is": replace(PLAIN, keys=called.keys)}
    rows = [row for name, walk in walks.items() for row in rows_of(name, walk)]
    notes = [
        "Share of the pixels that both pictures show whose counterpart is found within 2 px, by how"
        " much larger they are in the second picture. 640 x 360 px, 6 m apart, seed 4.",
        "scales: those tried for a label, about the one that geometry predicts; 10 are the paper's."
        " none: where depth and pose alone put it.",
    ]
    keep_or_print("walk-gorge-flow", rows, notes, not called.draft)


if __name__ == "__main__":
    main()
