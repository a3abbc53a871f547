"""`--photos ROOM=FILE`: which photo shows which room."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import JsonValue

from veduta.imaging.read import read_image
from veduta.plan.document import PlanDocument, Room, Storey
from veduta.run.digests import file_digest
from veduta.run.errors import InputError

OPTION = "--photos"
MOST_PHOTOS = 100
_SHOWN = 40


@dataclass(frozen=True)
class RoomPhoto:
    """A photo, and the room as the user names it; sha256 of the file."""

    room: str
    path: Path
    sha256: str

    @property
    def identity(self) -> list[JsonValue]:
        """What a key is made of."""
        return [self.room, self.path.name, self.sha256]


@dataclass(frozen=True)
class Place:
    """Where a room is in the document."""

    storey: int
    room: int


def room_photos(given: Sequence[str]) -> list[RoomPhoto]:
    """The photos of `ROOM=FILE`; InputError where one cannot be read, before any work is done."""
    if len(given) > MOST_PHOTOS:
        raise InputError(
            OPTION, f"{len(given)} photos, more than {MOST_PHOTOS}", "Give the best of them."
        )
    return [_room_photo(one) for one in given]


def _room_photo(given: str) -> RoomPhoto:
    room, equals, file = given.partition("=")
    if not (room.strip() and equals and file):
        raise InputError(
            OPTION, f"{given!r} is not ROOM=FILE", "Name a room of the plan: Kitchen=kitchen.jpg"
        )
    path = Path(file)
    read_image(path)
    return RoomPhoto(room.strip(), path, file_digest(path))


def place_of(document: PlanDocument, name: str) -> Place:
    """The room that is meant: by its id, its name on the plan, or its use if only one has it.

    `STOREY/ROOM` tells rooms of several storeys apart. Capital letters do not matter. InputError
    lists the rooms where there is none of the name, or more than one.
    """
    ways: tuple[Callable[[Room], str], ...] = (
        lambda room: room.id,
        lambda room: room.name,
        lambda room: room.use,
    )
    for word in ways:
        found = [
            place
            for place, storey, room in _rooms(document)
            if _same(name, word(room)) or _same(name, f"{storey.name}/{word(room)}")
        ]
        if len(found) == 1:
            return found[0]
        if found:
            several = ", ".join(_told(document, place) for place in found)
            fault = f"{name!r} may be any of {several}"
            raise InputError(OPTION, fault, "Give STOREY/ID, as they are in plan.json.")
    places = [place for place, _, _ in _rooms(document)]
    told = ", ".join(_told(document, place) for place in places[:_SHOWN])
    more = f" and {len(places) - _SHOWN} more" if len(places) > _SHOWN else ""
    raise InputError(OPTION, f"there is no room {name!r}", f"The rooms are: {told}{more}.")


def _same(given: str, own: str) -> bool:
    return bool(own) and given.strip().casefold() == own.strip().casefold()


def _rooms(document: PlanDocument) -> list[tuple[Place, Storey, Room]]:
    return [
        (Place(index, row), storey, room)
        for index, storey in enumerate(document.storeys)
        for row, room in enumerate(storey.rooms)
    ]


def _told(document: PlanDocument, place: Place) -> str:
    storey = document.storeys[place.storey]
    room = storey.rooms[place.room]
    return f"{storey.name}/{room.id} ({room.name or room.use})"
