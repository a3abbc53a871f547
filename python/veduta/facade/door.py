"""`veduta.read_facade`: from a photo of a facade to a place, for programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from veduta.facade.batch import run_call
from veduta.facade.options import FacadeOptions
from veduta.place.place import Place
from veduta.run.errors import InputError, NotFoundError, VedutaError
from veduta.run.flat import options_of
from veduta.run.progress import Progress
from veduta.run.report import Failure
from veduta.run.scratch import goes_with, scratch_folder

Paths = str | Path | Sequence[str | Path]


def read_facade(
    photos: Paths, out: str | Path | None = None, *, force: bool = False, **options: Any
) -> Place:
    """The building that a photo of a facade shows; of several, one beside the other.

    photos: pictures, or a `facade.json` that was edited. out: a folder for all that
    `veduta facade -o OUT` writes; without it nothing stays. options: as on the command line,
    `height_m=18.0`. InputError names the file that cannot be used, NotFoundError says what is not
    in it.
    """
    given = [photos] if isinstance(photos, (str, Path)) else list(photos)
    chosen = options_of(FacadeOptions, options)
    folder, scratch = (Path(out), None) if out is not None else scratch_folder()
    done = run_call([Path(one) for one in given], folder, chosen, Progress(quiet=True), force=force)
    if done.failed:
        raise _error(next(iter(done.failed.values())))
    place = Place.load(folder)
    if scratch is not None:
        goes_with(place, scratch)
    return place


def _error(failure: Failure) -> VedutaError:
    if failure.kind == "not-found":
        return NotFoundError("a facade", failure.reason, "Try another photo, or give its corners.")
    return InputError(failure.subject, failure.reason, "Mend it, or choose another.")
