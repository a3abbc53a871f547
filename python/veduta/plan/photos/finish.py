"""What photos found goes into the document: the paint and the tiles of their rooms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.plan.document import PhotoFile, PlanDocument, Room, Tiling, WallColour
from veduta.plan.house.finishes import rooms_of
from veduta.plan.house.looks import TILED
from veduta.plan.photos.given import Place, RoomPhoto, place_of
from veduta.plan.photos.look import Look, look_at
from veduta.plan.photos.tiles import Surface, TilesSeen
from veduta.run.digests import file_digest


@dataclass(frozen=True)
class Finished:
    """The document with the finishes; what was seen in each photo.

    pictures: of tiles, by name; also those that only the document in OUT names, where it stays.
    """

    document: PlanDocument
    pictures: dict[str, NDArray[np.uint8]]
    looks: tuple[Look, ...] = ()
    notes: tuple[str, ...] = field(default=())


def load_pictures(folder: Path, document: PlanDocument) -> Finished:
    """The pictures of tiles beside a document; what is missing is told."""
    pictures = {
        name: read_image(folder / name).pixels
        for name in picture_names(document)
        if (folder / name).is_file()
    }
    return Finished(document, pictures, (), tuple(_missing(document, pictures)))


def _missing(document: PlanDocument, pictures: Collection[str]) -> list[str]:
    """A note for each picture that a document names and that is not there."""
    return [
        f"{name} is missing: its tiles have the usual look"
        for name in picture_names(document)
        if name not in pictures
    ]


def picture_names(document: PlanDocument) -> list[str]:
    """The pictures that a document names, each once."""
    return list(dict.fromkeys(_pictures([rooms_of(document)])))


def _pictures(storeys: Sequence[Sequence[Room]]) -> list[str]:
    return [tiling.picture for rooms in storeys for room in rooms for tiling in room.tilings]


def picture_digests(folder: Path, document: PlanDocument) -> list[str]:
    """Of the pictures beside a document: the house depends on them, too."""
    paths = [folder / name for name in picture_names(document)]
    return [file_digest(path) if path.is_file() else "" for path in paths]


def with_photos(before: Finished, photos: Sequence[RoomPhoto], *, stays: bool = False) -> Finished:
    """The finishes of rooms by their photos, in the place of what the document says of them.

    stays: the document of `before` is kept as it is, and so are the pictures that it names.

    Of several photos of a room, the colour is of the one in which most pixels have it, the tiles
    of a surface of the one that shows most of them.
    """
    by_place: dict[Place, list[Look]] = {}
    document = before.document
    for photo in photos:
        place = place_of(document, photo.room)
        room = document.storeys[place.storey].rooms[place.room]
        by_place.setdefault(place, []).append(look_at(photo, room))
    pictures = dict(before.pictures)
    rooms = [list(storey.rooms) for storey in document.storeys]
    notes: list[str] = []
    kept = set(picture_names(document)) if stays else set[str]()
    for place, looks in by_place.items():
        room = rooms[place.storey][place.room]
        room, said = _finished(room, looks, pictures, Counter(_pictures(rooms)), kept)
        rooms[place.storey][place.room] = room
        notes += [note for look in looks for note in look.notes]
        notes += [f"{document.storeys[place.storey].name} {room.id}: {note}" for note in said]
    storeys = [
        storey.model_copy(update={"rooms": own})
        for storey, own in zip(document.storeys, rooms, strict=True)
    ]
    document = document.model_copy(update={"storeys": storeys})
    used = kept.union(picture_names(document))
    pictures = {name: pixels for name, pixels in pictures.items() if name in used}
    seen = tuple(look for looks in by_place.values() for look in looks)
    return Finished(document, pictures, seen, (*_missing(document, pictures), *notes))


def _finished(
    room: Room,
    looks: Sequence[Look],
    pictures: dict[str, NDArray[np.uint8]],
    uses: Counter[str],
    kept: Collection[str],
) -> tuple[Room, list[str]]:
    """The room with what its photos show; new pictures are added, or take the place of its own.

    uses: how many tilings have each picture. kept: pictures that are not replaced.
    """
    notes: list[str] = []
    tilings = {tiling.surface: tiling for tiling in room.tilings}
    surfaces: tuple[Surface, ...] = ("floor", "wall")
    for surface in surfaces:
        seen = [(look, tiles) for look in looks if (tiles := look.of(surface)) is not None]
        if not seen:
            continue
        look, tiles = max(seen, key=lambda one: len(one[1].lattice))
        known = tilings.get(surface)
        own = known is not None and _is_replaced(known, tiles, pictures, uses, kept)
        name = known.picture if known and own else _free_name({*pictures, *uses, *kept})
        pictures[name] = tiles.texture
        laid = surface == "floor" or room.use in TILED if known is None else known.laid
        tilings[surface] = _tiling(look, tiles, name, laid=laid)
        if surface == "wall" and not laid:
            notes.append(
                f"tiles on a wall of a {room.use} are taken for a part of it: the walls are not"
                " tiled (`laid` in plan.json)"
            )
    painted = [look for look in looks if look.colour is not None]
    colour = room.wall_colour
    if painted:
        best = max(painted, key=lambda look: 0.0 if look.colour is None else look.colour.share)
        colour = _wall_colour(best)
        if room.outdoors:
            notes.append("it is outdoors: its walls keep the look of the facade")
        elif "wall" in tilings and tilings["wall"].laid:
            notes.append("its walls are tiled all over: their colour is told, and no wall has it")
    update = {"wall_colour": colour, "tilings": list(tilings.values())}
    return room.model_copy(update=update), notes


def _is_replaced(
    known: Tiling,
    tiles: TilesSeen,
    pictures: dict[str, NDArray[np.uint8]],
    uses: Counter[str],
    kept: Collection[str],
) -> bool:
    """Whether a tiling's picture may give way to that of a photo: it is its own, or the same."""
    if np.array_equal(pictures.get(known.picture, ()), tiles.texture):
        return True
    return uses[known.picture] == 1 and known.picture not in kept


def _wall_colour(look: Look) -> WallColour | None:
    if look.colour is None:
        return None
    return WallColour(
        srgb=look.colour.srgb,
        share=round(look.colour.share, 4),
        photo=_file(look),
        origin="measured",
    )


def _tiling(look: Look, tiles: TilesSeen, picture: str, *, laid: bool) -> Tiling:
    return Tiling(
        surface=tiles.surface,
        picture=picture,
        tiles=tiles.block.tiles,
        size_m=tiles.size_m,
        size_origin="invented",
        laid=laid,
        photo=_file(look),
        corners_px=[(round(float(x), 1), round(float(y), 1)) for x, y in tiles.corners_px],
        origin="measured",
    )


def _file(look: Look) -> PhotoFile:
    return PhotoFile(file=look.photo.path.name, sha256=look.photo.sha256)


def _free_name(taken: Collection[str]) -> str:
    number = 1
    while f"tiles-{number}.png" in taken:
        number += 1
    return f"tiles-{number}.png"
