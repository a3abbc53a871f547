"""A place as a folder: `place.json`, a GLB of each part, a PLY of each cloud."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from veduta.formats.gltf import write_glb
from veduta.formats.mesh_glb import write_mesh_glb
from veduta.formats.mesh_glb_read import read_model
from veduta.formats.place_json import read_place, write_place
from veduta.formats.ply import read_points, write_points
from veduta.place import manifest
from veduta.place.files import Source, copies, drawn_files, files_beside
from veduta.place.mesh import Mesh
from veduta.place.part import Part
from veduta.place.place import UNMOVED, Cloud, Place, PlacedPart
from veduta.run.errors import InputError

MANIFEST = "place.json"
PARTS = "parts"
EYE_HEIGHT_M = 1.7
# Nearly all of a measured surface, and how much smaller its box is where strays widen the whole.
CORE_QUANTILES = (0.02, 0.98)
CORE_SHARE = 0.7


def save_place(place: Place, folder: Path) -> None:
    """Write all of it into a folder, with the files that it names from where it was loaded.

    Files that a place made in memory names must lie in the folder already, or come there later, as
    must models that are said to lie there.

    InputError, before anything is written, for what no manifest can say (two things of one id, a
    part too far away), for a part without a surface, and for files that are not there.
    """
    names = _FileNames([*place.names(), *_given_names(place)])
    models = [
        _given_name(one) or names.free(f"{PARTS}/", one.id, ".glb") for one in place.parts.values()
    ]
    clouds = [names.free("", one.id, ".ply") for one in place.clouds]
    described = _described(place, models, clouds)
    brought = copies(place.sources(), folder)
    folder.mkdir(parents=True, exist_ok=True)
    for source, target in brought:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
    for placed, name in zip(place.parts.values(), models, strict=True):
        if not placed.lies:
            _write_model(placed, folder / name)
    for cloud, name in zip(place.clouds, clouds, strict=True):
        write_points(cloud.points_m, cloud.colours, folder / name)
    write_place(described, folder / MANIFEST)


def save_part(placed: PlacedPart, folder: Path) -> manifest.PlacePart:
    """Write the model of a part alone, for a place that does not hold it; its row in the manifest.

    InputError where it is a part that no place can have, or nothing says how its file is called.
    """
    if placed.file is None:
        raise InputError(placed.id, "is a part whose model has no name", "Say which file it gets.")
    _require_surface(placed)
    try:
        row = _part_row(placed, placed.file.name)
    except ValidationError as error:
        raise _no_place(placed.id, error) from error
    _write_model(placed, folder / row.model)
    return row


def _write_model(placed: PlacedPart, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    content, file = placed.content, placed.file
    if isinstance(content, Mesh):
        write_mesh_glb(content, path)
    elif file is None:
        write_glb(content, path)
    else:
        write_glb(content, path, file.paths, file.sunlight)


def _given_name(placed: PlacedPart) -> str | None:
    """The file of a part's model, where that is said."""
    if placed.lies and placed.row is not None:
        return placed.row.model
    return None if placed.file is None else placed.file.name


def _given_names(place: Place) -> list[str]:
    """All of them; InputError where two parts would be written into one file."""
    written: set[str] = set()
    given = []
    for placed in place.parts.values():
        name = _given_name(placed)
        if name is None:
            continue
        given.append(name)
        if placed.lies:  # one model may stand several times
            continue
        if name.casefold() in written:
            raise InputError(
                placed.id, f"has its model in {name}, as another part has", "Name one."
            )
        written.add(name.casefold())
    return given


def _require_surface(placed: PlacedPart) -> None:
    content = placed.content
    instances = None if isinstance(content, Mesh) else content.instances
    if not len(content.positions_m) and instances is None:
        fault = "is a part without a surface, which no model can hold"
        raise InputError(placed.id, fault, "Leave it out of the place.")


def _no_place(title: str, error: ValidationError) -> InputError:
    """What of a place no manifest can say."""
    first = error.errors()[0]
    where = ".".join(str(step) for step in first["loc"])
    fault = f"cannot be written as a place ({f'{where}: ' if where else ''}{first['msg']})"
    return InputError(title, fault, "Change that in the place.")


def _described(place: Place, models: list[str], clouds: list[str]) -> manifest.Place:
    """What the manifest says; InputError where that is no place."""
    for placed in place.parts.values():
        if not placed.lies:
            _require_surface(placed)
    try:
        return manifest.Place(
            title=place.title,
            description=place.description,
            author=place.author,
            licence=place.licence,
            languages=list(place.languages),
            crs=place.crs,
            origin=place.origin_m,
            tileset=place.tileset if any(one.lies for one in place.parts.values()) else None,
            parts=[_part_row(*one) for one in zip(place.parts.values(), models, strict=True)],
            points=[_cloud_row(*one) for one in zip(place.clouds, clouds, strict=True)],
            cameras=place.cameras,
            tours=place.tours,
            animals=place.animals,
            walks=place.walks,
            scale=place.scale,
            sun=place.sun,
            hidden=list(place.hidden),
            start=place.start or chosen_start(place),
        )
    except ValidationError as error:
        raise _no_place(place.title or "the place", error) from error


