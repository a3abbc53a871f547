"""All inputs of one call: what is done already, the rest on all cores, and the place of all."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import cast

from pydantic import JsonValue

from veduta.facade.arrangement import Placed, Vector, arrange, stand_of
from veduta.facade.call import Call, Input, Kind, plan_call
from veduta.facade.document import FacadeDocument
from veduta.facade.house_folders import beside_kept, beside_of
from veduta.facade.job import Job, JobResult, memory_of, run_job
from veduta.facade.label_pictures import labels_note
from veduta.facade.load import DOCUMENT, load_document, load_photo
from veduta.facade.options import FacadeOptions, OntoOptions
from veduta.facade.pipeline import VERSION
from veduta.facade.report import call_report
from veduta.facade.style_told import search_note
from veduta.run.digests import file_digest, result_key
from veduta.run.errors import InputError
from veduta.run.names import real_path
from veduta.run.options import Options, flag
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.pool import Outcome, Task, run_tasks
from veduta.run.progress import Progress, no_progress
from veduta.run.record import CALL
from veduta.run.report import Failure

COMMAND = {"photo": "facade", "document": "facade (rebuild)"}
MADE_FROM = "document_sha256"
"""In an item's summary: the document that its building was made from."""
LASTING = {"input", "not-found"}
"""Failures that the same input would give again; others are tried anew by the next run."""


@dataclass
class CallResult:
    """What the call came to; names are those of the folders in OUT."""

    out: Path
    kind: Kind
    asked: list[str]
    """The inputs of this call; a rebuild in place leaves others in OUT."""
    up_to_date: bool = False
    summaries: dict[str, dict[str, JsonValue]] = field(default_factory=dict)
    failures: dict[str, Failure] = field(default_factory=dict)
    fresh: list[str] = field(default_factory=list)
    """Made by this run; the others were there already."""
    edited: list[str] = field(default_factory=list)
    """Files that somebody has edited: left as they are; paths in OUT."""
    outdated: list[str] = field(default_factory=list)
    """Names of buildings that were made from another document than the one that lies there now."""
    foreign: list[str] = field(default_factory=list)
    """Files that were there before Veduta and stand where results would go; paths in OUT."""
    left: list[str] = field(default_factory=list)
    """Folders of an earlier call that this one has nothing to do with."""
    labels: Sequence[Path] = ()
    """Pictures of labels between the photos of a folder: nothing was made of them."""
    tracebacks: dict[str, str] = field(default_factory=dict)

    @property
    def failed(self) -> dict[str, Failure]:
        """The inputs of this call that gave nothing."""
        return {name: self.failures[name] for name in self.asked if name in self.failures}

    @property
    def exit_code(self) -> int:
        """0 done, 1 a bug, 2 nothing but bad input (or no room), 3 some images failed."""
        kinds = {failure.kind for failure in self.failed.values()}
        if "bug" in kinds:
            return 1
        if "output" in kinds or (kinds == {"input"} and len(self.failed) == len(self.asked)):
            return 2
        return 3 if kinds else 0


def run_call(
    paths: Sequence[Path],
    out: Path,
    options: FacadeOptions,
    progress: Progress,
    *,
    force: bool = False,
    jobs: int | None = None,
) -> CallResult:
    """Make the results of all inputs in OUT, by the rules of `run.outputs`."""
    call = plan_call(paths)
    if call.kind == "document":
        _check_documents(call, options)
    elif options.rectify.corners is not None and len(call.inputs) > 1:
        raise InputError(
            "--corners",
            f"are those of one facade, but {len(call.inputs)} photos are named",
            "Make a call for each photo.",
        )
    elif options.onto.onto is not None and len(call.inputs) > 1:
        raise InputError(
            "--onto",
            f"has a wall for one front, but {len(call.inputs)} photos are named",
            "Make a call for each photo.",
        )
    elif options.depth.depth_map is not None and len(call.inputs) > 1:
        raise InputError(
            "--depth-map",
            f"is of one wall, but {len(call.inputs)} photos are named",
            "Make a call for each photo.",
        )
    if call.kind == "photo":
        options = _with_elevation(_on_wall(options), call).of_photo()
    key = _key("call", [source.identity for source in call.inputs], call, options)
    amend = all(_is_in_place(source, out) for source in call.inputs)
    with open_out(out, COMMAND[call.kind], key, force=force, amend=amend) as folder:
        asked = [source.name for source in call.inputs]
        result = CallResult(out, call.kind, asked, labels=call.left_out)
        result.up_to_date = folder.standing is Standing.UP_TO_DATE
        waiting = [
            source
            for source in call.inputs
            if (force and amend) or _is_wanted(folder, source, call, options, result)
        ]
        before = {name: folder.record.files.get(f"{name}/{DOCUMENT}") for name in result.asked}
        if folder.standing in {Standing.NEW, Standing.RESUMED, Standing.REPLACED}:
            folder.record.inputs = result.asked
        if waiting:
            result.up_to_date = False
            if options.style.style is not None:
                progress.said(search_note(options.style, len(waiting)))
            _process(waiting, folder, call, options, result, progress, jobs)
        elif amend:
            result.up_to_date = True
        _collect(folder, call, result)
        _outdate(folder, before)
        result.edited = folder.edited()
        result.outdated = [name for name in result.summaries if _is_outdated(folder, name, result)]
        if not result.up_to_date:
            _write_call(folder, options, key, result)
        result.foreign = sorted(set(folder.kept) - set(folder.record.files))
    return result


