"""Verify: which matches of two photos one scene, or one plane, explains.

Sections 2.4 and 2.5.2 of the thesis: a homography is weighed against the fundamental matrix, and
the matches that the better one explains are kept. The estimators are our own, in Rust
(`veduta-photos`), or OpenCV's MAGSAC++; the engine's, the third choice, runs while it matches.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta import _core
from veduta.photos.options import MatchOptions

Verdict = Literal["general", "planar", "too-few", "mostly-false"]

DRAWS = 1500
"""Of eight matches: 99.7 % sure that one is without a false match where half of all are false."""
PLANE_DRAWS = 300
"""Of four: sure but for one in 10^8 there."""
BAND_PX = (3.0, 6.0)
"""Matches nearer than the first are true and those further than the second false, whatever sigma
is; of both photos together, in pixels at which features were looked for. On fountain-P11 and
lund-door F is as near to the truth with 2 to 4 for the first; without it a tenth of the true
matches is lost, and F half as far off again."""
LEAST_SIGMA_PX = 0.3
"""No coordinate of a feature is better known than this where F and H are weighed."""
MAGSAC_PX = 1.5
"""Distance that MAGSAC++ takes to be the largest of a true match, in those pixels."""
SURE = 0.9999
"""Confidence at which MAGSAC++ stops."""
MOST_DRAWS = 10_000
"""Draws of MAGSAC++ at most."""
FEWEST = 20
"""True matches of a pair (n_min of algorithm 6)."""
LEAST_SHARE = 0.5
"""Share of the matches that must be true for LMedS: beyond it the median is that of false ones."""


@dataclass(frozen=True)
class Matched:
    """The matches of a pair: rows of the keypoints, and where they lie.

    rows: (n, 2). first, second: (n, 2) pixels. units: how many pixels of each photo one was at
    which features were looked for.
    """

    rows: NDArray[np.uint32]
    first: NDArray[np.float64]
    second: NDArray[np.float64]
    units: tuple[float, float]
    seed: int


@dataclass(frozen=True)
class Verified:
    """What a pair is. F and H lead from the first photo to the second, in pixels."""

    verdict: Verdict
    fundamental: NDArray[np.float64] | None
    homography: NDArray[np.float64] | None
    inliers: NDArray[np.bool_]


def verify_pairs(
    path: Path, pairs: Sequence[tuple[int, int]], options: MatchOptions, seed: int
) -> None:
    """Verify matched pairs of the engine's database, and write what they are to it."""
    with pycolmap.Database.open(path) as database:
        cameras, points = _photos(database, {image for pair in pairs for image in pair})
        matched = []
        for first, second in pairs:
            rows = np.asarray(database.read_matches(first, second), dtype=np.uint32).reshape(-1, 2)
            matched.append(
                Matched(
                    rows,
                    points[first][rows[:, 0]],
                    points[second][rows[:, 1]],
                    (_unit(cameras[first], options), _unit(cameras[second], options)),
                    _seed_of(seed, first, second),
                )
            )
        judge = by_magsac if options.epipolar == "magsac" else by_lmeds
        for pair, own, found in zip(pairs, matched, judge(matched), strict=True):
            geometry = _geometry(own, found, [cameras[n] for n in pair], [points[n] for n in pair])
            database.write_two_view_geometry(*pair, geometry)


def by_lmeds(matched: Sequence[Matched]) -> list[Verified]:
    """Least median of squares, then Huber's weights; all cores at once."""
    sizes = [len(own.rows) for own in matched]
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    verdicts, models, _, inliers = _core.judge_pairs(
        np.concatenate([own.first / own.units[0] for own in matched]),
        np.concatenate([own.second / own.units[1] for own in matched]),
        offsets,
        np.array([own.seed for own in matched], dtype=np.int64),
        draws=DRAWS,
        plane_draws=PLANE_DRAWS,
        seven=False,
        least_px=BAND_PX[0],
        largest_px=BAND_PX[1],
        least_sigma_px=LEAST_SIGMA_PX,
        min_matches=FEWEST,
        min_share=LEAST_SHARE,
    )
    found = []
    for number, own in enumerate(matched):
        verdict: Verdict = verdicts[number]  # type: ignore[assignment]
        kept = inliers[offsets[number] : offsets[number + 1]]
        f, h = (None if np.isnan(m).any() else m for m in models[number].reshape(2, 3, 3))
        found.append(Verified(verdict, *_full_size(own.units, f, h), kept))
    return found


def by_magsac(matched: Sequence[Matched]) -> list[Verified]:
    """MAGSAC++ (Barath and others, CVPR 2020) for both; the criterion between them is ours."""
    return [_magsac(own) for own in matched]


