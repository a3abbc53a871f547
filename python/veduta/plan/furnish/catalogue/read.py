"""Reading the catalogue: the project's objects, and those of a file of the user's own."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any, get_args

from veduta.plan.furnish.catalogue.entry import (
    Entry,
    Finish,
    ObjectClass,
    Side,
    Stands,
    SupportSurface,
    Wanted,
)
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path

TEXTS = ("schema.sql", "objects.sql", "rooms.sql")
MAX_BYTES = 50_000_000
MAX_OBJECTS = 5_000
LARGEST_M = 30.0
_REMEDY = "docs/plan.md says what the tables of a catalogue are."


@dataclass(frozen=True)
class Catalogue:
    """All that can stand in a house."""

    entries: Mapping[str, Entry]
    finishes: Mapping[str, Finish]
    wanted: tuple[Wanted, ...]
    smaller: Mapping[str, str]

    def of_type(self, kind: str) -> list[Entry]:
        """The objects of a type, in the order of the catalogue."""
        return [entry for entry in self.entries.values() if entry.type == kind]

    def wanted_in(self, use: str) -> list[Wanted]:
        """What a room of a use has, in its order."""
        return sorted((one for one in self.wanted if one.use == use), key=lambda one: one.place)


@lru_cache(maxsize=1)
def builtin_catalogue() -> Catalogue:
    """The project's own."""
    with open_builtin() as base:
        base.row_factory = sqlite3.Row
        return Catalogue(
            {row["name"]: _entry(row, _surfaces(base), None) for row in _all(base, "object")},
            {row["name"]: _finish(row) for row in _all(base, "finish")},
            tuple(_wanted(row) for row in _all(base, "wanted")),
            {row["type"]: row["instead"] for row in _all(base, "smaller")},
        )


def open_builtin() -> sqlite3.Connection:
    """The project's catalogue as a database in memory."""
    base = sqlite3.connect(":memory:")
    folder = resources.files("veduta.plan.furnish.catalogue")
    for name in TEXTS:
        base.executescript(folder.joinpath(name).read_text(encoding="utf-8"))
    return base


def catalogue_of(path: Path | None) -> Catalogue:
    """The project's catalogue; with a file, what is in its tables is added or goes before.

    InputError says what is wrong with the file.
    """
    own = builtin_catalogue()
    if path is None:
        return own
    try:
        require_file(path, MAX_BYTES)
        base = sqlite3.connect(f"{real_path(path).as_uri()}?mode=ro", uri=True)
    except (OSError, sqlite3.Error) as error:
        raise InputError(path, f"cannot be read ({error})", "Check its name.") from error
    try:
        base.row_factory = sqlite3.Row
        added = _read_added(base, path)
    except (sqlite3.Error, KeyError, IndexError, TypeError, ValueError) as error:
        fault = f"is no catalogue of objects ({error})"
        raise InputError(path, fault, _REMEDY) from error
    finally:
        base.close()
    return Catalogue(
        {**own.entries, **added.entries},
        {**own.finishes, **added.finishes},
        (*own.wanted, *added.wanted),
        {**own.smaller, **added.smaller},
    )


def _read_added(base: sqlite3.Connection, path: Path) -> Catalogue:
    tables = {row["name"] for row in base.execute("SELECT name FROM sqlite_master")}
    if "object" not in tables:
        raise ValueError("it has no table 'object'")
    count = base.execute("SELECT count(*) FROM object").fetchone()[0]
    if count > MAX_OBJECTS:
        raise ValueError(f"{count} objects; {MAX_OBJECTS} are the most")
    surfaces = _surfaces(base) if "surface" in tables else {}
    entries = {}
    for row in _all(base, "object"):
        entry = _entry(row, surfaces, path.parent)
        if entry.file is not None:
            entries[entry.name] = entry
        elif entry.name not in builtin_catalogue().entries:
            raise ValueError(f"object {entry.name!r} names no file")
    return Catalogue(
        entries,
        {row["name"]: _finish(row) for row in _all(base, "finish")} if "finish" in tables else {},
        _new_wishes(base) if "wanted" in tables else (),
        {row["type"]: row["instead"] for row in _all(base, "smaller")}
        if "smaller" in tables
        else {},
    )


def _new_wishes(base: sqlite3.Connection) -> tuple[Wanted, ...]:
    """Those that the project's catalogue has not: a copy of it repeats them."""
    known = set(builtin_catalogue().wanted)
    return tuple(one for one in map(_wanted, _all(base, "wanted")) if one not in known)


def _all(base: sqlite3.Connection, table: str) -> list[sqlite3.Row]:
    return base.execute(f"SELECT * FROM {table} ORDER BY rowid").fetchall()


def _entry(
    row: sqlite3.Row, surfaces: Mapping[str, list[SupportSurface]], folder: Path | None
) -> Entry:
    name = str(row["name"])
    size = tuple(float(row[side]) for side in ("width_m", "depth_m", "height_m"))
    if not all(0.0 < side <= LARGEST_M for side in size):
        raise ValueError(f"object {name!r} has no size between 0 and {LARGEST_M:g} m")
    return Entry(
        name=name,
        type=str(row["type"]),
        kind=_one_of(row["class"], get_args(ObjectClass), f"class of {name!r}"),
        model=row["model"],
        file=row["file"],
        folder=folder,
        finishes=_pairs(row["finishes"] or ""),
        size_m=(size[0], size[1], size[2]),
        widths_m=_range(row["least_width_m"], row["most_width_m"], size[0]),
        depths_m=_range(row["least_depth_m"], row["most_depth_m"], size[1]),
        walls=frozenset(
            _one_of(side, get_args(Side), f"walls of {name!r}")
            for side in (row["walls"] or "").split()
        ),
        stands=_one_of(row["stands"], get_args(Stands), f"stands of {name!r}"),
        above_m=float(row["above_m"]),
        front_m=float(row["front_m"]),
        side_m=float(row["side_m"]),
        fragility=int(row["fragility"]),
        surfaces=tuple(surfaces.get(name, ())),
    )


def _one_of(value: Any, allowed: tuple[Any, ...], what: str) -> Any:
    if value not in allowed:
        raise ValueError(f"{what} is {value!r}, not one of {', '.join(allowed)}")
    return value


def _pairs(text: str) -> dict[str, str]:
    return dict(pair.split("=", 1) for pair in text.split())


def _range(least: float | None, most: float | None, usual: float) -> tuple[float, float]:
    return (min(usual, least or usual), max(usual, most or usual))


def _surfaces(base: sqlite3.Connection) -> dict[str, list[SupportSurface]]:
    found: dict[str, list[SupportSurface]] = {}
    for row in _all(base, "surface"):
        sides = [float(row[name]) for name in ("left", "right", "front", "back", "height")]
        free, fragility = float(row["free_m"]), int(row["fragility"])
        own = SupportSurface(sides[0], sides[1], sides[2], sides[3], sides[4], free, fragility)
        found.setdefault(row["object"], []).append(own)
    return found


def _finish(row: sqlite3.Row) -> Finish:
    colour = (float(row["red"]), float(row["green"]), float(row["blue"]))
    return Finish(
        row["name"], colour, float(row["roughness"]), float(row["metalness"]),
        float(row["opacity"]), row["texture"],
    )  # fmt: skip


def _wanted(row: sqlite3.Row) -> Wanted:
    return Wanted(
        row["use"], row["type"], int(row["least"]), int(row["most"]), float(row["from_m2"]),
        float(row["each_m2"]), float(row["chance"]), bool(row["critical"]), int(row["place"]),
    )  # fmt: skip
