"""Where the path comes back to a place: later key scans matched onto earlier ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.read.pose_graph import Step, spread_corrections
from veduta.drive.read.scan_chain import ScanChain
from veduta.drive.read.scan_match import MatchParameters, between, match_scans, moved

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LoopParameters:
    """Thresholds of loops.

    apart_m: a loop is at least so long. near_m, drift: two scans may be of one place where the path
    brings them within near_m plus its drift per metre between them, at most most_m. around: key
    scans before and after that are looked at together. least_share: of the points must match, both
    ways. every_m: between two loops that are tried. rounds: after each the path is corrected and
    loops are looked for anew, the drift taken for less. back: how far the match of the second onto
    the first may differ from that of the first onto the second (m, rad).
    """

    apart_m: float = 12.0
    near_m: float = 2.0
    drift: float = 0.02
    most_m: float = 6.0
    around: int = 2
    least_share: float = 0.75
    every_m: float = 2.0
    rounds: int = 3
    less: float = 0.4
    back: tuple[float, float] = (0.1, 0.02)


def close_loops(
    chain: ScanChain,
    told: Callable[[float], None] = lambda share: None,
    parameters: LoopParameters | None = None,
) -> tuple[Floats, list[Step]]:
    """(k, 3) the key scans' poses with all loops closed, and the loops."""
    chosen = parameters or LoopParameters()
    steps = chain_steps(chain)
    poses, loops, drift = chain.poses, list[Step](), chosen.drift
    for number in range(chosen.rounds):
        pairs = _pairs(poses, drift, chosen)
        found = []
        for row, (first, second, reach) in enumerate(pairs):
            told((number + row / len(pairs)) / chosen.rounds)
            step = _loop(chain, poses, first, second, reach, chosen)
            if step is not None:
                found.append(step)
        if not found:
            break
        loops = found
        poses = spread_corrections(chain.poses if number == 0 else poses, [*steps, *loops], [])
        drift *= chosen.less
    return poses, loops


def chain_steps(chain: ScanChain) -> list[Step]:
    """Its steps from each key scan to the next."""
    return [
        Step(row, row + 1, between(chain.poses[row], chain.poses[row + 1]), covariance)
        for row, covariance in enumerate(chain.covariances)
    ]


def _pairs(poses: Floats, drift: float, chosen: LoopParameters) -> list[tuple[int, int, float]]:
    """Earlier and later key scan, and how far off they may be (m); of close ones only one pair."""
    step = np.linalg.norm(np.diff(poses[:, :2], axis=0), axis=1)
    station = np.concatenate([[0.0], np.cumsum(step)])
    near = cKDTree(poses[:, :2]).query_pairs(chosen.most_m, output_type="ndarray")
    length = np.abs(station[near[:, 1]] - station[near[:, 0]])
    apart = np.linalg.norm(poses[near[:, 1], :2] - poses[near[:, 0], :2], axis=1)
    reach = np.minimum(chosen.near_m + drift * length, chosen.most_m)
    usable = (length > chosen.apart_m) & (apart < reach)
    near, apart, reach = np.sort(near[usable], axis=1), apart[usable], reach[usable]
    taken: set[tuple[int, int]] = set()
    found = []
    for row in np.argsort(apart, kind="stable").tolist():
        first, second = int(near[row, 0]), int(near[row, 1])
        cell = (int(station[first] / chosen.every_m), int(station[second] / chosen.every_m))
        # One for each stretch of the later pass, and one earlier place at a time.
        if cell in taken or (-1, cell[1]) in taken:
            continue
        taken |= {cell, (-1, cell[1])}
        found.append((first, second, float(reach[row])))
    return sorted(found)


def _loop(
    chain: ScanChain, poses: Floats, first: int, second: int, reach: float, chosen: LoopParameters
) -> Step | None:
    one, two = (_around(chain, row, chosen.around) for row in (first, second))
    start = between(poses[first], poses[second])
    search = MatchParameters(
        reach_m=reach, reach_rad=0.4, step_m=max(reach / 12, 0.1), step_rad=0.03
    )
    match = match_scans(one, two, start, search)
    if match.share < chosen.least_share:
        return None
    forward = match_scans(one, chain.scans[second], match.pose, _CLOSE)
    backward = match_scans(two, chain.scans[first], between(forward.pose, np.zeros(3)), _CLOSE)
    if min(forward.share, backward.share) < chosen.least_share:
        return None
    back = between(backward.pose, np.zeros(3))
    off = between(forward.pose, back)
    if np.hypot(off[0], off[1]) > chosen.back[0] or abs(off[2]) > chosen.back[1]:
        return None
    least = np.diag([0.03**2, 0.03**2, 0.005**2])
    return Step(first, second, forward.pose, forward.covariance + least, robust=True)


_CLOSE = MatchParameters(reach_m=0.3, reach_rad=0.1)


def _around(chain: ScanChain, row: int, around: int) -> Floats:
    """(n, 2) a key scan with those before and after it, in its frame."""
    rows = range(max(row - around, 0), min(row + around + 1, len(chain.keys)))
    return np.concatenate([
        moved(between(chain.poses[row], chain.poses[other]), chain.scans[other]) for other in rows
    ])  # fmt: skip
