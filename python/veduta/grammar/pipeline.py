"""The recipe of `veduta grammar derive`: rules and lots to buildings, and to one place."""

from __future__ import annotations

import contextlib
import hashlib
import json
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import JsonValue

from veduta.formats.cityjson_joined import write_joined
from veduta.formats.cityjson_text import header, write_sequence
from veduta.formats.tiles import write_tileset
from veduta.grammar.assets.library import Library
from veduta.grammar.block import MEMORY, Job, run_block
from veduta.grammar.demo import DEMO_LOTS, demo_lots
from veduta.grammar.edits import read_edits
from veduta.grammar.failures import Failures
from veduta.grammar.given import check_options
from veduta.grammar.ground import is_level
from veduta.grammar.joining import tables, write_ground, write_ground_city, write_pictures
from veduta.grammar.kerbs import NAME as STREETS
from veduta.grammar.kerbs import streets_of, with_streets
from veduta.grammar.left_out import told_of_all
from veduta.grammar.lot import anchors_of
from veduta.grammar.lots import Lots, edited_lots, read_lots, require_lots
from veduta.grammar.on_earth import OnEarth, on_earth
from veduta.grammar.options import GrammarOptions
from veduta.grammar.otherwise import otherwise, told_computed, unreached
from veduta.grammar.placing import place_of, placed_how, town_of
from veduta.grammar.project import SearchPath
from veduta.grammar.project_files import project_files
from veduta.grammar.report import Whole, derive_report
from veduta.grammar.reported import FILE as REPORTS
from veduta.grammar.reported import write_joined as write_reports
from veduta.grammar.rules import compile_rules, find_rules, read_rules, with_start
from veduta.grammar.squares import FEW, Square, Squares, squares_of, told
from veduta.grammar.textures import find_textures, read_textures, textures_digests
from veduta.place.place import Standing as PartStanding
from veduta.run.atomic import same_file
from veduta.run.digests import result_key
from veduta.run.errors import InputError
from veduta.run.names import given_name
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.pool import Task, run_tasks
from veduta.run.progress import Progress
from veduta.run.record import CALL, PRIVATE
from veduta.run.report import Failure, StepRecord, timed_step

VERSION = "21"
COMMAND = "grammar derive"
MOST_SEPARATE = 100_000
"""Lots whose buildings may get a file each."""
SHOWN_WHOLE = 8
"""Up to so many lots are shown by their own models; more by tiles, which share meshes and pictures:
60 lots are 1.2 MB then and not 46, and 15 draws a frame and not 1,759."""
SEQUENCE = 1000
"""More lots than these are CityJSONSeq, which is read a line at a time."""
TILESET = "tileset.json"
CITY = f"{PRIVATE}/city"
"""Where lines of CityJSON wait for those of the other blocks."""
GROUND_CITY = f"{CITY}/ground.jsonl"
LASTING = {"input"}
"""Failures that the same input would give again; others are tried anew by the next run."""


@dataclass
class DeriveResult:
    """What the call came to; `built` is what was built."""

    out: Path
    total: int = 0
    up_to_date: bool = False
    built: Whole = field(default_factory=Whole)
    failures: Failures = field(default_factory=Failures)
    notes: list[str] = field(default_factory=list)
    steps: list[StepRecord] = field(default_factory=list)
    edited: list[str] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)
    tracebacks: dict[str, str] = field(default_factory=dict)

    @property
    def exit_code(self) -> int:
        """0 done, 1 a bug, 2 no lot could be built, 3 some could not."""
        kinds = self.failures.kinds
        if "bug" in kinds:
            return 1
        if kinds == {"input"} and not self.built.count:
            return 2
        return 3 if kinds else 0


