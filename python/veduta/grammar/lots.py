"""Building lots: outlines with holes on level ground, from files of several formats.

Read: GeoJSON (here), CityJSON (`city_lots`), GeoPackage (`package_lots`), OBJ (`object_lots`).
"""

from __future__ import annotations

import difflib
import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.city_lots import city_epsg, city_outlines
from veduta.grammar.edits import Edit
from veduta.grammar.feature_stream import FeatureStream
from veduta.grammar.frames import Frame, find_frame, height_origin, named_crs
from veduta.grammar.object_lots import object_outlines
from veduta.grammar.options import LotOptions
from veduta.grammar.outline import Attribute, Outline, plain_attributes
from veduta.grammar.package_lots import is_package, package_outlines
from veduta.grammar.rings import RingFault, clean_rings, numbers_of
from veduta.grammar.terrain import Ground, NoGroundError, Terrain, read_terrain
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.report import Failure

MAX_BYTES = 64 * 2**20
MAX_LOTS = 100_000
MAX_EXTENT_M = 200_000.0
"""Between the lots that are farthest from each other."""
_MAX_ID = 200


@dataclass(frozen=True)
class Lot:
    """A building lot.

    rings_m: (n, 2) each, about `anchor_m`; the outline first, counter-clockwise seen from above,
    its first edge along the street; holes run clockwise. anchor_m: x, y, z from the origin of all
    lots. attributes: what the file says of it. edits: what is otherwise at single shapes.
    """

    id: str
    name: str
    rings_m: tuple[NDArray[np.float64], ...]
    anchor_m: tuple[float, float, float]
    attributes: dict[str, Attribute] = field(default_factory=dict)
    edits: tuple[Edit, ...] = ()


@dataclass(frozen=True)
class Lots:
    """The lots of one call, about `origin_m` in `crs`, and what gave none.

    look: where a visitor begins: eye and target (m, about the origin), if the lots know it.
    """

    lots: tuple[Lot, ...]
    crs: str | None = None
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    failures: tuple[Failure, ...] = ()
    notes: tuple[str, ...] = ()
    look: tuple[tuple[float, float, float], tuple[float, float, float]] | None = None


def read_lots(path: Path, options: LotOptions | None = None) -> Lots:
    """The lots in a file; InputError where it has none that can be used."""
    options = options or LotOptions()
    outlines, failures, notes, epsg = _outlines_of(path, options)
    if not outlines:
        reason = f" ({failures[0].reason})" if failures else ""
        raise InputError(path, f"has no lot that can be used{reason}", "Give it polygons.")
    if len(outlines) > MAX_LOTS:
        raise InputError(path, f"has more than {MAX_LOTS} polygons", "Cut it into several.")
    frame = find_frame(path, epsg, [outline.rings[0] for outline in outlines])
    terrain = read_terrain(options.terrain, frame.crs) if options.terrain is not None else None
    lots, more = place_lots(path, outlines, frame, terrain, options.ground)
    if terrain is not None:
        frame, lots = from_lowest(frame, lots)
    notes += frame.notes
    return Lots(lots, frame.crs, frame.origin_m, (*failures, *more), tuple(notes))


def require_lots(path: Path | None, options: LotOptions | None) -> None:
    """InputError where options say how to read a file of lots, but there is none."""
    if path is None and options is not None and options != LotOptions():
        changed = [name for name, value in options if value != getattr(LotOptions(), name)]
        raise InputError(f"--{changed[0]}", "is about a file of lots", "Give --lots, too.")


def _outlines_of(
    path: Path, options: LotOptions
) -> tuple[list[Outline], list[Failure], list[str], int | None]:
    """What the file has, whatever its format, and its EPSG code."""
    if is_package(path):
        return package_outlines(path, options.layer, MAX_LOTS)
    if path.suffix.lower() == ".gpkg" and path.is_file():
        raise InputError(path, "is no GeoPackage, though its name says so", "Save it anew as one.")
    if options.layer is not None:
        raise InputError(f"--layer {options.layer}", f"but {path} has no layers", "Leave it out.")
    if path.suffix.lower() == ".obj":
        outlines, failures = object_outlines(path, options.up)
        return outlines, failures, [f"OBJ: {options.up} is up, the unit is taken for metres"], None
    if _size(path) > MAX_BYTES:
        stream = FeatureStream(path)
        outlines, failures, notes = _of_features(path, stream.features())
        return outlines, failures, notes, named_crs(path, stream.members)
    document = _read_json(path)
    if document.get("type") == "CityJSON":
        outlines, failures = city_outlines(path, document)
        return outlines, failures, [], city_epsg(document)
    outlines, failures, notes = _of_features(path, _features(path, document))
    return outlines, failures, notes, named_crs(path, document)


