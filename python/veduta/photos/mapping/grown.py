"""A model that the engine made, with the pair that it began with, in memory and on the disk."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pycolmap

from veduta.photos.mapping.initial_pair import Start, WeighedPair
from veduta.run.atomic import atomic_folder

_START = "start.json"


@dataclass(frozen=True)
class Grown:
    """Poses and points, and how they were begun; None where no single pair began them."""

    model: pycolmap.Reconstruction
    start: Start | None


def write_grown(grown: Grown, folder: Path) -> None:
    """Keep it; the folder appears whole."""
    with atomic_folder(folder) as temporary:
        write_files(grown, temporary)


def write_files(grown: Grown, folder: Path) -> None:
    """Its files into a folder that is there."""
    grown.model.write_binary(folder)
    if grown.start is not None:
        (folder / _START).write_text(json.dumps(asdict(grown.start)), encoding="utf-8")


def read_grown(folder: Path) -> Grown:
    """What was kept."""
    path = folder / _START
    start = _start_of(json.loads(path.read_text(encoding="utf-8"))) if path.exists() else None
    return Grown(pycolmap.Reconstruction(folder), start)


def _start_of(told: dict[str, Any]) -> Start:
    return Start(**{**told, "pair": WeighedPair(**told["pair"])})
