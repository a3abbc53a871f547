"""Projects with very many files, and files of lots whose properties are of every type."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from veduta.grammar.assets.library import MOST_FILES
from veduta.grammar.deriving import attributes_of, deriver
from veduta.grammar.lots import read_lots
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.rules import read_rules

COUNT = 10_000
WEDGE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"
RULES = """
const all = fileSearch("trees/*.obj")
const any = fileRandom("trees/*.obj")
Lot -->
    report("files", listSize(all))
    print(listLast(all))
    split(x) { ~1 : Tree(listItem(all, 0)) | ~1 : Tree(listLast(all)) | ~1 : Tree(any) }
Tree(file) --> s(1, 2, 1) i(file) report("trees", 1) T.
"""


def test_a_project_of_ten_thousand_assets_derives(tmp_path: Path) -> None:
    folder = tmp_path / "assets" / "trees"
    folder.mkdir(parents=True)
    for number in range(COUNT):
        (folder / f"tree-{number:05d}.obj").write_text(WEDGE)
    (tmp_path / "rules").mkdir()
    path = tmp_path / "rules" / "park.cga"
    path.write_text(RULES)
    rules = read_rules(path)
    made = deriver(rules.files, rules.search, GrammarOptions())
    lot = plain_lot()
    built = made.together([lot], 2.0)
    assert made.fault(built, 0, lot) is None
    assert dict(built.reports(0)) == {"files": float(COUNT), "trees": 3.0}
    assert built.messages(0) == ["trees/tree-09999.obj"]
    assert not made.library.missing
    # Only so many are looked into where names are computed; the digest is made all the same.
    assert COUNT > MOST_FILES
    assert len(made.library.digest(made.rules)) == 64


HEIGHTS: dict[str, tuple[object, float | str]] = {
    "number": (12, 12.0),
    "text": ("12.5", 12.5),
    "metres": ("12 m", 12.0),
    "feet": ("40'", 12.192),
    "nothing": (None, 9.0),
    "list": ([1, 2], 9.0),
    "object": ({"a": 1}, 9.0),
    "huge": (1e301, 9.0),
    "truth": (True, "its property height is True, but the rules want a number"),
    "word": ("high", "its property height is 'high', but the rules want a number"),
}


@pytest.mark.parametrize("name", HEIGHTS)
def test_properties_of_mixed_types(name: str, tmp_path: Path) -> None:
    """All in one file: each lot takes what it can, and says what it cannot."""
    features = [
        {
            "type": "Feature",
            "id": key,
            "properties": {"height": value},
            "geometry": {"type": "Polygon", "coordinates": [square(20.0 * place)]},
        }
        for place, (key, (value, _)) in enumerate(HEIGHTS.items())
    ]
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    lots = {lot.id: lot for lot in read_lots(path).lots}
    assert set(lots) == set(HEIGHTS)
    rules = tmp_path / "a.cga"
    rules.write_text('attr height = 9\nLot --> extrude(height) report("height", height) A.')
    files = read_rules(rules)
    made = deriver(files.files, files.search, GrammarOptions())
    wanted = HEIGHTS[name][1]
    given = attributes_of(lots[name], dict(made.rules.attributes), GrammarOptions())
    if isinstance(wanted, str):
        assert given == wanted
        return
    assert not isinstance(given, str)
    built = made.together([lots[name]], 2.0)
    assert dict(built.reports(0)) == {"height": pytest.approx(wanted)}


def square(x: float) -> list[list[float]]:
    """The corners of a lot of 10 m."""
    ring = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)]
    return [[1000.0 + x + a, 5000.0 + b] for a, b in ring]
