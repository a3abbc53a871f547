"""The images of a drive with what hides facades in each, a few in memory at a time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from scipy.spatial import cKDTree

from veduta.drive.build.backdrop import Backdrop
from veduta.drive.build.misfit import Frame
from veduta.drive.build.pictures_of import Around, Seen, look, read_shot
from veduta.drive.document.model import DriveSegment
from veduta.drive.record import Shot

T = TypeVar("T")


@dataclass(frozen=True)
class NearParameters:
    """near_m: images taken farther away add nothing to a facade, and nothing farther hides one.
    most_images: of a segment; of more each second, third ... is taken, the same ones for segments
    beside each other. held_images, held_segments: in memory at once. moved_m: images taken so far apart are compared:
    from nearer ones nothing moves, farther ones differ.
    """

    near_m: float = 45.0
    most_images: int = 40
    held_images: int = 24
    held_segments: int = 6
    moved_m: tuple[float, float] = (0.05, 5.0)


class NearImages:
    """segments: each with what loads its surroundings. looked: how many images were looked at."""

    def __init__(
        self,
        shots: Sequence[Shot],
        segments: Sequence[tuple[DriveSegment, Callable[[], Around]]],
        parameters: NearParameters | None = None,
    ) -> None:
        self._chosen = parameters or NearParameters()
        self._shots = shots
        self._places = np.array([shot.world_from_cam[:3, 3] for shot in shots]).reshape(-1, 3)
        self._segments = segments
        self._lines = [np.array(segment.line)[:, :2] for segment, _ in segments]
        self._seen: OrderedDict[int, Seen] = OrderedDict()
        self._frames: OrderedDict[int, Frame] = OrderedDict()
        self._around: OrderedDict[int, Around] = OrderedDict()
        self.looked = 0

    def near(self, segment: DriveSegment) -> list[Seen]:
        """Those taken near a segment, in their order."""
        if not len(self._shots):
            return []
        distance, _ = cKDTree(np.array(segment.line)[:, :2]).query(self._places[:, :2])
        rows = np.flatnonzero(distance < self._chosen.near_m)
        every = 1
        while (rows % every == 0).sum() > self._chosen.most_images:
            every += 1
        return [self._one(row) for row in rows[rows % every == 0].tolist()]

    def _one(self, row: int) -> Seen:
        def made() -> Seen:
            self.looked += 1
            beside = [self._frame(other) for other in self._beside(row)]
            return look(self._frame(row), self._surroundings(row), beside)

        return _held(self._seen, row, made, self._chosen.held_images)

    def _frame(self, row: int) -> Frame:
        most = self._chosen.held_images
        return _held(self._frames, row, lambda: read_shot(self._shots[row]), most)

    def _beside(self, row: int) -> list[int]:
        """The last image before and the first one after it from which things move."""
        away = np.linalg.norm(self._places - self._places[row], axis=1)
        least, most = self._chosen.moved_m
        usable = (away >= least) & (away <= most)
        before, after = np.flatnonzero(usable[:row]), np.flatnonzero(usable[row + 1 :])
        return [int(one) for one in (*before[-1:], *(after[:1] + row + 1))]

    def _surroundings(self, row: int) -> Around:
        """Of all segments that an image can show."""
        eye, reach = self._places[row], 2 * self._chosen.near_m
        foreground, crowns, solid = ([np.zeros((0, 3))] for _ in range(3))
        backdrops: list[Backdrop] = []
        for number, line in enumerate(self._lines):
            if np.linalg.norm(line - eye[:2], axis=1).min() > reach:
                continue
            load = self._segments[number][1]
            own = _held(self._around, number, load, self._chosen.held_segments)
            parts = ((foreground, own.foreground), (crowns, own.crowns), (solid, own.solid))
            for kept, points in parts:
                kept.append(points[np.linalg.norm(points[:, :2] - eye[:2], axis=1) < reach])
            backdrops += own.backdrops
        joined = [np.concatenate(one) for one in (foreground, crowns, solid)]
        return Around(joined[0], joined[1], tuple(backdrops), joined[2])


def _held(held: OrderedDict[int, T], key: int, made: Callable[[], T], most: int) -> T:
    """What is kept under a key, made where it is not there; the longest unused goes first."""
    if key not in held:
        held[key] = made()
    held.move_to_end(key)
    while len(held) > most:
        held.popitem(last=False)
    return held[key]
