"""`place.json`: the parts of a place, where they stand, and how two places become one."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Annotated, Literal, Self, TypeVar

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from veduta.place.same import same
from veduta.run.errors import InputError

VERSION = 1
IDENTITY: tuple[float, ...] = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)

FARTHEST_M = 1e7
"""No coordinate of a projected CRS is larger: from the equator to a pole it is 10,000 km."""

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Vector = tuple[Finite, Finite, Finite]
Matrix = Annotated[tuple[Finite, ...], Field(min_length=16, max_length=16)]


def _within_folder(path: str) -> str:
    """A manifest comes from outside: it may not reach outside of its folder."""
    parts = PurePosixPath(path).parts
    if not parts or path.startswith("/") or ".." in parts or "\\" in path or ":" in parts[0]:
        raise ValueError(f"{path!r} is not a path below the folder of place.json")
    return path


def _check_placement(transform: tuple[float, ...], what: str) -> None:
    """ValueError where a transform (4x4, column-major) puts something nowhere, or too far away."""
    matrix = np.array(transform).reshape(4, 4).T
    if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0] or np.linalg.det(matrix[:3, :3]) <= 0.0:
        raise ValueError(f"the transform of {what} is no placement in space")
    if np.abs(matrix).max() > FARTHEST_M:
        raise ValueError(f"the transform of {what} puts it more than {FARTHEST_M:,.0f} m away")


Words = Annotated[str, Field(max_length=10_000)]
RelativePath = Annotated[str, Field(min_length=1, max_length=1024), AfterValidator(_within_folder)]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class Bounds(_Record):
    """Axis-parallel box in the part's own frame (m)."""

    min: Vector
    max: Vector


class PlacePart(_Record):
    """One part: its files, relative to place.json, and where it stands."""

    id: str = Field(min_length=1, max_length=256, description="stable: a rebuild keeps it")
    name: str
    model: RelativePath = Field(description="glTF binary")
    city_model: RelativePath | None = Field(default=None, description="CityJSON")
    document: RelativePath | None = Field(default=None, description="what it was built from")
    photo: RelativePath | None = Field(default=None, description="the photo that textures it")
    raw: RelativePath | None = Field(
        default=None,
        description="glTF binary: the same as it was recorded, with what stood before it",
    )
    transform: Matrix = Field(
        default=IDENTITY, description="world_from_part, 4x4, column-major, metres"
    )
    arrangement: Literal["single", "invented"] = Field(
        description="invented: where it stands relative to the other parts is not known"
    )
    bounds: Bounds
    core: Bounds | None = Field(
        default=None,
        description="around nearly all of it, where a little of it lies far off: what one looks at",
    )
    ground: bool = Field(
        default=False, description="whether it is the ground between the others, on which one walks"
    )
    backdrop: bool = Field(
        default=False, description="whether it is a picture around the others: nobody bumps into it"
    )

    @model_validator(mode="after")
    def _stands_somewhere(self) -> Self:
        _check_placement(self.transform, f"part {self.id!r}")
        return self


class PlacePoints(_Record):
    """A cloud of points."""

    id: str = Field(min_length=1, max_length=256)
    file: RelativePath = Field(description="PLY with colours")
    layer: Literal["points", "distances"] = Field(
        default="points",
        description="distances: the points again, coloured by how far they lie from a model",
    )
    transform: Matrix = Field(
        default=IDENTITY, description="world_from_points, 4x4, column-major, metres"
    )
    count: int = Field(ge=0)
    bounds: Bounds = Field(description="around nearly all of the points; a few lie far off")

    @model_validator(mode="after")
    def _stands_somewhere(self) -> Self:
        _check_placement(self.transform, f"cloud {self.id!r}")
        return self


class PlaceCamera(_Record):
    """A photo in the place where it was taken. Camera frame: x right, y down, z forward."""

    id: str = Field(min_length=1, max_length=256)
    name: str = Field(description="the photo's file, as the user named it")
    picture: RelativePath = Field(description="the photo without the lens's distortion")
    width_px: int = Field(gt=0)
    height_px: int = Field(gt=0)
    focal_px: tuple[Positive, Positive] = Field(description="along x and y, of the picture")
    centre_px: tuple[Finite, Finite] = Field(description="principal point, of the picture")
    transform: Matrix = Field(description="world_from_camera, 4x4, column-major")

    @model_validator(mode="after")
    def _stands_somewhere(self) -> Self:
        _check_placement(self.transform, f"camera {self.id!r}")
        return self


