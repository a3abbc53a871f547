"""Convex polygons, against OpenCV's."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from veduta.geometry import polygon


@given(
    st.lists(st.floats(0.0, 6.28), min_size=3, max_size=9, unique=True),
    st.floats(0.0, 6.28),
    st.floats(-1.2, 1.2),
)
def test_clip_is_the_intersection(angles: list[float], heading: float, offset: float) -> None:
    ring = np.array([[np.cos(t), np.sin(t)] for t in sorted(angles)])
    assume(float(np.diff(sorted(angles)).min()) > 0.05 and polygon.signed_area(ring) > 0.05)
    normal = np.array([np.cos(heading), np.sin(heading)])
    clipped = polygon.clip_half_plane(ring, np.append(normal, offset))
    along = np.array([-normal[1], normal[0]])
    foot = -offset * normal
    half_plane = np.array(
        [
            foot - 9 * along,
            foot - 9 * along + 9 * normal,
            foot + 9 * (along + normal),
            foot + 9 * along,
        ]
    )
    expected, _ = cv2.intersectConvexConvex(ring.astype(np.float32), half_plane.astype(np.float32))
    found = abs(polygon.signed_area(clipped)) if len(clipped) >= 3 else 0.0
    assert found == pytest.approx(max(0.0, expected), abs=1e-4)


def test_convexity_and_direction() -> None:
    square = polygon.rectangle(0, 0, 2, 1)
    assert polygon.is_strictly_convex(square)
    assert polygon.is_strictly_convex(square[::-1])
    assert polygon.signed_area(square) == 2.0
    assert polygon.signed_area(square[::-1]) == -2.0
    assert not polygon.is_strictly_convex(square[[0, 2, 1, 3]])
    assert not polygon.is_strictly_convex(np.array([[0, 0], [1, 0], [2, 0], [1, 2.0]]))
    star = np.array([[np.sin(4 * np.pi * k / 5), np.cos(4 * np.pi * k / 5)] for k in range(5)])
    assert not polygon.is_strictly_convex(star)


@given(st.floats(-2, 4), st.floats(-2, 4))
def test_contains(x: float, y: float) -> None:
    triangle = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])
    distance = cv2.pointPolygonTest(triangle.astype(np.float32), (x, y), True)
    assume(abs(distance) > 1e-4)
    assert bool(polygon.contains(triangle, np.array([[x, y]]))[0]) == (distance > 0)
