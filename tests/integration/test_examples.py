"""The scripts in examples/ do what they say."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from photo_scene import ARC, write_photos
from sample_plan import sample_plan

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted((ROOT / "examples").glob("[0-9]*.py"))


def example(number: int, *arguments: object) -> str:
    """What the script of this number prints."""
    (script,) = (ROOT / "examples").glob(f"{number:02d}_*.py")
    words = [sys.executable, str(script), *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def hill(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("own") / "hill"
    assert "A hill" in example(6, folder)
    return folder


def test_each_is_short_and_says_how_it_is_called() -> None:
    assert [int(script.name[:2]) for script in SCRIPTS] == list(range(1, len(SCRIPTS) + 1))
    for script in SCRIPTS:
        text = script.read_text("utf-8")
        assert f"python examples/{script.name}" in text
        assert 10 <= len(text.splitlines()) <= 50, script.name


def test_facade_to_obj(photo: Path, tmp_path: Path) -> None:
    told = example(1, photo, tmp_path / "house.obj")
    assert "windows" in told
    assert (tmp_path / "house.mtl").is_file()


def test_town_from_geojson(tmp_path: Path) -> None:
    assert "3 houses in EPSG:32633" in example(2, tmp_path)
    assert {"town.glb", "town.gpkg"} <= {file.name for file in tmp_path.iterdir()}


def test_plan_to_ifc(tmp_path: Path) -> None:
    document = tmp_path / "plan.json"
    document.write_text(sample_plan().model_dump_json(by_alias=True), encoding="utf-8")
    told = example(3, document, tmp_path / "out")
    assert "house.ifc" in told
    assert (tmp_path / "out" / "house.usdz").is_file()


def test_photos_to_cameras(tmp_path: Path) -> None:
    write_photos(tmp_path / "photos", ARC[:3])
    told = example(4, tmp_path / "photos", tmp_path / "points.ply")
    assert told.count("looks along") >= 3
    assert (tmp_path / "points.ply").is_file()


def test_edit_a_rule(tmp_path: Path) -> None:
    assert "with five storeys" in example(5, tmp_path / "house.obj")
    assert "window" in (tmp_path / "house.mtl").read_text("utf-8")


def test_merge_places(hill: Path, one_house: Path, tmp_path: Path) -> None:
    assert "2 parts" in example(7, hill, one_house, tmp_path / "both.glb")


def test_count_windows(one_house: Path) -> None:
    assert "measured" in example(8, one_house)
