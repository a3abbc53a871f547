"""The buildings of a city model as a place, with the colours and pictures that it has for them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.formats.building_faces import BuildingFaces, CityFile, FaceLook, SurfaceTold
from veduta.formats.citygml_read import read_citygml
from veduta.formats.cityjson_read import read_cityjson
from veduta.imaging.read import read_image
from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Material, Texture
from veduta.place.part import PLANE_TOLERANCE_M, Part
from veduta.place.place import Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

LEFT_OUT = "polygons_left_out"
"""Attribute of a building: how many cannot be drawn."""
MOST_TOLD = 20
"""Notes of a place that name what is left out one by one."""
WARPED_M = 0.005
"""A face whose corners leave its mean plane by more is cut into triangles between them."""
MOST_PICTURE_PIXELS = 2**27
"""Of all pictures of a file together: 400 MB in memory."""
UNREAD = "cannot be read"
Rings = list[NDArray[np.float64]]


def read_city_place(path: Path) -> Place:
    """The buildings of a CityJSON or CityGML file, each a part; its notes say what is left out."""
    city = (
        read_citygml(path)
        if path.suffix.lower() == ".gml"
        else read_cityjson(path, installations=True)
    )
    if not city.buildings:
        raise InputError(path, "has no building with polygons", "Choose a model of LoD1 or above.")
    place = Place(title=path.stem, crs=None if city.epsg is None else f"EPSG:{city.epsg}")
    left = list(city.left)
    low = _low(city)
    pictures = _Pictures(path.parent)
    place.origin_m = (float(low[0]), float(low[1]), float(low[2]))
    for building in city.buildings:
        own = np.concatenate([ring for rings in building.polygons for ring in rings]).min(axis=0)
        matrix = np.eye(4)
        matrix[:3, 3] = own - low
        name = str(building.attributes.get("name", building.id))
        part = _building(building, own, pictures)
        if part is None:
            left.append((building.id, "has no polygon that can be drawn"))
            continue
        if part.notes:
            left.append((building.id, "; ".join(part.notes)))
        place.add(part, Standing(name=name, transform=matrix))
    if not place.parts:
        raise InputError(path, "has no polygon that can be drawn", "Check its coordinates.")
    place.notes += [*city.notes, *pictures.notes(), *_named(left)]
    return place


def _named(left: Sequence[tuple[str, str]]) -> Iterator[str]:
    """What is not in the place, as notes."""
    yield from (f"left out: {name}: {reason}" for name, reason in left[:MOST_TOLD])
    if len(left) > MOST_TOLD:
        yield f"left out: {len(left) - MOST_TOLD:,} more"


class _Pictures:
    """The pictures that a file names, each read once; those that cannot be used are counted."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[str, Texture | None] = {}
        self._pixels = 0
        self._faults: Counter[str] = Counter()
        self._first_unread = ""

    def __getitem__(self, name: str) -> Texture | None:
        if name not in self._known:
            self._known[name] = self._read(name)
        return self._known[name]

    def _read(self, name: str) -> Texture | None:
        path = PurePosixPath(name.replace("\\", "/"))
        if "://" in name or path.is_absolute() or ".." in path.parts or ":" in name[:2]:
            self._faults["lie outside of its folder"] += 1
            return None
        if self._pixels >= MOST_PICTURE_PIXELS:
            self._faults[f"are more than {MOST_PICTURE_PIXELS:,} pixels together"] += 1
            return None
        try:
            pixels = read_image(self._folder / path).pixels
        except (InputError, OSError, ValueError):  # also names that no file can have
            self._first_unread = self._first_unread or name[:200]
            self._faults[UNREAD] += 1
            return None
        self._pixels += pixels.shape[0] * pixels.shape[1]
        return Texture(pixels, np.zeros(pixels.shape[:2], dtype=np.bool_))

    def notes(self) -> Iterator[str]:
        """What is not shown, and why."""
        for fault, count in self._faults.items():
            example = f", such as {self._first_unread!r}" if fault is UNREAD else ""
            yield f"left out: {count:,} pictures that {fault}{example}"


def _low(city: CityFile) -> NDArray[np.float64]:
    low = [ring.min(axis=0) for one in city.buildings for rings in one.polygons for ring in rings]
    least: NDArray[np.float64] = np.floor(np.min(low, axis=0))
    return least


