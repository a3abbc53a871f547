"""The steps of texturing against closed forms and brute force."""

from __future__ import annotations

import itertools

import cv2
import numpy as np
import pytest
from painted_wall import box_part, city_of, south
from scipy.ndimage import minimum_filter

from veduta import _core
from veduta.photos.cameras.orient import moved_poses
from veduta.photos.choosing import median_of
from veduta.photos.straight import Pinhole
from veduta.photos.texture.atlas import GUTTER, filled, packed
from veduta.photos.texture.cells import SAMPLES, Grid, Sights
from veduta.photos.texture.choice import Choice
from veduta.photos.texture.faces import faces_of
from veduta.photos.texture.files import file_names
from veduta.photos.texture.levels import LightSamples
from veduta.photos.texture.seams import offsets_of
from veduta.photos.texture.views import (
    Blockers,
    PlaneView,
    View,
    density,
    plane_view,
    seen_at,
    warped,
)
from veduta.photos.world.georeference import Similarity
from veduta.synthetic.camera import look_at


def view_at(
    eye: tuple[float, float, float], target: tuple[float, float, float], focal: float = 500.0
) -> View:
    camera = look_at(eye, target, (640, 480), focal)
    pinhole = Pinhole(640, 480, (focal, focal), camera.centre_px)
    pixels = np.zeros((480, 640, 3), dtype=np.uint8)
    return View("view", pinhole, camera.cam_from_world[:3], lambda: pixels)


def test_faces_join_what_lies_in_one_plane_and_leave_the_ground_out() -> None:
    faces = faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3))))
    assert len(faces) == 5
    front = south(faces)
    assert sorted(front.polygons.tolist()) == [0, 1]
    assert front.size_m == pytest.approx((6.0, 3.0))
    assert front.area_m2 == pytest.approx(18.0)
    np.testing.assert_allclose(front.corner, [0.0, 0.0, 3.0], atol=1e-9)
    np.testing.assert_allclose(front.right, [1.0, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(front.down, [0.0, 0.0, -1.0], atol=1e-9)
    for face in faces:
        np.testing.assert_allclose(np.cross(face.down, face.right), face.normal, atol=1e-9)


def test_a_plane_is_projected_as_its_points_are() -> None:
    face = south(faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3)))))
    view = view_at((1.0, -8.0, 1.7), (4.0, 0.0, 1.0))
    plane = plane_view(view, face)
    assert plane is not None
    places = np.random.default_rng(0).uniform(0, 1, (50, 2)) * face.size_m
    local = face.points(places) @ view.cam_from_world[:, :3].T + view.cam_from_world[:, 3]
    pixels = local @ view.intrinsics.T
    mapped = np.column_stack([places, np.ones(50)]) @ plane.matrix.T
    np.testing.assert_allclose(mapped, pixels, atol=1e-9)
    at = np.column_stack([pixels[:, :2] / pixels[:, 2:], np.ones(50)])
    np.testing.assert_allclose(at @ plane.inverse, 1.0 / local[:, 2], rtol=1e-9)


def test_density_is_the_area_that_a_small_square_has_in_the_picture() -> None:
    face = south(faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3)))))
    view = view_at((1.0, -8.0, 1.7), (4.0, 0.0, 1.0))
    plane = plane_view(view, face)
    assert plane is not None
    found = density(plane, view, (3, 6), 1.0)
    for row, column in itertools.product(range(3), range(6)):
        x, y, half = column + 0.5, row + 0.5, 0.005
        square = np.array([[x - half, y - half], [x + half, y - half], [x + half, y + half]])
        square = np.vstack([square, [[x - half, y + half]]])
        mapped = np.column_stack([square, np.ones(4)]) @ plane.matrix.T
        area = cv2.contourArea((mapped[:, :2] / mapped[:, 2:]).astype(np.float32))
        assert found[row, column] == pytest.approx(area / (2 * half) ** 2, rel=0.02)