def run_derive(
    rules_name: str,
    lots_path: Path | None,
    out: Path,
    options: GrammarOptions,
    progress: Progress,
    *,
    edits_path: Path | None = None,
    project: Path | None = None,
    libraries: Sequence[Path] = (),
    force: bool = False,
    jobs: int | None = None,
) -> DeriveResult:
    """Build every lot in OUT, by the rules of `run.outputs`.

    project, libraries: as `rules.read_rules` has them.
    """
    steps: list[StepRecord] = []
    with timed_step(steps, "read"):
        call = _call(
            rules_name, lots_path, edits_path, options, _room_for(out), progress, project, libraries
        )
    lots = call.lots
    with contextlib.closing(lots), open_out(out, COMMAND, call.key, force=force) as folder:
        result = DeriveResult(out, len(lots.lots) + len(lots.failures), steps=steps)
        result.up_to_date = folder.standing is Standing.UP_TO_DATE
        if result.up_to_date:
            shutil.rmtree(out / CITY, ignore_errors=True)
        waiting = [] if result.up_to_date else _waiting(call, folder)
        with timed_step(steps, "build"):
            _process(call, waiting, folder, result, progress, jobs)
        _collect(folder, call, result)
        if not result.up_to_date:
            _write_call(folder, call, result)
        result.edited = folder.edited()
        result.foreign = sorted(set(folder.kept) - set(folder.record.files))
    return result


def _room_for(out: Path) -> Path:
    """The folder that is there, nearest to OUT: lots that memory does not hold lie on its disk."""
    return next(folder for folder in (out, *out.absolute().parents) if folder.is_dir())


@dataclass(frozen=True)
class _Call:
    """What a call is given, read and checked, and the keys of what is to be made of it.

    source: what failures name. search: where what the rules name lies. told: what is built
    otherwise than the rules say, and which assets and pictures are missing, in words. keys: of the
    blocks. key: of all.
    """

    rules_name: str
    source: str
    search: SearchPath
    files: tuple[tuple[str, str], ...]
    options: GrammarOptions
    textures: Mapping[str, str]
    told: tuple[str, ...]
    lots: Lots
    squares: Squares
    keys: dict[str, str]
    key: str
    earth: OnEarth | None

    def job(self, square: Square, folder: OutFolder) -> Job:
        """The work on a block, with its lots."""
        return Job(
            self.squares.block(square),
            self.files,
            self.options,
            self.source,
            self.search,
            folder.path,
            folder.work_path(square.name),
            is_separate(self.options, self.lots),
            _city_path(folder.path, square) if self.options.output.city else None,
            self.textures,
            self.earth,
        )


def _call(
    rules_name: str,
    lots_path: Path | None,
    edits_path: Path | None,
    options: GrammarOptions,
    room: Path,
    progress: Progress,
    project: Path | None,
    libraries: Sequence[Path],
) -> _Call:
    """Read and check all that is given; InputError names what is wrong.

    room: the folder that large lots may lie in.
    """
    rules = read_rules(find_rules(rules_name), project, libraries)
    rules, start = with_start(rules, options.derive.start)
    options = options.starting_with(start)
    compiled = compile_rules(rules, options.derive.style, start)
    options = check_options(compiled, rules.path, options)
    library = Library(rules.search)
    assets = library.digest(compiled)
    files = tuple(rules.texts)
    asked = project_files(rules.search, compiled)
    textures = find_textures(rules.path, [text for _, text in files], rules.search, asked.names)
    read_textures(textures)
    own, notes = library.textures(compiled)
    textures |= own
    edits = {} if edits_path is None else read_edits(edits_path)
    lots = _lots(lots_path, options, room, progress)
    if edits_path is not None:
        lots = edited_lots(lots, edits_path, edits)
    if options.output.separate and len(lots.lots) > MOST_SEPARATE:
        told_of = f"is for up to {MOST_SEPARATE:,} lots, and here are {len(lots.lots):,}"
        raise InputError("--separate", told_of, "Leave it out: tiles have all buildings.")
    squares = squares_of(lots.lots, ask_beside=compiled.asks_beside)
    source = rules_name if lots_path is None else given_name(lots_path)
    made_of: list[JsonValue] = [files_digest(files), assets, textures_digests(textures)]
    made_of += [asked.digest()] if asked.names else []
    earth = on_earth(lots.crs, lots.origin_m) if compiled.asks_place else None
    made_of += [earth.crs, list(earth.origin_m)] if earth else []
    keys = {
        square.name: _key("block", options, [*made_of, told(squares.block(square))])
        for square in squares.every
    }
    origin: JsonValue = [lots.crs, list(lots.origin_m)]
    failed: JsonValue = lots.failures.told()
    key = _key("call", options, [dict(keys), origin, failed, source])
    return _Call(
        rules_name,
        source,
        rules.search,
        files,
        options,
        textures,
        (*otherwise(rules, compiled), *unreached(compiled), *notes),
        lots,
        squares,
        keys,
        key,
        earth,
    )


