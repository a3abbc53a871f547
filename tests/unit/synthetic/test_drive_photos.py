"""Images of synthetic drives: what they show is where the street has it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.read.own import read_own
from veduta.drive.record import Shot
from veduta.synthetic.drives import (
    Fronts,
    Street,
    StreetCamera,
    StreetOptions,
    StreetPhoto,
    TruckOptions,
    build_street,
    photograph,
    poses_at,
    scan_street,
    take_photos,
    write_drive,
    write_photos,
)

CAMERA = StreetCamera(width_px=256, height_px=192, focal_px=125.0, noise=0.0, exposure=0.0)
TRUCK = TruckOptions()
SEED, PLACE_M = 3, 20.0


@pytest.fixture(scope="module")
def street() -> Street:
    return build_street(StreetOptions(length_m=40.0, near_trees=1.0), SEED)


@pytest.fixture(scope="module")
def photo(street: Street) -> StreetPhoto:
    pose = poses_at(np.array([PLACE_M]), TRUCK)[0]
    return photograph(street, Fronts(street, SEED), CAMERA, pose, np.random.default_rng(1))


def _projected(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """(n, 2) columns and rows of points, by the camera that the verb has."""
    place = np.eye(4)
    place[:3] = CAMERA.world_from_cam(poses_at(np.array([PLACE_M]), TRUCK)[0])
    middle = (CAMERA.width_px / 2, CAMERA.height_px / 2)
    focal = (CAMERA.focal_px, CAMERA.focal_px)
    shot = Shot("a", Path("a"), 0.0, CAMERA.width_px, CAMERA.height_px, focal, middle, place)
    pixels, depth = shot.project(points)
    assert (depth > 0).all()
    return np.floor(pixels).astype(np.int64)


def _inside(at: NDArray[np.int64], rim: int = 6) -> NDArray[np.bool_]:
    size = np.array([CAMERA.width_px, CAMERA.height_px])
    return np.asarray(((at >= rim) & (at < size - rim)).all(axis=1))


def test_windows_are_dark_where_they_stand(street: Street, photo: StreetPhoto) -> None:
    """A quarter of each window lies below its bars, and is glass or a curtain."""
    middle = street.panes.mean(axis=1)
    middle[:, 0] += 0.15
    at = _projected(middle + np.array([0.0, 0.2, -0.3]))
    seen = _inside(at)
    assert seen.sum() > 6
    front = photo.front[at[seen, 1], at[seen, 0]]
    light = photo.behind[at[seen, 1], at[seen, 0]].mean(axis=1)
    assert front.mean() > 0.9  # a balcony may stand before one
    assert np.median(light) < 110
    beside = _projected(middle + np.array([0.0, 1.1, 0.0]))
    kept = _inside(beside)
    assert np.median(photo.behind[beside[kept, 1], beside[kept, 0]].mean(axis=1)) > 110


def test_trunks_and_crowns_hide_what_is_behind(street: Street, photo: StreetPhoto) -> None:
    thick = street.cylinders[street.cylinders[:, 2] > 0.1]
    at = _projected(np.column_stack([thick[:, :2], np.full(len(thick), 1.5)]))
    at = at[_inside(at, 1)]
    assert len(at) > 0
    assert photo.before[at[:, 1], at[:, 0]].all()


def test_elsewhere_nothing_is_changed(photo: StreetPhoto) -> None:
    apart = np.abs(photo.pixels.astype(int) - photo.behind).max(axis=2)
    assert apart[photo.before].mean() > 20
    # A pixel on an edge is partly hidden.
    assert (apart[~photo.before] == 0).mean() > 0.9


def test_a_front_straight_on_is_its_picture(street: Street, photo: StreetPhoto) -> None:
    """What a camera sees of a place on a front is the colour that the front has there."""
    fronts = Fronts(street, SEED)
    y, z = np.meshgrid(np.arange(16.0, 24.0, 0.5), np.arange(1.0, 6.0, 0.5))
    number = fronts.number_at(y.ravel())
    front = np.array([house.front_m for house in fronts.houses])[number]
    at = _projected(np.column_stack([front, y.ravel(), z.ravel()]))
    footprint = np.full(y.size, 11.0 / CAMERA.focal_px)
    told = fronts.colours(y.ravel(), z.ravel(), footprint)
    shown = photo.front[at[:, 1], at[:, 0]]
    apart = np.abs(photo.behind[at[:, 1], at[:, 0]] - told).mean(axis=1)
    assert shown.mean() > 0.8
    assert np.median(apart[shown]) < 12


def test_a_drive_with_images_is_read(street: Street, tmp_path: Path) -> None:
    write_drive(scan_street(street, TRUCK, SEED), tmp_path)
    taken = take_photos(street, Fronts(street, SEED), TRUCK, CAMERA, SEED, (10.0, 12.5))
    true = write_photos(taken, CAMERA, tmp_path)
    record = read_own(tmp_path)
    assert len(record.shots) == len(true) == 3
    told = np.array([shot.time_s for shot in record.shots])
    assert 0.0 < np.abs(told - true).max() < 0.03
    for shot, time_s in zip(record.shots, told, strict=True):
        pose = poses_at(np.array([time_s * TRUCK.speed_m_s]), TRUCK)[0]
        place = CAMERA.world_from_cam(pose)
        np.testing.assert_allclose(shot.world_from_cam[:3, :3], place[:, :3], atol=1e-3)
        np.testing.assert_allclose(shot.world_from_cam[:3, 3], place[:, 3], atol=0.01)


def test_near_trees_leave_the_rest_of_the_street(street: Street) -> None:
    other = build_street(StreetOptions(length_m=40.0), SEED)
    np.testing.assert_array_equal(street.walls, other.walls)
    np.testing.assert_array_equal(street.balls[: len(other.balls)], other.balls)
    assert len(street.balls) > len(other.balls)
