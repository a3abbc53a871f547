"""The analysis of rectified photos, in a few processes: what it found, in arrays."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from facade_truth import Boxes, Labels

from veduta.facade.analyse import analyse
from veduta.facade.document import CLASSES, FacadeClass, FacadeDocument, Source
from veduta.facade.options import EyesOptions, FacadeOptions, RectifyOptions
from veduta.facade.outputs import rasterise
from veduta.facade.rectify import rectify
from veduta.imaging.read import read_image
from veduta.run.errors import InputError, NotFoundError
from veduta.run.pool import Task, run_tasks

OPTIONS = FacadeOptions(rectify=RectifyOptions(rectified=True))
PLAIN = OPTIONS.model_copy(update={"eyes": EyesOptions(eyes="plain")})
STREET = OPTIONS.model_copy(update={"rectify": RectifyOptions()})
PLAIN_STREET = PLAIN.model_copy(update={"rectify": RectifyOptions()})
_MEMORY = 200 * 1024**2


@dataclass(frozen=True)
class Reading:
    """What was found in one photo; `document` is None and `reason` says why where nothing was."""

    document: FacadeDocument | None
    labels: Labels
    windows: Boxes
    seconds: float
    reason: str = ""


def read_facade(path: Path, options: FacadeOptions = OPTIONS) -> Reading:
    """Analyse one photo; by default one that is rectified."""
    started = time.perf_counter()
    photo = read_image(path)
    height, width = photo.pixels.shape[:2]
    source = Source(image=path.name, sha256=photo.sha256, width_px=width, height_px=height)
    try:
        document, _ = analyse(rectify(photo, options.rectify), source, options)
    except (NotFoundError, InputError) as error:
        nothing = np.full((height, width), CLASSES.index("other"), np.uint8)
        seconds = time.perf_counter() - started
        return Reading(None, nothing, np.zeros((0, 4)), seconds, str(error))
    seconds = time.perf_counter() - started
    return Reading(document, rasterise(document), boxes_of(document, "window"), seconds)


def _read(argument: tuple[Path, FacadeOptions]) -> Reading:
    return read_facade(*argument)


def boxes_of(document: FacadeDocument, kind: FacadeClass) -> Boxes:
    """Boxes of the document's elements of one class (rectified pixels)."""
    boxes = [
        (e.x_px, e.y_px, e.x_px + e.width_px, e.y_px + e.height_px)
        for e in document.elements
        if e.class_ == kind
    ]
    return np.array(boxes, np.float64).reshape(-1, 4)


def read_facades(
    paths: Sequence[Path], jobs: int = 2, options: FacadeOptions = OPTIONS
) -> list[Reading]:
    """Analyse photos in `jobs` spawned processes; the readings in the order of the paths."""
    tasks = [Task(str(path), (path, options), _MEMORY) for path in paths]
    done: dict[str, Reading] = {}
    for outcome in run_tasks(_read, tasks, jobs=jobs):
        if outcome.value is None:
            raise RuntimeError(outcome.crash or outcome.traceback or str(outcome.error))
        done[outcome.task.name] = outcome.value
    return [done[task.name] for task in tasks]
