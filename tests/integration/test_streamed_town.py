"""A town that is streamed: derived, served by `veduta view`, exported, and walked in Chromium."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import veduta
from PIL import Image
from test_studio import CHROMIUM, show_in_chromium, viewed

from veduta.formats.tiles import contents

RULES = """
attr LOD = 2
attr height = 9
@Hidden
attr provenance = "invented"
Lot --> extrude(world.up, height) comp(f) { bottom : NIL | top : Roof | all : Front }
Front --> set(material.name, "wall") setupProjection(0, scope.xy, 2, 2) texture("plaster.png")
    projectUV(0) Storeys
Storeys --> split(y) { { ~3 : split(x) { { ~3 : Bay }* } }* }
Bay -->
    case LOD < 1 : Wall.
    else : split(x) { ~1 : Wall. | 1 : Column | ~1 : Wall. }
Column --> split(y) { ~1 : Wall. | 1.5 : Window | ~1 : Wall. }
Window --> t(0, 0, -0.2) Glass
Glass -->
    case LOD < 2 : Plain
    else : Pane
Plain --> set(material.name, "window") texture("") color("#405060") Flat.
Pane --> set(material.name, "window") texture("") color("#506070") set(provenance, "inferred") Bars.
Roof --> set(material.name, "roof") color("#803020") Tiles.
"""


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("streamed")
    rules, lots, out = folder / "a.cga", folder / "lots.geojson", folder / "out"
    rules.write_text(RULES)
    speckled = np.random.default_rng(1).integers(150, 230, (64, 64, 3)).astype(np.uint8)
    Image.fromarray(speckled).save(folder / "plaster.png")
    features = []
    for number in range(80):
        x, y = 100_000.0 + 12.0 * (number % 20), 200_000.0 + 25.0 * (number // 20)
        ring = [[x, y], [x + 12, y], [x + 12, y + 10], [x, y + 10], [x, y]]
        ring = [[*point, 0.5 * (number // 20)] for point in ring]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": f"house {number}", "geometry": shape})
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    done = veduta("grammar", "derive", rules, "--lots", lots, "-o", out)
    assert done.returncode == 0, done.stderr
    return out


def test_an_export_has_all_tiles(town: Path, tmp_path: Path) -> None:
    web = tmp_path / "web"
    assert veduta("export", town, "--web", web).returncode == 0
    names = contents(web)
    assert len([name for name in names if name.endswith(".glb")]) > 4
    assert len([name for name in names if name.startswith("textures/plaster-")]) == 1
    assert all((web / name).read_bytes() == (town / name).read_bytes() for name in names)


@pytest.mark.slow
@pytest.mark.skipif(not CHROMIUM.is_file(), reason=f"no Chromium at {CHROMIUM}")
def test_it_is_walked_in_chromium(town: Path, repository: Path) -> None:
    with viewed(town) as (_, url):
        show_in_chromium(repository, "town", "VEDUTA_TOWN_URL", url, timeout_s=500)
