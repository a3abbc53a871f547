"""Texturing as a whole: a painted front comes back out of pictures of it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from painted_wall import TEXEL_M, PaintedWall, painted_wall
from PIL import Image

from veduta.formats.gltf import read_glb
from veduta.imaging.srgb import linear_of_srgb
from veduta.photos.options import TextureOptions
from veduta.photos.texture.compose import FaceTexture
from veduta.photos.texture.files import write_texture_files
from veduta.photos.texture.part import TexturedBuilding
from veduta.photos.texture.recipe import TexturedModel, texture_model
from veduta.photos.texture.report import TextureTold
from veduta.photos.texture.views import View
from veduta.place.semantics import Provenance
from veduta.run.errors import NotFoundError

GAINS = (1.0, 0.7, 1.3, 0.85, 1.15)


def textured(wall: PaintedWall) -> TexturedModel:
    return texture_model(wall.views, wall.city, TextureOptions(texel_m=TEXEL_M))


def front_of(building: TexturedBuilding) -> FaceTexture:
    found = [texture for _, texture in building.faces if texture is not None]
    assert len(found) == 1
    return found[0]


def off(wall: PaintedWall, texture: FaceTexture) -> np.ndarray:
    """Share by which the light is off, but for one gain of all."""
    light = linear_of_srgb(texture.pixels / 255.0)
    true = linear_of_srgb(wall.paint / 255.0)
    inner = (slice(8, -8), slice(8, -8))
    ratio = light[inner] / true[inner]
    found: np.ndarray = np.abs(ratio / np.median(ratio, axis=(0, 1)) - 1.0).mean(axis=-1)
    return found


def test_a_painted_front_comes_back_levelled() -> None:
    wall = painted_wall(GAINS)
    model = textured(wall)
    texture = front_of(next(model.buildings))
    assert texture.pixels.shape == wall.paint.shape
    assert texture.seen_share > 0.9
    assert np.median(off(wall, texture)) < 0.03
    assert np.quantile(off(wall, texture), 0.99) < 0.15
    levelled = model.gains * wall.gains[:, None]
    np.testing.assert_allclose(levelled / levelled.mean(axis=0), 1.0, atol=0.02)


def test_what_stands_before_the_wall_in_one_view_is_left_out() -> None:
    wall = painted_wall(GAINS, car=True)
    assert np.quantile(off(wall, front_of(next(textured(wall).buildings))), 0.995) < 0.2


def test_what_no_photo_shows_is_marked_and_not_called_measured() -> None:
    wall = painted_wall(GAINS[:1])
    narrow = wall.views[0]
    half = np.zeros((360, 480), dtype=np.bool_)
    half[:, :200] = True
    view = View(narrow.name, narrow.camera, narrow.cam_from_world, narrow.pixels, lambda: half)
    building = next(texture_model([view], wall.city, TextureOptions(texel_m=TEXEL_M)).buildings)
    texture = front_of(building)
    assert 0.05 < texture.seen_share < 0.6
    assert texture.invented.mean() == pytest.approx(1 - texture.seen_share, abs=0.02)
    part = building.part
    walls = [row for row in range(len(part.features)) if "wall" in part.features.name[row]]
    sides = {part.features.provenance(row) for row in walls[2:]}
    assert sides == {Provenance.INFERRED}


def test_photos_of_something_else_are_refused() -> None:
    wall = painted_wall(GAINS[:2])
    back = np.diag([-1.0, 1.0, -1.0])
    away = [View(one.name, one.camera, back @ one.cam_from_world, one.pixels) for one in wall.views]
    with pytest.raises(NotFoundError, match="none of"):
        texture_model(away, wall.city, TextureOptions())


def test_the_same_input_gives_the_same_textures() -> None:
    first, second = (
        front_of(next(textured(painted_wall(GAINS, car=True)).buildings)) for _ in range(2)
    )
    np.testing.assert_array_equal(first.pixels, second.pixels)
    np.testing.assert_array_equal(first.invented, second.invented)


def test_files_say_the_same_as_the_model(tmp_path: Path) -> None:
    """A texel looked up through CityJSON's texture vertices is that of the painted front."""
    wall = painted_wall(GAINS)
    model = textured(wall)
    files = write_texture_files(model, tmp_path)
    city = json.loads((tmp_path / "model.city.json").read_text())
    appearance = city["appearance"]
    picture = np.asarray(Image.open(tmp_path / appearance["textures"][0]["image"]))
    geometry = city["CityObjects"]["house"]["geometry"][0]
    assert (geometry["type"], geometry["lod"]) == ("Solid", "1")
    values = geometry["texture"]["photos"]["values"][0]
    shown = [row for row, rings in enumerate(values) if rings[0] != [None]]
    assert shown == [0, 1]
    height, width = picture.shape[:2]
    for row in shown:
        ring = geometry["boundaries"][0][row][0]
        vertices = np.array(city["vertices"])[ring] * 1e-3 + city["transform"]["translate"]
        uv = np.array(appearance["vertices-texture"])[values[row][0][1:]]
        middle_uv, middle = uv.mean(axis=0), vertices.mean(axis=0)
        x, y = round(middle_uv[0] * width), round((1 - middle_uv[1]) * height)
        true_x, true_y = round(middle[0] / TEXEL_M), round((3.0 - middle[2]) / TEXEL_M)
        here = picture[y - 5 : y + 5, x - 5 : x + 5].astype(float)
        there = wall.paint[true_y - 5 : true_y + 5, true_x - 5 : true_x + 5].astype(float)
        assert np.abs(here - there).mean() < 12
    mask = np.asarray(Image.open(tmp_path / files.pictures[0].replace(".jpg", "_mask.png")))
    assert mask.shape == picture.shape[:2]
    assert read_glb(tmp_path / files.parts[0].model) is not None
    tree = json.loads((tmp_path / "tileset.json").read_text())
    assert [one["content"]["uri"] for one in tree["root"]["children"]] == ["parts/house.glb"]


def test_the_report_has_the_shares_and_a_picture() -> None:
    model = textured(painted_wall(GAINS))
    building = next(model.buildings)
    told = TextureTold([f"view {number}" for number in range(5)], model.gains)
    told.take(building)
    measures = told.measures(7)
    assert (measures["faces"], measures["faces_textured"]) == (5, 1)
    assert (measures["buildings_textured"], measures["buildings_plain"]) == (1, 7)
    assert measures["texel_mean_m"] == TEXEL_M
    share = front_of(building).seen_share
    assert measures["texture_seen_share_of_textured"] == pytest.approx(share, abs=1e-4)
    tables = told.tables()
    assert len(tables[0].rows) == 1
    assert len(tables[1].rows) == 5
    assert told.picture().data[:2] == b"\xff\xd8"
