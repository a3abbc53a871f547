"""Some lots of a call, derived and written together: what one process does at a time."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from veduta import _core
from veduta.formats.cityjson_text import CLASSES, KINDS, Tint, feature_line, forms_of
from veduta.formats.tiles import Tile
from veduta.grammar.building import Building, NothingBuiltError, build
from veduta.grammar.deriving import Deriver, attributes_of, deriver, rings_of
from veduta.grammar.edge_values import without_edges
from veduta.grammar.failures import Failures
from veduta.grammar.levels import FULL, PANELS, PLAIN, VOLUME
from veduta.grammar.lot import Lot
from veduta.grammar.on_earth import OnEarth
from veduta.grammar.options import GrammarOptions
from veduta.grammar.project import SearchPath
from veduta.grammar.quadtree import squares
from veduta.grammar.reported import FILE, Values, as_attributes, as_json, sums_of, table, values_of
from veduta.grammar.textures import read_textures, with_builtin
from veduta.grammar.tile_pictures import picture_file, tile_pictures
from veduta.grammar.town import Built, Town, built_of, prisms
from veduta.place.part import Part
from veduta.place.place import ModelFile, Place
from veduta.run.atomic import sync_file, write_bytes
from veduta.run.outputs import writing_to
from veduta.run.report import Failure, StepRecord, timed_step

LEAF_LOTS = 32
"""Lots of a tile that is seen from near."""
NODE_LOTS = 256
"""Lots of a tile of volumes."""
MEMORY = 400 * 1024**2
"""Bytes that a block is expected to need."""
MOST_RULES = 200
"""Rules whose surfaces that are left out are counted."""
MOST_MISSING = 1000
"""Assets with computed names of which it is said that they are missing."""
NOTHING = "the rules leave nothing on it"


@dataclass(frozen=True)
class Block:
    """Lots whose files go to one folder; `name` is its path in OUT. origin_m: of its tiles.

    beside: the lots that stand beside each, by its id, also those of other blocks, where the rules
    ask about them.
    """

    name: str
    lots: tuple[Lot, ...]
    origin_m: tuple[float, float, float]
    beside: Mapping[str, tuple[Lot, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class Job:
    """A block to work on; `files` are the rule files, `source` is what failures name.

    search: where what the rules name lies. textures: the files of the pictures
    that the rules name, by those names. separate: whether each building gets a GLB of its own.
    city: the file for the buildings as lines of CityJSON, None where they are not wanted.
    earth: where the lots lie, where the rules ask that.
    """

    block: Block
    files: tuple[tuple[str, str], ...]
    options: GrammarOptions
    source: str
    search: SearchPath
    out: Path
    work: Path
    separate: bool
    city: Path | None
    textures: Mapping[str, str] = field(default_factory=dict)
    earth: OnEarth | None = None


@dataclass
class BlockResult:
    """What became of the lots: what was built together, a failure of each other."""

    town: Town
    tile: Tile | None = None
    rows: list[dict[str, Any]] = field(default_factory=list)
    reported: list[tuple[str, str, Values]] = field(default_factory=list)
    failures: Failures = field(default_factory=Failures)
    notes: Counter[str] = field(default_factory=Counter)
    missing: list[str] = field(default_factory=list)
    forms: Counter[str] = field(default_factory=Counter)
    tinted: set[tuple[str, Tint]] = field(default_factory=set)
    steps: list[StepRecord] = field(default_factory=list)

    def summary(self, name: str) -> dict[str, Any]:
        """For the run's record: all that the place and the report need."""
        town = self.town
        front = _front(town.built)
        return {
            "built": len(town.built),
            "polygons": town.polygons,
            "triangles": town.triangles,
            "classes": {kind: count for kind, count in sorted(town.classes.items()) if count},
            "dropped": dict(town.dropped.most_common(MOST_RULES)),
            "pictures": sorted(town.shown),
            "tinted": [[name, list(tint)] for name, tint in sorted(self.tinted)],
            "notes": dict(self.notes.most_common(50)),
            "missing": self.missing,
            "forms": dict(sorted(self.forms.items())),
            "tabled": any(values for _, _, values in self.reported),
            "reports": as_json(sums_of(values for _, _, values in self.reported)),
            "front": front and _bounds_row(front),
            "box": self.tile and [list(corner) for corner in self.tile.box],
            "leaves": [
                [f"{name}/tiles/{content}", count, [list(corner) for corner in box]]
                for content, count, box in town.leaves
            ],
            "lots": self.rows,
            "failures": [failure.model_dump() for failure in self.failures],
            **({"untold": self.failures.untold} if self.failures.untold else {}),
            "steps": [asdict(step) for step in self.steps],
        }


