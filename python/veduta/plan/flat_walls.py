"""Which walls of a flat are the weather's: not those to neighbours, stairs and landings."""

from __future__ import annotations

from veduta.plan.document import Storey
from veduta.plan.terrace import axis_of, sides_of


def external_walls(storey: Storey, *, flat: bool) -> set[str]:
    """Ids of walls with the open air behind them. A house: its outer walls but party walls.

    flat: only where the sheet shows the open air: along sides with a window, and in walls that have
    one, or that bound a balcony. A way out alone may lead to the landing.
    """
    outer = {wall.id for wall in storey.walls if wall.outer and not wall.party}
    if not flat:
        return outer
    balconies = [room for room in storey.rooms if room.outdoors]
    to_air = {name for room in balconies for name in room.openings}
    lit = {one.wall for one in storey.openings if one.kind == "window" or one.id in to_air}
    lit |= {name for room in balconies for name in room.walls}
    for side in sides_of(storey, axis_of(storey)):
        if lit.intersection(side.walls):
            lit |= set(side.walls)
    return outer & lit
