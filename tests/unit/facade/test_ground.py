"""Ground floors that the test draws: shop fronts, doors, windows, and nothing but wall."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.appearance import wall_colour
from veduta.facade.boxes import Box
from veduta.facade.evidence import gather
from veduta.facade.floors import Floors
from veduta.facade.ground import read_ground
from veduta.facade.ground_chain import Gains, Kind, solve

STOREY = 70
GROUND_TOP = 230
HEIGHT, WIDTH = 320, 320

Rectangle = tuple[int, int, int, int, tuple[int, int, int]]


def _read(*rectangles: Rectangle) -> list[Box]:
    """Draw rectangles (x, y, width, height, sRGB) on a stone wall of three floors, and read it."""
    rng = np.random.default_rng(1)
    pixels = np.full((HEIGHT, WIDTH, 3), (200, 190, 170), np.float64)
    for x, y, w, h, colour in rectangles:
        pixels[y : y + h, x : x + w] = colour
    pixels += rng.normal(0, 3, pixels.shape)
    image = np.clip(pixels, 0, 255).astype(np.uint8)
    evidence = gather(image, np.ones(image.shape[:2], bool))
    boundaries = [GROUND_TOP - i * STOREY for i in (3, 2, 1, 0)]
    floors = Floors(boundaries, float(STOREY), 0.0, {}, 0)
    wall = wall_colour(evidence, floors.eaves, floors.ground_top, floors.mean_storey)
    return read_ground(evidence, floors, wall)


def _shop(x: int, width: int) -> list[Rectangle]:
    """A sign, and below it glass with goods in it."""
    goods = [
        (x + 6 * i, 262 + 8 * j, 4, 4, (220, 60, 40))
        for i, j in product(range(width // 6), range(6))
    ]
    top = GROUND_TOP + 6
    front = (x, top, width, HEIGHT - top, (40, 45, 50))
    return [front, (x, top, width, 14, (20, 90, 60)), *goods]


DOOR: Rectangle = (200, 250, 30, 70, (30, 45, 35))
WINDOW: Rectangle = (50, 248, 28, 34, (60, 70, 80))


def test_plain_wall_has_no_openings() -> None:
    assert _read() == []


def test_shop_and_door_are_told_apart() -> None:
    shop, door = _read(*_shop(20, 140), DOOR)
    assert (shop.kind, door.kind) == ("shop", "door")
    assert shop.x == pytest.approx(20, abs=3)
    assert shop.x + shop.width == pytest.approx(160, abs=3)
    assert shop.y == pytest.approx(GROUND_TOP + 6, abs=4)
    assert shop.y + shop.height == HEIGHT
    assert door.x == pytest.approx(200, abs=3)
    assert door.width == pytest.approx(30, abs=4)
    assert door.y == pytest.approx(250, abs=4)
    assert door.y + door.height == HEIGHT


def test_window_has_wall_below_it() -> None:
    window, door = _read(WINDOW, DOOR)
    assert (window.kind, door.kind) == ("window", "door")
    for value, wanted in zip(
        (window.x, window.y, window.width, window.height), WINDOW[:4], strict=True
    ):
        assert value == pytest.approx(wanted, abs=4)


def test_front_over_the_whole_width_is_a_shop() -> None:
    boxes = _read(*_shop(0, WIDTH))
    assert [(b.kind, b.x, b.width) for b in boxes] == [("shop", 0, WIDTH)]


def test_scores_are_shares_and_clear_things_score_high() -> None:
    boxes = _read(*_shop(20, 140), DOOR)
    assert all(0.8 < b.score <= 1.0 for b in boxes)


def test_same_image_gives_same_boxes() -> None:
    assert _read(*_shop(20, 140), DOOR) == _read(*_shop(20, 140), DOOR)


def _kind(name: str, widths: tuple[int, int], table: NDArray[np.float64]) -> Kind:
    def gains(starts: slice, end: int) -> Gains:
        gain = table[starts, end]
        zeros = np.zeros(len(gain), np.int64)
        return Gains(gain, zeros, zeros)

    return Kind(name, widths, gains)


Case = tuple[NDArray[np.float64], NDArray[np.float64], int, list[Kind]]


def _case(seed: int) -> tuple[Case, list[NDArray[np.float64]]]:
    rng = np.random.default_rng(seed)
    width = 9
    tables = [rng.normal(0, 2, (width + 1, width + 1)) for _ in range(2)]
    wall = np.concatenate([[0.0], np.cumsum(rng.normal(0, 1, width))])
    boundary = rng.normal(0, 0.5, width + 1)
    kinds = [_kind("a", (1, 4), tables[0]), _kind("b", (3, 9), tables[1])]
    return (wall, boundary, 2, kinds), tables


def _every_value(case: Case, at: int, wall_next: bool) -> float:
    """The greatest gain from pixel column `at` on, by trying every sequence."""
    wall, boundary, pier, kinds = case
    width = len(wall) - 1
    if at == width:
        return 0.0
    values = [-np.inf]
    change = boundary[at]
    if wall_next:
        values += [
            change + wall[end] - wall[at] + _every_value(case, end, False)
            for end in range(at + pier, width + 1)
        ]
    else:
        values += [
            change + kind.gains(slice(at, at + 1), end).gain[0] + _every_value(case, end, True)
            for kind in kinds
            for end in range(at + kind.widths[0], min(width, at + kind.widths[1]) + 1)
        ]
    return float(max(values))


@pytest.mark.parametrize("seed", range(20))
def test_chain_is_exact(seed: int) -> None:
    case, tables = _case(seed)
    wall, boundary, pier, kinds = case
    openings = solve(wall, boundary, pier, kinds)
    value, at = 0.0, 0
    for o in openings:
        if o.start > at:
            assert o.start - at >= pier
            value += boundary[at] + wall[o.start] - wall[at]
        value += boundary[o.start] + tables["ab".index(o.name)][o.start, o.end]
        at = o.end
    if at < len(wall) - 1:
        value += boundary[at] + wall[-1] - wall[at]
    best = max(_every_value(case, 0, wall_next) for wall_next in (True, False))
    assert value == pytest.approx(best)
