"""Building lots from GeoPackages (OGC 12-128r19): the polygons of one of its layers.

Rows are read in blocks, so that a file may be larger than memory; only plain tables are read, and
nothing that the file computes.
"""

from __future__ import annotations

import contextlib
import difflib
import shlex
import sqlite3
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from veduta.grammar.line_layers import add_roads_beside, crs_of_layer
from veduta.grammar.outline import Found, Outlines, name_of, outlines_of, plain_attributes
from veduta.grammar.rings import RingFault, closed_ring
from veduta.grammar.wkb import polygons_of_wkb
from veduta.run.errors import InputError
from veduta.run.names import real_path

MAGIC = b"SQLite format 3\0"
BLOCK_ROWS = 1000
_NAMES = ("id", "name", "fid")
MAX_CELL_BYTES = 16 * 2**20
MAX_SECONDS = 300.0
_STEPS = 100_000
_ENVELOPES = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}
_AREAS = ("POLYGON", "MULTIPOLYGON", "GEOMETRY", "GEOMETRYCOLLECTION", "SURFACE", "MULTISURFACE")


_LINES = ("LINESTRING", "MULTILINESTRING", "CURVE", "MULTICURVE")


@dataclass(frozen=True)
class _Layer:
    table: str
    column: str
    srs: int


