"""Panoramas along a path: their views' rotations are known, depth comes from the next panorama."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.synthetic.walks.gorge import make_gorge
from veduta.synthetic.walks.record import GorgeWalk, cameras_of
from veduta.synthetic.walks.shoot import GorgeScene, WalkCamera
from veduta.walk.build.photo_depth import FramePlanes
from veduta.walk.command import Sources, run_walk
from veduta.walk.options import TakeOptions, WalkOptions
from veduta.walk.panorama_record import PanoramaRecord
from veduta.walk.photo_record import read_photo_record
from veduta.walk.read.photo_path import views_of_panoramas

SIDES, SIDE_PX = 8, 112
FOCAL_PX = 0.5 * SIDE_PX / np.tan(np.deg2rad(43.5))


@pytest.fixture(scope="module")
def panoramas(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three panoramas 0.8 m apart as eight views each, named as `veduta photos` names them."""
    folder = tmp_path_factory.mktemp("panoramas")
    gorge = make_gorge(3.0)
    scene = GorgeScene(gorge)
    for name in ("photos", "cameras"):
        (folder / name).mkdir()
    for key, camera in enumerate(cameras_of(GorgeWalk(keys=3, step_m=0.8), gorge)):
        for side in range(SIDES):
            pose = camera.world_from_camera.copy()
            turn = Rotation.from_euler("y", 2.0 * np.pi * side / SIDES).as_matrix()
            pose[:3, :3] = pose[:3, :3] @ turn
            view = WalkCamera(SIDE_PX, SIDE_PX, float(FOCAL_PX), pose)
            name = f"pano{key}_view{side}.png"
            Image.fromarray(scene.shoot(view, samples=1).image).save(folder / "photos" / name)
            _write_camera(folder / "cameras" / f"{name}.camera", view)
    return folder


def _write_camera(path: Path, one: WalkCamera) -> None:
    middle = one.width_px / 2.0 - 0.5
    rows = [
        [one.focal_px, 0.0, middle], [0.0, one.focal_px, middle], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0],
        *one.world_from_camera[:3, :3].tolist(), one.world_from_camera[:3, 3].tolist(),
        [one.width_px, one.height_px],
    ]  # fmt: skip
    path.write_text("\n".join(" ".join(str(value) for value in row) for row in rows) + "\n")


def test_views_are_told_by_their_names() -> None:
    names = ["a_view0.jpg", "a_view1.jpg", "b_b_view0.jpg"]
    assert views_of_panoramas(names) == {"a": {0: 0, 1: 1}, "b_b": {0: 2}}
    assert views_of_panoramas(["a_view0.jpg", "hall.jpg"]) is None


def test_a_walk_of_panoramas_looks_all_around(panoramas: Path, tmp_path: Path) -> None:
    sources = Sources(cameras=panoramas / "cameras")
    options = WalkOptions(take=TakeOptions(count=2))
    result = run_walk(
        panoramas / "photos", tmp_path / "out", options, Progress(quiet=True), sources=sources
    )
    assert result.exit_code == 0
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    (way,) = told["transitions"]
    assert way["distance_m"] == pytest.approx(0.8, rel=0.05)
    assert way["score_db"] > way["unmoved_db"]
    assert [one["id"] for one in told["keys"]] == ["pano0", "pano1"]
    assert len(told["keys"][0]["views"]) == SIDES
    key = json.loads((tmp_path / "out" / "place.json").read_text())["walks"][0]["keys"][0]
    assert key["projection"] == "cylinder"
    assert key["width_px"] == pytest.approx(2.0 * 3.1 * FOCAL_PX, abs=2)
    assert result.measures["largest_gap_share"] == pytest.approx(0.0, abs=0.01)


def test_views_to_a_side_that_one_panorama_has_are_left_out(
    panoramas: Path, tmp_path: Path
) -> None:
    cameras = tmp_path / "cameras"
    shutil.copytree(panoramas / "cameras", cameras)
    for name in ("pano0_view3.png", "pano2_view3.png"):
        (cameras / f"{name}.camera").unlink()
    record = read_photo_record(panoramas / "photos", cameras, TakeOptions(), 500)
    assert isinstance(record, PanoramaRecord)
    assert record.alone == ("pano1_view3.png",)
    assert [len(views) for _, views in record.panoramas] == [SIDES - 1] * 3
    # Most of the views that follow each other stand in one place.
    assert record.path.rig.baseline_m == pytest.approx(0.8, rel=0.05)
    for path in cameras.glob("pano[12]_*"):
        path.unlink()
    shutil.copy(panoramas / "cameras" / "pano1_view3.png.camera", cameras)
    with pytest.raises(InputError, match=r"no two panoramas.*Take them nearer"):
        read_photo_record(panoramas / "photos", cameras, TakeOptions(), 500)


def test_the_front_looks_along_the_path(panoramas: Path) -> None:
    record = read_photo_record(panoramas / "photos", panoramas / "cameras", TakeOptions(), 500)
    assert isinstance(record, PanoramaRecord)
    assert record.rig.baseline_m == pytest.approx(0.8, rel=0.05)
    pose = record.pose(0, 2)
    assert pose is not None
    assert -pose[2, 3] == pytest.approx(1.6, rel=0.05)


def test_at_an_end_views_beside_give_depth_to_the_rim(panoramas: Path) -> None:
    """What is at the rim of the first view ahead is outside of the next one's."""
    record = read_photo_record(panoramas / "photos", panoramas / "cameras", TakeOptions(), 500)
    assert isinstance(record, PanoramaRecord)
    assert [set(record.around[n]) for n in (0, SIDES, 2 * SIDES + 3)] == [
        {8, 9, 15}, {0, 16}, {SIDES + 2, SIDES + 3, SIDES + 4},
    ]  # fmt: skip
    path = record.path
    same = tuple((n + SIDES,) if n < SIDES else (n - SIDES,) for n in range(len(path.cameras)))
    alone = FramePlanes(path.cameras, path.picture, path.span, around=same)
    both = FramePlanes(path.cameras, path.picture, path.span, around=record.around, kept=24)
    gorge = make_gorge(3.0)
    first = cameras_of(GorgeWalk(keys=3, step_m=0.8), gorge)[0]
    view = WalkCamera(SIDE_PX, SIDE_PX, float(FOCAL_PX), first.world_from_camera)
    true = GorgeScene(gorge).shoot(view, samples=1).depth_m
    rim = np.ones(true.shape, dtype=bool)
    rim[SIDE_PX // 6 : -SIDE_PX // 6, SIDE_PX // 6 : -SIDE_PX // 6] = False
    rim &= np.isfinite(true)
    off = [
        float(np.mean(np.abs(planes.depth(0)[0][rim] / true[rim] - 1.0) > 0.1))
        for planes in (alone, both)
    ]
    assert off[1] < 0.8 * off[0]
