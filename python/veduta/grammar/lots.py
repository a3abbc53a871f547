"""Building lots: outlines with holes on level ground, from files of several formats and any size.

A file is read once: its outlines go to a spool on the disk while what they have in common (where
they lie, in which units) is found out. The lots are then placed one by one, into a second spool;
in memory remains where each stands, and which names are taken.

Read: GeoJSON (`geojson_lots`), CityJSON (`city_lots`, `city_stream`), GeoPackage (`package_lots`),
OBJ (`object_lots`), and by GDAL Shapefile, OpenStreetMap, KML and others (`vector_lots`). Where
there are roads, each lot begins at its front (`roads`, `streets`); without any, one whose first
edge stands against another lot begins where none does (`free_fronts`).
"""

from __future__ import annotations

import contextlib
import difflib
import itertools
import json
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.city_lots import city_outlines
from veduta.grammar.city_stream import (
    SEQUENCES,
    is_city,
    large_city_outlines,
    sequence_outlines,
)
from veduta.grammar.edge_values import STREET, edges_of_ring
from veduta.grammar.edits import Edit
from veduta.grammar.failures import Failures
from veduta.grammar.feature_stream import FeatureStream
from veduta.grammar.frames import (
    Frame,
    Survey,
    find_frame,
    given_crs,
    height_origin,
    named_crs,
)
from veduta.grammar.free_fronts import MOST, FreeFronts, free_fronts
from veduta.grammar.geojson_lots import feature_outlines, features_of
from veduta.grammar.json_stream import refuse_constant
from veduta.grammar.lot import (
    Lot,
    SpooledLots,
    bytes_of_rings,
    edited,
    ids_of,
    rings_of_bytes,
)
from veduta.grammar.object_lots import object_outlines
from veduta.grammar.options import LotOptions
from veduta.grammar.outline import Attribute, Found, Outline, Outlines, Road
from veduta.grammar.package_lots import is_package, package_outlines
from veduta.grammar.rings import RingFault, clean_rings
from veduta.grammar.roads import Roads
from veduta.grammar.spool import Record, Spool
from veduta.grammar.streets import roads_among
from veduta.grammar.taken_names import TakenNames
from veduta.grammar.terrain import Ground, NoGroundError, Terrain, read_terrain
from veduta.grammar.unread import remedy_for
from veduta.grammar.vector_lots import FOLDERS, vector_outlines
from veduta.grammar.vector_lots import SUFFIXES as VECTORS
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path
from veduta.run.outputs import writing_to

MAX_BYTES = 64 * 2**20
"""Bytes of JSON that are read at once."""
MAX_EXTENT_M = 200_000.0
"""Between the lots that are farthest from each other."""
TELL_EACH = 100_000
"""Polygons between two lines about how far the reading has come."""
MOST_COMPARED = 10_000
"""Ids that are looked at for one that is written alike."""


@dataclass(frozen=True)
class Lots:
    """The lots of one call, about `origin_m` in `crs`, and what gave none.

    roads: in metres about the origin.
    """

    lots: Sequence[Lot]
    crs: str | None = None
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    failures: Failures = field(default_factory=Failures)
    notes: tuple[str, ...] = ()
    roads: tuple[Road, ...] = ()

    def close(self) -> None:
        """Give the room on the disk back; no lot can be read any more."""
        if isinstance(self.lots, SpooledLots):
            self.lots.close()


