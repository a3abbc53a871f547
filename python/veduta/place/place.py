"""A place in memory: parts where they stand, clouds, cameras and tours in one frame.

World frame: x east, y north, z up, metres from `origin_m` in `crs`. What is loaded from a folder is
read when it is asked for: a town of thousands of parts costs no more memory than what is looked at.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.place.camera_path import CameraPath
from veduta.place.files import Source, drawn_files, files_beside, names_apart, renamed
from veduta.place.holding import require_held
from veduta.place.manifest import (
    PlaceAnimal,
    PlaceCamera,
    PlacePart,
    PlaceSun,
    Start,
    Tour,
    Walk,
    joined,
)
from veduta.place.mesh import Mesh
from veduta.place.part import Part
from veduta.place.registry import folders, format_of, is_readable, reader_of
from veduta.place.same import same
from veduta.place.sunlight import Sunlight
from veduta.run.errors import InputError

Vector = tuple[float, float, float]


UNMOVED: NDArray[np.float64] = np.eye(4)
"""The transform of a part that was made in the frame of the place: the manifest need not say it."""
UNMOVED.setflags(write=False)


def _identity() -> NDArray[np.float64]:
    return np.eye(4)


@dataclass(frozen=True, eq=False)
class Standing:
    """Where a part stands in the place, and what it is there.

    transform: (4, 4) float64, world_from_part. document, photo, city_model: files in the place's
    folder; raw: there, a model of the part as it was recorded. ground: whether one walks on it.
    backdrop: a picture around the others.
    """

    name: str = ""
    transform: NDArray[np.float64] = field(default_factory=_identity)
    arrangement: Literal["single", "invented"] = "single"
    ground: bool = False
    backdrop: bool = False
    document: str | None = None
    photo: str | None = None
    city_model: str | None = None
    raw: str | None = None


@dataclass(frozen=True, eq=False)
class ModelFile:
    """The file of a part's model, where that is not left to those who save the place.

    name: below the place's folder. paths: tours that the model shows by itself, in the part's
    frame. sunlight: the sun that shines on it.
    """

    name: str
    paths: tuple[CameraPath, ...] = ()
    sunlight: Sunlight | None = None


@dataclass(eq=False)
class PlacedPart:
    """A part and where it stands. read: brings its content where that is not in memory yet."""

    id: str
    standing: Standing
    read: Callable[[], Part | Mesh]
    row: PlacePart | None = None
    """What a manifest says of it; None where the part was made in memory."""
    file: ModelFile | None = None
    """How its model is written; None: as those like who save the place."""
    lies: bool = False
    """Whether the model of its row lies where the place will be saved: it is not written again."""
    _content: Part | Mesh | None = None

    @staticmethod
    def standing_as(row: PlacePart, read: Callable[[], Part | Mesh]) -> PlacedPart:
        """As a row of a manifest says; read: brings the content of its model."""
        standing = Standing(
            row.name, np.array(row.transform).reshape(4, 4).T, row.arrangement, row.ground,
            row.backdrop, row.document, row.photo, row.city_model, row.raw,
        )  # fmt: skip
        return PlacedPart(row.id, standing, read, row)

    @property
    def content(self) -> Part | Mesh:
        """The polygons or triangles, in the part's own frame."""
        if self._content is None:
            self._content = self.read()
        return self._content

    def passing(self) -> Part | Mesh:
        """The content for those who look at one part after another: what is read is not kept."""
        return self.read() if self._content is None else self._content

    def save(self, folder: str | Path) -> PlacePart:
        """Write its model into the folder of a place; the row for `Place.lay`.

        So parts of a town are written one by one, and no place holds them all in memory. Its
        `file` says where; InputError where it has none, or is a part that no place can have.
        """
        return folders().save_part(self, Path(folder))

    def triangles(self) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
        """Vertices (v, 3) in the world (m), and triangles (m, 3), counter-clockwise from outside.

        Meshes that stand many times in a part are not among them: `place.flatten` writes them out.
        """
        content = self.content
        faces = content.triangles if isinstance(content, Mesh) else content.triangles.indices
        turn, move = self.standing.transform[:3, :3], self.standing.transform[:3, 3]
        return content.positions_m.astype(np.float64) @ turn.T + move, faces


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points of the place. points_m: (n, 3) float64, world. colours: (n, 3) uint8 sRGB.

    classes: (n,) uint8, ASPRS's numbers; None where nothing is known. seen_m: lower and upper
    corner around what is to be looked at; None: around nearly all points. layer: `distances` are
    other points again, in colours that show how far they lie from a model; they are shown in their
    place.
    """

    id: str
    points_m: NDArray[np.float64]
    colours: NDArray[np.uint8]
    classes: NDArray[np.uint8] | None = None
    seen_m: tuple[Vector, Vector] | None = None
    layer: Literal["points", "distances"] = "points"


@dataclass(eq=False)
class Place:
    """What every verb ends in, and what every format is written from."""

    title: str | None = None
    description: str | None = None
    author: str | None = None
    licence: str | None = None
    languages: tuple[str, ...] = ()
    crs: str | None = None
    origin_m: Vector = (0.0, 0.0, 0.0)
    scale: Literal["metres", "unknown"] = "metres"
    parts: dict[str, PlacedPart] = field(default_factory=dict)
    clouds: list[Cloud] = field(default_factory=list)
    cameras: list[PlaceCamera] = field(default_factory=list)
    tours: list[Tour] = field(default_factory=list)
    animals: list[PlaceAnimal] = field(default_factory=list)
    walks: list[Walk] = field(default_factory=list)
    sun: PlaceSun | None = None
    hidden: tuple[Literal["points", "cameras", "photos"], ...] = ()
    """What is not shown until a visitor asks for it."""
    start: Start | None = None
    """Where a visitor begins; None: chosen where the place is saved."""
    folder: Path | None = None
    """Where it was loaded from: the files that its cameras and parts name lie there."""
    tileset: str | None = None
    """Its tiles in that folder, where it has too many parts to be shown one by one."""
    files: dict[str, Source] = field(default_factory=dict)
    """Where the files that it names are. One that is not here lies where the place is saved."""
    notes: list[str] = field(default_factory=list)
    """What of the file that it was read from is not in it, and why."""
    held: list[object] = field(default_factory=list)
    """What is to live as long as the place, such as a folder that it is read from."""

    def add(
        self,
        part: Part | Mesh,
        standing: Standing | None = None,
        file: ModelFile | None = None,
        *,
        part_id: str | None = None,
    ) -> PlacedPart:
        """Put a part into the place; InputError where another has its id.

        file: how its model is written. part_id: what it is called here, if not by its own id.
        """
        placed = PlacedPart(part_id or part.id, standing or Standing(), lambda: part, file=file)
        self._add(placed)
        return placed

    def lay(self, row: PlacePart, folder: str | Path) -> PlacedPart:
        """Put a part into the place whose model is written already (`PlacedPart.save`).

        folder: where the model lies now. Where the place is saved it must lie, too: only the
        manifest is written of it. InputError where another part has its id.
        """
        model = Path(folder) / row.model
        placed = PlacedPart.standing_as(row, lambda: folders().read_model(model))
        placed.lies = True
        self._add(placed)
        return placed

    def _add(self, placed: PlacedPart) -> None:
        if placed.id in self.parts:
            raise InputError(placed.id, "is the id of two parts of a place", "Rename one of them.")
        self.parts[placed.id] = placed

    @staticmethod
    def load(path: str | Path) -> Place:
        """The place in a folder that a verb has written, or in a file of a format that is read.

        InputError where there is none.
        """
        source = Path(path)
        if not source.exists() and is_readable(source):
            raise InputError(source, "there is no such file", "Check its name.")
        if not source.is_file():
            return folders().load(source)
        return reader_of(source)(source)

    def save(self, folder: str | Path) -> None:
        """Write it as a folder that `veduta view` shows: `place.json`, models and clouds."""
        folders().save(self, Path(folder))

    def write(self, path: str | Path) -> None:
        """Write it as one file, in the format that its name asks for.

        A town in tiles is written from the city model beside them. InputError where the format
        could hold nothing of it.
        """
        target = Path(path)
        asked = format_of(target)
        whole = self.untiled()
        require_held(whole, asked, target)
        asked.write(whole, target)

    def untiled(self) -> Place:
        """The same with its buildings as parts, where it has tiles that hold many of them.

        They come from the city model that lies beside the tiles, with its classes, colours and
        pictures. InputError where there is none.
        """
        return folders().untiled(self)

    def merge(self, other: Place) -> Place:
        """Both as one, in the frame of this one; `place.manifest.merge` has the rules.

        What both have under one id is kept once. Files of the other whose names this one has for
        other files get new names. InputError where they are in different CRS, have no scale, or
        have two things of one id that differ.
        """
        if self.crs != other.crs:
            fault = f"is in another coordinate system ({other.crs}, not {self.crs})"
            raise InputError("the place", fault, "Bring both into one coordinate system first.")
        if "unknown" in (self.scale, other.scale):
            fault = "has no known scale"
            raise InputError("one of the places", fault, "Give it its scale first.")
        other = self.with_names_apart(other)
        shift = np.array(other.origin_m) - np.array(self.origin_m)
        move = shift.tolist()
        return replace(
            self, folder=None, tileset=None,
            parts=_joined_parts(self, other, shift),
            clouds=_joined_clouds(self.clouds, other.clouds, shift),
            cameras=joined("camera", self.cameras, other.cameras, move),
            tours=joined("tour", self.tours, other.tours, move),
            animals=joined("animal", self.animals, other.animals, move),
            walks=joined("walk", self.walks, other.walks, move),
            files={**other.sources(), **self.sources()},
            notes=list(dict.fromkeys([*self.notes, *other.notes])),
            held=[*self.held, *other.held],
        )  # fmt: skip

    def names(self) -> set[str]:
        """The files that it names: pictures, documents, models of walks; not those of its parts."""
        standings = [placed.standing for placed in self.parts.values()]
        return {*drawn_files(self.walks), *files_beside(standings, self.cameras, self.walks)}

    def sources(self) -> dict[str, Source]:
        """Where the files that it names are; what is not among them lies where it is saved."""
        return {name: self.files[name] for name in sorted(self.names()) if name in self.files}

    def with_names_apart(self, other: Place) -> Place:
        """The other with new names for its files whose names this one has for other files."""
        new = names_apart(
            {name: self.files.get(name) for name in sorted(self.names())},
            {name: other.files.get(name) for name in sorted(other.names())},
        )
        if not new:
            return other

        def name(old: str) -> str:
            return new.get(old, old)

        parts = {}
        for placed in other.parts.values():
            own = placed.standing
            standing = replace(
                own,
                document=own.document and name(own.document),
                photo=own.photo and name(own.photo),
                city_model=own.city_model and name(own.city_model),
                raw=own.raw and name(own.raw),
            )
            parts[placed.id] = replace(placed, standing=standing)
        return replace(
            other, parts=parts,
            cameras=[renamed(one, name) for one in other.cameras],
            walks=[renamed(one, name) for one in other.walks],
            files={name(old): source for old, source in other.files.items()},
        )  # fmt: skip

    def hold(self, what: object) -> None:
        """Keep something alive as long as this place, or a part of it that is still to be read."""
        self.held.append(what)
        for placed in self.parts.values():
            placed.read = partial(_read_holding, placed.read, what)

    def bounds_m(self) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
        """Lower and upper corner (m, world) around parts and clouds; None of an empty place."""
        corners = [_box(placed) for placed in self.parts.values()]
        corners += [
            np.quantile(cloud.points_m, [0.01, 0.99], axis=0)
            for cloud in self.clouds
            if len(cloud.points_m)
        ]
        if not corners:
            return None
        every = np.concatenate(corners)
        return every.min(axis=0), every.max(axis=0)


def _box(placed: PlacedPart) -> NDArray[np.float64]:
    """(8, 3) the corners of a part's box, in the world."""
    row = placed.row
    low, high = placed.content.bounds_m if row is None else (row.bounds.min, row.bounds.max)
    grid = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    turn, move = placed.standing.transform[:3, :3], placed.standing.transform[:3, 3]
    return np.asarray(grid @ turn.T + move, dtype=np.float64)


