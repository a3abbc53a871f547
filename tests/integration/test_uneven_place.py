"""A few lots at different heights: derived, served by `veduta view`, and walked in Chromium."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import veduta
from test_studio import CHROMIUM, show_in_chromium, viewed

RULES = "Lot --> extrude(5) Mass\nMass --> comp(f) { top : Roof. | bottom : NIL | all : Wall. }\n"
HIGH_M = 3.0
"""How high the front row lies over the lot behind it; `uneven.test.ts` knows it, too."""


@pytest.mark.slow
@pytest.mark.skipif(not CHROMIUM.is_file(), reason=f"no Chromium at {CHROMIUM}")
def test_its_ground_is_walked_in_chromium(tmp_path: Path, repository: Path) -> None:
    rules, lots, out = tmp_path / "a.cga", tmp_path / "lots.geojson", tmp_path / "out"
    rules.write_text(RULES)
    features = []
    for x, y, z in [*((12.0 * k, 0.0, HIGH_M) for k in range(4)), (18.0, 30.0, 0.0)]:
        ring = [[x, y, z], [x + 12, y, z], [x + 12, y + 10, z], [x, y + 10, z], [x, y, z]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "geometry": shape, "properties": {}})
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    assert veduta("grammar", "derive", rules, "--lots", lots, "-o", out).returncode == 0
    with viewed(out) as (_, url):
        show_in_chromium(repository, "uneven", "VEDUTA_UNEVEN_URL", url, timeout_s=400)
