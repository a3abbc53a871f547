"""What was given, and how each key position of it becomes a model."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs import RigCalibration, find_calibration
from veduta.run.errors import InputError
from veduta.run.work import Work
from veduta.walk.build.place import world_from_first
from veduta.walk.keys import KeyModel, picture_of, read_key, views_by_key
from veduta.walk.options import TakeOptions
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import Rectifier, make_rectifier, read_pair
from veduta.walk.rig import Image, PairFiles, Rig

Matrix = NDArray[np.float64]


class WalkRecord(Protocol):
    """Key positions in their order."""

    @property
    def rig(self) -> Rig:
        """Two cameras side by side, or what stands for them."""

    @property
    def keys(self) -> list[tuple[PairFiles, ...]]:
        """The views of each key position."""

    @property
    def files(self) -> list[Path]:
        """All that the walk depends on."""

    @property
    def first(self) -> Matrix:
        """(4, 4) world_from_camera of the first key position."""

    @property
    def in_metres(self) -> bool:
        """Whether the scale is known; else neighbouring frames count as 1 apart."""

    def files_of(self, number: int) -> list[Path]:
        """What a key position depends on."""

    def key(self, work: Work, number: int) -> KeyModel:
        """Its model."""

    def picture(self, work: Work, number: int) -> Image:
        """What it shows, before colours are levelled along the walk."""

    def pose(self, first: int, second: int) -> Matrix | None:
        """(3, 4) second_from_first, where the record says it."""


@dataclass(frozen=True, eq=False)
class StereoRecord:
    """Stereo pairs, and how they are rectified. calibration: the files that it comes from."""

    keys: list[tuple[PairFiles, ...]]
    rectifier: Rectifier
    calibration: tuple[Path, ...]

    @property
    def rig(self) -> Rig:
        """The rectified one."""
        return self.rectifier.rig

    @property
    def files(self) -> list[Path]:
        """The calibration and all pictures."""
        return [
            *self.calibration,
            *(one for n in range(len(self.keys)) for one in self.files_of(n)),
        ]

    @property
    def first(self) -> Matrix:
        """Level at the origin, looking north."""
        return world_from_first()

    @property
    def in_metres(self) -> bool:
        """A rig's baseline says it."""
        return True

    def files_of(self, number: int) -> list[Path]:
        """Its pictures."""
        return [path for one in self.keys[number] for path in (one.left, one.right)]

    def key(self, work: Work, number: int) -> KeyModel:
        """From its pairs."""
        return read_key(work, self.keys[number], self.rectifier)

    def picture(self, work: Work, number: int) -> Image:
        """The left picture, or the mosaic."""
        return picture_of(work, self.keys[number], self.rectifier)

    def pose(self, first: int, second: int) -> Matrix | None:
        """Not known."""
        return None


def read_stereo_record(
    folder: Path, take: TakeOptions, calibration: Path | RigCalibration | None,
    boards: tuple[Path, ...] = (),
) -> StereoRecord:  # fmt: skip
    """The views that the options take; InputError where the folder is not right.

    calibration: the rig, or its file; None: that in the folder. boards: what a rig comes from.
    """
    keys = taken(views_by_key(find_pairs(folder)), take, folder)
    first = keys[0][0]
    if isinstance(calibration, RigCalibration):
        rig, sources = calibration, boards
    else:
        rig = find_calibration(folder, calibration, first.left.parent.name)
        sources = (rig.source,)
    left, _ = read_pair(first, None)
    return StereoRecord(keys, make_rectifier(rig, (left.shape[1], left.shape[0])), sources)


def taken(
    keys: list[tuple[PairFiles, ...]], take: TakeOptions, folder: Path
) -> list[tuple[PairFiles, ...]]:
    """The key positions that the options take; InputError where there are none."""
    found = keys[take.first :: take.every][: take.count]
    if not found:
        raise InputError(folder, f"has no key position {take.first}", "Begin at an earlier one.")
    return found
