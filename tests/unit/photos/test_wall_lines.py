"""Parts of the search for walls, against closed forms and brute force."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.photos.walls.ends import dense_range, with_closed_corners, without_overshoot
from veduta.photos.walls.lines import Line, fitted
from veduta.photos.walls.plan_view import PlanView
from veduta.photos.walls.sight import Sights, share_seen_through
from veduta.photos.walls.spans import Bounds, spans
from veduta.photos.walls.steps import parting
from veduta.photos.walls.wall import Wall

BOUNDS = Bounds(points=20, width=0.5, height=0.5, gap=0.4)


def wall(start: tuple[float, float], end: tuple[float, float], top: float = 5.0) -> Wall:
    rows = np.zeros(0, dtype=np.int64)
    return Wall("w", np.array(start, float), np.array(end, float), 0.0, top, rows, 0.0)


def view(xy: np.ndarray, sigma: float = 0.02) -> PlanView:
    count = len(xy)
    return PlanView(
        rows=np.arange(count),
        xy=xy,
        z=np.zeros(count),
        facing=np.tile([0.0, -1.0], (count, 1)),
        seen_from=np.tile([0.0, -10.0], (count, 1)),
        covariance=np.tile(1e-12 * np.eye(2), (count, 1, 1)),
        roughness=sigma,
        reach=10.0,
    )


def test_a_fit_is_that_of_least_squares_and_forgives_strays() -> None:
    rng = np.random.default_rng(3)
    along = rng.uniform(-4, 4, 300)
    xy = np.column_stack([along, 0.1 * along + 1.0 + 0.02 * rng.standard_normal(300)])
    xy[:30, 1] += 0.5
    true = np.array([0.1, -1.0]) / np.hypot(0.1, 1.0)
    found = fitted(view(xy), Line(np.array([0.0, -1.0]), -1.0, np.zeros(2)))
    clean = xy[30:] - xy[30:].mean(axis=0)
    total = np.linalg.svd(clean)[2][1]
    assert abs(abs(found.normal @ total) - 1.0) < 1e-5
    assert np.rad2deg(np.arccos(abs(found.normal @ true))) < 0.1
    assert found.normal[1] < 0.0
    assert found.offset == pytest.approx(found.normal @ [0.0, 1.0], abs=0.01)


def test_gaps_part_spans_both_ways() -> None:
    rng = np.random.default_rng(5)
    boxes = [(0.0, 6.0, 0.0, 3.0), (8.0, 12.0, 0.0, 3.0), (0.0, 6.0, 5.0, 7.0)]
    along = np.concatenate([rng.uniform(a, b, 200) for a, b, _, _ in boxes])
    up = np.concatenate([rng.uniform(c, d, 200) for _, _, c, d in boxes])
    found = sorted(spans(along, up, BOUNDS), key=lambda rows: int(rows[0]))
    assert [rows.tolist() for rows in found] == [
        list(range(start, start + 200)) for start in (0, 200, 400)
    ]


def test_even_points_are_one_span_whatever_their_number() -> None:
    for seed in range(40):
        rng = np.random.default_rng(seed)
        count = int(rng.integers(40, 800))
        assert len(spans(rng.uniform(0, 9, count), rng.uniform(0, 4, count), BOUNDS)) == 1


def test_too_few_or_too_small_is_no_span() -> None:
    rng = np.random.default_rng(1)
    assert spans(rng.uniform(0, 9, 19), rng.uniform(0, 4, 19), BOUNDS) == []
    assert spans(rng.uniform(0, 0.3, 90), rng.uniform(0, 4, 90), BOUNDS) == []


def brute_parting(along: np.ndarray, off: np.ndarray, least: int) -> int:
    """The cut of least squares by fitting both sides of each."""
    order = np.argsort(along)
    t, r = along[order], off[order]
    costs = {
        at: sum(
            np.polyfit(t[part], r[part], 1, full=True)[1].sum()
            for part in (slice(None, at), slice(at, None))
        )
        for at in range(least, len(t) - least + 1)
    }
    return min(costs, key=costs.__getitem__)


def test_a_step_parts_a_line_where_brute_force_says() -> None:
    rng = np.random.default_rng(8)
    along = rng.uniform(0, 10, 160)
    off = np.where(along > 6.3, 0.08, -0.02) + 0.02 * rng.standard_normal(160)
    cut = parting(along, off, np.full(160, 0.02), 20, 0.5)
    order = np.sort(along)
    at = brute_parting(along, off, 20)
    assert cut == pytest.approx(0.5 * (order[at - 1] + order[at]))
    assert cut == pytest.approx(6.3, abs=0.2)


def test_a_straight_line_is_not_parted() -> None:
    for seed in range(60):
        rng = np.random.default_rng(seed)
        along = rng.uniform(0, 10, 200)
        off = 0.01 * along + 0.03 * rng.standard_normal(200)
        assert parting(along, off, np.full(200, 0.02), 20, 0.5) is None


def test_strays_beyond_the_end_are_cut() -> None:
    rng = np.random.default_rng(2)
    places = np.concatenate([rng.uniform(0, 10, 400), [11.5, 12.0, -1.0]])
    low, high = dense_range(places)
    assert 0.0 < low < 0.2
    assert 9.8 < high < 10.0


def test_an_end_with_fewer_points_is_kept() -> None:
    rng = np.random.default_rng(2)
    places = np.concatenate([rng.uniform(0, 10, 400), rng.uniform(10, 12, 25)])
    assert dense_range(places)[1] > 11.0


def test_two_ends_that_nearly_meet_are_brought_together() -> None:
    one, two = wall((0, 0), (4.8, 0)), wall((5, -0.1), (5, -6))
    found = with_closed_corners([one, two], 0.3)
    assert np.allclose(found[0].end, [5, 0])
    assert np.allclose(found[1].start, [5, 0])
    far = wall((5.4, -0.1), (5.4, -6))
    assert with_closed_corners([one, far], 0.3) == [one, far]
    parallel = wall((5, 0.05), (9, 0.05))
    assert with_closed_corners([one, parallel], 0.3) == [one, parallel]


def test_what_sticks_out_behind_another_wall_is_cut() -> None:
    # Seen from y < 0: `front` faces it; the other one ends on it, and goes on behind.
    front, other = wall((0, 0), (8, 0)), wall((8.0, -5), (8.0, 0.2))
    found = without_overshoot([front, other], 0.3)
    assert np.allclose(found[1].end, [8, 0])
    longer = wall((4, -5), (4, 2))
    assert without_overshoot([front, longer], 0.3)[1] is longer


def test_what_photos_see_through_is_counted() -> None:
    one = wall((0, 0), (4, 0))
    assert np.allclose(one.outward, [0, -1])
    eye = np.tile([2.0, -8.0, 1.5], (5, 1))
    point = np.array(
        [[1, 0, 1], [2, 0.05, 2], [3, -0.05, 1], [2.5, 4, 2], [30, 4, 1]], dtype=float
    )  # three on it, one through it, one past it
    assert share_seen_through(one, Sights(eye, point), 0.2) == 0.25
    assert share_seen_through(one, Sights(point[3:4], eye[3:4]), 0.2) == 0.0
