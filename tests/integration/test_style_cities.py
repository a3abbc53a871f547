"""The styles as CityJSON with closed volumes, checked by cjval."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest
from command_line import read_json, veduta
from test_grammar_verb import lots_json
from test_validators import validate_city


@pytest.mark.parametrize("style", ["haussmann", "modern-slab", "suburban-house"])
def test_every_building_has_a_volume(tmp_path: Path, style: str) -> None:
    lots, out = tmp_path / "lots.geojson", tmp_path / "out"
    lots.write_text(json.dumps(lots_json(3)))
    done = veduta("grammar", "derive", style, "--lots", lots, "-o", out)
    assert done.returncode == 0, done.stderr
    city = validate_city(out / "city.city.json")
    assert (city["valid"], city["has_warnings"]) == (True, False), city["checks"]
    objects = read_json(out / "city.city.json")["CityObjects"].values()
    kinds = Counter(
        (geometry["type"], geometry["lod"])
        for one in objects
        if one["type"] == "Building"
        for geometry in one["geometry"]
    )
    assert (kinds["Solid", "1.2"], kinds["Solid", "2.2"]) == (3, 3)
