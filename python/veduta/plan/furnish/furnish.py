"""The recipe: what each room wants, placed in order; then things on things; then the records."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely.geometry import Polygon

from veduta.plan.document import Fitting, Furniture, Origin, PlanDocument, Room, RoomUse, Stairs
from veduta.plan.furnish.arrangement import Spot, Variant, alone
from veduta.plan.furnish.as_drawn import place_drawn, without_drawn
from veduta.plan.furnish.catalogue.entry import Wanted
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.drawn_kitchen import place_kitchen
from veduta.plan.furnish.groups.lounge import lounge
from veduta.plan.furnish.groups.rows import coats, kitchen_run, wash_row
from veduta.plan.furnish.groups.single import single
from veduta.plan.furnish.groups.sleeping import sleeping
from veduta.plan.furnish.groups.table import desk, dining, garden_seats
from veduta.plan.furnish.layout import Layout, Stood
from veduta.plan.furnish.place import place_first
from veduta.plan.furnish.room import RoomSpace, room_spaces
from veduta.plan.furnish.upon import place_upon
from veduta.plan.furnish.walk import Ways, is_too_large
from veduta.plan.house.flights import storey_spaces

GROUPS: dict[str, Callable[[Choice, RoomSpace], list[Variant]]] = {
    "sleeping": sleeping,
    "lounge": lounge,
    "dining": dining,
    "garden-seats": garden_seats,
    "desk": desk,
    "wash-row": wash_row,
    "kitchen-run": kitchen_run,
    "coats": coats,
}
"""Wishes of the catalogue that are more than one thing; others are types of objects."""
APART: dict[str, tuple[str, ...]] = {
    "wash-row": ("toilet", "basin"),
    "kitchen-run": ("kitchen-sink", "kitchen-hob", "fridge", "kitchen-unit"),
}
"""What a row comes to where no wall is long enough for it: its things at walls of their own."""
INSTEAD: dict[str, str] = {"shower": "bathtub", "fridge": "fridge-small"}
"""Not wanted where the other stands already."""
AS: dict[RoomUse, RoomUse] = {"other": "storage"}
RESTARTS = 3
DRAWN_GROUP = 1000
"""The group of what is drawn: what a room wants has lower numbers."""
MOST_THINGS = 60
"""In a room."""


@dataclass(frozen=True)
class FurnishedRoom:
    """A room with what stands in it, what found no place, and why it has no more than that."""

    room: Room
    stood: tuple[Stood, ...]
    missing: tuple[str, ...]
    notes: tuple[str, ...] = ()


def furnish(document: PlanDocument, catalogue: Catalogue, seed: int, slab_m: float, *,
            varied: bool = False) -> tuple[PlanDocument, list[FurnishedRoom]]:  # fmt: skip
    """The document with furniture in the storeys that have none yet, and what was done.

    A storey whose list is there, empty or not, stays as it is. The same document, catalogue and
    seed give the same furniture.
    """
    choice = Choice(catalogue, seed, varied)
    order = sorted(
        range(len(document.storeys)), key=lambda index: document.storeys[index].elevation_m
    )
    spaces, _ = storey_spaces([document.storeys[index] for index in order], slab_m)
    storeys, rooms = list(document.storeys), []
    below: list[Stairs] = []
    for index, space in zip(order, spaces, strict=True):
        storey = document.storeys[index]
        if storey.furniture is None:
            height = storey.height_m - slab_m
            done = [
                furnish_room(one, choice, storey.name, storey.fittings)
                for one in room_spaces(space, height, below)
            ]
            rooms += done
            storeys[index] = storey.model_copy(update={"furniture": records(done)})
        below = storey.stairs
    return document.model_copy(update={"storeys": storeys}), rooms


def furnish_room(
    space: RoomSpace, choice: Choice, storey: str, fittings: Sequence[Fitting] = ()
) -> FurnishedRoom:
    """A room by its use; where something critical finds no place, what came before it gives way.

    What the plan draws in it stands first, and gives way to nothing.
    """
    if is_too_large(space.floor):
        return FurnishedRoom(space.room, (), (), ("is left empty: it is too large",))
    done, lacks = _furnished(space, choice, storey, fittings)
    if lacks and not space.leaves.is_empty:
        # Better a leaf that one closes behind oneself than a bedroom without a bed.
        again, lacks_still = _furnished(replace(space, leaves=Polygon()), choice, storey, fittings)
        if lacks_still < lacks:
            note = "has a leaf that bars the way while it stands open: else not all had found place"
            return replace(again, notes=(*again.notes, note))
    return done


def _furnished(
    space: RoomSpace, choice: Choice, storey: str, fittings: Sequence[Fitting]
) -> tuple[FurnishedRoom, int]:
    """A room with what finds place in it, and how many critical things did not."""
    name = zlib.crc32(f"{storey} {space.room.id}".encode())
    seeds = [choice.seed, name]
    wishes = list(_wishes(space, choice, np.random.default_rng(seeds)))
    ways = Ways(space.floor, space.doors, space.leaves)
    begun = Layout(space, ways)
    own = [one for one in fittings if one.room == space.room.id]
    elsewhere = place_drawn(own, begun, choice, DRAWN_GROUP)
    elsewhere += place_kitchen(own, begun, choice, DRAWN_GROUP)
    wishes = without_drawn(wishes, begun.stood)
    tried: list[tuple[Layout, list[str], int]] = []
    given_up: list[str] = []
    critical = {wish.type for wish in wishes if wish.critical}

    def lack(one: tuple[Layout, list[str], int]) -> tuple[int, int]:
        return sum(kind in critical for kind in one[1]), len(one[1])

    for _ in range(RESTARTS):
        layout = begun.copy()
        missing, left, failed = _place_all(wishes, layout, choice, np.random.default_rng(seeds))
        tried.append((layout, [*_not_replaced(given_up, layout), *missing], left))
        if not failed:
            break
        # The first wishes are the largest: without the first, there is place for the critical one.
        given_up.append(wishes.pop(0).type)
    # The last of those that lack as little: what was asked for in vain has its place there.
    best, missing, left = min(reversed(tried), key=lack)
    place_upon(best, choice, np.random.default_rng([*seeds, 1]))
    full = f"has {MOST_THINGS} things, which are the most; {left} wishes were not looked at"
    notes = [
        f"the {kind} that is drawn has no place there: it would be in the way" for kind in elsewhere
    ]
    if left:
        notes.append(full)
    done = FurnishedRoom(space.room, tuple(best.stood), tuple(missing), tuple(notes))
    return done, sum(kind in critical for kind in missing)


def _not_replaced(given_up: Sequence[str], layout: Layout) -> list[str]:
    """What gave way, unless what stands does its work."""
    stood = {one.entry.type for one in layout.stood}
    serve = {INSTEAD[one] for one in stood if one in INSTEAD}
    return [one for one in given_up if one not in serve and INSTEAD.get(one) not in stood]


def _wishes(space: RoomSpace, choice: Choice, rng: np.random.Generator) -> Iterator[Wanted]:
    """What the room's use asks for, each as often as it is wanted."""
    area = space.floor.area
    use = AS.get(space.room.use, space.room.use)
    for wanted in choice.catalogue.wanted_in(use):
        drawn = rng.random()
        if area < wanted.from_m2 or drawn >= wanted.chance:
            continue
        count = min(wanted.most, wanted.least + int(area / wanted.each_m2))
        for _ in range(max(wanted.least, count)):
            yield wanted


