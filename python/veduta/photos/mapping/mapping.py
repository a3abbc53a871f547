"""Mapping: poses of the photos and points, grown photo by photo from one pair.

Incremental structure from motion of the engine (Schoenberger and Frahm, CVPR 2016). Photos that
hang together only among themselves become a model of their own, a component.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pycolmap

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.mapping.growing import Growth, RigKind, grow
from veduta.photos.mapping.grown import Grown, read_grown, write_files, write_grown
from veduta.photos.mapping.initial_pair import Start
from veduta.photos.matching.match import PairRecord, database_name
from veduta.run.atomic import atomic_folder
from veduta.run.progress import StepProgress, no_progress

SMALLEST = 3
"""Photos of a component: two alone are not checked by any third."""
FEWEST_MATCHES = 15
"""Pairs that agree in fewer features are not mapped with (the engine's own bound)."""
_GROWING = "growing-"


@dataclass(frozen=True)
class Mapped:
    """The components, that with most photos first, and what each was begun with."""

    grown: tuple[Grown, ...]

    @property
    def models(self) -> tuple[pycolmap.Reconstruction, ...]:
        """Poses and points of each."""
        return tuple(one.model for one in self.grown)

    @property
    def starts(self) -> tuple[Start, ...]:
        """The first pair of each that was grown from one."""
        return tuple(one.start for one in self.grown if one.start is not None)


def map_photos(
    database: Path,
    work: Path,
    image_ids: Sequence[int],
    seed: int,
    progress: StepProgress = no_progress,
    rig: RigKind = "none",
    *,
    focal_held: bool = False,
) -> Mapped:
    """Poses and points of as many of the photos as hang together; none where none do.

    work: a folder for the components that are ended and the snapshots of the one in hand; where an
    earlier call was killed, it goes on from them. rig, focal_held: as in
    `Growth`. The result differs in the last digits from run to run where several threads add up, so
    it is kept: `write_models`.
    """
    quiet_engine()
    work.mkdir(exist_ok=True)
    ended = list(_read_numbered(work))

    def growth_of(waiting: tuple[int, ...], smallest: int) -> Growth:
        snapshots = work / f"{_GROWING}{len(ended)}"
        cache = _cache(database, waiting)
        return Growth(database, waiting, cache, snapshots, smallest, seed, rig, focal_held)

    while (found := _next_component(ended, image_ids, growth_of, progress)) is not None:
        write_grown(found, work / str(len(ended)))
        ended.append(found)
        for snapshots in work.glob(f"{_GROWING}*"):
            shutil.rmtree(snapshots)
    return by_size(ended)


def by_size(grown: Sequence[Grown]) -> Mapped:
    """Components in their order."""

    def place(one: Grown) -> tuple[int, int]:
        return -one.model.num_reg_images(), min(one.model.reg_image_ids())

    return Mapped(tuple(sorted(grown, key=place)))


def _next_component(
    ended: Sequence[Grown],
    image_ids: Sequence[int],
    growth_of: Callable[[tuple[int, ...], int], Growth],
    progress: StepProgress,
) -> Grown | None:
    """One more of the photos that no ended component has; None where there is none."""
    placed = {image for one in ended for image in one.model.reg_image_ids()}
    waiting = tuple(image for image in image_ids if image not in placed)

    def registered(count: int) -> None:
        progress("map", min(1.0, (len(placed) + count) / len(image_ids)))

    smallest = min(SMALLEST, len(image_ids))
    if len(waiting) < smallest:
        return None
    return grow(growth_of(waiting, smallest), registered)


def _cache(database: Path, image_ids: Sequence[int]) -> pycolmap.DatabaseCache:
    """What the engine maps: some of the photos, and their verified pairs."""
    options = pycolmap.DatabaseCacheOptions()
    options.min_num_matches = FEWEST_MATCHES
    options.image_names = {database_name(image) for image in image_ids}
    with pycolmap.Database.open(database) as opened:
        return pycolmap.DatabaseCache.create(opened, options)


def write_models(mapped: Mapped, folder: Path) -> None:
    """Keep the components; the folder appears whole."""
    with atomic_folder(folder) as temporary:
        for number, one in enumerate(mapped.grown):
            (temporary / str(number)).mkdir()
            write_files(one, temporary / str(number))


def read_models(folder: Path) -> Mapped:
    """What `write_models` kept."""
    return Mapped(_read_numbered(folder))


def _read_numbered(folder: Path) -> tuple[Grown, ...]:
    """The models of the folders with numbers for names; others are not whole, or snapshots."""
    numbers = sorted(int(path.name) for path in folder.iterdir() if path.name.isdigit())
    return tuple(read_grown(folder / str(number)) for number in numbers)


def left_out(
    photos: Sequence[PhotoRecord], placed: set[int], pairs: Sequence[PairRecord]
) -> list[tuple[str, str]]:
    """The photos without a pose, as (name, reason)."""
    verified: dict[int, list[int]] = {photo.image_id: [] for photo in photos}
    for pair in pairs:
        for image in (pair.first, pair.second):
            if pair.verified:
                verified[image].append(pair.verified)
    return [
        (photo.name, _reason(verified[photo.image_id]))
        for photo in photos
        if photo.image_id not in placed
    ]


def _reason(verified: Sequence[int]) -> str:
    if not verified:
        return "shares no view with another photo: no pair with it could be verified"
    others = f"{len(verified)} other photo{'s' if len(verified) > 1 else ''}"
    return f"agrees with {others} in at most {max(verified)} features: not enough to place it"
