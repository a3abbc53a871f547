"""Animals without limbs: axes, silhouettes that were not seen, new motion, paths, and their times.

`python benchmarks fauna/limbless` prints a table and keeps it in
`benchmarks/results/fauna-limbless.md`. `--times` measures times alone, for a machine without other
work, and keeps them in `fauna-times.md`.
Real data is read from `$VEDUTA_DATA`, else from `../shared/data`.
"""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Value, record
from scipy.spatial import cKDTree

from veduta.fauna.build.build import build_animal
from veduta.fauna.document.schema import Source
from veduta.fauna.motion.angles import axis_angles, coefficients, equal_steps
from veduta.fauna.motion.gaits import Gait, roamed_gait
from veduta.fauna.motion.states import StateSampling, curvature_range, without_turn
from veduta.fauna.options import FaunaOptions, MotionOptions
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.terrain import terrain_of_heights
from veduta.fauna.path.through import path_through
from veduta.fauna.read.footage import Footage, read_footage
from veduta.fauna.read.limbless import Seen, axes_in, silhouettes_in, tracked_axes
from veduta.fauna.read.midlines import read_midlines
from veduta.fauna.read.overlap import drawn_body, overlap
from veduta.fauna.read.tracked import describe

Row = dict[str, Value]
Floats = NDArray[np.float64]
DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
WALKS = 1000


