"""Party walls as lines: where a house in a row ends, and its neighbours begin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.house.space import Space, pieces_of

_FAR_M = 200.0
EVERYWHERE = box(-_FAR_M, -_FAR_M, _FAR_M, _FAR_M)
ROW = 2.5
"""A row goes on beyond a side for so many times this house's depth there: its ridge runs along."""
MOST_BEYOND = 0.2
"""Share of a house that may lie beyond a party wall: slight wings and walls that are askew do."""
_ALIKE = 0.98
"""Cosine between the ways out of walls of one side."""


@dataclass(frozen=True)
class Party:
    """A side to a neighbour. face_m: (2,) on its walls' outer faces. out: (2,) unit vector."""

    face_m: NDArray[np.float64]
    out: NDArray[np.float64]

    @property
    def along(self) -> NDArray[np.float64]:
        """(2,) the direction of the walls, the way out to its right."""
        return np.array([-self.out[1], self.out[0]])

    def beyond(self, more_m: float = 0.0) -> Polygon:
        """All that lies on the neighbour's side, from so far behind the face on."""
        along = self.along
        start = self.face_m + more_m * self.out
        corners = [
            start - _FAR_M * along,
            start + _FAR_M * along,
            start + _FAR_M * along + _FAR_M * self.out,
            start - _FAR_M * along + _FAR_M * self.out,
        ]
        return Polygon(corners)


def parties_of(space: Space) -> list[Party]:
    """The party walls of a storey, those of one side together at its farthest face.

    Without those of a court: no row can go on where much of this house lies.
    """
    return [one for one in _all_parties(space) if not _is_of_court(one, space)]


def court_notes(space: Space) -> list[str]:
    """What is to be noted of party walls beyond which the house itself goes on."""
    count = sum(_is_of_court(one, space) for one in _all_parties(space))
    if not count:
        return []
    return [f"no row goes on at {count} of its sides with party walls: the house itself does"]


def _is_of_court(party: Party, space: Space) -> bool:
    own = space.slab.area
    return bool(space.slab.intersection(party.beyond()).area > MOST_BEYOND * own)


def _all_parties(space: Space) -> list[Party]:
    found: list[Party] = []
    for wall in space.storey.walls:
        line = space.lines.get(wall.id)
        if not wall.party or line is None:
            continue
        start, end = np.array(line.line.coords[0]), np.array(line.line.coords[-1])
        way = (end - start) / max(float(np.linalg.norm(end - start)), 1e-9)
        out, middle = np.array([-way[1], way[0]]), 0.5 * (start + end)
        if space.slab.covers(Point(middle + (line.half_m + 0.1) * out)):
            out = -out
        face = middle + line.half_m * out
        same = next((row for row, one in enumerate(found) if one.out @ out > _ALIKE), None)
        if same is None:
            found.append(Party(face, out))
        elif (face - found[same].face_m) @ found[same].out > 0.0:
            found[same] = Party(face, found[same].out)
    return found


def own_side(shape: BaseGeometry, parties: Sequence[Party]) -> BaseGeometry:
    """What of a region is not the neighbours'."""
    for party in parties:
        shape = shape.difference(party.beyond())
    return shape


def row_region(region: BaseGeometry, parties: Sequence[Party]) -> BaseGeometry:
    """A region with what its row goes on as beyond its party walls."""
    beside = []
    for party in parties:
        near = neighbour_region(region, party, 1.0)
        if not near.is_empty:
            beside.append(neighbour_region(region, party, ROW * near.area))
    return unary_union([region, *beside]) if beside else region


def neighbour_region(slab: BaseGeometry, party: Party, width_m: float) -> Polygon:
    """The ground of a blank house beside a side, as deep as this one is at that wall."""
    along = party.along
    near = pieces_of(slab.intersection(party.beyond(-0.5)))
    if not near:
        return Polygon()
    reach = np.concatenate([np.array(piece.exterior.coords) for piece in near]) @ along
    base = float(party.face_m @ party.out) - 0.01
    corners = [
        base * party.out + reach.min() * along,
        base * party.out + reach.max() * along,
        (base + width_m) * party.out + reach.max() * along,
        (base + width_m) * party.out + reach.min() * along,
    ]
    return Polygon(corners)