def _waiting(call: _Call, folder: OutFolder) -> list[Square]:
    """The blocks that are not there, or whose lines of CityJSON are wanted and are not there."""
    needs_lines = call.options.output.city and not _has_city(folder, call)
    return [
        square
        for square in call.squares.every
        if not folder.is_current(square.name, call.keys[square.name])
        or (needs_lines and not _city_path(folder.path, square).exists())
    ]


def _lots(path: Path | None, options: GrammarOptions, room: Path, progress: Progress) -> Lots:
    require_lots(path, options.lots)
    if path is None:
        return demo_lots(DEMO_LOTS, options.derive.seed)
    return read_lots(path, options.lots, room, progress.said)


def is_separate(options: GrammarOptions, lots: Lots) -> bool:
    """Whether each building gets a file of its own."""
    return options.output.separate or len(lots.lots) <= FEW


def is_streamed(options: GrammarOptions, lots: Lots) -> bool:
    """Whether the place is shown by its tiles."""
    return not is_separate(options, lots) or len(lots.lots) > SHOWN_WHOLE


def _city_path(out: Path, block: Square) -> Path:
    """A block's lines of CityJSON, until all are there."""
    return out / CITY / f"{block.name.rpartition('/')[2]}.jsonl"


def _city_name(lots: Lots) -> str:
    return "city.city.jsonl" if len(lots.lots) > SEQUENCE else "city.city.json"


def _has_city(folder: OutFolder, call: _Call) -> bool:
    """Whether the CityJSON of this very call is there: its lines need not be made again."""
    return folder.is_done(CALL, call.key) and (folder.path / _city_name(call.lots)).exists()


def files_digest(files: Sequence[tuple[str, str]]) -> str:
    """The digest of all rule files and their names."""
    told = [(given_name(name), text) for name, text in files]
    return hashlib.sha256(json.dumps(told).encode()).hexdigest()


def _key(step: str, options: GrammarOptions, inputs: JsonValue) -> str:
    return result_key(f"{COMMAND} {step}", VERSION, options, inputs)


def _process(
    call: _Call,
    waiting: Sequence[Square],
    folder: OutFolder,
    result: DeriveResult,
    progress: Progress,
    jobs: int | None,
) -> None:
    """Work on the blocks, and publish each as soon as it is done."""

    def made(square: Square) -> Job:
        folder.work_folder(square.name)
        return call.job(square, folder)

    tasks = [Task(square.name, square, MEMORY) for square in waiting]
    run = run_tasks(run_block, tasks, jobs=jobs, started=progress.started, made=made)
    with progress.over(len(tasks)), contextlib.closing(run) as outcomes:
        for outcome in outcomes:
            if outcome.error is not None:
                raise outcome.error
            name = outcome.task.name
            if outcome.value is None:
                if outcome.traceback is not None:
                    result.tracebacks[name] = outcome.traceback
                failure = outcome.failure(name)
                result.failures.add(failure)
                folder.forget(name)
            else:
                failure = None
                folder.publish(name, call.keys[name], folder.work_path(name), outcome.value)
            progress.finished(name, failure)


