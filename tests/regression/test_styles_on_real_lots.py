"""Every style on lots of a real town, and on outlines that are hard for roofs."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.grammar.assets.library import Library
from veduta.grammar.building import build_part
from veduta.grammar.deriving import attributes_of
from veduta.grammar.lot import Lot
from veduta.grammar.lots import read_lots
from veduta.grammar.options import GrammarOptions
from veduta.grammar.rules import compile_rules, find_rules, read_rules, style_names
from veduta.grammar.textures import Textures


def rings_of(lot: Lot) -> list[list[tuple[float, float, float]]]:
    return [[(float(x), float(y), 0.0) for x, y in ring] for ring in lot.rings_m]


def faults(style: str, lots: tuple[Lot, ...], level: float) -> dict[str, str]:
    """What failed or lost surfaces, by the name of the lot."""
    path = find_rules(style)
    rules, library = compile_rules(read_rules(path)), Library(path.parent)
    library.add_written_to(rules)
    kinds = dict(rules.attributes)
    told = {}
    for lot in lots:
        given = attributes_of(lot, kinds, GrammarOptions())
        assert not isinstance(given, str)
        (derived,) = rules.derive([rings_of(lot)], [1], attributes=[given | {"LOD": level}])
        if isinstance(derived, str):
            told[lot.name] = derived
        elif notes := build_part(derived, "lot", library.assets_of(derived), Textures({})).notes:
            told[lot.name] = notes[0]
    return told


@pytest.mark.parametrize("style", style_names())
def test_a_town_derives_in_every_style(veduta_data: Path, style: str) -> None:
    lots = read_lots(veduta_data / "city/delft.json").lots
    assert len(lots) >= 150
    assert faults(style, lots, level=2.0) == {}


@pytest.mark.parametrize("style", style_names())
def test_hard_outlines_derive_in_every_style(veduta_data: Path, style: str) -> None:
    """Boxes and roofs: what is hard about these outlines is their roofs."""
    lots = read_lots(veduta_data / "footprints/hard-footprints.geojson").lots
    assert len(lots) == 120
    assert faults(style, lots, level=0.0) == {}
