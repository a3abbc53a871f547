"""One run of a verb: the OUT folder, resuming, the report, and how failure is told.

A verb gives what it depends on and a function that does the work; all the rest is the same for
every verb (`run.outputs` has the rules of OUT).
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import JsonValue

from veduta.run.atomic import remove_folder
from veduta.run.digests import result_key
from veduta.run.errors import NotFoundError
from veduta.run.options import Options
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.page import Page, render
from veduta.run.pool import Task
from veduta.run.progress import Progress
from veduta.run.record import CALL, PRIVATE
from veduta.run.report import Failure, Report
from veduta.run.work import Work

DOUBTS, SUMMARY = "doubts", "summary"


@dataclass(frozen=True)
class VerbCall:
    """What a run depends on.

    command: the verb, or what of it ("plan (rebuild)"). version: raised when a step changes its
    result, so that no older result is taken for a new one's. inputs: digests of the records, and
    names that are written into the result. options: all that count. in_place: the result of an
    edited document in OUT itself; whatever run made OUT is then amended.
    """

    command: str
    version: str
    subject: str
    options: Options
    inputs: JsonValue
    in_place: bool = False

    @property
    def key(self) -> str:
        """Changes with anything that the result depends on; the subject is written into it."""
        inputs: list[JsonValue] = [self.subject, self.inputs]
        return result_key(self.command, self.version, self.options, inputs)


@dataclass
class VerbResult:
    """What a run came to; `measures` are those of its report."""

    out: Path
    up_to_date: bool = False
    measures: dict[str, Any] = field(default_factory=dict)
    failure: Failure | None = None
    doubts: list[str] = field(default_factory=list)
    summary: str = ""
    edited: list[str] = field(default_factory=list)
    """Files in OUT that the user has changed: they are left as they are."""
    foreign: list[str] = field(default_factory=list)
    """Files in OUT that Veduta did not make."""

    @property
    def exit_code(self) -> int:
        """0 done, 3 nothing was found."""
        return 3 if self.failure else 0


def run_verb(
    call: VerbCall,
    out: Path,
    make: Callable[[Work], None],
    progress: Progress,
    *,
    force: bool = False,
) -> VerbResult:
    """Do the work into OUT, unless it is there already.

    make: writes into `work.folder`; NotFoundError of it ends in a report that says why, and in exit
    code 3. Errors of bad input pass through.
    """
    key = call.key
    with open_out(out, call.command, key, force=force, amend=call.in_place) as opened:
        done = opened.standing is Standing.UP_TO_DATE or (
            call.in_place and not force and opened.is_current(CALL, key)
        )
        if not done:
            with progress.over(1):
                progress.started(Task(call.subject, None))
                _make(call, opened, key, make, progress)
                progress.finished(call.subject, opened.record.items[CALL].failure)
        with suppress(OSError):  # what was kept is in nobody's way
            remove_folder(_stages(call, opened))
        return _result(out, opened, up_to_date=done)


def _make(
    call: VerbCall,
    opened: OutFolder,
    key: str,
    make: Callable[[Work], None],
    progress: Progress,
) -> None:
    stages = _stages(call, opened)
    with writing_to(opened.path):
        stages.mkdir(parents=True, exist_ok=True)
    folder = opened.work_folder(CALL)
    work = Work(folder, stages, call.command, call.version, call.options, progress.step)
    failure = None
    try:
        make(work)
    except NotFoundError as error:
        failure = Failure(subject=call.subject, kind="not-found", reason=str(error))
        folder = opened.work_folder(CALL)  # nothing half made is left
    report = _report(call, work, failure)
    with writing_to(opened.path):
        (folder / "report.json").write_bytes(report.to_json())
        (folder / "report.html").write_bytes(render(report, _page(call, work, failure)))
    summary: dict[str, JsonValue] = {
        **report.measures, DOUBTS: [*work.doubts], SUMMARY: work.summary
    }  # fmt: skip
    opened.publish(CALL, key, folder, summary, failure)
    if not call.in_place:
        opened.finish()


def _stages(call: VerbCall, opened: OutFolder) -> Path:
    """Where a killed run leaves what the next goes on from."""
    return opened.path / PRIVATE / call.command.split()[0]


def _report(call: VerbCall, work: Work, failure: Failure | None) -> Report:
    return Report(
        verb=call.command,
        subject=call.subject,
        state="failed" if failure else "done",
        options=call.options.model_dump(mode="json"),
        steps=work.steps,
        measures={} if failure else work.measures,
        notes=[*work.doubts, *work.notes],
        failures=[failure] if failure else [],
    )


def _page(call: VerbCall, work: Work, failure: Failure | None) -> Page:
    files = [] if failure else [*work.files, ("report.json", "the same as this page, for programs")]
    return Page(
        title=call.subject,
        summary=failure.reason if failure else work.summary,
        facts=[] if failure else work.facts,
        doubts=[] if failure else work.doubts,
        pictures=work.pictures,
        bars=work.charts,
        tables=work.tables,
        files=files,
    )


def _result(out: Path, opened: OutFolder, *, up_to_date: bool) -> VerbResult:
    item = opened.record.items[CALL]
    measures: dict[str, Any] = dict(item.summary)
    return VerbResult(
        out,
        up_to_date,
        failure=item.failure,
        doubts=list(measures.pop(DOUBTS, [])),
        summary=str(measures.pop(SUMMARY, "")),
        measures=measures,
        edited=opened.edited(),
        foreign=sorted(set(opened.kept) - set(opened.record.files)),
    )