def _read_holding(read: Callable[[], Part | Mesh], held: object) -> Part | Mesh:
    """Read; what is held is alive at least until then."""
    return read()


def _joined_parts(first: Place, second: Place, shift: NDArray[np.float64]) -> dict[str, PlacedPart]:
    """The parts of both; InputError for two of one id that differ."""
    move = np.eye(4)
    move[:3, 3] = shift
    parts = dict(first.parts)
    for placed in second.parts.values():
        standing = replace(placed.standing, transform=move @ placed.standing.transform)
        moved = PlacedPart(placed.id, standing, placed.passing)
        known = parts.setdefault(placed.id, moved)
        if known is moved:
            continue
        alike = known is placed or known.read is placed.read
        if not same(known.standing, standing) or not (
            alike or same(known.passing(), placed.passing())
        ):
            raise _differ("part", placed.id)
    return parts


def _joined_clouds(
    first: list[Cloud], second: list[Cloud], shift: NDArray[np.float64]
) -> list[Cloud]:
    """The clouds of both; InputError for two of one id that differ."""
    kept: dict[str, Cloud] = {}
    for cloud in [*first, *(replace(one, points_m=one.points_m + shift) for one in second)]:
        if not same(kept.setdefault(cloud.id, cloud), cloud):
            raise _differ("cloud", cloud.id)
    return list(kept.values())


def _differ(kind: str, identity: str) -> InputError:
    fault = f"is the id of two {kind}s of a place, and the two differ"
    return InputError(identity, fault, "Rename one of them, or remove the one out of date.")