def edited_lots(lots: Lots, path: Path, edits: Mapping[str, tuple[Edit, ...]]) -> Lots:
    """The lots with the edits of the file `path`; InputError where it names another lot."""
    ids = [lot.id for lot in lots.lots]
    for name in sorted(set(edits) - set(ids)):
        line = edits[name][0].where.rpartition(":")[2]
        near = difflib.get_close_matches(name, ids, n=1)
        hint = f"Did you mean `{near[0]}`?" if near else f"There are: {', '.join(ids[:12])}."
        raise InputError(path, f"line {line} edits the lot `{name}`, which is not there", hint)
    return replace(lots, lots=tuple(replace(lot, edits=edits.get(lot.id, ())) for lot in lots.lots))


def _size(path: Path) -> int:
    """Bytes of a file; 0 where there is none, which reading it tells."""
    try:
        return path.stat().st_size if path.is_file() else 0
    except OSError:
        return 0


def _of_features(
    path: Path, features: Iterable[Any]
) -> tuple[list[Outline], list[Failure], list[str]]:
    outlines, failures, others = _outlines(path, features)
    told = ", ".join(f"{count} {kind}" for kind, count in sorted(others.items()))
    notes = [f"left out, for they are no polygons: {told}"] if others else []
    return outlines, failures, notes


def place_lots(
    path: Path,
    outlines: list[Outline],
    frame: Frame,
    terrain: Terrain | None = None,
    ground: Ground = "lowest",
) -> tuple[tuple[Lot, ...], list[Failure]]:
    """Lots with rings that can be built on, each about its own anchor; the failures of others.

    A lot stands as high as its lowest corner, or as the terrain says where there is one.
    """
    found: list[Lot] = []
    failures: list[Failure] = []
    taken: set[str] = set()
    for outline in outlines:
        try:
            rings = [frame.local(ring) for ring in outline.rings]
            low = np.floor(rings[0].min(axis=0))
            level = float(min(ring[:, 2].min() for ring in rings))
            flat = clean_rings([ring[:, :2] - low[:2] for ring in rings])
            if terrain is not None:
                east, north, up = frame.origin_m
                own = [ring[:, :2] + (east, north) for ring in rings]
                level = terrain.under(own, ground) - up
        except (RingFault, NoGroundError) as fault:
            failures.append(Failure(subject=outline.subject, kind="input", reason=str(fault)))
            continue
        found.append(
            Lot(
                id=_own_id(outline.name, taken),
                name=outline.name,
                rings_m=tuple(flat),
                anchor_m=(float(low[0]), float(low[1]), level),
                attributes=outline.attributes,
            )
        )
    if not found:
        raise InputError(
            path, f"has no lot that can be used ({failures[0].reason})", "Mend its polygons."
        )
    _require_near(path, found)
    return tuple(found), failures


def from_lowest(frame: Frame, lots: tuple[Lot, ...]) -> tuple[Frame, tuple[Lot, ...]]:
    """Lots that stand on terrain, with heights about the lowest of them: it lies on the plane."""
    x, y, z = frame.origin_m
    up = height_origin(z + min(lot.anchor_m[2] for lot in lots))
    moved = [(*lot.anchor_m[:2], lot.anchor_m[2] + z - up) for lot in lots]
    placed = tuple(replace(lot, anchor_m=at) for lot, at in zip(lots, moved, strict=True))
    return replace(frame, origin_m=(x, y, up)), placed


def _require_near(path: Path, lots: list[Lot]) -> None:
    anchors = np.array([lot.anchor_m for lot in lots])
    extent_m = float(np.ptp(anchors[:, :2], axis=0).max())
    if extent_m > MAX_EXTENT_M:
        raise InputError(
            path,
            f"has lots that lie {extent_m / 1000:.0f} km apart, more than "
            f"{MAX_EXTENT_M / 1000:.0f} km",
            "Cut it into several, or check its coordinates.",
        )


