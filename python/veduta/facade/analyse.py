"""From the rectified photo to the facade document: by the eyes that are asked for."""

from __future__ import annotations

from veduta.facade.analyse_seen import analyse_houses, analyse_seen
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.eyes import Seen
from veduta.facade.house_folders import with_numbers
from veduta.facade.options import FacadeOptions
from veduta.facade.rectify import Rectified
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import StepRecord


def analyse(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    progress: StepProgress = no_progress,
    seen: Seen | None = None,
) -> tuple[FacadeDocument, list[StepRecord]]:
    """Read a rectified facade; NotFoundError where the image shows none.

    seen: what the learned eyes see in it, of a caller that has looked already.
    """
    if options.eyes.eyes == "learned":
        return analyse_seen(rectified, source, options, progress, seen)
    # Loaded where it is used: few calls ask for it, and it is a fifth of the package.
    from veduta.facade.analyse_plain import analyse_plain

    return analyse_plain(rectified, source, options, progress)


def read_houses(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    progress: StepProgress = no_progress,
    seen: Seen | None = None,
) -> tuple[list[FacadeDocument], list[StepRecord], list[list[StepRecord]]]:
    """The documents of all houses of a picture, from left to right.

    With the steps of the picture and its main house, and those of each other one by itself.
    One where only one is asked for, where the front is named (by corners, by a width, by the wall
    or the depths that it gets, by a style), or nothing is learned.
    """
    named = (
        options.houses.houses == "one"
        or options.eyes.eyes != "learned"
        or rectified.record.method == "corners"
        or options.wall is not None
        or options.elevation is not None
        or options.style.style is not None
        or options.scale.width_m is not None
    )
    if named:
        document, steps = analyse(rectified, source, options, progress, seen)
        return [document], steps, [[]]
    documents, steps, own = analyse_houses(rectified, source, options, progress, seen)
    return with_numbers(documents), steps, own
