"""Some lots of a call, derived and written together: what one process does at a time."""

from __future__ import annotations

import functools
import hashlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from veduta import _core
from veduta.formats.cityjson_text import CLASSES, KINDS, feature_line
from veduta.formats.gltf import write_glb
from veduta.formats.tiles import Tile
from veduta.grammar.building import NothingBuiltError, build_part
from veduta.grammar.levels import FULL, PLAIN, VOLUME, Levels, levels_of
from veduta.grammar.lots import Lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.quadtree import squares
from veduta.grammar.town import Built, Town, built_of, prisms
from veduta.place.part import Part
from veduta.run.atomic import write_bytes
from veduta.run.outputs import writing_to
from veduta.run.report import Failure, StepRecord, timed_step

LEAF_LOTS = 32
"""Lots of a tile that is seen from near."""
NODE_LOTS = 256
"""Lots of a tile of volumes."""
MAX_SHAPES = 500_000
"""Of one lot's tree; it bounds memory to some hundred megabytes."""
MEMORY = 400 * 1024**2
"""Bytes that a block is expected to need."""
NOTHING = "the rules leave nothing on it"


@dataclass(frozen=True)
class Block:
    """Lots whose files go to one folder; `name` is its path in OUT. origin_m: of its tiles."""

    name: str
    lots: tuple[Lot, ...]
    origin_m: tuple[float, float, float]


@dataclass(frozen=True)
class Job:
    """A block to work on; `files` are the rule files, `source` is what failures name.

    separate: whether each building gets a GLB of its own. city: the file for the buildings as
    lines of CityJSON, None where they are not wanted. origin_m: of the place.
    """

    block: Block
    files: tuple[tuple[str, str], ...]
    options: GrammarOptions
    source: str
    out: Path
    work: Path
    separate: bool
    city: Path | None


@dataclass
class BlockResult:
    """What became of the lots: what was built together, a failure of each other."""

    town: Town
    tile: Tile | None = None
    rows: list[dict[str, Any]] = field(default_factory=list)
    city: list[str] = field(default_factory=list)
    failures: list[Failure] = field(default_factory=list)
    notes: Counter[str] = field(default_factory=Counter)
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
            "dropped": town.dropped,
            "notes": dict(self.notes.most_common(50)),
            "front": front and _bounds_row(front),
            "box": self.tile and [list(corner) for corner in self.tile.box],
            "leaves": [
                [f"{name}/tiles/{content}", count, [list(corner) for corner in box]]
                for content, count, box in town.leaves
            ],
            "lots": self.rows,
            "failures": [failure.model_dump() for failure in self.failures],
            "steps": [asdict(step) for step in self.steps],
        }


@functools.lru_cache(maxsize=1)
def _rules(files: tuple[tuple[str, str], ...]) -> _core.GrammarRules:
    """Compiled once in each process."""
    return _core.GrammarRules(list(files))


def run_block(job: Job) -> BlockResult:
    """Derive each lot and write its tiles, its model and its line of CityJSON."""
    rules = _rules(job.files)
    levels = levels_of(rules, job.options.attributes.values)
    folder = job.work / "tiles"
    with writing_to(job.out):
        folder.mkdir(parents=True, exist_ok=True)
    result = BlockResult(Town(folder))
    middles = np.array([_middle(lot) for lot in job.block.lots])
    for number, node in enumerate(squares(middles, NODE_LOTS)):
        _node(job, rules, levels, f"{number:02d}", [job.block.lots[row] for row in node], result)
    with timed_step(result.steps, "write"), writing_to(job.out):
        result.tile = result.town.finish()
        if job.city is not None:
            job.city.parent.mkdir(parents=True, exist_ok=True)
            write_bytes(job.city, "".join(f"{line}\n" for line in result.city).encode())
    return result


def _middle(lot: Lot) -> tuple[float, float]:
    x, y = lot.rings_m[0].mean(axis=0).tolist()
    return x + lot.anchor_m[0], y + lot.anchor_m[1]


