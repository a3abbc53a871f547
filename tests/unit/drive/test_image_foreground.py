"""Foreground in images (section 7.1): a board before a wall, drawn by code of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta import _core
from veduta.drive.build.backdrop import backdrop_of, draw_backdrops
from veduta.drive.build.fill import Background, Source
from veduta.drive.build.frame import ColumnFrame, column_frame
from veduta.drive.build.misfit import Frame, correspondence_error
from veduta.drive.build.pictures_of import Around, Seen, look, read_shot
from veduta.drive.record import Shot
from veduta.run.errors import InputError

WALL_M, BOARD_M = 10.0, 6.0
BOARD = (4.2, 5.4, 0.6, 3.4)
"""From y to y, from z to z (m)."""
SIZE = (320, 240)
NOTHING = np.zeros((0, 3))


def _frame() -> ColumnFrame:
    line = np.column_stack([np.zeros(120), np.arange(120) * 0.1, np.full(120, 2.0)])
    return column_frame(line, "left", np.deg2rad(np.arange(-14.0, 30.0, 0.5)), np.zeros(120))


def _background() -> Background:
    shape = _frame().shape
    depth = np.full(shape, WALL_M, dtype=np.float32)
    source = np.full(shape, Source.MEASURED, dtype=np.uint8)
    wall = np.ones(shape, dtype=bool)
    return Background(depth, source, wall, np.full(120, WALL_M), np.zeros(120, dtype=np.int64))


def _picture(y: float) -> tuple[Frame, NDArray[np.bool_]]:
    """A camera at (0, y, 2) that looks at the wall x = -10, and which pixels show the board."""
    random = np.random.default_rng(7)
    wall = random.integers(90, 255, (100, 160, 3)).astype(np.uint8)
    board = random.integers(20, 50, (100, 160, 3)).astype(np.uint8)
    place = np.eye(4)
    place[:3, :3] = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]
    place[:3, 3] = (0.0, y, 2.0)
    shot = Shot(f"{y}", Path("a"), y, *SIZE, (200.0, 200.0), (160.0, 120.0), place)
    across, down = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)

    def painted(
        texture: NDArray[np.uint8], away: float
    ) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
        to_y, to_z = y + (across - 160) / 200 * away, 2.0 - (down - 120) / 200 * away
        rows = np.clip(((to_z + 5.0) / 0.2).astype(int), 0, 99)
        columns = np.clip(((to_y + 8.0) / 0.2).astype(int), 0, 159)
        inside = (to_y > BOARD[0]) & (to_y < BOARD[1]) & (to_z > BOARD[2]) & (to_z < BOARD[3])
        return texture[rows, columns], inside

    behind, _ = painted(wall, WALL_M)
    before, shown = painted(board, BOARD_M)
    return Frame(shot, np.where(shown[..., None], before, behind).astype(np.uint8)), shown


def _points(every_m: float) -> NDArray[np.float64]:
    """(n, 3) what a coarse scanner sees of the board."""
    y, z = np.meshgrid(
        np.arange(BOARD[0] + 0.1, BOARD[1], every_m), np.arange(BOARD[2] + 0.1, BOARD[3], every_m)
    )
    return np.stack([np.full(y.size, -BOARD_M), y.ravel(), z.ravel()], axis=1)


def _looked(points: NDArray[np.float64], *, beside: bool = True) -> tuple[Seen, NDArray[np.bool_]]:
    (one, shown), (before, _), (after, _) = _picture(4.5), _picture(4.1), _picture(4.9)
    around = Around(points, NOTHING, (backdrop_of(_background(), _frame(), 0.0),))
    return look(one, around, (before, after) if beside else ()), shown


def test_the_backdrop_is_drawn_where_it_is() -> None:
    shot = _picture(4.5)[0].shot
    drawn = draw_backdrops(shot, [backdrop_of(_background(), _frame(), 0.0)])
    shown = drawn.depth[60:165, 80:260]
    np.testing.assert_allclose(shown, WALL_M, atol=1e-3)
    assert not drawn.inferred.any()


def test_what_stands_before_the_wall_does_not_fit_it() -> None:
    (one, shown), (beside, _) = _picture(4.5), _picture(4.9)
    drawn = draw_backdrops(one.shot, [backdrop_of(_background(), _frame(), 0.0)])
    error = correspondence_error(one, drawn.depth, [beside])
    # The board moves by 200 * 0.4 * (1 / 6 - 1 / 10) pixels more than the wall.
    inner = shown & np.roll(shown, 12, axis=1) & np.roll(shown, -12, axis=1)
    assert np.nanmedian(error[inner]) == pytest.approx(200 * 0.4 * (1 / 6 - 1 / 10), abs=1.0)
    away = np.roll(shown, 12, axis=1) | np.roll(shown, -12, axis=1) | shown
    told = ~away & np.isfinite(error)
    assert (error[told] < 1.5).mean() > 0.97


def test_a_few_points_become_the_whole_object() -> None:
    seen, shown = _looked(_points(0.5))
    found = seen.hidden_m < WALL_M - 0.4
    assert found[shown].mean() > 0.95
    wide = np.roll(shown, 8, axis=1) | np.roll(shown, -8, axis=1) | shown
    assert found[~wide].mean() < 0.01
    np.testing.assert_allclose(seen.hidden_m[shown & found], BOARD_M, atol=0.01)


def test_without_images_beside_only_points_hide() -> None:
    seen, shown = _looked(_points(0.5), beside=False)
    assert (seen.hidden_m[shown] < WALL_M - 0.4).mean() < 0.8
    assert not np.isfinite(seen.misfit).any()


def test_without_foreground_nothing_is_hidden() -> None:
    """What does not fit, as reflections in panes, is left where no scan point is near."""
    assert not np.isfinite(_looked(NOTHING)[0].hidden_m).any()


def test_crowns_hide_where_no_image_beside_tells() -> None:
    (one, _), (beside, _) = _picture(4.5), _picture(4.9)
    above = np.array([[-8.0, 4.5, 3.0]])
    backdrop = backdrop_of(_background(), _frame(), 0.0)
    alone = look(one, Around(NOTHING, above, (backdrop,)))
    told = look(one, Around(NOTHING, above, (backdrop,)), (beside,))
    assert np.isfinite(alone.hidden_m).any()
    assert not np.isfinite(told.hidden_m).any()


def _green(tone: tuple[int, int, int], rough: float) -> tuple[float, float]:
    """The share told as plants of a wall of a colour, from one image and with those beside it."""
    frames = []
    for y in (4.5, 4.1, 4.9):
        one = _picture(y)[0]
        light = one.pixels.astype(np.float64).mean(axis=2, keepdims=True) - 172.0
        painted = np.clip(np.array(tone) + rough * light, 0, 255).astype(np.uint8)
        frames.append(Frame(one.shot, painted))
    around = Around(NOTHING, NOTHING, (backdrop_of(_background(), _frame(), 0.0),))
    away = (slice(100, 140), slice(225, 245))  # from the board, which does not fit
    alone, beside = look(frames[0], around), look(frames[0], around, frames[1:])
    return float(alone.leaves[away].mean()), float(beside.leaves[away].mean())


def test_greenish_plaster_is_no_plant() -> None:
    """What fits the wall is of it unless it is as green and as rough as leaves are."""
    assert _green((176, 186, 178), 0.0) == (1.0, 0.0)
    assert _green((120, 132, 116), 0.0) == (1.0, 0.0)
    assert min(_green((70, 112, 52), 0.7)) > 0.9


def test_a_painted_shop_is_no_plant() -> None:
    assert _green((12, 66, 40), 0.0) == (1.0, 0.0)


def test_what_is_below_scan_points_hides_too() -> None:
    """The end of a car has no scan points where the planes of the scanner run along it."""
    column = np.column_stack([np.full(20, -BOARD_M), np.full(20, 4.5), np.linspace(0.2, 1.2, 20)])
    shot = _picture(4.5)[0].shot
    none = look(_picture(4.5)[0], Around(NOTHING, NOTHING))
    seen = look(_picture(4.5)[0], Around(NOTHING, NOTHING, (), column))
    at = np.floor(shot.project(column)[0]).astype(int)
    assert (seen.hidden_m[at[:, 1], at[:, 0]] < BOARD_M).all()
    assert np.isfinite(seen.hidden_m).mean() < 0.05
    assert not np.isfinite(none.hidden_m).any()


def test_an_image_of_another_size_is_named(tmp_path: Path) -> None:
    from PIL import Image

    path = tmp_path / "a.png"
    Image.new("RGB", (20, 10)).save(path)
    shot = Shot("a", path, 0.0, 30, 10, (20.0, 20.0), (15.0, 5.0), np.eye(4))
    with pytest.raises(InputError, match="20 x 10") as told:
        read_shot(shot)
    assert told.value.remedy


def test_a_point_outside_of_an_image_is_refused() -> None:
    pixels, misfit = np.zeros((4, 5, 3), np.uint8), np.zeros((4, 5), np.float32)
    with pytest.raises(_core.DriveFault, match="outside"):
        _core.flood_foreground(
            pixels, misfit, np.array([[5, 0]]), np.ones(1, np.float32), reach=3, colour=9,
            slack=1.0, least=1.0,
        )  # fmt: skip
    with pytest.raises(_core.DriveFault, match="a depth for each"):
        _core.flood_foreground(
            pixels, misfit, np.array([[1, 0]]), np.ones(2, np.float32), reach=3, colour=9,
            slack=1.0, least=1.0,
        )  # fmt: skip