def _magsac(own: Matched) -> Verified:
    none = np.zeros(len(own.rows), dtype=bool)
    if len(own.rows) < FEWEST:
        return Verified("too-few", None, None, none)
    first, second = own.first / own.units[0], own.second / own.units[1]
    cv2.setRNGSeed(own.seed % 2**31)
    f, f_true = _opencv(
        cv2.findFundamentalMat(first, second, cv2.USAC_MAGSAC, MAGSAC_PX, SURE, MOST_DRAWS)
    )
    h, h_true = _opencv(
        cv2.findHomography(first, second, cv2.USAC_MAGSAC, MAGSAC_PX, None, MOST_DRAWS, SURE)
    )
    planar = h is not None
    if f is not None and h is not None:
        planar, *_ = _core.weigh_models(first, second, f, h, f_true, h_true, LEAST_SIGMA_PX)
    kept = h_true if planar else f_true
    if kept.sum() < FEWEST:
        return Verified("too-few", None, None, none)
    return Verified("planar" if planar else "general", *_full_size(own.units, f, h), kept)


def _opencv(found: tuple[Any, Any]) -> tuple[NDArray[np.float64] | None, NDArray[np.bool_]]:
    """A matrix and its inliers; where none was found there is none, or one of another shape."""
    matrix, mask = found
    if matrix is None or mask is None or matrix.shape != (3, 3):
        return None, np.zeros(0, dtype=bool)
    return np.asarray(matrix, dtype=np.float64), np.asarray(mask).ravel().astype(bool)


def _full_size(
    units: tuple[float, float], f: NDArray[np.float64] | None, h: NDArray[np.float64] | None
) -> tuple[NDArray[np.float64] | None, NDArray[np.float64] | None]:
    """F and H between pixels of the photos, of those at the size that was searched."""
    small = [np.diag([1.0 / unit, 1.0 / unit, 1.0]) for unit in units]
    return (
        None if f is None else small[1] @ f @ small[0],
        None if h is None else np.linalg.inv(small[1]) @ h @ small[0],
    )


def essential(
    f: NDArray[np.float64], first: NDArray[np.float64], second: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The essential matrix nearest to F between cameras of calibration matrices (3, 3) (2.26)."""
    left, sizes, right = np.linalg.svd(second.T @ f @ first)
    size = (sizes[0] + sizes[1]) / 2.0
    found: NDArray[np.float64] = left @ np.diag([size, size, 0.0]) @ right
    return found


def _geometry(
    own: Matched,
    found: Verified,
    cameras: Sequence[pycolmap.Camera],
    points: Sequence[NDArray[np.float64]],
) -> pycolmap.TwoViewGeometry:
    """The engine's record; with the pose where both focal lengths are trusted."""
    configurations = pycolmap.TwoViewGeometryConfiguration
    geometry = pycolmap.TwoViewGeometry()
    if found.verdict not in ("general", "planar"):
        geometry.config = configurations.DEGENERATE
        return geometry
    trusted = all(camera.has_prior_focal_length for camera in cameras)
    geometry.F, geometry.H = found.fundamental, found.homography
    geometry.inlier_matches = own.rows[found.inliers]
    if found.verdict == "planar":
        geometry.config = configurations.PLANAR_OR_PANORAMIC
    elif trusted and found.fundamental is not None:
        geometry.config = configurations.CALIBRATED
        geometry.E = essential(
            found.fundamental, *(camera.calibration_matrix() for camera in cameras)
        )
    else:
        geometry.config = configurations.UNCALIBRATED
    if trusted:
        # Tells a plane from a camera that only turned, too.
        pycolmap.estimate_two_view_geometry_pose(
            cameras[0], points[0], cameras[1], points[1], geometry
        )
    return geometry


def _photos(
    database: pycolmap.Database, images: set[int]
) -> tuple[Mapping[int, pycolmap.Camera], Mapping[int, NDArray[np.float64]]]:
    """Camera and keypoints (n, 2; pixels) of photos."""
    cameras, points = {}, {}
    for image in sorted(images):
        cameras[image] = database.read_camera(database.read_image(image).camera_id)
        found = np.asarray(database.read_keypoints(image), dtype=np.float64)
        points[image] = np.ascontiguousarray(found[:, :2])
    return cameras, points


def _unit(camera: pycolmap.Camera, options: MatchOptions) -> float:
    return max(1.0, max(camera.width, camera.height) / options.max_side_px)


def _seed_of(seed: int, first: int, second: int) -> int:
    """The draws of a pair do not depend on which pairs are verified with it."""
    return int(np.random.SeedSequence([seed, first, second]).generate_state(1)[0])
