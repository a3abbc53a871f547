"""Streets of whole houses for drives: where rays end, wide beams, and streets in bends."""

from __future__ import annotations

import numpy as np
import pytest
from derived_houses import derived_house
from numpy.typing import NDArray

from veduta.place.semantics import SemanticClass
from veduta.synthetic.drives import (
    PAPER,
    Kind,
    MadeHouse,
    MadeStreet,
    MadeStreetOptions,
    StreetCamera,
    TruckOptions,
    Way,
    make_street,
    overcast,
    photograph_made,
    poses_at,
    scan_street,
)
from veduta.synthetic.drives.footprint import PULSE_M, mixed, spread
from veduta.synthetic.drives.surface import surface_of

LENGTH_M = 30.0
Floats = NDArray[np.float64]


def same_house(seed: int) -> MadeHouse:
    """One derived house for all lots: quick."""
    return derived_house(11)


@pytest.fixture(scope="module")
def street() -> MadeStreet:
    return make_street(MadeStreetOptions(length_m=LENGTH_M, hedge=True), 2, same_house)


def fan(street: MadeStreet) -> tuple[Floats, Floats]:
    """Level and slanted rays to the left, all along."""
    y, angle = np.meshgrid(np.arange(1.0, 29.0, 0.5), np.deg2rad(np.arange(-60.0, 61.0, 3.0)))
    origins = np.stack([np.zeros(y.size), y.ravel(), np.full(y.size, 3.6)], axis=1)
    flat = np.cos(angle.ravel())
    return origins, np.stack([-flat, np.zeros(y.size), np.sin(angle.ravel())], axis=1)


def test_a_straight_way_goes_along_y() -> None:
    places, heading = Way().at(np.array([-3.0, 0.0, 40.0]))
    np.testing.assert_array_equal(places, [[0, -3], [0, 0], [0, 40]])
    np.testing.assert_array_equal(heading, np.pi / 2)
    poses = poses_at(np.array([0.0, 15.0]), TruckOptions(sway_m=0.0, sway_rad=0.0))
    np.testing.assert_array_equal(poses[1, :, 3], [0.0, 15.0, 0.0])
    np.testing.assert_array_equal(poses[0, :, :3], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])


def test_a_way_in_bends_is_as_tight_as_asked() -> None:
    way = Way(radius_m=60.0, period_m=120.0)
    along = np.arange(0.0, 240.0, 0.5)
    places, heading = way.at(along)
    moves = np.diff(places, axis=0)
    np.testing.assert_allclose(np.linalg.norm(moves, axis=1), 0.5, atol=1e-4)
    middle = (heading[1:] + heading[:-1]) / 2
    np.testing.assert_allclose(np.arctan2(moves[:, 1], moves[:, 0]), middle, atol=1e-3)
    curvature = np.gradient(heading, along)
    assert abs(curvature).max() == pytest.approx(1 / 60.0, rel=0.01)
    # To both sides, by as much.
    assert curvature.min() == pytest.approx(-curvature.max(), rel=0.01)


def test_what_answers_is_of_the_street(street: MadeStreet) -> None:
    origins, directions = fan(street)
    found, kind = street.meet(origins, directions, np.ones(len(origins), dtype=bool))
    facade, is_wall = street.facade(origins, directions)
    assert set(np.unique(kind)) >= {Kind.GROUND, Kind.WALL, Kind.OBJECT, Kind.BEHIND_GLASS}
    # Walls and ground that are met are those of the bare street.
    met = kind == Kind.WALL
    assert is_wall[met].all()
    np.testing.assert_allclose(found[met], facade[met], atol=1e-3)
    np.testing.assert_allclose(found[kind == Kind.GROUND], facade[kind == Kind.GROUND], atol=1e-3)
    # Things stand before it, rooms behind it.
    assert (found[kind == Kind.OBJECT] < facade[kind == Kind.OBJECT] + 1e-3).all()
    behind = kind == Kind.BEHIND_GLASS
    assert is_wall[behind].mean() > 0.95
    assert (found[behind] > facade[behind] + 0.05).mean() > 0.95
    low = kind == Kind.GROUND
    points = origins[low] + found[low, None] * directions[low]
    np.testing.assert_allclose(points[:, 2], 0.0, atol=0.01)


def test_shut_glass_answers_nothing(street: MadeStreet) -> None:
    origins, directions = fan(street)
    open_, kind = street.meet(origins, directions, np.ones(len(origins), dtype=bool))
    shut, _ = street.meet(origins, directions, np.zeros(len(origins), dtype=bool))
    slanted = np.abs(directions[:, 2]) > 0.1  # a level beam comes back from the pane itself
    assert np.isinf(shut[(kind == Kind.BEHIND_GLASS) & slanted]).all()
    both = np.isfinite(shut) & np.isfinite(open_)
    np.testing.assert_array_equal(shut[both], open_[both])
    assert both[kind == Kind.WALL].mean() > 0.99


