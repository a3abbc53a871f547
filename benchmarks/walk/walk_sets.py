"""The paths with known poses: `stereo/kitti03` and `stereo/kitti-seq1`."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs import find_calibration
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import Rectifier, make_rectifier, read_pair, read_stereo
from veduta.walk.rig import PairFiles, Rig

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("VEDUTA_DATA", ROOT.parent / "shared" / "data"))
Matrix = NDArray[np.float64]


@dataclass
class PathSet:
    """Pairs along a path, and the true pose of each left camera."""

    name: str
    pairs: list[PairFiles]
    rectifier: Rectifier
    poses: list[Matrix]
    models: dict[int, LocalModel] = field(default_factory=dict)

    @property
    def rig(self) -> Rig:
        """The rectified one."""
        return self.rectifier.rig

    def model(self, number: int) -> LocalModel:
        """The local model of a pair; the last few are kept."""
        if number not in self.models:
            if len(self.models) > 8:
                self.models.pop(next(iter(self.models)))
            pair = read_stereo(self.pairs[number], self.rectifier)
            self.models[number] = build_local_model(pair, self.rig)
        return self.models[number]

    def true_pose(self, first: int, second: int) -> Matrix:
        """(3, 4) second_from_first of the left cameras."""
        return np.asarray(np.linalg.inv(self.poses[second]) @ self.poses[first])[:3]


def load_set(name: str) -> PathSet:
    """A set by the name of its folder in `stereo/`; its poses are one per original frame."""
    folder = DATA / "stereo" / name
    pairs = find_pairs(folder)
    calibration = find_calibration(folder, None, pairs[0].left.parent.name)
    left, _ = read_pair(pairs[0], None)
    rows = np.loadtxt(folder / "poses.txt").reshape(-1, 3, 4)
    poses = [np.vstack([rows[int(pair.key)], [0.0, 0.0, 0.0, 1.0]]) for pair in pairs]
    rectifier = make_rectifier(calibration, (left.shape[1], left.shape[0]))
    return PathSet(name, pairs, rectifier, poses)


def between(true_end: Matrix, found_end: Matrix, true_middle: Matrix) -> tuple[Matrix, float]:
    """The pose of an omitted camera beside an end that was found and not given; and its share.

    All (3, 4), from the first camera. What the found end is off in length and direction, the
    omitted one is off in proportion: it stands where it does on the way.
    """
    centres = [-pose[:, :3].T @ pose[:, 3] for pose in (true_end, found_end, true_middle)]
    lengths = [float(np.linalg.norm(centre)) for centre in centres]
    aside = np.cross(centres[0] / lengths[0], centres[1] / lengths[1])
    turn = cv2.Rodrigues(aside)[0]
    centre = lengths[1] / lengths[0] * turn @ centres[2]
    share = lengths[2] / lengths[0]
    drift = cv2.Rodrigues(found_end[:, :3] @ true_end[:, :3].T)[0] * share
    rotation = cv2.Rodrigues(drift)[0] @ true_middle[:, :3]
    return np.column_stack([rotation, -rotation @ centre]), share
