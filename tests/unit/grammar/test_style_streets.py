"""What styles have at streets: two fronts at corners, shops that one sees into, trees as assets."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from test_styles import derive, ring

from veduta.grammar.deriving import Deriver, deriver
from veduta.grammar.lot import Lot
from veduta.grammar.options import AttributeOptions, GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.rules import find_rules, read_rules

CORNERS = np.array([[0.0, 0.0], [16.0, 0.0], [16.0, 12.0], [0.0, 12.0]])
PARISIAN = ("haussmann", "restauration", "empire", "louis-xiii", "louis-xiv")
WIDTHS = "6;8;0;0"
"""A street in the south and another in the east."""


def deriver_of(style: str, **given: Attribute) -> Deriver:
    rules = read_rules(find_rules(style))
    attributes = AttributeOptions(values={"LOD": 1.0, **given})
    return deriver(rules.files, rules.search, GrammarOptions(attributes=attributes))


def windows_by_side(style: str, told: dict[str, Attribute]) -> Counter[str]:
    """How many windows look to each side of a lot."""
    lot = Lot("a", "a", (CORNERS,), (0.0, 0.0, 0.0), told)
    by = deriver_of(style)
    built = by.together([lot], 1.0)
    assert by.fault(built, 0, lot) is None
    columns = built.columns(0)
    first = columns.ring_offsets[columns.polygon_offsets[:-1]]
    found: Counter[str] = Counter()
    for row, start in enumerate(first.tolist()):
        if columns.feature_class[columns.polygon_feature[row]] != "window":
            continue
        a, b, c = columns.positions_m[start : start + 3]
        x, y, z = np.cross(b - a, c - a)
        if abs(z) < 0.5 * np.hypot(x, y):
            east = "east" if x > 0 else "west"
            found[east if abs(x) > abs(y) else ("north" if y > 0 else "south")] += 1
    return found


@pytest.mark.parametrize("style", PARISIAN)
def test_a_house_at_a_corner_has_windows_on_both_streets(style: str) -> None:
    corner = windows_by_side(style, {"/edgeattr/streetWidth": WIDTHS, "streetCorner": True})
    row = windows_by_side(style, {"/edgeattr/streetWidth": "6;0;0;0"})
    assert corner["south"] > 0
    assert corner["east"] >= 3
    assert corner["east"] > row["east"]
    assert corner["west"] == row["west"] == 0


SHOPS: list[tuple[str, dict[str, Attribute]]] = [
    ("haussmann", {"withShops": True}),
    ("restauration", {"withShops": True}),
    ("louis-xiii", {"arcade": True}),
    ("empire", {"arcade": True}),
]


@pytest.mark.parametrize(("style", "given"), SHOPS)
def test_one_sees_into_shops(style: str, given: dict[str, Attribute]) -> None:
    """Behind each front is a room, and what is before it is no wall but a clear pane."""
    lot = [ring((0, 0), (16, 0), (16, 12), (0, 12))]
    (part,) = derive(style, [lot], LOD=2.0, **given)
    assert part.instances is not None
    names = {mesh.name.split("@")[0] for mesh in part.instances.meshes}
    assert names & {"builtin/shop-shelves", "builtin/shop-counter"}
    clear = [row for row, one in enumerate(part.materials) if one.opacity < 1.0]
    panes = np.isin(part.polygon_material, clear)
    assert panes.any()
    features = {part.features.semantic(row).value for row in part.polygon_feature[panes].tolist()}
    assert features == {"shop"}
    (flat,) = derive(style, [lot], LOD=1.5, **given)
    assert all(one.opacity == 1.0 for one in flat.materials)


def test_trees_and_shrubs_of_gardens_are_repeated_assets() -> None:
    (part,) = derive("suburban-house", [[ring((0, 0), (24, 0), (24, 40), (0, 40))]], LOD=2.0)
    assert part.instances is not None
    names = {mesh.name.split("@")[0] for mesh in part.instances.meshes}
    assert names & {"builtin/tree-broad", "builtin/tree-slim"}
    assert "builtin/shrub" in names