def is_package(path: Path) -> bool:
    """Whether the file is a database as GeoPackages are."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def package_outlines(path: Path, layer_name: str | None, found: Found) -> Outlines:
    """The outlines of a layer; of the only one where none is named.

    InputError where the file is no GeoPackage.
    """
    try:
        with contextlib.closing(_opened(path)) as base:
            layer = _layer(path, base, layer_name)
            if not found.is_settled:
                found.epsg = _epsg(path, base, layer.srs)
            if not found.has_roads and _has_lines(base):
                add_roads_beside(path, layer.table, crs_of_layer(path, layer.table), found)
            yield from _outlines(path, base, layer, found)
    except (sqlite3.Error, UnicodeError) as error:
        raise _damaged(path, f"cannot be read ({error})") from error


def _damaged(path: Path, fault: str) -> InputError:
    """What a program that reads it cannot save anew."""
    own, new = shlex.quote(path.name), shlex.quote(f"{path.stem}-whole.gpkg")
    return InputError(
        path, fault,
        "It is damaged: fetch or copy it again. What is left of it comes out of"
        f" `sqlite3 {own} .recover | sqlite3 {new}`.",
    )  # fmt: skip


def _opened(path: Path) -> sqlite3.Connection:
    """The file, to be read only."""
    base = sqlite3.connect(f"{real_path(path).as_uri()}?mode=ro&immutable=1", uri=True)
    base.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MAX_CELL_BYTES)
    base.execute("PRAGMA trusted_schema = OFF")
    _bound_time(base)
    base.text_factory = lambda raw: raw.decode("utf-8", "replace")
    return base


def _bound_time(base: sqlite3.Connection) -> None:
    """What the file is asked from now on may take so long."""
    end = time.monotonic() + MAX_SECONDS
    base.set_progress_handler(lambda: int(time.monotonic() > end), _STEPS)


def _layer(path: Path, base: sqlite3.Connection, wanted: str | None) -> _Layer:
    tables = {row[0] for row in base.execute("SELECT name FROM sqlite_master WHERE type='table'")}
    if "gpkg_geometry_columns" not in tables:
        own = shlex.quote(path.name)
        remedy = f"If it is one of SpatiaLite, `ogr2ogr -f GPKG lots.gpkg {own}` converts it."
        raise InputError(path, "is a database, but no GeoPackage", remedy)
    rows = base.execute(
        "SELECT table_name, column_name, geometry_type_name, srs_id FROM gpkg_geometry_columns"
    )
    found = [
        _Layer(str(table), str(column), int(srs))
        for table, column, kind, srs in rows
        if table in tables and str(kind).upper() in _AREAS and isinstance(srs, int)
    ]
    names = [layer.table for layer in found]
    if not found:
        raise InputError(path, "has no layer of polygons", "Give it one, as a plain table.")
    if wanted is None and len(found) > 1:
        raise InputError(
            path, f"has {len(found)} layers of polygons", f"Name one with --layer: {_some(names)}."
        )
    if wanted is not None and wanted not in names:
        near = difflib.get_close_matches(wanted, names, n=1)
        hint = f"Did you mean `{near[0]}`?" if near else f"It has: {_some(names)}."
        raise InputError(f"--layer {wanted}", f"is no layer of polygons in {path}", hint)
    return found[0] if wanted is None else found[names.index(wanted)]


def _has_lines(base: sqlite3.Connection) -> bool:
    """Whether one of its layers is named as one of lines."""
    kinds = base.execute("SELECT geometry_type_name FROM gpkg_geometry_columns")
    return any(str(kind).upper() in _LINES for (kind,) in kinds)


def _some(names: list[str]) -> str:
    return ", ".join(names[:12])


def _epsg(path: Path, base: sqlite3.Connection, srs: int) -> int | None:
    """The EPSG code of a reference system; None where the layer says that it has none."""
    if srs in (-1, 0):
        return 4326 if srs == 0 else None
    row = base.execute(
        "SELECT organization, organization_coordsys_id FROM gpkg_spatial_ref_sys WHERE srs_id = ?",
        (srs,),
    ).fetchone()
    if row is None or str(row[0]).upper() != "EPSG" or not isinstance(row[1], int):
        raise InputError(
            path, f"has a reference system without EPSG code (srs_id {srs})", "Give --crs."
        )
    return int(row[1])


def _outlines(path: Path, base: sqlite3.Connection, layer: _Layer, found: Found) -> Outlines:
    columns = list(base.execute(f"PRAGMA table_info({_quoted(layer.table)})"))
    names = [str(column[1]) for column in columns]
    truths = {str(column[1]) for column in columns if str(column[2]).upper() == "BOOLEAN"}
    if layer.column not in names:
        raise InputError(path, f"has no column {layer.column}", "Save it anew as GeoPackage.")
    for number, row in enumerate(_rows(path, base, layer, names), 1):
        subject = f"{path}: {layer.table} row {number}"
        if isinstance(row, str):
            found.fail(subject, row)
            continue
        values = dict(zip(names, row, strict=True))
        geometry = values.pop(layer.column)
        properties = {k: bool(v) if k in truths and v in (0, 1) else v for k, v in values.items()}
        attributes = plain_attributes(properties)
        name = name_of(attributes, _NAMES, number)
        try:
            polygons, kind = _polygons(geometry)
            if polygons is None:
                found.pass_over(kind)
                continue
            yield from outlines_of(polygons, len(polygons), name, subject, attributes)
        except RingFault as fault:
            found.fail(subject, str(fault))


def _rows(
    path: Path, base: sqlite3.Connection, layer: _Layer, names: list[str]
) -> Iterator[tuple[Any, ...] | str]:
    """The rows in their order; what is wrong with one that has a cell too large."""
    taken = {name.lower() for name in names}
    row_id = next((name for name in ("rowid", "_rowid_", "oid") if name not in taken), None)
    if row_id is None:
        raise InputError(path, "has no numbers of rows", "Save it anew as GeoPackage.")
    listed = ", ".join(_quoted(name) for name in names)
    begin = f"FROM {_quoted(layer.table)} WHERE {row_id} > ? ORDER BY {row_id}"
    last, number = -(2**63), 0
    try:
        while True:
            _bound_time(base)
            with contextlib.suppress(sqlite3.DataError):  # of the next row, or the one behind it
                for row in base.execute(f"SELECT {row_id}, {listed} {begin}", (last,)):
                    last, number = row[0], number + 1
                    yield row[1:]
                    if number % BLOCK_ROWS == 0:
                        _bound_time(base)
                return
            number += 1
            try:
                row = base.execute(f"SELECT {row_id}, {listed} {begin} LIMIT 1", (last,)).fetchone()
                yield row[1:]
            except sqlite3.DataError:
                row = base.execute(f"SELECT {row_id} {begin} LIMIT 1", (last,)).fetchone()
                yield f"a cell is larger than {MAX_CELL_BYTES >> 20} MB"
            last = row[0]
    except sqlite3.DatabaseError as error:
        raise _damaged(path, f"cannot be read after row {number} ({error})") from error


def _polygons(geometry: object) -> tuple[list[Any] | None, str]:
    """The polygons of a cell: the header of GeoPackage (section 2.1.3), then WKB."""
    if geometry is None:
        return None, "row without geometry"
    if not isinstance(geometry, bytes) or geometry[:2] != b"GP" or len(geometry) < 8:
        raise RingFault("its geometry is none of a GeoPackage")
    flags = geometry[3]
    envelope = _ENVELOPES.get((flags >> 1) & 7)
    if envelope is None:
        raise RingFault("its geometry is none of a GeoPackage")
    if flags & 0b1_0000:
        return None, "empty geometry"
    polygons, kind = polygons_of_wkb(geometry[8 + envelope :])
    if polygons is None:
        return None, kind
    return [[closed_ring(ring) for ring in rings] for rings in polygons], kind


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'
