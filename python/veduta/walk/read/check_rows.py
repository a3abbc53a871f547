"""Whether the rows of a rectified pair lie on one another, and the left picture is the left one."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from veduta.run.errors import InputError
from veduta.walk.rig import PairFiles, Rig, StereoPair


@dataclass(frozen=True)
class RowLimits:
    """off_px: the median distance of matches from their row, beyond which a calibration is refused
    (a row is matched with itself, so stereo breaks at about one pixel). fewest: matches for a
    judgement. swapped: share of matches left of where infinity is, beyond which the pictures were
    exchanged. noise_px: of a match.
    """

    off_px: float = 1.5
    fewest: int = 25
    swapped: float = 0.8
    noise_px: float = 1.0


@dataclass(frozen=True)
class Rows:
    """matches: how many were found. off_px: their median distance from their row. backwards: the
    share whose disparity is negative; both NaN without enough matches.
    """

    matches: int
    off_px: float
    backwards: float


def check_rows(pair: StereoPair, rig: Rig, limits: RowLimits = RowLimits()) -> Rows:
    """Match features of the two pictures, wherever they are, and look at how they lie."""
    features = cv2.ORB.create(2000)
    points, descriptors = zip(
        *(
            features.detectAndCompute(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY), None)
            for image in (pair.left, pair.right)
        ),
        strict=True,
    )
    nothing = Rows(0, float("nan"), float("nan"))
    if any(one is None or len(one) < limits.fewest for one in descriptors):
        return nothing
    found = cv2.BFMatcher(cv2.NORM_HAMMING, crossCheck=True).match(*descriptors)
    good = [one for one in found if one.distance < 40]
    if len(good) < limits.fewest:
        return nothing
    left = np.array([points[0][one.queryIdx].pt for one in good])
    right = np.array([points[1][one.trainIdx].pt for one in good])
    disparity = left[:, 0] - right[:, 0] - rig.shift_px
    off = np.abs(left[:, 1] - right[:, 1])
    near = off < max(4.0 * float(np.median(off)), limits.noise_px)
    backwards = float((disparity[near] < -limits.noise_px).mean())
    return Rows(len(good), float(np.median(off)), backwards)


def require_rows(
    pair: StereoPair, rig: Rig, files: PairFiles, limits: RowLimits = RowLimits()
) -> Rows:
    """The same; InputError where the pictures were exchanged, or the calibration does not fit."""
    rows = check_rows(pair, rig, limits)
    if rows.matches == 0:
        return rows
    if rows.off_px > limits.off_px:
        raise InputError(
            files.left,
            f"does not lie row on row with {files.right.name}: matches are {rows.off_px:.1f} px off"
            " their rows after rectification",
            "The calibration is not that of these pictures: calibrate the two cameras again.",
        )
    if rows.backwards > limits.swapped:
        raise InputError(
            files.left,
            f"seems to be the right picture: {rows.backwards:.0%} of its matches in"
            f" {files.right.name} lie on the wrong side",
            "Exchange the folders of the left and the right pictures.",
        )
    return rows
