"""Textures, opacity and provenance of rule files in tiles, read back as glTF says it."""

from __future__ import annotations

import json
import shutil
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from veduta import _core
from veduta.formats.cityjson_text import CLASSES
from veduta.formats.tiles import contents
from veduta.grammar.deriving import deriver
from veduta.grammar.levels import FULL
from veduta.grammar.lot import Lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.project import SearchPath
from veduta.grammar.surfaces.catalogue import mean_colour
from veduta.grammar.textures import WHITE, find_textures, mean_light, with_builtin
from veduta.grammar.tile_pictures import MAX_SIDE, picture_files, tile_pictures
from veduta.grammar.town import PROVENANCES
from veduta.place.semantics import DRAWN_ONLY, SemanticClass
from veduta.run.progress import Progress

RULES = """
attr LOD = 2
attr provenance = "invented"
Lot --> extrude(world.up, 8) comp(f) { front : Front | top : Roof | bottom : NIL | all : Plain }
Front --> set(material.name, "wall") setupProjection(0, scope.xy, 2, 4) texture("brick.png")
    projectUV(0) split(x) { { ~3 : Bay }* }
Bay --> split(x) { ~1 : Brick. | 1 : Window | ~1 : Brick. }
Window --> set(material.name, "window") texture("") color("#3060a0") set(material.opacity, 0.4)
    set(provenance, "measured") Pane.
Plain --> set(material.name, "wall") color("#ffffff") texture("nowhere.png") Side.
Roof --> set(material.name, "roof") color("#808080") texture("brick.png") Tiles.
"""
PIXELS = np.full((8, 8, 3), (200, 100, 50), dtype=np.uint8)


def lots_of(count: int) -> _core.DerivedLots:
    by = deriver((("rules.cga", RULES),), SearchPath.of(Path()), GrammarOptions())
    outline = np.array([[0.0, 0.0], [12.0, 0.0], [12.0, 9.0], [0.0, 9.0]])
    lots = [Lot(f"{k}", f"{k}", (outline,), (0.0, 0.0, 0.0), {}) for k in range(count)]
    return by.together(lots, FULL)