def main() -> None:
    """Measure all of it and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", action="store_true", help="times alone, each the best of three")
    if parser.parse_args().times:
        record("fauna-times", times(), ["The best of three runs."])
        return
    rows: list[Row] = []
    animals = DATA / "animals"
    if animals.is_dir():
        rows += rendered_lamprey(animals / "lamprey" / "lampreydata.csv")
        rows += unseen_worm(animals / "worm" / "celegans3.avi")
        rows += new_motion(animals / "lamprey" / "lampreydata.csv")
    rows += million_cells()
    record(
        "fauna-limbless",
        rows,
        [
            "Lamprey: its midlines drawn as footage, with a width, a shadow, a mottled ground and"
            " noise, by OpenCV alone; no threshold was chosen with it.",
            "Worm: the body is the median of the even frames. `pose seen` poses it by the odd"
            " frame's own axis, `pose unseen` by the mean of the frames before and after.",
            f"New motion: {WALKS} walks of 6 s at least, seeds 0 to {WALKS - 1}, 40 drawn states.",
        ],
    )


def times() -> list[Row]:
    """How long models and paths take, each the best of three."""
    lamprey = DATA / "animals" / "lamprey" / "lampreydata.csv"
    found = [[rendered_lamprey(lamprey)[-1], *million_cells()[:2]] for _ in range(3)]
    best = [
        min(same, key=lambda row: float(row["value"] or 0.0)) for same in zip(*found, strict=True)
    ]
    return list(best)


def drawn_footage(axes: list[Floats], size: tuple[int, int], width_px: float) -> NDArray[np.uint8]:
    """(t, h, w, 3) frames: dark bodies, thinner towards their ends, over a mottled ground."""
    random = np.random.default_rng(0)
    ground = cv2.GaussianBlur(random.normal(165.0, 70.0, size).astype(np.float32), (0, 0), 5.0)
    frames = np.empty((len(axes), *size, 3), dtype=np.uint8)
    for row, axis in enumerate(axes):
        along = np.linspace(0.0, 1.0, len(axis))
        half = width_px * np.minimum(1.0, np.sqrt(np.minimum(along / 0.06, (1.0 - along) / 0.5)))
        picture = np.repeat(ground[..., None], 3, axis=2)
        for shift, colour in ((0.5 * width_px + 5.0, None), (0.0, (52.0, 60.0, 40.0))):
            mask = np.zeros(size, np.uint8)
            for (x, y), reach in zip(axis + shift, half, strict=True):
                centre = (round(x * 16 - 8), round(y * 16 - 8))
                cv2.circle(mask, centre, max(8, round(reach * 16)), 255, -1, cv2.LINE_AA, 4)
            share = cv2.GaussianBlur(mask, (0, 0), 1.0)[..., None].astype(np.float32) / 255.0
            if colour is None:
                picture = picture * (1.0 - 0.3 * share)
            else:
                picture = picture * (1.0 - share) + np.array(colour, dtype=np.float32) * share
        noisy = picture + random.normal(0.0, 4.0, picture.shape)
        frames[row] = np.clip(noisy, 0, 255).astype(np.uint8)
    return frames


def rendered_lamprey(path: Path) -> list[Row]:
    """The midlines as footage of 1.5 megapixels: how far the axis that is found lies from them."""
    tracked = read_midlines(path)
    points = tracked.points * 1e3
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    scale = 1900.0 / float(high[0] - low[0] + 80.0)
    fine = equal_steps((points - low + 40.0) * scale, 400)
    size = (max(800, int((high[1] - low[1] + 80.0) * scale)), 1900)
    length = float(np.linalg.norm(np.diff(fine, axis=1), axis=2).sum(axis=1).mean())
    chosen = list(range(0, len(fine), 3))
    footage = Footage(
        drawn_footage([fine[k] for k in chosen], size, 0.028 * length),
        np.array(chosen), tracked.frame_s, assumed=False,
    )  # fmt: skip
    start = time.perf_counter()
    silhouettes, background = silhouettes_in(footage, None, None, "lamprey")
    seen = Seen(silhouettes, axes_in(silhouettes), background)
    found = tracked_axes(footage, seen)
    source = Source(file="lamprey", sha256="", frames=len(chosen), used=len(chosen))
    animal = describe(found, "lamprey", source, FaunaOptions()).animal
    build_animal(animal, MotionOptions(seconds=2.0))
    seconds = time.perf_counter() - start
    worst, mean = [], []
    for axis, frame in zip(found.points, found.frame, strict=True):
        shown = np.stack([axis[:, 0], size[0] - axis[:, 1]], axis=1)
        apart = np.linalg.norm(shown[:, None] - fine[int(frame)][None], axis=2).min(axis=1)
        ends = [np.linalg.norm(shown - fine[int(frame)][end], axis=1).min() for end in (0, -1)]
        worst.append(max(float(apart.max()), *map(float, ends)) / length)
        mean.append(float(apart.mean()) / length)
    within = float((np.array(worst) <= 0.02).mean())
    return [
        {"what": "lamprey drawn as footage: frames used", "value": len(worst) / len(chosen)},
        {"what": "axis from the midline, mean (of the length)", "value": float(np.mean(mean)),
         "bound": "0.02"},
        {"what": "axis and both ends, worst point, median frame", "value": float(np.median(worst)),
         "bound": "0.02"},
        {"what": "frames whose worst point is within 2 %", "value": within},
        {"what": f"model from {len(chosen)} frames of {size[0] * size[1] / 1e6:.1f} Mpx (s)",
         "value": seconds, "bound": "5 (paper: 26)"},
    ]  # fmt: skip


def unseen_worm(path: Path) -> list[Row]:
    """The worm's body from the even frames against the silhouettes of the odd ones."""
    footage = read_footage(path, None)
    silhouettes, _ = silhouettes_in(footage, None, None, path.name)
    axes = axes_in(silhouettes)
    even = [axis for axis in axes[::2] if axis is not None]
    half = np.median([axis.half_width for axis in even], axis=0)
    seen, unseen = [], []
    for k in range(1, len(axes) - 1, 2):
        before, here, after = axes[k - 1], axes[k], axes[k + 1]
        if before is None or here is None or after is None:
            continue
        mask = silhouettes.masks[k]
        seen.append(overlap(drawn_body(here.points, half, footage.size), mask))
        between = 0.5 * (before.points + after.points)
        unseen.append(overlap(drawn_body(between, half, footage.size), mask))
    return [
        {"what": "worm, unseen frames: IoU of the median frame, pose seen",
         "value": float(np.median(seen)), "bound": "0.85"},
        {"what": "worm, unseen frames: IoU of the median frame, pose unseen",
         "value": float(np.median(unseen)), "bound": "0.85"},
    ]  # fmt: skip


