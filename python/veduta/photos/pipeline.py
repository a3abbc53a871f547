"""`veduta photos`: find cameras and points, lay them into the world, write."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import JsonValue

from veduta.photos.finding import find_components
from veduta.photos.idle_options import require_effect
from veduta.photos.intake.call import Call, plan_call
from veduta.photos.intake.frames import publish_frames, with_frames
from veduta.photos.intake.given import NOTHING_ELSE, Given
from veduta.photos.intake.panoramas import with_panoramas
from veduta.photos.intake.read import sizes_of
from veduta.photos.laying import lay_components, on_the_ground
from veduta.photos.options import PhotosOptions
from veduta.photos.report import Told
from veduta.photos.stages import COMMAND, VERSION, Stages
from veduta.photos.world.control_adjust import adjust_components
from veduta.photos.world.control_axes import settled_axes
from veduta.photos.world.control_marks import marks_within, unknown_marks
from veduta.photos.world.control_panoramas import marks_in_views
from veduta.photos.world.georeferencing import digests_of, read_references, require_walls
from veduta.photos.writing import write_failure, write_results
from veduta.run.digests import result_key
from veduta.run.errors import NotFoundError
from veduta.run.names import given_name, real_path
from veduta.run.outputs import OutFolder, Standing, open_out
from veduta.run.pool import Task
from veduta.run.progress import Progress, StepProgress
from veduta.run.record import CALL
from veduta.run.report import Failure, StepRecord, timed_step


@dataclass
class PhotosResult:
    """What the call came to; `measures` is of its report."""

    out: Path
    up_to_date: bool = False
    measures: dict[str, Any] = field(default_factory=dict)
    failure: Failure | None = None
    left: list[tuple[str, str]] = field(default_factory=list)
    """Files that no camera was found for, as (name, reason)."""
    edited: list[str] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)

    @property
    def exit_code(self) -> int:
        """0 done, 3 no photos could be placed."""
        return 3 if self.failure else 0


def run_photos(
    folder: Path | None,
    out: Path,
    options: PhotosOptions,
    progress: Progress,
    *,
    given: Given = NOTHING_ELSE,
    force: bool = False,
    jobs: int | None = None,
) -> PhotosResult:
    """Make cameras and points of the photos of a folder in OUT, by the rules of `run.outputs`.

    folder: None where the photos are the frames of a film alone.
    """
    require_effect(options, given)
    require_walls(options)
    call = plan_call(folder, given, rig=options.camera.rig)
    inputs: list[JsonValue] = [call.inputs(), *digests_of(options.world)]
    key = result_key(COMMAND, VERSION, options, inputs)
    with open_out(out, COMMAND, key, force=force) as opened:
        result = PhotosResult(out, up_to_date=opened.standing is Standing.UP_TO_DATE)
        if not result.up_to_date:
            task = Task(real_path(call.folder).name, None)
            with progress.over(1):
                progress.started(task)
                _make(call, options, opened, key, progress.step, jobs)
                progress.finished(task.name, opened.record.items[CALL].failure)
        item = opened.record.items[CALL]
        result.failure = item.failure
        result.measures = dict(item.summary)
        result.left = [(name, reason) for name, reason in result.measures.pop("left")]
        result.edited = opened.edited()
        result.foreign = sorted(set(opened.kept) - set(opened.record.files))
    return result


def _make(
    call: Call,
    options: PhotosOptions,
    opened: OutFolder,
    key: str,
    progress: StepProgress,
    jobs: int | None,
) -> None:
    """All steps; what cannot be found ends in a report that says why."""
    references = read_references(options.world)
    steps: list[StepRecord] = []
    stages = Stages(opened.path, call, options)
    stages.open()
    told = Told(given_name(call.folder), options, steps)
    with timed_step(steps, "video") if call.video else nullcontext():
        call = with_frames(call, stages, progress)
    call = with_panoramas(call, stages, progress)
    stages = Stages(opened.path, call, options)
    told.notes += call.notes
    told.left += [(name, f"has the content of {first}") for name, first in call.copies]
    told.left += [*call.unreadable, *call.unread]
    told.notes += references.notes
    told.positions = references.positions
    if references.control is not None:
        names = [source.name for source in call.sources] + [name for name, _ in call.copies]
        control, above = marks_in_views(references.control, call.sources)
        references = replace(references, control=control)
        told.marks = unknown_marks(control, names) + above
        control, outside = marks_within(control, sizes_of(call.sources))
        references = replace(references, control=control)
        told.marks += outside
    try:
        components = find_components(call, options, stages, told, progress, jobs)
    except NotFoundError as error:
        publish_frames(call, opened, key)
        write_failure(opened, key, told, error)
    else:
        if references.control is not None:
            control, exchanged = settled_axes(components[0].structure, references.control)
            references = replace(references, control=control)
            told.alarms += [exchanged] if exchanged else []
        if references.control is not None and not told.is_given:
            with timed_step(steps, "control points") as step:
                components, notes = adjust_components(components, references.control, step)
                told.notes += notes
        laid = lay_components(components, references, told.photos, options, steps, progress)
        references, note = on_the_ground(laid, references)
        told.alarms += [note] if note else []
        publish_frames(call, opened, key)
        write_results(laid, references, told, opened, key, progress)
    opened.finish()
    stages.drop()
