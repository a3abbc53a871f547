"""Heights under lots, against slopes whose heights are known everywhere."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, TiffImagePlugin

from veduta.grammar.lots import read_lots
from veduta.grammar.options import LotOptions
from veduta.grammar.terrain import NoGroundError, Terrain, read_terrain
from veduta.run.errors import InputError

ORIGIN = (84_000.0, 446_000.0)


def slope(rows: int, columns: int, cell: float) -> np.ndarray:
    """Height 2 + 0.1 x + 0.05 y at the middle of each cell; x, y from the lower left corner."""
    x = (np.arange(columns) + 0.5) * cell
    y = (rows - np.arange(rows) - 0.5) * cell
    return (2 + 0.1 * x[None, :] + 0.05 * y[:, None]).astype(np.float32)


def tiff(path: Path, heights: np.ndarray, cell: float, **more: object) -> Path:
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    point = bool(more.get("point"))
    edge = cell / 2 if point else 0.0
    tags[33550] = (cell, cell, 0.0)
    tags[33922] = (0.0, 0.0, 0.0, ORIGIN[0] + edge, ORIGIN[1] + len(heights) * cell - edge, 0.0)
    epsg = more.get("epsg", 28992)
    tags[34735] = (1, 1, 0, 2, 1025, 0, 1, 2 if point else 1, 3072, 0, 1, epsg)
    for tag in (33550, 33922):
        tags.tagtype[tag] = 12
    tags.tagtype[34735] = 3
    if "nodata" in more:
        tags[42113] = str(more["nodata"])
    for tag in more.get("without", ()):  # type: ignore[attr-defined]
        del tags[tag]
    compression = more.get("compression")
    Image.fromarray(heights).save(path, tiffinfo=tags, compression=compression)
    return path


def ring(x: float, y: float, width: float, depth: float) -> np.ndarray:
    west, south = ORIGIN[0] + x, ORIGIN[1] + y
    east, north = west + width, south + depth
    return np.array([[west, south], [east, south], [east, north], [west, north]])


@pytest.mark.parametrize("more", [{}, {"point": True}, {"compression": "tiff_deflate"}])
def test_a_slope_is_met_everywhere(tmp_path: Path, more: dict[str, object]) -> None:
    terrain = read_terrain(tiff(tmp_path / "t.tif", slope(60, 80, 0.5), 0.5, **more), "EPSG:28992")
    lot = [ring(3.3, 4.1, 12.0, 9.0)]
    assert terrain.under(lot, "lowest") == pytest.approx(2 + 0.33 + 0.205, abs=1e-4)
    mean = 2 + 0.1 * (3.3 + 6.0) + 0.05 * (4.1 + 4.5)
    assert terrain.under(lot, "mean") == pytest.approx(mean, abs=0.03)


def test_the_lowest_place_may_lie_within(tmp_path: Path) -> None:
    heights = np.full((20, 20), 5.0, np.float32)
    heights[10, 10] = 1.0
    terrain = read_terrain(tiff(tmp_path / "t.tif", heights, 1.0), None)
    whole = [ring(5, 5, 10, 10)]
    assert terrain.under(whole, "lowest") == 1.0
    courtyard = [*whole, ring(9, 8, 3, 3)]
    assert terrain.under(courtyard, "lowest") == 5.0


eighths = st.integers(1, 120).map(lambda number: number / 8)


@given(eighths, eighths, eighths, eighths)
def test_cells_in_a_lot_are_those_whose_centre_is(
    x: float, y: float, width: float, depth: float
) -> None:
    rows, columns = 40, 50
    numbers = np.arange(rows * columns, dtype=np.float32).reshape(rows, columns)
    terrain = Terrain(numbers, 0.5, rows - 0.5, (1.0, 1.0))
    found = terrain._inside([ring(x, y, width, depth) - ORIGIN])
    cx, cy = np.meshgrid(np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5)
    inside = (cx >= x) & (cx < x + width) & (cy >= y) & (cy < y + depth)
    assert sorted(found.tolist()) == sorted(numbers[inside].tolist())


def test_where_there_are_no_heights(tmp_path: Path) -> None:
    heights = slope(20, 20, 1.0)
    heights[5, 5] = -9999.0
    terrain = read_terrain(tiff(tmp_path / "t.tif", heights, 1.0, nodata=-9999), None)
    assert terrain.under([ring(10, 2, 5, 5)], "lowest") > 0
    for lot in (ring(3, 12, 5, 5), ring(15, 2, 10, 5)):
        with pytest.raises(NoGroundError):
            terrain.under([lot], "lowest")


def test_lots_stand_on_it(tmp_path: Path) -> None:
    path = tiff(tmp_path / "t.tif", slope(60, 80, 0.5), 0.5)
    features = []
    for x in (2.0, 20.0, 38.0):
        corners = [*ring(x, 3, 8, 8).tolist(), ring(x, 3, 8, 8)[0].tolist()]
        shape = {"type": "Polygon", "coordinates": [corners]}
        features.append({"type": "Feature", "geometry": shape, "properties": {}})
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    lots = tmp_path / "lots.geojson"
    lots.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    found = read_lots(lots, LotOptions(terrain=path))
    heights = [found.origin_m[2] + lot.anchor_m[2] for lot in found.lots]
    assert heights == pytest.approx([2 + 0.2 + 0.15, 2 + 2.0 + 0.15], abs=1e-4)
    assert 0 <= found.lots[0].anchor_m[2] < 1e-3  # the lowest lies on the plane of the place
    (failure,) = found.failures
    assert "no height" in failure.reason


def test_what_cannot_be_used_is_told(tmp_path: Path) -> None:
    heights = slope(10, 10, 1.0)
    other = tiff(tmp_path / "crs.tif", heights, 1.0, epsg=25832)
    with pytest.raises(InputError, match="is in EPSG:25832, but the lots are in EPSG:28992"):
        read_terrain(other, "EPSG:28992")
    bare = tiff(tmp_path / "bare.tif", heights, 1.0, without=[33550])
    with pytest.raises(InputError, match="does not say where it lies"):
        read_terrain(bare, None)
    photo = tmp_path / "photo.tif"
    Image.new("RGB", (4, 4)).save(photo)
    with pytest.raises(InputError, match="no single band"):
        read_terrain(photo, None)
    text = tmp_path / "text.tif"
    text.write_text("heights")
    with pytest.raises(InputError, match="no GeoTIFF"):
        read_terrain(text, None)
    with pytest.raises(InputError, match="does not exist"):
        read_terrain(tmp_path / "none.tif", None)
