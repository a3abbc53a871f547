"""Scan matching on the Intel lab: relations of Kuemmerle et al. 2009, from raw odometry and scans.

A chain of matches of each scan onto the one before starts the search for each relation's pair; the
corrected poses are never read.

    python benchmarks drive/intel_relations [DATA]
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import record

from veduta.drive.read.scan_match import (
    MatchParameters,
    between,
    joined,
    match_scans,
    moved,
)

FARTHEST_M, SAME_TIME_S, NEIGHBOURS, AROUND = 20.0, 0.001, 8, 4
WIDE = MatchParameters(reach_m=2.5, reach_rad=0.5)
CLOSE = MatchParameters(reach_m=0.2, reach_rad=0.1)
Floats = NDArray[np.float64]


def read_scans(path: Path) -> tuple[Floats, Floats, list[Floats]]:
    """(s,) times, (s, 3) raw odometry, and the points of each scan."""
    rows = sorted((float(key), value) for key, value in json.loads(path.read_text())["map"].items())
    times = np.array([time_s for time_s, _ in rows])
    odometry = np.array([(row["x"], row["y"], row["theta"]) for _, row in rows])
    scans = []
    for _, row in rows:
        ranges = np.array(row["range"], dtype=float)
        angles = np.deg2rad(np.arange(len(ranges)) * 180.0 / len(ranges) - 90.0)
        near = (ranges > 0.1) & (ranges < FARTHEST_M)
        scans.append((ranges * np.stack([np.cos(angles), np.sin(angles)]))[:, near].T)
    return times, odometry, scans


def relations(path: Path, times: Floats) -> list[tuple[int, int, Floats]]:
    """Pairs of scans and the pose of the second in the frame of the first."""
    found = []
    for line in path.read_text().splitlines():
        words = [float(word) for word in line.split()]
        rows = [int(np.argmin(np.abs(times - words[k]))) for k in (0, 1)]
        if all(abs(times[rows[k]] - words[k]) < SAME_TIME_S for k in (0, 1)) and rows[0] != rows[1]:
            found.append((rows[0], rows[1], np.array([words[2], words[3], words[7]])))
    return found


def submap(scans: list[Floats], poses: Floats, row: int, around: int) -> Floats:
    """(n, 2) a scan and those before and after it, in its frame."""
    rows = range(max(row - around, 0), min(row + around + 1, len(scans)))
    return np.concatenate(
        [moved(between(poses[row], poses[other]), scans[other]) for other in rows]
    )


def main() -> None:
    """Measure, print and keep."""
    root = Path(__file__).resolve().parents[3] / "shared/data"
    folder = (Path(sys.argv[1]) if len(sys.argv) > 1 else root) / "laser/carmen"
    times, odometry, scans = read_scans(folder / "intel_raw_odometry.json")
    begin = time.perf_counter()
    chain = [odometry[0]]
    for row in range(1, len(scans)):
        start = between(odometry[row - 1], odometry[row])
        step = match_scans(scans[row - 1], scans[row], start)
        chain.append(joined(chain[-1], step.pose if step.share > 0.4 else start))
    seconds = time.perf_counter() - begin
    pairs = relations(folder / "intel.relations", times)
    rows = []
    for name in ("raw odometry", "chain of matches", "pair matched"):
        errors = []
        for first, second, truth in pairs:
            poses = odometry if name == "raw odometry" else np.array(chain)
            guess = between(poses[first], poses[second])
            if name == "pair matched":
                near = abs(first - second) <= NEIGHBOURS
                around = AROUND if not near else 0
                one, two = (submap(scans, poses, row, around) for row in (first, second))
                guess = match_scans(one, two, guess, MatchParameters() if near else WIDE).pose
                guess = match_scans(scans[first], scans[second], guess, CLOSE).pose
            off = between(truth, guess)
            errors.append((np.hypot(off[0], off[1]), abs(np.degrees(off[2]))))
        apart = np.array(errors)
        rows.append({
            "path": name, "relations": len(pairs),
            "mean (m)": float(apart[:, 0].mean()), "median (m)": float(np.median(apart[:, 0])),
            "mean (deg)": float(apart[:, 1].mean()), "median (deg)": float(np.median(apart[:, 1])),
            "within 0.06 m": float((apart[:, 0] < 0.06).mean()),
        })  # fmt: skip
    record(
        "drive-intel-relations",
        rows,
        [
            f"Relations whose two times are scans (within {SAME_TIME_S} s). Bound: 0.06 m, 1 degree"
            " on average.",
            f"The chain of {len(scans)} scans took {seconds:.0f} s.",
        ],
    )


if __name__ == "__main__":
    main()
