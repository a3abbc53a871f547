"""By which of several doors a visitor comes into a house."""

from __future__ import annotations

from typing import Any

import pytest
from sample_plan import opening, rectangle, room, sample_storey

from veduta.plan.house.entrance import entrances
from veduta.plan.house.space import space_of

WEST, EAST = rectangle(0.15, 0.15, 4.94, 4.85), rectangle(5.06, 0.15, 7.85, 4.85)


def ways_in(west: str, east: str, in_west: dict[str, Any], in_east: dict[str, Any]) -> list[str]:
    """Doors in the south walls of two rooms side by side; the most inviting first."""
    storey = sample_storey(
        openings=[
            opening("west", "south-1", 1.0, **({"width_m": 0.95} | in_west)),
            opening("east", "south-2", 1.0, **({"width_m": 0.95} | in_east)),
        ],
        rooms=[room("one", WEST, use=west), room("two", EAST, use=east)],
    )
    return [one.hole.opening.id for one in entrances(space_of(storey, 2.55))]


SURER = {"score": 1.0}


@pytest.mark.parametrize(
    ("west", "east", "in_west", "in_east"),
    [
        ("hall", "living", {}, SURER),
        ("living", "kitchen", {}, SURER),
        ("kitchen", "garage", {}, SURER),
        ("hall", "hall", {}, SURER | {"type": "sliding"}),
        ("living", "living", {}, SURER | {"type": "french"}),
        # What shows no leaf and is so wide leads onto a terrace.
        ("living", "living", {}, SURER | {"type": "unknown", "width_m": 1.6}),
        ("bedroom", "hall", {}, SURER | {"kind": "gap", "type": "plain"}),
        ("living", "living", SURER, {}),
    ],
)
def test_a_visitor_comes_by_the_western_door(
    west: str, east: str, in_west: dict[str, Any], in_east: dict[str, Any]
) -> None:
    assert ways_in(west, east, in_west, in_east) == ["west", "east"]
    assert ways_in(east, west, in_east, in_west) == ["east", "west"]