def read_lots(
    path: Path,
    options: LotOptions | None = None,
    folder: Path | None = None,
    say: Callable[[str], None] = lambda text: None,
) -> Lots:
    """The lots in a file; InputError where it has none that can be used.

    folder: has room for the lots where they are many; where temporary files lie if it is None. say:
    is told how far the reading of many has come.
    """
    options = options or LotOptions()
    found = Found(is_settled=options.crs is not None, has_roads=options.roads is not None)
    survey = Survey()
    room = folder or Path(tempfile.gettempdir())
    with writing_to(room), contextlib.closing(Spool(folder)) as spool:
        for outline in _outlines_of(path, options, found, folder):
            survey.add(outline.rings[0])
            spool.append(_record(outline))
            if len(spool) % TELL_EACH == 0:
                say(f"{path}: {len(spool):,} polygons read")
        if options.crs is not None:
            found.epsg = given_crs(options.crs)
        if not len(spool):
            named = found.failures.named
            reason = f" ({named[0].reason})" if named else ""
            raise InputError(path, f"has no lot that can be used{reason}", "Give it polygons.")
        frame = find_frame(path, found.epsg, survey, lambda: (_first_ring(one) for one in spool))
        terrain = read_terrain(options.terrain, frame.crs) if options.terrain is not None else None
        if options.roads is not None and real_path(options.roads) == real_path(path):
            found.roads.clear()  # they come with all others of the file
        roads = roads_among(options.roads, found, frame)
        outlines = [] if len(roads) or len(spool) > MOST else map(_outline, spool)
        free = free_fronts(outlines, frame)
        stand = _Stand(frame, terrain, options.ground, roads, free)
        lots = _placed(path, map(_outline, spool), stand, found, folder)
        if terrain is not None:
            frame = _from_lowest(frame, lots)
        if len(spool) >= TELL_EACH:
            say(f"{path}: {len(lots):,} lots")
    notes = (*found.all_notes(), *frame.notes, *free.notes())
    return Lots(lots, frame.crs, frame.origin_m, found.failures, notes, roads=roads.lines)


def require_lots(path: Path | None, options: LotOptions | None) -> None:
    """InputError where options say how to read a file of lots, but there is none."""
    if path is None and options is not None and options != LotOptions():
        changed = [name for name, value in options if value != getattr(LotOptions(), name)]
        raise InputError(f"--{changed[0]}", "is about a file of lots", "Give --lots, too.")


def edited_lots(lots: Lots, path: Path, edits: Mapping[str, tuple[Edit, ...]]) -> Lots:
    """The lots with the edits of the file `path`; InputError where it names another lot."""
    missing = set(edits)
    if missing:
        missing.difference_update(ids_of(lots.lots))
    for name in sorted(missing):
        line = edits[name][0].where.rpartition(":")[2]
        hint = near_id(name, lots.lots, "There are")
        raise InputError(path, f"line {line} edits the lot `{name}`, which is not there", hint)
    return replace(lots, lots=edited(lots.lots, edits))


def near_id(name: str, lots: Sequence[Lot], told: str) -> str:
    """What to say of a lot that is not there: one that is called alike, or the first ones."""
    ids = list(itertools.islice(ids_of(lots), MOST_COMPARED))
    near = difflib.get_close_matches(name, ids, n=1)
    more = ", ..." if len(lots) > 12 else ""
    return f"Did you mean `{near[0]}`?" if near else f"{told}: {', '.join(ids[:12])}{more}."


def _outlines_of(path: Path, options: LotOptions, found: Found, folder: Path | None) -> Outlines:
    """What the file has, whatever its format."""
    _require(path)
    if is_package(path):
        return package_outlines(path, options.layer, found)
    suffix = path.suffix.lower()
    if suffix == ".gpkg":
        remedy = "Fetch or export it again: its first bytes are not those of a database."
        raise InputError(path, "is no GeoPackage, though its name says so", remedy)
    if suffix in VECTORS:
        return vector_outlines(path, options.layer, found)
    if options.layer is not None:
        raise InputError(f"--layer {options.layer}", f"but {path} has no layers", "Leave it out.")
    if suffix == ".obj":
        return object_outlines(path, options.up, found, folder)
    if suffix in SEQUENCES:
        return sequence_outlines(path, found)
    if path.stat().st_size > MAX_BYTES:
        if is_city(path):
            return large_city_outlines(path, found, folder)
        stream = FeatureStream(path)
        return _of_geojson(path, stream.features(), stream.members, found, options)
    document = _read_json(path)
    if document.get("type") == "CityJSON":
        return city_outlines(path, document, found)
    return _of_geojson(path, features_of(path, document), document, found, options)


def _of_geojson(
    path: Path,
    features: Iterator[Any],
    members: dict[str, Any],
    found: Found,
    options: LotOptions,
) -> Outlines:
    """The lots of all features; `members` has the CRS when the last feature has come."""
    yield from feature_outlines(path, features, found)
    if options.crs is None:
        found.epsg = named_crs(path, members)


