"""`veduta walk`: from a folder of stereo views to a place that one walks through."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.place.manifest import WalkTransition
from veduta.place.place import Cloud, Place
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.names import real_path
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work
from veduta.walk.build.film import flat_picture, frames_of, write_film
from veduta.walk.build.flow import FlowSettings
from veduta.walk.build.graph import worlds_of
from veduta.walk.build.judge import JudgeLimits
from veduta.walk.build.level import Compared, Gains, level_gains, levelled
from veduta.walk.build.local_model import FARTHEST_M, LocalModel
from veduta.walk.build.marks import BLUE, GREEN, painted
from veduta.walk.build.mesh import MeshSettings
from veduta.walk.build.place import (
    Station,
    picture_name,
    walk_of,
    write_picture,
    write_way,
)
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import Way, WaySettings, find_way
from veduta.walk.build.way_file import arrays_of, way_of
from veduta.walk.document.load import DOCUMENT, write_document
from veduta.walk.keys import KeyFigures, KeyModel
from veduta.walk.options import WalkOptions
from veduta.walk.photo_record import read_photo_record
from veduta.walk.read.board import calibrate_rig
from veduta.walk.record import WalkRecord, read_stereo_record
from veduta.walk.rig import Image, Rig
from veduta.walk.tell import document_of, tell_marks, tell_walk

VERSION = "10"
FILM = "walk.mp4"
CLOUD_STEP_PX = 6
CLOUD_FARTHEST_M = 60.0


@dataclass(eq=False)
class Found:
    """What is known of a walk so far. ends: the key positions of each way. marked: of the view with
    most water and grass their share, its name, and it with them painted.
    """

    stations: list[Station] = field(default_factory=list)
    figures: list[KeyFigures] = field(default_factory=list)
    ways: list[Way] = field(default_factory=list)
    ends: list[tuple[int, int]] = field(default_factory=list)
    clouds: list[tuple[NDArray[np.float64], NDArray[np.uint8]]] = field(default_factory=list)
    marked: tuple[float, str, Image] | None = None

    def add(self, found: tuple[Way, tuple[int, int]]) -> None:
        """A transition."""
        self.ways.append(found[0])
        self.ends.append(found[1])


@dataclass(frozen=True)
class Sources:
    """What a walk is made of besides its folder.

    calibration: the rig's file; boards: a folder of pictures of a board that calibrate it; cameras:
    where the frames of a single camera were taken. All None: the calibration lies in the folder.
    """

    calibration: Path | None = None
    boards: Path | None = None
    cameras: Path | None = None


def run_walk(
    folder: Path, out: Path, options: WalkOptions, progress: Progress, *,
    sources: Sources = Sources(), force: bool = False,
) -> VerbResult:  # fmt: skip
    """Make the walk of a folder into OUT."""
    record, notes = read_record(folder, options, sources)
    inputs = [file_digest(path) for path in record.files]
    call = VerbCall("walk", VERSION, real_path(folder).name, options, [*inputs])

    def make(work: Work) -> None:
        for note in notes:
            work.note(note)
        _make(work, record, options)

    return run_verb(call, out, make, progress, force=force)


def read_record(
    folder: Path, options: WalkOptions, sources: Sources = Sources()
) -> tuple[WalkRecord, list[str]]:
    """The key positions that the options take, and what is to be said of them."""
    given = [one for one in (sources.calibration, sources.boards, sources.cameras) if one]
    if len(given) > 1:
        raise InputError(
            given[1], "is one of two things that say where the cameras are",
            "Give one of --calibration, --calibrate and --cameras.",
        )  # fmt: skip
    if sources.cameras is not None:
        return read_photo_record(
            folder, sources.cameras, options.take, options.photo.largest_px
        ), []
    if sources.boards is None:
        return read_stereo_record(folder, options.take, sources.calibration), []
    found = calibrate_rig(sources.boards, options.board)
    rig = found.rig
    baseline_m = float(np.linalg.norm(rig.right_from_left[:, 3]))
    notes = [
        f"the rig was calibrated by {found.used} pairs of pictures of a board, whose corners are"
        f" {found.off_px:.2f} px off; the cameras are {baseline_m:.4f} m apart"
    ]
    if found.left_out:
        notes.append(f"pictures of the board that were left out: {', '.join(found.left_out)}")
    return read_stereo_record(folder, options.take, rig, found.files), notes


def _make(work: Work, record: WalkRecord, options: WalkOptions) -> None:
    with work.step("walk") as step:
        found = _find(work, record, options)
        step.counts["key positions"] = len(found.stations)
        step.counts["views"] = sum(len(views) for views in record.keys)
        step.counts["transitions"] = len(found.ways)
    if len(found.stations) < 2:
        raise NotFoundError("a walk", "there is one key position", "Give pairs of at least two.")
    with work.step("level") as step:
        gains = _gains(found)
        step.counts["compared"] = sum(way.ratio is not None for way in found.ways)
        work.measure("exposure_range", float(gains.max() / gains.min()))
    with work.step("place") as step:
        step.counts["points"] = _write_place(work, record, found, gains, options)
    if options.play.video:
        with work.step("video") as step:
            step.counts["frames"] = _film(work, record, found, gains, options)
        work.file(FILM, "the walk as a film")
    tell_walk(work, found.stations, found.ends, found.ways, in_metres=record.in_metres)
    tell_marks(work, found.figures, found.stations, found.marked)


def _find(work: Work, record: WalkRecord, options: WalkOptions) -> Found:
    """All key positions and the transitions between them."""
    settings = _settings(options)
    links = _links(record, options.take.links)
    found = Found()
    before: LocalModel | None = None
    shapes: list[Screen] = []
    for number in range(len(record.keys)):
        work.progress("walk", number / len(record.keys))
        key = record.key(work, number)
        if before is not None:
            found.add(_way(work, before, key.model, record, settings, (number - 1, number)))
        shapes.append(key.model.screen)
        found.figures.append(_marked(found, key, record.keys[number][0].key))
        found.clouds.append(_cloud(key.model))
        before = key.model
    for ends in links:
        first, second = (record.key(work, number).model for number in ends)
        found.add(_way(work, first, second, record, settings, ends))
    worlds = worlds_of(len(shapes), record.first, found.ends, found.ways, _ahead(record.rig))
    names = [views[0].key for views in record.keys]
    found.stations = [Station(*one) for one in zip(names, shapes, worlds, strict=True)]
    if any(len(views) > 1 for views in record.keys):
        work.measure("largest_gap_share", max(one.gap for one in found.figures))
    off_px = float(np.fmax.reduce([one.rows_off_px for one in found.figures]))
    if not np.isnan(off_px):
        work.measure("largest_rows_off_px", off_px)
    return found


def _marked(found: Found, key: KeyModel, name: str) -> KeyFigures:
    """Its figures with the shares of water and grass; the view with most of them is kept."""
    marks = key.model.marks
    figures = replace(key.figures, water=float(marks.water.mean()), grass=float(marks.grass.mean()))
    share = figures.water + figures.grass
    if share > (0.0 if found.marked is None else found.marked[0]):
        shown = painted(key.model.image, ((marks.water, BLUE), (marks.grass, GREEN)))
        found.marked = (share, name, shown)
    return figures


def _links(record: WalkRecord, links: tuple[str, ...]) -> list[tuple[int, int]]:
    """The numbers of the key positions of FROM:TO; InputError where there are no such."""
    names = {views[0].key: number for number, views in enumerate(record.keys)}
    found = []
    for link in links:
        parted = [(link[:at], link[at + 1 :]) for at, sign in enumerate(link) if sign == ":"]
        ends = next(((a, b) for a, b in parted if a != b and a in names and b in names), None)
        if ends is None:
            raise InputError(
                link, "is no link of two key positions",
                f"Say FROM:TO with names as {next(iter(names))} and {next(reversed(names))}.",
            )  # fmt: skip
        found.append((names[ends[0]], names[ends[1]]))
    return found


def _gains(found: Found) -> Gains:
    """(k, 3) of each key position's picture."""
    compared = [
        Compared(*ends, way.ratio)
        for ends, way in zip(found.ends, found.ways, strict=True)
        if way.ratio is not None
    ]
    return level_gains(len(found.stations), compared)


