"""`veduta dense` on photos of a wall whose depths are known, and what it refuses."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from command_line import refused
from PIL import Image
from stereo_scene import BLOCK_M, WALL_M, depths, eyes, write_set

from veduta import _core
from veduta.cameras import CameraSet
from veduta.cli.main import main


@pytest.fixture(scope="module")
def photos(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_set(tmp_path_factory.mktemp("set") / "wall")


@pytest.fixture(scope="module")
def result(photos: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("dense") / "out"
    assert main(["dense", str(photos), "-o", str(out), "--quiet"]) == 0
    return out


def _report(out: Path) -> dict[str, object]:
    loaded: dict[str, object] = json.loads((out / "report.json").read_text())
    return loaded


def test_depths_are_those_of_the_wall(result: Path) -> None:
    for number, eye in enumerate(eyes(4)):
        found = np.array(Image.open(result / "depth" / f"view{number}.tif"))
        truth, _ = depths(eye)
        known = np.isfinite(found)
        assert known.mean() > 0.6
        away = np.abs(found - truth)[known] / truth[known]
        assert np.quantile(away, 0.9) < 0.01


def test_cloud_and_mesh_lie_on_the_surfaces(result: Path) -> None:
    data = (result / "cloud.ply").read_bytes()
    head, _, body = data.partition(b"end_header\n")
    count = int(head.split(b"element vertex ")[1].split()[0])
    rows = np.frombuffer(body, dtype=np.dtype([("xyz", "<f4", 6), ("rgbv", "u1", 4)]))
    assert len(rows) == count > 5000
    y = rows["xyz"][:, 1]
    away = np.minimum(np.abs(y - WALL_M), np.abs(y - BLOCK_M))
    assert np.quantile(away, 0.9) < 0.05
    assert rows["rgbv"][:, 3].min() >= 3
    assert np.median(rows["xyz"][:, 4]) < -0.9  # normals face the cameras
    place = json.loads((result / "place.json").read_text())
    assert [part["id"] for part in place["parts"]] == ["surface"]
    assert len(place["cameras"]) == 4
    assert _report(result)["state"] == "done"


def test_a_finished_run_is_up_to_date_and_a_killed_one_goes_on(
    photos: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from veduta.dense import depths as steps

    made: list[int] = []
    real = steps.match_coarse

    def counted(views, comparison, *rest):  # type: ignore[no-untyped-def]
        if len(made) == 2:
            made.append(-1)
            raise KeyboardInterrupt
        made.append(comparison.view)
        return real(views, comparison, *rest)

    monkeypatch.setattr(steps, "match_coarse", counted)
    call = ["dense", str(photos), "-o", str(tmp_path / "out"), "--quiet", "--no-mesh"]
    assert main(call) == 130
    made.append(-1)
    assert main(call) == 0
    assert [one for one in made if one >= 0] == [0, 1, 2, 3]  # none a second time
    count = len(made)
    assert main(call) == 0
    assert len(made) == count


def test_the_same_seed_makes_the_same_depths(result: Path, photos: Path, tmp_path: Path) -> None:
    again = tmp_path / "out"
    assert main(["dense", str(photos), "-o", str(again), "--quiet", "--no-mesh"]) == 0
    for name in ("depth/view1.tif", "cloud.ply"):
        assert (result / name).read_bytes() == (again / name).read_bytes()


def test_two_photos_are_enough_and_doubted(tmp_path: Path) -> None:
    pair = write_set(tmp_path / "pair", 2)
    out = tmp_path / "out"
    assert main(["dense", str(pair), "-o", str(out), "--quiet", "--no-mesh"]) == 0
    assert any("no third" in str(note) for note in _report(out)["notes"])  # type: ignore[attr-defined]


def test_cameras_without_photos_are_refused(photos: Path, tmp_path: Path) -> None:
    shutil.copytree(photos / "cameras", tmp_path / "cameras")
    done = refused("dense", tmp_path, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "has photos for 0 of 4 cameras; two are needed" in done.stderr
    assert "Put the photos beside the cameras" in done.stderr


def test_mirrored_photos_are_told_by_their_matches(tmp_path: Path) -> None:
    folder = write_set(tmp_path / "mirrored", mirrored=True)
    done = refused("dense", folder, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "has cameras that do not fit their photos" in done.stderr
    assert "x to the right and y down" in done.stderr


def test_photos_of_different_places_are_not_found(photos: Path, tmp_path: Path) -> None:
    folder = tmp_path / "apart"
    shutil.copytree(photos, folder)
    noise = np.random.default_rng(0)
    for path in sorted((folder / "images").iterdir()):
        Image.fromarray(noise.integers(0, 255, (120, 160, 3), dtype=np.uint8)).save(path)
    done = refused("dense", folder, "-o", tmp_path / "out")
    assert done.returncode == 3
    assert "no two of the 4 photos show the same spots" in done.stderr


def test_a_photo_of_another_shape_is_refused(photos: Path, tmp_path: Path) -> None:
    folder = tmp_path / "shape"
    shutil.copytree(photos, folder)
    Image.fromarray(np.zeros((90, 160, 3), dtype=np.uint8)).save(folder / "images" / "view1.png")
    done = refused("dense", folder, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "view1" in done.stderr


def test_what_moves_between_the_photos_is_left_out(tmp_path: Path) -> None:
    folder = write_set(tmp_path / "moving")
    noise = np.random.default_rng(5).integers(0, 255, (30, 30, 3), dtype=np.uint8)
    for number, path in enumerate(sorted((folder / "images").iterdir())):
        pixels = np.array(Image.open(path))
        row, column = (40 + 9 * number, 20 + 31 * number)
        pixels[row : row + 30, column : column + 30] = noise
        Image.fromarray(pixels).save(path)
    out = tmp_path / "out"
    assert main(["dense", str(folder), "-o", str(out), "--quiet", "--no-mesh"]) == 0
    for number, eye in enumerate(eyes(4)):
        found = np.array(Image.open(out / "depth" / f"view{number}.tif"))
        truth, _ = depths(eye)
        known = np.isfinite(found)
        assert known.mean() > 0.4
        away = np.abs(found - truth)[known] / truth[known]
        assert np.quantile(away, 0.9) < 0.02


@pytest.mark.skipif(hasattr(_core, "GraphicsCard"), reason="built with graphics cards")
def test_a_graphics_card_is_refused_where_there_can_be_none(photos: Path, tmp_path: Path) -> None:
    done = refused("dense", photos, "-o", tmp_path / "out", "--device", "gpu")
    assert done.returncode == 2
    assert "built without graphics cards" in done.stderr
    assert "--device auto" in done.stderr


def test_a_photo_has_no_depths_where_its_mask_is_black(
    photos: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from veduta.dense import command

    real = command.read_cameras

    def masked(path: Path, images: Path | None = None) -> CameraSet:
        given = real(path, images)
        return replace(given, masks={given.cameras[1].name: tmp_path / "mask.png"})

    shown = np.array(Image.open(next(photos.glob("**/view1.png"))))
    left = shown.shape[1] // 2
    mask = np.full(shown.shape[:2], 255, np.uint8)
    mask[:, :left] = 0
    Image.fromarray(mask).save(tmp_path / "mask.png")
    monkeypatch.setattr(command, "read_cameras", masked)
    out = tmp_path / "out"
    assert main(["dense", str(photos), "-o", str(out), "--quiet", "--no-mesh"]) == 0
    found = np.array(Image.open(out / "depth" / "view1.tif"))
    assert not np.isfinite(found[:, :left]).any()
    assert np.isfinite(found[:, left:]).mean() > 0.5
    assert np.isfinite(np.array(Image.open(out / "depth" / "view2.tif"))[:, :left]).any()
    assert "; computed by the processor" in (out / ".veduta" / "run.json").read_text()
