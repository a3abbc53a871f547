"""Straight line segments of a photo."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography
from veduta.geometry.homography import Matrix, Points

DETECTION_SIDE_PX = 1200
"""Photos are reduced to this side first: enough for 0.1 degree, and a quarter of the time."""

MIN_LENGTH_PART = 0.0125
"""Shortest segment as a part of the photo's diagonal: shorter ones have no direction."""


@dataclass(frozen=True)
class Segments:
    """(n, 2) float64 ends in photo pixels."""

    start: Points
    end: Points

    def __len__(self) -> int:
        return len(self.start)

    def midpoints(self) -> Points:
        """(n, 2) midpoints."""
        return (self.start + self.end) / 2.0

    def lengths(self) -> NDArray[np.float64]:
        """(n,) lengths in pixels."""
        return np.asarray(np.linalg.norm(self.end - self.start, axis=1))

    def directions(self) -> Points:
        """(n, 2) unit vectors."""
        return (self.end - self.start) / np.maximum(self.lengths(), 1e-12)[:, None]

    def select(self, mask: NDArray[np.bool_]) -> Segments:
        """Those where the mask is True."""
        return Segments(self.start[mask], self.end[mask])

    def centred(self, size_px: tuple[int, int]) -> Segments:
        """From the middle of a photo of (width, height), in parts of its diagonal."""
        middle, diagonal = np.array(size_px) / 2, float(np.hypot(*size_px))
        return Segments((self.start - middle) / diagonal, (self.end - middle) / diagonal)

    def mapped(self, target_from_source: Matrix) -> Segments:
        """The segments through a homography (all must lie on one side of its horizon)."""
        start = homography.apply(target_from_source, self.start)
        return Segments(start, homography.apply(target_from_source, self.end))


def joined(first: Segments, second: Segments) -> Segments:
    """The segments of both."""
    return Segments(np.vstack([first.start, second.start]), np.vstack([first.end, second.end]))


def detect_segments(
    pixels: NDArray[np.uint8],
    shortest_part: float = MIN_LENGTH_PART,
    longest_side_px: int = DETECTION_SIDE_PX,
) -> Segments:
    """Segments of (h, w, 3) sRGB pixels by LSD (von Gioi et al. 2010, as in OpenCV).

    Left out: segments shorter than `shortest_part` of the diagonal, and segments along the
    image's own border (frames, letter boxes). Images are first reduced to `longest_side_px`.
    """
    height, width = pixels.shape[:2]
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    shrink = min(1.0, longest_side_px / max(height, width))
    if shrink < 1.0:
        size = (max(1, round(width * shrink)), max(1, round(height * shrink)))
        grey = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    found = np.array(cv2.createLineSegmentDetector(cv2.LSD_REFINE_STD).detect(grey)[0])
    if found.size < 4:  # OpenCV gives None for no segments
        return Segments(np.zeros((0, 2)), np.zeros((0, 2)))
    # OpenCV puts the centre of the upper left pixel at (0, 0).
    ends = (found.astype(np.float64).reshape(-1, 2, 2) + 0.5) / shrink
    segments = Segments(ends[:, 0], ends[:, 1])
    shortest = shortest_part * float(np.hypot(height, width))
    keep = (segments.lengths() >= shortest) & ~_on_border(segments, width, height, longest_side_px)
    return segments.select(keep)


def _on_border(
    segments: Segments, width: int, height: int, longest_side_px: int
) -> NDArray[np.bool_]:
    margin = 3.0 * max(1.0, max(width, height) / longest_side_px)
    ends = np.stack([segments.start, segments.end])
    x, y = ends[..., 0], ends[..., 1]
    on_any = np.zeros(len(segments), dtype=np.bool_)
    for beyond in (x < margin, x > width - margin, y < margin, y > height - margin):
        on_any |= beyond.all(axis=0)
    return on_any