def test_what_stands_before_a_wall_hides_it_as_rays_say() -> None:
    """A box before the wall: all places well inside or outside of its shadow are told apart."""
    wall, block = box_part("wall", (0, 0, 0), (6, 4, 3)), box_part("block", (2, -3, 0), (3, -2, 2))
    city = city_of(wall, block)
    face = south(faces_of(city_of(wall)))
    view = view_at((1.0, -8.0, 1.7), (3.0, 0.0, 1.0))
    plane = plane_view(view, face)
    assert plane is not None
    shape, pitch = (60, 120), 0.05
    seen = seen_at(view, plane, Blockers(city).nearness(view), None, None, shape, pitch)
    x, y = np.meshgrid((np.arange(120) + 0.5) * pitch, (np.arange(60) + 0.5) * pitch)
    points = face.points(np.column_stack([x.ravel(), y.ravel()]))
    ways = points - view.eye
    # The slabs of the block along each way (Kay and Kajiya).
    with np.errstate(divide="ignore"):
        ends = (np.array([[2, -3, 0], [3, -2, 2]])[:, None] - view.eye) / ways
    hit = (ends.min(axis=0).max(axis=1) <= ends.max(axis=0).min(axis=1)).reshape(shape)
    wide = np.ones((7, 7))
    open_ = minimum_filter((~hit).astype(np.uint8), footprint=wide, mode="nearest") > 0
    hidden = minimum_filter(hit.astype(np.uint8), footprint=wide, mode="nearest") > 0
    inside = (x > 0.2) & (x < 5.8) & (y > 0.2) & (y < 2.8)
    assert hidden.sum() > 100
    assert not seen[hit].any()
    assert seen[open_ & inside].all()


def test_a_face_seen_from_behind_has_no_view() -> None:
    face = south(faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3)))))
    assert plane_view(view_at((1.0, 9.0, 1.7), (4.0, 0.0, 1.0)), face) is None
    assert plane_view(view_at((1.0, -9.0, 1.7), (4.0, -20.0, 1.0)), face) is None


def test_a_square_of_the_plane_takes_the_colour_of_its_pixel() -> None:
    """Pixels that are 0.1 m apart on the plane, squares of the same size: the picture itself."""
    pixels = np.random.default_rng(1).integers(0, 255, (20, 30, 3)).astype(np.uint8)
    plane = PlaneView(np.array([[10.0, 0, 0], [0, 10.0, 0], [0, 0, 1.0]]), np.zeros(3))
    np.testing.assert_array_equal(warped(pixels, plane, 0, (20, 30), 0.1), pixels)


def flat_sights(colours: np.ndarray, views: list[int]) -> Sights:
    """A face whose views show (k, rows, columns, 3) sRGB, all of it."""
    k, rows, columns, _ = colours.shape
    fine = colours.repeat(SAMPLES, axis=1).repeat(SAMPLES, axis=2).astype(np.uint8)
    face = south(faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3)))))
    plane = PlaneView(np.eye(3), np.zeros(3))
    ones = np.ones((k, rows, columns), dtype=np.float32)
    grid = Grid(rows, columns, 0.25)
    seen = np.ones(fine.shape[:3], dtype=np.bool_)
    return Sights(face, grid, np.array(views), (plane,) * k, fine, seen, 1e4 * ones, ones)


def test_gains_take_back_known_exposures_despite_a_car() -> None:
    """Photos 0-1-2 overlap in a chain; a tenth of the cells of one shows something else."""
    rng = np.random.default_rng(3)
    wall = rng.uniform(0.05, 0.4, (2, 8, 20, 3))
    truth = np.array([[1.0, 1.0, 1.0], [1.4, 1.3, 1.5], [0.7, 0.75, 0.7], [1.0, 1.0, 1.0]])
    faces = []
    for part, (first, second) in zip(wall, ((0, 1), (1, 2)), strict=True):
        light = np.stack([part * truth[first], part * truth[second]])
        light[0, :2, :8] = 0.02
        srgb = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
        faces.append(flat_sights(np.round(255 * srgb), [first, second]))
    samples = LightSamples(4, len(faces))
    for sights in faces:
        samples.add(sights)
    found = samples.gains()
    ratio = found[:3] * truth[:3]
    np.testing.assert_allclose(ratio / ratio[0], 1.0, rtol=0.03)
    np.testing.assert_allclose(found[3], 1.0)
    np.testing.assert_allclose(np.log(found[:3]).mean(axis=0), 0.0, atol=1e-6)


def test_median_leaves_out_what_is_unseen() -> None:
    values = np.random.default_rng(4).normal(size=(5, 6, 7)).astype(np.float32)
    values[np.random.default_rng(5).random(values.shape) < 0.3] = np.nan
    values[:, 0, 0] = np.nan
    with np.errstate(all="ignore"), pytest.warns(RuntimeWarning):
        wanted = np.nanmedian(values, axis=0)
    np.testing.assert_allclose(median_of(values), wanted, rtol=1e-6)


