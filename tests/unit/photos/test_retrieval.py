"""Photos that look alike: those that show the same places, on descriptors that are made up."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.photos.matching.retrieval import look_alikes

PHOTOS, PLACES_EACH, STEP, NEIGHBOURS = 40, 300, 60, 4


def write_walk(folder: Path, seed: int = 0) -> list[Path]:
    """Photos along a street of places: each shows 300, of which it shares 240 with the next one.

    A place looks a little different from photo to photo, and a quarter of what is seen is chance.
    """
    rng = np.random.default_rng(seed)
    places = rng.gamma(0.6, 1.0, (PHOTOS * STEP + PLACES_EACH, 128))
    files = []
    for photo in range(PHOTOS):
        seen = places[photo * STEP : photo * STEP + PLACES_EACH]
        seen = seen * rng.lognormal(0.0, 0.25, seen.shape)
        seen[rng.random(len(seen)) < 0.25] = rng.gamma(0.6, 1.0, 128)
        roots = np.sqrt(seen / seen.sum(axis=1, keepdims=True))
        files.append(folder / f"{photo}.npz")
        descriptors = np.clip(np.rint(512 * roots), 0, 255).astype(np.uint8)
        np.savez(files[-1], keypoints=np.zeros((len(seen), 4), np.float32), descriptors=descriptors)
    return files


def test_neighbours_that_overlap_are_found(tmp_path: Path) -> None:
    pairs = look_alikes(write_walk(tmp_path), NEIGHBOURS, seed=0)
    assert pairs == sorted(set(pairs))
    assert all(first < second for first, second in pairs)
    near = {(a, b) for a in range(PHOTOS) for b in range(a + 1, min(a + 3, PHOTOS))}
    assert len(near & set(pairs)) > 0.95 * len(near)


def test_the_same_seed_draws_the_same(tmp_path: Path) -> None:
    files = write_walk(tmp_path)
    assert look_alikes(files, 3, seed=5) == look_alikes(files, 3, seed=5)


@pytest.mark.parametrize("count", [0, 1, 5])
def test_photos_with_few_features(tmp_path: Path, count: int) -> None:
    files = [tmp_path / f"{number}.npz" for number in range(3)]
    for number, file in enumerate(files):
        found = np.random.default_rng(number).integers(0, 200, (count, 128)).astype(np.uint8)
        np.savez(file, keypoints=np.zeros((count, 4), np.float32), descriptors=found)
    assert look_alikes(files, 12, seed=0) == [(0, 1), (0, 2), (1, 2)]
