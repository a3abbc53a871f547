"""`veduta photos`: read, features, match, map, cameras, write."""

from __future__ import annotations

import shutil
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import JsonValue

from veduta.formats.place_json import write_place
from veduta.formats.ply import write_points
from veduta.photos.call import Call, plan_call
from veduta.photos.component import Component, finish_component
from veduta.photos.features import FeaturesJob, memory_of, run_features
from veduta.photos.mapping import Mapped, left_out, map_photos, read_models, write_models
from veduta.photos.match import (
    PairRecord,
    count_keypoints,
    match_pairs,
    read_pairs,
    write_database,
)
from veduta.photos.options import PhotosOptions
from veduta.photos.pairs import Pairs, choose_pairs
from veduta.photos.pictures import write_pictures
from veduta.photos.placing import PICTURES, POINTS, place_of
from veduta.photos.read import ReadPhotos, read_photos
from veduta.photos.report import Told, failure_report, measures_of, photos_report
from veduta.photos.stages import COMMAND, VERSION, Stages
from veduta.photos.structure import model_of, structure_of
from veduta.run.digests import result_key
from veduta.run.errors import InputError, NotFoundError
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.pool import Task, run_tasks
from veduta.run.progress import Progress, StepProgress
from veduta.run.record import CALL
from veduta.run.report import Failure, StepRecord, timed_step

SPARSE = "sparse"
FEATURES_MEMORY = 6 * 1024**3
"""Bytes that all processes together may use while they look for features."""
_NOTHING_HANGS = (
    "Take photos that overlap by more than half with their neighbours, from places that differ:"
    " turning on the spot shows no depth."
)


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
    folder: Path,
    out: Path,
    options: PhotosOptions,
    progress: Progress,
    *,
    force: bool = False,
    jobs: int | None = None,
) -> PhotosResult:
    """Make cameras and points of the photos of a folder in OUT, by the rules of `run.outputs`."""
    call = plan_call(folder)
    key = _key(call, options)
    with open_out(out, COMMAND, key, force=force) as opened:
        result = PhotosResult(out, up_to_date=opened.standing is Standing.UP_TO_DATE)
        if not result.up_to_date:
            task = Task(folder.resolve().name, None)
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


def _key(call: Call, options: PhotosOptions) -> str:
    photos: list[JsonValue] = [[source.name, source.sha256] for source in call.sources]
    aside: list[JsonValue] = [list(pair) for pair in (*call.copies, *call.unreadable)]
    return result_key(COMMAND, VERSION, options, [photos, aside])


def _make(
    call: Call,
    options: PhotosOptions,
    opened: OutFolder,
    key: str,
    progress: StepProgress,
    jobs: int | None,
) -> None:
    """All steps; what cannot be found ends in a report that says why."""
    steps: list[StepRecord] = []
    stages = Stages(opened.path, call, options)
    stages.open()
    told = Told(str(call.folder), options, steps)
    told.left += [(name, f"has the content of {first}") for name, first in call.copies]
    told.left += call.unreadable
    try:
        components = _components(call, options, stages, told, progress, jobs)
    except NotFoundError as error:
        _fail(opened, key, told, error)
    else:
        _write(components, told, opened, key, progress)
    opened.finish()
    stages.drop()


def _components(
    call: Call,
    options: PhotosOptions,
    stages: Stages,
    told: Told,
    progress: StepProgress,
    jobs: int | None,
) -> list[Component]:
    """From the files to the components, that with most photos first."""
    with timed_step(told.steps, "read") as step:
        read = read_photos(call.sources, progress)
        told.photos = read.photos
        told.left += read.set_aside
        step.counts |= {"photos": len(read.photos), "set aside": len(told.left)}
        step.rejected.extend(f"{name}: {reason}" for name, reason in told.left)
        _require_two(call, read)
        pairs = choose_pairs(read.photos, options.match)
    with timed_step(told.steps, "features") as step:
        _features(read, options, stages, progress, jobs)
    with timed_step(told.steps, "match") as step:
        told.how = pairs.how
        told.pairs, told.keypoints = _match(read, pairs, options, stages, progress)
        told.steps[-2].counts["keypoints"] = sum(told.keypoints)
        verified = sum(pair.verified > 0 for pair in told.pairs)
        step.counts |= {"pairs": len(told.pairs), "verified": verified}
    with timed_step(told.steps, "map") as step:
        mapped = _map(read, options, stages, progress)
        step.counts["components"] = len(mapped.models)
        placed = {image for model in mapped.models for image in model.reg_image_ids()}
        unplaced = left_out(read.photos, placed, told.pairs)
        told.left += unplaced
        step.rejected.extend(f"{name}: {reason}" for name, reason in unplaced)
        if not mapped.models:
            raise NotFoundError("cameras", "no photos hang together", _NOTHING_HANGS)
    with timed_step(told.steps, "cameras") as step:
        groups = {photo.image_id: photo.group for photo in read.photos}
        names = {photo.image_id: photo.name for photo in read.photos}
        components = []
        for number, model in enumerate(mapped.models):
            progress("cameras", number / len(mapped.models))
            structure = structure_of(model, names)
            components.append(
                finish_component(structure, options.camera, groups, options.random.seed)
            )
        step.counts["kinds tried"] = sum(len(component.lens.tried) for component in components)
    return components


