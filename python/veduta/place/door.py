"""What the functions of the library share: a verb is run, and its place is handed over."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from veduta.place.place import Place
from veduta.run.errors import NotFoundError
from veduta.run.scratch import goes_with, scratch_folder
from veduta.run.verb import VerbResult


def path_or_none(given: str | Path | None) -> Path | None:
    """What a caller may leave out, as a path."""
    return None if given is None else Path(given)


def place_of_run(
    out: str | Path | None, run: Callable[[Path], VerbResult], wanted: str, remedy: str
) -> Place:
    """The place that a run leaves in OUT, or in a folder that goes with it where OUT is None.

    NotFoundError where what was wanted is not in the record; other errors of the run pass through.
    """
    folder, scratch = (Path(out), None) if out is not None else scratch_folder()
    done = run(folder)
    if done.failure is not None:
        raise NotFoundError(wanted, done.failure.reason, remedy)
    place = Place.load(folder)
    if scratch is not None:
        goes_with(place, scratch)
    return place
