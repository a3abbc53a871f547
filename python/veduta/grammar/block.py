"""Some lots of a call, derived and written together: what one process does at a time."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from veduta import _core
from veduta.formats.gltf import write_glb
from veduta.grammar.assets.library import Library
from veduta.grammar.building import NothingBuiltError, build_part
from veduta.grammar.edits import fault_told
from veduta.grammar.lots import Lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.textures import read_textures
from veduta.place.material import Texture
from veduta.place.part import Part
from veduta.run.errors import InputError
from veduta.run.outputs import writing_to
from veduta.run.report import Failure, StepRecord, timed_step

AT_ONCE = 4
"""Lots that are derived in one call of the extension: between two, Ctrl-C is heard."""
MAX_SHAPES = 500_000
"""Of one lot's tree; it bounds memory to some hundred megabytes."""
MEMORY = 400 * 1024**2
"""Bytes that a block is expected to need."""


@dataclass(frozen=True)
class Block:
    """Lots whose models go to one folder; `name` is its path in OUT."""

    name: str
    lots: tuple[Lot, ...]


@dataclass(frozen=True)
class Job:
    """A block to work on; `files` are the rule files, `source` is what failures name.

    folder: where the rules lie, and the assets that they name.
    textures: the files of the pictures that the rules name, by those names.
    """

    block: Block
    files: tuple[tuple[str, str], ...]
    options: GrammarOptions
    source: str
    folder: Path
    out: Path
    work: Path
    textures: Mapping[str, str] = field(default_factory=dict)


@dataclass
class BlockResult:
    """What became of the lots: a summary of each that was built, a failure of each other."""

    lots: list[dict[str, Any]] = field(default_factory=list)
    failures: list[Failure] = field(default_factory=list)
    steps: list[StepRecord] = field(default_factory=list)

    def summary(self) -> dict[str, Any]:
        """For the run's record: all that the place and the report need."""
        return {
            "lots": self.lots,
            "failures": [failure.model_dump() for failure in self.failures],
            "steps": [asdict(step) for step in self.steps],
        }


@functools.lru_cache(maxsize=1)
def _rules(
    files: tuple[tuple[str, str], ...], style: str | None, folder: Path
) -> tuple[_core.GrammarRules, Library]:
    """Compiled once in each process, with the assets that are named in the rules."""
    rules, library = _core.GrammarRules(list(files), style), Library(folder)
    library.add_written_to(rules)
    return rules, library


def run_block(job: Job) -> BlockResult:
    """Derive each lot and write its model into the work folder."""
    rules, library = _rules(job.files, job.options.derive.style, job.folder)
    result = BlockResult()
    with timed_step(result.steps, "derive"):
        derived = _derive_all(rules, library, job)
    textures = read_textures(job.textures)
    with timed_step(result.steps, "write"):
        for lot, found in zip(job.block.lots, derived, strict=True):
            try:
                part = _part_of(lot, found, library, textures)
            except NothingBuiltError as fault:
                subject = f"{job.source}: {lot.name}"
                result.failures.append(Failure(subject=subject, kind="input", reason=str(fault)))
                continue
            with writing_to(job.out):
                write_glb(part, job.work / f"{lot.id}.glb")
            result.lots.append(_summary(lot, part, job.block.name))
    return result


def _derive_all(
    rules: _core.GrammarRules, library: Library, job: Job
) -> list[_core.DerivedLot | str]:
    kinds = dict(rules.attributes)
    derived: list[_core.DerivedLot | str] = []
    for first in range(0, len(job.block.lots), AT_ONCE):
        lots = job.block.lots[first : first + AT_ONCE]
        given = [attributes_of(lot, kinds, job.options) for lot in lots]
        sound = [index for index, found in enumerate(given) if not isinstance(found, str)]
        made = _with_assets(
            rules,
            library,
            [lots[index] for index in sound],
            [found for found in given if not isinstance(found, str)],
            job.options,
        )
        by_index: dict[int, _core.DerivedLot | str] = dict(zip(sound, made, strict=True))
        by_index |= {index: found for index, found in enumerate(given) if isinstance(found, str)}
        derived += [by_index[index] for index in range(len(lots))]
    return derived


def _with_assets(
    rules: _core.GrammarRules,
    library: Library,
    lots: list[Lot],
    given: list[dict[str, Attribute]],
    options: GrammarOptions,
) -> list[_core.DerivedLot | str]:
    """Derive lots; again where one wants an asset whose name only the derivation shows."""
    found: list[_core.DerivedLot | str | None] = [None] * len(lots)
    while waiting := [index for index, one in enumerate(found) if one is None]:
        made = rules.derive(
            [_rings(lots[index]) for index in waiting],
            [seed_of(lots[index], options.derive.seed) for index in waiting],
            start=options.derive.start,
            attributes=[given[index] for index in waiting],
            edits=[[edit.core for edit in lots[index].edits] for index in waiting],
            seconds=options.derive.seconds,
            shapes=MAX_SHAPES,
        )
        for index, one in zip(waiting, made, strict=True):
            if isinstance(one, _core.MissingAsset):
                found[index] = _fault_of(rules, library, one)
            else:
                found[index] = one
    return [one for one in found if one is not None]


def _fault_of(
    rules: _core.GrammarRules, library: Library, missing: _core.MissingAsset
) -> str | None:
    """Makes the asset known; why it cannot be where it cannot."""
    try:
        library.add_to(rules, missing.name)
    except InputError as error:
        return f"{missing.why} ({error})"
    return None


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


def _part_of(
    lot: Lot,
    derived: _core.DerivedLot | str,
    library: Library,
    textures: Mapping[str, Texture],
) -> Part:
    if isinstance(derived, str):
        raise NothingBuiltError(derived)
    if fault := fault_told(lot.edits, derived.edit_faults):
        raise NothingBuiltError(fault)
    return build_part(derived, lot.id, library.assets_of(derived), textures)


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
        "triangles": len(part.triangles.indices) + _triangles_of_assets(part),
        "classes": {
            part.features.semantic(row).value: int((classes == classes[row]).sum())
            for row in sorted({int((classes == code).argmax()) for code in set(classes.tolist())})
        },
        "notes": list(part.notes),
    }


def _triangles_of_assets(part: Part) -> int:
    return 0 if part.instances is None else part.instances.triangle_count
