"""The size of a camera's sensor by its make and model, from published specifications.

`camera_table/sensors.csv` has a row per format, `models.csv` one per model: what EXIF calls it, the
format, and, where a phone or drone has several cameras, the focal length of the one that is meant.
A model that ends in `*` stands for all that begin so (phones are named anew for each country).
"""

from __future__ import annotations

import csv
import functools
import re
from dataclasses import dataclass
from pathlib import Path

TABLE = Path(__file__).parent / "camera_table"
_SAME_FOCAL = 0.03
"""Relative difference of the focal lengths of one camera, as several programs write it."""


@dataclass(frozen=True)
class Sensor:
    """The sides of a sensor, the longer one first (mm)."""

    width_mm: float
    height_mm: float


@dataclass(frozen=True)
class _Row:
    make: str
    focal_mm: float | None
    sensor: Sensor


@dataclass(frozen=True)
class _Table:
    """Rows by the plain name of the model, and those that stand for a beginning of it."""

    makes: frozenset[str]
    exact: dict[str, list[_Row]]
    starts: list[tuple[str, _Row]]


def sensor_of(make: str, model: str, focal_mm: float) -> Sensor | None:
    """The sensor of a camera as EXIF names it; None where the table does not have it.

    focal_mm: the true focal length, by which the cameras of a phone are told apart.
    """
    table = _table()
    name = _plain(model, table.makes)
    words = f"{make} {model}".upper()
    begun = [row for start, row in table.starts if name.startswith(start)]
    found: list[_Row] = [*table.exact.get(name, ()), *begun]
    for row in found:
        meant = row.focal_mm is None or abs(focal_mm / row.focal_mm - 1.0) <= _SAME_FOCAL
        if meant and row.make in words:
            return row.sensor
    return None


def _plain(model: str, makes: frozenset[str]) -> str:
    """The model without what differs between programs: the maker's name, case, spaces, signs."""
    kept = [word for word in model.upper().split() if word not in makes]
    return re.sub(r"[^A-Z0-9]", "", "".join(kept))


@functools.cache
def _table() -> _Table:
    sensors = {
        row["sensor"]: Sensor(float(row["width_mm"]), float(row["height_mm"]))
        for row in _rows("sensors.csv")
    }
    models = _rows("models.csv")
    makes = frozenset(word for row in models for word in row["make"].upper().split())
    table = _Table(makes, {}, [])
    for found in models:
        focal = float(found["focal_mm"]) if found["focal_mm"] else None
        row = _Row(found["make"].upper(), focal, sensors[found["sensor"]])
        name = _plain(found["model"], makes)
        if found["model"].endswith("*"):
            table.starts.append((name, row))
        else:
            table.exact.setdefault(name, []).append(row)
    return table


def _rows(name: str) -> list[dict[str, str]]:
    with (TABLE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