def test_offsets_make_a_step_between_patches_agree() -> None:
    """Two patches that differ by 0.1: a tenth is left at the seam, and no new edge."""
    colours = np.full((2, 6, 20, 3), 0.4, dtype=np.float32)
    colours[1] = 0.5
    label = np.zeros((6, 20), dtype=np.int64)
    label[:, 10:] = 1
    usable = np.ones((2, 6, 20), dtype=np.bool_)
    seen = np.ones((2, 6 * SAMPLES, 20 * SAMPLES), dtype=np.bool_)
    order = np.stack([label, 1 - label])
    offsets = offsets_of(colours, Choice(label, order, usable, seen))
    levelled = np.take_along_axis(colours, label[None, ..., None], axis=0)[0] + offsets
    steps = np.abs(np.diff(levelled, axis=1))
    assert steps.max() < 0.012
    assert abs(float(offsets.mean())) < 0.005


def test_labels_are_the_cheapest_where_views_agree() -> None:
    """Views of the same colours: a seam costs its length alone; brute force over small grids."""
    rng = np.random.default_rng(6)
    for _ in range(5):
        costs = rng.random((6, 2)).astype(np.float32)
        colours = np.full((6, 6), 0.5, dtype=np.float32)
        found = _core.label_cells(
            costs, colours, (2, 3), base=0.1, slope=1.0, most=1.0, rounds=20
        ).ravel()

        def energy(labels: tuple[int, ...], costs: np.ndarray = costs) -> float:
            grid = np.array(labels).reshape(2, 3)
            seams = (grid[:, 1:] != grid[:, :-1]).sum() + (grid[1:] != grid[:-1]).sum()
            return float(costs[np.arange(6), grid.ravel()].sum() + 0.1 * seams)

        best = min(energy(labels) for labels in itertools.product(range(2), repeat=6))
        assert energy(tuple(found.tolist())) == pytest.approx(best, abs=1e-5)
    with pytest.raises(_core.LabelFault):
        _core.label_cells(costs, colours, (2, 2), base=0.1, slope=1.0, most=1.0, rounds=1)


def test_rectangles_lie_apart_and_inside() -> None:
    rng = np.random.default_rng(7)
    sizes = [tuple(size) for size in rng.integers(3, 120, (60, 2)).tolist()]
    packing = packed(sizes, 256)
    images = [
        np.full((height, width), 1 + number % 200, np.uint8)
        for number, (width, height) in enumerate(sizes)
    ]
    counts = [np.zeros((height, width), int) for width, height in packing.sizes]
    for (width, height), spot in zip(sizes, packing.spots, strict=True):
        rows = slice(spot.y - GUTTER, spot.y + height + GUTTER)
        columns = slice(spot.x - GUTTER, spot.x + width + GUTTER)
        assert counts[spot.atlas][rows, columns].shape == (height + 2 * GUTTER, width + 2 * GUTTER)
        counts[spot.atlas][rows, columns] += 1
    assert max(count.max() for count in counts) == 1
    assert all(max(size) <= 256 for size in packing.sizes)
    atlases = filled(packing, images, 0)
    for image, spot in zip(images, packing.spots, strict=True):
        height, width = image.shape
        own = atlases[spot.atlas][spot.y : spot.y + height, spot.x : spot.x + width]
        np.testing.assert_array_equal(own, image)
    with pytest.raises(ValueError, match="larger"):
        packed([(300, 10)], 256)


def test_a_pose_moves_with_its_world() -> None:
    rng = np.random.default_rng(8)
    turn = cv2.Rodrigues(np.array([0.1, -0.2, 0.7]))[0]
    pose = np.column_stack([cv2.Rodrigues(np.array([1.0, 0.4, 0.1]))[0], [0.3, -1.0, 2.0]])
    world = Similarity(2.5, turn, np.array([10.0, -4.0, 1.0]))
    points = rng.normal(size=(9, 3))
    own = points @ pose[:, :3].T + pose[:, 3]
    moved = moved_poses(pose[None], world.scale, world.rotation, world.shift)[0]
    there = world.moved(points) @ moved[:, :3].T + moved[:, 3]
    np.testing.assert_allclose(there, 2.5 * own, atol=1e-9)


def test_names_of_files_differ_on_every_system() -> None:
    names = file_names(["a/b", "a b", "A-B", "", "..", "x" * 300])
    assert len({name.lower() for name in names}) == 6
    assert all(name and "/" not in name and len(name) <= 70 for name in names)
