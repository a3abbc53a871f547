"""The view of a wall from line segments whose truth the test made."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.geometry import homography, polygon, vanishing
from veduta.geometry.vanishing import FacadeView
from veduta.imaging import plane_fit
from veduta.imaging.plane_fit import PlaneFit, aspect_error, fit_plane, measure_plane
from veduta.imaging.segments import Segments, joined

SIZE = (1200, 900)
FOCAL_PX = 1100.0
VIEW = FacadeView(0.5, 0.2, -0.05, FOCAL_PX, SIZE[0] / 2, SIZE[1] / 2)


def segments_of_wall(
    rng: np.random.Generator, lengths_px: NDArray[np.float64], end_noise_px: float
) -> Segments:
    """Half along and half up the wall, anywhere in the photo, both ends off by Gaussian noise."""
    points = VIEW.camera() @ VIEW.rotation()
    middle = rng.uniform((150, 150), (SIZE[0] - 150, SIZE[1] - 150), (len(lengths_px), 2))
    is_up = np.arange(len(lengths_px)) % 2
    towards = points[:2, is_up].T - middle * points[2, is_up][:, None]
    half = 0.5 * lengths_px[:, None] * towards / np.linalg.norm(towards, axis=1)[:, None]
    start, end = (e + rng.normal(0, end_noise_px, e.shape) for e in (middle - half, middle + half))
    return Segments(start, end)


def turned(segments: Segments, degrees: float) -> Segments:
    """Each about its own middle, all the same way."""
    angle, middle = np.deg2rad(degrees), segments.midpoints()
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    ends = (middle + (end - middle) @ turn.T for end in (segments.start, segments.end))
    return Segments(*ends)


def found_in(segments: Segments, size: tuple[int, int] = SIZE, known: bool = True) -> PlaneFit:
    focal_px = FOCAL_PX * size[0] / SIZE[0] if known else None
    fit = fit_plane(segments, size, focal_px)
    assert fit is not None
    return fit


def corner_error(fit: PlaneFit) -> float:
    """Of the photo's corners on the wall: the largest, less shift and scales, per width."""
    corners = polygon.rectangle(0.0, 0.0, *SIZE)
    truth = homography.apply(vanishing.plane_from_image(VIEW), corners)
    estimate = homography.apply(vanishing.plane_from_image(fit.view), corners)
    e, t = estimate - estimate.mean(axis=0), truth - truth.mean(axis=0)
    scaled = e * (e * t).sum(axis=0) / (e * e).sum(axis=0)
    return float(np.linalg.norm(scaled - t, axis=1).max() / np.ptp(t[:, 0]))


def root_mean_square(values: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def test_exact_segments_give_the_exact_view() -> None:
    rng = np.random.default_rng(2)
    assert corner_error(found_in(segments_of_wall(rng, rng.uniform(20, 200, 200), 0.0))) < 0.0005


def test_long_edges_that_run_nearly_with_the_wall_do_not_turn_it() -> None:
    """Edges of roofs and shutters, 3 degrees off and longer than most of the wall's own."""
    errors = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        wall = segments_of_wall(rng, rng.uniform(20, 100, 250), 0.4)
        off = segments_of_wall(rng, rng.uniform(60, 150, 60), 0.4)
        errors.append(corner_error(found_in(joined(wall, turned(off, 3.0)))))
    assert root_mean_square(errors) < 0.003


def test_clutter_does_not_move_the_view() -> None:
    rng = np.random.default_rng(5)
    wall = segments_of_wall(rng, rng.uniform(20, 150, 250), 0.5)
    angle, middle = rng.uniform(0, np.pi, 150), rng.uniform((60, 60), (1140, 840), (150, 2))
    half = 15.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert corner_error(found_in(joined(wall, Segments(middle - half, middle + half)))) < 0.004


def test_a_larger_photo_of_the_same_edges_gives_the_same_view() -> None:
    """Photos are reduced for detection, so ends are off by more of a large photo's pixels."""
    rng = np.random.default_rng(7)
    segments = segments_of_wall(rng, rng.uniform(20, 150, 250), 0.5)
    small = found_in(segments)
    large = found_in(Segments(4.0 * segments.start, 4.0 * segments.end), (4800, 3600))
    angles = np.subtract(
        vanishing.angles_from_rotation(small.view.rotation()),
        vanishing.angles_from_rotation(large.view.rotation()),
    )
    assert np.abs(np.rad2deg(angles)).max() < 0.02


def test_the_stated_aspect_error_covers_the_real_one() -> None:
    middle = np.array([SIZE[0] / 2, SIZE[1] / 2])
    true_aspect = _aspect(VIEW, middle)
    stated, real = [], []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        fit = found_in(segments_of_wall(rng, rng.uniform(20, 120, 300), 0.5), known=False)
        stated.append(aspect_error(fit, middle))
        real.append(np.log(_aspect(fit.view, middle) / true_aspect))
    # It holds an unknown principal point as well, which is in the middle here.
    assert root_mean_square(real) < float(np.mean(stated)) < 0.05


def _aspect(view: FacadeView, at_px: NDArray[np.float64]) -> float:
    steps = np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]]) + at_px
    origin, across, up = homography.apply(vanishing.plane_from_image(view), steps)
    return float(np.linalg.norm(across - origin) / np.linalg.norm(up - origin))


