"""Rendering against closed forms: depth of a plane, shadows, texture, light and mirrors."""

from __future__ import annotations

import numpy as np
from small_part import part_of

from veduta.place.material import Texture
from veduta.synthetic.camera import look_at
from veduta.synthetic.light import Light, daylight
from veduta.synthetic.render import measure, render
from veduta.synthetic.scene import RayScene

WALL = ((-50.0, 0.0, -50.0), (100.0, 0.0, 0.0), (0.0, 0.0, 100.0))
SIZE = (120, 90)


def sun(azimuth_rad: float, elevation_rad: float) -> Light:
    return daylight(0, True, azimuth_rad, elevation_rad)


def test_depth_of_a_plane_is_its_closed_form() -> None:
    camera = look_at((1.0, -7.0, 2.0), (3.0, 0.0, 4.0), SIZE, 110.0, 0.1)
    seen = measure(RayScene([(part_of([WALL]), np.eye(4))]), camera)
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    rays = camera.rays(np.stack([x.ravel(), y.ravel()], axis=1))
    expected = (7.0 / rays[:, 1]).reshape(SIZE[1], SIZE[0])
    np.testing.assert_allclose(seen.depth_m, expected, rtol=1e-5)
    assert (seen.feature == 0).all()


def test_what_misses_everything_is_sky() -> None:
    camera = look_at((0, -5, 0), (0, -6, 0), SIZE, 100.0)
    seen = measure(RayScene([(part_of([WALL]), np.eye(4))]), camera)
    assert (seen.feature == -1).all()
    assert np.isnan(seen.depth_m).all()


def test_features_count_through_placed_parts_and_the_nearer_one_is_seen() -> None:
    small = part_of([((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((2, 0, 0), (1, 0, 0), (0, 0, 1))])
    nearer = np.eye(4)
    nearer[:3, 3] = [0.0, -1.0, 0.0]
    scene = RayScene([(small, np.eye(4)), (small, nearer)])
    camera = look_at((1.5, -20, 0.5), (1.5, 0, 0.5), (200, 100), 600.0)
    seen = measure(scene, camera)
    centres, _ = camera.project(np.array([[0.5, -1, 0.5], [2.5, -1, 0.5], [1.5, -1, 0.5]]))
    at = [seen.feature[int(y), int(x)] for x, y in centres]
    assert at == [2, 3, -1]
    assert scene.first_feature == [0, 2]


def test_a_shadow_falls_away_from_the_sun() -> None:
    """A slab sticks out of the wall; with the sun up and to the left, its shadow is below right."""
    slab = ((-0.5, -1.0, 2.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    scene = RayScene([(part_of([WALL, slab]), np.eye(4))])
    camera = look_at((0, -12, 1), (0, 0, 1), (240, 240), 400.0)
    azimuth, elevation = np.deg2rad(225.0), np.deg2rad(45.0)
    light = sun(azimuth, elevation)
    picture = render(scene, camera, light, samples=2).mean(axis=2)
    # The slab's front edge is 1 m out: its shadow is shifted by the sun's slope per metre of y.
    x, y, z = light.sun_from
    right, down = x / y, z / -y
    dark, lit = (0.0 + right, 2.0 - down + 0.1), (0.0 - right, 2.0 - down + 0.1)
    pixels, _ = camera.project(np.array([[dark[0], 0, dark[1]], [lit[0], 0, lit[1]]]))
    values = [picture[int(v), int(u)] for u, v in pixels]
    assert right > 0.9
    assert values[0] < 0.5 * values[1]


def test_without_sun_nothing_casts_a_sharp_shadow() -> None:
    slab = ((-0.5, -1.0, 2.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    scene = RayScene([(part_of([WALL, slab]), np.eye(4))])
    camera = look_at((0, -12, 1), (0, 0, 1), (120, 120), 200.0)
    picture = render(scene, camera, daylight(0, False, 4.0, 0.8), samples=2).mean(axis=2)
    pixels, _ = camera.project(np.array([[1.0, 0, 0.6], [-1.0, 0, 0.6]]))
    values = [picture[int(v), int(u)] for u, v in pixels]
    np.testing.assert_allclose(values[0], values[1], rtol=0.15)


def test_sunlight_follows_the_cosine_law() -> None:
    scene = RayScene([(part_of([WALL]), np.eye(4))])
    camera = look_at((0, -5, 0), (0, 0, 0), (32, 32), 64.0)
    values = []
    for elevation in np.deg2rad([10.0, 60.0]):
        light = sun(-np.pi / 2, float(elevation))
        dark = Light(light.sun_from, (0, 0, 0), light.sky, light.bounce, light.clouds, False,
                     light.skyline_rad)  # fmt: skip
        lit = render(scene, camera, light) - render(scene, camera, dark)
        values.append(float(lit.mean()))
    expected = np.cos(np.deg2rad(60)) / np.cos(np.deg2rad(10))
    np.testing.assert_allclose(values[1] / values[0], expected, rtol=0.02)


def test_a_texture_is_the_right_way_round() -> None:
    """UV (0, 0) is the upper left: four colours land in the four corners of the wall."""
    colours = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    pixels = np.repeat(np.repeat(colours, 8, axis=0), 8, axis=1)
    texture = Texture(pixels, np.zeros((16, 16), np.bool_))
    quad = ((-1.0, 0.0, -1.0), (2.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    scene = RayScene([(part_of([quad], texture), np.eye(4))])
    camera = look_at((0, -10, 0), (0, 0, 0), (64, 64), 300.0)
    picture = render(scene, camera, daylight(0, False, 4.0, 0.8))
    found = [picture[y, x] > 0.1 for y, x in ((8, 8), (8, 56), (56, 8), (56, 56))]
    assert [list(f) for f in found] == [
        [True, False, False], [False, True, False], [False, False, True], [True, True, True],
    ]  # fmt: skip


def test_glass_mirrors_and_plaster_does_not() -> None:
    camera = look_at((0, -5, 0), (0, 0, 3.5), (48, 48), 100.0)
    light = daylight(0, False, 4.0, 0.8)
    matt = render(RayScene([(part_of([WALL], colour=(0, 0, 0)), np.eye(4))]), camera, light)
    glass = render(
        RayScene([(part_of([WALL], colour=(0, 0, 0), roughness=0.0), np.eye(4))]), camera, light
    )
    assert matt.max() == 0.0
    assert glass.mean() > 0.05


def test_the_same_seed_gives_the_same_picture_on_any_number_of_threads() -> None:
    scene = RayScene([(part_of([WALL]), np.eye(4))])
    camera = look_at((0, -5, 0), (0, 0, 0), (64, 200), 64.0)
    light = sun(4.0, 0.7)
    one, two = (render(scene, camera, light, seed=3, threads=n) for n in (1, 3))
    np.testing.assert_array_equal(one, two)
