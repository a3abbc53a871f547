"""Drawings taken through `veduta plan`, in a few processes: what it says is on them."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter
from record import commit

from veduta.plan.analyse import read_drawings
from veduta.plan.document import PlanDocument, Storey
from veduta.plan.options import PlanOptions
from veduta.plan.pages import Drawing
from veduta.plan.pipeline import run_plan
from veduta.run.errors import VedutaError
from veduta.run.pool import Task, run_tasks
from veduta.run.progress import Progress, no_progress

MEMORY = 800 * 1024**2


@dataclass(frozen=True)
class Reading:
    """One drawing. `storey` is None, and `reason` says why, where nothing could be read."""

    storey: Storey | None
    seconds: float
    reason: str = ""


READING = TypeAdapter(Reading)


def read_alone(path: Path) -> Reading:
    """One drawing to its document; errors that people are told are results."""
    started = time.perf_counter()
    try:
        read = read_drawings([Drawing(path)], PlanOptions(), [], no_progress)
    except VedutaError as error:
        return Reading(None, time.perf_counter() - started, str(error))
    return Reading(read.document.storeys[0], time.perf_counter() - started)


def read_with_house(path: Path) -> Reading:
    """One drawing through the whole verb: the house, all files, and plan.json as written."""
    started = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        try:
            result = run_plan([path], out, PlanOptions(), Progress(quiet=True))
            if result.failure is not None:
                return Reading(None, time.perf_counter() - started, result.failure.reason)
            text = (out / "plan.json").read_text("utf-8")
        except VedutaError as error:
            return Reading(None, time.perf_counter() - started, str(error))
    seconds = time.perf_counter() - started
    return Reading(PlanDocument.model_validate_json(text).storeys[0], seconds)


def read_plans(
    paths: Sequence[Path], jobs: int = 2, house: bool = True, kept: Path | None = None
) -> list[Reading]:
    """Drawings in `jobs` spawned processes; a crash is raised, with the drawing's name.

    Readings are left in `kept`, in a folder for this commit by the names of the drawings, and taken
    from there; not where the sources differ from the commit.
    """
    work = read_with_house if house else read_alone
    now = commit()
    if now["changed"]:
        kept = None
    if kept is not None:
        kept = kept / f"{now['commit']}-{work.__name__}"
    done = {} if kept is None else _kept(kept, paths)
    tasks = [Task(str(path), path, MEMORY) for path in paths if str(path) not in done]
    for outcome in run_tasks(work, tasks, jobs=jobs):
        if outcome.value is None:
            fault = outcome.crash or outcome.traceback or str(outcome.error)
            raise RuntimeError(f"{outcome.task.name}: {fault}")
        done[outcome.task.name] = outcome.value
        if kept is not None:
            _keep(_file_of(kept, outcome.task.argument), outcome.value)
    return [done[str(path)] for path in paths]


def _kept(folder: Path, paths: Sequence[Path]) -> dict[str, Reading]:
    folder.mkdir(parents=True, exist_ok=True)
    files = {str(path): _file_of(folder, path) for path in paths}
    return {
        name: READING.validate_json(file.read_bytes())
        for name, file in files.items()
        if file.exists()
    }


def _keep(file: Path, reading: Reading) -> None:
    half = file.with_suffix(".half")
    half.write_bytes(READING.dump_json(reading))
    half.replace(file)


def _file_of(folder: Path, path: Path) -> Path:
    return folder / f"{path.stem}.json"