def run_block(job: Job) -> dict[str, Any]:
    """Derive each lot and write its tiles, its model and its line of CityJSON; the summary."""
    by = deriver(job.files, job.search, job.options, job.block.beside, job.earth)
    folder = job.work / "tiles"
    with writing_to(job.out):
        folder.mkdir(parents=True, exist_ok=True)
        if job.city is not None:
            job.city.parent.mkdir(parents=True, exist_ok=True)
            _growing(job.city).write_bytes(b"")
    result = BlockResult(Town(folder, tile_pictures(with_builtin(job.textures))))
    middles = np.array([_middle(lot) for lot in job.block.lots])
    for number, node in enumerate(squares(middles, NODE_LOTS)):
        _node(job, by, f"{number:02d}", [job.block.lots[row] for row in node], result)
    reported = table(result.reported)
    result.notes.update(dict.fromkeys(by.library.notes(), 1))
    result.missing = by.library.computed_missing(by.rules)[:MOST_MISSING]
    if beyond := len(by.library.pictures.keys() - job.textures.keys()):
        result.notes[f"{beyond} pictures of assets are shown by their mean colours"] = 1
    with timed_step(result.steps, "write"), writing_to(job.out):
        result.tile = result.town.finish()
        if reported is not None:
            write_bytes(job.work / FILE, reported)
        if job.city is not None:
            sync_file(_growing(job.city))
            os.replace(_growing(job.city), job.city)
    return result.summary(job.block.name)


def _growing(path: Path) -> Path:
    """Where lines of CityJSON are before all of the block are there."""
    return path.with_suffix(".part")


def _middle(lot: Lot) -> tuple[float, float]:
    x, y = lot.rings_m[0].mean(axis=0).tolist()
    return x + lot.anchor_m[0], y + lot.anchor_m[1]


def _node(
    job: Job,
    by: Deriver,
    name: str,
    lots: Sequence[Lot],
    result: BlockResult,
) -> None:
    """The tiles of neighbours: near levels of a few at a time, volumes of all."""
    begin = len(result.town.built)
    tiles = []
    middles = np.array([_middle(lot) for lot in lots])
    for number, leaf in enumerate(squares(middles, LEAF_LOTS)):
        tile = _leaf(job, by, f"{name}-{number:02d}", [lots[r] for r in leaf], result)
        tiles += [tile] if tile else []
    built = result.town.built[begin:]
    if not built:
        return
    with timed_step(result.steps, "derive"):
        if by.levels.marked:
            volumes = by.together([one.lot for one in built], VOLUME)
        else:
            volumes = prisms(built, [rings_of(one.lot) for one in built])
    with timed_step(result.steps, "write"), writing_to(job.out):
        result.town.node(name, built, (volumes, list(range(len(built)))), tiles)


def _leaf(
    job: Job,
    by: Deriver,
    name: str,
    lots: Sequence[Lot],
    result: BlockResult,
) -> Tile | None:
    """The near levels of some lots, with their models and lines of CityJSON."""
    sound = _sound(job, by, lots, result)
    with timed_step(result.steps, "derive"):
        full = by.together(sound, FULL)
        plain = by.together(sound, PLAIN) if by.levels.plain else None
        is_solid = job.city is not None and by.levels.marked
        panels = by.together(sound, PANELS) if is_solid else None
        volumes = by.together(sound, VOLUME) if is_solid else None
    rows, built = [], []
    reported: dict[str, Values] = {}
    for row, lot in enumerate(sound):
        fault = by.fault(full, row, lot)
        one = None if fault else built_of(full, row, lot, job.block.origin_m, result.town.pictures)
        if one is None:
            _fail(job, lot, fault or NOTHING, result)
            continue
        result.notes.update(dict.fromkeys(full.messages(row)[:20], 1))
        reported[lot.id] = values_of(full.reports(row))
        rows.append(row)
        built.append(one)
    with timed_step(result.steps, "write"), writing_to(job.out):
        if job.city is not None:
            levels = [panels, full] if panels else [full]
            with _growing(job.city).open("a", encoding="utf-8", newline="\n") as lines:
                lines.writelines(_city(levels, volumes, rows, built, reported, result))
        tile = result.town.leaf(name, built, (full, rows), (plain, rows) if plain else None)
    if job.separate:
        built = _models(job, by, built, (full, rows), result)
    result.reported += [(one.lot.id, one.lot.name, reported[one.lot.id]) for one in built]
    result.town.built += built
    result.town.polygons += sum(one.polygons for one in built)
    return tile


