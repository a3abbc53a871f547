"""`veduta grammar` with assets: found beside the rules, told where they are not."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import veduta

from veduta.formats.gltf import read_glb

RULES = """
attr kind = "wedge"
Lot --> extrude(3) comp(f) { front : Front | all : Wall. }
Front --> set(material.name, "window") i({name})
"""
WEDGE = (
    "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 1 0\nv 2 1 0\n"
    "f 1 2 3 4\nf 1 5 6 2\nf 3 6 5 4\nf 1 4 5\nf 2 6 3\n"
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    square = [[0, 0], [200, 0], [200, 50], [0, 50], [0, 0]]
    (tmp_path / "lots.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [square]}))
    (tmp_path / "things").mkdir()
    (tmp_path / "things" / "wedge.obj").write_text(WEDGE)
    return tmp_path


def write(folder: Path, name: str) -> Path:
    path = folder / "house.cga"
    path.write_text(RULES.replace("{name}", name))
    return path


def test_a_file_beside_the_rules(folder: Path) -> None:
    rules, out = write(folder, '"things/" + kind + ".obj"'), folder / "out"
    call = ("grammar", "derive", rules, "--lots", folder / "lots.geojson", "-o", out, "--jobs", 1)
    assert veduta(*call).returncode == 0
    (model,) = out.glob("parts/*/*.glb")
    part = read_glb(model)
    assert part.instances is not None
    assert len(part.instances) == 1
    # 200 m by 3 m: stretched by 100 and by 3, so by 51.5 along z, where the wedge was 1 m deep.
    (row,) = part.instances.groups[0].feature.tolist()
    slope = (3.0**2 + 51.5**2) ** 0.5
    truth = 200 * 3.0 + 200 * 51.5 + 200 * slope + 3.0 * 51.5
    assert part.feature_area_m2[row] == pytest.approx(truth, rel=1e-5)
    assert (part.features.width_m[row], part.features.height_m[row]) == (200.0, 3.0)
    assert "up to date" in veduta(*call).stdout
    (folder / "things" / "wedge.obj").write_text(WEDGE.replace("v 2 1 0", "v 2 2 0"))
    changed = veduta(*call)
    assert changed.returncode == 2
    assert "--force" in changed.stderr


def test_an_asset_that_is_not_there(folder: Path) -> None:
    rules = write(folder, '"builtin/window-casment"')
    out = folder / "out"
    for action in (("check", rules), ("derive", rules, "-o", out)):
        told = veduta("grammar", *action)
        assert told.returncode == 0
        assert "a box stands for it. Did you mean `builtin/window-casement`?" in told.stdout
    assert (out / "place.json").exists()
    notes = json.loads((out / "report.json").read_text())["notes"]
    assert len([note for note in notes if "window-casment" in note]) == 1


def test_a_computed_name_that_is_not_there_leaves_a_box(folder: Path) -> None:
    rules, out = write(folder, '"things/" + kind + ".obj"'), folder / "out"
    told = veduta("grammar", "derive", rules, "-o", out, "--attr", "kind=none", "--jobs", 1)
    assert told.returncode == 0
    report = json.loads((out / "report.json").read_text())
    (note,) = [note for note in report["notes"] if "does not exist" in note]
    assert "things/none.obj" in note
    assert "1 asset of computed names cannot be had: a box stands for each" in report["notes"]
    assert "1 asset of computed names cannot be had" in told.stdout
