"""Tiles in photos of rooms whose sizes, colours and cameras are known."""

from __future__ import annotations

import time

import cv2
import numpy as np
import pytest
from room_photo import RoomScene, Tiled, pixel_of, room_photo

from veduta.geometry import homography
from veduta.plan.photos.lattice import find_lattices
from veduta.plan.photos.plane import plane_of
from veduta.plan.photos.rectangles import Rectangles, find_rectangles
from veduta.plan.photos.texture import evenly_lit
from veduta.plan.photos.tiles import Looked, TilesSeen, find_tiles

WIDTH, HEIGHT = 600, 450
ROOM_M = 20.0**0.5
BLUE = (110, 150, 185)


def look(scene: RoomScene) -> Looked:
    """What is found in a photo of the scene, with the focal length that EXIF would give."""
    return find_tiles(room_photo(scene, WIDTH, HEIGHT), scene.focal * WIDTH, ROOM_M)


def only(found: Looked, surface: str) -> TilesSeen:
    (tiles,) = [one for one in found.tiles if one.surface == surface]
    return tiles


def corners_off_joints(scene: RoomScene, tiles: TilesSeen, size_m: tuple[float, float]) -> float:
    """How far (pixels) the corners of the block are from the nearest crossing of joints."""
    across, along = np.meshgrid(
        np.arange(0.0, scene.room_m[0] + 1e-6, size_m[0]),
        np.arange(0.9, scene.room_m[1] + 1e-6, size_m[1]),
    )
    crossings = np.array(
        [
            pixel_of(scene, np.array([x, y, 0.0]), WIDTH, HEIGHT)
            for x, y in zip(across.ravel(), along.ravel(), strict=True)
        ]
    )
    apart = np.linalg.norm(tiles.corners_px[:, None] - crossings, axis=2)
    return float(apart.min(axis=1).max())


@pytest.mark.parametrize(
    ("origin", "axes", "pitch", "surface", "away_m"),
    [
        ((2.0, 3.0, 0.0), ((1, 0, 0), (0, -1, 0)), 0.3, "floor", 1.5),
        ((2.0, 2.0, 0.0), ((1, 0, 0), (0, -1, 0)), 1.0, "floor", 1.5),
        ((2.0, 5.0, 1.5), ((1, 0, 0), (0, 0, -1)), 0.3, "wall", 4.6),
        ((2.0, 5.0, 1.5), ((1, 0, 0), (0, 0, -1)), -0.4, "wall", 4.6),
        ((0.0, 3.0, 1.5), ((0, 1, 0), (0, 0, -1)), 0.1, "wall", 2.2),
        ((2.0, 3.0, 2.6), ((1, 0, 0), (0, 1, 0)), -0.3, "ceiling", 1.1),
    ],
)
def test_a_plane_is_told_by_its_homography(
    origin: tuple[float, ...],
    axes: tuple[tuple[int, ...], ...],
    pitch: float,
    surface: str,
    away_m: float,
) -> None:
    size = np.array([0.4, 0.2])
    scene = RoomScene(pitch_rad=pitch, yaw_rad=0.25)
    tiles = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    points = np.array(origin) + (tiles * size) @ np.array(axes, dtype=float)
    seen = np.array([pixel_of(scene, point, WIDTH, HEIGHT) for point in points])
    matrix = homography.from_points(tiles, seen)
    plane = plane_of(matrix, (WIDTH, HEIGHT), scene.focal * WIDTH)
    assert plane.surface == surface
    assert plane.shape == pytest.approx(2.0, rel=1e-6)
    assert plane.distance * size[0] == pytest.approx(away_m, rel=1e-6)


@pytest.mark.parametrize("size_m", [(0.30, 0.30), (0.60, 0.30)])
def test_floor_tiles_are_found_in_perspective(size_m: tuple[float, float]) -> None:
    scene = RoomScene(floor_tiles=Tiled(size_m, joint_m=0.008))
    tiles = only(look(scene), "floor")
    assert len(tiles.lattice) >= 15
    assert corners_off_joints(scene, tiles, size_m) < 1.5
    # x of the texture may run along either side of the tile.
    assert sorted(tiles.size_m) == sorted(size_m)
    shape = size_m[0] / size_m[1]
    assert (
        min(abs(np.log(tiles.plane.shape / shape)), abs(np.log(tiles.plane.shape * shape))) < 0.03
    )
    # The camera is 1.5 m above the floor: the lattice says so in widths of a tile.
    assert tiles.plane.distance * tiles.size_m[0] == pytest.approx(1.5, rel=0.04)


