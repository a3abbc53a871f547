"""Options that change nothing in a rebuild say so; those that change something do not."""

from __future__ import annotations

from typing import Any

import pytest
from sample_plan import sample_plan, sample_storey

from veduta.plan.document import Furniture, Light
from veduta.plan.idle_options import idle_notes
from veduta.plan.options import HouseOptions, PlanOptions

THING = Furniture(id="f1", object="stool", room="living", at_m=(2, 2), size_m=(0.4, 0.4, 0.5))
LAMP = Light(id="l1", kind="wall", room="living", at_m=(2, 2), above_m=2.0, lumen=500)
UPPER = {"name": "first floor", "elevation_m": 2.8}


@pytest.mark.parametrize(
    ("given", "storey", "said"),
    [
        ({"seed": 3}, {"furniture": [THING]}, "--seed"),
        ({"seed": 3}, {"furniture": []}, "--seed"),
        ({"varied_furniture": True}, {"furniture": [THING]}, "--varied-furniture"),
        ({"no_furniture": True}, {"furniture": [THING]}, "--no-furniture"),
        ({"lights": "wall"}, {"lights": [LAMP]}, "--lights"),
        ({"lights": "wall"}, {"lights": []}, "--lights"),
        ({"lights": "none"}, {"lights": [LAMP]}, "--lights"),
        ({"storey_height": 3.1}, {}, "--storey-height"),
        ({}, {"furniture": [THING], "lights": [LAMP]}, None),
        ({"seed": 3, "lights": "wall"}, {}, None),
        ({"no_furniture": True, "lights": "none"}, {"furniture": [], "lights": []}, None),
        ({"roof": "flat"}, {"furniture": [THING], "lights": [LAMP]}, None),
    ],
)
def test_what_changes_nothing_is_told(
    given: dict[str, Any], storey: dict[str, Any], said: str | None
) -> None:
    document = sample_plan(sample_storey(**storey), sample_storey(**UPPER))
    notes = idle_notes(document, PlanOptions(house=HouseOptions(**given)))
    assert [note.split()[0] for note in notes] == ([said] if said else [])
    assert all("first floor" not in note for note in notes)