def _building(
    building: BuildingFaces, origin: NDArray[np.float64], pictures: _Pictures
) -> Part | None:
    """None where none of its polygons can be drawn."""
    builder = PartBuilder(building.id)
    builder.attributes |= dict(building.attributes)
    builder.attributes.pop(LEFT_OUT, None)
    left = 0
    told = building.attributes.get("provenance")
    known_by = Provenance(told) if told in set(Provenance) else Provenance.MEASURED
    materials: dict[Material, int] = {}
    features: dict[int | SemanticClass, int] = {}
    named: dict[str, int] = {}
    rows = building.surface or (-1,) * len(building.polygons)
    looks = building.looks or (None,) * len(building.polygons)
    each = zip(building.polygons, building.classes, rows, looks, strict=True)
    for rings, known, row, look in each:
        semantic = known or SemanticClass.OTHER
        said = building.surfaces[row] if row >= 0 else SurfaceTold(known)
        # A file that tells of no surface more than its class has one of each class.
        key = row if said.name or said.colour else semantic
        if key not in features:
            name = said.name or semantic.value
            count = named[name] = named.get(name, 0) + 1
            name = name if count == 1 else f"{name} {count}"
            features[key] = builder.feature(semantic, known_by, name)
        material = _material(semantic, said, look, pictures)
        if material not in materials:
            materials[material] = builder.material(material)
        own = [ring - origin for ring in rings]
        corners = list(look.corners) if look and material.texture else None
        kept = [piece for piece in _flat(own, corners) if _is_sound(piece[0])]
        left += not kept
        for piece, mapped in kept:
            uv = None if mapped is None else _in_turn(mapped)
            builder.polygon(piece, features[key], materials[material], uv)
    if left:
        builder.attributes[LEFT_OUT] = left
        builder.notes.append(f"{left} of {len(building.polygons)} polygons cannot be drawn")
    return builder.build() if builder.polygon_count else None


def _material(
    semantic: SemanticClass, said: SurfaceTold, look: FaceLook | None, pictures: _Pictures
) -> Material:
    """A picture as it is; without one the colour that the surface or its material has."""
    texture = pictures[look.picture] if look and look.picture else None
    opacity = look.opacity if look else 1.0
    if texture is not None:
        return Material(semantic.value, texture=texture, opacity=opacity)
    own = look.colour if look else None
    return Material(semantic.value, said.colour or own or (1.0, 1.0, 1.0), opacity=opacity)


def _in_turn(corners: Rings) -> UvMap:
    """Those of each ring when it is asked for, from the upper left as glTF has them."""
    each = iter(corners)
    return lambda _: next(each) * (1.0, -1.0) + (0.0, 1.0)


def _is_sound(rings: Rings) -> bool:
    """Whether it can be triangulated: whole millimetres make slivers cross themselves."""
    points, ends, whole = _columns(rings)
    points = points.astype(np.float32).astype(np.float64)
    return bool(_core.sound_polygons(points, ends, whole, PLANE_TOLERANCE_M)[0])


def _columns(
    rings: Rings,
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """One polygon's corners, the first of each ring, and the first ring."""
    ends = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])]).astype(np.int64)
    return np.concatenate(rings), ends, np.array([0, len(rings)], dtype=np.int64)


def _flat(rings: Rings, corners: Rings | None) -> list[tuple[Rings, Rings | None]]:
    """The polygon on its mean plane where whole millimetres warp it; of one that is warped more
    triangles between its corners as they are, cut where they do not overlap on that plane. corners:
    where the rings' corners lie on a picture, if they do.
    """
    ring = rings[0]
    middle = ring.mean(axis=0)
    after = np.roll(ring, -1, axis=0)
    normal = np.cross(ring - middle, after - middle).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0.0:
        return [(rings, corners)]
    normal = normal / length
    off = max(float(np.abs((one - middle) @ normal).max()) for one in rings)
    if off <= 0.5 * PLANE_TOLERANCE_M:
        return [(rings, corners)]
    level = [one - ((one - middle) @ normal)[:, None] * normal for one in rings]
    return [(level, corners)] if off <= WARPED_M else _cut(rings, level, corners)


def _cut(rings: Rings, level: Rings, corners: Rings | None) -> list[tuple[Rings, Rings | None]]:
    """Triangles of the corners, as those of the level polygon lie; none where it crosses itself."""
    points, ends, whole = _columns(level)
    if not _core.sound_polygons(points, ends, whole, PLANE_TOLERANCE_M)[0]:
        return []
    indices, _, _, _ = _core.triangulate_polygons(points, ends, whole, PLANE_TOLERANCE_M)
    own = np.concatenate(rings)
    mapped = None if corners is None else np.concatenate(corners)
    return [([own[row]], None if mapped is None else [mapped[row]]) for row in indices]
