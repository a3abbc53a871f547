"""`veduta plan`: a document of walls, openings and rooms becomes a house; all files are written.

An edited document takes the same way as one that was just found.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic import JsonValue

from veduta.plan.building import FILES_OF, Building, BuildingFiles, Visit
from veduta.plan.call import Call, plan_call
from veduta.plan.document import PlanDocument
from veduta.plan.doubts import doubts
from veduta.plan.flat_alone import as_flat
from veduta.plan.flats import flat_options
from veduta.plan.follow_walls import with_rooms_on_walls
from veduta.plan.furnish.catalogue.digest import catalogue_digests
from veduta.plan.furnish.catalogue.read import Catalogue, catalogue_of
from veduta.plan.house.furniture import check_objects
from veduta.plan.idle_options import idle_notes
from veduta.plan.kept_document import LEFT, UNWRITTEN, keep_panorama, says_site, sited
from veduta.plan.load import DOCUMENT, load_document
from veduta.plan.options import HouseOptions, PlanOptions
from veduta.plan.pages import Drawing, find_drawings
from veduta.plan.photos.finish import picture_digests
from veduta.plan.photos.given import RoomPhoto, place_of
from veduta.plan.report import measures, plan_report
from veduta.plan.rescale import rescaled
from veduta.plan.steps import (
    document_step,
    finish_step,
    furnish_step,
    house_step,
    light_step,
    tour_step,
)
from veduta.plan.surroundings.panorama import Pictures, given_pictures, kept_pictures
from veduta.plan.surroundings.site import check_site, site_of
from veduta.plan.terrace import terrace_options, with_terrace
from veduta.plan.upper_floor import upper_floor_options
from veduta.plan.vector.open_dxf import is_dxf
from veduta.plan.writing import result_of, write_result
from veduta.run.beside import Beside
from veduta.run.digests import file_digest, result_key
from veduta.run.errors import InputError, NotFoundError
from veduta.run.failed import failure_report
from veduta.run.options import Options
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.pool import Task
from veduta.run.progress import Progress, StepProgress
from veduta.run.record import CALL
from veduta.run.report import Failure, StepRecord, timed_step

VERSION = "54"
"""Raised when any step changes its result: no older result is then taken for a new one's."""
COMMAND = {"drawings": "plan", "document": "plan (rebuild)"}
MADE_FROM = "document_sha256"
"""In the summary of a result: the document that its house was made from."""
OTHERWISE = "document_says_otherwise"
"""In the summary of a result: whether options made another house than the document describes."""
DOUBTS = "doubts"
"""In the summary of a result: what must be known before the house is trusted."""


@dataclass
class PlanResult:
    """What the call came to; `measures` is of its report."""

    out: Path
    up_to_date: bool = False
    measures: dict[str, Any] = field(default_factory=dict)
    failure: Failure | None = None
    outdated: bool = False
    """Whether plan.json was changed since the house was made from it."""
    notes: list[str] = field(default_factory=list)
    """Options that changed nothing, and why."""
    doubts: list[str] = field(default_factory=list)
    """What must be known before the house is trusted."""
    left: bool = False
    """Whether nothing was made, as plan.json was edited."""
    edited: list[str] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)

    @property
    def exit_code(self) -> int:
        """0 done, 3 there is no plan in the drawings."""
        return 3 if self.failure else 0


@dataclass(frozen=True)
class _Given:
    """What a house is made of: a document or drawings, photos of rooms, furniture, a panorama.

    notes: what was changed in the document to hold together.
    """

    plan: PlanDocument | list[Drawing]
    photos: Sequence[RoomPhoto]
    catalogue: Catalogue
    panorama: Pictures | None
    notes: Sequence[str] = ()


