"""The Khronos glTF validator and cjval on the files that we write."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from sample_document import element, sample_document, sample_photo

from veduta.facade.document import FacadeDocument
from veduta.facade.model import build_part
from veduta.facade.options import ModelSizes
from veduta.formats.cityjson import write_cityjson
from veduta.formats.gltf import read_glb, write_glb
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.place.semantics import SemanticClass
from veduta.run.progress import Progress

ROOT = Path(__file__).resolve().parents[2]
CJVAL_COMMAND = "cargo install cjval --features build-binary --root build/cjval"
GLTF_COMMAND = "npm ci --prefix studio"
_SCRIPT = """
const validator = require(process.argv[1] + '/gltf-validator');
const { dirname, join } = require('path');
const read = (path) => new Uint8Array(require('fs').readFileSync(path));
const beside = async (uri) => read(join(dirname(process.argv[2]), decodeURIComponent(uri)));
const asked = validator.validateBytes(read(process.argv[2]), { externalResourceFunction: beside });
asked.then((report) => console.log(JSON.stringify(report.issues)));
"""


def documents() -> dict[str, FacadeDocument]:
    crowded = [element("window", 0.1 * k, 0.4 * k, 1.5, 1.5) for k in range(30)]
    return {
        "sample": sample_document(),
        "bare": sample_document(elements=[], roof_m=0.0),
        "crowded": sample_document(elements=[*crowded, element("shop", -1.0, -1.0, 20.0, 4.0)]),
    }


def validate_gltf(path: Path) -> dict[str, Any]:
    modules = ROOT / "studio" / "node_modules"
    node = shutil.which("node")
    if node is None or not (modules / "gltf-validator").is_dir():
        pytest.skip(f"no glTF validator: {GLTF_COMMAND}")
    done = subprocess.run(
        [node, "-e", _SCRIPT, str(modules), str(path)], capture_output=True, text=True, check=True
    )
    report: dict[str, Any] = json.loads(done.stdout)
    return report


def validate_city(path: Path) -> dict[str, Any]:
    installed = ROOT / "build" / "cjval" / "bin" / "cjval"
    program = str(installed) if installed.is_file() else shutil.which("cjval")
    if program is None:
        pytest.skip(f"no cjval: {CJVAL_COMMAND}")
    done = subprocess.run([program, "-r", str(path)], capture_output=True, text=True, check=True)
    report: dict[str, Any] = json.loads(done.stdout)
    return report


@pytest.mark.parametrize("name", list(documents()))
@pytest.mark.parametrize("setback_m", [0.0, 0.2])
def test_files_are_valid(tmp_path: Path, name: str, setback_m: float) -> None:
    sizes = ModelSizes(setback_m=setback_m)
    document = documents()[name].model_copy(update={"model": sizes})
    part = build_part(document, sample_photo(document), name)
    write_glb(part, tmp_path / "model.glb")
    write_cityjson(part, tmp_path / "model.city.json")
    issues = validate_gltf(tmp_path / "model.glb")
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    report = validate_city(tmp_path / "model.city.json")
    assert (report["valid"], report["has_warnings"]) == (True, False), report["checks"]


def test_repeated_assets_are_valid(tmp_path: Path) -> None:
    rules = tmp_path / "rules.cga"
    rules.write_text(
        "Lot --> extrude(6) comp(f) { side : Front | all : Plain. }\n"
        "Front --> split(x) { { ~2 : split(y) { { ~3 : Bay }* } }* }\n"
        'Bay --> set(material.name, "window") i("builtin/window-casement@" + split.index)\n'
    )
    out = tmp_path / "out"
    options = GrammarOptions()
    lots = tmp_path / "lots.geojson"
    square = [[0, 0], [600, 0], [600, 20], [0, 20], [0, 0]]
    lots.write_text(json.dumps({"type": "Polygon", "coordinates": [square]}))
    run_derive(str(rules), lots, out, options, Progress(quiet=True), jobs=1)
    (model,) = out.glob("parts/*/*.glb")
    issues = validate_gltf(model)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    part = read_glb(model)
    assert part.instances is not None
    assert len(part.instances) == int((part.features.class_code == SemanticClass.WINDOW.code).sum())


def test_a_style_is_textured_and_valid(tmp_path: Path) -> None:
    out = tmp_path / "out"
    lots = tmp_path / "lots.geojson"
    square = [[0, 0], [14, 0], [14, 12], [0, 12], [0, 0]]
    lots.write_text(json.dumps({"type": "Polygon", "coordinates": [square]}))
    run_derive("haussmann", lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    (model,) = out.glob("parts/*/*.glb")
    issues = validate_gltf(model)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    part = read_glb(model)
    assert not [note for note in part.notes if "texture" in note]
    textured = np.array([material.texture is not None for material in part.materials])
    shown = textured[part.polygon_material]
    for semantic in (SemanticClass.WALL, SemanticClass.ROOF):
        of_class = part.features.class_code[part.polygon_feature] == semantic.code
        assert shown[of_class].mean() > 0.7
    assert part.instances is not None
    stones = [g for g in part.instances.groups if textured[list(g.materials)].any()]
    assert stones
    assert all(part.instances.meshes[group.mesh].uv is not None for group in stones)


def test_tiles_with_pictures_and_ground_are_valid(tmp_path: Path) -> None:
    rules = tmp_path / "rules.cga"
    rules.write_text(
        "attr LOD = 2\n"
        "Lot --> extrude(6) comp(f) { side : Front | top : Roof | bottom : NIL }\n"
        'Front --> setupProjection(0, scope.xy, 2, 2) texture("wall.png") projectUV(0) Bays\n'
        "Bays --> split(x) { { ~2 : split(y) { { ~3 : Bay }* } }* }\n"
        'Bay --> set(material.name, "wall") split(x) { ~1 : Wall. | 1 : Window | ~1 : Wall. }\n'
        'Window --> set(material.name, "window") set(material.opacity, 0.5) Pane.\n'
        'Roof --> set(material.name, "roof") texture("wall.png") Tiles.\n'
    )
    Image.fromarray(np.full((8, 8, 3), 99, np.uint8)).save(tmp_path / "wall.png")
    features = []
    for number in range(70):
        x, z = 20.0 * number, 0.3 * number
        ring = [[x, 0, z], [x + 15, 0, z], [x + 15, 12, z], [x, 12, z], [x, 0, z]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": number, "geometry": shape, "properties": {}})
    lots, out = tmp_path / "lots.geojson", tmp_path / "out"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    run_derive(str(rules), lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    tiles = [*out.glob("parts/00/tiles/*.glb"), *out.glob("ground/00.glb")]
    assert len(tiles) >= 4
    for tile in tiles:
        issues = validate_gltf(tile)
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    (picture,) = (out / "textures").iterdir()
    picture.write_bytes(b"no picture")
    told = [validate_gltf(tile) for tile in tiles]
    assert sum(issues["numErrors"] + issues["numWarnings"] for issues in told) > 0


def test_the_ground_of_a_few_lots_is_valid(tmp_path: Path) -> None:
    rules, lots, out = tmp_path / "rules.cga", tmp_path / "lots.geojson", tmp_path / "out"
    rules.write_text("Lot --> extrude(6) comp(f) { bottom : NIL | all : Wall. }\n")
    features = []
    for number in range(9):
        x, y, z = 20.0 * (number % 3), 20.0 * (number // 3), 0.4 * number
        ring = [[x, y, z], [x + 15, y, z], [x + 15, y + 12, z], [x, y + 12, z], [x, y, z]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": number, "geometry": shape, "properties": {}})
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    run_derive(str(rules), lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    for file in ("ground/00.glb", "ground/00-model.glb"):
        issues = validate_gltf(out / file)
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    city = out / "city.city.json"
    assert '"TINRelief"' in city.read_text()
    assert validate_city(city)["valid"] is True


def test_the_validators_see_a_broken_file(tmp_path: Path) -> None:
    document = sample_document()
    part = build_part(document, sample_photo(document), "broken")
    glb, city = tmp_path / "model.glb", tmp_path / "model.city.json"
    write_glb(part, glb)
    glb.write_bytes(glb.read_bytes().replace(b'"VEC3"', b'"VEC4"', 1))
    assert validate_gltf(glb)["numErrors"] > 0
    write_cityjson(part, city)
    city.write_text(city.read_text().replace('"GroundSurface"', '"CellarSurface"'))
    assert validate_city(city)["valid"] is False
