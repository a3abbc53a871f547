"""What is marked in views: water and movers of rendered gorges, by what each pixel shows there."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.run.progress import Progress
from veduta.synthetic.walks.gorge import MOVER, WATER
from veduta.synthetic.walks.record import GorgeWalk, shoot_walk, write_walk
from veduta.synthetic.walks.shoot import WalkCamera, WalkShot
from veduta.walk.build.fewer import fewer_triangles, grid_shape
from veduta.walk.build.ground import height_above_ground
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.marks import find_grass
from veduta.walk.build.mesh import GRASS, MOVING, MorphMesh
from veduta.walk.build.moving import find_moving
from veduta.walk.build.render import Mixing, draw_mesh, mixed
from veduta.walk.build.screen import Screen
from veduta.walk.build.water import find_water
from veduta.walk.command import run_walk
from veduta.walk.options import WalkOptions
from veduta.walk.rig import Rig, StereoPair
from veduta.walk.tell import moving_or_wrong

SMALL = GorgeWalk(keys=2, step_m=2.0, width_px=288, height_px=180)
Mask = NDArray[np.bool_]


def _models(walk: GorgeWalk) -> tuple[list[LocalModel], list[WalkCamera], list[WalkShot], Rig]:
    cameras, pairs = shoot_walk(walk)
    focal = (walk.focal_px, walk.focal_px)
    middle = (0.5 * walk.width_px, 0.5 * walk.height_px)
    rig = Rig(walk.width_px, walk.height_px, focal, middle, walk.baseline_m)
    models = [
        build_local_model(StereoPair(str(n), "0", left.image, right.image), rig)
        for n, (left, right) in enumerate(pairs)
    ]
    return models, cameras, [left for left, _ in pairs], rig


def _overlap(found: Mask, true: Mask) -> float:
    return float((found & true).sum() / (found | true).sum())


def _between(first: WalkCamera, second: WalkCamera) -> NDArray[np.float64]:
    poses = [one.world_from_camera for one in (first, second)]
    return np.asarray(np.linalg.inv(poses[1]) @ poses[0])[:3]


def test_water_is_where_the_gorge_is_mirrored() -> None:
    models, _, shots, _ = _models(replace(SMALL, keys=1, pool=True))
    true = shots[0].kind == WATER
    assert true.mean() > 0.1
    found = models[0].marks.water
    assert _overlap(found, true) > 0.6
    assert (found & ~true).sum() < 0.15 * found.sum()


def test_what_moved_is_marked_in_both_views_and_nothing_else() -> None:
    models, cameras, shots, rig = _models(replace(SMALL, mover=True))
    stereo_px_m = rig.focal_px[0] * rig.baseline_m
    for own, other in ((0, 1), (1, 0)):
        pose = _between(cameras[own], cameras[other])
        found = find_moving(models[own], models[other], pose, stereo_px_m)
        true = shots[own].kind == MOVER
        assert (found & true).sum() > 0.7 * true.sum()
        assert (found & ~true).sum() < 0.7 * true.sum()


def test_a_gorge_that_stands_still_and_dry_has_no_marks() -> None:
    models, cameras, _, rig = _models(replace(SMALL, seed=2))
    pose = _between(*cameras)
    assert not find_moving(models[0], models[1], pose, rig.focal_px[0] * rig.baseline_m).any()
    assert not models[0].marks.water.any()


def _meadow(wall: bool) -> tuple[NDArray[np.uint8], NDArray[np.float64], Mask]:
    """Green ground 1.5 m below the camera, or a green wall 8 m away that stands on grey ground."""
    screen = Screen(200, 140, (180.0, 180.0), (100.0, 60.0))
    rays = screen.points(screen.pixels, np.ones((140, 200)))
    with np.errstate(divide="ignore"):
        depth = np.where(rays[..., 1] > 0.0, 1.5 / rays[..., 1], 1e3)
    depth = np.minimum(depth, 8.0 if wall else 60.0)
    rng = np.random.default_rng(1)
    image = np.tile(np.array([120, 120, 120]), (140, 200, 1))
    is_ground = depth < (8.0 if wall else 60.0)
    image[is_ground != wall] = (70, 130, 50)
    image = image + rng.integers(-12, 13, (140, 200, 1))
    return image.astype(np.uint8), screen.points(screen.pixels, depth), is_ground


def test_green_ground_is_grass_and_a_green_wall_is_none() -> None:
    image, points, ground = _meadow(wall=False)
    everywhere = np.ones(ground.shape, dtype=bool)
    near = ground & (points[..., 2] < 20.0)
    assert find_grass(image, points, everywhere)[near].mean() > 0.95
    assert not find_grass(image, points, everywhere)[~ground].any()
    image, points, _ = _meadow(wall=True)
    assert find_grass(image, points, everywhere).mean() < 0.03  # a row or two at its foot


def test_height_above_a_slanted_ground_is_that_of_its_plane() -> None:
    rng = np.random.default_rng(2)
    x, z = rng.uniform(-8, 8, (60, 80)), rng.uniform(2, 25, (60, 80))
    above = np.where(rng.random((60, 80)) < 0.3, rng.uniform(0.5, 3.0, (60, 80)), 0.0)
    points = np.stack([x, 1.6 + 0.03 * x - 0.02 * z - above, z], axis=-1)
    found = height_above_ground(points, np.ones((60, 80), dtype=bool))
    assert found is not None
    assert np.abs(found - above).max() < 0.05
    assert height_above_ground(points, np.zeros((60, 80), dtype=bool)) is None


def _sheet(depth_m: float, marks: NDArray[np.uint8], shape: tuple[int, int]) -> MorphMesh:
    rows, columns = shape
    y, x = np.indices(shape)
    uv = np.stack([x / (columns - 1), y / (rows - 1)], axis=-1).reshape(-1, 2).astype(np.float32)
    points = np.column_stack([(uv[:, 0] - 0.5) * depth_m, (uv[:, 1] - 0.5) * depth_m, uv[:, 0]])
    points[:, 2] = depth_m
    number = np.arange(rows * columns).reshape(shape)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]
    triangles = np.concatenate(cells).astype(np.uint32)
    place = points.astype(np.float32)
    nothing = np.zeros(len(uv), dtype=np.float32)
    torn = np.zeros(len(triangles), dtype=bool)
    return MorphMesh(place, place, uv, uv, nothing, triangles, torn, marks=marks)


def test_what_moves_is_left_behind_and_hides_nothing() -> None:
    screen = Screen(40, 40, (40.0, 40.0), (20.0, 20.0))
    still = np.column_stack([np.eye(3), np.zeros(3)])
    red, blue = (
        np.tile(np.array(one, np.uint8), (40, 40, 1)) for one in ((255, 0, 0), (0, 0, 255))
    )
    mover = _sheet(4.0, np.full(81, MOVING, np.uint8), (9, 9))
    behind = _sheet(20.0, np.zeros(81, np.uint8), (9, 9))
    for m, seen in ((0.0, red), (0.5, blue), (1.0, blue)):
        layers = [
            draw_mesh(mover, m, still, still, screen, red, blue, Mixing()),
            draw_mesh(behind, 1.0 - m, still, still, screen, blue, red, Mixing()),
        ]
        picture = mixed(layers[0], layers[1], m)[0][4:-4, 4:-4].astype(int)
        assert np.abs(picture - seen[4:-4, 4:-4]).max() < 8


def test_a_surface_at_the_wrong_depth_is_doubted_away_from_its_own_picture() -> None:
    """Two sheets before one another; the first model has a wall at a wrong depth, so that it finds
    something else in the other picture.
    """
    size = 80
    screen = Screen(size, size, (float(size),) * 2, (size / 2.0,) * 2)
    still = np.column_stack([np.eye(3), np.zeros(3)])
    wave = np.sin(np.arange(size) * 0.5)[None, :, None] * np.ones((size, 1, 3))
    wall = (128.0 + 100.0 * wave).astype(np.uint8)
    right = _sheet(5.0, np.zeros(441, np.uint8), (21, 21))
    wrong = replace(right, uv_second=right.uv_second + np.array([0.075, 0.0], np.float32))
    for m, least in ((0.0, 0.999), (0.5, 0.9)):
        layer = draw_mesh(right, m, still, still, screen, wall, wall)
        assert layer.weight[4:-4, 4:-4].min() > least
    inner = draw_mesh(wrong, 0.5, still, still, screen, wall, wall).weight[4:-4, 4:-4]
    assert np.median(inner) < 0.3
    assert inner.min() > 0.04, "nothing is left without a weight"
    assert draw_mesh(wrong, 0.0, still, still, screen, wall, wall).weight[4:-4, 4:-4].min() == 1.0


def test_fewer_triangles_keep_what_is_marked() -> None:
    marks = np.zeros((33, 49), np.uint8)
    marks[5:14, 8:23] = GRASS
    marks[20:25, 30:41] = MOVING
    mesh = _sheet(9.0, marks.reshape(-1), (33, 49))
    found = fewer_triangles(mesh, (480, 320), 400.0)
    assert len(found.triangles) < 0.7 * len(mesh.triangles)
    for bit in (GRASS, MOVING):
        areas = []
        for one in (mesh, found):
            corners = one.uv[one.triangles[one.marked(bit)]].astype(float)
            u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            areas.append(0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum())
        assert areas[1] == pytest.approx(areas[0], rel=0.02)
    assert grid_shape(mesh) == (33, 49)


def test_a_thing_that_moves_is_said_and_marked(tmp_path: Path) -> None:
    write_walk(tmp_path / "in", replace(SMALL, mover=True))
    result = run_walk(tmp_path / "in", tmp_path / "out", WalkOptions(), Progress(quiet=True))
    assert any(doubt.startswith("000 to 001: something moves, in ") for doubt in result.doubts)
    (way,) = json.loads((tmp_path / "out" / "walk.json").read_text())["transitions"]
    assert 0.03 < way["moving"] < 0.12
    glb = (tmp_path / "out" / way["forth"]).read_bytes()
    assert b'"moving"' in glb[: glb.index(b"BIN\0")]


def test_an_upright_wall_that_looks_the_same_above_and_below_is_no_water() -> None:
    screen = Screen(240, 160, (200.0, 200.0), (120.0, 80.0))
    rays = screen.points(screen.pixels, np.ones((160, 240)))
    depth = np.full((160, 240), 5.0)
    rng = np.random.default_rng(5)
    stripes = np.repeat(rng.integers(40, 220, 60), 4)[None, :] + rng.normal(0, 4, (160, 240))
    image = np.repeat(np.clip(stripes, 0, 255)[..., None], 3, axis=2).astype(np.uint8)
    everywhere = np.ones((160, 240), dtype=bool)
    found = find_water(image, rays * depth[..., None], everywhere, ~everywhere, screen)
    assert not found.any()


def test_where_much_seems_to_move_a_wrong_depth_is_named_too() -> None:
    assert moving_or_wrong(0.02, 0.14) == "something moves"
    assert "a depth of one of them is wrong" in moving_or_wrong(0.0, 0.25)
