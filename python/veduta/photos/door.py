"""`veduta.locate_photos`: where photos were taken, for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.photos.options import PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.place.place import Place
from veduta.run.errors import NotFoundError
from veduta.run.flat import options_of
from veduta.run.progress import Progress
from veduta.run.scratch import goes_with, scratch_folder


def locate_photos(
    photos: str | Path, out: str | Path | None = None, *, force: bool = False, **options: Any
) -> Place:
    """Where the photos of a folder were taken (`place.cameras`), and the points that they show.

    out: a folder for all that `veduta photos -o OUT` writes, among it COLMAP's files; a call that
    was stopped goes on there. Without it nothing stays. options: as on the command line.
    InputError names what cannot be used; NotFoundError where no photos could be placed.
    """
    chosen = options_of(PhotosOptions, options)
    folder, scratch = (Path(out), None) if out is not None else scratch_folder()
    done = run_photos(Path(photos), folder, chosen, Progress(quiet=True), force=force)
    if done.failure is not None:
        raise NotFoundError("cameras", done.failure.reason, "See the report for what was tried.")
    place = Place.load(folder)
    if scratch is not None:
        goes_with(place, scratch)
    return place
