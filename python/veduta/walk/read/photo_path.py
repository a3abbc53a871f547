"""A single camera's frames along a path, with cameras that `veduta photos` or others have found."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera, CameraSet, read_cameras, straight_camera, undistorted
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.run.work import Work
from veduta.walk.rig import Image, PairFiles, Rig

NEIGHBOURS = 1.0
"""A scale that nobody knows: neighbouring frames are so far apart (taken for metres)."""
UNKNOWN = (
    "the cameras' scale is not known: neighbouring frames are taken to be 1 m apart, and all"
    " lengths follow from it"
)
SIZE_SLACK = 0.02
"""By which sizes and focal lengths of frames may differ, as a share."""
STILL = 0.05
"""A share of the longest step below which cameras stand in one place: views of a panorama."""
ASIDE = 4.0
"""Nearest and farthest points of the source are believed up to this factor."""

VIEW = re.compile(r"(.+)_view(\d{1,2})(?:\.\w+)?")
"""How `veduta photos` names the views that it cuts out of a panorama."""


def views_of_panoramas(names: list[str]) -> dict[str, dict[int, int]] | None:
    """The numbers of the views of each panorama, by its name; None where a name is no view's."""
    found: dict[str, dict[int, int]] = {}
    for number, name in enumerate(names):
        said = VIEW.fullmatch(name)
        if said is None:
            return None
        found.setdefault(said[1], {})[int(said[2])] = number
    return found