def _require_two(call: Call, read: ReadPhotos) -> None:
    if len(read.photos) < 2:
        raise InputError(
            call.folder,
            f"holds {len(read.photos)} photos that can be used, of {len(call.sources)}"
            + "".join(f"; {name} {reason}" for name, reason in read.set_aside[:3]),
            "Put at least two photos of the same place into it.",
        )


def _features(
    read: ReadPhotos,
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
    jobs: int | None,
) -> None:
    """Look for the features of the photos that have none yet, on all cores."""
    waiting = [photo for photo in read.photos if not stages.features(photo).exists()]
    if stages.database().exists():
        return
    tasks = [
        Task(
            photo.name,
            FeaturesJob(photo.path, options.match, stages.features(photo)),
            memory_of(photo.width_px, photo.height_px, options.match),
        )
        for photo in waiting
    ]
    done = len(read.photos) - len(tasks)
    outcomes = run_tasks(
        run_features, tasks, jobs=jobs, started=lambda task: None, memory_budget=FEATURES_MEMORY
    )
    with closing(outcomes):
        for outcome in outcomes:
            if outcome.error is not None:
                raise outcome.error
            if outcome.value is None:
                raise RuntimeError(outcome.traceback or outcome.crash)
            done += 1
            progress("features", done / len(read.photos))


def _match(
    read: ReadPhotos,
    pairs: Pairs,
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
) -> tuple[list[PairRecord], list[int]]:
    """The verified pairs, and how many keypoints each photo has."""
    database = stages.database()
    with writing_to(stages.out):
        if not database.exists():
            files = [stages.features(photo) for photo in read.photos]
            per_photo = options.camera.cameras == "per-photo"
            write_database(database, read.photos, files, per_photo=per_photo)
        match_pairs(database, pairs, options.random.seed, progress)
    return read_pairs(database, pairs), count_keypoints(database, read.photos)


def _map(
    read: ReadPhotos, options: PhotosOptions, stages: Stages, progress: StepProgress
) -> Mapped:
    if not stages.models().exists():
        work = stages.folder / "mapping"
        with writing_to(stages.out):
            shutil.rmtree(work, ignore_errors=True)
            work.mkdir()
        mapped = map_photos(
            stages.database(), work, len(read.photos), options.random.seed, progress
        )
        with writing_to(stages.out):
            write_models(mapped, stages.models())
    return read_models(stages.models())


def _write(
    components: list[Component],
    told: Told,
    opened: OutFolder,
    key: str,
    progress: StepProgress,
) -> None:
    """Write everything that lies in OUT."""
    pictures = opened.work_folder(PICTURES)
    with timed_step(told.steps, "pictures"), writing_to(opened.path):
        structure, cameras = write_pictures(
            components[0].structure, told.photos, pictures, progress
        )
    told.components = [replace(components[0], structure=structure), *components[1:]]
    sparse = opened.work_folder(SPARSE)
    work = opened.work_folder(CALL)
    with timed_step(told.steps, "write"), writing_to(opened.path):
        for number, component in enumerate(told.components):
            folder = sparse / str(number)
            folder.mkdir()
            model_of(component.structure).write_binary(folder)
        write_points(structure.points, structure.colours, work / POINTS)
        write_place(place_of(structure, cameras), work / "place.json")
    report, page = photos_report(told)
    with writing_to(opened.path):
        (work / "report.json").write_bytes(report.to_json())
        (work / "report.html").write_bytes(page)
    opened.publish(SPARSE, key, sparse)
    opened.publish(PICTURES, key, pictures)
    summary = {**measures_of(told), "left": [list(pair) for pair in told.left]}
    opened.publish(CALL, key, work, summary)


def _fail(opened: OutFolder, key: str, told: Told, error: NotFoundError) -> None:
    """Say why there is nothing; what an earlier call left is taken away."""
    failure = Failure(subject=told.folder, kind="not-found", reason=str(error))
    report, page = failure_report(told, failure)
    work = opened.work_folder(CALL)
    with writing_to(opened.path):
        (work / "report.json").write_bytes(report.to_json())
        (work / "report.html").write_bytes(page)
    for item in (SPARSE, PICTURES):
        opened.publish(item, key, opened.work_folder(item))
    opened.publish(CALL, key, work, {"left": [list(pair) for pair in told.left]}, failure)
