"""`veduta.carve_photos`: the verb `veduta carve` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.carve.command import run_carve
from veduta.carve.options import CarveOptions
from veduta.place.door import place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress


def carve_photos(
    photos: str | Path, out: str | Path | None = None, *, force: bool = False, **options: Any
) -> Place:
    """The object that photos with silhouettes show, as a closed coloured mesh.

    photos: the folder of the photos and their cameras.
    out: a folder for all that `veduta carve -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen = options_of(CarveOptions, options)
    return place_of_run(
        out,
        lambda folder: run_carve(Path(photos), folder, chosen, Progress(quiet=True), force=force),
        "an object",
        "Give sharper silhouettes, or more photos.",
    )
