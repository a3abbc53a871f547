"""A single camera's path as a record of key positions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.run.digests import file_digest
from veduta.run.work import Work
from veduta.walk.build.local_model import LocalModel, model_of_depth
from veduta.walk.build.photo_depth import FramePlanes
from veduta.walk.build.place import world_from_first
from veduta.walk.keys import KeyFigures, KeyModel
from veduta.walk.options import TakeOptions
from veduta.walk.panorama_record import PanoramaRecord, panorama_record
from veduta.walk.read.photo_path import PhotoPath, read_photo_path, views_of_panoramas
from veduta.walk.record import Matrix, taken
from veduta.walk.rig import Image, PairFiles, Rig


@dataclass(frozen=True, eq=False)
class PhotoRecord:
    """Frames whose cameras are known. numbers: those of the frames that are key positions."""

    path: PhotoPath
    numbers: list[int]
    sources: tuple[Path, ...]

    @property
    def rig(self) -> Rig:
        """Neighbouring frames as two cameras."""
        return self.path.rig

    @property
    def keys(self) -> list[tuple[PairFiles, ...]]:
        """One view each: the frame and the next one."""
        pairs = self.path.pairs
        return [(pairs[n],) for n in self.numbers]

    @property
    def files(self) -> list[Path]:
        """The cameras' files and all frames that count."""
        around = {n for number in self.numbers for n in self._around(number)}
        pairs = self.path.pairs
        return [*self.sources, *(pairs[n].left for n in sorted(around))]

    @property
    def in_metres(self) -> bool:
        """As the cameras are."""
        return self.path.known

    @property
    def first(self) -> Matrix:
        """As the cameras say, where they are in metres; else level at the origin."""
        if not self.path.known:
            return world_from_first()
        pose = np.vstack([self.path.cameras[self.numbers[0]].cam_from_world, [0.0, 0.0, 0.0, 1.0]])
        return np.asarray(np.linalg.inv(pose))

    @cached_property
    def _planes(self) -> FramePlanes:
        return FramePlanes(self.path.cameras, self.path.picture, self.path.span)

    def _around(self, number: int) -> list[int]:
        return [number, *self._planes.neighbours(number)]

    def files_of(self, number: int) -> list[Path]:
        """The frame, those beside it, and the cameras."""
        pairs = self.path.pairs
        return [*self.sources, *(pairs[n].left for n in self._around(self.numbers[number]))]

    def key(self, work: Work, number: int) -> KeyModel:
        """Depth from the frames before and after; kept, for a run that is killed and for links."""
        self.path.tell(work)
        frame = self.numbers[number]
        found = work.kept_arrays(
            f"frame-{frame:04d}", [*map(file_digest, self.files_of(number)), repr(self.rig)],
            lambda: dict(zip(("depth", "sure"), self._planes.depth(frame), strict=True)),
        )  # fmt: skip
        return KeyModel(self._model(frame, found), KeyFigures(np.eye(3)[None]))

    def _model(self, frame: int, found: dict[str, NDArray[Any]]) -> LocalModel:
        """found: its depth, and where that is sure."""
        depth, sure = found["depth"], found["sure"]
        return model_of_depth(
            self.path.pairs[frame].key, self.path.picture(frame), depth, sure, self.rig
        )

    def picture(self, work: Work, number: int) -> Image:
        """The frame."""
        return self.path.picture(self.numbers[number])

    def pose(self, first: int, second: int) -> Matrix | None:
        """As the cameras say."""
        return self.path.pose(self.numbers[first], self.numbers[second])


def read_photo_record(
    folder: Path, cameras: Path, take: TakeOptions, largest_px: int
) -> PhotoRecord | PanoramaRecord:
    """The frames that the options take, or the panoramas whose views they are; all give depth."""
    path = read_photo_path(folder, cameras, largest_px)
    views = views_of_panoramas([one.name for one in path.given])
    if views is not None and len(views) > 1:
        return panorama_record(path, views, take, folder, _sources(cameras))
    numbered: list[tuple[PairFiles, ...]] = [(pair,) for pair in path.pairs]
    chosen = {views[0].left for views in taken(numbered, take, folder)}
    numbers = [n for n, pair in enumerate(path.pairs) if pair.left in chosen]
    return PhotoRecord(path, numbers, _sources(cameras))


def _sources(cameras: Path) -> tuple[Path, ...]:
    """The files that say where the cameras are."""
    if cameras.is_file():
        return (cameras,)
    inner = sorted(one for one in cameras.rglob("*") if one.is_file() and _says_cameras(one))
    return tuple(inner)


def _says_cameras(path: Path) -> bool:
    return path.suffix in {".bin", ".txt", ".json", ".camera", ".mat", ".yaml", ".yml"} and (
        not path.name.startswith("report") and ".veduta" not in path.parts
    )
