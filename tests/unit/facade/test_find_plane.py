"""The plane that is measured in the view that faces it, and what the held-out edges know of it."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from drawn_wall import draw_wall, photo_of, take, view_of

from veduta.facade.find_plane import _facing_segments, _is_seen_in, find_plane, plane_of_segments
from veduta.facade.plane import FacadePlane, require_evidence
from veduta.geometry import homography
from veduta.geometry.vanishing import FacadeView, axis_angles
from veduta.imaging.plane_fit import PlaneFit, measure_plane
from veduta.imaging.segments import Segments, detect_segments
from veduta.run.errors import NotFoundError

SIZE = (1000, 750)


@pytest.mark.parametrize(("yaw", "pitch"), [(45, 10), (-40, 20), (20, -10)])
def test_edges_of_the_facing_view_are_those_of_the_wall(yaw: float, pitch: float) -> None:
    view = view_of(yaw, pitch, 2, 0.75, SIZE)
    picture, view_from_wall = take(draw_wall(), view, 0.9, SIZE)
    photo = photo_of(picture)
    plane = find_plane(photo, view.focal_px)
    edges = _facing_segments(plane, photo, 1.0)
    on_wall = edges.mapped(homography.inverse(view_from_wall))
    off = np.rad2deg(axis_angles(on_wall.directions()))
    assert len(edges) > 150
    assert float(np.median(off)) < 0.25
    # They are where the wall has them: its windows' sides are at 35, 41, 79 and 85 of 120 px.
    steep = np.abs(on_wall.directions()[:, 1]) > 0.99
    beside = np.abs(on_wall.midpoints()[steep, :1] % 120 - [0, 35, 41, 58.5, 61.5, 79, 85, 120])
    assert float(np.median(beside.min(axis=1))) < 1.0


def test_the_photos_own_border_is_no_edge_of_the_facing_view() -> None:
    """The wall fills the photo, so the facing view ends within it, on black."""
    view = view_of(35, 15, 0, 0.7, SIZE)
    picture, _ = take(draw_wall(12, 10), view, 1.6, SIZE)
    photo = photo_of(picture)
    edges = _facing_segments(find_plane(photo, view.focal_px), photo, 1.0)
    ends = np.vstack([edges.start, edges.end])
    assert len(edges) > 100
    assert (ends > 1.0).all()
    assert (ends < np.array(SIZE) - 1.0).all()


def test_edges_of_the_facing_view_take_part() -> None:
    """The kept view lies between what the photo's and the facing view's edges say, alone."""
    view = view_of(30, 10, 0, 0.75, SIZE)
    photo = photo_of(take(draw_wall(), view, 0.9, SIZE)[0])
    plane = find_plane(photo, view.focal_px)
    facing = _facing_segments(plane, photo, 1.0)
    photo_alone = measure_plane(plane.fit, plane.segments, view.focal_px, 1).view.yaw
    facing_alone = measure_plane(plane.fit, facing, view.focal_px, 1).view.yaw
    low, high = sorted((photo_alone, facing_alone))
    assert low < plane.view.yaw < high


@pytest.mark.parametrize("degrees", [1.0, 1.5])
def test_held_out_edges_do_not_come_back_from_the_facing_view(degrees: float) -> None:
    """The right half of the wall is turned, and held out: only the kept view knows."""
    view = view_of(20, 5, 0, 0.75, SIZE)
    wall = draw_wall(8, 6)
    height, width = wall.shape[:2]
    turn = cv2.getRotationMatrix2D((0.75 * width, height / 2), degrees, 1.0)
    turned = cv2.warpAffine(wall, turn, (width, height), borderMode=cv2.BORDER_REFLECT)
    wall[:, width // 2 :] = turned[:, width // 2 :]
    picture, view_from_wall = take(wall, view, 0.9, SIZE)
    segments = detect_segments(picture)
    on_wall = homography.apply(homography.inverse(view_from_wall), segments.midpoints())
    held_out = on_wall[:, 0] > width / 2
    plane = plane_of_segments(segments, held_out, photo_of(picture), view.focal_px)
    assert abs(np.rad2deg(plane.judged.view.roll)) < 0.1
    assert abs(np.rad2deg(plane.fit.view.roll)) > 0.2 * degrees


def test_the_same_edge_is_known_again_in_pieces() -> None:
    """Against distances that are computed point by point; it is enough that they overlap."""
    rng = np.random.default_rng(4)
    ends = rng.uniform(0, 120, (2, 60, 2))
    first, others = Segments(ends[0][:30], ends[1][:30]), Segments(ends[0][30:], ends[1][30:])
    expected = [
        any(
            min(_distance(end, b) for a, b in ((one, other), (other, one)) for end in a) <= 3.0
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
