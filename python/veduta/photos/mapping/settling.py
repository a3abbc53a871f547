"""Mapping until no photos contradict each other: map, drop doubtful pairs, map again.

Doubt needs a model: only where photos have places can it be said what both should show. Each round
is kept on the disk, so that a killed run goes on within it.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from veduta.photos.mapping.at_once import map_at_once
from veduta.photos.mapping.conflicts import close_pairs
from veduta.photos.mapping.doubt import (
    Doubt,
    database_without,
    doubtful_pairs,
    read_doubts,
    read_matched,
    write_doubts,
)
from veduta.photos.mapping.growing import RigKind
from veduta.photos.mapping.mapping import (
    FEWEST_MATCHES,
    Mapped,
    map_photos,
    read_models,
    write_models,
)
from veduta.photos.mapping.same_place import different_places
from veduta.photos.options import MapKind
from veduta.photos.structure import structure_of
from veduta.run.progress import StepProgress, no_progress

ROUNDS = 4
"""Times that the photos are mapped at most."""


@dataclass(frozen=True)
class Settled:
    """The components, and the pairs that they were made without.

    folded: whether photos of theirs contradict each other still.
    """

    mapped: Mapped
    dropped: tuple[Doubt, ...]
    folded: bool


def map_settled(
    database: Path,
    work: Path,
    image_ids: Sequence[int],
    seed: int,
    progress: StepProgress = no_progress,
    kind: MapKind = "incremental",
    rig: RigKind = "none",
    *,
    focal_held: bool = False,
) -> Settled:
    """Map the photos of a database until their pairs agree.

    work: a folder for what is finished; a call that was killed goes on from there. rig,
    focal_held: as in `Growth`.
    """
    work.mkdir(exist_ok=True)
    dropped: tuple[Doubt, ...] = ()

    def mapped_from(source: Path, growing: Path) -> Mapped:
        if kind == "global":
            return map_at_once(source, growing, image_ids, seed, progress)
        return map_photos(source, growing, image_ids, seed, progress, rig, focal_held=focal_held)

    for number in range(ROUNDS):
        mapped = _mapped(database, work, number, dropped, mapped_from)
        noted = work / f"doubts-{number}.json"
        if not noted.exists():
            write_doubts(noted, _doubts(mapped, database, image_ids, dropped))
        doubts = read_doubts(noted)
        if doubts == dropped:
            return Settled(mapped, dropped, folded=False)
        if number < ROUNDS - 1:
            dropped = doubts
    more = {*doubts} - {*dropped}
    return Settled(mapped, dropped, folded=bool(more))


def _mapped(
    database: Path,
    work: Path,
    number: int,
    dropped: Sequence[Doubt],
    mapped_from: Callable[[Path, Path], Mapped],
) -> Mapped:
    """The components of a round, from the disk where it is finished.

    mapped_from: makes them of a database, with a folder to work in.
    """
    models = work / f"models-{number}"
    if not models.exists():
        source = database
        if dropped:
            source = work / f"matches-{number}.db"
            if not source.exists():
                database_without(database, dropped, source)
        growing = work / f"round-{number}"
        write_models(mapped_from(source, growing), models)
        shutil.rmtree(growing)
        if dropped:
            source.unlink()
    return read_models(models)


def _doubts(
    mapped: Mapped, database: Path, image_ids: Sequence[int], dropped: Sequence[Doubt]
) -> tuple[Doubt, ...]:
    structures = [
        structure_of(model, {image: str(image) for image in model.reg_image_ids()})
        for model in mapped.models
    ]
    matched = read_matched(database, image_ids, FEWEST_MATCHES)
    close = [close_pairs(structure) for structure in structures]
    apart = [
        different_places(structure, pairs, matched)
        for structure, pairs in zip(structures, close, strict=True)
    ]
    return doubtful_pairs(list(chain(*close)), matched, dropped, frozenset().union(*apart))
