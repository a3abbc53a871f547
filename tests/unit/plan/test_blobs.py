"""What is too thick for a wall is none: chimney breasts, cars; the wall behind goes on."""

from __future__ import annotations

import numpy as np

from veduta.plan.openings.leaf_pieces import free_leaves
from veduta.plan.walls.blobs import without_blobs
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness

WALLS = Thickness(5.0, 10.0)


def page() -> np.ndarray:
    """Walls of 10 px around 400 x 300 px, and one across."""
    solid = np.zeros((400, 500), dtype=bool)
    solid[40:50, 40:450] = solid[340:350, 40:450] = True
    solid[40:350, 40:50] = solid[40:350, 440:450] = True
    solid[40:350, 240:250] = True
    return solid


def test_walls_alone_stay_as_they_are() -> None:
    assert (without_blobs(page(), WALLS) == page()).all()


def test_a_wall_goes_on_behind_a_chimney_breast() -> None:
    walls = page()
    with_chimney = walls.copy()
    with_chimney[150:260, 40:80] = True
    found = without_blobs(with_chimney, WALLS)
    # But for the breast's rim, the mask is that of the walls.
    assert (found & ~walls).sum() < 0.1 * (with_chimney & ~walls).sum()
    assert (walls & ~found).sum() < 0.01 * walls.sum()


def test_a_car_is_no_wall() -> None:
    walls = page()
    car = walls.copy()
    car[100:220, 120:170] = True
    assert (without_blobs(car, WALLS) == walls).all()


def test_a_thick_long_wall_stays() -> None:
    walls = page()
    walls[340:370, 40:450] = True
    assert (without_blobs(walls, WALLS) == walls).all()


def piece(start: tuple[float, float], end: tuple[float, float]) -> Piece:
    return Piece(np.array(start), np.array(end), 8.0, "filled")


def test_a_slanted_stroke_that_hangs_on_a_wall_is_a_leaf() -> None:
    walls = [piece((0, 0), (400, 0)), piece((0, 0), (0, 300))]
    leaf, bay = piece((100, 4), (150, 54)), [piece((300, 0), (340, 40)), piece((340, 40), (380, 0))]
    assert free_leaves([*walls, leaf], 8.0, 75.0) == {2}
    # Sides of a bay hang on something at both ends, and upright stubs are walls.
    assert free_leaves([*walls, *bay], 8.0, 60.0) == set()
    assert free_leaves([*walls, piece((200, 0), (200, 70))], 8.0, 75.0) == set()


def test_a_leaf_that_begins_thinner_than_walls_points_at_the_wall_it_hangs_on() -> None:
    """Its thick half stands free, 40 px from the end of the wall and 100 px from all others."""
    walls = [piece((0, 0), (200, 0)), piece((275, 0), (500, 0))]
    half = piece((228, 28), (256, 56))
    assert free_leaves([*walls, half], 8.0, 75.0) == {2}
    elsewhere = piece((328, 128), (356, 156))
    assert free_leaves([*walls, elsewhere], 8.0, 75.0) == set()
