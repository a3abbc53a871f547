"""`veduta.read_animal`: the verb `veduta fauna` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.fauna.command import run_fauna
from veduta.fauna.options import FaunaOptions
from veduta.fauna.recipe import Record
from veduta.place.door import path_or_none, place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress


def read_animal(
    footage: str | Path,
    out: str | Path | None = None,
    *,
    masks: str | Path | None = None,
    background: str | Path | None = None,
    place: str | Path | None = None,
    path: str | Path | None = None,
    plan: str | Path | None = None,
    joints: str | Path | None = None,
    markers: str | Path | None = None,
    gaits: str | Path | None = None,
    second_view: str | Path | None = None,
    force: bool = False,
    **options: Any,
) -> Place:
    """The animal that footage shows, with its skeleton and its motion.

    footage: a film, a folder of frames, a CSV of midlines, or an `animal.json` that was edited.
    masks: a folder of silhouettes, one for each frame. background: a picture without the animal.
    place: the folder of a place that the animal is put into. path: GeoJSON of its way there.
    plan: a TOML with a body plan of your own.
    joints: a CSV of them as DeepLabCut writes it. markers: a TOML with the colours of painted ones.
    gaits: the `animal.json` of another animal, whose gaits it takes on.
    second_view: the animal from the other side: a silhouette, a folder of some, or footage.
    out: a folder for all that `veduta fauna -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen = options_of(FaunaOptions, options)
    paths = (masks, background, place, path, plan, joints, markers, gaits, second_view)
    given = [path_or_none(one) for one in paths]
    record = Record(Path(footage), *given)
    return place_of_run(
        out,
        lambda folder: run_fauna(record, folder, chosen, Progress(quiet=True), force=force),
        "an animal",
        "Give footage in which it is seen whole.",
    )
