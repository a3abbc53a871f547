"""`veduta.read_drive`: the verb `veduta drive` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.drive.command import run_drive
from veduta.drive.options import DriveOptions
from veduta.place.door import place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress


def read_drive(
    log: str | Path, out: str | Path | None = None, *, force: bool = False, **options: Any
) -> Place:
    """The facades along a drive with laser scans and images, without what stood before them.

    log: the folder of the drive.
    out: a folder for all that `veduta drive -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen = options_of(DriveOptions, options)
    return place_of_run(
        out,
        lambda folder: run_drive(Path(log), folder, chosen, Progress(quiet=True), force=force),
        "facades",
        "Choose a stretch with facades.",
    )
