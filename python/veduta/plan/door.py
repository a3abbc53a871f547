"""`veduta.read_plan`: from the drawings of a house to a place, for programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from veduta.place.place import Place
from veduta.plan.options import PlanOptions
from veduta.plan.pipeline import run_plan
from veduta.run.errors import NotFoundError
from veduta.run.flat import options_of
from veduta.run.progress import Progress
from veduta.run.scratch import goes_with, scratch_folder


def read_plan(
    drawings: str | Path | Sequence[str | Path],
    out: str | Path | None = None,
    *,
    force: bool = False,
    **options: Any,
) -> Place:
    """The house that floor plans show, furnished and with its tour.

    drawings: of the storeys from the lowest up (pictures, DXF, or a PDF), or a `plan.json` that was
    edited. out: a folder for all that `veduta plan -o OUT` writes, among it `house.ifc` and
    `plan.dxf`; without it nothing stays. options: as on the command line, `no_furniture=True`.
    InputError names the file that cannot be used; NotFoundError where there is no plan in it.
    """
    given = [drawings] if isinstance(drawings, (str, Path)) else list(drawings)
    chosen = options_of(PlanOptions, options)
    folder, scratch = (Path(out), None) if out is not None else scratch_folder()
    done = run_plan([Path(one) for one in given], folder, chosen, Progress(quiet=True), force=force)
    if done.failure is not None:
        raise NotFoundError("a plan", done.failure.reason, "Try another drawing.")
    place = Place.load(folder)
    if scratch is not None:
        goes_with(place, scratch)
    return place