def mapped_points(
    buffers: _core.TileBuffers,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Place (m, z up) and texture coordinates (from the upper left) of vertices of the wall."""
    walls = {
        number
        for number, (code, *_, picture) in enumerate(buffers.materials)
        if picture is not None and CLASSES[code] == "wall"
    }
    low, step = np.array(buffers.grid)
    points, uvs = [], []
    for material, positions, _, _, _, _, uv in buffers.merged:
        if material in walls:
            at = np.frombuffer(positions, "<u2").reshape(-1, 4)[:, :3] * step + low
            points.append(np.stack([at[:, 0], -at[:, 2], at[:, 1]], axis=1))
            share = buffers.uv_steps[material]
            uvs.append(np.frombuffer(uv, "<u2").reshape(-1, 2) * share)
    return np.concatenate(points), np.concatenate(uvs)


def test_texture_coordinates_are_those_of_the_projection() -> None:
    """The front is the plane y = 0: a repeat is 2 m wide and 4 m high, from its lower left."""
    lots = lots_of(1)
    named = [("brick.png", (0.8, 0.4, 0.2))]
    buffers = lots.tile([0], [(0.0, 0.0, 0.0)], CLASSES, PROVENANCES, named, mapped=True)
    points, uv = mapped_points(buffers)
    assert len(points) >= 12
    assert np.abs(points[:, 1]).max() < 1e-2
    truth = np.stack([points[:, 0] / 2, 1 - points[:, 2] / 4], axis=1)
    off = uv - truth
    assert np.abs(off - np.round(off)).max() < 1e-3
    # Whole repeats are left out, and no piece is stretched.
    assert uv.min() >= 0
    assert uv.max() < 8


def test_pieces_that_repeat_keep_their_place_on_the_texture() -> None:
    """Forty fronts of one lot: bays two apart show the same part of the texture, others do not."""
    lots = lots_of(40)
    places = [(20.0 * k, 0.0, 0.0) for k in range(40)]
    named = [("brick.png", (0.8, 0.4, 0.2))]
    buffers = lots.tile(list(range(40)), places, CLASSES, PROVENANCES, named, mapped=True)
    walls = [n for n, row in enumerate(buffers.materials) if row[4] is not None]
    shared = [one for one in buffers.repeated if one[0] in walls]
    assert shared
    for material, positions, *_, uv in shared:
        at = np.frombuffer(positions, "<i2").reshape(-1, 4)[:, :3] * buffers.step_m
        told = np.frombuffer(uv, "<u2").reshape(-1, 2) * buffers.uv_steps[material]
        across = np.ptp(at, axis=0)
        size = np.sort(across[across > 1e-2])
        spans = np.ptp(told, axis=0)
        if len(size) == 2 and CLASSES[buffers.materials[material][0]] == "wall":
            assert sorted([2 * spans[0], 4 * spans[1]]) == pytest.approx(size, abs=5e-3)


def test_looks_tell_opacity_provenance_and_what_is_not_there() -> None:
    lots = lots_of(1)
    named = [("brick.png", (0.8, 0.4, 0.2))]
    place = [(0.0, 0.0, 0.0)]
    near = lots.tile([0], place, CLASSES, PROVENANCES, named, mapped=True)
    looks = {(CLASSES[row[0]], row[4]): row for row in near.materials}
    _, known, colour, opacity, _ = looks[("window", None)]
    assert (PROVENANCES[known], round(opacity, 2)) == ("measured", 0.4)
    assert [round(255 * channel) for channel in colour] == [0x30, 0x60, 0xA0]
    assert looks[("wall", None)][2] == pytest.approx((1, 1, 1))  # nowhere.png
    assert looks[("wall", 0)][2] == pytest.approx((1, 1, 1))
    assert PROVENANCES[looks[("roof", 0)][1]] == "invented"
    far = lots.tile([0], place, CLASSES, PROVENANCES, named)
    assert not far.uv_steps
    told = {CLASSES[row[0]]: row[2] for row in far.materials if min(row[2]) < 1}
    assert told["wall"] == pytest.approx((0.8, 0.4, 0.2), abs=3e-3)
    assert told["roof"] == pytest.approx((0.4, 0.2, 0.1), abs=3e-3)
    assert lots.colour(0, "roof", named) == pytest.approx((0.4, 0.2, 0.1), abs=3e-3)


def test_means_are_of_light() -> None:
    """Half black and half white reflect half of the light: sRGB 188 (IEC 61966-2-1)."""
    board = np.zeros((600, 1200, 3), dtype=np.uint8)
    board[:, 600:] = 255
    assert [round(255 * channel) for channel in mean_light(board)] == [188] * 3


def test_files_are_small_and_have_names_of_their_own(tmp_path: Path) -> None:
    for name, pixels in (("a", np.zeros((100, 4000, 3), dtype=np.uint8)), ("b", PIXELS)):
        Image.fromarray(pixels).save(tmp_path / f"{name}.png")
    wide, small = str(tmp_path / "a.png"), str(tmp_path / "b.png")
    names = {"a/wall.jpg": wide, "b/wall.jpg": small, "\u00e9/..\u00e8": small}
    files = picture_files(names, [(name, WHITE) for name in names])
    assert len(files) == 3
    assert [picture.file for picture in tile_pictures(names)] == list(files)
    assert all(name.isascii() and name.count("/") == 1 and ".." not in name for name in files)
    import io

    sizes = [Image.open(io.BytesIO(data)).size for data in files.values()]
    assert sizes[:2] == [(MAX_SIDE, round(MAX_SIDE / 40)), (8, 8)]


def test_built_in_pictures_are_not_painted_for_their_means(tmp_path: Path) -> None:
    text = 'Lot --> texture("builtin/textures/slate") Roof.'
    files = with_builtin(find_textures(tmp_path / "rules.cga", [text]))
    means = {picture.name: picture.mean for picture in tile_pictures(files)}
    assert {"builtin/textures/slate", "builtin/textures/stone"} <= means.keys()
    assert all(mean == mean_colour(name) for name, mean in means.items())


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    (folder / "rules.cga").write_text(RULES)
    Image.fromarray(PIXELS).save(folder / "brick.png")
    features = []
    for number in range(70):
        x, y = 14.0 * (number % 10), 25.0 * (number // 10)
        ring = [[x, y], [x + 12, y], [x + 12, y + 9], [x, y + 9], [x, y]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "geometry": shape, "properties": {"id": f"{number}"}})
    lots = folder / "lots.geojson"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    out = folder / "out"
    rules = str(folder / "rules.cga")
    result = run_derive(rules, lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    assert result.built.count == 70
    return out


def document(path: Path) -> dict[str, Any]:
    data = path.read_bytes()
    found: dict[str, Any] = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
    return found


def test_all_tiles_share_one_file(town: Path) -> None:
    named = "?" * 8  # CityJSON has one in the colour of the wall beside it
    (picture,) = town.glob(f"textures/*-{named}.jpg")
    near = sorted(town.glob("parts/*/tiles/*-full.glb"))
    assert len(near) > 1
    for path in near:
        told = document(path)
        (image,) = told["images"]
        assert (path.parent / image["uri"]).resolve() == picture.resolve()
        assert "KHR_texture_transform" in told["extensionsRequired"]
        assert "TEXCOORD_0" in json.dumps(told["meshes"])
        looks = {look["name"]: look for look in told["materials"]}
        assert looks["window"]["alphaMode"] == "BLEND"
        assert looks["window"]["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.4
        assert looks["window"]["extras"] == {"veduta": {"provenance": "measured"}}
    for path in town.glob("parts/*/tiles/*-volume.glb"):
        told = document(path)
        assert "images" not in told
        colours = [m["pbrMetallicRoughness"]["baseColorFactor"] for m in told["materials"]]
        assert any(max(colour[:3]) < 0.9 for colour in colours)
    assert f"textures/{picture.name}" in contents(town)


def test_tiles_show_built_in_textures_whose_names_are_computed(tmp_path: Path) -> None:
    rules = tmp_path / "rules.cga"
    rules.write_text(
        'attr kind = "brick"\n'
        "Lot --> extrude(6) comp(f) { side : Wall | all : NIL }\n"
        "Wall --> setupProjection(0, scope.xy, 1, 1) "
        'texture("builtin/textures/" + kind) projectUV(0)'
    )
    out = tmp_path / "out"
    run_derive(str(rules), None, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    (picture,) = (out / "textures").iterdir()
    (tile,) = out.glob("parts/*/tiles/*-full.glb")
    (image,) = document(tile)["images"]
    assert (tile.parent / image["uri"]).resolve() == picture.resolve()
    assert picture.name.startswith("brick-")


def test_a_picture_that_leads_out_is_refused(town: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    shutil.copytree(town, other)
    tile = sorted(other.glob("parts/*/tiles/*-full.glb"))[0]
    data = tile.read_bytes()
    tile.write_bytes(data.replace(b'"../../../textures', b'"../../../../xtures'))
    with pytest.raises(ValueError, match="leads out"):
        contents(other)


def test_the_codes_are_those_of_the_place() -> None:
    assert len(CLASSES) == len(SemanticClass)
    for code, name in enumerate(CLASSES):
        known = SemanticClass.of_code(code)
        # Rules of others call surfaces what they like: none of theirs is drawn only.
        assert (name == known) is (known not in DRAWN_ONLY)
