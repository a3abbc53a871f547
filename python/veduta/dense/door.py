"""`veduta.measure_photos`: the verb `veduta dense` for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from veduta.dense.command import run_dense
from veduta.dense.options import DenseOptions
from veduta.place.door import path_or_none, place_of_run
from veduta.place.place import Place
from veduta.run.flat import options_of
from veduta.run.progress import Progress


def measure_photos(
    cameras: str | Path,
    out: str | Path | None = None,
    *,
    images: str | Path | None = None,
    force: bool = False,
    **options: Any,
) -> Place:
    """The surface that calibrated photos show: a cloud and a mesh.

    cameras: a set of cameras beside its photos, such as what `locate_photos` leaves. images:
    the folder of the photos, where they do not lie beside the cameras.
    out: a folder for all that `veduta dense -o OUT` writes; without it nothing stays. options: as
    on the command line. InputError names what cannot be used; NotFoundError says what is not in it.
    """
    chosen = options_of(DenseOptions, options)
    return place_of_run(
        out,
        lambda folder: run_dense(
            Path(cameras),
            folder,
            chosen,
            Progress(quiet=True),
            images=path_or_none(images),
            force=force,
        ),
        "a surface",
        "Give more photos that overlap.",
    )
