"""CityJSON of lots with edits: those have one level of detail, and no lower one is told."""

from __future__ import annotations

import json
from pathlib import Path

from rows_of_houses import write_row

from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.run.progress import Progress

RULES = """
attr LOD = 2
attr height = 6
Lot --> extrude(world.up, height) Sides
Sides -->
    case LOD < 1 : Block.
    else : comp(f) { top : roofGable(45) Roof | bottom : NIL | all : Wall. }
Roof --> comp(f) { bottom : NIL | all : Slope. }
"""


def test_a_lot_with_edits_has_its_full_detail_alone(tmp_path: Path) -> None:
    rules, lots, edits = (tmp_path / name for name in ("a.cga", "lots.geojson", "edits.txt"))
    rules.write_text(RULES)
    write_row(lots, 2)
    edits.write_text("house-1 /:Lot height = 9\n")
    out = tmp_path / "out"
    result = run_derive(
        str(rules),
        lots,
        out,
        GrammarOptions(),
        Progress(quiet=True),
        jobs=1,
        edits_path=edits,
    )
    assert result.exit_code == 0
    city = json.loads((out / "city.city.json").read_text())
    lods = {
        name: {geometry["lod"] for geometry in city["CityObjects"][name]["geometry"]}
        for name in ("house-0", "house-1")
    }
    assert lods["house-0"] == {"3", "2.2"}
    assert lods["house-1"] == {"3"}