def run_plan(
    paths: Sequence[Path],
    out: Path,
    options: PlanOptions,
    progress: Progress,
    *,
    photos: Sequence[RoomPhoto] = (),
    force: bool = False,
) -> PlanResult:
    """Make a house of drawings or of a document in OUT, by the rules of `run.outputs`.

    photos: of rooms, whose paint and tiles they show.
    """
    call = plan_call(paths)
    in_place = call.is_in_place(out)
    # Checked before anything is written because of it.
    checked, followed = _checked(call, options)
    check_site(checked, options.site)
    catalogue = catalogue_of(options.house.catalogue)
    if checked is not None:
        check_objects(checked, catalogue, call.paths[0])
        for photo in photos:
            place_of(checked, photo.room)
    panorama = _panorama(call, checked, options)
    drawings = _drawings(call, options)
    given = _Given(checked or drawings, photos, catalogue, panorama, followed)
    key = _key(call, given, checked, options)
    with open_out(out, COMMAND[call.kind], key, force=force, amend=in_place) as opened:
        result = PlanResult(out, up_to_date=_is_made(opened, call, key, force=force))
        result.notes = [] if checked is None else [*followed, *idle_notes(checked, options)]
        result.left = not result.up_to_date and _is_left(opened, call)
        if result.left and (photos or not says_site(out / DOCUMENT, options.site, panorama)):
            result.notes.append(LEFT)
        if not result.up_to_date and not result.left:
            with progress.over(1, _steps(given, options.house)):
                progress.started(Task(call.subject, None))
                with Beside(FILES_OF) as building:
                    _make(call, given, options, opened, key, building, progress.step)
                progress.finished(call.subject, opened.record.items[CALL].failure)
        _tell(result, opened)
    return result


def _checked(call: Call, options: PlanOptions) -> tuple[PlanDocument | None, list[str]]:
    """The document that is given, with rooms on their walls and in its scale; and what changed."""
    if call.kind != "document":
        return None, []
    document, followed = with_rooms_on_walls(load_document(call.paths[0]))
    document, scaled = rescaled(document, options.scale.scale)
    return document, [*followed, *scaled]


def _steps(given: _Given, options: HouseOptions) -> int:
    """How many steps there are to be, for the bar that shows them."""
    if isinstance(given.plan, PlanDocument):
        reading = 1
    else:
        reading = sum(2 if is_dxf(one.path) else 4 for one in given.plan)
    asked = (bool(given.photos), not options.no_furniture, not options.no_tour)
    return reading + sum(asked) + 4  # lights, house, drawings, write


def _drawings(call: Call, options: PlanOptions) -> list[Drawing]:
    """What is to be read: none where a house is rebuilt."""
    if call.kind == "drawings":
        return find_drawings(call.paths, options.input.page_numbers())
    if options.input.pages is not None:
        raise InputError("--pages", "is for PDFs, and a document is given", "Leave it out.")
    return []


def _panorama(call: Call, checked: PlanDocument | None, options: PlanOptions) -> Pictures | None:
    """The pictures around the house: those that are asked for, else the document's."""
    if options.site.panorama is not None:
        return given_pictures(options.site.panorama)
    if checked is None or checked.panorama is None:
        return None
    return kept_pictures(checked.panorama, call.paths[0].parent)


def _key(call: Call, given: _Given, checked: PlanDocument | None, options: PlanOptions) -> str:
    """All that the result depends on."""
    digests: list[JsonValue] = [*catalogue_digests(options.house.catalogue, given.catalogue)]
    if checked is not None:
        digests += picture_digests(call.paths[0].parent, checked)
    if given.panorama is not None:
        digests.append(given.panorama.digest)
    digests += [photo.identity for photo in given.photos]
    return result_key_of(call, options, digests)


def result_key_of(call: Call, options: PlanOptions, others: Sequence[JsonValue]) -> str:
    """The key of a result: of the files that options name their content, wherever they lie.

    others: the digests of those files, and what takes part besides what is read or rebuilt.
    """
    house = options.house.model_copy(update={"catalogue": None})
    site = options.site.model_copy(update={"panorama": None})
    used = _used(call, options.model_copy(update={"house": house, "site": site}))
    return result_key(COMMAND[call.kind], VERSION, used, [*call.identity, *others])


def _used(call: Call, options: PlanOptions) -> Options:
    """The options that count: a house that is rebuilt has its drawings."""
    if call.kind == "drawings":
        return options
    return PlanOptions(house=options.house, site=options.site, scale=options.scale)


def _is_made(opened: OutFolder, call: Call, key: str, *, force: bool) -> bool:
    if opened.standing is Standing.AMENDED:
        item = opened.record.items.get(CALL)
        made_from = None if item is None else item.summary.get(MADE_FROM)
        same = made_from == call.digests[0] and opened.is_current(CALL, key)
        return same and not force
    return opened.standing is Standing.UP_TO_DATE


