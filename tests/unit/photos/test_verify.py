"""Verification of two views: against numpy's SVD and against cameras that are known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from numpy.typing import NDArray

from veduta import _core
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.matching.match import read_pairs, write_database
from veduta.photos.matching.pairs import Pairs
from veduta.photos.matching.verify import Matched, by_lmeds, by_magsac, essential, verify_pairs
from veduta.photos.options import MatchOptions

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 1600, 1200, 1400.0
K = np.array([[FOCAL_PX, 0, WIDTH_PX / 2], [0, FOCAL_PX, HEIGHT_PX / 2], [0, 0, 1.0]])
ROTATION = pycolmap.Rotation3d(np.array([0.05, -0.15, 0.03])).matrix()
SHIFT = np.array([1.2, -0.3, 0.2])
Points = NDArray[np.float64]


def two_views(
    kind: str = "deep", count: int = 160, share: float = 0.25, seed: int = 0
) -> tuple[Points, Points, int]:
    """Matched points with noise, of which the first ones are false, and how many those are."""
    rng = np.random.default_rng(seed)
    points = rng.uniform((-3.0, -2.0, 7.0), (3.0, 2.0, 12.0), (count, 3))
    if kind == "plane":
        points[:, 2] = 9.0 + 0.3 * points[:, 0]
    shift = np.zeros(3) if kind == "turn" else SHIFT
    seen = [own @ K.T for own in (points, points @ ROTATION.T + shift)]
    first, second = (own[:, :2] / own[:, 2:] + rng.normal(0, 0.4, (count, 2)) for own in seen)
    false = int(share * count)
    second[:false] = rng.uniform((0, 0), (WIDTH_PX, HEIGHT_PX), (false, 2))
    return first, second, false


def true_f() -> Points:
    x, y, z = SHIFT
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0.0]])
    back = np.linalg.inv(K)
    found: Points = back.T @ cross @ ROTATION @ back
    return found


def line_errors(f: Points, first: Points, second: Points) -> Points:
    ones = np.ones((len(first), 1))
    one, other = np.hstack([first, ones]), np.hstack([second, ones])
    lines = one @ f.T
    found: Points = np.abs((other * lines).sum(axis=1)) / np.linalg.norm(lines[:, :2], axis=1)
    return found


def matched(first: Points, second: Points, unit: float = 1.0) -> Matched:
    rows = np.arange(len(first), dtype=np.uint32)
    return Matched(np.column_stack([rows, rows]), first, second, (unit, unit), 7)


def normalisation(points: Points) -> Points:
    middle = points.mean(axis=0)
    scale = np.sqrt(2) / np.linalg.norm(points - middle, axis=1).mean()
    return np.array([[scale, 0, -scale * middle[0]], [0, scale, -scale * middle[1]], [0, 0, 1.0]])


@pytest.mark.parametrize("seed", range(5))
def test_eight_points_as_numpy_has_them(seed: int) -> None:
    first, second, _ = two_views(share=0.0, count=30, seed=seed)
    weights = np.random.default_rng(seed).uniform(0.1, 2.0, 30)
    t1, t2 = normalisation(first), normalisation(second)
    ones = np.ones((30, 1))
    one, other = np.hstack([first, ones]) @ t1.T, np.hstack([second, ones]) @ t2.T
    rows = (other[:, :, None] * one[:, None, :]).reshape(30, 9) * np.sqrt(weights)[:, None]
    left, sizes, right = np.linalg.svd(np.linalg.svd(rows)[2][-1].reshape(3, 3))
    wanted = t2.T @ left @ np.diag([sizes[0], sizes[1], 0]) @ right @ t1
    found = _core.linear_fundamental(first, second, weights)
    wanted /= np.linalg.norm(wanted)
    assert min(np.abs(found - wanted).max(), np.abs(found + wanted).max()) < 1e-7
    assert abs(np.linalg.norm(found) - 1) < 1e-12


@pytest.mark.parametrize("judge", [by_lmeds, by_magsac])
@pytest.mark.parametrize("unit", [1.0, 3.0])
def test_a_scene_in_depth(judge: object, unit: float) -> None:
    first, second, false = two_views()
    assert callable(judge)
    (found,) = judge([matched(first * unit, second * unit, unit)])
    assert found.verdict == "general"
    assert found.inliers[:false].sum() <= 3
    assert found.inliers[false:].mean() > 0.9
    errors = line_errors(found.fundamental, first[false:] * unit, second[false:] * unit)
    assert errors.mean() < 0.7 * unit


@pytest.mark.parametrize("judge", [by_lmeds, by_magsac])
@pytest.mark.parametrize("kind", ["plane", "turn"])
def test_a_plane_and_a_turn(judge: object, kind: str) -> None:
    first, second, false = two_views(kind)
    assert callable(judge)
    (found,) = judge([matched(first, second)])
    assert found.verdict == "planar"
    assert found.inliers[false:].mean() > 0.9
    moved = np.hstack([first, np.ones((len(first), 1))])[false:] @ found.homography.T
    off = np.linalg.norm(moved[:, :2] / moved[:, 2:] - second[false:], axis=1)
    assert off.mean() < 1.5


@pytest.mark.parametrize("judge", [by_lmeds, by_magsac])
def test_noise_and_too_few_are_refused(judge: object) -> None:
    first, second, _ = two_views(share=1.0, count=60)
    assert callable(judge)
    noise, few = judge([matched(first, second), matched(first[:19], second[:19])])
    assert noise.verdict in ("mostly-false", "too-few")
    assert few.verdict == "too-few"
    assert not noise.inliers.any()
    assert not few.inliers.any()


def test_the_essential_matrix_is_that_of_the_cameras() -> None:
    found = essential(true_f(), K, K)
    sizes = np.linalg.svd(found)[1]
    assert sizes[0] == pytest.approx(sizes[1])
    assert sizes[2] == pytest.approx(0.0, abs=1e-15)
    x, y, z = SHIFT
    wanted = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0.0]]) @ ROTATION
    assert np.abs(found / np.linalg.norm(found) - wanted / np.linalg.norm(wanted)).max() < 1e-9


def database(folder: Path, views: list[tuple[Points, Points, int]], focal: float | None) -> Path:
    """Two photos for each pair of views, the pair's matches between them."""
    photos, files = [], []
    for number, points in enumerate(own for view in views for own in view[:2]):
        file = folder / f"{number}.npz"
        keypoints = np.column_stack([points, np.ones(len(points)), np.zeros(len(points))])
        np.savez(
            file,
            keypoints=keypoints.astype(np.float32),
            descriptors=np.zeros((len(points), 128), dtype=np.uint8),
        )
        files.append(file)
        photos.append(
            PhotoRecord(
                image_id=number + 1, name=f"{number}.jpg", path=file, sha256="",
                width_px=WIDTH_PX, height_px=HEIGHT_PX, focal_px=focal, camera=None,
                time=None, position=None, group=1, notes=(),
            )
        )  # fmt: skip
    path = folder / "matches.db"
    write_database(path, photos, files, per_photo=False)
    with pycolmap.Database.open(path) as opened:
        for number, view in enumerate(views):
            rows = np.arange(len(view[0]), dtype=np.uint32)
            opened.write_matches(2 * number + 1, 2 * number + 2, np.column_stack([rows, rows]))
    return path