def _picture(work: Work, record: WalkRecord, gains: Gains, number: int) -> Image:
    """What a key position shows, its exposure levelled."""
    return levelled(record.picture(work, number), gains[number])


def _write_place(
    work: Work, record: WalkRecord, found: Found, gains: Gains, options: WalkOptions
) -> int:
    """Pictures, models, the index and the document; how many points there are."""
    pictures = [picture_name(number) for number in range(len(found.stations))]
    for number, name in enumerate(pictures):
        image = _picture(work, record, gains, number)
        write_picture(work.folder / name, image, options.play.quality)
    made = _settings(options).mesh
    told = [
        _written(work.folder, number, ends, way, pictures, found.stations[ends[0]].screen, made)
        for number, (ends, way) in enumerate(zip(found.ends, found.ways, strict=True))
    ]
    place = Place(scale="metres" if record.in_metres else "unknown")
    place.walks.append(
        walk_of(
            "Walk",
            DOCUMENT,
            found.stations,
            pictures,
            [entry for entry, _ in told],
            options.play.speed_m_s,
        )
    )
    worlds = [one.world_from_camera for one in found.stations]
    points = np.concatenate(
        [own @ to[:3, :3].T + to[:3, 3] for (own, _), to in zip(found.clouds, worlds, strict=True)]
    )
    colours = np.concatenate([own for _, own in found.clouds])
    place.clouds.append(Cloud("points", points, colours))
    place.save(work.folder)
    document = document_of(
        record.rig, record.keys, found.figures, found.stations, gains, found.ends,
        found.ways, [models for _, models in told], in_metres=record.in_metres,
    )  # fmt: skip
    write_document(document, work.folder / DOCUMENT)
    return len(points)


