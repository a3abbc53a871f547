"""The chain of horizontal scans: each onto the last key scan, from where the motion leads."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.scan_match import (
    Match,
    MatchParameters,
    Reference,
    align_scans,
    between,
    joined,
    match_scans,
    moved,
)

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ChainParameters:
    """Thresholds of the chain.

    key_m, key_rad: a scan so far from the last key scan becomes the next one. good_share: below it
    the correlative search looks around, first as `search`, then wider. fewest_share: below it a
    match is none, the motion goes on as before, and that is said. around: key scans that are
    matched onto at once.
    still_m, still_rad: least deviations of a step: beams of neighbours err alike, and the
    covariance of ICP takes them for independent. slip: of a step that was not matched.
    """

    key_m: float = 1.0
    key_rad: float = 0.25
    good_share: float = 0.75
    fewest_share: float = 0.4
    search: MatchParameters = field(default_factory=MatchParameters)
    wide: MatchParameters = field(
        default_factory=lambda: MatchParameters(reach_m=2.0, reach_rad=0.7, step_m=0.15)
    )
    widest: MatchParameters = field(
        default_factory=lambda: MatchParameters(
            reach_m=3.5, reach_rad=1.6, step_m=0.2, step_rad=0.03
        )
    )
    around: int = 3
    still_m: float = 0.01
    still_rad: float = 0.002
    slip: float = 0.3


@dataclass(frozen=True, eq=False)
class ScanChain:
    """key: (s,) the key scan of each scan; in_key: (s, 3) its pose there (m, rad).

    keys: (k,) rows of the key scans; poses: (k, 3) theirs, the first is 0; scans: their points;
    covariances: (k - 1, 3, 3) of the steps between them; lost: rows where nothing matched.
    """

    key: NDArray[np.int64]
    in_key: Floats
    keys: NDArray[np.int64]
    poses: Floats
    scans: list[Floats]
    covariances: Floats
    lost: list[int]

    def all_poses(self, poses: Floats) -> Floats:
        """(s, 3) poses of all scans where the key scans have these (k, 3)."""
        base = poses[self.key]
        cosine, sine = np.cos(base[:, 2]), np.sin(base[:, 2])
        x, y, turn = self.in_key.T
        return np.stack(
            [base[:, 0] + cosine * x - sine * y, base[:, 1] + sine * x + cosine * y,
             base[:, 2] + turn], axis=1,
        )  # fmt: skip


def chain_scans(
    scans: Iterable[Floats],
    guesses: Floats | None = None,
    parameters: ChainParameters | None = None,
) -> ScanChain:
    """scans: (n, 2) points each (m, vehicle), one at a time. guesses: (s, 3) odometry, if any.

    Without odometry each search starts where the motion so far leads.
    """
    chosen = parameters or ChainParameters()
    growing = _Growing(chosen)
    for row, points in enumerate(scans):
        growing.take(row, points, guesses)
    return growing.chain()


class _Growing:
    """A chain while it grows."""

    def __init__(self, chosen: ChainParameters) -> None:
        self._chosen = chosen
        self._key: list[int] = []
        self._in_key: list[Floats] = []
        self._keys: list[int] = []
        self._scans: list[Floats] = []
        self._steps: list[Floats] = []
        self._covariances: list[Floats] = []
        self._lost: list[int] = []
        self._broken: set[int] = set()
        self._motion = np.zeros(3)
        self._reference: Reference | None = None

    def take(self, row: int, points: Floats, guesses: Floats | None) -> None:
        if not self._keys:
            self._open(row, points, np.zeros(3))
            return
        last = self._in_key[-1]
        if guesses is not None:
            self._motion = between(guesses[row - 1], guesses[row])
        start = joined(last, self._motion)
        match, lost = self._matched(points, start)
        if lost:
            self._lost.append(row)
            self._broken.add(row)
        pose = match.pose
        far = float(np.hypot(pose[0], pose[1])) > self._chosen.key_m
        turned = abs(pose[2]) > self._chosen.key_rad
        self._motion = between(last, pose)
        if far or turned or lost:
            self._steps.append(pose)
            self._covariances.append(self._covariance(match, lost))
            self._open(row, points, np.zeros(3))
        else:
            self._key.append(len(self._keys) - 1)
            self._in_key.append(pose)

    def _open(self, row: int, points: Floats, pose: Floats) -> None:
        self._keys.append(row)
        self._scans.append(points)
        self._key.append(len(self._keys) - 1)
        self._in_key.append(pose)
        seen, place = [points], np.zeros(3)
        for back in range(1, min(self._chosen.around, len(self._keys))):
            if self._keys[-back] in self._broken:
                break
            place = joined(place, between(self._steps[-back], np.zeros(3)))
            seen.append(moved(place, self._scans[-1 - back]))
        together = np.concatenate(seen)
        self._reference = Reference(together) if len(together) >= 10 else None

    def _matched(self, points: Floats, start: Floats) -> tuple[Match, bool]:
        chosen, reference = self._chosen, self._reference
        if reference is None:
            return Match(start, np.eye(3), 0.0), True
        match = align_scans(reference, points, start, chosen.search)
        for search in (chosen.search, chosen.wide, chosen.widest):
            if match.share >= chosen.good_share:
                break
            origin = self._in_key[-1] if search is chosen.widest else start
            other = match_scans(reference, points, origin, search)
            match = other if other.share > match.share + 0.02 else match
        lost = match.share < chosen.fewest_share
        return (Match(start, match.covariance, match.share) if lost else match), lost

    def _covariance(self, match: Match, lost: bool) -> Floats:
        chosen = self._chosen
        if lost:
            return np.diag([chosen.slip**2, chosen.slip**2, (chosen.slip / 3.0) ** 2])
        least = np.diag([chosen.still_m**2, chosen.still_m**2, chosen.still_rad**2])
        return np.asarray(match.covariance + least, dtype=np.float64)

    def chain(self) -> ScanChain:
        poses = [np.zeros(3)]
        for step in self._steps:
            poses.append(joined(poses[-1], step))
        return ScanChain(
            np.array(self._key, dtype=np.int64),
            np.array(self._in_key).reshape(-1, 3),
            np.array(self._keys, dtype=np.int64),
            np.array(poses),
            self._scans,
            np.array(self._covariances).reshape(-1, 3, 3),
            self._lost,
        )
