"""`veduta.read_animal`: the verb `veduta fauna` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.fauna.command import run_fauna
from veduta.fauna.options import FaunaOptions
from veduta.fauna.recipe import Record
from veduta.place.door import place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress


def read_animal(
    footage: str | Path, out: str | Path | None = None, *, force: bool = False, **options: Any
) -> Place:
    """The animal that footage shows, with its skeleton and its motion.

    footage: a film, or a folder of frames.
    out: a folder for all that `veduta fauna -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen, record = options_of(FaunaOptions, options), Record(Path(footage))
    return place_of_run(
        out,
        lambda folder: run_fauna(record, folder, chosen, Progress(quiet=True), force=force),
        "an animal",
        "Give footage in which it is seen whole.",
    )
