"""The plane that is measured in the view that faces it, and what the held-out edges know of it."""

from __future__ import annotations

import numpy as np
import pytest
from drawn_wall import corner_error, draw_wall, photo_of, take, view_of

from veduta.facade.find_plane import _is_seen_in, find_plane, plane_of_segments
from veduta.facade.plane import FacadePlane, require_evidence
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.plane_fit import PlaneFit, fit_plane
from veduta.imaging.segments import Segments, detect_segments
from veduta.run.errors import NotFoundError

SIZE = (1000, 750)


@pytest.mark.parametrize(("yaw", "pitch"), [(45, 10), (-40, 20), (20, -10)])
def test_facing_the_wall_measures_no_worse(yaw: float, pitch: float) -> None:
    view = view_of(yaw, pitch, 2, 0.75, SIZE)
    wall = draw_wall()
    picture, view_from_wall = take(wall, view, 0.9, SIZE)
    segments = detect_segments(picture)
    first = fit_plane(segments, SIZE, view.focal_px)
    found = find_plane(photo_of(picture), view.focal_px)
    assert first is not None
    before = FacadePlane(first, first, segments, np.zeros(len(segments), dtype=np.bool_))
    size = (wall.shape[1], wall.shape[0])
    error = corner_error(found.plane_from_image(), view_from_wall, size)
    assert error < max(0.003, 1.05 * corner_error(before.plane_from_image(), view_from_wall, size))


def test_held_out_edges_do_not_come_back_from_the_facing_view() -> None:
    """Edges of a wall that turn only in the held-out half would turn a fit that used them."""
    view = view_of(30, 5, 0, 0.75, SIZE)
    picture, _ = take(draw_wall(), view, 0.9, SIZE)
    segments = detect_segments(picture)
    held_out = segments.midpoints()[:, 0] > np.median(segments.midpoints()[:, 0])
    photo = photo_of(picture)
    plane = plane_of_segments(segments, held_out, photo, view.focal_px)
    # The same picture with that half painted over, within where its edges were.
    hidden = picture.copy()
    left = int(segments.select(held_out).midpoints()[:, 0].min())
    hidden[:, left + 30 :] = 128
    blind = find_plane(photo_of(hidden), view.focal_px)
    assert abs(np.rad2deg(plane.judged.view.yaw - blind.view.yaw)) < 0.6
    assert plane.judged.view != plane.fit.view


def test_the_same_edge_is_known_again_in_pieces() -> None:
    """Against distances that are computed point by point."""
    rng = np.random.default_rng(4)
    ends = rng.uniform(0, 120, (2, 60, 2))
    first, others = Segments(ends[0][:30], ends[1][:30]), Segments(ends[0][30:], ends[1][30:])
    expected = [
        any(
            _distance(one.mean(0), other) <= 3.0 or _distance(other.mean(0), one) <= 3.0
            for other in _pairs(others)
        )
        for one in _pairs(first)
    ]
    assert _is_seen_in(first, others, 3.0).tolist() == expected
    assert 0 < sum(expected) < 30


def _pairs(segments: Segments) -> list[np.ndarray]:
    return list(np.stack([segments.start, segments.end], axis=1))


def _distance(point: np.ndarray, ends: np.ndarray) -> float:
    """To the segment's line where the foot lies on the segment, else infinity."""
    a, b = ends
    t = float((point - a) @ (b - a) / ((b - a) @ (b - a)))
    return float(np.linalg.norm(a + t * (b - a) - point)) if 0 <= t <= 1 else np.inf


def _wall_of(levels: int, uprights: int, clutter: int) -> FacadePlane:
    """A wall seen straight on, all of its segments held out."""
    rng = np.random.default_rng(1)
    angles = np.concatenate(
        [np.zeros(levels), np.full(uprights, np.pi / 2), np.deg2rad(rng.uniform(20, 70, clutter))]
    )
    middle = rng.uniform(200, 600, (len(angles), 2))
    half = 20.0 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    segments = Segments(middle - half, middle + half)
    view = FacadeView(0.0, 0.0, 0.0, 800.0, 400.0, 400.0)
    fit = PlaneFit(view, np.eye(6), 0.0, (800, 800))
    return FacadePlane(fit, fit, segments, np.ones(len(segments), dtype=np.bool_))


def test_few_uprights_are_enough_where_little_else_stands_beside_the_courses() -> None:
    require_evidence(_wall_of(levels=92, uprights=4, clutter=4), 1000.0)


@pytest.mark.parametrize(
    ("levels", "uprights", "clutter"), [(80, 3, 17), (98, 0, 2), (98, 1, 1), (3, 40, 57)]
)
def test_levels_with_other_things_are_no_wall(levels: int, uprights: int, clutter: int) -> None:
    with pytest.raises(NotFoundError, match="straight edges"):
        require_evidence(_wall_of(levels, uprights, clutter), 1000.0)
