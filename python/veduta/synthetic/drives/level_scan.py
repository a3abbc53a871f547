"""What a level 2D scanner sees of upright walls and round trunks: closed forms in the plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LevelScanner:
    """The figures of Frueh et al. 2005: 180 degrees at one, 80 m, sigma 3.5 cm.

    first_deg: the first beam, from straight ahead to the left; beams go on from there to the left.
    stray: share of beams that something unknown stops on their way. lost: share without an answer.
    """

    beams: int = 181
    first_deg: float = 0.0
    step_deg: float = 1.0
    farthest_m: float = 80.0
    sigma_m: float = 0.035
    stray: float = 0.03
    lost: float = 0.02

    def angles_rad(self) -> Floats:
        """(b,) from straight ahead to the left."""
        degrees = self.first_deg + self.step_deg * np.arange(self.beams)
        return np.asarray(np.deg2rad(degrees), dtype=np.float64)


def scan_level(
    walls: Floats,
    trunks: Floats,
    poses: Floats,
    scanner: LevelScanner,
    random: np.random.Generator,
) -> NDArray[np.float32]:
    """(s, b) ranges, 0 where nothing came back.

    walls: (w, 2, 2) their ends (m). trunks: (t, 3) x, y, radius. poses: (s, 3) x, y (m), heading.
    """
    angles = poses[:, 2, None] + scanner.angles_rad()
    ranges = np.empty(angles.shape)
    for row, pose in enumerate(poses):
        beams = np.stack([np.cos(angles[row]), np.sin(angles[row])], axis=1)
        ranges[row] = np.minimum(
            _to_walls(walls, pose[:2], beams), _to_trunks(trunks, pose[:2], beams)
        )
    stopped = random.uniform(size=ranges.shape) < scanner.stray
    ranges = np.where(
        stopped, ranges.clip(max=40.0) * random.uniform(0.1, 1.0, ranges.shape), ranges
    )
    ranges += random.normal(0.0, scanner.sigma_m, ranges.shape)
    silent = (ranges > scanner.farthest_m) | (random.uniform(size=ranges.shape) < scanner.lost)
    return np.where(silent, 0.0, ranges).astype(np.float32)


def _to_walls(walls: Floats, eye: Floats, beams: Floats) -> Floats:
    along = walls[:, 1] - walls[:, 0]
    offset = walls[:, 0] - eye
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = beams[:, :1] * along[:, 1] - beams[:, 1:] * along[:, 0]
        distance = (offset[:, 0] * along[:, 1] - offset[:, 1] * along[:, 0]) / cross
        share = (offset[:, 0] * beams[:, 1:] - offset[:, 1] * beams[:, :1]) / cross
        hit = (distance > 0.0) & (share >= 0.0) & (share <= 1.0)
    return np.asarray(np.where(hit, distance, np.inf).min(axis=1, initial=np.inf))


def _to_trunks(trunks: Floats, eye: Floats, beams: Floats) -> Floats:
    offset = trunks[:, :2] - eye
    ahead = beams @ offset.T
    inside = trunks[:, 2] ** 2 - ((offset**2).sum(axis=1) - ahead**2)
    distance = ahead - np.sqrt(np.maximum(inside, 0.0))
    hit = (inside > 0.0) & (distance > 0.0)
    return np.asarray(np.where(hit, distance, np.inf).min(axis=1, initial=np.inf))
