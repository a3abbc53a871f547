"""The conditions on a first pair, on two views of made-up points."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from numpy.typing import NDArray

from veduta.photos.mapping.initial_pair import (
    FEWEST,
    LEAST_ANGLE_DEG,
    MOST_PLANAR,
    WeighedPair,
    weigh,
    weighed_pairs,
)

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 1200, 900, 1000.0
SEEDS = (0, 1, 2)


def camera(number: int = 1, *, known: bool = True) -> pycolmap.Camera:
    made = pycolmap.Camera.create_from_model_name(
        number, "SIMPLE_RADIAL", FOCAL_PX, WIDTH_PX, HEIGHT_PX
    )
    made.has_prior_focal_length = known
    return made


def scene(seed: int, *, plane: bool = False) -> NDArray[np.float64]:
    """(400, 3) points 8 to 12 m before the first camera; or on a slanting plane."""
    rng = np.random.default_rng(seed)
    points = rng.uniform((-3.0, -2.5, 8.0), (3.0, 2.5, 12.0), (400, 3))
    if plane:
        points[:, 2] = 10.0 + 0.4 * points[:, 0]
    return points


def views(
    points: NDArray[np.float64], baseline_m: float, turned_rad: float, seed: int
) -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
    """Pixels (n, 2) of both, half a pixel off, and the angle between the rays of each (n,).

    The second camera stands to the right and looks to the left.
    """
    rng = np.random.default_rng(seed + 100)
    cosine, sine = np.cos(turned_rad), np.sin(turned_rad)
    turn = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    places = np.array([[0.0, 0.0, 0.0], [baseline_m, 0.0, 0.0]])
    seen = []
    for rotation, place in zip((np.eye(3), turn), places, strict=True):
        local = (points - place) @ rotation.T
        px = FOCAL_PX * local[:, :2] / local[:, 2:] + (WIDTH_PX / 2, HEIGHT_PX / 2)
        seen.append(px + rng.normal(0.0, 0.5, px.shape))
    rays = [points - place for place in places]
    rays = [ray / np.linalg.norm(ray, axis=1)[:, None] for ray in rays]
    return seen, np.arccos(np.minimum(1.0, (rays[0] * rays[1]).sum(axis=1)))


def weighed(
    points: NDArray[np.float64], baseline_m: float, turned_rad: float, seed: int
) -> tuple[WeighedPair, float]:
    """The pair, and the true median angle (degrees)."""
    seen, angles = views(points, baseline_m, turned_rad, seed)
    rows = np.repeat(np.arange(len(points))[:, None], 2, axis=1)
    found = weigh((1, 2), [camera(1), camera(2)], seen, rows, seed)
    return found, float(np.rad2deg(np.median(angles)))


@pytest.mark.parametrize("seed", SEEDS)
def test_depth_seen_from_two_places_begins_a_map(seed: int) -> None:
    found, true_deg = weighed(scene(seed), 2.0, -0.2, seed)
    assert found.fault is None
    assert (found.matches, found.known) == (400, True)
    assert found.planar < 0.5
    assert found.angle_deg == pytest.approx(true_deg, rel=0.05)
    assert 10.0 < true_deg < 13.0


@pytest.mark.parametrize("seed", SEEDS)
def test_a_plane_begins_none(seed: int) -> None:
    found, _ = weighed(scene(seed, plane=True), 2.0, -0.2, seed)
    assert found.planar > 0.95 > MOST_PLANAR
    assert found.fault is not None
    assert "homography" in found.fault


@pytest.mark.parametrize("seed", SEEDS)
def test_a_camera_that_only_turned_begins_none(seed: int) -> None:
    found, _ = weighed(scene(seed), 0.0, -0.2, seed)
    assert found.planar > 0.95
    assert found.fault is not None


@pytest.mark.parametrize("seed", SEEDS)
def test_two_places_near_each_other_begin_none(seed: int) -> None:
    """A metre at 10 m: 5.7 degrees; what moves 50 pixels is no homography's doing."""
    found, true_deg = weighed(scene(seed), 1.0, -0.1, seed)
    assert found.planar < MOST_PLANAR
    assert found.angle_deg == pytest.approx(true_deg, rel=0.1)
    assert true_deg < LEAST_ANGLE_DEG
    assert found.fault is not None
    assert "apart" in found.fault


def test_the_order_of_pairs(tmp_path: Path) -> None:
    """Known focal lengths first where matches suffice, then by matches; too few are none.

    Photos 1 to 3 have a known focal length, 4 and 5 none; 6 and 7 do, and see a plane.
    """
    counts = {(1, 2): 150, (1, 3): 30, (2, 3): FEWEST - 1, (1, 4): 300, (4, 5): 200, (2, 5): 90}
    counts |= {(6, 7): 400}
    seen, _ = views(scene(0), 2.0, -0.2, 0)
    flat, _ = views(scene(0, plane=True), 2.0, -0.2, 0)
    with pycolmap.Database.open(tmp_path / "own.db") as opened:
        for image in range(1, 8):
            opened.write_camera(camera(image, known=image not in (4, 5)), use_camera_id=True)
            made = pycolmap.Image(name=f"{image}", camera_id=image, image_id=image)
            opened.write_image(made, use_image_id=True)
            places = (seen if image <= 5 else flat)[image % 2]
            opened.write_keypoints(image, places.astype(np.float32))
        for pair, count in counts.items():
            rows = np.repeat(np.arange(count, dtype=np.uint32)[:, None], 2, axis=1)
            geometry = pycolmap.TwoViewGeometry(inlier_matches=rows)
            opened.write_two_view_geometry(*pair, geometry)
    found = weighed_pairs(tmp_path / "own.db", range(1, 8), 0)
    order = [(pair.first, pair.second) for pair in found]
    assert order[:4] == [(1, 2), (1, 4), (4, 5), (2, 5)]
    assert {*order[4:]} == {(1, 3), (6, 7)}
    assert [pair.known for pair in found[:4]] == [True, False, False, False]
    some = weighed_pairs(tmp_path / "own.db", (1, 4, 5), 0)
    assert [(pair.first, pair.second) for pair in some] == [(1, 4), (4, 5)]