@dataclass(frozen=True)
class _Stand:
    """Where lots come to stand: as high as their lowest corner, or as the terrain says."""

    frame: Frame
    terrain: Terrain | None
    ground: Ground
    roads: Roads
    free: FreeFronts

    def of(self, outline: Outline, own_id: Callable[[str], str]) -> Lot:
        """The lot, about its own anchor; RingFault or NoGroundError where it cannot be used."""
        rings = [self.frame.local(ring) for ring in outline.rings]
        low = np.floor(rings[0].min(axis=0))
        level = float(min(ring[:, 2].min() for ring in rings))
        flat = clean_rings([ring[:, :2] - low[:2] for ring in rings])
        if self.terrain is not None:
            east, north, up = self.frame.origin_m
            own = [ring[:, :2] + (east, north) for ring in rings]
            level = self.terrain.under(own, self.ground) - up
        attributes = outline.attributes
        told: dict[str, Attribute] = {}
        if (front := self.roads.front_of(flat[0] + low[:2])) is not None:
            flat = [np.roll(flat[0], -front.edge, axis=0), *flat[1:]]
            widths = [*np.roll(front.widths_m, -front.edge).tolist()]
            widths += [0.0] * sum(len(ring) for ring in flat[1:])
            told = {STREET: ";".join(f"{width:g}" for width in widths)}
        elif STREET not in attributes and (edge := self.free.edge_of(flat[0] + low[:2])):
            flat = [np.roll(flat[0], -edge, axis=0), *flat[1:]]
        attributes = edges_of_ring(attributes, [ring[:, :2] - low[:2] for ring in rings], flat)
        attributes = (front.attributes() if front else {}) | told | attributes
        return Lot(
            id=own_id(outline.name),
            name=outline.name,
            rings_m=tuple(flat),
            anchor_m=(float(low[0]), float(low[1]), level),
            attributes=attributes,
        )


def _placed(
    path: Path, outlines: Outlines, stand: _Stand, found: Found, folder: Path | None
) -> SpooledLots:
    """Lots with rings that can be built on; the failures of others go to `found`."""
    lots, taken = SpooledLots(folder), TakenNames()
    first_fault = ""
    for outline in outlines:
        try:
            lots.append(stand.of(outline, taken.own))
        except (RingFault, NoGroundError) as fault:
            found.fail(outline.subject, str(fault))
            first_fault = first_fault or str(fault)
    if not len(lots):
        raise InputError(path, f"has no lot that can be used ({first_fault})", "Mend its polygons.")
    lots.flush()
    extent_m = float(np.ptp(lots.anchors_m[:, :2], axis=0).max())
    if extent_m > MAX_EXTENT_M:
        raise InputError(
            path,
            f"has lots that lie {extent_m / 1000:.0f} km apart, more than "
            f"{MAX_EXTENT_M / 1000:.0f} km",
            "Cut it into several, or check its coordinates.",
        )
    return lots


def _from_lowest(frame: Frame, lots: SpooledLots) -> Frame:
    """Has heights of lots on terrain count from the lowest of them: it lies on the plane."""
    x, y, z = frame.origin_m
    up = height_origin(z + float(lots.anchors_m[:, 2].min()))
    lots.lift(z, up)
    return replace(frame, origin_m=(x, y, up))


def _record(outline: Outline) -> Record:
    return outline.subject, outline.name, outline.attributes, bytes_of_rings(outline.rings)


def _outline(record: Record) -> Outline:
    subject, name, attributes, rings = record
    return Outline(subject, name, list(rings_of_bytes(rings, 3)), attributes)


def _first_ring(record: Record) -> NDArray[np.float64]:
    return rings_of_bytes(record[3][:1], 3)[0]


def _require(path: Path) -> None:
    if path.suffix.lower() in FOLDERS and path.is_dir():
        return
    try:
        require_file(path)
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error


def _read_json(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(path.read_bytes(), parse_constant=refuse_constant)
    except OSError as error:
        raise InputError(
            path, f"cannot be read ({error.strerror})", "Check its permissions."
        ) from error
    except RecursionError as error:
        raise InputError(path, "is nested too deep", "Check that it is GeoJSON.") from error
    except ValueError as error:  # bad JSON, bad UTF-8, a number that is none
        remedy = remedy_for(path, VECTORS)
        is_text = not isinstance(error, UnicodeDecodeError)
        fault = (
            f"is not JSON ({error})" if is_text else "is no text, and no file of lots that is read"
        )
        raise InputError(path, fault, remedy) from error
    if not isinstance(document, dict):
        raise InputError(path, "is not GeoJSON: it is no object", "Save it as GeoJSON.")
    return document
