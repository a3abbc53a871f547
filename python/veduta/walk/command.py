"""`veduta walk`: from a folder of stereo views to a place that one walks through."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.place.manifest import WalkTransition
from veduta.place.place import Cloud, Place
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.page import Table
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work
from veduta.walk.build.film import frames_of, write_film
from veduta.walk.build.flow import FlowSettings
from veduta.walk.build.judge import JudgeLimits
from veduta.walk.build.local_model import FARTHEST_M, LocalModel, build_local_model
from veduta.walk.build.mesh import MeshSettings
from veduta.walk.build.place import Station, walk_of, world_from_first, write_picture, write_way
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import Way, WaySettings, find_way
from veduta.walk.build.way_file import arrays_of, way_of
from veduta.walk.document.load import DOCUMENT, write_document
from veduta.walk.document.schema import KeyRecord, RigRecord, TransitionRecord, WalkDocument
from veduta.walk.options import WalkOptions
from veduta.walk.read.calibration import find_calibration
from veduta.walk.read.check_rows import Rows, require_rows
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import Rectifier, make_rectifier, read_pair, read_stereo
from veduta.walk.rig import Image, PairFiles, Rig

VERSION = "1"
FILM = "walk.mp4"
CLOUD_STEP_PX = 6
CLOUD_FARTHEST_M = 60.0


@dataclass(frozen=True, eq=False)
class Record:
    """What was given: the pairs of the key positions in their order, and how they are rectified."""

    pairs: list[PairFiles]
    rectifier: Rectifier
    calibration: Path


def run_walk(
    folder: Path, out: Path, options: WalkOptions, progress: Progress, *,
    calibration: Path | None = None, force: bool = False,
) -> VerbResult:  # fmt: skip
    """Make the walk of a folder into OUT."""
    record = read_record(folder, options, calibration)
    files = [path for pair in record.pairs for path in (pair.left, pair.right)]
    inputs = [file_digest(path) for path in (record.calibration, *files)]
    call = VerbCall("walk", VERSION, folder.resolve().name, options, [*inputs])
    return run_verb(call, out, lambda work: _make(work, record, options), progress, force=force)


def read_record(folder: Path, options: WalkOptions, calibration: Path | None) -> Record:
    """The pairs that the options take; InputError where the folder is not right."""
    pairs = find_pairs(folder)
    take = options.take
    keys = list(dict.fromkeys(pair.key for pair in pairs))[take.first :: take.every][: take.count]
    chosen = [pair for pair in pairs if pair.key in set(keys)]
    if not chosen:
        raise InputError(folder, f"has no key position {take.first}", "Begin at an earlier one.")
    if len(chosen) > len(keys):
        raise InputError(
            folder, "has several views at a key position, which are not joined yet",
            "Leave one view of each key position.",
        )  # fmt: skip
    rig = find_calibration(folder, calibration, chosen[0].left.parent.name)
    left, _ = read_pair(chosen[0], None)
    return Record(chosen, make_rectifier(rig, (left.shape[1], left.shape[0])), rig.source)


def _make(work: Work, record: Record, options: WalkOptions) -> None:
    rig = record.rectifier.rig
    settings = _settings(options)
    place = Place()
    pictures: list[str] = []
    stations: list[Station] = []
    ways: list[Way] = []
    images: list[Image] = []
    clouds: list[tuple[NDArray[np.float64], NDArray[np.uint8]]] = []
    before: LocalModel | None = None
    world = world_from_first()
    with work.step("walk") as step:
        for number, files in enumerate(record.pairs):
            work.progress("walk", number / len(record.pairs))
            model = _model(work, files, record.rectifier, number)
            if before is not None:
                way = _way(
                    work, before, model, rig, settings, record.pairs[number - 1 : number + 1]
                )
                back = np.linalg.inv(np.vstack([way.second_from_first, [0.0, 0.0, 0.0, 1.0]]))
                world = world @ (back if way.forth is not None else _ahead(rig))
                ways.append(way)
            stations.append(Station(files.key, model.screen, world))
            pictures.append(write_picture(work.folder, number, model.image, options.play.quality))
            clouds.append(_cloud(model, world))
            if options.play.video:
                images.append(model.image)
            before = model
        step.counts["key positions"] = len(stations)
        step.counts["transitions"] = len(ways)
    if len(stations) < 2:
        raise NotFoundError("a walk", "there is one key position", "Give pairs of at least two.")
    with work.step("place") as step:
        told = [_written(work.folder, n, way, pictures) for n, way in enumerate(ways)]
        place.walks.append(
            walk_of("Walk", DOCUMENT, stations, pictures, told, options.play.speed_m_s)
        )
        points, colours = (np.concatenate(column) for column in zip(*clouds, strict=True))
        place.clouds.append(Cloud("points", points, colours))
        place.save(work.folder)
        write_document(_document(record, stations, ways), work.folder / DOCUMENT)
        step.counts["points"] = len(points)
    if options.play.video:
        with work.step("video") as step:
            step.counts["frames"] = _film(work, ways, images, stations[0].screen, options)
        work.file(FILM, "the walk as a film")
    _tell(work, record, stations, ways)


def _film(
    work: Work, ways: list[Way], images: list[Image], screen: Screen, options: WalkOptions
) -> int:
    def frames() -> Iterator[Image]:
        for number, way in enumerate(ways):
            work.progress("video", number / len(ways))
            first, second = images[number], images[number + 1]
            yield from frames_of(way, first, second, screen, options.play.speed_m_s)
        yield images[-1]

    return write_film(work.folder / FILM, frames(), screen)


def _settings(options: WalkOptions) -> WaySettings:
    morph = options.morph
    return WaySettings(
        FlowSettings(solver=morph.solver),
        MeshSettings(step_px=morph.step_px),
        JudgeLimits(gain_db=morph.least_gain_db),
    )


def _model(work: Work, files: PairFiles, rectifier: Rectifier, number: int) -> LocalModel:
    pair = read_stereo(files, rectifier)
    rows: Rows = require_rows(pair, rectifier.rig, files)
    if number == 0 and rows.matches == 0:
        work.doubt("the pictures have too little texture to check the calibration by them")
    return build_local_model(pair, rectifier.rig)


def _way(
    work: Work, first: LocalModel, second: LocalModel, rig: Rig, settings: WaySettings,
    files: list[PairFiles],
) -> Way:  # fmt: skip
    """One transition, kept for a run that is killed later."""
    inputs = [file_digest(path) for pair in files for path in (pair.left, pair.right)]
    options = work.options.model_dump(mode="json")
    name = f"way-{first.key}-{second.key}"
    arrays = work.kept_arrays(
        name, [*inputs, repr(rig), options],
        lambda: arrays_of(find_way(first, second, rig, settings)),
    )  # fmt: skip
    return way_of(arrays)


def _ahead(rig: Rig) -> NDArray[np.float64]:
    """Where a key position is put that has nothing in common with the one before: ahead."""
    matrix = np.eye(4)
    matrix[2, 3] = 10.0 * rig.baseline_m
    return matrix


def _cloud(
    model: LocalModel, world: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """What stereo measured near a key position, as points in the world."""
    thin = (slice(None, None, CLOUD_STEP_PX), slice(None, None, CLOUD_STEP_PX))
    chosen = model.measured[thin] & (model.depth_m[thin] < min(CLOUD_FARTHEST_M, FARTHEST_M))
    points = model.points[thin][chosen]
    return points @ world[:3, :3].T + world[:3, 3], model.image[thin][chosen]


def _written(folder: Path, number: int, way: Way, pictures: list[str]) -> WalkTransition:
    score = None if way.verdict is None else way.verdict.score_db
    if way.kind != "morph":
        return WalkTransition(start=number, end=number + 1, kind=way.kind, score_db=score)
    forth, back = write_way(folder, number, way, (pictures[number], pictures[number + 1]))
    return WalkTransition(
        start=number, end=number + 1, kind="morph", forth=forth, back=back, score_db=score
    )


def _document(record: Record, stations: list[Station], ways: list[Way]) -> WalkDocument:
    rig = record.rectifier.rig
    keys = [
        KeyRecord(
            id=one.id, left=files.left.name, right=files.right.name,
            transform=tuple(one.world_from_camera.T.ravel().tolist()),
        )
        for one, files in zip(stations, record.pairs, strict=True)
    ]  # fmt: skip
    return WalkDocument(
        rig=RigRecord(
            width_px=rig.width_px, height_px=rig.height_px, focal_px=rig.focal_px,
            centre_px=rig.centre_px, baseline_m=rig.baseline_m,
            centre_right_px=rig.centre_px[0] - rig.shift_px,
        ),
        keys=keys,
        transitions=[
            _transition(way, stations[n].id, stations[n + 1].id) for n, way in enumerate(ways)
        ],
    )  # fmt: skip


def _transition(way: Way, start: str, end: str) -> TransitionRecord:
    verdict = way.verdict
    energies = way.energies or (None, None, None)
    return TransitionRecord(
        start=start, end=end, kind=way.kind, why=way.why, matches=way.matches,
        distance_m=None if verdict is None else way.distance_m,
        residual_px=way.residual_px, psi=None if verdict is None else verdict.psi,
        score_db=None if verdict is None else verdict.score_db,
        unmoved_db=None if verdict is None else verdict.unmoved_db,
        energy=energies[0], energy_icm=energies[1], energy_bound=energies[2],
    )  # fmt: skip


def _tell(work: Work, record: Record, stations: list[Station], ways: list[Way]) -> None:
    """The report: measures, a table of the transitions, and what is doubtful."""
    kinds = [way.kind for way in ways]
    steps = [way.distance_m for way in ways if way.forth]
    work.measure("key_positions", len(stations))
    work.measure("length_m", sum(steps))
    for kind in ("morph", "fade", "cut"):
        work.measure(f"transitions_{kind}", kinds.count(kind))
    rows = []
    for number, way in enumerate(ways):
        names = f"{stations[number].id} to {stations[number + 1].id}"
        verdict = way.verdict
        if way.why:
            work.doubt(f"{names}: {'a cut' if way.kind == 'cut' else 'cross-faded'}: {way.why}")
        if way.predicted is not None and way.kind != "morph":
            work.picture(
                names, f"the view of {stations[number + 1].id} as predicted", way.predicted
            )
        rows.append(
            [
                names, way.kind,
                None if verdict is None else round(way.distance_m, 2),
                None if verdict is None else f"{verdict.psi:.0%}",
                None if verdict is None else round(verdict.score_db, 1),
                None if verdict is None else round(verdict.unmoved_db, 1),
                None if way.energies is None else round(way.energies[0]),
                None if way.energies is None else round(way.energies[1]),
                None if way.energies is None else round(way.energies[2]),
            ]
        )  # fmt: skip
    columns = [
        "from, to",
        "kind",
        "m",
        "Psi",
        "predicted dB",
        "unmoved dB",
        "energy",
        "by ICM",
        "bound",
    ]
    note = (
        "Psi: share of the picture in which the two views were found to show the same. Predicted"
        " and unmoved: how near the next view is to its prediction, and to the view before it as it"
        " is (PSNR). Energy: of the labels that say what goes where, beside what a simpler search"
        " (ICM) finds, and the least that there can be."
    )
    work.table(Table("Transitions", columns, rows, note=note))
    best = max(
        (way for way in ways if way.predicted is not None),
        key=lambda way: way.verdict.score_db if way.verdict else 0.0,
        default=None,
    )
    if best is not None and best.predicted is not None:
        work.picture(
            "The next view, predicted",
            "from the colours of the one before it alone: dark is what that one did not see, which"
            " the walk takes from the other view",
            best.predicted,
        )
    work.file("walk.json", "the key positions and transitions, each with its score")
    work.file("place.json", "the place that `veduta view` shows")
    work.summary = (
        f"{len(stations)} key positions, {sum(steps):.1f} m: {kinds.count('morph')} transitions"
        f" morph, {kinds.count('fade')} cross-fade, {kinds.count('cut')} are cut"
    )
