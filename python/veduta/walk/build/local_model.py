"""A local model (section 3.2): what a key position shows, and how far away it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.features import Features, find_features
from veduta.walk.build.marks import Marks, find_marks
from veduta.walk.build.screen import Points, Screen
from veduta.walk.build.sky import find_sky
from veduta.walk.build.stereo import StereoSettings, carried_over, match_stereo, smoothed
from veduta.walk.rig import Image, Rig, StereoPair

SKY_M = 2000.0
"""Where the sky is put; nothing that stereo sees is as far."""
FARTHEST_M = 1000.0


@dataclass(frozen=True, eq=False)
class LocalModel:
    """L = (X, Y, Z, I, dom): the maps follow from the depth and the screen.

    image: (h, w, 3). depth_m: (h, w) float32 without gaps. measured: (h, w), the valid domain: where
    stereo is sure; elsewhere depth was carried over from around. sky: (h, w). front: of a mosaic,
    the view in whose camera's frame it is.
    """

    key: str
    screen: Screen
    image: Image
    depth_m: NDArray[np.float32]
    measured: NDArray[np.bool_]
    sky: NDArray[np.bool_]
    front: LocalModel | None = None

    @property
    def plane(self) -> LocalModel:
        """The model on a plane in whose frame this one is: itself, or a mosaic's front view."""
        return self if self.front is None else self.front

    @cached_property
    def points(self) -> Points:
        """(h, w, 3) X, Y, Z in the camera's frame (m)."""
        return self.screen.points(self.screen.pixels, self.depth_m)

    @cached_property
    def grey(self) -> NDArray[np.float32]:
        """(h, w) light, 0..255."""
        return cv2.cvtColor(self.image, cv2.COLOR_RGB2GRAY).astype(np.float32)

    @cached_property
    def features(self) -> Features:
        """By which it is matched with others."""
        return find_features(self.grey, self.sky)

    @cached_property
    def marks(self) -> Marks:
        """Where water and grass are seen."""
        return find_marks(self.image, self.points, self.measured, self.sky, self.screen)


def build_local_model(
    pair: StereoPair, rig: Rig, settings: StereoSettings = StereoSettings()
) -> LocalModel:
    """Section 3.2: stereo, filters, and the maps of the left camera."""
    found = match_stereo(pair.left, pair.right, rig, settings)
    sky = find_sky(pair.left, found.left - np.float32(rig.shift_px))
    nearest_px = rig.focal_px[0] * rig.baseline_m / FARTHEST_M
    disparity = np.maximum(found.filled - rig.shift_px, nearest_px)
    depth = rig.focal_px[0] * rig.baseline_m / disparity
    depth = np.where(sky, SKY_M, depth).astype(np.float32)
    measured = np.isfinite(found.left) & ~sky
    return LocalModel(pair.key, Screen.of(rig), pair.left, depth, measured, sky)


def model_of_depth(
    key: str, image: Image, depth_m: NDArray[np.float32], sure: NDArray[np.bool_], rig: Rig
) -> LocalModel:
    """The same from a depth (h, w) that was found otherwise; sure: (h, w) where it is believed."""
    stereo_m = rig.focal_px[0] * rig.baseline_m
    disparity = np.where(sure, stereo_m / np.maximum(depth_m, 1e-6), np.nan).astype(np.float32)
    kept = smoothed(disparity)
    sky = find_sky(image, kept)
    filled = np.maximum(carried_over(kept, image), stereo_m / FARTHEST_M)
    depth = np.where(sky, SKY_M, stereo_m / filled).astype(np.float32)
    return LocalModel(key, Screen.of(rig), image, depth, np.isfinite(kept) & ~sky, sky)