def _with_elevation(options: FacadeOptions, call: Call) -> FacadeOptions:
    """The options with what the depth map is of; InputError where it is not of the photo."""
    if options.depth.depth_map is None:
        return options
    from veduta.facade.measured import of_photo  # few calls ask for it

    elevation = of_photo(options.depth.depth_map, call.inputs[0].path)
    return options.model_copy(update={"elevation": elevation})


def _on_wall(options: FacadeOptions) -> FacadeOptions:
    """The options with the wall that the front is put on, where one is asked for."""
    if options.onto == OntoOptions():
        return options
    from veduta.facade.footprint import on_wall  # slow to load, and few calls ask for it

    return on_wall(options)


def _outdate(folder: OutFolder, before: dict[str, str | None]) -> None:
    """A rebuild that wrote another document leaves no result of the photos' own call.

    What somebody edited is kept by that call, and told; `before` are the documents' digests.
    """
    if folder.standing is not Standing.AMENDED:
        return
    for name, digest in before.items():
        document = f"{name}/{DOCUMENT}"
        changed = digest != folder.record.files.get(document)
        if changed and document not in folder.edited(name):
            folder.record.key = f"amended {document}"


def _is_outdated(folder: OutFolder, name: str, result: CallResult) -> bool:
    """Whether the document was changed since the building was made from it."""
    document = folder.path / name / DOCUMENT
    if not document.is_file():
        return False
    # A result of an older run does not say what it was made from: any edit is then a newer one.
    made_from = result.summaries[name].get(MADE_FROM)
    if made_from is None:
        return f"{name}/{DOCUMENT}" in result.edited
    return made_from != file_digest(document)


def _check_documents(call: Call, options: FacadeOptions) -> None:
    """Edited documents are checked before anything is written because of them."""
    mend_scale = "Leave it out and edit scale.metres_per_px there; or name the photo."
    mend = "Leave it out, or name the photo."
    remedies = (
        (options.eyes, mend),
        (options.rectify, mend),
        (options.scale, mend_scale),
        (options.style, mend),
        (options.houses, mend),
        (options.onto, mend),
        (options.depth, mend),
    )
    for given, remedy in remedies:
        for name in type(given).model_fields:
            if getattr(given, name) != getattr(type(given)(), name):
                raise InputError(
                    flag(name),
                    "is for photos and changes nothing in a document",
                    remedy,
                )
    for source in call.inputs:
        load_photo(source.path, load_document(source.path))


def _is_in_place(source: Input, out: Path) -> bool:
    return source.kind == "document" and real_path(source.path) == (
        real_path(out) / source.name / DOCUMENT
    )


def _key(step: str, inputs: JsonValue, call: Call, options: FacadeOptions) -> str:
    """A rebuild depends on the model's options alone."""
    used: Options = options if call.kind == "photo" else options.model
    return result_key(f"{COMMAND[call.kind]} {step}", VERSION, used, inputs)


def _is_wanted(
    folder: OutFolder, source: Input, call: Call, options: FacadeOptions, result: CallResult
) -> bool:
    """Whether the input has still to be worked on.

    A folder whose document somebody has edited stays as it is, whole: new pictures and models
    beside an old document would contradict it. Only a rebuild works on it.
    """
    if folder.standing is Standing.UP_TO_DATE:
        return False
    edited = [name for name in folder.edited(source.name) if name.endswith(f"/{DOCUMENT}")]
    if call.kind == "photo" and edited:  # also of another house of the photo
        if not folder.keep(source.name):
            document = folder.path / source.name / DOCUMENT
            result.failures[source.name] = _interrupted(document, folder.path)
        return False
    return not folder.is_current(source.name, _key("item", source.identity, call, options))


def _interrupted(document: Path, out: Path) -> Failure:
    reason = f"was edited, and its rebuild did not end: veduta facade {document} -o {out}"
    return Failure(subject=str(document), kind="output", reason=reason)


def _process(
    waiting: list[Input],
    folder: OutFolder,
    call: Call,
    options: FacadeOptions,
    result: CallResult,
    progress: Progress,
    jobs: int | None,
) -> None:
    """Work on the inputs, and publish each as soon as it is done."""
    inputs = {source.name: source for source in waiting}
    step = progress.step if len(waiting) == 1 else no_progress
    tasks = [
        Task(
            source.name,
            Job(source, options, folder.path, folder.work_folder(source.name), step),
            memory_of(source, options.rectify),
        )
        for source in waiting
    ]
    # Closed at once where nothing more can be written: no worker goes on for nothing.
    with (
        progress.over(len(tasks)),
        closing(run_tasks(run_job, tasks, jobs=jobs, started=progress.started)) as outcomes,
    ):
        for outcome in outcomes:
            if outcome.error is not None:
                raise outcome.error
            source = inputs[outcome.task.name]
            job_result = _result_of(outcome, source, result)
            _publish(folder, source, call, options, job_result)
            result.fresh.append(source.name)
            if job_result.failure:
                result.failures[source.name] = job_result.failure
            progress.finished(source.name, job_result.failure)


