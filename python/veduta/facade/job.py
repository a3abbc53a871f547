"""One input of a call, from its path to a folder of finished files: what a worker does."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image
from pydantic import JsonValue

from veduta.facade.adjusted import count_adjusted
from veduta.facade.arrangement import stands
from veduta.facade.call import Input
from veduta.facade.document import FacadeDocument
from veduta.facade.glass import GLASS_TOLD
from veduta.facade.house_folders import beside_told, houses_doubt
from veduta.facade.load import PHOTO
from veduta.facade.margins import WIDTH_DOUBTED
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.pipeline import Building, rebuild, reconstruct, write_building
from veduta.facade.report import image_report, measures
from veduta.imaging.read import DAMAGE, FORMATS
from veduta.run.errors import InputError, NotFoundError
from veduta.run.failed import failure_report
from veduta.run.options import Options
from veduta.run.outputs import writing_to
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import Failure, Report, StepRecord

# Measured as the peak resident size of single runs, less that of the interpreter and libraries:
# 500 MB with 24 megapixels, 1790 MB with 99, 900 MB with 24 that are rectified at full size.
BYTES_PER_PHOTO_PIXEL = 16
BYTES_PER_RECTIFIED_PIXEL = 34
BYTES_BESIDE = 90 * 1024**2


@dataclass(frozen=True)
class Job:
    """One input, the OUT that is asked for, and the empty folder in it that gets the files."""

    source: Input
    options: FacadeOptions
    out: Path
    folder: Path
    progress: StepProgress = no_progress


@dataclass(frozen=True)
class JobResult:
    """What is kept in the run record of a finished input; or why there is nothing."""

    summary: dict[str, JsonValue] = field(default_factory=dict)
    failure: Failure | None = None


def run_job(job: Job) -> JobResult:
    """Fill the job's folder with the results, or with the report of why there are none.

    InputError where neither can be written: then no other job's result could be either.
    """
    steps: list[StepRecord] = []
    options: Options = job.options if job.source.kind == "photo" else job.options.model
    try:
        building = _building(job, steps)
    except (InputError, NotFoundError) as error:
        kind = "input" if isinstance(error, InputError) else "not-found"
        failure = Failure(subject=str(job.source.path), kind=kind, reason=_reason(error, job))
        report = failure_report("facade", job.source.path.name, failure, options, steps)
        with writing_to(job.out):
            _write_report(job.folder, report)
        return JobResult(failure=failure)
    if job.source.kind == "document":
        options = building.document.model
    with writing_to(job.out):
        write_building(building, job.folder, steps, job.progress)
        _write_report(job.folder, image_report(building, options, steps))
        for name, other in building.beside:
            folder = job.folder / name
            folder.mkdir()
            own = list(other.steps)
            write_building(other, folder, own, job.progress)
            _write_report(folder, image_report(other, options, own))
    return JobResult(summary=_summary(building, steps))


def memory_of(source: Input, options: RectifyOptions) -> int:
    """Bytes that a worker will need for the input, from its header; 0 where there is none."""
    path = source.path if source.kind == "photo" else source.path.with_name(PHOTO)
    try:
        with warnings.catch_warnings(action="ignore"), Image.open(path, formats=FORMATS) as image:
            pixels = image.width * image.height
    except (*DAMAGE, Image.DecompressionBombError):
        return 0  # the job will say what is wrong with it
    rectified = min(pixels, options.max_side_px**2)
    return BYTES_BESIDE + BYTES_PER_PHOTO_PIXEL * pixels + BYTES_PER_RECTIFIED_PIXEL * rectified


def _building(job: Job, steps: list[StepRecord]) -> Building:
    source = job.source
    if source.kind == "photo":
        return reconstruct(source.path, job.options, source.name, steps, job.progress)
    return rebuild(source.path, job.options.model, source.name, steps, job.progress)


def _reason(error: InputError | NotFoundError, job: Job) -> str:
    """The error without the path, which stands beside it."""
    if isinstance(error, InputError) and error.subject == str(job.source.path):
        return f"{error.fault}. {error.remedy}"
    return str(error)


def _write_report(folder: Path, report: tuple[Report, bytes]) -> None:
    (folder / "report.json").write_bytes(report[0].to_json())
    (folder / "report.html").write_bytes(report[1])


def _summary(building: Building, steps: list[StepRecord]) -> dict[str, JsonValue]:
    low, high = building.part.bounds_m
    others = [(name, one.document, one.part) for name, one in building.beside]
    numbers = [_numbers(one.document) for _, one in building.beside]
    return {
        **stands(building.document),
        **_numbers(building.document),
        **({} if building.style is None else {"style": building.style.line}),
        **houses_doubt(building.document),
        **_said(building.document),
        **count_adjusted(building.part.notes),
        **beside_told(building.document, others, numbers),
        "seconds": round(sum(step.seconds for step in steps), 3),
        "bounds_min": list(low),
        "bounds_max": list(high),
    }


def _numbers(document: FacadeDocument) -> dict[str, JsonValue]:
    """What the line of a house at the terminal is made of."""
    found = measures(document)
    kept = (
        "storeys",
        "storeys_doubtful",
        "windows",
        "doubtful_windows",
        "doubtful_elements",
        "width_m",
        "height_m",
        "picture_share",
        "corners_doubtful",
        "scale",
    )
    return {name: found[name] for name in kept}


def _said(document: FacadeDocument) -> dict[str, JsonValue]:
    """Notes that are told at the terminal, too: of glass, and of a width in doubt."""
    told = {"glass": GLASS_TOLD, "width": WIDTH_DOUBTED}
    return {
        name: note
        for name, begins in told.items()
        for note in document.notes
        if note.startswith(begins)
    }