def test_the_texture_is_whole_tiles_of_their_colour_that_continue_themselves() -> None:
    tiled = Tiled((0.30, 0.30), joint_m=0.012, spread=0.0)
    tiles = only(look(RoomScene(floor_tiles=tiled)), "floor")
    height, width = tiles.texture.shape[:2]
    columns, rows = tiles.block.tiles
    assert width / columns == pytest.approx(height / rows, rel=0.03)
    side = width // columns
    inner = tiles.texture[side // 4 : side // 2, side // 4 : side // 2].mean(axis=(0, 1))
    # As bright as it is there, 2 to 3 m away (the scene dims by 1.2 % a metre), and no joint.
    assert np.abs(inner - np.array(tiled.tile)).max() < 8
    # Joints lie on the edges, in the middle of which the texture is cut.
    lines = tiles.texture.mean(axis=(1, 2))
    assert lines[[0, -1]].min() < lines[side // 4 : side // 2].mean() - 6


def test_a_bond_is_found_and_its_block_has_two_rows() -> None:
    tiled = Tiled((0.30, 0.15), joint_m=0.01, tile=BLUE, joint=(235, 235, 230), bond=0.5)
    tiles = only(look(RoomScene(wall_tiles=tiled, pitch_rad=0.05, boxes_m=())), "wall")
    assert tiles.lattice.bond == "rows"
    assert tiles.block.tiles[1] % 2 == 0
    assert tiles.plane.shape == pytest.approx(2.0, rel=0.04)


def test_floor_and_wall_are_told_apart_in_one_photo() -> None:
    wall = Tiled((0.20, 0.20), joint_m=0.008, tile=BLUE, joint=(235, 235, 230))
    floor = Tiled((0.60, 0.30), joint_m=0.008)
    found = look(RoomScene(wall_tiles=wall, floor_tiles=floor))
    assert {one.surface for one in found.tiles} == {"floor", "wall"}
    inner = only(found, "wall").texture.reshape(-1, 3)
    assert np.abs(np.median(inner, axis=0) - np.array(BLUE)).max() < 14


def test_a_room_without_tiles_has_none() -> None:
    found = look(RoomScene())
    assert found.tiles == ()


def test_five_thousand_tiles_are_found_in_a_moment() -> None:
    """Each has its neighbours looked at, not all others: that took a minute."""
    count = 70
    at = np.stack(np.meshgrid(np.arange(count), np.arange(count)), axis=-1).reshape(-1, 1, 2)
    tile = np.array([[0.05, 0.05], [0.95, 0.05], [0.95, 0.95], [0.05, 0.95]])
    flat = (at + tile) * 2.0 / count - 1.0
    matrix = np.array([[600.0, 0.0, 700.0], [0.0, 600.0, 700.0], [0.0, 0.2, 1.0]])
    seen = homography.apply(matrix, flat.reshape(-1, 2)).reshape(-1, 4, 2)
    seen += np.random.default_rng(0).normal(0.0, 0.05, seen.shape)
    areas = np.array([cv2.contourArea(one.astype(np.float32)) for one in seen])
    begun = time.process_time()
    (found,) = find_lattices(Rectangles(seen, areas))
    assert time.process_time() - begun < 10.0
    assert len(found) == count**2
    # Whichever corner and cell it began with, tile (0, 0) of one is a whole tile of the other.
    side = 2.0 / count
    ours = homography.apply(
        homography.inverse(matrix) @ found.photo_from_tiles, (found.cells + 0.5).astype(float)
    )
    cells = (ours + 1.0) / side - 0.5
    assert np.abs(cells - cells.round()).max() < 0.05
    assert len(np.unique(cells.round(), axis=0)) == count**2


def test_a_row_of_doors_is_no_tiling() -> None:
    pixels = np.full((300, 400, 3), 230, dtype=np.uint8)
    for x in range(20, 380, 60):
        pixels[60:200, x : x + 50] = (120, 90, 70)
    assert len(find_rectangles(pixels)) >= 6
    assert find_tiles(pixels, None, ROOM_M).tiles == ()


@pytest.mark.parametrize("shape", [(1, 1), (2, 300), (40, 3)])
def test_tiny_photos_have_none(shape: tuple[int, int]) -> None:
    pixels = np.full((*shape, 3), 128, dtype=np.uint8)
    assert find_tiles(pixels, None, ROOM_M).tiles == ()


def test_a_gradient_of_light_is_taken_out() -> None:
    ramp = np.linspace(0.7, 1.3, 80)[None, :, None] * np.linspace(0.9, 1.1, 60)[:, None, None]
    lit = (150.0 * np.repeat(ramp, 3, axis=2)).round().astype(np.uint8)
    even = evenly_lit(lit)
    assert np.ptp(lit.astype(int)) > 80
    assert np.ptp(even.astype(int)) < 18


def test_rectangles_have_the_corners_that_were_drawn() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    quad = np.array([[60.0, 50.0], [180.0, 62.0], [168.0, 150.0], [72.0, 138.0]])
    photo_from_unit = homography.from_points(square, quad)
    y, x = np.mgrid[0:200, 0:240] + 0.5
    unit = homography.apply(
        homography.inverse(photo_from_unit), np.stack([x, y], -1).reshape(-1, 2)
    )
    inside = ((unit > 0) & (unit < 1)).all(axis=1).reshape(200, 240)
    pixels = np.where(inside[..., None], (60, 120, 200), (220, 215, 210)).astype(np.uint8)
    found = find_rectangles(pixels)
    off = np.linalg.norm(found.corners_px - quad, axis=2).max(axis=1)
    # The contour has a width, within which the area ends.
    assert off.min() < 4.5