def _is_left(opened: OutFolder, call: Call) -> bool:
    """New drawings of a house beside a document that somebody has edited would contradict it."""
    if call.kind == "document" or DOCUMENT not in opened.edited():
        return False
    if not opened.keep(CALL):
        return False
    opened.finish()
    return True


def _stays(opened: OutFolder) -> bool:
    """Whether the house is made from the document in OUT, and that was edited: it is kept."""
    return opened.standing is Standing.AMENDED and DOCUMENT in opened.edited()


def _make(
    call: Call,
    given: _Given,
    options: PlanOptions,
    opened: OutFolder,
    key: str,
    building: Beside[Building | Visit, BuildingFiles],
    progress: StepProgress,
) -> None:
    """All steps; drawings in which there is no plan end in a report that says why.

    building: makes files beside the tour, and beside the models.
    """
    steps: list[StepRecord] = []
    used = _used(call, options)
    stays = _stays(opened)
    work = opened.work_folder(CALL)
    try:
        read, sheets, notes = document_step(call, given.plan, options, steps, progress)
        finished = finish_step(call, read, given.photos, steps, progress, stays=stays)
        notes = [*given.notes, *notes, *finished.notes]
        document = sited(finished.document, options.site, given.panorama)
        document = as_flat(document, options.house, drawn=call.kind == "drawings")
        document = with_terrace(document, options.house, by_text=call.kind == "drawings")
        built = terrace_options(document, flat_options(document, options.house))
        built = upper_floor_options(document, built)
        otherwise = stays and (document != read or bool(options.scale.scale))
        if otherwise:
            notes = [*notes, UNWRITTEN]
        if not options.house.no_furniture:
            document = furnish_step(document, given.catalogue, options.house, steps, progress)
        document = light_step(document, options, steps, progress).document
        house = house_step(document, finished.pictures, built, steps, progress)
        site = site_of(document)
        building.give(Building(house, built, site))
        tour, house = tour_step(house, built, steps, progress)
        progress("drawings", 0.0)
        with timed_step(steps, "drawings"):
            result = result_of(document, house, tour, sheets, finished, given.panorama, site)
    except NotFoundError as error:
        failure = Failure(subject=call.subject, kind="not-found", reason=str(error))
        report, page = failure_report("plan", call.subject, failure, used, steps)
        with writing_to(opened.path):
            (work / "report.json").write_bytes(report.to_json())
            (work / "report.html").write_bytes(page)
        opened.publish(CALL, key, work, {}, failure)
    else:
        progress("write", 0.0)
        with writing_to(opened.path), timed_step(steps, "write") as step:
            if stays:
                keep_panorama(read, opened.path, work)
            step.rejected.extend(write_result(result, building, work, built))
        doubtful = doubts(result.document, result.tour, result.house.spaces)
        report, page = plan_report(result, call.subject, used, steps, notes, doubtful)
        with writing_to(opened.path):
            (work / "report.json").write_bytes(report.to_json())
            (work / "report.html").write_bytes(page)
        made_from = call.digests[0] if stays else file_digest(work / DOCUMENT)
        summary: dict[str, JsonValue] = {
            **measures(result.document),
            MADE_FROM: made_from,
            OTHERWISE: otherwise,
            DOUBTS: [*doubtful],
        }
        opened.publish(CALL, key, work, summary)
    if opened.standing is not Standing.AMENDED:
        opened.finish()


def _tell(result: PlanResult, opened: OutFolder) -> None:
    """What lies in OUT now."""
    item = opened.record.items.get(CALL)
    if item is not None:
        result.failure = item.failure
        result.measures = dict(item.summary)
        made_from = result.measures.pop(MADE_FROM, None)
        result.doubts = result.measures.pop(DOUBTS, [])
        if result.measures.pop(OTHERWISE, False) and _stays(opened):
            result.notes.append(UNWRITTEN)
        document = opened.path / DOCUMENT
        if made_from is not None and document.is_file():
            result.outdated = made_from != file_digest(document)
    result.edited = opened.edited()
    result.foreign = sorted(set(opened.kept) - set(opened.record.files))
