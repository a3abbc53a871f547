"""Disparities of a rectified pair: semi-global matching, checked from right to left, and filtered."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.rig import Image, Rig

_SIXTEENTHS = 16.0


@dataclass(frozen=True)
class StereoSettings:
    """Of OpenCV's StereoSGBM (Hirschmueller 2008).

    nearest: depth of the nearest surface that is looked for, in baselines. block_px: of the cost.
    most: disparities at most. check_px: how far left and right may disagree. speckle_px: smaller
    pieces are noise. median_px, sigma_px: of the two filters of section 3.2. smoothness, edge: of
    the weighted least squares (Min et al. 2014) that carry disparities into rows that have none;
    evenness: the same, of those that even what was carried over gaps. nearer: share of the sure
    pixels near the end of the search from which it is done again, twice as far.
    """

    nearest: float = 10.0
    block_px: int = 5
    most: int = 256
    check_px: float = 1.25
    speckle_px: int = 60
    median_px: int = 5
    sigma_px: float = 1.0
    smoothness: float = 4000.0
    evenness: float = 100.0
    edge: float = 1.2
    nearer: float = 0.004


@dataclass(frozen=True, eq=False)
class Disparities:
    """left: (h, w) float32, NaN where nothing is sure. filled: the same without gaps."""

    left: NDArray[np.float32]
    filled: NDArray[np.float32]


def match_stereo(
    left: Image, right: Image, rig: Rig, settings: StereoSettings = StereoSettings()
) -> Disparities:
    """Section 3.2: the disparity (px, left x minus right x) of each pixel of the left picture."""
    count = _disparities(rig, settings)
    found = _checked(left, right, rig, settings, count)
    if _is_short(found, rig, settings, count):
        found = _checked(left, right, rig, settings, _longer(count, rig, settings))
    sure = smoothed(found, settings)
    return Disparities(sure, carried_over(sure, left, settings))


def _checked(
    left: Image, right: Image, rig: Rig, settings: StereoSettings, count: int
) -> NDArray[np.float32]:
    """(h, w) disparities among `count`, NaN where left and right disagree."""
    lowest = int(np.floor(rig.shift_px))
    matcher = cv2.StereoSGBM.create(
        minDisparity=lowest, numDisparities=count, blockSize=settings.block_px,
        P1=8 * 3 * settings.block_px**2, P2=32 * 3 * settings.block_px**2, disp12MaxDiff=-1,
        uniquenessRatio=5, speckleWindowSize=settings.speckle_px, speckleRange=1, preFilterCap=31,
        mode=cv2.STEREO_SGBM_MODE_SGBM_3WAY,
    )  # fmt: skip
    padded = [_padded(image, count + lowest) for image in (left, right)]
    forth = matcher.compute(*padded)[:, count + lowest :]
    flipped = [_padded(np.ascontiguousarray(image[:, ::-1]), count + lowest) for image in (right, left)]
    back = matcher.compute(*flipped)[:, count + lowest :][:, ::-1]
    nothing = (lowest - 1) * _SIXTEENTHS
    disparity = np.where(forth > nothing, forth / _SIXTEENTHS, np.nan).astype(np.float32)
    other = np.where(back > nothing, back / _SIXTEENTHS, np.nan).astype(np.float32)
    return _agreed(disparity, other, settings.check_px)


def _is_short(
    found: NDArray[np.float32], rig: Rig, settings: StereoSettings, count: int
) -> bool:
    """Whether surfaces go on beyond the nearest depth that was looked for."""
    if _longer(count, rig, settings) <= count or not np.isfinite(found).any():
        return False
    with np.errstate(invalid="ignore"):
        near = found - np.float32(rig.shift_px) > 0.9 * count
    return bool(near.sum() > settings.nearer * np.isfinite(found).sum())


def _longer(count: int, rig: Rig, settings: StereoSettings) -> int:
    most = int(min(settings.most, rig.width_px / 3.0)) // 16 * 16
    return max(count, min(2 * count, most))


def _disparities(rig: Rig, settings: StereoSettings) -> int:
    """How many are looked for: a multiple of 16."""
    nearest = rig.focal_px[0] / settings.nearest
    wanted = min(nearest, settings.most, rig.width_px / 3.0)
    return max(16, int(np.ceil(wanted / 16.0)) * 16)


def _padded(image: Image, columns: int) -> Image:
    """With grey columns on the left: what lies there is outside of the right picture."""
    return cv2.copyMakeBorder(image, 0, 0, max(0, columns), 0, cv2.BORDER_REPLICATE)  # type: ignore[return-value]


def _agreed(
    left: NDArray[np.float32], right: NDArray[np.float32], limit_px: float
) -> NDArray[np.float32]:
    """What the right picture's disparity leads back from."""
    rows, columns = np.indices(left.shape)
    target = np.round(columns - np.nan_to_num(left)).astype(np.int64)
    inside = (target >= 0) & (target < left.shape[1])
    seen = right[rows, np.clip(target, 0, left.shape[1] - 1)]
    with np.errstate(invalid="ignore"):
        agree = inside & (np.abs(seen - left) <= limit_px)
    return np.where(agree, left, np.nan).astype(np.float32)


