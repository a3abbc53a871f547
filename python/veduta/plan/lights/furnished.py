"""Lamps that go with furniture: those that stand in the document, and one beside a seat.

What is a lamp or a seat, the catalogue says.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from shapely.geometry import Point
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Furniture, Light, PlanDocument, Storey
from veduta.plan.furnish.catalogue.entry import Stands
from veduta.plan.furnish.catalogue.read import Catalogue

FLOOR_LUMEN, TABLE_LUMEN = 800.0, 450.0
FLOOR_LAMP_M = 1.55
"""From the floor to where a floor lamp shines from."""
FOOT_M = 0.16
"""Radius of its foot."""
_SEATS = frozenset({"armchair", "sofa", "corner-sofa"})
"""Types of the catalogue beside which one reads."""
_KINDS: Mapping[Stands, Literal["floor", "wall", "table"]] = {
    "floor": "floor", "wall": "wall", "things": "table",
}  # fmt: skip
_BESIDE_M = 0.08
_SHADE = 0.85
"""A lamp shines from this share of its height."""
_NEAR_M = 2.0
_WALL_M = 0.04


def light_id(item: Furniture) -> str:
    """The id of the light of a lamp that is furniture."""
    return f"{item.id}-light"


def bodies_of(storey: Storey) -> dict[str, Furniture]:
    """The things that are the bodies of lamps, by the ids of their lights."""
    by_id = {item.id: item for item in storey.furniture or ()}
    by_light = {light_id(item): item for item in storey.furniture or ()}
    found = {
        light.id: by_light.get(light.id) if light.thing is None else by_id.get(light.thing)
        for light in storey.lights or ()
    }
    return {name: item for name, item in found.items() if item is not None}


def furniture_lamps(room: str, things: Sequence[Furniture], catalogue: Catalogue) -> list[Light]:
    """The lamps among the things of a room: they stand on the floor or on other things."""
    return [
        Light(id=light_id(item), thing=item.id, room=room, **_shining(item, catalogue))
        for item in things
        if _is_lamp(item, catalogue)
    ]


def relit(
    before: PlanDocument, furnished: PlanDocument, catalogue: Catalogue
) -> tuple[PlanDocument, list[str]]:
    """The document with the lamps of its new furniture for those of the old, and what that changed.

    before: as it was before storeys of it were furnished. Furniture that is new has new ids: what
    has the id of an old lamp may be one elsewhere, or none at all.
    """
    storeys, notes = [], []
    for old, new in zip(before.storeys, furnished.storeys, strict=True):
        # Who has no lamps at all wants none, and who has null gets all of them later.
        if old.furniture is not None or new.furniture is None or not new.lights:
            storeys.append(new)
            continue
        rooms: dict[str, list[Furniture]] = {}
        for item in new.furniture:
            rooms.setdefault(item.room, []).append(item)
        lamps = [lamp for room in rooms for lamp in furniture_lamps(room, rooms[room], catalogue)]
        taken = {lamp.id for lamp in lamps}
        kept = [light for light in new.lights if light.thing is None and light.id not in taken]
        storeys.append(new.model_copy(update={"lights": [*kept, *lamps]}))
        notes.append(f"{new.name}: the {len(lamps)} lamps of its new furniture are its lights now")
    return furnished.model_copy(update={"storeys": storeys}), notes


def followed(storey: Storey, catalogue: Catalogue) -> tuple[Storey, list[str]]:
    """The storey with the lights of its furniture where that stands now, and what that changed.

    Whoever moves a lamp in a document, or takes it away, means its light, too. How bright it is
    stays as it is there.
    """
    lights, notes = [], []
    bodies = bodies_of(storey)
    for light in storey.lights or []:
        item = bodies.get(light.id)
        if item is not None and _is_lamp(item, catalogue):
            place = _shining(item, catalogue) | {"lumen": light.lumen, "room": item.room}
            moved = light.model_copy(update=place)
            if moved != light:
                notes.append(f"{storey.name}: light {light.id} goes with its lamp {item.id}")
            lights.append(moved)
        elif light.thing is None:
            lights.append(light)
        else:
            gone = f"there is no lamp {light.thing!r} any more"
            notes.append(f"{storey.name}: light {light.id} is left out: {gone}")
    if not notes:
        return storey, []
    return storey.model_copy(update={"lights": lights}), notes


def _is_lamp(item: Furniture, catalogue: Catalogue) -> bool:
    return catalogue.entries[item.object].kind == "lamp"


def _shining(item: Furniture, catalogue: Catalogue) -> dict[str, Any]:
    """From where a lamp shines, and how brightly."""
    kind = _KINDS[catalogue.entries[item.object].stands]
    return {
        "kind": kind,
        "at_m": item.at_m,
        "above_m": round(item.above_m + _SHADE * item.size_m[2], 3),
        "lumen": TABLE_LUMEN if kind == "table" else FLOOR_LUMEN,
    }


def seat_lamp(
    room: str,
    name: str,
    things: Sequence[Furniture],
    free: BaseGeometry,
    lamps: Sequence[Light],
    catalogue: Catalogue,
) -> Light | None:
    """A floor lamp beside the first seat that has none near it, where there is room for it.

    free: what of the floor is neither taken nor walked on by a door's leaf.
    """
    for seat in things:
        if catalogue.entries[seat.object].type not in _SEATS:
            continue
        if any(math.dist(seat.at_m, lamp.at_m) < _NEAR_M for lamp in lamps):
            return None
        for at in _beside(seat):
            foot = Point(at).buffer(FOOT_M)
            if free.covers(foot.buffer(_WALL_M)):
                place = (round(float(at[0]), 3), round(float(at[1]), 3))
                return Light(
                    id=name, kind="floor", room=room, at_m=place,
                    above_m=FLOOR_LAMP_M, lumen=FLOOR_LUMEN,
                )  # fmt: skip
    return None


def _beside(seat: Furniture) -> list[np.ndarray]:
    """Places at both ends of a seat, by its back."""
    width, depth, _ = seat.size_m
    cos, sin = math.cos(seat.turn_rad), math.sin(seat.turn_rad)
    turn = np.array([[cos, -sin], [sin, cos]])
    out = width / 2.0 + FOOT_M + _BESIDE_M
    back = depth / 2.0 - FOOT_M - _BESIDE_M
    return [
        np.array(seat.at_m) + turn @ np.array([side * out, along])
        for along in (back, 0.0)
        for side in (1.0, -1.0)
    ]