def _place_all(
    wishes: Sequence[Wanted], layout: Layout, choice: Choice, rng: np.random.Generator
) -> tuple[list[str], int, bool | None]:
    """What found no place, how many wishes are left when the room is full, and ...

    ... whether something critical found no place that others could make room for; None where
    nothing critical failed.
    """
    missing: list[str] = []
    failed: bool | None = None
    for group, wish in enumerate(wishes, 1):
        if len(layout.stood) >= MOST_THINGS:
            return missing, len(wishes) - group + 1, failed
        other = INSTEAD.get(wish.type)
        if other and any(one.entry.type == other for one in layout.stood):
            continue
        if _place_one(wish.type, layout, choice, rng, group):
            continue
        missing.append(wish.type)
        if wish.critical:
            failed = group > 1
    return missing, 0, failed


def _place_one(
    kind: str, layout: Layout, choice: Choice, rng: np.random.Generator, group: int
) -> bool:
    if kind == "curtain":
        return _hang_curtain(layout, choice, group)
    if kind == "bath-mat":
        return _lay_mat(layout, choice, group)
    make = GROUPS.get(kind)
    variants = make(choice, layout.space) if make else single(kind, choice, layout.space)
    if place_first(variants, layout, rng, group):
        return True
    done = [
        place_first(single(part, choice, layout.space), layout, rng, group)
        for part in APART.get(kind, ())
    ]
    return bool(done) and all(done)


def _hang_curtain(layout: Layout, choice: Choice, group: int) -> bool:
    """At the next window that has none and where nothing stands in their way."""
    entry = choice.entry("curtain")
    hung = [one.shape.centroid for one in layout.stood if one.entry.type == "curtain"]
    for window in layout.space.windows:
        middle = window.hole.middle
        face = middle + (window.hole.line.half_m + 0.02) * window.inward
        if any(np.hypot(p.x - middle[0], p.y - middle[1]) < 0.6 for p in hung):
            continue
        turn = float(np.arctan2(window.inward[0], -window.inward[1]))
        size = entry.sized(window.hole.width_m + 0.4)
        spot = Spot(layout.space, face, turn, None)
        thing = spot.place(alone(entry, size), group, None)
        if layout.allows(thing):
            layout.add([thing])
            return True
    return False


def _lay_mat(layout: Layout, choice: Choice, group: int) -> bool:
    """Before the bath, the shower or the basin."""
    entry = choice.entry("bath-mat")
    size = entry.sized()
    for one in layout.stood:
        if one.entry.type not in {"bathtub", "shower", "basin"}:
            continue
        at = one.point(0.0, -one.size_m[1] / 2.0 - size[1] / 2.0 - 0.03)
        mat = Stood(
            entry, size, (round(float(at[0]), 4), round(float(at[1]), 4)), one.turn, group=group
        )
        if layout.allows(mat):
            layout.add([mat])
            return True
    return False


def _origin(one: Stood) -> Origin:
    if one.drawn:
        return "measured"
    return "inferred" if one.between else "invented"


def records(rooms: Sequence[FurnishedRoom]) -> list[Furniture]:
    """The things as they are kept in the document."""
    found: list[Furniture] = []
    for room in rooms:
        ids: dict[int, str] = {}
        for one in room.stood:
            name = f"f{len(found) + 1}"
            ids[id(one)] = name
            found.append(
                Furniture(
                    id=name,
                    object=one.entry.name,
                    room=room.room.id,
                    at_m=one.at,
                    turn_rad=one.turn,
                    size_m=one.size_m,
                    above_m=one.above_m,
                    on=None if one.on is None else ids[id(one.on)],
                    origin=_origin(one),
                )
            )
    return found
