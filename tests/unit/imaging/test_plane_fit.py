"""The view of a wall from line segments whose truth the test made."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.geometry import homography, polygon, vanishing
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.plane_fit import PlaneFit, aspect_error, fit_plane
from veduta.imaging.segments import Segments

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


def joined(first: Segments, second: Segments) -> Segments:
    return Segments(np.vstack([first.start, second.start]), np.vstack([first.end, second.end]))


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
    """Edges of roofs and shutters, 1.5 degrees off and longer than most of the wall's own."""
    errors = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        wall = segments_of_wall(rng, rng.uniform(20, 100, 250), 0.4)
        off = segments_of_wall(rng, rng.uniform(60, 150, 60), 0.4)
        errors.append(corner_error(found_in(joined(wall, turned(off, 1.5)))))
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
