"""Assets of files with pictures: in the part of a lot, in its tile, mirrored, and taken apart."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from pictured_quads import BLUE, GREEN, QUARTERS, RED, WHITE, png, write_dae, write_glb, write_obj

from veduta import _core, grammar
from veduta.formats.cityjson_text import CLASSES
from veduta.grammar.assets.library import Library
from veduta.grammar.assets.pictures import picture_name
from veduta.grammar.building import build_part
from veduta.grammar.deriving import deriver
from veduta.grammar.levels import FULL
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.project import SearchPath
from veduta.grammar.textures import Textures, is_cut, textures_digests
from veduta.grammar.tile_pictures import tile_pictures
from veduta.grammar.town import PROVENANCES
from veduta.place.instances import placed
from veduta.place.part import Part
from veduta.run.errors import InputError
from veduta.run.progress import Progress

WRITERS = {"obj": write_obj, "glb": write_glb, "dae": write_dae}
MADE = {
    "as it is": ("", QUARTERS),
    "mirrored": (
        "mirror(true, false, false)",
        {(-1, 1): GREEN, (1, 1): RED, (-1, -1): WHITE, (1, -1): BLUE},
    ),
    "by its size": ("s(-2, '1, '1)", {(-1, 1): GREEN, (1, 1): RED, (-1, -1): WHITE, (1, -1): BLUE}),
    "inside out": ("reverseNormals()", QUARTERS),
}
"""Operations after `i`, and the colour of each corner where it then is in the part."""
Corners = dict[tuple[int, int], tuple[int, ...]]


def rules_of(kind: str, operations: str = "", colour: str = "", last: str = "Quad.") -> str:
    return f'Lot --> t(3, 0, 4) s(2, 1, 0) {colour} i("quad.{kind}") {operations} {last}'


def built(folder: Path, rules: str) -> tuple[Part, Library, _core.DerivedLots]:
    by = deriver((("rules.cga", rules),), SearchPath.of(folder), GrammarOptions())
    lots = by.together([plain_lot(20, 30)], FULL)
    columns = lots.columns(0)
    textures = Textures(by.library.pictures)
    return build_part(columns, "quad", by.library.assets_of(columns), textures), by.library, lots


def pixel(pixels: NDArray[np.uint8], u: float, v: float) -> tuple[int, ...]:
    """The colour at a place from the upper left."""
    height, width = pixels.shape[:2]
    column, row = math.floor((u % 1.0) * width), math.floor((v % 1.0) * height)
    return tuple(pixels[row, column].tolist())


def corners_seen(
    points: NDArray[np.float64], uv: NDArray[np.float64], pixels: NDArray[np.uint8]
) -> Corners:
    """The colour a little inside of each corner: left or right (x), low or high (z)."""
    middle = (uv.min(axis=0) + uv.max(axis=0)) / 2.0
    x, z = points[:, 0], points[:, 2]
    found: Corners = {}
    for row, place in enumerate(uv):
        side = (
            1 if x[row] > (x.min() + x.max()) / 2 else -1,
            1 if z[row] > (z.min() + z.max()) / 2 else -1,
        )
        u, v = (place + 0.05 * (middle - place)).tolist()
        found[side] = pixel(pixels, u, v)
    return found


def seen_in_part(part: Part) -> Corners:
    assert part.instances is not None
    (group,) = part.instances.groups
    mesh = part.instances.meshes[group.mesh]
    assert mesh.uv is not None
    points = placed(group.part_from_mesh, mesh.positions_m.astype(np.float64))[0]
    (texture,) = {part.materials[row].texture for row in group.materials} - {None}
    assert texture is not None
    return corners_seen(points, mesh.uv.astype(np.float64), texture.pixels)


@pytest.mark.parametrize("kind", WRITERS)
def test_an_asset_shows_its_picture(tmp_path: Path, kind: str) -> None:
    WRITERS[kind](tmp_path)
    part, library, _ = built(tmp_path, rules_of(kind))
    assert seen_in_part(part) == QUARTERS
    ending = "quad.glb#0" if kind == "glb" else "four.png"
    assert list(library.pictures) == [f"asset:{ending}"]
    assert library.notes() == []


@pytest.mark.parametrize("name", MADE)
def test_what_rules_do_to_an_asset_is_done_to_its_picture(tmp_path: Path, name: str) -> None:
    write_obj(tmp_path)
    operations, expected = MADE[name]
    assert seen_in_part(built(tmp_path, rules_of("obj", operations))[0]) == expected


@pytest.mark.parametrize("name", MADE)
def test_a_tile_shows_what_the_part_shows(tmp_path: Path, name: str) -> None:
    write_obj(tmp_path)
    operations, expected = MADE[name]
    _, library, lots = built(tmp_path, rules_of("obj", operations))
    pictures = tile_pictures(library.pictures)
    named = [picture.named for picture in pictures]
    place = [(0.0, 0.0, 0.0)]
    tile = lots.tile([0], place, CLASSES, PROVENANCES, named, mapped=True)
    (merged,) = tile.merged
    material, positions, _, _, _, _, uvs = merged
    assert tile.materials[material][4] == 0
    at = np.frombuffer(positions, "<u2").reshape(-1, 4)[:, :3].astype(np.float64)
    z_up = np.stack([at[:, 0], -at[:, 2], at[:, 1]], axis=1)
    uv = np.frombuffer(uvs, "<u2").reshape(-1, 2) * tile.uv_steps[material]
    pixels = Textures(library.pictures)[pictures[0].name].pixels
    assert corners_seen(z_up, uv, pixels) == expected
    # From afar it has its mean colour.
    far = lots.tile([0], place, CLASSES, PROVENANCES, named)
    assert far.materials[0][2] == pytest.approx(pictures[0].mean, abs=2 / 255)
    unknown = lots.tile([0], place, CLASSES, PROVENANCES, [], mapped=True)
    assert unknown.materials[0][2] == pytest.approx(pictures[0].mean, abs=2 / 255)


def test_a_colour_multiplies_the_picture(tmp_path: Path) -> None:
    write_dae(tmp_path)  # without a colour of its own
    part, _, _ = built(tmp_path, rules_of("dae", colour='color("#ff8000")'))
    (material,) = [one for one in part.materials if one.texture is not None]
    assert material.colour == pytest.approx((1.0, 0.502, 0.0), abs=1e-3)


def test_taken_apart_it_has_the_mean_colour_of_its_picture(tmp_path: Path) -> None:
    write_obj(tmp_path)
    part, library, _ = built(tmp_path, rules_of("obj", "comp(m) { all : Skin. }", last=""))
    assert part.instances is None
    (slot,) = library["quad.obj"].slots
    # Half of the light of each channel (IEC 61966-2-1): red in two quarters, and so on.
    assert slot.mean == pytest.approx((0.735, 0.735, 0.735), abs=2e-3)
    colours = {part.materials[row].colour for row in part.polygon_material.tolist()}
    assert colours == {tuple(round(channel, 4) for channel in slot.mean)}


def test_a_picture_that_is_not_there_leaves_the_colour(tmp_path: Path) -> None:
    path = write_obj(tmp_path, named="gone.png")
    (tmp_path / "quad.mtl").write_text("newmtl skin\nKd 0.2 0.4 0.6\nmap_Kd gone.png\n")
    part, library, _ = built(tmp_path, rules_of("obj"))
    assert [one.colour for one in part.materials if one.name == "skin"] == [(0.2, 0.4, 0.6)]
    (told,) = library.notes()
    assert "quad.obj" in told
    assert "gone.png" in told
    (path.parent / "gone.png").write_bytes(b"no picture")
    part, library, _ = built(tmp_path / ".", rules_of("obj", colour='color("#123456")'))
    assert [one.colour for one in part.materials if one.name == "skin"] == [(0.2, 0.4, 0.6)]
    assert "gone.png" in library.notes()[0]


def test_faces_without_places_leave_the_colour(tmp_path: Path) -> None:
    path = write_obj(tmp_path)
    path.write_text(path.read_text().replace("f 1/1 2/2 3/3 4/4", "f 1 2 3 4"))
    part, library, _ = built(tmp_path, rules_of("obj"))
    assert all(one.texture is None for one in part.materials)
    assert "no places on its picture" in library.notes()[0]


def test_names_do_not_depend_on_where_the_project_lies(tmp_path: Path) -> None:
    rules, assets = tmp_path / "rules", tmp_path / "assets"
    search = SearchPath((rules, assets), (str(tmp_path),))
    for folder in (rules, assets):
        (folder / "in").mkdir(parents=True)
        (folder / "in/a.png").write_bytes(png())
    assert picture_name(str(rules / "in/a.png"), search) == "asset:in/a.png"
    assert picture_name(str(assets / "in/a.png"), search) == "asset1:in/a.png"
    assert picture_name(f"{assets}/tree.glb#3", search) == "asset1:tree.glb#3"


def test_another_picture_is_another_result(tmp_path: Path) -> None:
    for kind, writer in WRITERS.items():
        writer(tmp_path)
        for name in (f'"quad.{kind}"', f'"qu" + "ad.{kind}" + ext'):
            rules = _core.GrammarRules([("r.cga", f'attr ext = ""\nLot --> i({name})')])
            library = Library(tmp_path)
            found, notes = library.textures(rules)
            assert notes == ()
            assert found
            before = textures_digests(found)
            for file in ("four.png", "quad.glb"):
                if (tmp_path / file).exists():
                    data = (tmp_path / file).read_bytes()
                    (tmp_path / file).write_bytes(data + b"\0")
            assert textures_digests(found) != before
            writer(tmp_path)


def test_leaves_are_seen_through(tmp_path: Path) -> None:
    alpha = np.full((16, 16), 255, dtype=np.uint8)
    alpha[:8, :8] = 0
    write_glb(tmp_path, image=png(alpha), material={"alphaMode": "MASK"})
    part, library, _ = built(tmp_path, rules_of("glb"))
    (material,) = [one for one in part.materials if one.texture is not None]
    assert material.texture is not None
    assert material.texture.cut
    assert material.two_sided
    (path,) = library.pictures.values()
    assert is_cut(path)
    (picture,) = tile_pictures(library.pictures)
    assert picture.file.endswith(".png")


def test_a_derived_town_has_the_pictures(tmp_path: Path) -> None:
    """By a computed name, in a process of its own: in the building's model and in the tiles."""
    (tmp_path / "rules").mkdir()
    write_obj(tmp_path / "rules")
    (tmp_path / "rules/town.cga").write_text(
        'attr kind = "quad"\nLot --> s(\'1, 1, 0) i(kind + ".obj") Quad.'
    )
    lots = tmp_path / "lots.geojson"
    ring = [[0, 0], [20, 0], [20, 10], [0, 10], [0, 0]]
    feature = {
        "type": "Feature",
        "properties": {},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
    lots.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": [feature]}))
    out = tmp_path / "out"
    result = run_derive(
        str(tmp_path / "rules/town.cga"), lots, out, GrammarOptions(), Progress(quiet=True), jobs=1
    )
    assert result.exit_code == 0, result.failures
    (picture,) = (out / "textures").iterdir()
    assert picture.name.startswith("asset-four-")
    (tile,) = out.glob("parts/*/tiles/*-full.glb")
    assert picture.name.encode() in tile.read_bytes()
    (model,) = (one for one in out.glob("parts/*/*.glb"))
    assert b"baseColorTexture" in model.read_bytes()


def test_programs_have_the_pictures_too(tmp_path: Path) -> None:
    write_obj(tmp_path)
    (tmp_path / "r.cga").write_text('attr k = "quad"\nLot --> s(2, 1, 0) i(k + ".obj") Quad.')
    rules = grammar.parse(tmp_path / "r.cga")
    part = grammar.derive(rules, [[(0, 0), (9, 0), (9, 9), (0, 9)]]).part()
    assert any(one.texture is not None for one in part.materials)


def test_places_must_fit_the_corners(tmp_path: Path) -> None:
    write_obj(tmp_path)
    rules = _core.GrammarRules([("r.cga", "Lot --> X.")])
    asset = Library(tmp_path)["quad.obj"]
    assert asset.uv is not None
    faces = (asset.points_m, asset.corners, asset.offsets, asset.box_m)
    with pytest.raises(ValueError, match="no faces of points"):
        rules.add_asset("one", *faces, uv=asset.uv[1:])
    with pytest.raises(InputError):
        Library(tmp_path)["gone.obj"]
