"""What stands across the street against what is seen from near: the same, of fewer faces."""

from __future__ import annotations

import numpy as np
import pytest
from test_styles import LOTS, rules_of

from veduta import _core
from veduta.grammar.levels import FULL, PANELS, PLAIN
from veduta.grammar.rules import style_names

SEEDS = 3
SILHOUETTE_M = 0.12
"""What a profile of few faces may differ."""


SEEN_INTO = frozenset(
    f"builtin/{name}"
    for name in (
        "shop-front", "shop-window", "shop-counter", "shop-door", "shop-shelves",
        "door-glazed", "door-entrance", "entrance-hall",
    )
)  # fmt: skip
"""Shops and entrances that one sees into from near with what stands in them, and the shut ones that
stand for them across the street. What stands in them has colours alone, without a texture."""


def at_level(style: str, lot: str, level: float) -> _core.DerivedLots:
    return _core.derive_lots(
        rules_of(style),
        [LOTS[lot]] * SEEDS,
        list(range(SEEDS)),
        attributes=[{"LOD": level}] * SEEDS,
        edits=[[]] * SEEDS,
    )


def shown(derived: _core.DerivedLots, row: int) -> tuple[set[str], set[str | None], set[str]]:
    """Classes of surfaces, textures, and assets without their levels."""
    columns = derived.columns(row)
    textures = {columns.looks[look][4] for look in columns.polygon_look}
    assets = {name.partition("@")[0] for name in columns.asset_names}
    return set(columns.feature_class), textures, assets


@pytest.mark.parametrize("style", style_names())
@pytest.mark.parametrize("lot", ["rectangle", "corner", "garden"])
def test_the_same_stands_there(style: str, lot: str) -> None:
    full, plain = at_level(style, lot, FULL), at_level(style, lot, PLAIN)
    for row in range(SEEDS):
        classes, textures, assets = shown(plain, row)
        near_classes, near_textures, near_assets = shown(full, row)
        assert classes == near_classes
        assert textures - {None} == near_textures - {None}
        assert assets - SEEN_INTO == near_assets - SEEN_INTO
        # In arches rules draw what is shut there: a shop without an asset.
        assert (bool(assets & SEEN_INTO) or "shop" in classes) == bool(near_assets & SEEN_INTO)
        boxes = []
        for derived in (full, plain):
            extent = derived.extent(row)
            assert extent is not None
            boxes.append(np.array(extent[:2]))
        assert np.abs(boxes[0] - boxes[1]).max() < SILHOUETTE_M


@pytest.mark.parametrize("style", style_names())
def test_openings_of_cityjson_are_panels(style: str) -> None:
    """One polygon each, of the classes that they have from near."""
    openings = {"window", "door", "shop"}
    full, panels = at_level(style, "rectangle", FULL), at_level(style, "rectangle", PANELS)
    for row in range(SEEDS):
        columns = panels.columns(row)
        kinds = [columns.feature_class[feature] for feature in columns.polygon_feature]
        assert not {columns.feature_class[one] for one in columns.instance_feature} & openings
        assert set(kinds) & openings == shown(full, row)[0] & openings
        names = {columns.looks[look][4] for look in columns.polygon_look}
        assert any(names)
        for kind, look in zip(kinds, columns.polygon_look, strict=True):
            assert kind not in openings or not columns.looks[look][4]


@pytest.mark.parametrize(
    ("style", "door", "rule"),
    [
        ("haussmann", "door", "DoorPanelled"),
        ("haussmann", "shop", "ShopWood"),
        ("restauration", "shop", "ShopWood"),
        ("modern-slab", "door", "DoorGlazed"),
        ("modern-slab", "door", "DoorMetal"),
        ("gothic-revival", "door", "ArchedPlanks"),
        ("louis-xiii", "door", "ArchedPanels"),
        ("louis-xiv", "door", "ArchedPanels"),
        ("victorian", "door", "ArchedPanels"),
        ("suburban-house", "door", "DoorPanelled"),
    ],
)
def test_doors_and_shops_are_told_from_windows(style: str, door: str, rule: str) -> None:
    for level in (FULL, PLAIN):
        derived = at_level(style, "rectangle", level)
        all_columns = [derived.columns(row) for row in range(SEEDS)]
        found = {
            one
            for columns in all_columns
            for one in zip(columns.feature_class, columns.feature_name, strict=True)
        }
        assert (door, rule) in found
        assert not any(kind == "window" and "Door" in name for kind, name in found)
