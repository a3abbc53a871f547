"""What the report draws and links: names beside the matrix, a length on the map, no dead links."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from known_structure import known_structure
from PIL import Image

from veduta.formats.gltf import write_glb
from veduta.formats.gltf_read import read_glb
from veduta.photos.city.reading import read_city_model
from veduta.photos.matching.match import PairRecord
from veduta.photos.options import ModelOptions
from veduta.photos.report_pictures import FAINT, INK, draw_ruler, match_picture, plan_picture
from veduta.photos.walls.grid import WallGrid
from veduta.photos.walls.part import walls_part
from veduta.photos.walls.pictures import WallPicture
from veduta.photos.walls.wall import Wall
from veduta.photos.world.georeference import Fit, Georeference, Residual, Similarity
from veduta.photos.world.georeferencing import Georeferenced
from veduta.photos.world.pictures import georef_pictures, model_beside
from veduta.photos.world.report import georef_tables
from veduta.run.page import Picture, Table


def pixels_of(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)))


@pytest.mark.parametrize("photos", [3, 200])
def test_the_matrix_has_the_names_of_the_photos(photos: int) -> None:
    ids = list(range(1, photos + 1))
    pairs = [PairRecord(1, 2, 100, 90, planar=False)]
    names = [f"IMG_{number:04d}.jpg" for number in ids]
    bare, named = (pixels_of(match_picture(ids, pairs, (), given).data) for given in ((), names))
    room = len(named) - len(bare)
    assert room > 40
    assert np.array_equal(named[room:, room:], bare)
    beside = named[room:, :room].min(axis=(1, 2)) < 200
    above = named[:room, room:].min(axis=(0, 2)) < 200
    # Letters above each column that has them beside its row, and nowhere near the corner.
    assert beside.sum() > 20
    assert np.array_equal(np.flatnonzero(above), np.flatnonzero(beside))
    assert (named[:room, :room] >= 200).all()


def test_a_map_has_a_length() -> None:
    pixels = np.full((300, 400, 3), 250, np.uint8)
    draw_ruler(pixels, 7.3, "m")
    line = np.flatnonzero((pixels[286] == INK).all(axis=1))
    # The longest of 1, 2, 5 times a power of ten under a sixth of the width.
    assert abs((line.max() - line.min()) / 7.3 - 5.0) < 0.5
    note = plan_picture(known_structure()).note
    assert "scale is not known" in note
    assert "North is up" in plan_picture(known_structure(), in_metres=True).note


def test_one_sees_through_a_wall_where_no_photo_shows_it(tmp_path: Path) -> None:
    wall = Wall("w000", np.zeros(2), np.array([4.0, 0.0]), 0.0, 2.0, np.arange(3), 0.01)
    pixels = np.full((20, 40, 4), 120, np.uint8)
    pixels[:, :, 3] = 255
    pixels[:, 25:, 3] = 0
    grid = WallGrid(wall, 0.1, 0.0, 2.0, 40, 20)
    part = walls_part((_picture(grid, pixels),))
    assert part is not None
    write_glb(part, tmp_path / "walls.glb")
    back = read_glb(tmp_path / "walls.glb").materials[0].texture
    assert back is not None
    assert back.cut
    assert np.array_equal(back.invented, pixels[:, :, 3] == 0)
    data = (tmp_path / "walls.glb").read_bytes()
    assert b'"alphaMode":"MASK"' in data.replace(b" ", b"")
    image = Image.open(io.BytesIO(data[data.index(b"\x89PNG") :]))
    assert image.mode == "RGBA"
    assert np.array_equal(np.asarray(image)[..., 3] == 0, pixels[:, :, 3] == 0)


def _picture(grid: WallGrid, pixels: np.ndarray) -> WallPicture:
    return WallPicture(grid, pixels, (0,), 0.6)


def _laid_by_gps(tmp_path: Path, model_crs: str) -> tuple[Picture, list[Table]]:
    """The picture and the tables of a component that GPS lays beside a model of another frame."""
    structure = known_structure()
    origin = (500_000.0, 5_500_000.0, 0.0)
    similar = Similarity(1.0, np.eye(3), np.zeros(3))
    fit = Fit(similar, 0.01, np.zeros(3), np.ones(3), 0.4, 1.0, (Residual("a.jpg", 0.4),))
    found = Georeference("gps", True, "fits", "EPSG:25832", origin, fit)
    middle = structure.centres().mean(axis=0)[:2] + origin[:2]
    corners = middle + 3.0 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    shape = {"type": "Polygon", "coordinates": [corners.tolist()]}
    lot = {"type": "Feature", "properties": {"height": 5}, "geometry": shape}
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [lot]}))
    model = read_city_model(path, ModelOptions(crs=model_crs))
    found = replace(found, origin_m=model.origin_m)
    (picture,) = georef_pictures(structure, (), found, model_beside(found, model))
    return picture, georef_tables([Georeferenced((found,))])


def test_a_map_by_gps_has_the_outlines_of_a_model_of_its_frame(tmp_path: Path) -> None:
    same, tables = _laid_by_gps(tmp_path, "EPSG:25832")
    other, _ = _laid_by_gps(tmp_path, "EPSG:25833")
    assert "outlines of the model" in same.note
    assert "outlines" not in other.note
    grey = (pixels_of(same.data) == FAINT).all(axis=2).sum()
    assert grey > (pixels_of(other.data) == FAINT).all(axis=2).sum() + 100
    assert "North is up" in same.note
    assert tables[0].rows[0][0] == "A"