def smoothed(
    disparity: NDArray[np.float32], settings: StereoSettings = StereoSettings()
) -> NDArray[np.float32]:
    """A median against spurious values, then a Gaussian that does not reach over edges of depth."""
    known = np.isfinite(disparity)
    filled = np.where(known, disparity, 0.0).astype(np.float32)
    median = cv2.medianBlur(filled, settings.median_px)
    kept = known & (np.abs(median - filled) < 2.0)
    median = np.where(kept, median, 0.0).astype(np.float32)
    size = 2 * int(np.ceil(2.0 * settings.sigma_px)) + 1
    smooth = cv2.bilateralFilter(median, size, 0.8, settings.sigma_px)
    return np.where(kept, smooth, np.nan).astype(np.float32)


def carried_over(
    disparity: NDArray[np.float32], guide: Image, settings: StereoSettings = StereoSettings()
) -> NDArray[np.float32]:
    """Carried over gaps: a gap is mostly what one eye alone sees, behind what is beside it.

    So it is as far as the farther of the sure pixels next to it in its row. Rows without any are
    filled by weighted least squares along the picture's edges.
    """
    known = np.isfinite(disparity)
    if not known.any():
        return np.zeros_like(disparity)
    behind = farther_beside(disparity, known)
    if not np.isfinite(behind).all():
        behind = np.where(np.isfinite(behind), behind, _spread(disparity, known, guide, settings))
    # Rows know nothing of each other: a light smoothing along the picture takes the streaks away.
    smoother = cv2.ximgproc.createFastGlobalSmootherFilter(
        guide, settings.evenness, settings.edge * 10.0
    )
    even = smoother.filter(behind.astype(np.float32))
    return np.where(known, disparity, even).astype(np.float32)


def farther_beside(
    disparity: NDArray[np.float32], known: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """(h, w) the lesser of the nearest known ones to the left and the right; NaN without any."""
    columns = np.arange(disparity.shape[1])
    rows = np.arange(len(disparity))[:, None]
    last = np.maximum.accumulate(np.where(known, columns, -1), axis=1)
    back = np.where(known, columns, len(columns))[:, ::-1]
    following = np.minimum.accumulate(back, axis=1)[:, ::-1]
    before = np.where(last >= 0, disparity[rows, np.maximum(last, 0)], np.nan)
    end = np.minimum(following, len(columns) - 1)
    after = np.where(following < len(columns), disparity[rows, end], np.nan)
    return np.fmin(before, after).astype(np.float32)


def _spread(
    disparity: NDArray[np.float32],
    known: NDArray[np.bool_],
    guide: Image,
    settings: StereoSettings,
) -> NDArray[np.float32]:
    """Weighted least squares of what is known, over the whole picture."""
    smoother = cv2.ximgproc.createFastGlobalSmootherFilter(
        guide, settings.smoothness, settings.edge * 10.0
    )
    weight = known.astype(np.float32)
    carried = smoother.filter(np.where(known, disparity, 0.0).astype(np.float32))
    share = smoother.filter(weight)
    middle = float(np.nanmedian(disparity))
    return np.where(share > 1e-4, carried / np.maximum(share, 1e-4), middle).astype(np.float32)