def _fail(job: Job, lot: Lot, reason: str, result: BlockResult) -> None:
    subject = f"{job.source}: {lot.name}"
    result.failures.add(Failure(subject=subject, kind="input", reason=reason))


def _sound(job: Job, by: Deriver, lots: Sequence[Lot], result: BlockResult) -> list[Lot]:
    """The lots whose attributes the rules take."""
    kinds = dict(by.rules.attributes)
    sound = []
    for lot in lots:
        given = attributes_of(lot, kinds, job.options)
        if isinstance(given, str):
            _fail(job, lot, given, result)
        else:
            sound.append(lot)
    return sound


def _city(
    levels: Sequence[_core.DerivedLots],
    volumes: _core.DerivedLots | None,
    rows: Sequence[int],
    built: Sequence[Built],
    reported: Mapping[str, Values],
    result: BlockResult,
) -> Iterator[str]:
    """The lines of the buildings, of the first level that has something of each.

    With `volumes`, the lots at their lowest level, closed volumes stand beside it; not of lots with
    edits, which have but one level.
    """
    pictures = result.town.pictures
    named = [picture.named for picture in pictures]

    def image(number: int, tint: Tint) -> str:
        result.tinted.add((pictures[number].name, tint))
        return picture_file(pictures[number].name, tint)

    for row, one in zip(rows, built, strict=True):
        derived = next(level for level in levels if level.extent(row) is not None)
        closed = None if one.lot.edits else volumes
        geometry = derived.city(row, one.lot.anchor_m, CLASSES, KINDS, named, closed)
        about = without_edges(one.lot.attributes) | {"name": one.lot.name, "provenance": "invented"}
        about |= as_attributes(reported[one.lot.id], about)
        line = feature_line(one.lot.id, about, geometry, image)
        if line:
            yield f"{line}\n"
        result.forms.update(forms_of(geometry))


def _models(
    job: Job,
    by: Deriver,
    built: Sequence[Built],
    derived: tuple[_core.DerivedLots, Sequence[int]],
    result: BlockResult,
) -> list[Built]:
    """A GLB of each building; those that give one. derived: with the row of each building."""
    lots, rows = derived
    made = []
    textures = read_textures(job.textures)
    with timed_step(result.steps, "write"):
        for one, row in zip(built, rows, strict=True):
            columns = lots.columns(row)
            try:
                building = build(columns, one.lot.id, by.library.assets_of(columns), textures)
            except NothingBuiltError as fault:
                _fail(job, one.lot, str(fault), result)
                continue
            with writing_to(job.out):
                model = ModelFile(f"{one.lot.id}.glb")
                Place().add(building.part, file=model).save(job.work)
            result.rows.append(_summary(one.lot, building, job.block.name))
            made.append(one)
    return made


def _front(built: Sequence[Built]) -> Built | None:
    """The building in the middle of the southern edge."""
    if not built:
        return None
    x = np.array([one.place_m[0] + (one.low[0] + one.high[0]) / 2 for one in built])
    y = np.array([one.place_m[1] + one.low[1] for one in built])
    middle = (x.min() + x.max()) / 2
    return built[int(np.argmin(np.abs(x - middle) + (y - y.min())))]


def _bounds_row(one: Built) -> dict[str, Any]:
    return {"anchor_m": list(one.lot.anchor_m), "bounds": [list(one.low), list(one.high)]}


def _summary(lot: Lot, building: Building, folder: str) -> dict[str, Any]:
    part = building.part
    low, high = part.bounds_m
    classes = part.features.class_code
    return {
        "id": lot.id,
        "name": lot.name,
        "model": f"{folder}/{lot.id}.glb",
        "anchor_m": list(lot.anchor_m),
        "bounds": [list(low), list(high)],
        "polygons": len(part.polygon_feature),
        "triangles": len(part.triangles.indices) + _triangles_of_assets(part),
        "classes": {
            part.features.semantic(row).value: int((classes == classes[row]).sum())
            for row in sorted({int((classes == code).argmax()) for code in set(classes.tolist())})
        },
        "notes": list(building.said),
        "left_out": {one.rule: one.count for one in building.left_out},
    }


def _triangles_of_assets(part: Part) -> int:
    return 0 if part.instances is None else part.instances.triangle_count
