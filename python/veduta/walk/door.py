"""`veduta.read_walk`: the verb `veduta walk` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.place.door import path_or_none, place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress
from veduta.walk.command import Sources, run_walk
from veduta.walk.options import WalkOptions


def read_walk(
    pairs: str | Path,
    out: str | Path | None = None,
    *,
    calibration: str | Path | None = None,
    calibrate: str | Path | None = None,
    cameras: str | Path | None = None,
    force: bool = False,
    **options: Any,
) -> Place:
    """A walk from stereo view to stereo view through a landscape.

    pairs: the folder of the stereo pairs, in the order of the way. calibration: of the
    two cameras, where it does not lie in that folder; calibrate: or pictures of a board. cameras:
    of the frames of a single camera (a result of `veduta photos`), which `pairs` then holds.
    out: a folder for all that `veduta walk -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen = options_of(WalkOptions, options)
    return place_of_run(
        out,
        lambda folder: run_walk(
            Path(pairs),
            folder,
            chosen,
            Progress(quiet=True),
            sources=Sources(
                path_or_none(calibration), path_or_none(calibrate), path_or_none(cameras)
            ),
            force=force,
        ),
        "a walk",
        "Take the pairs nearer to each other.",
    )
