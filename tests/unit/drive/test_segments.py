"""Where the path is cut: straight pieces stay, turns towards the scanner go, passes are found."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.segments import cut_segments, driven_line

SPACING_M = 0.2


def _corner(radius_m: float) -> NDArray[np.float64]:
    """(n, 3) 40 m north, a turn to the left, 40 m west."""
    first = np.stack([np.zeros(200), np.linspace(0, 40, 200)], axis=1)
    angle = np.linspace(0, np.pi / 2, 100)
    arc = np.stack([radius_m * (np.cos(angle) - 1), 40 + radius_m * np.sin(angle)], axis=1)
    last = arc[-1] + np.stack([-np.linspace(0.2, 40, 200), np.zeros(200)], axis=1)
    flat = np.concatenate([first, arc[1:], last])
    return np.concatenate([flat, np.full((len(flat), 1), 1.8)], axis=1)


def test_points_are_equally_spaced_and_stops_leave_one() -> None:
    path = _corner(30.0)
    path = np.insert(path, [50] * 40, path[50], axis=0)
    line = driven_line(path, SPACING_M, 0.0)
    step = np.linalg.norm(np.diff(line[5:-5], axis=0), axis=1)
    np.testing.assert_allclose(step, SPACING_M, rtol=0.05)


def test_turn_towards_the_scanner_is_cut_out() -> None:
    line = driven_line(_corner(10.0), SPACING_M, 0.0)
    segments = cut_segments(line, SPACING_M)
    left = [one for one in segments if one.side == "left" and one.fate == "build"]
    right = [one for one in segments if one.side == "right" and one.fate == "build"]
    assert len(left) == 2
    assert len(right) == 1
    for one in left:
        flat = np.array(one.line)[:, :2]
        heading = np.unwrap(np.arctan2(*np.diff(flat, axis=0).T[::-1]))
        # 1 / (turn per metre) is the critical distance: never within 18 m.
        assert np.abs(np.diff(heading)).max() < SPACING_M / 18.0 + 1e-3


def test_wide_bend_stays_whole() -> None:
    segments = cut_segments(driven_line(_corner(60.0), SPACING_M, 0.0), SPACING_M)
    assert all(one.reason.startswith(("between", "cut")) for one in segments)


def test_long_piece_is_cut_where_fewest_points_are() -> None:
    y = np.arange(0.0, 160.0, SPACING_M)
    line = np.stack([np.zeros_like(y), y, np.full_like(y, 1.8)], axis=1)
    counts = np.full(len(y), 50)
    counts[426:435] = 1  # a gap of almost two metres
    segments = cut_segments(line, SPACING_M, counts)
    left = [one for one in segments if one.side == "left"]
    assert len(left) == 2
    assert abs(left[1].line[0][1] - 430 * SPACING_M) < 1e-6


def test_second_pass_is_left_out() -> None:
    y = np.arange(0.0, 50.0, 0.5)
    there = np.stack([np.zeros_like(y), y, np.full_like(y, 1.8)], axis=1)
    turn = np.linspace(0, np.pi, 60)[1:-1]
    around = np.stack(
        [3 - 3 * np.cos(turn), 50 + 3 * np.sin(turn), np.full_like(turn, 1.8)], axis=1
    )
    back = there[::-1] + np.array([6.0, 0.0, 0.0])
    around_again = np.stack(
        [3 + 3 * np.cos(turn), -3 * np.sin(turn), np.full_like(turn, 1.8)], axis=1
    )
    path = np.concatenate([there, around, back, around_again, there])
    segments = cut_segments(driven_line(path, SPACING_M, 0.0), SPACING_M)
    again = [one for one in segments if "another pass" in one.reason]
    assert {one.side for one in again} == {"left", "right"}


def test_driving_backwards_is_another_pass() -> None:
    y = np.concatenate([np.arange(0.0, 60.0, 0.2), np.arange(60.0, 20.0, -0.2)])
    path = np.stack([np.zeros_like(y), y, np.full_like(y, 1.8)], axis=1)
    segments = cut_segments(driven_line(path, SPACING_M, 0.0), SPACING_M)
    built = [one for one in segments if one.fate == "build"]
    assert {one.side for one in built} == {"left", "right"}
    for one in built:
        assert 50.0 < len(one.line) * SPACING_M < 65.0
    assert sum("another pass" in one.reason for one in segments) == 2


def test_stop_and_go_is_as_a_smooth_drive() -> None:
    y = np.concatenate([np.linspace(a, a + 10.0, 60) for a in range(0, 60, 10)])
    y = np.insert(y, [120] * 300, y[120])
    random = np.random.default_rng(1)
    path = np.stack([random.normal(0, 0.02, len(y)), y, np.full_like(y, 1.8)], axis=1)
    segments = cut_segments(driven_line(path, SPACING_M, 0.0), SPACING_M)
    built = [one for one in segments if one.side == "left" and one.fate == "build"]
    assert len(built) == 1
    assert 55.0 < len(built[0].line) * SPACING_M < 65.0