def test_a_beam_is_as_wide_as_asked() -> None:
    random = np.random.default_rng(1)
    directions = random.normal(size=(50, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    rays = spread(directions, 0.015)
    away = np.arccos(np.clip((rays * directions[:, None]).sum(axis=2), -1.0, 1.0))
    assert away.max() <= 0.0075
    np.testing.assert_allclose(away[:, 1:], away[:, 1:].mean(), rtol=1e-3)
    np.testing.assert_allclose(rays.mean(axis=1), directions, atol=1e-4)


def test_near_echoes_melt_and_far_ones_do_not() -> None:
    inf = np.inf
    distances = np.array([
        [10.0, 10.0, 10.0, 10.4, 10.4, 10.4, 10.4],  # within a pulse: between both
        [5.0, 5.0, 5.0, 5.0, 11.0, 11.0, 11.0],  # apart: the stronger one
        [5.0, 11.0, 11.0, 11.0, 11.0, 11.0, 11.0],
        [5.0, inf, inf, inf, inf, inf, inf],  # too little of the beam
        [inf] * 7,
    ])  # fmt: skip
    kinds = np.where(distances < 10.2, Kind.OBJECT, Kind.WALL).astype(np.uint8)
    found, kind = mixed(distances, kinds)
    assert 10.0 < found[0] < 10.4
    assert PULSE_M > 0.4
    np.testing.assert_allclose(found[1:3], [5.0, 11.0])
    assert np.isinf(found[3:]).all()
    np.testing.assert_array_equal(kind[1:], [Kind.OBJECT, Kind.WALL, Kind.NOTHING, Kind.NOTHING])


def test_points_float_at_edges_with_wide_beams_only(street: MadeStreet) -> None:
    """Between the hedge's top and what is behind it, thin rays see nothing."""
    own = {}
    for name, truck in (("wide", PAPER), ("thin", TruckOptions())):
        scans = scan_street(street, TruckOptions(**{**vars(truck), "sigma_m": 0.0}), 2)
        found, _ = street.meet(*_rays(scans), np.ones(scans.ranges.size, dtype=bool))
        apart = np.abs(scans.ranges.ravel() - found)
        solid = (scans.kind.ravel() != Kind.NOTHING) & np.isfinite(found)
        solid &= scans.kind.ravel() != Kind.BEHIND_GLASS
        own[name] = float(((apart > 0.05) & (apart < PULSE_M) & solid).mean())
    assert own["thin"] == 0.0
    assert own["wide"] > 0.002


def _rays(scans) -> tuple[Floats, Floats]:  # type: ignore[no-untyped-def]
    poses, angles = scans.world_from_vehicle, scans.angles_rad
    level = poses[:, None, :, 1] * np.cos(angles)[None, :, None]
    beams = level + np.array([0.0, 0.0, 1.0]) * np.sin(angles)[None, :, None]
    origins = np.broadcast_to(poses[:, None, :, 3] + [0.0, 0.0, 3.6], beams.shape)
    return origins.reshape(-1, 3), beams.reshape(-1, 3)


def test_fronts_follow_the_bend() -> None:
    way = Way(radius_m=50.0, period_m=100.0)
    options = MadeStreetOptions(length_m=LENGTH_M, way=way, steps_m=0.0, trees=0.0, gaps=0.0)
    street = make_street(options, 3, same_house)
    frames = way.frames(np.arange(2.0, 28.0, 1.0))
    origins = frames[:, :, 3] + [0.0, 0.0, 5.5]
    found, is_wall = street.facade(origins, frames[:, :, 1])
    assert is_wall.all()
    # A front is a chord: a house of 18 m strays by w^2 / 8 r from the bend, balconies by a metre.
    assert np.abs(found - options.front_m).max() < 1.8


def test_photographs_show_what_rays_meet(street: MadeStreet) -> None:
    """Where rays through pixels meet things, the image is hidden; elsewhere it is the bare one."""
    camera = StreetCamera(width_px=96, height_px=72, focal_px=47.0, noise=0.0, exposure=0.0)
    pose = poses_at(np.array([15.0]), TruckOptions())[0]
    photo = photograph_made(street, camera, pose, overcast(1), np.random.default_rng(1))
    world_from_cam = camera.world_from_cam(pose)
    y, x = np.indices((72, 96)) + 0.5
    local = np.stack([(x - 48.0) / 47.0, (y - 36.0) / 47.0, np.ones_like(x)], axis=2)
    rays = (local @ world_from_cam[:, :3].T).reshape(-1, 3)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    origins = np.broadcast_to(world_from_cam[:, 3], rays.shape)
    facade, is_wall = street.facade(origins, rays)
    met, kind = street.meet(origins, rays, np.zeros(len(rays), dtype=bool))
    thing = (kind == Kind.OBJECT) & (met < facade - 0.2)
    assert thing.sum() > 300
    assert photo.before.ravel()[thing].mean() > 0.98
    wall = is_wall & np.isfinite(facade)
    assert (photo.front.ravel() == wall).mean() > 0.98
    apart = np.abs(photo.pixels.astype(int) - photo.behind).max(axis=2)
    assert np.median(apart[photo.before]) > 15
    # Things darken what is right beside them.
    assert np.median(apart[~photo.before]) <= 2


def test_a_surface_model_has_the_roofs_and_the_road(street: MadeStreet) -> None:
    heights, low = surface_of(street, 1.0, 4)
    assert np.isnan(heights).mean() == pytest.approx(0.02, abs=0.01)

    def around(x: float, y: float) -> float:
        column, row = int(x - low[0]), int(y - low[1])
        return float(np.nanmedian(heights[row - 1 : row + 2, column - 1 : column + 2]))

    top = float(derived_house(11).part.positions_m[:, 2].max())
    assert around(2.0, 15.0) == pytest.approx(0.0, abs=0.3)
    roofs = [around(-16.0, y) for y in (8.0, 15.0, 22.0)]
    assert 3.0 < max(roofs) <= top + 0.5
    # The hedge stands in it, too.
    assert np.nanmax(heights[:, int(-8.9 - low[0])]) > 1.0


def test_a_street_says_which_features_are_windows(street: MadeStreet) -> None:
    """Textures ask for the windows that a house has."""
    assert street.bare_codes.shape == street.bare_kinds.shape
    windows = street.bare_codes == SemanticClass.WINDOW.code
    assert windows.sum() > 20
    assert (street.bare_kinds[windows] == Kind.WALL).all()