def _node(
    job: Job,
    rules: _core.GrammarRules,
    levels: Levels,
    name: str,
    lots: Sequence[Lot],
    result: BlockResult,
) -> None:
    """The tiles of neighbours: near levels of a few at a time, volumes of all."""
    begin = len(result.town.built)
    tiles = []
    middles = np.array([_middle(lot) for lot in lots])
    for number, leaf in enumerate(squares(middles, LEAF_LOTS)):
        tile = _leaf(job, rules, levels, f"{name}-{number:02d}", [lots[r] for r in leaf], result)
        tiles += [tile] if tile else []
    built = result.town.built[begin:]
    if not built:
        return
    with timed_step(result.steps, "derive"):
        if levels.marked:
            volumes = _derive(job, rules, levels, [one.lot for one in built], VOLUME)
        else:
            volumes = prisms(built, [_rings(one.lot) for one in built])
    with timed_step(result.steps, "write"), writing_to(job.out):
        result.town.node(name, built, (volumes, list(range(len(built)))), tiles)


def _leaf(
    job: Job,
    rules: _core.GrammarRules,
    levels: Levels,
    name: str,
    lots: Sequence[Lot],
    result: BlockResult,
) -> Tile | None:
    """The near levels of some lots, with their models and lines of CityJSON."""
    sound = _sound(job, rules, lots, result)
    with timed_step(result.steps, "derive"):
        full = _derive(job, rules, levels, sound, FULL)
        plain = _derive(job, rules, levels, sound, PLAIN) if levels.plain else None
    rows, built = [], []
    for row, lot in enumerate(sound):
        one = built_of(full, row, lot, job.block.origin_m)
        if one is None:
            _fail(job, lot, full.fault(row) or NOTHING, result)
            continue
        result.notes.update(dict.fromkeys(full.messages(row)[:20], 1))
        rows.append(row)
        built.append(one)
    with timed_step(result.steps, "write"), writing_to(job.out):
        if job.city is not None:
            result.city += _city(plain or full, rows, built)
        tile = result.town.leaf(name, built, (full, rows), (plain, rows) if plain else None)
    if job.separate:
        built = _models(job, rules, levels, built, result)
    result.town.built += built
    result.town.polygons += sum(one.polygons for one in built)
    return tile


def _fail(job: Job, lot: Lot, reason: str, result: BlockResult) -> None:
    subject = f"{job.source}: {lot.name}"
    result.failures.append(Failure(subject=subject, kind="input", reason=reason))


def _sound(
    job: Job, rules: _core.GrammarRules, lots: Sequence[Lot], result: BlockResult
) -> list[Lot]:
    """The lots whose attributes the rules take."""
    kinds = dict(rules.attributes)
    sound = []
    for lot in lots:
        given = attributes_of(lot, kinds, job.options)
        if isinstance(given, str):
            _fail(job, lot, given, result)
        else:
            sound.append(lot)
    return sound


def _derive(
    job: Job, rules: _core.GrammarRules, levels: Levels, lots: Sequence[Lot], level: float
) -> _core.DerivedLots:
    options = job.options.derive
    return _core.derive_lots(
        rules,
        [_rings(lot) for lot in lots],
        [seed_of(lot, options.seed) for lot in lots],
        start=options.start,
        attributes=_given(job, rules, levels, lots, level),
        seconds=options.seconds,
        shapes=MAX_SHAPES,
    )


def _given(
    job: Job, rules: _core.GrammarRules, levels: Levels, lots: Sequence[Lot], level: float
) -> list[dict[str, Attribute]]:
    kinds = dict(rules.attributes)
    found = [attributes_of(lot, kinds, job.options) for lot in lots]
    return [levels.given(one, level) for one in found if not isinstance(one, str)]