class TourStretch(_Record):
    """A time of a tour in one room, or in none (`room` is null)."""

    room: str | None = Field(default=None, max_length=256, description="id in the document")
    name: str = Field(max_length=256, description="what the room is called")
    start_s: Finite
    end_s: Finite


class Tour(_Record):
    """A guided tour: where the eye is and looks, key by key.

    Between two keys the eye moves on a straight line, and the direction turns the shorter way at an
    even pace.
    """

    id: str = Field(min_length=1, max_length=256)
    name: str
    times_s: list[Finite] = Field(min_length=2, max_length=100_000, description="ascending, from 0")
    eyes: list[Vector] = Field(description="one for each time (m, world frame)")
    directions: list[Vector] = Field(description="unit vectors, one for each time")
    stretches: list[TourStretch] = Field(
        default=[], max_length=10_000, description="the rooms passed, in the order of the tour"
    )
    shut: list[str] = Field(
        default=[],
        max_length=10_000,
        description="ids of features: doors that stay closed on it, as their leaves bar its way",
    )

    @model_validator(mode="after")
    def _columns_belong_together(self) -> Self:
        count = len(self.times_s)
        if len(self.eyes) != count or len(self.directions) != count:
            raise ValueError(f"tour {self.id!r} has not one eye and one direction for each time")
        times = np.array(self.times_s)
        if times[0] != 0.0 or (np.diff(times) <= 0.0).any():
            raise ValueError(f"the times of tour {self.id!r} do not ascend from 0")
        if np.abs(np.linalg.norm(self.directions, axis=1) - 1.0).max() > 1e-3:
            raise ValueError(f"the directions of tour {self.id!r} are no unit vectors")
        return self


class AnimalClip(_Record):
    """A motion of an animal, straight along +x of its part."""

    name: str = Field(max_length=256, description="of the animation in the part's model")
    seconds: Positive = Field(description="how long it is")
    stride: Finite = Field(description="how far the animal goes in it (m)")
    loops: bool = Field(default=False, description="whether it begins anew without a jump")


class PlaceAnimal(_Record):
    """A part that moves along a path: its skeleton is bent along the path's curve.

    At rest it lies along +x of its part, over the origin, its ground at z = 0.
    """

    id: str = Field(min_length=1, max_length=256)
    name: str = Field(max_length=256)
    part: str = Field(max_length=256, description="id of the part that is the animal")
    root: str = Field(
        default="root", max_length=256, description="the joint that carries the way forwards"
    )
    length: Positive = Field(description="from head to tail (m)")
    swims: bool = Field(
        default=False, description="whether it keeps its height and does not lie on the ground"
    )
    clips: list[AnimalClip] = Field(min_length=1, max_length=100, description="the usual one first")
    path: list[Vector] = Field(
        min_length=2, max_length=100_000, description="on the ground, in its order (m, world frame)"
    )
    closed: bool = Field(default=False, description="whether the path ends where it begins")
    turns: list[Annotated[int, Field(ge=0)]] | None = Field(
        default=None,
        max_length=1000,
        description="numbers of the path's points at which it turns on the spot, from 0; null: it"
        " goes in curves alone, as animals without legs do",
    )


class WalkKey(_Record):
    """A position on the way of a walk. Camera frame: x right, y down, z forward."""

    id: str = Field(min_length=1, max_length=256)
    picture: RelativePath = Field(description="what is seen there, without the lens's distortion")
    width_px: int = Field(gt=0)
    height_px: int = Field(gt=0)
    focal_px: tuple[Positive, Positive] = Field(description="along x and y, of the picture")
    centre_px: tuple[Finite, Finite] = Field(description="principal point, of the picture")
    transform: Matrix = Field(description="world_from_camera, 4x4, column-major")
    projection: Literal["plane", "cylinder"] = Field(
        default="plane",
        description="of the picture; a cylinder's axis is the camera's y, its x angles times the"
        " focal length, its y heights over the distance from the axis times the focal length",
    )