@dataclass(frozen=True, eq=False)
class PhotoPath:
    """Frames in the order of their names.

    cameras: without distortion, of one size, in metres (or in steps between frames: `known`).
    """

    source: Path
    given: tuple[Camera, ...]
    cameras: list[Camera]
    visible: tuple[NDArray[np.float64], ...]
    known: bool

    @property
    def pairs(self) -> list[PairFiles]:
        """Each frame, and the next one (for the last: the one before)."""
        names = [one.picture or Path(one.name) for one in self.given]
        after = [*names[1:], names[-2]]
        return [
            PairFiles(one.stem, "0", one, other) for one, other in zip(names, after, strict=True)
        ]

    @cached_property
    def rig(self) -> Rig:
        """What stands for the two cameras: the usual step between frames is their baseline."""
        one = self.cameras[0]
        step = _step(self.cameras, self.source)
        return Rig(one.width_px, one.height_px, one.focal_px, one.centre_px, step)

    def picture(self, number: int) -> Image:
        """(h, w, 3) of a frame, without its lens, of the size of all."""
        given = self.given[number]
        path = given.picture
        if path is None:
            raise InputError(self.source, f"has no picture of {given.name}", "Name their folder.")
        pixels = read_image(path).pixels
        if pixels.shape[1::-1] != (given.width_px, given.height_px):
            raise InputError(
                path, f"is {pixels.shape[1]} x {pixels.shape[0]}, and its camera"
                f" {given.width_px} x {given.height_px}", "Give the pictures of these cameras.",
            )  # fmt: skip
        plain = undistorted(given, pixels)[1]
        size = (self.cameras[number].width_px, self.cameras[number].height_px)
        if plain.shape[1::-1] == size:
            return plain
        return np.asarray(cv2.resize(plain, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)

    def span(self, number: int) -> tuple[float, float]:
        """The depths that are looked for in a frame: those of its points, and somewhat beyond."""
        seen = self.visible[number] if self.visible else np.zeros((0, 3))
        depths = self.cameras[number].project(seen)[1]
        ahead = depths[depths > 0.0]
        step = self.rig.baseline_m
        if len(ahead) < 10:
            return 2.0 * step, 200.0 * step
        low, high = np.percentile(ahead, [1.0, 98.0])
        return float(max(low / ASIDE, 0.3 * step)), float(high * ASIDE)

    def pose(self, first: int, second: int) -> NDArray[np.float64]:
        """(3, 4) second_from_first."""
        return between(self.cameras[first], self.cameras[second])

    def tell(self, work: Work) -> None:
        """Say once that the scale is not known, where it is not."""
        if not self.known and UNKNOWN not in work.doubts:
            work.doubt(UNKNOWN)


def between(first: Camera, second: Camera) -> NDArray[np.float64]:
    """(3, 4) second_from_first."""
    turn, shift = np.split(second.cam_from_world, [3], axis=1)
    own, move = np.split(first.cam_from_world, [3], axis=1)
    turned = turn @ own.T
    return np.column_stack([turned, shift - turned @ move])


def centre_of(camera: Camera) -> NDArray[np.float64]:
    """(3,) where it stands."""
    return camera.centre()


def read_photo_path(folder: Path, cameras: Path, largest_px: int) -> PhotoPath:
    """The frames of a folder that have cameras; InputError where they make no path."""
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", "Give the folder of the frames.")
    found = read_cameras(cameras, folder)
    order = _pictured(found)
    if not order and views_of_panoramas([one.name for one in found.cameras]) is not None:
        found = read_cameras(cameras)  # views that were cut out of panoramas lie with the cameras
        order = _pictured(found)
    if len(order) < 2:
        raise InputError(
            cameras, f"has {len(order)} cameras with pictures in {folder}",
            "Run `veduta photos` over the frames first.",
        )  # fmt: skip
    given = tuple(found.cameras[n] for n in order)
    _require_alike(given, cameras)
    known = found.scale == "metres"
    step = _step(given, cameras)
    factor = 1.0 if known else NEIGHBOURS / step
    largest = max(given[0].width_px, given[0].height_px)
    share = min(1.0, largest_px / largest)
    prepared = [_scaled(straight_camera(one), given[0], share, factor) for one in given]
    visible = _visible(found, order, factor)
    return PhotoPath(cameras, given, prepared, visible, known)


def _pictured(found: CameraSet) -> list[int]:
    """The cameras that have pictures, in the order of their names."""
    numbers = [n for n, one in enumerate(found.cameras) if one.picture is not None]
    return sorted(numbers, key=lambda n: _natural(found.cameras[n].name))


def _step(given: Sequence[Camera], source: Path) -> float:
    """The usual distance of neighbours that do not stand in one place."""
    steps = np.linalg.norm(np.diff([one.centre() for one in given], axis=0), axis=1)
    moved = steps[steps > STILL * steps.max(initial=0.0)]
    middle = float(np.median(moved)) if len(moved) else 0.0
    if not middle > 0.0:
        raise InputError(
            source, "has all cameras in one place", "A walk needs frames along a path."
        )
    return middle


def _require_alike(given: tuple[Camera, ...], source: Path) -> None:
    first = given[0]
    for one in given[1:]:
        sizes = [
            (float(one.width_px), float(first.width_px)),
            (float(one.height_px), float(first.height_px)),
            (one.focal_px[0], first.focal_px[0]),
        ]
        if any(abs(a - b) > SIZE_SLACK * b for a, b in sizes):
            raise InputError(
                source, f"{one.name} has another size or lens than {first.name}",
                "All frames of a walk must be of one camera.",
            )  # fmt: skip


def _scaled(camera: Camera, like: Camera, share: float, factor: float) -> Camera:
    """At a share of the size, its place times a factor."""
    width, height = round(like.width_px * share), round(like.height_px * share)
    across, down = width / camera.width_px, height / camera.height_px
    pose = camera.cam_from_world.copy()
    pose[:, 3] *= factor
    return replace(
        camera, width_px=width, height_px=height,
        focal_px=(camera.focal_px[0] * across, camera.focal_px[1] * down),
        centre_px=(camera.centre_px[0] * across, camera.centre_px[1] * down), cam_from_world=pose,
    )  # fmt: skip


def _visible(found: CameraSet, order: list[int], factor: float) -> tuple[NDArray[np.float64], ...]:
    """(n, 3) the points that each frame sees."""
    if found.points is None or found.visible is None:
        return ()
    return tuple(found.points[found.visible[n]] * factor for n in order)


def _natural(name: str) -> list[tuple[int, int, str]]:
    parts = re.findall(r"\d+|\D+", name)
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in parts]