def _city(derived: _core.DerivedLots, rows: Sequence[int], built: Sequence[Built]) -> list[str]:
    """The lines of the buildings; a level with plain windows, where there is one."""
    lines = []
    for row, one in zip(rows, built, strict=True):
        if derived.extent(row) is None:
            continue
        geometry = derived.city(row, one.lot.anchor_m, CLASSES, KINDS)
        about = one.lot.attributes | {"name": one.lot.name, "provenance": "invented"}
        line = feature_line(one.lot.id, about, geometry)
        lines += [line] if line else []
    return lines


def _models(
    job: Job,
    rules: _core.GrammarRules,
    levels: Levels,
    built: Sequence[Built],
    result: BlockResult,
) -> list[Built]:
    """A GLB of each building; those that give one."""
    lots = [one.lot for one in built]
    options = job.options.derive
    with timed_step(result.steps, "derive"):
        derived = rules.derive(
            [_rings(lot) for lot in lots],
            [seed_of(lot, options.seed) for lot in lots],
            start=options.start,
            attributes=_given(job, rules, levels, lots, FULL),
            seconds=options.seconds,
            shapes=MAX_SHAPES,
        )
    made = []
    with timed_step(result.steps, "write"):
        for one, found in zip(built, derived, strict=True):
            try:
                part = _part_of(one.lot, found)
            except NothingBuiltError as fault:
                _fail(job, one.lot, str(fault), result)
                continue
            with writing_to(job.out):
                write_glb(part, job.work / f"{one.lot.id}.glb")
            result.rows.append(_summary(one.lot, part, job.block.name))
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


def attributes_of(
    lot: Lot, kinds: dict[str, str], options: GrammarOptions
) -> dict[str, Attribute] | str:
    """The attributes that the rules have: of the call before those of the lot; or the fault."""
    found: dict[str, Attribute] = {}
    for name, value in lot.attributes.items():
        if name not in kinds or name in options.attributes.values:
            continue
        taken = as_kind(value, kinds[name])
        if taken is None:
            return f"its property {name} is {value!r}, but the rules want a {kinds[name]}"
        found[name] = taken
    return found | options.attributes.values


def as_kind(value: Attribute, kind: str) -> Attribute | None:
    """The value as an attribute of this kind takes it; None where it cannot."""
    if kind == "number" and isinstance(value, str):
        try:
            number = float(value)
        except ValueError:
            return None
        return number if abs(number) < 1e300 else None
    if kind == "number":
        return None if isinstance(value, bool) else value
    if kind == "bool":
        words: dict[Attribute, bool] = {"true": True, "false": False, True: True, False: False}
        return words.get(value.lower() if isinstance(value, str) else value)
    if kind == "text" and not isinstance(value, str):
        return f"{value:g}" if isinstance(value, float) else str(value).lower()
    return value


def seed_of(lot: Lot, seed: int) -> int:
    """What is random in a lot depends on its name and the seed, and on no other lot."""
    digest = hashlib.sha256(f"{seed}/{lot.id}".encode()).digest()
    return int.from_bytes(digest[:8], "little")


def _rings(lot: Lot) -> list[list[tuple[float, float, float]]]:
    return [[(x, y, 0.0) for x, y in ring.tolist()] for ring in lot.rings_m]


def _part_of(lot: Lot, derived: _core.DerivedLot | str) -> Part:
    if isinstance(derived, str):
        raise NothingBuiltError(derived)
    return build_part(derived, lot.id)


def _summary(lot: Lot, part: Part, folder: str) -> dict[str, Any]:
    low, high = part.bounds_m
    classes = part.features.class_code
    return {
        "id": lot.id,
        "name": lot.name,
        "model": f"{folder}/{lot.id}.glb",
        "anchor_m": list(lot.anchor_m),
        "bounds": [list(low), list(high)],
        "polygons": len(part.polygon_feature),
        "triangles": len(part.triangles.indices),
        "classes": {
            part.features.semantic(row).value: int((classes == classes[row]).sum())
            for row in sorted({int((classes == code).argmax()) for code in set(classes.tolist())})
        },
        "notes": list(part.notes),
    }