def _collect(folder: OutFolder, call: _Call, result: DeriveResult) -> None:
    """What the place consists of, in the order of the lots."""
    result.failures.add_all(call.lots.failures, call.lots.failures.untold)
    result.notes += call.lots.notes
    result.notes += call.told
    for square in call.squares.every:
        item = folder.record.items.get(square.name)
        if item is None:
            continue
        summary: dict[str, Any] = dict(item.summary)
        result.built.add(square.name, summary | {"origin_m": square.origin_m})
        named = [Failure.model_validate(failure) for failure in summary["failures"]]
        result.failures.add_all(named, summary.get("untold", 0))
        for step in summary["steps"]:
            _add_step(result.steps, StepRecord(**step))
    whole = result.built
    result.notes += told_computed(whole.missing)
    lost = (row["left_out"] for row in whole.rows)
    result.notes += told_of_all(lost, whole.dropped, call.files)
    names = {square.name for square in call.squares.every}
    files = [path for path in folder.record.files if path.startswith("parts/")]
    # What lies in `parts` itself, as the streets do, is of this call.
    folders = {"/".join(path.split("/")[:2]) for path in files if path.count("/") > 1}
    result.notes += [f"{name}/ is left from an earlier call" for name in sorted(folders - names)]


def _add_step(steps: list[StepRecord], step: StepRecord) -> None:
    """Times of the same step in several blocks add up; they ran beside each other."""
    for known in steps:
        if known.name == step.name:
            steps[steps.index(known)] = replace(known, seconds=known.seconds + step.seconds)
            return
    steps.append(step)


def _write_call(folder: OutFolder, call: _Call, result: DeriveResult) -> None:
    """The place of all that is done, and the report of the call."""
    whole, lots, options = result.built, call.lots, call.options
    work = folder.work_folder(CALL)
    result.notes.append(placed_how(lots, call.squares.every))
    if not is_level(anchors_of(lots.lots)):
        result.notes.append("the ground between the lots is invented, from their heights")
    result.notes += [f"{name} was edited and is left as it is" for name in folder.edited()]
    report, page = derive_report(
        call.rules_name, options, whole, result.failures, result.notes, result.steps
    )
    with writing_to(folder.path):
        if whole.count:
            with timed_step(result.steps, "join"):
                _write_town(folder, call, work, whole)
                write_pictures(work, call.textures, whole)
                write_reports(work / REPORTS, tables(folder.path, whole))
        (work / "report.json").write_bytes(report.to_json())
        (work / "report.html").write_bytes(page)
    folder.publish(CALL, call.key, work)
    if result.failures.kinds <= LASTING:
        shutil.rmtree(folder.path / CITY, ignore_errors=True)
        folder.finish()


def _write_town(folder: OutFolder, call: _Call, work: Path, whole: Whole) -> None:
    """The files that hold all blocks together."""
    lots, squares = call.lots, call.squares.every
    streamed = is_streamed(call.options, lots)
    done = {name for name, _ in whole.blocks}
    separate = is_separate(call.options, lots)
    grounds = write_ground(work, call.squares, done, separate=separate)
    town = town_of(lots, squares, whole, grounds)
    streets = streets_of(lots.lots, lots.roads)
    if streets is not None:
        town = with_streets(town, streets, work)
    write_tileset(town, work / TILESET)
    tileset = TILESET if streamed else None
    place = place_of(lots, whole, grounds, folder.path, tileset=tileset)
    if streets is not None:
        place.add(streets, PartStanding(name=STREETS, arrangement="invented", ground=True))
    place.save(work)
    if not call.options.output.city:
        return
    pieces = [_city_path(folder.path, one) for one in squares if one.name in done]
    name = _city_name(lots)
    if _has_city(folder, call) and not all(piece.exists() for piece in pieces):
        same_file(folder.path / name, work / name)
        return
    first = header(Path(call.rules_name).stem, lots.crs, lots.origin_m)
    write = write_sequence if len(lots.lots) > SEQUENCE else write_joined
    if grounds:
        write_ground_city(folder.path / GROUND_CITY, grounds)
        pieces.append(folder.path / GROUND_CITY)
    write(work / name, first, pieces)