@pytest.mark.parametrize("focal", [None, FOCAL_PX])
@pytest.mark.parametrize("epipolar", ["lmeds", "magsac"])
def test_what_the_engine_is_told(tmp_path: Path, epipolar: str, focal: float | None) -> None:
    views = [two_views(), two_views("plane"), two_views("turn"), two_views(share=1.0, count=60)]
    path = database(tmp_path, views, focal)
    pairs = ((1, 2), (3, 4), (5, 6), (7, 8))
    options = MatchOptions.model_validate({"epipolar": epipolar})
    verify_pairs(path, pairs, options, seed=0)
    with pycolmap.Database.open(path) as opened:
        found = [opened.read_two_view_geometry(*pair) for pair in pairs]
    known = pycolmap.TwoViewGeometryConfiguration
    names = [known(geometry.config).name for geometry in found]
    if focal is None:
        either = "PLANAR_OR_PANORAMIC"
        assert names == ["UNCALIBRATED", either, either, "DEGENERATE"]
    else:
        assert names == ["CALIBRATED", "PLANAR", "PANORAMIC", "DEGENERATE"]
        pose = found[0].cam2_from_cam1
        assert np.abs(pose.rotation.matrix() - ROTATION).max() < 0.02
        assert pose.translation @ SHIFT / np.linalg.norm(SHIFT) > 0.99
    records = read_pairs(path, Pairs(pairs, "all", ""))
    assert [record.planar for record in records] == [False, True, True, False]
    assert records[0].matches == 160
    assert 110 < records[0].verified < 125
    assert records[3].verified == 0


def test_the_draws_of_a_pair_are_its_own(tmp_path: Path) -> None:
    """A killed run that goes on with fewer pairs has the same result."""
    views = [two_views(seed=seed) for seed in range(3)]
    pairs = ((1, 2), (3, 4), (5, 6))
    geometries = []
    for batches in ([pairs], [pairs[2:], pairs[:2]]):
        folder = tmp_path / str(len(batches))
        folder.mkdir()
        path = database(folder, views, None)
        for batch in batches:
            verify_pairs(path, batch, MatchOptions(), seed=3)
        with pycolmap.Database.open(path) as opened:
            geometries.append([opened.read_two_view_geometry(*pair).F for pair in pairs])
    assert all(np.array_equal(one, other) for one, other in zip(*geometries, strict=True))


def test_faults_of_the_input_are_named() -> None:
    points = np.zeros((9, 2))
    with pytest.raises(_core.UnequalPointsError, match="9 points of the first photo, 8"):
        _core.linear_fundamental(points, points[:8], np.ones(9))
    with pytest.raises(_core.PointNotFiniteError, match="match 0"):
        _core.linear_fundamental(np.full((9, 2), np.nan), points, np.ones(9))
    with pytest.raises(_core.DegenerateMatchesError):
        _core.linear_fundamental(points, points, np.ones(9))
    with pytest.raises(_core.TooFewMatchesError, match="7 matches, 8 are needed"):
        _core.linear_fundamental(points[:7], points[:7], np.ones(7))
