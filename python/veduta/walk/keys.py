"""The key positions of a walk as local models: of one view as it is, of several as a 3D-mosaic."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.run.digests import file_digest
from veduta.run.errors import NotFoundError
from veduta.run.work import Work
from veduta.walk.build.key_file import arrays_of_mosaic, mosaic_of
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.mosaic import make_mosaic
from veduta.walk.read.check_rows import Rows, require_rows
from veduta.walk.read.pairs import Rectifier, read_stereo
from veduta.walk.rig import Image, PairFiles

_KEPT = 3
"""What is kept of a mosaic: the third way, with its front view and how far rows lie off."""

_OFF = "rows_off_px"


@dataclass(frozen=True, eq=False)
class KeyFigures:
    """Where the views of a key position are.

    turns: (n, 3, 3) model_from_view, NaN for a view that was left out; gap: share of a mosaic that
    no view shows. front: number of the view in whose frame the model is. water, grass: share of the
    picture that shows it. rows_off_px: of its worst pair, how far matches lie off their rows in the
    median; NaN where there are too few, or no pairs.
    """

    turns: NDArray[np.float64]
    front: int = 0
    gap: float = 0.0
    water: float = 0.0
    grass: float = 0.0
    rows_off_px: float = float("nan")


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
        model, off_px = _model(work, views[0], rectifier)
        return KeyModel(model, KeyFigures(np.eye(3)[None], rows_off_px=off_px))
    inputs = [file_digest(path) for one in views for path in (one.left, one.right)]
    try:
        arrays = work.kept_arrays(
            f"mosaic-{views[0].key}", [*inputs, repr(rectifier.rig), _KEPT],
            lambda: _mosaic(work, views, rectifier),
        )  # fmt: skip
    except NotFoundError as error:
        middle = len(views) // 2
        work.doubt(f"{views[0].key}: {error.evidence}: view {views[middle].view} stands alone")
        turns = np.full((len(views), 3, 3), np.nan)
        turns[middle] = np.eye(3)
        model, off_px = _model(work, views[middle], rectifier)
        return KeyModel(model, KeyFigures(turns, middle, rows_off_px=off_px))
    key = views[0].key
    mosaic = mosaic_of(key, arrays)
    for view, found in zip(views, mosaic.turns.found, strict=True):
        if not found:
            work.doubt(f"{key}: view {view.view} has nothing in common with the others: left out")
    turns_found = mosaic.turns
    off_px = float(arrays[_OFF][0])
    figures = KeyFigures(
        turns_found.front_from_view, turns_found.front, mosaic.gap, rows_off_px=off_px
    )
    return KeyModel(mosaic.model, figures)


def _mosaic(
    work: Work, views: tuple[PairFiles, ...], rectifier: Rectifier
) -> dict[str, NDArray[Any]]:
    made = [_model(work, view, rectifier) for view in views]
    kept = arrays_of_mosaic(make_mosaic([model for model, _ in made]))
    return {**kept, _OFF: np.fmax.reduce([[off_px] for _, off_px in made])}


def picture_of(work: Work, views: tuple[PairFiles, ...], rectifier: Rectifier) -> Image:
    """What a key position shows, before colours are levelled along the walk."""
    if len(views) == 1:
        return read_stereo(views[0], rectifier).left
    return read_key(work, views, rectifier).model.image


def _model(work: Work, files: PairFiles, rectifier: Rectifier) -> tuple[LocalModel, float]:
    """The model of a view, and how far matches of its pair lie off their rows (px)."""
    pair = read_stereo(files, rectifier)
    rows: Rows = require_rows(pair, rectifier.rig, files)
    untextured = "the pictures have too little texture to check the calibration by them"
    if rows.matches == 0 and untextured not in work.doubts:
        work.doubt(untextured)
    return build_local_model(pair, rectifier.rig), rows.off_px
