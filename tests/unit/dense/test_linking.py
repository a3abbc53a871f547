"""Rectified pairs and links on a wall with a block before it, whose depths are known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from stereo_scene import depths, eyes, write_set

from veduta.cameras import Camera, read_cameras
from veduta.dense.document import Views
from veduta.dense.read.linking import (
    LinkParameters,
    MatchedPair,
    chains_of,
    linked_depths,
    match_views,
    pair_range,
)
from veduta.dense.read.neighbours import Comparison
from veduta.dense.read.pictures import open_views, usable_cameras
from veduta.dense.read.rectifying import RectifyParameters, rectify_pair
from veduta.dense.read.sparse import SparsePoints
from veduta.run.card import choose_engine

RULE = LinkParameters()


@pytest.fixture(scope="module")
def views(tmp_path_factory: pytest.TempPathFactory) -> Views:
    folder = write_set(tmp_path_factory.mktemp("linked") / "wall")
    cameras, _ = usable_cameras(read_cameras(folder))
    return open_views(cameras, 1.0, {})


def _known(views: Views) -> SparsePoints:
    points = depths(eyes(4)[1])[1].reshape(-1, 3)[::97]
    everywhere = np.arange(len(points))
    return SparsePoints(points, (everywhere,) * len(views))


def _pixels(matrix: NDArray[np.float64], pixels: NDArray[np.float64]) -> NDArray[np.float64]:
    moved = np.c_[pixels, np.ones(len(pixels))] @ matrix.T
    return np.asarray(moved[:, :2] / moved[:, 2:])


def _turned(camera: Camera, roll: float, yaw: float) -> Camera:
    """The camera where it stands, turned about its own axes."""
    (sr, cr), (sy, cy) = ((np.sin(a), np.cos(a)) for a in (roll, yaw))
    turn = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]]) @ np.array(
        [[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]
    )
    return replace(camera, cam_from_world=turn @ camera.cam_from_world)


@pytest.mark.parametrize(("roll", "yaw"), [(0.0, 0.0), (0.3, 0.2), (1.5, -0.1), (-1.6, 0.0)])
def test_rows_of_a_pair_are_the_same_and_disparities_tell_the_depth(
    views: Views, roll: float, yaw: float
) -> None:
    here, there = _turned(views.cameras[1], roll, yaw), _turned(views.cameras[2], roll, 0.0)
    pair = rectify_pair(here, there, RectifyParameters())
    assert not isinstance(pair, str)
    points = np.random.default_rng(1).uniform([-1, 4, 0], [1, 7, 1.5], (200, 3))
    seen = [
        _pixels(matrix, camera.project(points)[0])
        for matrix, camera in zip(pair.rectified, (here, there), strict=True)
    ]
    assert np.allclose(seen[0][:, 1], seen[1][:, 1], atol=1e-6)
    ahead = (points - here.centre()) @ pair.turn[2]
    wanted = pair.shift_px - pair.focal_px * pair.baseline_m / ahead
    assert np.allclose(seen[1][:, 0] - seen[0][:, 0], wanted, atol=1e-6)
    back = pair.swapped()
    assert np.allclose(-wanted, back.shift_px - back.focal_px * back.baseline_m / ahead)
    low, count = pair.disparities(ahead.min(), ahead.max())
    assert low <= wanted.min()
    assert low + count - 1 >= wanted.max()


def test_driving_forward_is_no_pair(views: Views) -> None:
    here = views.cameras[1]
    pose = here.cam_from_world.copy()
    pose[2, 3] -= 2.0
    assert "rows of theirs" in str(
        rectify_pair(here, replace(here, cam_from_world=pose), RectifyParameters())
    )
    assert isinstance(rectify_pair(here, here, RectifyParameters()), str)


def _matched(views: Views) -> dict[tuple[int, int], MatchedPair]:
    found = {}
    engine = choose_engine("cpu")
    for two in ((0, 1), (1, 2), (2, 3)):
        pair = rectify_pair(views.cameras[two[0]], views.cameras[two[1]], RULE.rectify)
        assert not isinstance(pair, str)
        tried = pair_range(_known(views), views, two, pair, RULE)
        assert not isinstance(tried, str)
        there, back = match_views(views, two, pair, tried, RULE, engine)
        found[two] = MatchedPair(two, pair, there, back)
    return found


def test_points_behind_a_pair_give_no_disparities(views: Views) -> None:
    pair = rectify_pair(views.cameras[1], views.cameras[2], RULE.rectify)
    assert not isinstance(pair, str)
    known = _known(views)
    behind = replace(known, points_m=2.0 * views.cameras[1].centre() - known.points_m)
    assert "no point" in str(pair_range(behind, views, (1, 2), pair, RULE))


def test_links_find_the_depths_and_end_where_a_pair_is_missing(views: Views) -> None:
    pairs = _matched(views)
    engine = choose_engine("cpu")
    comparison = Comparison(1, (0, 2), 2.0, 12.0)
    chains = chains_of(1, pairs, [0, 1, 2, 3], RULE.most_links)
    assert [[one.views for one in chain] for chain in chains] == [[(1, 2), (2, 3)], [(1, 0)]]
    found = linked_depths(views, comparison, chains, 2, RULE, engine)
    truth, _ = depths(eyes(4)[1])
    assert found.known.mean() > 0.5
    away = np.abs(found.depths_m - truth)[found.known] / truth[found.known]
    assert np.quantile(away, 0.85) < 0.03
    facing = found.normals.reshape(*truth.shape, 3)[found.known]
    assert np.median(facing[:, 2]) < -0.8
    assert found.agree.max() == 3
    del pairs[(1, 2)]
    chains = chains_of(1, pairs, [0, 1, 2, 3], RULE.most_links)
    assert [len(chain) for chain in chains] == [0, 1]
    alone = linked_depths(views, comparison, [[], []], 2, RULE, engine)
    assert not alone.known.any()


def test_the_command_links(tmp_path: Path) -> None:
    from veduta.cli.main import main

    photos = write_set(tmp_path / "wall")
    call = ["dense", str(photos), "-o", str(tmp_path / "out"), "--quiet", "--no-texture"]
    assert main([*call, "--method", "linking"]) == 0
    assert (tmp_path / "out" / "cloud.ply").is_file()
