"""How well `veduta drive` tells what stands before a facade from the facade: KITTI's labels.

`kitti00` has a semantic class for every point; the verb never reads it. Per point, over points
nearer than the labelled facade of their column: cars, poles and trunks found, plants found,
building kept. The street was looked at while the thresholds were set: nothing of it is held out.

    python benchmarks drive/kitti_labels [DATA]
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import record

from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import frame_of, reconstruct
from veduta.drive.options import DriveOptions
from veduta.drive.read.kitti import OWN_VEHICLE_M, read_kitti
from veduta.drive.read.segments import cut_segments, driven_line

GROUPS: tuple[tuple[str, tuple[int, ...], float], ...] = (
    ("cars found", (10, 252), 0.99),
    ("poles and signs found", (80, 81), 0.99),
    ("trunks found", (71,), 0.99),
    ("plants found", (70,), 0.95),
)
BUILDING, FEWEST, OVER_GROUND_M = 50, 5, 0.3


def labels_of(folder: Path, name: str) -> NDArray[np.int64]:
    """(n,) the class of each usable point of a scan, in the reader's order."""
    rows = np.fromfile(folder / "velodyne" / f"{name}.bin", "<f4").reshape(-1, 4)[:, :3]
    rows = rows.astype(np.float64)
    kept = np.isfinite(rows).all(axis=1) & ((rows**2).sum(axis=1) > OWN_VEHICLE_M**2)
    label = np.fromfile(folder / "labels" / f"{name}.label", "<u4") & 0xFFFF
    return np.asarray(label[kept], dtype=np.int64)


def measure(folder: Path, options: DriveOptions) -> list[dict[str, str | int | float | None]]:
    """A row for each group of classes, over both sides of the street."""
    begin = time.perf_counter()
    drive = read_kitti(folder, options.seed)
    points = np.concatenate([sweep.world_points() for sweep in drive.sweeps])
    label = np.concatenate([labels_of(folder, sweep.name) for sweep in drive.sweeps])
    columns = options.columns
    line = driven_line(drive.path(), columns.column_spacing_m, columns.reach_m)
    road_m = float(drive.sweeps[0].world_from_sensor[2, 3])
    found: dict[str, list[NDArray[np.bool_]]] = {name: [] for name, _, _ in GROUPS}
    kept, plain_kept = [], []
    plain: dict[str, list[NDArray[np.bool_]]] = {name: [] for name, _, _ in GROUPS}
    for segment in cut_segments(line, columns.column_spacing_m):
        frame = frame_of(segment, options, road_m)
        layers = reconstruct(segment, frame, points, options).layers
        own = label[layers.points.index]
        depth, column = layers.points.depth, layers.points.column
        facade = _facade(
            column, depth, (own == BUILDING) & (layers.above > OVER_GROUND_M), frame.shape[1]
        )
        with np.errstate(invalid="ignore"):
            nearer = depth < facade[column]
        taken = layers.kind == PointClass.FOREGROUND
        simple = _far_peak(column, depth, layers.above, frame.shape[1])
        for name, classes, _ in GROUPS:
            chosen = nearer & np.isin(own, classes)
            found[name].append(taken[chosen])
            plain[name].append(simple[chosen])
        kept.append(~taken[nearer & (own == BUILDING)])
        plain_kept.append(~simple[nearer & (own == BUILDING)])
    seconds = time.perf_counter() - begin
    rows: list[dict[str, str | int | float | None]] = []
    for name, _, bound in GROUPS:
        share = float(np.concatenate(found[name]).mean())
        rows.append(
            _row(name, len(np.concatenate(found[name])), share, bound, np.concatenate(plain[name]))
        )
    share = float(np.concatenate(kept).mean())
    rows.append(
        _row("building kept", len(np.concatenate(kept)), share, 0.97, np.concatenate(plain_kept))
    )
    rows.append({"what": "time (s)", "share": round(seconds, 1)})
    return rows


def _row(
    what: str, count: int, share: float, bound: float, plain: NDArray[np.bool_]
) -> dict[str, str | int | float | None]:
    return {
        "what": what, "points": count, "share": share, "bound": bound,
        "holds": "yes" if share >= bound else "missed",
        "plain histogram": float(plain.mean()),
    }  # fmt: skip


def _facade(
    column: NDArray[np.int32], depth: NDArray[np.float32], wall: NDArray[np.bool_], count: int
) -> NDArray[np.float64]:
    """(c,) the middle depth of the labelled building points of each column; NaN with too few."""
    facade = np.full(count, np.nan)
    order = np.argsort(column[wall], kind="stable")
    numbers, first = np.unique(column[wall][order], return_index=True)
    for number, group in zip(numbers, np.split(depth[wall][order], first[1:]), strict=True):
        if len(group) >= FEWEST:
            facade[number] = np.median(group)
    return facade


def _far_peak(
    column: NDArray[np.int32], depth: NDArray[np.float32], above: NDArray[np.float32], count: int
) -> NDArray[np.bool_]:
    """(n,) what a plain histogram takes out: all that is 0.75 m before the farthest depth with half
    as many points as the fullest.
    """
    bins = 100
    high = above > OVER_GROUND_M
    cell = column[high].astype(np.int64) * bins + np.minimum(depth[high] / 0.25, bins - 1).astype(
        int
    )
    histogram = np.bincount(cell, minlength=count * bins).reshape(count, bins)
    full = histogram >= np.maximum(0.5 * histogram.max(axis=1, keepdims=True), 1)
    far = (bins - 1 - np.argmax(full[:, ::-1], axis=1)) * 0.25
    return np.asarray(high & (depth < far[column] - 0.75))


def main() -> None:
    """Measure, print and keep."""
    given = (
        Path(sys.argv[1])
        if len(sys.argv) > 1
        else Path(__file__).resolve().parents[3] / "shared/data"
    )
    rows = measure(given / "laser" / "kitti00", DriveOptions())
    record(
        "drive-kitti-labels",
        rows,
        [
            "Points nearer than the labelled facade of their column, both sides of the street.",
            "plain histogram: what is 0.75 m before the farthest depth with half of the points of"
            " the fullest.",
            "The thresholds were set on this street: nothing of it is held out.",
        ],
    )


if __name__ == "__main__":
    main()