class WalkTransition(_Record):
    """The way between two key positions, and how one view becomes the other."""

    start: int = Field(ge=0, description="number of the key position where it begins")
    end: int = Field(ge=0, description="number of the one where it ends")
    kind: Literal["morph", "fade", "cut"]
    forth: RelativePath | None = Field(
        default=None,
        description="glTF of the start's model, in its camera's frame: a morph target of where it"
        " ends, and a second set of texture coordinates in the end's picture",
    )
    back: RelativePath | None = Field(default=None, description="the same of the end's model")
    score_db: Finite | None = Field(
        default=None, description="how well one end's view was predicted from the other's (PSNR)"
    )

    @model_validator(mode="after")
    def _morphs_have_models(self) -> Self:
        if self.kind == "morph" and (self.forth is None or self.back is None):
            raise ValueError("a transition that morphs names no models")
        return self


class Walk(_Record):
    """A way along key positions on which geometry and texture morph from view to view."""

    id: str = Field(min_length=1, max_length=256)
    name: str
    document: RelativePath | None = None
    speed_m_s: Positive = Field(default=1.4, description="at which it is played")
    keys: list[WalkKey] = Field(min_length=1, max_length=20_000)
    transitions: list[WalkTransition] = Field(max_length=100_000)

    @model_validator(mode="after")
    def _transitions_are_between_keys(self) -> Self:
        if any(max(one.start, one.end) >= len(self.keys) for one in self.transitions):
            raise ValueError(f"a transition of walk {self.id!r} has an end that is not there")
        return self


class PlaceSun(_Record):
    """Where the place is on the earth and when it is looked at: by these the sun stands."""

    latitude_deg: Annotated[Finite, Field(ge=-90, le=90)] | None = None
    longitude_deg: Annotated[Finite, Field(ge=-180, le=180)] | None = None
    time: Annotated[str, Field(max_length=64)] | None = Field(
        default=None, description="ISO 8601 with an offset; null where the place is not known"
    )
    assumed: list[Literal["north", "place", "time"]] = Field(
        default=[], max_length=3, description="what of it nobody has said; north: that it is +y"
    )


class Start(_Record):
    """Where a visitor begins (m, world frame)."""

    eye: Vector
    target: Vector


class Place(_Record):
    """The manifest. World frame: x east, y north, z up, metres from `origin` in `crs`."""

    schema_: Literal["veduta/place"] = Field(default="veduta/place", alias="schema")
    version: Literal[1] = 1
    title: Words | None = Field(default=None, description="what the place is called")
    description: Words | None = Field(default=None, description="what it shows, in a few sentences")
    author: Words | None = Field(default=None, description="who made it")
    licence: Words | None = Field(default=None, description="SPDX expression, or plain words")
    languages: list[Annotated[str, Field(max_length=35)]] = Field(
        default=[], max_length=100, description="of the texts (BCP 47)"
    )
    crs: str | None = Field(default=None, description="EPSG code; null where none is known")
    origin: Vector = (0.0, 0.0, 0.0)
    parts: list[PlacePart] = Field(max_length=1_000_000)
    tileset: RelativePath | None = Field(
        default=None,
        description="3D Tiles of all parts together: what is shown where they are too many",
    )
    points: list[PlacePoints] = Field(default=[], max_length=1000)
    cameras: list[PlaceCamera] = Field(default=[], max_length=100_000)
    tours: list[Tour] = Field(default=[], max_length=100)
    animals: list[PlaceAnimal] = Field(default=[], max_length=1000)
    walks: list[Walk] = Field(default=[], max_length=100)
    scale: Literal["metres", "unknown"] = Field(
        default="metres", description="unknown: the unit of length is not the metre, but any"
    )
    sun: PlaceSun | None = Field(default=None, description="null: nothing is known of it")
    hidden: list[Literal["points", "cameras", "photos"]] = Field(
        default=[],
        max_length=3,
        description="what is not shown until a visitor asks for it; photos: that they fade in",
    )
    start: Start

    @model_validator(mode="after")
    def _ids_are_unique(self) -> Self:
        for kind, items in (
            ("parts", self.parts), ("cameras", self.cameras), ("tours", self.tours),
            ("animals", self.animals), ("walks", self.walks), ("clouds", self.points),
        ):  # fmt: skip
            seen: set[str] = set()
            for item in items:
                if item.id in seen:
                    raise ValueError(f"two {kind} have the id {item.id!r}")
                seen.add(item.id)
        known = {part.id for part in self.parts}
        for animal in self.animals:
            if animal.part not in known:
                raise ValueError(f"the part of animal {animal.id!r} is not there")
        return self


