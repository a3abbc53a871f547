"""What must be known before a house is trusted: it is said at the terminal, too."""

from __future__ import annotations

from veduta.plan.document import PlanDocument, Storey
from veduta.plan.remarks import closed_in
from veduta.plan.scale.estimate import scale_notes
from veduta.plan.tour.find import Tour
from veduta.run.report import counted

_SHOWN = 5


def doubts(document: PlanDocument, tour: Tour | None) -> list[str]:
    """One sentence each: of the scale, of rooms without doors, of what the tour cannot reach."""
    several = len(document.storeys) > 1
    said = []
    for storey in document.storeys:
        of = f"{storey.name}: " if several else ""
        said += [of + note for note in (*scale_notes(storey.scale), *_closed_in(storey))]
    return [*said, *(() if tour is None else tour.notes)]


def _closed_in(storey: Storey) -> list[str]:
    closed = [room.id for room in closed_in(storey.rooms, storey.openings)]
    if not closed:
        return []
    more = f" and {len(closed) - _SHOWN} more" if len(closed) > _SHOWN else ""
    which = counted(len(closed), "room")
    return [f"no door was found into {which}: {', '.join(closed[:_SHOWN])}{more}."]
