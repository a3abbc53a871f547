"""Mosaics of several views at a key position, against the gorge that they were taken of."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.run.errors import NotFoundError
from veduta.run.progress import Progress
from veduta.synthetic.walks.record import GorgeWalk, cameras_of, shoot_walk, write_walk
from veduta.synthetic.walks.shoot import WalkCamera, WalkShot
from veduta.walk.build.level import Compared, compare_colours, level_gains
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.mosaic import Mosaic, make_mosaic
from veduta.walk.build.rectify_maps import rectified
from veduta.walk.build.screen import Screen
from veduta.walk.build.turns import find_turns, turn_between
from veduta.walk.command import run_walk
from veduta.walk.options import WalkOptions
from veduta.walk.rig import Rig, StereoPair

WALK = GorgeWalk(keys=1, views=3, width_px=288, height_px=208, drift=1.15)


@pytest.fixture(scope="module")
def shots() -> tuple[list[WalkCamera], list[tuple[WalkShot, WalkShot]]]:
    return shoot_walk(WALK)


@pytest.fixture(scope="module")
def models(shots: tuple[list[WalkCamera], list[tuple[WalkShot, WalkShot]]]) -> list[LocalModel]:
    focal = (WALK.focal_px, WALK.focal_px)
    rig = Rig(288, 208, focal, (144.0, 104.0), WALK.baseline_m)
    pairs = [StereoPair("0", str(n), a.image, b.image) for n, (a, b) in enumerate(shots[1])]
    return [build_local_model(pair, rig) for pair in pairs]


@pytest.fixture(scope="module")
def mosaic(models: list[LocalModel]) -> Mosaic:
    return make_mosaic(models)


def test_a_point_of_a_cylinder_comes_back() -> None:
    screen = Screen(600, 200, (300.0, 310.0), (280.0, 90.0), round=True)
    depth = np.random.default_rng(1).uniform(1.0, 50.0, (200, 600))
    points = screen.points(screen.pixels, depth)
    pixels, found = screen.project(points)
    assert np.abs(pixels - screen.pixels).max() < 1e-3
    assert np.abs(found - depth).max() < 1e-4
    behind = screen.project(np.array([[0.1, 0.0, -5.0]]))
    assert behind[1][0] < 0.0
    assert np.isfinite(behind[0][0, 0])


def test_rays_turned_by_a_known_rotation() -> None:
    rng = np.random.default_rng(2)
    rays = rng.normal(size=(30, 3))
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    turn = Rotation.from_rotvec([0.2, -0.7, 0.1]).as_matrix()
    assert np.abs(turn_between(rays @ turn.T, rays) - turn).max() < 1e-9


def test_the_views_turn_as_they_were_turned(models: list[LocalModel]) -> None:
    found = find_turns(models)
    assert found.front == 1
    for number, turn in enumerate(found.front_from_view):
        true = Rotation.from_euler("y", (number - 1) * WALK.view_turn_rad).as_matrix()
        assert np.rad2deg(Rotation.from_matrix(true.T @ turn).magnitude()) < 0.1


def test_a_mosaic_has_no_gaps_and_one_exposure(mosaic: Mosaic) -> None:
    assert mosaic.gap < 1e-3
    wanted = 1.15 ** (np.array([1.0, 0.0, -1.0]) / 2.2)
    assert np.abs(mosaic.gains / wanted[:, None] - 1.0).max() < 0.02


def test_a_mosaic_shows_what_is_there(
    mosaic: Mosaic, shots: tuple[list[WalkCamera], list[tuple[WalkShot, WalkShot]]]
) -> None:
    """Depth and picture beside those of a camera that looks between two of the views."""
    screen = mosaic.model.screen
    for number, (shot, _) in enumerate(shots[1]):
        turn = Rotation.from_euler("y", (number - 1) * WALK.view_turn_rad).as_matrix()
        plane = Screen(288, 208, (WALK.focal_px,) * 2, (144.0, 104.0))
        inner = (slice(60, 150, 5), slice(90, 280, 5))
        depth = shot.depth_m[inner]
        points = plane.points(plane.pixels[inner], np.nan_to_num(depth, nan=1.0)) @ turn.T
        pixels, radius = screen.project(points)
        columns, rows = np.floor(pixels).astype(int).transpose(2, 0, 1)
        inside = np.isfinite(depth) & (rows >= 0) & (rows < screen.height_px)
        rows, columns = np.clip(rows, 0, screen.height_px - 1), np.clip(columns, 0, None)
        columns = np.minimum(columns, screen.width_px - 1)
        inside &= mosaic.model.measured[rows, columns]
        off = np.abs(mosaic.model.depth_m[rows, columns] / radius - 1.0)[inside]
        assert inside.sum() > 200
        assert np.median(off) < 0.04
        assert (off < 0.15).mean() > 0.85
        seen = mosaic.model.image[rows, columns].astype(float) / mosaic.gains[number]
        assert np.median(np.abs(seen - shot.image[inner])[inside]) < 6.0


def test_maps_are_made_to_meet() -> None:
    """A plane that is wrong by a factor joins another one, and keeps its slope beyond."""
    x, y = np.meshgrid(np.arange(240.0), np.arange(120.0))
    true = (0.2 + 0.0005 * x + 0.001 * y).astype(np.float32)
    wrong = (true * 1.08 + 0.01).astype(np.float32)
    own, other = x > 90, x < 150
    found = rectified(wrong, own, true, other)
    shared = own & other
    assert np.abs(found - true)[shared].max() < 1e-6
    seam = np.abs(found[:, 150] - found[:, 149])
    assert seam.max() < 0.002
    assert np.abs(wrong[:, 150] - true[:, 149]).min() > 0.03
    across = np.diff(found[:, 170:], axis=1) - np.diff(wrong[:, 170:], axis=1)
    assert np.abs(across).max() < 5e-4


def test_no_seam_is_left_in_the_gorge(models: list[LocalModel], mosaic: Mosaic) -> None:
    """Neighbours' inverse depths differ at the borders of views no more than elsewhere."""
    inverse = 1.0 / mosaic.model.depth_m.astype(float)
    steps = np.abs(np.diff(inverse, axis=1)) / np.minimum(inverse[:, 1:], inverse[:, :-1])
    usual = np.percentile(steps, 95, axis=0)
    ends = _borders(models, mosaic)
    for border in ends:
        around = slice(max(0, border - 3), border + 4)
        assert np.median(steps[:, around].max(axis=1)) < max(0.05, 2.0 * np.median(usual))


