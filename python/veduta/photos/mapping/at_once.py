"""Mapping all photos at once: the rotations of all, then all places and points, then an adjustment.

The engine's global structure from motion (Pan, Barath, Pollefeys and Schoenberger, Global
structure-from-motion revisited, ECCV 2024). It takes the pose of each pair from focal lengths that
must be known: `require_focal_lengths`. It is one step: a run that is killed in it begins it again.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

import pycolmap

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.mapping.grown import Grown
from veduta.photos.mapping.mapping import FEWEST_MATCHES, SMALLEST, Mapped, by_size
from veduta.run.errors import InputError
from veduta.run.progress import StepProgress, no_progress
from veduta.run.threads import available_cores

UPDATES = 5
"""Times that the engine tells of itself: rotations, places, and rounds of adjustment."""
NAMED = 3
"""Photos without a focal length that an error names."""


def require_focal_lengths(photos: Sequence[PhotoRecord]) -> None:
    """InputError where a photo's focal length is not known.

    With an assumed one the directions between photos may be off from the start, and a small error
    in the picture does not tell a false map from a true one.
    """
    unknown = [photo.name for photo in photos if photo.focal_px is None]
    if unknown:
        names = ", ".join(unknown[:NAMED]) + (", …" if len(unknown) > NAMED else "")
        raise InputError(
            "--mapping global",
            f"the focal length of {len(unknown)} of {len(photos)} photos is not known ({names})",
            "Write it into their EXIF (FocalLengthIn35mmFilm), leave them out,"
            " or take --mapping incremental, which finds it.",
        )


def map_at_once(
    database: Path,
    work: Path,
    image_ids: Sequence[int],
    seed: int,
    progress: StepProgress = no_progress,
) -> Mapped:
    """Poses and points of as many of the photos as hang together, all placed in one go.

    work: a folder for the engine, which writes into the database that it is given.
    """
    quiet_engine()
    work.mkdir(exist_ok=True)
    own = work / "matches.db"
    shutil.copyfile(database, own)
    options = pycolmap.GlobalPipelineOptions()
    options.random_seed, options.num_threads = seed, available_cores()
    smallest = min(SMALLEST, len(image_ids))
    options.min_num_matches, options.min_model_size = FEWEST_MATCHES, smallest
    manager = pycolmap.ReconstructionManager()
    updates = 0

    def updated() -> None:
        nonlocal updates
        updates += 1
        progress("map", updates / (updates + UPDATES))

    with pycolmap.Database.open(own) as opened:
        pipeline = pycolmap.GlobalPipeline(options, opened, manager)
        pipeline.add_callback(pycolmap.GlobalPipelineCallback.MODEL_UPDATE_CALLBACK, updated)
        pipeline.run()
    models = [manager.get(number) for number in range(manager.size())]
    return by_size([Grown(model, None) for model in models if model.num_reg_images() >= smallest])
