"""Which photos look alike, by what their features are as a whole.

A vocabulary of words is made of the photos' own descriptors (k-means); a photo is the sums of the
differences of its descriptors to their words, each word's normalised to one length (VLAD: Jegou,
Douze, Schmid and Perez, CVPR 2010; intra-normalisation: Arandjelovic and Zisserman, CVPR 2013).
Nothing is downloaded, and nothing is learnt from other photos.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.matching.features import read_features

WORDS = 64
SAMPLE = 60_000
"""Descriptors of all photos that the words are made of."""
MOST_PER_PHOTO = 3000
"""Descriptors of a photo that are looked at."""
_ROUNDS = 15


def look_alikes(files: Sequence[Path], count: int, seed: int) -> list[tuple[int, int]]:
    """The `count` photos most like each, as pairs of places in `files`, the smaller first.

    files: what `features.run_features` kept. Sorted, without repeats.
    """
    words = _vocabulary(files, seed)
    vectors = np.array([_vlad(_descriptors(file), words) for file in files])
    alike = vectors @ vectors.T
    np.fill_diagonal(alike, -np.inf)
    most = min(count, len(files) - 1)
    nearest = np.argsort(-alike, axis=1, kind="stable")[:, :most]
    rows = np.repeat(np.arange(len(files)), most)
    pairs = np.sort(np.column_stack([rows, nearest.ravel()]), axis=1)
    return [(int(first), int(second)) for first, second in np.unique(pairs, axis=0)]


def _descriptors(file: Path) -> NDArray[np.float32]:
    """(k, 128) of unit length; spread over all where there are many."""
    found = read_features(file).descriptors
    if len(found) > MOST_PER_PHOTO:
        found = found[np.linspace(0, len(found) - 1, MOST_PER_PHOTO).astype(np.int64)]
    values = found.astype(np.float32)
    lengths = np.linalg.norm(values, axis=1, keepdims=True)
    return np.asarray(values / np.maximum(lengths, 1e-6), dtype=np.float32)


def _vocabulary(files: Sequence[Path], seed: int) -> NDArray[np.float32]:
    """(w, 128) the words; fewer than WORDS where there are fewer descriptors."""
    rng = np.random.default_rng(seed)
    share = max(1, SAMPLE // len(files))
    drawn = []
    for file in files:
        found = _descriptors(file)
        drawn.append(found[rng.permutation(len(found))[:share]])
    sample = np.concatenate(drawn)
    if len(sample) <= WORDS:
        return sample
    cv2.setRNGSeed(seed)
    until = (cv2.TERM_CRITERIA_MAX_ITER + cv2.TERM_CRITERIA_EPS, _ROUNDS, 1e-4)
    labels = np.empty((len(sample), 1), dtype=np.int32)
    words = cv2.kmeans(sample, WORDS, labels, until, 1, cv2.KMEANS_PP_CENTERS)[2]
    return np.asarray(words, dtype=np.float32)


def _vlad(descriptors: NDArray[np.float32], words: NDArray[np.float32]) -> NDArray[np.float64]:
    """(w * 128,) of unit length; zero where there are no descriptors."""
    sums = np.zeros(words.shape)
    if len(descriptors) and len(words):
        # The nearest word: |d - w|^2 without |d|^2, which is the same for all words.
        nearest = ((words**2).sum(axis=1) - 2.0 * descriptors @ words.T).argmin(axis=1)
        np.add.at(sums, nearest, descriptors - words[nearest])
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    vector = (sums / np.maximum(lengths, 1e-12)).ravel()
    return np.asarray(vector / max(float(np.linalg.norm(vector)), 1e-12))