LATER = frozenset(
    {"title", "description", "author", "licence", "languages", "animals", "walks", "hidden"}
)
"""What manifests have said only since some time: it is left out of the file where nothing is said,
so that places that say nothing of it are written as they were."""

Item = TypeVar("Item", PlacePart, PlacePoints, PlaceCamera, Tour, PlaceAnimal, Walk)
_FILES = {"model", "city_model", "document", "photo", "raw", "file", "picture", "forth", "back"}


def merge(first: Place, second: Place, second_folder: str = "") -> Place:
    """Join two places into one in the frame of the first.

    The rule: both are in the same CRS (or both in none), and both have a scale. Parts, points,
    cameras, tours and walks of the second move by the difference of the origins, and their files
    are looked for below `second_folder`. One that both have under one id is kept once if it is the
    same in all that it says, and refused otherwise: an id names one thing. They keep their order,
    the first place's before the second's; the start and the sun are the first's.
    """
    if first.crs != second.crs:
        raise InputError(
            "place.json",
            f"the places are in different coordinate systems ({first.crs} and {second.crs})",
            "Bring both into one coordinate system first.",
        )
    if "unknown" in (first.scale, second.scale):
        raise InputError(
            "place.json",
            "the scale of one of the places is not known",
            "Give it its scale first: nothing says how large it is beside the other.",
        )
    shift = (np.array(second.origin) - np.array(first.origin)).tolist()
    update: dict[str, object] = {
        "parts": joined("part", first.parts, second.parts, shift, second_folder),
        "points": joined("cloud", first.points, second.points, shift, second_folder),
        "cameras": joined("camera", first.cameras, second.cameras, shift, second_folder),
        "tours": joined("tour", first.tours, second.tours, shift, second_folder),
        "animals": joined("animal", first.animals, second.animals, shift, second_folder),
        "walks": joined("walk", first.walks, second.walks, shift, second_folder),
        "tileset": None,  # the tiles of one do not show the other
    }
    return first.model_copy(update=update)


def joined(
    kind: str, first: list[Item], second: list[Item], shift_m: list[float], folder: str = ""
) -> list[Item]:
    """The items of both, those of the second moved (m) and their files below `folder`.

    What is there twice under one id is kept once; InputError where the two differ, or where one
    comes to lie too far away.
    """
    moved: list[Item] = []
    try:
        moved += [_moved(item, shift_m, folder) for item in second]
    except ValidationError as error:
        fault = f"has a {kind} that cannot be moved there ({error.errors()[0]['msg']})"
        raise InputError("place.json", fault, "Look at the origins of both places.") from error
    items: dict[str, Item] = {}
    for item in first + moved:
        if not same(items.setdefault(item.id, item), item):
            raise InputError(
                "place.json",
                f"both places have a {kind} {item.id!r}, and the two differ",
                "Rename one of them, or remove the one that is out of date.",
            )
    return list(items.values())


def _moved(item: Item, shift_m: list[float], folder: str) -> Item:
    update: dict[str, object]
    if isinstance(item, Tour):
        update = {"eyes": (np.array(item.eyes) + shift_m).tolist()}
        return type(item).model_validate(item.model_dump() | update)
    if isinstance(item, PlaceAnimal):
        update = {"path": (np.array(item.path) + shift_m).tolist()}
        return type(item).model_validate(item.model_dump() | update)
    if isinstance(item, Walk):
        keys = [one.model_copy(update=_placed(one, shift_m, folder)) for one in item.keys]
        ways = [one.model_copy(update=_filed(one, folder)) for one in item.transitions]
        update = {"keys": keys, "transitions": ways, **_filed(item, folder)}
        return item.model_copy(update=update)
    return type(item).model_validate(item.model_dump() | _placed(item, shift_m, folder))


def _placed(
    item: PlacePart | PlacePoints | PlaceCamera | WalkKey, shift_m: list[float], folder: str
) -> dict[str, object]:
    transform = list(item.transform)
    for axis in range(3):
        transform[12 + axis] += shift_m[axis]
    return {"transform": tuple(transform), **_filed(item, folder)}


def _filed(item: BaseModel, folder: str) -> dict[str, object]:
    """The files of an item, below the folder."""
    update: dict[str, object] = {}
    for field in _FILES & set(type(item).model_fields):
        path = getattr(item, field)
        if path is not None and folder:
            update[field] = str(PurePosixPath(folder) / path)
    return update