def new_motion(path: Path) -> list[Row]:
    """Walks through the motion graph: repeats, bends and jumps against the footage's."""
    tracked = read_midlines(path)
    angles = axis_angles(equal_steps(tracked.points, 101))
    states = coefficients(angles)
    frames = np.diff(tracked.frame) == 1
    kept = np.abs(np.diff(angles - angles.mean(axis=1, keepdims=True), axis=0))[frames]
    fastest = float(kept.max()) / tracked.frame_s
    sampling = StateSampling(count=40)
    sharpest, speed, windows = 0.0, 0.0, []
    for seed in range(WALKS):
        gait = roamed_gait("roam", states, tracked.frame_s, sampling, seed, 6.0, 0.5, follows=False)
        bends = np.abs(np.diff(gait.angles, axis=1)).max() * 100.0
        sharpest = max(sharpest, float(bends))
        step = np.abs(np.diff(gait.angles, axis=0)).max() / float(gait.times_s[1])
        speed = max(speed, float(step))
        windows.append(_windows(gait))
    every = np.concatenate(windows)
    apart = np.asarray(cKDTree(every).query(every, k=[2])[0])
    smallest = float(apart.min() / np.sqrt(every.shape[1]))
    least, most = curvature_range(without_turn(states), 100)
    return [
        {"what": f"{WALKS} walks: sharpest bend, of the footage's", "value":
         sharpest / max(-least, most), "bound": "1.05"},
        {"what": f"{WALKS} walks: fastest turn of a joint, of the footage's", "value":
         speed / fastest, "bound": "1"},
        {"what": f"{WALKS} walks: two stretches of 2 s nearest to each other (rad, rms)",
         "value": smallest, "bound": "> 0"},
    ]  # fmt: skip


def _windows(gait: Gait) -> Floats:
    """(k, d) stretches of two seconds, a second apart, at 10 places and 20 times each."""
    rate = 1.0 / float(gait.times_s[1])
    span, step = round(2.0 * rate), round(rate)
    starts = range(0, len(gait.times_s) - span, step)
    picked = np.linspace(0, span - 1, 20).round().astype(int)
    return np.stack([gait.angles[s + picked][:, ::10].ravel() for s in starts])


def million_cells() -> list[Row]:
    """A path through a million heights with obstacles, and 300 frames of new motion."""
    random = np.random.default_rng(0)
    rough = random.normal(size=(1000, 1000))
    heights = cv2.GaussianBlur(rough, (0, 0), 30.0)
    heights = heights / heights.std() * 4.0 + 0.15 * cv2.GaussianBlur(rough, (0, 0), 2.0)
    stones = cv2.GaussianBlur(random.normal(size=(1000, 1000)), (0, 0), 8.0)
    heights = np.where(stones > 2.0 * stones.std(), np.nan, heights)
    terrain = terrain_of_heights(heights.astype(np.float64), 0.25, (0.0, 0.0))
    points = np.array([[10.0, 10.0], [238.0, 118.0], [20.0, 240.0]])
    along = np.linspace(0.0, 1.0, 100)
    wave = np.sin(2.0 * np.pi * (np.arange(60)[:, None] / 25.0 - along))
    states = coefficients((0.2 + 0.5 * along) * wave)
    start = time.perf_counter()
    found = path_through(terrain, points, PathLimits(), 1.2)
    planned = time.perf_counter() - start
    roamed_gait("roam", states, 0.04, StateSampling(), 0, 10.0, 0.4, follows=True)
    seconds = time.perf_counter() - start
    cells = np.round(terrain.cell_of(found.points_m)).astype(int)
    clear = float(found.ways.free[cells[:, 0], cells[:, 1]].mean())
    off = np.abs(found.points_m[:, 2] - terrain.height_at(found.points_m)).max()
    return [
        {"what": "path over 1,000,000 heights (s)", "value": planned},
        {"what": "with 300 frames of new motion (s)", "value": seconds,
         "bound": "2 (paper: 22, of 10,000 vertices)"},
        {"what": "points of the path that are clear of obstacles", "value": clear, "bound": "1"},
        {"what": "path from the ground, worst (m)", "value": float(off)},
    ]  # fmt: skip


if __name__ == "__main__":
    main()