def _result_of(outcome: Outcome[JobResult], source: Input, result: CallResult) -> JobResult:
    """The job's own result, or the failure that its end without one is."""
    if outcome.value is not None:
        return outcome.value
    if outcome.traceback is not None:
        result.tracebacks[source.name] = outcome.traceback
    return JobResult(failure=outcome.failure(str(source.path)))


def _publish(
    folder: OutFolder, source: Input, call: Call, options: FacadeOptions, job_result: JobResult
) -> None:
    """Put the files in place. A failed rebuild leaves what was there."""
    failure = job_result.failure
    lasting = failure is None or failure.kind in LASTING
    if lasting and not (failure and folder.standing is Standing.AMENDED):
        work = folder.work_path(source.name)
        lies_there = _lasting(source, folder, work)
        key = _key("item", lies_there.identity, call, options)
        summary = dict(job_result.summary)
        if failure is None:
            summary[MADE_FROM] = _digest_of_document(lies_there, folder, work)
        former = folder.record.items.get(source.name)
        stays: list[str] = []
        if folder.standing is Standing.AMENDED and former is not None:
            main = FacadeDocument.model_validate_json((work / DOCUMENT).read_bytes())
            summary |= beside_kept(former.summary, main, folder.path / source.name)
            stays = [house.folder for house in beside_of(summary)]
        folder.publish(source.name, key, work, summary, failure, stays)
    elif folder.standing is not Standing.AMENDED:
        folder.forget(source.name)


def _lasting(source: Input, folder: OutFolder, work: Path) -> Input:
    """The input as the next call finds it: a rebuild in place may replace its own document.

    It does where other sizes were asked for and the document is as Veduta wrote it.
    """
    document = f"{source.name}/{DOCUMENT}"
    if folder.standing is not Standing.AMENDED or document in folder.edited(source.name):
        return source
    return replace(source, digests=(file_digest(work / DOCUMENT), *source.digests[1:]))


def _digest_of_document(source: Input, folder: OutFolder, work: Path) -> str:
    """Of the document that will lie in OUT: in place it stays as it was edited."""
    if folder.standing is Standing.AMENDED and _is_in_place(source, folder.path):
        return source.digests[0]
    return file_digest(work / DOCUMENT)


def _collect(folder: OutFolder, call: Call, result: CallResult) -> None:
    """What the place consists of, in the order of the call (or of the run that it amends)."""
    asked = [source.name for source in call.inputs]
    if folder.standing is Standing.AMENDED:
        asked = list(dict.fromkeys([*folder.record.inputs, *asked]))
        folder.record.inputs = asked
    for name in asked:
        item = folder.record.items.get(name)
        if item is not None and item.failure is not None:
            result.failures.setdefault(name, item.failure)
        elif item is not None and item.state == "done" and name not in result.failures:
            result.summaries[name] = item.summary
    folders = {path.split("/")[0] for path in folder.record.files if "/" in path}
    result.left = sorted(folders - set(asked))


def _write_call(folder: OutFolder, options: FacadeOptions, key: str, result: CallResult) -> None:
    """The place of all that is done, and the report of the call."""
    work = folder.work_folder(CALL)
    placed = [
        Placed(
            name,
            _vector(summary["bounds_min"]),
            _vector(summary["bounds_max"]),
            stand_of(summary),
            beside_of(summary),
        )
        for name, summary in result.summaries.items()
    ]
    notes = [f"{name}/ is left from an earlier call" for name in result.left]
    notes += [f"{name} was edited and is left as it is" for name in result.edited]
    notes += [f"{name}/{DOCUMENT} was changed since the rest was made" for name in result.outdated]
    notes += [labels_note(result.labels, whole=True)] if result.labels else []
    failures = list(result.failures.values())
    effective = options.model_dump(mode="json")
    if result.kind == "document":
        # What is not given here is as each document has it: its own report says what that is.
        effective = options.model.model_dump(mode="json", exclude_none=True)
        notes.insert(0, f"rebuilt from facade.json: {', '.join(result.asked)}")
    report, page = call_report(folder.path, effective, result.summaries, failures, notes)
    with writing_to(folder.path):
        if placed:
            arrange(placed, folder.path).save(work)
        (work / "report.json").write_bytes(report.to_json())
        (work / "report.html").write_bytes(page)
    folder.publish(CALL, key, work)
    retry = any(failure.kind not in LASTING for failure in result.failures.values())
    if not retry and folder.standing is not Standing.AMENDED:
        folder.finish()


def _vector(value: JsonValue) -> Vector:
    x, y, z = cast(list[float], value)
    return (x, y, z)
