"""The frames of a film beside the photos: taken once, kept in OUT, and read as photos are."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from veduta.photos.intake.call import Call
from veduta.photos.intake.masks import with_masks
from veduta.photos.intake.source import Source
from veduta.photos.intake.video import Video, write_frames
from veduta.photos.stages import Stages
from veduta.run.atomic import atomic_folder, same_file
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.outputs import OutFolder, writing_to
from veduta.run.progress import StepProgress, no_progress

FRAMES = "frames"
"""The folder in OUT that has them, too."""
_TOLD = "told.json"


def with_frames(call: Call, stages: Stages, progress: StepProgress = no_progress) -> Call:
    """The call with the frames of its film among the photos; as it is where it has none.

    A killed run's frames are taken over.
    """
    if call.video is None:
        return call
    folder = stages.frames(call.video)
    if not folder.exists():
        with writing_to(stages.out), atomic_folder(folder) as temporary:
            taken = write_frames(call.video, stages.options.video, temporary, progress)
            (temporary / _TOLD).write_text(json.dumps(taken.notes), encoding="utf-8")
    paths = sorted(folder.glob("*.jpg"))
    notes = json.loads((folder / _TOLD).read_text(encoding="utf-8"))
    sources = (*call.sources, *_sources(call, call.video, paths))
    masked, told = with_masks(sources, call.masks)
    return replace(call, sources=masked, notes=(*call.notes, *notes, *told))


def publish_frames(call: Call, opened: OutFolder, key: str) -> None:
    """Give the user the frames in OUT/frames; nothing reads those, for they may be changed.

    They come with the results: a call that is refused for its photos or masks leaves none.
    """
    if call.video is None and not opened.record.files_of(FRAMES):  # nor of a former call
        return
    if opened.is_current(FRAMES, key):
        return
    work = opened.work_folder(FRAMES)
    with writing_to(opened.path):
        for source in call.sources:
            if source.video is not None:
                same_file(source.path, work / source.name)
    opened.publish(FRAMES, key, work)


def _sources(call: Call, video: Video, paths: list[Path]) -> list[Source]:
    taken = {source.name for source in call.sources}
    for path in paths:
        if path.name in taken:
            fault = f"has a photo of the name of a frame of {video.name} ({path.name})"
            raise InputError(call.folder, fault, "Give the photo another name.")
    return [Source(path.name, path, file_digest(path), video=video.name) for path in paths]
