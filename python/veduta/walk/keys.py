"""The key positions of a walk as local models: of one view as it is, of several as a 3D-mosaic."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from veduta.run.digests import file_digest
from veduta.run.errors import NotFoundError
from veduta.run.work import Work
from veduta.walk.build.key_file import arrays_of_mosaic, mosaic_of
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.mosaic import Mosaic, make_mosaic
from veduta.walk.read.check_rows import Rows, require_rows
from veduta.walk.read.pairs import Rectifier, read_stereo
from veduta.walk.rig import Image, PairFiles

_KEPT = 2
"""What is kept of a mosaic: the second way, with its front view."""


@dataclass(frozen=True, eq=False)
class KeyFigures:
    """Where the views of a key position are.

    turns: (n, 3, 3) model_from_view, NaN for a view that was left out; gap: share of a mosaic that
    no view shows. front: number of the view in whose frame the model is. water, grass: share of the
    picture that shows it.
    """

    turns: NDArray[np.float64]
    front: int = 0
    gap: float = 0.0
    water: float = 0.0
    grass: float = 0.0


@dataclass(frozen=True, eq=False)
class KeyModel:
    """A key position."""

    model: LocalModel
    figures: KeyFigures


def views_by_key(pairs: list[PairFiles]) -> list[tuple[PairFiles, ...]]:
    """The views of each key position, in the order of the pairs."""
    return [tuple(views) for _, views in groupby(pairs, key=lambda pair: pair.key)]


def read_key(work: Work, views: tuple[PairFiles, ...], rectifier: Rectifier) -> KeyModel:
    """Section 3.2, and 3.6 where there are several views; said where some were left out."""
    if len(views) == 1:
        return KeyModel(_model(work, views[0], rectifier), KeyFigures(np.eye(3)[None]))
    inputs = [file_digest(path) for one in views for path in (one.left, one.right)]
    try:
        arrays = work.kept_arrays(
            f"mosaic-{views[0].key}", [*inputs, repr(rectifier.rig), _KEPT],
            lambda: arrays_of_mosaic(_mosaic(work, views, rectifier)),
        )  # fmt: skip
    except NotFoundError as error:
        middle = len(views) // 2
        work.doubt(f"{views[0].key}: {error.evidence}: view {views[middle].view} stands alone")
        turns = np.full((len(views), 3, 3), np.nan)
        turns[middle] = np.eye(3)
        return KeyModel(_model(work, views[middle], rectifier), KeyFigures(turns, middle))
    key = views[0].key
    mosaic = mosaic_of(key, arrays)
    for view, found in zip(views, mosaic.turns.found, strict=True):
        if not found:
            work.doubt(f"{key}: view {view.view} has nothing in common with the others: left out")
    turns_found = mosaic.turns
    figures = KeyFigures(turns_found.front_from_view, turns_found.front, mosaic.gap)
    return KeyModel(mosaic.model, figures)


def _mosaic(work: Work, views: tuple[PairFiles, ...], rectifier: Rectifier) -> Mosaic:
    return make_mosaic([_model(work, view, rectifier) for view in views])


def picture_of(work: Work, views: tuple[PairFiles, ...], rectifier: Rectifier) -> Image:
    """What a key position shows, before colours are levelled along the walk."""
    if len(views) == 1:
        return read_stereo(views[0], rectifier).left
    return read_key(work, views, rectifier).model.image


def _model(work: Work, files: PairFiles, rectifier: Rectifier) -> LocalModel:
    pair = read_stereo(files, rectifier)
    rows: Rows = require_rows(pair, rectifier.rig, files)
    untextured = "the pictures have too little texture to check the calibration by them"
    if rows.matches == 0 and untextured not in work.doubts:
        work.doubt(untextured)
    return build_local_model(pair, rectifier.rig)
