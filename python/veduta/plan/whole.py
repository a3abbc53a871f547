"""Whether what was read is a whole house: one whose rooms can be walked to."""

from __future__ import annotations

from veduta.plan.document import PlanDocument
from veduta.plan.tour.find import Tour
from veduta.plan.tour.stops import is_cupboard
from veduta.run.report import counted

WALKED = 0.5
"""Share of the rooms that the tour must reach: below it, doors or walls were missed."""


def parts_only(document: PlanDocument, tour: Tour | None) -> list[str]:
    """One sentence where the tour reaches few of the rooms, or a storey not at all; else nothing.

    Cupboards, voids and what lies outdoors are no rooms here. Without a tour nothing is known.
    """
    if tour is None:
        return []
    walked = {(one.storey, one.room) for one in tour.stretches}
    rooms = [
        [
            (number, room.id)
            for room in storey.rooms
            if not (room.outdoors or room.open_below or is_cupboard(room))
        ]
        for number, storey in enumerate(document.storeys)
    ]
    reached = [sum(room in walked for room in of_storey) for of_storey in rooms]
    number = sum(len(of_storey) for of_storey in rooms)
    left = [
        storey.name
        for storey, of_storey, seen in zip(document.storeys, rooms, reached, strict=True)
        if of_storey and not seen
    ]
    if not number or (sum(reached) >= WALKED * number and not left):
        return []
    none_of = f", and none of {' and '.join(left)}" if left else ""
    return [
        f"This is no whole house: the tour reaches {sum(reached)} of {counted(number, 'room')}"
        f"{none_of}. Doors or walls were not read as drawn; overlay.png shows what was, and doors"
        " can be added in plan.json."
    ]
