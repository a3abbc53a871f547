"""aces, csail, orebro: the path from scans alone, against the corrected poses of the logs.

Of a log only the ranges and the order of its laser lines are read; its poses, which are the
answer, are compared with afterwards.

    python benchmarks drive/carmen_paths [DATA]
"""

from __future__ import annotations

import gzip
import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import record

from veduta.drive.read.loops import close_loops
from veduta.drive.read.scan_chain import chain_scans
from veduta.drive.read.scan_match import between

FARTHEST_M = 20.0
LOGS = ("aces", "csail", "orebro")
NOTES = [
    "Scans alone: no odometry. The reference is the corrected path of each log, itself made by"
    " others' scan matching (Radish); whole paths are compared after the best rigid motion.",
    "Missed: scans a metre apart in corridors slide along them, whole paths drift and loops stay"
    " open. Tried: searching all places around each scan (steps then fell to nothing in corridors:"
    " 103 of 440 of aces off by over 0.25 m), and matching onto several key scans at once (kept).",
]
Floats = NDArray[np.float64]


def read_log(path: Path) -> tuple[list[Floats], Floats]:
    """Points of each scan in the frame of the scanner, and the corrected poses (s, 3)."""
    scans, poses = [], []
    with gzip.open(path, "rt", encoding="latin-1") as file:
        for line in file:
            words = line.split()
            if not words or words[0] != "FLASER":
                continue
            count = int(words[1])
            ranges = np.array(words[2 : 2 + count], dtype=float)
            step = np.pi / count if count % 2 == 0 else np.pi / (count - 1)
            angles = np.arange(count) * step - np.pi / 2
            near = (ranges > 0.1) & (ranges < FARTHEST_M)
            scans.append((ranges * np.stack([np.cos(angles), np.sin(angles)]))[:, near].T)
            poses.append(np.array(words[2 + count : 5 + count], dtype=float))
    return scans, np.array(poses)


def aligned(found: Floats, truth: Floats) -> Floats:
    """(s,) m between positions after the best rigid motion."""
    one = (found[:, :2] - found[:, :2].mean(axis=0)) @ np.array([1.0, 1j])
    two = (truth[:, :2] - truth[:, :2].mean(axis=0)) @ np.array([1.0, 1j])
    turn = np.exp(1j * np.angle((np.conj(one) * two).sum()))
    return np.asarray(np.abs(one * turn - two))


def relative(found: Floats, truth: Floats, apart_m: float) -> tuple[float, float, float]:
    """Median and mean (m), mean (deg) of the pose of a scan as seen from one `apart_m` before
    it.
    """
    step = np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1)
    station = np.concatenate([[0.0], np.cumsum(step)])
    errors = []
    for row in range(len(truth)):
        later = max(int(np.searchsorted(station, station[row] + apart_m)), row + 1)
        if later >= len(truth):
            break
        off = between(between(truth[row], truth[later]), between(found[row], found[later]))
        errors.append((np.hypot(off[0], off[1]), abs(np.rad2deg(off[2]))))
    apart = np.array(errors)
    return float(np.median(apart[:, 0])), float(apart[:, 0].mean()), float(apart[:, 1].mean())


def main() -> None:
    """Measure, print and keep."""
    root = Path(__file__).resolve().parents[3] / "shared/data"
    folder = (Path(sys.argv[1]) if len(sys.argv) > 1 else root) / "laser/carmen"
    rows: list[dict[str, str | int | float | bool | None]] = []
    for name in LOGS:
        scans, truth = read_log(folder / f"{name}-corrected.log.gz")
        begin = time.perf_counter()
        chain = chain_scans(scans)
        chained_s = time.perf_counter() - begin
        closed, loops = close_loops(chain)
        for path, poses in (("chain", chain.poses), ("loops closed", closed)):
            found = chain.all_poses(poses)
            off = aligned(found, truth)
            near, far = relative(found, truth, 0.0), relative(found, truth, 10.0)
            rows.append({
                "log": name, "path": path, "scans": len(scans), "not matched": len(chain.lost),
                "length (m)": float(np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1).sum()),
                "loops": len(loops) if path != "chain" else 0,
                "next scan: median (m)": near[0], "next scan: mean (m)": near[1],
                "next scan: mean (deg)": near[2],
                "10 m on: mean (m)": far[1], "10 m on: mean (deg)": far[2],
                "whole path: RMS (m)": float(np.sqrt((off**2).mean())),
                "whole path: most (m)": float(off.max()),
                "seconds": chained_s if path == "chain" else time.perf_counter() - begin,
            })  # fmt: skip
            print(rows[-1], flush=True)
    record("drive-carmen-paths", rows, NOTES)


if __name__ == "__main__":
    main()