def _film(work: Work, record: WalkRecord, found: Found, gains: Gains, options: WalkOptions) -> int:
    """The walk from end to end, as its front view sees it."""
    screen = Screen.of(record.rig)

    def frames() -> Iterator[Image]:
        for way, (start, end) in zip(found.ways, found.ends, strict=True):
            if end != start + 1:
                continue  # a link: the film goes along the path
            work.progress("video", start / len(found.stations))
            shown = [
                (_picture(work, record, gains, n), found.stations[n].screen) for n in (start, end)
            ]
            yield from frames_of(way, shown[0], shown[1], screen, options.play.speed_m_s)
        yield flat_picture(*shown[1], screen)

    return write_film(work.folder / FILM, frames(), screen)


def _settings(options: WalkOptions) -> WaySettings:
    morph = options.morph
    return WaySettings(
        FlowSettings(solver=morph.solver),
        MeshSettings(step_px=morph.step_px),
        JudgeLimits(gain_db=morph.least_gain_db),
    )


def _way(
    work: Work, first: LocalModel, second: LocalModel, record: WalkRecord, settings: WaySettings,
    ends: tuple[int, int],
) -> tuple[Way, tuple[int, int]]:  # fmt: skip
    """One transition and its ends, kept for a run that is killed later."""
    inputs = [file_digest(path) for number in ends for path in record.files_of(number)]
    options = work.options.model_dump(mode="json")
    given = record.pose(*ends)
    name = f"way-{first.key}-{second.key}"
    arrays = work.kept_arrays(
        name, [*inputs, repr(record.rig), options],
        lambda: arrays_of(find_way(first, second, record.rig, settings, given)),
    )  # fmt: skip
    return way_of(arrays), ends


def _ahead(rig: Rig) -> NDArray[np.float64]:
    """Where a key position is put that has nothing in common with the one before: ahead."""
    matrix = np.eye(4)
    matrix[2, 3] = 10.0 * rig.baseline_m
    return matrix


def _cloud(model: LocalModel) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """What stereo measured near a key position, as points in its camera's frame."""
    thin = (slice(None, None, CLOUD_STEP_PX), slice(None, None, CLOUD_STEP_PX))
    chosen = model.measured[thin] & (model.depth_m[thin] < min(CLOUD_FARTHEST_M, FARTHEST_M))
    return model.points[thin][chosen], model.image[thin][chosen]


def _written(
    folder: Path, number: int, ends: tuple[int, int], way: Way, pictures: list[str], screen: Screen,
    made: MeshSettings,
) -> tuple[WalkTransition, tuple[str, str] | None]:  # fmt: skip
    """The entry of the place, and the files of the models, which a fade has for a rebuild."""
    score = None if way.verdict is None else way.verdict.score_db
    start, end = ends
    models = None
    if way.forth is not None:
        models = write_way(folder, number, way, (pictures[start], pictures[end]), screen, made)
    if way.kind != "morph" or models is None:
        return WalkTransition(start=start, end=end, kind=way.kind, score_db=score), models
    entry = WalkTransition(
        start=start, end=end, kind="morph", forth=models[0], back=models[1], score_db=score
    )
    return entry, models
