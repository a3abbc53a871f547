"""Mapping: poses of the photos and points, grown photo by photo from one pair.

Incremental structure from motion of the engine (Schoenberger and Frahm, CVPR 2016). Photos that
hang together only among themselves become a model of their own, a component.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pycolmap

from veduta.photos.engine import quiet_engine
from veduta.photos.match import PairRecord
from veduta.photos.read import PhotoRecord
from veduta.run.atomic import atomic_folder
from veduta.run.pool import available_cores
from veduta.run.progress import StepProgress, no_progress

SMALLEST = 3
"""Photos of a component: two alone are not checked by any third."""


@dataclass(frozen=True)
class Mapped:
    """The components, that with most photos first."""

    models: tuple[pycolmap.Reconstruction, ...]


def map_photos(
    database: Path, work: Path, count: int, seed: int, progress: StepProgress = no_progress
) -> Mapped:
    """Poses and points of as many of the photos as hang together; none where none do.

    work: an empty folder for the engine. count: of photos, for the progress. Its result differs in
    the last digits from run to run where several threads add up, so it is kept: `read_models`.
    """
    quiet_engine()
    options = pycolmap.IncrementalPipelineOptions()
    options.random_seed = seed
    options.num_threads = available_cores()
    options.min_model_size = min(SMALLEST, count)
    options.extract_colors = False
    # The engine warns of a trivial rig in each photo otherwise.
    options.ba_refine_sensor_from_rig = False
    placed = [0]

    def one_more() -> None:
        placed[0] += 1
        progress("map", min(1.0, placed[0] / count))

    models = pycolmap.incremental_mapping(
        database, work, work, options, next_image_callback=one_more
    )
    found = [model for model in models.values() if model.num_reg_images() >= 2]
    found.sort(key=lambda model: (-model.num_reg_images(), min(model.reg_image_ids())))
    return Mapped(tuple(found))


def write_models(mapped: Mapped, folder: Path) -> None:
    """Keep the components; the folder appears whole."""
    with atomic_folder(folder) as temporary:
        for number, model in enumerate(mapped.models):
            (temporary / str(number)).mkdir()
            model.write_binary(temporary / str(number))


def read_models(folder: Path) -> Mapped:
    """What `write_models` kept."""
    numbers = sorted(int(path.name) for path in folder.iterdir())
    return Mapped(tuple(pycolmap.Reconstruction(folder / str(number)) for number in numbers))


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
