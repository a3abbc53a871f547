"""GeoTIFFs as places: heights as a surface, pictures on level ground."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rasterio
from rasterio.transform import from_origin

import veduta
from veduta.place.mesh import Mesh
from veduta.place.place import Place
from veduta.place.raster import Raster
from veduta.run.errors import InputError

WEST, NORTH = 500_000.0, 5_500_000.0


def write(path: Path, bands: np.ndarray, cell_m: float = 2.0, **more: Any) -> Path:
    """bands: (b, h, w)."""
    count, height, width = bands.shape
    told = {"crs": "EPSG:25832", "transform": from_origin(WEST, NORTH, cell_m, cell_m)} | more
    with rasterio.open(
        path, "w", driver="GTiff", width=width, height=height, count=count,
        dtype=bands.dtype, **told,
    ) as file:  # fmt: skip
        file.write(bands)
    return path


def mesh_of(place: Place) -> Mesh:
    (part,) = place.parts.values()
    assert isinstance(part.content, Mesh)
    return part.content


def world(place: Place) -> np.ndarray:
    (part,) = place.parts.values()
    return part.triangles()[0] + np.array(place.origin_m)


def test_heights_lie_where_the_file_has_them(tmp_path: Path) -> None:
    heights = np.arange(12, dtype=np.float32).reshape(3, 4) + 107.5
    heights[0, 3] = -9999.0
    path = write(tmp_path / "dsm.tif", heights[None], nodata=-9999.0)
    place = veduta.load(path)
    assert place.crs == "EPSG:25832"
    points = world(place)
    expected = {
        (WEST + 2 * column + 1, NORTH - 2 * row - 1, heights[row, column])
        for row in range(3)
        for column in range(4)
        if (row, column) != (0, 3)
    }
    assert {tuple(point) for point in points.tolist()} == expected
    mesh = mesh_of(place)
    assert len(mesh.triangles) == 2 * 6 - 2  # the one triangle with the unknown corner, and its kin
    a, b, c = (mesh.positions_m[mesh.triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_an_orthophoto_is_level_and_the_right_way_up(tmp_path: Path) -> None:
    picture = np.zeros((3, 20, 30), dtype=np.uint8)
    picture[0, :10, :15] = 255  # red in the north-west
    place = veduta.load(write(tmp_path / "ortho.tif", picture))
    points, mesh = world(place), mesh_of(place)
    assert points.min(axis=0).tolist() == [WEST, NORTH - 40, 0]
    assert points.max(axis=0).tolist() == [WEST + 60, NORTH, 0]
    texture = mesh.materials[0].texture
    assert texture is not None
    assert texture.pixels[0, 0].tolist() == [255, 0, 0]
    assert mesh.uv is not None
    corner = np.argmin(points[:, 0] - points[:, 1])  # the north-west
    assert mesh.uv[corner].tolist() == [0, 0]


def test_large_rasters_have_larger_cells(tmp_path: Path) -> None:
    heights = np.full((700, 1400), 5.0, dtype=np.float32)
    place = veduta.load(write(tmp_path / "dem.tif", heights[None], 0.5))
    assert len(mesh_of(place).positions_m) == 256 * 512
    points = world(place)
    np.testing.assert_allclose(np.ptp(points[:, :2], axis=0), [700 * 511 / 512, 350 * 255 / 256])


def test_a_raster_goes_beside_buildings_into_any_format(tmp_path: Path) -> None:
    picture = np.full((1, 8, 8), 99, dtype=np.uint8)
    place = veduta.load(write(tmp_path / "map.tif", picture))
    heights = veduta.load(write(tmp_path / "dem.tif", np.zeros((1, 4, 4), dtype=np.float32)))
    both = place.merge(heights)
    assert list(both.parts) == ["map", "dem"]
    for name in ("both.glb", "both.obj", "both.city.json"):
        both.write(tmp_path / name)
    folder = tmp_path / "place"
    folder.mkdir()
    both.save(folder)
    assert list(Place.load(folder).parts) == ["map", "dem"]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("empty.tif", "is no GeoTIFF that can be read"),
        ("text.tif", "is no GeoTIFF that can be read"),
        ("degrees.tif", "has degrees"),
        ("nothing.tif", "has no heights that lie beside each other"),
        ("row.tif", "has no heights that lie beside each other"),
        ("deep.tif", "has 4 bands of uint16"),
        ("feet.tif", "is not in metres"),
    ],
)
def test_what_cannot_be_used_is_named(tmp_path: Path, name: str, told: str) -> None:
    path = tmp_path / name
    heights = np.zeros((1, 4, 4), dtype=np.float32)
    if name == "empty.tif":
        path.write_bytes(b"")
    elif name == "text.tif":
        path.write_text("no picture")
    elif name == "degrees.tif":
        write(path, heights, 0.01, crs="EPSG:4326", transform=from_origin(8, 50, 0.01, 0.01))
    elif name == "deep.tif":
        write(path, np.full((4, 4, 4), 60_000, dtype=np.uint16))
    elif name == "feet.tif":
        write(path, heights, crs="EPSG:2263")
    elif name == "nothing.tif":
        write(path, heights + np.float32(np.nan))
    else:
        write(path, heights[:, :1])
    with pytest.raises(InputError, match=told) as caught:
        veduta.load(path)
    assert name in str(caught.value)


def test_a_raster_without_four_known_cells_is_no_mesh() -> None:
    heights = np.full((5, 5), np.nan, dtype=np.float32)
    heights[::2, ::2] = 1.0
    with pytest.raises(ValueError, match="no four cells"):
        Raster("dsm", (5.0, 5.0), heights).mesh()


def test_signs_for_nothing_known_are_no_heights(tmp_path: Path) -> None:
    """Also undeclared ones, and in the cells of a raster that is read coarser."""
    heights = np.full((8, 1024), 100.0, dtype=np.float32)
    heights[0, 0], heights[5, 700] = -9999.0, -32768.0
    points = world(veduta.load(write(tmp_path / "dem.tif", heights[None])))
    np.testing.assert_allclose(points[:, 2], 100.0, atol=1e-3)


def test_a_map_with_a_palette_has_its_colours(tmp_path: Path) -> None:
    path = write(tmp_path / "map.tif", np.ones((1, 8, 8), dtype=np.uint8))
    with rasterio.open(path, "r+") as file:
        file.write_colormap(1, {0: (0, 0, 0), 1: (200, 10, 20)})
    texture = mesh_of(veduta.load(path)).materials[0].texture
    assert texture is not None
    assert (texture.pixels == [200, 10, 20]).all()


def test_what_a_picture_does_not_show_is_white(tmp_path: Path) -> None:
    picture = np.full((3, 8, 8), 90, dtype=np.uint8)
    picture[:, :4] = 0
    path = write(tmp_path / "o.tif", picture, nodata=0)
    texture = mesh_of(veduta.load(path)).materials[0].texture
    assert texture is not None
    assert (texture.pixels[:4] == 255).all()
    assert (texture.pixels[4:] == 90).all()


def test_a_system_without_a_number_is_said(tmp_path: Path) -> None:
    own = "+proj=tmerc +lat_0=12.3 +lon_0=4.5 +k=1 +x_0=7 +y_0=8 +ellps=bessel +units=m"
    place = veduta.load(write(tmp_path / "own.tif", np.zeros((1, 4, 4), np.float32), crs=own))
    assert place.crs is None
    assert any("no EPSG number" in note for note in place.notes)
