"""Panoramas along a path as a record: each is a key position, its views are joined to a mosaic."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.work import Work
from veduta.walk.build.key_file import arrays_of_mosaic, mosaic_of
from veduta.walk.build.local_model import LocalModel, model_of_depth
from veduta.walk.build.mosaic import Mosaic, make_mosaic
from veduta.walk.build.photo_depth import FramePlanes
from veduta.walk.build.place import world_from_first
from veduta.walk.build.turns import Turns
from veduta.walk.keys import KeyFigures, KeyModel
from veduta.walk.options import TakeOptions
from veduta.walk.read.photo_path import PhotoPath, between, centre_of
from veduta.walk.record import Matrix, taken
from veduta.walk.rig import Image, PairFiles, Rig

BESIDE_RAD = 1.0
"""Between the axes of views that overlap: views of a panorama are 45 degrees apart, 90 wide."""


@dataclass(frozen=True, eq=False)
class PanoramaRecord:
    """path: all views. panoramas: of each key position its views' numbers, by direction.

    chosen: those of the panoramas that are key positions; all of them give depth. alone: names of
    views to a side to which no other panorama has one: they are left out, for they have no depth.
    """

    path: PhotoPath
    panoramas: list[tuple[str, dict[int, int]]]
    chosen: list[int]
    sources: tuple[Path, ...]
    alone: tuple[str, ...] = ()

    @cached_property
    def rig(self) -> Rig:
        """A view of two neighbouring panoramas as two cameras."""
        one = self.path.cameras[0]
        steps = np.linalg.norm(np.diff(self._centres, axis=0), axis=1)
        baseline_m = float(np.median(steps))
        return Rig(one.width_px, one.height_px, one.focal_px, one.centre_px, baseline_m)

    @cached_property
    def _centres(self) -> Matrix:
        """(p, 3) where the panoramas were taken: in the middle of their views' places."""
        return np.array(
            [
                np.median([centre_of(self.path.cameras[n]) for n in views.values()], axis=0)
                for _, views in self.panoramas
            ]
        )

    @cached_property
    def _fronts(self) -> list[int]:
        """The view of each panorama that looks along the path."""
        ahead = np.diff(self._centres, axis=0, append=self._centres[-1:])
        ahead[-1] = ahead[-2]
        fronts = []
        for (_, views), along in zip(self.panoramas, ahead, strict=True):
            towards = {
                n: float(self.path.cameras[n].cam_from_world[2, :3] @ along) for n in views.values()
            }
            fronts.append(max(towards, key=lambda n: towards[n]))
        return fronts

    @property
    def keys(self) -> list[tuple[PairFiles, ...]]:
        """The views of each panorama, and the same of the next one."""
        return [self._views(one) for one in self.chosen]

    def _views(self, panorama: int) -> tuple[PairFiles, ...]:
        name, views = self.panoramas[panorama]
        other = self.panoramas[panorama + 1 if panorama + 1 < len(self.panoramas) else panorama - 1]
        pairs = self.path.pairs
        return tuple(
            PairFiles(name, str(side), pairs[n].left, pairs[other[1].get(side, n)].left)
            for side, n in sorted(views.items())
        )

    @property
    def files(self) -> list[Path]:
        """The cameras' files and all views."""
        return [*self.sources, *(pair.left for pair in self.path.pairs)]

    def files_of(self, number: int) -> list[Path]:
        """Those of the panorama, of the ones beside it, and the cameras'."""
        around = range(
            max(0, self.chosen[number] - 1), min(len(self.panoramas), self.chosen[number] + 2)
        )
        pairs = self.path.pairs
        return [
            *self.sources,
            *(pairs[n].left for one in around for n in self.panoramas[one][1].values()),
        ]

    @property
    def in_metres(self) -> bool:
        """As the cameras are."""
        return self.path.known

    @property
    def first(self) -> Matrix:
        """As the cameras say, where they are in metres; else level at the origin."""
        if not self.path.known:
            return world_from_first()
        front = self.path.cameras[self._fronts[self.chosen[0]]]
        return np.asarray(np.linalg.inv(np.vstack([front.cam_from_world, [0.0, 0.0, 0.0, 1.0]])))

    @cached_property
    def _planes(self) -> FramePlanes:
        most = 3 * max(len(views) for _, views in self.panoramas)
        return FramePlanes(
            self.path.cameras, self.path.picture, self.path.span, around=self.around, kept=most
        )

    @cached_property
    def around(self) -> tuple[tuple[int, ...], ...]:
        """The views that each is compared with: those to the same side, before and after.

        At an end of the path there is one, and where it was taken ahead the rim of this one is
        outside of it: there those beside it are asked, too.
        """
        found: dict[int, tuple[int, ...]] = {}
        for side in sorted({side for _, views in self.panoramas for side in views}):
            along = [views for _, views in self.panoramas if side in views]
            for place, views in enumerate(along):
                others = [along[n] for n in (place - 1, place + 1) if 0 <= n < len(along)]
                same = tuple(other[side] for other in others)
                more = self._overlapping(views[side], others[0]) if len(others) == 1 else []
                found[views[side]] = (*same, *(n for n in more if n not in same))
        return tuple(found.get(n, ()) for n in range(len(self.path.cameras)))

    def _overlapping(self, view: int, others: dict[int, int]) -> list[int]:
        """Those of another panorama's views that look less than `BESIDE_RAD` aside of one."""
        ahead = [camera.cam_from_world[2, :3] for camera in self.path.cameras]
        least = float(np.cos(BESIDE_RAD))
        return [n for n in others.values() if float(ahead[n] @ ahead[view]) > least]

    def key(self, work: Work, number: int) -> KeyModel:
        """The mosaic of a panorama's views, whose rotations the cameras say."""
        self.path.tell(work)
        if self.alone and (note := self._left_out()) not in work.notes:
            work.note(note)
        mosaic = mosaic_of(self.panoramas[self.chosen[number]][0], self._arrays(work, number))
        turns = mosaic.turns
        return KeyModel(mosaic.model, KeyFigures(turns.front_from_view, turns.front, mosaic.gap))

    def _arrays(self, work: Work, number: int) -> dict[str, NDArray[Any]]:
        """The mosaic, kept: it is wanted again for its picture."""
        inputs = [file_digest(path) for path in self.files_of(number)]
        inputs.append(f"{self.panoramas[self.chosen[number]]}")
        return work.kept_arrays(
            f"mosaic-{number:04d}", [*inputs, repr(self.rig)],
            lambda: arrays_of_mosaic(self._mosaic(number), front=False),
        )  # fmt: skip

    def _mosaic(self, number: int) -> Mosaic:
        name, views = self.panoramas[self.chosen[number]]
        order = sorted(views)
        models = [self._model(name, views[side]) for side in order]
        front = self._fronts[self.chosen[number]]
        cameras = self.path.cameras
        turns = np.array([between(cameras[views[n]], cameras[front])[:, :3] for n in order])
        known = Turns([views[side] for side in order].index(front), turns, 0, 0.0)
        return make_mosaic(models, known)

    def _left_out(self) -> str:
        return f"left out, for no other panorama has a view to that side: {', '.join(self.alone)}"

    def _model(self, name: str, view: int) -> LocalModel:
        depth, sure = self._planes.depth(view)
        return model_of_depth(name, self.path.picture(view), depth, sure, self.rig)

    def picture(self, work: Work, number: int) -> Image:
        """What the mosaic shows."""
        return np.asarray(self._arrays(work, number)["image"], dtype=np.uint8)

    def pose(self, first: int, second: int) -> Matrix | None:
        """From front view to front view, as the cameras say."""
        fronts = [self.path.cameras[self._fronts[self.chosen[n]]] for n in (first, second)]
        return between(*fronts)


def panorama_record(
    path: PhotoPath, views: dict[str, dict[int, int]], take: TakeOptions, folder: Path,
    sources: tuple[Path, ...],
) -> PanoramaRecord:  # fmt: skip
    """The panoramas that the options take; InputError where no two have views to one side."""
    often = Counter(side for sides in views.values() for side in sides)
    panoramas, alone = [], []
    for name, sides in views.items():
        shared = {side: n for side, n in sides.items() if often[side] > 1}
        alone += [path.given[n].name for side, n in sides.items() if often[side] == 1]
        if shared:
            panoramas.append((name, shared))
    if len(panoramas) < 2:
        raise InputError(
            path.source, "has no two panoramas with views to the same side",
            "Take them nearer to each other, and run `veduta photos` over them again.",
        )  # fmt: skip
    left = tuple(alone)
    whole = PanoramaRecord(path, panoramas, list(range(len(panoramas))), sources, left)
    names = [views[0].key for views in taken(whole.keys, take, folder)]
    chosen = [number for number, (name, _) in enumerate(panoramas) if name in set(names)]
    return PanoramaRecord(path, panoramas, chosen, sources, left)
