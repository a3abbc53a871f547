"""Sides of rooms between bare faces, against walls whose faces are known by their formula."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.plan.scale.clear_spans import Span, clear_sides, thin_wall

SIZE = 190
FINE = 8  # samples along each side of a pixel
WALL = 9.0


def _drawn(
    turn: float, low: NDArray[np.float64], high: NDArray[np.float64], furniture: float = 0.0
) -> NDArray[np.float32]:
    """Ink (h, w) of a rectangle's walls in a turned frame, by how much of each pixel they cover.

    `furniture` is the share of the lower walls, from their middle on to both sides, along which
    ink reaches 3 px into the room.
    """
    at = (np.arange(SIZE * FINE) + 0.5) / FINE
    x, y = np.meshgrid(at, at)
    cos, sin = math.cos(turn), math.sin(turn)
    points = np.stack([cos * x + sin * y, cos * y - sin * x], axis=-1)
    outside = np.maximum(low - points, points - high).max(axis=-1)
    ink = (outside >= 0.0) & (outside < WALL)
    middle, reach = (low + high) / 2.0, furniture * (high - low) / 2.0
    for axis in (0, 1):
        near = (points[..., axis] - low[axis] >= 0.0) & (points[..., axis] - low[axis] < 3.0)
        beside = np.abs(points[..., 1 - axis] - middle[1 - axis]) < reach[1 - axis]
        ink |= near & beside & (outside < 0.0)
    shares = ink.reshape(SIZE, FINE, SIZE, FINE).mean(axis=(1, 3))
    return shares.astype(np.float32)


def _outline(turn: float, low: NDArray[np.float64], high: NDArray[np.float64]) -> Span:
    """As it is found beside furniture: 2 px within the lower walls."""
    return Span(turn, low + 2.0, high)


@settings(deadline=None, max_examples=15)
@given(st.floats(-0.06, 0.06), st.floats(0.0, 1.0), st.floats(90.0, 110.0), st.floats(0.0, 0.8))
def test_bare_faces_are_found_beside_furniture(
    turn: float, part: float, side: float, furniture: float
) -> None:
    low = np.array([30.0 + part, 40.0 - part])
    high = low + np.array([side, 0.8 * side])
    ink = _drawn(turn, low, high, furniture)
    along, across = clear_sides(ink, _outline(turn, low, high), WALL)
    # An edge between two centres of pixels is told by straight lines to 0.1 px, and what is drawn
    # here has it to half a sample.
    assert along == pytest.approx(side, abs=0.35)
    assert across == pytest.approx(0.8 * side, abs=0.35)


def test_what_is_no_wall_filled_with_ink_has_no_face() -> None:
    low, high = np.array([40.0, 40.0]), np.array([150.0, 120.0])
    room = _outline(0.0, low, high)
    ink = _drawn(0.0, low, high)
    assert None not in clear_sides(ink, room, WALL)
    assert clear_sides(0.55 * ink, room, WALL) == (None, None)  # grey
    outlined = ink.copy()
    outlined[33:127, 33:157] *= 0.8
    outlined[38:122, 38:152] = ink[38:122, 38:152]  # a dark grey, and its outline
    assert clear_sides(outlined, room, WALL) == (None, None)
    hollow = ink.copy()
    hollow[33:127, 33:157] = 0.0
    hollow[38:122, 38:152] = ink[38:122, 38:152]
    assert clear_sides(hollow, room, WALL) == (None, None)
    assert clear_sides(ink, room, 4.0) == (None, None)  # as broad as lines


def test_a_leaf_in_its_pocket_is_no_face() -> None:
    """For a half of the wall there is a leaf in it, of half of its thickness."""
    low, high = np.array([40.0, 40.0]), np.array([150.0, 120.0])
    ink = _drawn(0.0, low, high)
    ink[60:100, 35:40] = 0.0
    along, _ = clear_sides(ink, Span(0.0, low, high), WALL)
    assert along == pytest.approx(110.0, abs=0.05)


def test_partitions_are_the_thin_walls() -> None:
    assert thin_wall([10.0] * 5 + [30.0] * 5) == 10.0
    assert thin_wall([]) == 0.0