def _borders(models: list[LocalModel], mosaic: Mosaic) -> list[int]:
    """The columns in which the front view's picture ends."""
    half = np.arctan(0.5 * WALK.width_px / WALK.focal_px)
    screen = mosaic.model.screen
    return [round(screen.centre_px[0] + sign * half * screen.focal_px[0]) for sign in (-1, 1)]


def test_views_of_other_places_make_no_mosaic(models: list[LocalModel]) -> None:
    blank = [
        LocalModel(
            one.key, one.screen, np.full_like(one.image, 120), one.depth_m, one.measured, one.sky
        )
        for one in models
    ]
    with pytest.raises(NotFoundError, match="no two of its views have anything in common"):
        make_mosaic(blank)


def test_colours_are_compared_where_they_say_something() -> None:
    rng = np.random.default_rng(6)
    one = rng.uniform(30, 160, (4000, 3))
    ratio = compare_colours(one, one * [1.2, 1.1, 0.9])
    assert ratio == pytest.approx((1.2, 1.1, 0.9), rel=1e-6)
    assert compare_colours(one[:50], one[:50]) is None
    assert compare_colours(np.full((4000, 3), 255.0), np.full((4000, 3), 255.0)) is None


def test_gains_undo_a_drift() -> None:
    compared = [Compared(n, n + 1, (1.1, 1.1, 1.1)) for n in range(4)]
    gains = level_gains(5, compared)
    exposure = gains[:, 0] * 1.1 ** np.arange(5)
    assert exposure.max() / exposure.min() < 1.06
    assert np.prod(gains[:, 0]) == pytest.approx(1.0, abs=1e-9)


def test_a_walk_of_mosaics(tmp_path: Path) -> None:
    walk = GorgeWalk(keys=2, views=2, width_px=224, height_px=160, step_m=2.0, drift=1.05)
    write_walk(tmp_path / "record", walk)
    result = run_walk(tmp_path / "record", tmp_path / "out", WalkOptions(), Progress(quiet=True))
    assert result.exit_code == 0
    assert result.doubts == []
    told = json.loads((tmp_path / "out" / "walk.json").read_text())
    (way,) = told["transitions"]
    assert way["kind"] == "morph"
    assert way["distance_m"] == pytest.approx(2.0, rel=0.06)
    assert [one["id"] for one in told["keys"][0]["views"]] == ["0", "1"]
    gains = np.array([one["gain"] for one in told["keys"]])
    assert (gains[0] / gains[1]) == pytest.approx(1.05 ** (2 / 2.2), rel=0.02)
    place = json.loads((tmp_path / "out" / "place.json").read_text())
    key = place["walks"][0]["keys"][0]
    assert key["projection"] == "cylinder"
    assert key["width_px"] > 1.3 * 224
    assert Image.open(tmp_path / "out" / key["picture"]).size == (key["width_px"], key["height_px"])


def test_the_cameras_of_a_key_position_stand_in_one_place() -> None:
    from veduta.synthetic.walks.gorge import make_gorge
    from veduta.synthetic.walks.record import views_of

    camera = cameras_of(WALK, make_gorge(3.0))[0]
    views = views_of(WALK, camera)
    assert len(views) == 3
    for view in views:
        assert np.abs(view.world_from_camera[:3, 3] - camera.world_from_camera[:3, 3]).max() < 1e-12
    assert np.abs(views[1].world_from_camera - camera.world_from_camera).max() < 1e-12