def load_place(folder: Path) -> Place:
    """The place in a folder; its parts are read when they are asked for.

    InputError where there is no place, or its manifest is broken.
    """
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", "Name one that Veduta wrote.")
    told = read_place(folder / MANIFEST)
    place = Place(
        told.title, told.description, told.author, told.licence, tuple(told.languages),
        told.crs, told.origin, told.scale, cameras=told.cameras, tours=told.tours,
        walks=told.walks, sun=told.sun, hidden=tuple(told.hidden), start=told.start,
        folder=folder, tileset=told.tileset, animals=told.animals,
    )  # fmt: skip
    beside = files_beside(told.parts, told.cameras, told.walks)
    place.files = {name: Source(folder, name) for name in [*drawn_files(told.walks), *beside]}
    for row in told.parts:
        place.parts[row.id] = _placed(row, folder)
    for cloud in told.points:
        points, colours = read_points(folder / cloud.file)
        matrix = np.array(cloud.transform).reshape(4, 4).T
        world = points @ matrix[:3, :3].T + matrix[:3, 3]
        place.clouds.append(Cloud(cloud.id, world, colours, layer=cloud.layer))
    return place


def chosen_start(place: Place) -> manifest.Start:
    """A view of the whole from the south-west, a little from above; at eye height where it fits."""
    box = place.bounds_m()
    if place.walks:
        return _walk_start(place.walks[0])
    if box is None:
        return manifest.Start(eye=(0.0, -5.0, EYE_HEIGHT_M), target=(0.0, 0.0, EYE_HEIGHT_M))
    middle, size = (box[0] + box[1]) / 2.0, float(np.linalg.norm(box[1] - box[0]))
    eye = middle + size * np.array([-0.45, -0.95, 0.35])
    return manifest.Start(eye=_vector(eye), target=_vector(middle))


def _walk_start(walk: manifest.Walk) -> manifest.Start:
    """Where the way begins, and as one looks there."""
    matrix = np.array(walk.keys[0].transform).reshape(4, 4).T
    eye, ahead = matrix[:3, 3], matrix[:3, 2]
    return manifest.Start(eye=_vector(eye), target=_vector(eye + 5.0 * ahead))


class _FileNames:
    """Names that every file system takes; no two are one where case does not count."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = {MANIFEST, *(name.casefold() for name in taken)}

    def free(self, above: str, identity: str, suffix: str) -> str:
        """A name for what has this id, with a number where the id alone is none or is taken."""
        plain = re.sub(r"[^A-Za-z0-9_-]+", "-", identity).strip("-")[:64]
        name = f"{above}{plain}{suffix}"
        number = 0
        while plain != identity or name.casefold() in self._taken:
            name = f"{above}{plain or 'part'}-{number}{suffix}"
            if name.casefold() not in self._taken:
                break
            number += 1
        self._taken.add(name.casefold())
        return name


def _part_row(placed: PlacedPart, model: str) -> manifest.PlacePart:
    standing, row = placed.standing, placed.row
    if row is not None and placed.lies:
        bounds, core = row.bounds, row.core
    else:
        low, high = placed.content.bounds_m
        bounds, core = manifest.Bounds(min=low, max=high), _core_of(placed.content)
    moved: dict[str, manifest.Matrix] = {}
    if standing.transform is not UNMOVED:
        moved["transform"] = tuple(standing.transform.T.ravel().tolist())
    found = manifest.PlacePart(
        id=placed.id,
        name=standing.name or placed.id,
        model=model,
        city_model=standing.city_model,
        document=standing.document,
        photo=standing.photo,
        raw=standing.raw,
        arrangement=standing.arrangement,
        bounds=bounds,
        core=core,
        ground=standing.ground,
        backdrop=standing.backdrop,
        **moved,
    )
    if placed.lies and row is not None and row.transform == found.transform:
        return found.model_copy(update={"transform": row.transform})  # spelt as it was
    return found


def _core_of(content: Part | Mesh) -> manifest.Bounds | None:
    """The box around nearly all of a surface; None where it is little smaller than the whole.

    Surfaces from photos and scans trail away into strays: with those in view, the thing is small.
    """
    if not isinstance(content, Mesh) or len(content.positions_m) == 0:
        return None
    low, high = np.quantile(content.positions_m, CORE_QUANTILES, axis=0)
    whole = np.linalg.norm(np.ptp(content.positions_m, axis=0))
    if float(np.linalg.norm(high - low)) > CORE_SHARE * float(whole):
        return None
    return manifest.Bounds(min=_vector(low), max=_vector(high))


def _cloud_row(cloud: Cloud, name: str) -> manifest.PlacePoints:
    """The bounds are around nearly all points: few strays would make the place look empty."""
    seen = np.zeros((2, 3))
    if cloud.seen_m is not None:
        seen = np.array(cloud.seen_m)
    elif len(cloud.points_m):
        seen = np.quantile(cloud.points_m, CORE_QUANTILES, axis=0)
    bounds = manifest.Bounds(min=_vector(seen[0]), max=_vector(seen[1]))
    count = len(cloud.points_m)
    return manifest.PlacePoints(
        id=cloud.id, file=name, layer=cloud.layer, count=count, bounds=bounds
    )


def _placed(row: manifest.PlacePart, folder: Path) -> PlacedPart:
    return PlacedPart.standing_as(row, lambda: read_model(folder / row.model))


def _vector(values: NDArray[np.float64]) -> manifest.Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
