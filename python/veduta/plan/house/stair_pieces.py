"""The stairs of a house as features of its part: what each consists of, for its formats."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from veduta.plan.document import Stairs
from veduta.plan.house.build import House
from veduta.plan.house.space import Space


@dataclass(frozen=True)
class StairPieces:
    """One stair. space: the storey that it begins in; above: the one that it leads to.

    body: the features of steps and what bears them. columns, rails: those of a spiral's column and
    of handrails, by their names.
    """

    name: str
    stairs: Stairs
    space: Space
    above: Space
    body: tuple[int, ...]
    columns: dict[str, int]
    rails: dict[str, int]

    @property
    def rise_m(self) -> float:
        """From floor to floor."""
        return self.above.storey.elevation_m - self.space.storey.elevation_m


def stair_pieces(house: House) -> list[StairPieces]:
    """All stairs that were built, from the lowest storey up."""
    names = house.part.features.name
    found = []
    for space, above in zip(house.spaces, house.spaces[1:], strict=False):
        drawn = {one.id: one for one in [*above.storey.stairs, *space.storey.stairs]}
        for one in drawn.values():
            name = f"{space.storey.name} stairs {one.id}"
            rows = [
                row for row, own in enumerate(names) if own == name or own.startswith(f"{name} ")
            ]
            columns, rails = (
                {names[row]: row for row in rows if names[row].endswith(kind)}
                for kind in (" column", " rail")
            )
            body = tuple(row for row in rows if names[row] not in columns | rails)
            if body:
                found.append(StairPieces(name, one, space, above, body, columns, rails))
    return found


def guard_rails(house: House) -> Iterator[tuple[Space, str, int]]:
    """Rails around the openings in floors: the storey, their names and features."""
    for space in house.spaces:
        start = f"{space.storey.name} stairwell rail "
        for row, name in enumerate(house.part.features.name):
            if name.startswith(start):
                yield space, name, row
