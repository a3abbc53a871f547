"""Levels of detail of segments, and the path over the surface model in the report."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.drive.build.path_report import corrections_table, path_picture
from veduta.drive.command import run_drive
from veduta.drive.document.model import Correction, DriveSegment
from veduta.drive.options import DriveOptions, MeshOptions
from veduta.drive.read.surface_picture import draw_surface
from veduta.drive.record import Overview
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.tiles import contents
from veduta.place.place import Place
from veduta.run.progress import Progress
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)
from veduta.synthetic.drives.surface import surface_of, write_surface

_SURFACE = '\n[surface]\nfile = "surface.tif"\nstart = [0.0, 0.0]\n'


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("levels")
    street = build_street(StreetOptions(length_m=25.0), 4)
    write_drive(scan_street(street, TruckOptions(), 4), folder / "log")
    write_surface(*surface_of(street), folder / "log/surface.tif")
    toml = folder / "log/drive.toml"
    toml.write_text(toml.read_text() + _SURFACE)
    options = DriveOptions(mesh=MeshOptions(tiles=True))
    assert run_drive(folder / "log", folder / "out", options, Progress(quiet=True)).exit_code == 0
    return folder / "out"


def _chain(tile: dict[str, Any]) -> list[dict[str, Any]]:
    """A branch from its coarsest tile to its finest."""
    found = [tile]
    while found[-1].get("children"):
        found.append(found[-1]["children"][0])
    return found


def test_segments_have_levels_of_detail(out: Path) -> None:
    root = json.loads((out / "tiles/tileset.json").read_text())["root"]
    assert len(root["children"]) == 2  # walls and ground
    names = contents(out, "tiles/tileset.json")
    assert all((out / name).is_file() for name in names)
    fewer = []
    for branch in root["children"]:
        tiles = _chain(branch)
        errors = [tile["geometricError"] for tile in [root, *tiles]]
        assert errors == sorted(errors, reverse=True)
        assert errors[-1] == 0.0
        files = [out / "tiles" / tile["content"]["uri"] for tile in tiles]
        sizes = [len(read_glb_mesh(file).face_material) for file in files]
        assert sizes == sorted(sizes)
        fewer.append(sizes[0] < sizes[-1])
    assert any(fewer)  # few triangles stay as they are


def test_the_finest_level_is_the_part_itself(out: Path) -> None:
    place = Place.load(out)
    assert place.tileset == "tiles/tileset.json"
    mesh = read_glb_mesh(out / "parts/left-001.glb")
    tile = read_glb_mesh(out / "tiles/left-001-0.glb")
    np.testing.assert_allclose(tile.points, mesh.points, atol=1e-4)
    branch = json.loads((out / "tiles/tileset.json").read_text())["root"]["children"][0]
    place_of = np.array(branch["transform"]).reshape(4, 4).T
    np.testing.assert_allclose(place_of, place.parts["left-001"].standing.transform, atol=1e-6)


def test_the_report_shows_the_path(out: Path) -> None:
    page = (out / "report.html").read_text()
    assert "The path over the surface model" in page


def test_the_surface_is_drawn_where_it_is(tmp_path: Path) -> None:
    heights = np.zeros((40, 60), dtype=np.float32)
    heights[10:20, 30:45] = 12.0  # from the south, from the west
    heights[0, 0] = np.nan
    write_surface(heights, (100.0, 200.0), tmp_path / "a.tif")
    shown = draw_surface(tmp_path / "a.tif", (100.0, 200.0, 0.0), (5.0, 5.0), (50.0, 30.0))
    assert shown.low == (5.0, 5.0)
    assert shown.pixels.shape[:2] == (25, 45)
    roof = shown.pixels[8:12, 28:38].astype(int).mean()
    assert roof > shown.pixels[18:22, 5:20].astype(int).mean() + 40
    beyond = draw_surface(tmp_path / "a.tif", (100.0, 200.0, 0.0), (500.0, 5.0), (550.0, 30.0))
    assert beyond.pixels.size == 0


def test_the_path_is_drawn_over_it() -> None:
    base = Overview(np.full((80, 100, 3), 60, dtype=np.uint8), (-30.0, -30.0), 1.0)
    line = np.column_stack([np.zeros(20), np.arange(20.0), np.zeros(20)])
    points = [(0.0, float(y), 3.6) for y in range(20)]
    segment = DriveSegment(id="left-001", side="left", line=points, reason="all")
    drawn = path_picture(base, line, [segment], [(line[10], np.array([0.5, 0.0, 0.0]))])
    height, width = drawn.shape[:2]
    middle = width // 2
    assert (drawn[height // 2, middle - 3 : middle + 4] == 255).all(axis=1).any()
    green = (drawn[..., 1] > drawn[..., 0].astype(int) + 60) & (drawn[..., 1] > 150)
    assert green[:, :middle].sum() > 10 * max(green[:, middle:].sum(), 1)
    assert ((drawn[..., 0] > 200) & (drawn[..., 1] < 120)).any()  # the correction
    nothing = Overview(np.zeros((0, 0, 3), dtype=np.uint8), (0.0, 0.0), 1.0)
    assert (path_picture(nothing, line, [], []) == 255).any()


def test_corrections_are_told_with_their_reasons() -> None:
    rows = [
        Correction(sweep=f"{n}", moved_m=(0.1, 0.0, 0.0), reason="a loop was closed")
        for n in range(200)
    ]
    rows[77] = Correction(sweep="77", moved_m=(3.0, 4.0, 0.0), reason="a loop was closed")
    table = corrections_table(rows)
    assert len(table.rows) <= 40
    assert ["77", 3.0, 4.0, 0.0, 5.0, "a loop was closed"] in [list(row) for row in table.rows]
    assert "200 corrections" in table.note
    assert "5.00 m at most" in table.note
