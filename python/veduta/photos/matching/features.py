"""The features of one photo: SIFT keypoints and descriptors of its upright pixels.

Lowe, Distinctive image features from scale-invariant keypoints (IJCV 2004), with the square roots
of L1-normalised descriptors (Arandjelovic and Zisserman, CVPR 2012), as the engine has it.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.imaging.read import Photo, read_image
from veduta.photos.intake.masks import read_mask, shown_at
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.options import MatchOptions
from veduta.run.atomic import write_bytes

MEMORY_PER_PIXEL = 400
"""Bytes that the search needs per pixel that it looks at (measured: 360, at 1.6 megapixels)."""


MOST_MASKED = 8
"""So many times as many features are looked for, at most, where a mask will drop some."""


@dataclass(frozen=True)
class Features:
    """keypoints: (k, 4) float32, x and y in pixels of the full photo, scale, direction (rad).

    descriptors: (k, 128) uint8.
    """

    keypoints: NDArray[np.float32]
    descriptors: NDArray[np.uint8]


@dataclass(frozen=True)
class FeaturesJob:
    """A photo to search, and the file that its features go to."""

    photo: Path
    options: MatchOptions
    target: Path
    mask: Path | None = None


def run_features(job: FeaturesJob) -> int:
    """Search one photo and keep what was found; the number of keypoints (for a worker)."""
    photo = read_image(job.photo)
    shown = None
    if job.mask is not None:
        height, width = photo.pixels.shape[:2]
        shown = read_mask(job.mask, job.photo.name, (width, height))
    found = find_features(photo, job.options, shown)
    file = io.BytesIO()
    np.savez(file, keypoints=found.keypoints, descriptors=found.descriptors)
    write_bytes(job.target, file.getvalue())
    return len(found.keypoints)


def find_features(
    photo: Photo, options: MatchOptions, shown: NDArray[np.bool_] | None = None
) -> Features:
    """The features of a photo; those of the largest scale where there are too many.

    shown: (h, w) False where a mask hides the photo: what is found there is dropped. The mask is
    not laid over the pixels, for its edges would be features themselves.
    """
    grey = cv2.cvtColor(photo.pixels, cv2.COLOR_RGB2GRAY)
    height, width = grey.shape
    shrink = min(1.0, options.max_side_px / max(width, height))
    if shrink < 1.0:
        size = max(1, round(shrink * width)), max(1, round(shrink * height))
        grey = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    engine = pycolmap.FeatureExtractionOptions()
    engine.use_gpu = False
    engine.num_threads = 1
    engine.sift.max_num_features = options.max_features
    if shown is not None:
        share = max(float(shown.mean()), 1.0 / MOST_MASKED)
        engine.sift.max_num_features = int(options.max_features / share)
    quiet_engine()
    extractor = pycolmap.FeatureExtractor.create(engine, pycolmap.Device.cpu)
    found, descriptors = extractor.extract_from_uint8_array(grey)
    keypoints = pycolmap.keypoints_to_matrix(found)[:, :4].astype(np.float32)
    keypoints[:, 0] *= width / grey.shape[1]
    keypoints[:, 1] *= height / grey.shape[0]
    keypoints[:, 2] /= shrink
    features = Features(keypoints, np.asarray(descriptors.data, dtype=np.uint8))
    return features if shown is None else _unhidden(features, shown, options.max_features)


def _unhidden(features: Features, shown: NDArray[np.bool_], most: int) -> Features:
    """The features that no mask hides; those of the largest scale where there are too many."""
    kept = np.flatnonzero(shown_at(shown, features.keypoints[:, :2]))
    if len(kept) > most:
        scales = features.keypoints[kept, 2]
        kept = np.sort(kept[np.argsort(-scales, kind="stable")[:most]])
    return Features(features.keypoints[kept], features.descriptors[kept])


def read_features(path: Path) -> Features:
    """What `run_features` kept."""
    with np.load(path, allow_pickle=False) as stored:
        return Features(stored["keypoints"], stored["descriptors"])


def memory_of(width_px: int, height_px: int, options: MatchOptions) -> int:
    """Bytes that the search of a photo of this size needs."""
    shrink = min(1.0, options.max_side_px / max(width_px, height_px))
    return int(MEMORY_PER_PIXEL * shrink**2 * width_px * height_px) + 6 * width_px * height_px