def _own_id(name: str, taken: set[str]) -> str:
    """A name for files that no other lot has, on disks that do not tell case apart neither."""
    slug = re.sub(r"[^A-Za-z0-9_-]+", "-", name)[:80].strip("-") or "lot"
    unique, number = slug, 2
    while unique.lower() in taken:
        unique, number = f"{slug}-{number}", number + 1
    taken.add(unique.lower())
    return unique


def _read_json(path: Path) -> dict[str, Any]:
    try:
        require_file(path, MAX_BYTES)
        document = json.loads(path.read_bytes(), parse_constant=_refuse_constant)
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except OSError as error:
        raise InputError(
            path, f"cannot be read ({error.strerror})", "Check its permissions."
        ) from error
    except RecursionError as error:
        raise InputError(path, "is nested too deep", "Check that it is GeoJSON.") from error
    except ValueError as error:  # bad JSON, bad UTF-8, a number that is none
        raise InputError(path, f"is not JSON ({error})", "Save it as GeoJSON.") from error
    if not isinstance(document, dict):
        raise InputError(path, "is not GeoJSON: it is no object", "Save it as GeoJSON.")
    return document


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is not a number")


def _features(path: Path, document: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The features of a collection; a lone feature or polygon counts as one."""
    kind = document.get("type")
    if kind == "FeatureCollection":
        features = document.get("features")
        if not isinstance(features, list):
            raise InputError(path, "has no list of features", "Save it as GeoJSON.")
        yield from features
    elif kind == "Feature":
        yield document
    elif kind in ("Polygon", "MultiPolygon"):
        yield {"type": "Feature", "geometry": document, "properties": {}}
    else:
        raise InputError(
            path,
            f"is not GeoJSON of polygons: its type is {str(kind)[:40]!r}",
            "Give a FeatureCollection of polygons, CityJSON, GeoPackage or OBJ.",
        )


def _outlines(
    path: Path, features: Iterable[Any]
) -> tuple[list[Outline], list[Failure], Counter[str]]:
    """The polygons of all features, the faults of bad ones, and how many are something else."""
    found: list[Outline] = []
    failures: list[Failure] = []
    others: Counter[str] = Counter()
    for number, feature in enumerate(features, 1):
        if number > MAX_LOTS:
            raise InputError(path, f"has more than {MAX_LOTS} features", "Cut it into several.")
        subject = f"{path}: feature {number}"
        try:
            polygons, kind = _polygons(feature)
            if polygons is None:
                others[kind] += 1
                continue
            attributes = plain_attributes(feature.get("properties"))
            name = _name(feature, attributes, number)
            for index, polygon in enumerate(polygons, 1):
                rings = [numbers_of(ring) for ring in polygon]
                own = name if len(polygons) == 1 else f"{name}-{index}"
                found.append(Outline(f"{subject} ({own})", own, rings, attributes))
        except RingFault as fault:
            failures.append(Failure(subject=subject, kind="input", reason=str(fault)))
    return found, failures, others


def _polygons(feature: Any) -> tuple[list[list[Any]] | None, str]:
    """The polygons of a feature, each a list of rings; None and the kind of something else."""
    if not isinstance(feature, dict):
        raise RingFault("is no object")
    geometry = feature.get("geometry")
    if geometry is None:
        return None, "feature without geometry"
    if not isinstance(geometry, dict):
        raise RingFault("its geometry is no object")
    kind, coordinates = geometry.get("type"), geometry.get("coordinates")
    if kind not in ("Polygon", "MultiPolygon"):
        return None, str(kind)[:40]
    polygons = [coordinates] if kind == "Polygon" else coordinates
    if not isinstance(polygons, list) or not polygons:
        raise RingFault("has no coordinates")
    for polygon in polygons:
        if not isinstance(polygon, list) or not polygon:
            raise RingFault("has a polygon without rings")
    return polygons, str(kind)


def _name(feature: dict[str, Any], attributes: dict[str, Attribute], number: int) -> str:
    """What the file calls the feature, or its number."""
    for value in (feature.get("id"), attributes.get("id"), attributes.get("name")):
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if isinstance(value, str | int) and not isinstance(value, bool) and str(value).strip():
            return "".join(c for c in str(value).strip() if c.isprintable())[:_MAX_ID]
    return f"lot-{number}"