def test_one_direction_alone_gives_no_view() -> None:
    start = np.stack([np.full(30, 100.0), np.linspace(100, 800, 30)], axis=1)
    assert fit_plane(Segments(start, start + np.array([50.0, 0.0])), SIZE, FOCAL_PX) is None


@pytest.mark.parametrize("seed", [0, 1])
def test_same_segments_same_view(seed: int) -> None:
    segments = segments_of_wall(np.random.default_rng(seed), np.full(80, 60.0), 0.5)
    assert found_in(segments).view == found_in(segments).view


def test_edges_that_scatter_on_the_wall_are_weighed_as_they_scatter_there(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Against a fit to which a degree is a degree of the photo, on a wall that lies across."""
    view = FacadeView(np.deg2rad(65.0), 0.1, 0.0, FOCAL_PX, SIZE[0] / 2, SIZE[1] / 2)
    start = found_in(segments_of_wall(np.random.default_rng(2), np.full(200, 80.0), 0.0))
    start = replace(start, view=view)

    def yaw_errors() -> list[float]:
        walls = (_scattered_on_wall(view, np.random.default_rng(seed)) for seed in range(12))
        fits = [measure_plane(start, segments, FOCAL_PX, times=1) for segments in walls]
        return [float(np.rad2deg(fit.view.yaw - view.yaw)) for fit in fits]

    on_wall = root_mean_square(yaw_errors())
    monkeypatch.setattr(
        plane_fit, "_degrees_per_degree_of_wall", lambda problem, _: np.ones(len(problem.middle))
    )
    assert on_wall < 0.06
    assert on_wall < 0.85 * root_mean_square(yaw_errors())


def test_short_edges_that_run_off_count_for_less_than_long_ones() -> None:
    """Long edges of the wall and short ones turned by half a degree, and the other way round."""
    off = []
    for long_off, short_off in ((0.0, 0.5), (0.5, 0.0)):
        rng = np.random.default_rng(6)
        longer = turned(segments_of_wall(rng, np.full(100, 160.0), 0.0), long_off)
        shorter = turned(segments_of_wall(rng, np.full(100, 40.0), 0.0), short_off)
        view = measure_plane(
            found_in(segments_of_wall(rng, np.full(100, 80.0), 0.0)),
            joined(longer, shorter),
            FOCAL_PX,
            times=1,
        ).view
        off.append(abs(view.roll - VIEW.roll))
    assert off[0] < 0.45 * off[1]


def _scattered_on_wall(view: FacadeView, rng: np.random.Generator) -> Segments:
    plane_from_image = vanishing.plane_from_image(view)
    middle = rng.uniform((100, 100), (SIZE[0] - 100, SIZE[1] - 100), (300, 2))
    centre = homography.apply(plane_from_image, middle)
    angle = np.deg2rad(rng.normal(0.0, 1.0, 300)) + np.where(np.arange(300) % 2, np.pi / 2, 0.0)
    step = 1e-3 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    image_from_plane = homography.inverse(plane_from_image)
    end = homography.apply(image_from_plane, centre + step)
    direction = (end - middle) / np.linalg.norm(end - middle, axis=1)[:, None]
    return Segments(middle - 25.0 * direction, middle + 25.0 * direction)


def test_the_same_segments_twice_say_no_more_than_once() -> None:
    segments = segments_of_wall(np.random.default_rng(3), np.full(120, 60.0), 0.5)
    start = found_in(segments)
    once = measure_plane(start, segments, FOCAL_PX, times=1)
    twice = measure_plane(start, joined(segments, segments), FOCAL_PX, times=2)
    np.testing.assert_allclose(once.covariance, twice.covariance, rtol=1e-4)
    assert abs(once.view.yaw - twice.view.yaw) < 1e-6
