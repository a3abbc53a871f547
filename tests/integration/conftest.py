"""Photos for the real command line that need no outside data, and what it makes of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from command_line import facade
from photo_scene import write_photos
from PIL import Image
from sample_document import sample_document, sample_photo


@pytest.fixture(scope="session")
def photos(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Four small photos of facades, drawn here."""
    folder = tmp_path_factory.mktemp("photos")
    paths = [folder / f"house{number}.png" for number in range(4)]
    for seed, path in enumerate(paths):
        photo = Image.fromarray(sample_photo(sample_document(), seed=seed))
        photo.resize((260, 400), Image.Resampling.LANCZOS).save(path)
    return paths


@pytest.fixture(scope="session")
def photo(photos: list[Path]) -> Path:
    """One of them."""
    return photos[0]


def _made(folder: Path, photos: list[Path]) -> Path:
    done = facade(*photos, "-o", folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture(scope="session")
def one_house(tmp_path_factory: pytest.TempPathFactory, photo: Path) -> Path:
    """The result of the one photo, which no test may change."""
    return _made(tmp_path_factory.mktemp("one") / "out", [photo])


@pytest.fixture(scope="session")
def two_houses(tmp_path_factory: pytest.TempPathFactory, photos: list[Path]) -> Path:
    """The result of the first two photos, which no test may change."""
    return _made(tmp_path_factory.mktemp("two") / "out", photos[:2])


@pytest.fixture(scope="session")
def all_houses(tmp_path_factory: pytest.TempPathFactory, photos: list[Path]) -> Path:
    """The result of all photos, which no test may change."""
    return _made(tmp_path_factory.mktemp("all") / "out", photos)


@pytest.fixture(scope="session")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of the photos of `photo_scene.ARC`, which no test may change."""
    folder = tmp_path_factory.mktemp("scene") / "corner with spaces"
    write_photos(folder)
    return folder


@pytest.fixture(scope="session")
def noise(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A photo of nothing."""
    path = tmp_path_factory.mktemp("noise") / "noise.png"
    pixels = np.random.default_rng(7).integers(0, 256, (360, 300, 3), dtype=np.uint8)
    Image.fromarray(pixels).save(path)
    return path


@pytest.fixture(scope="session")
def meadow(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Grass of all sizes below a sky with soft clouds, and a hill between them."""
    path = tmp_path_factory.mktemp("meadow") / "meadow.jpg"
    Image.fromarray(_meadow(np.random.default_rng(11), 480, 640)).save(path, quality=90)
    return path


def _meadow(rng: np.random.Generator, height: int, width: int) -> np.ndarray:
    rows = np.arange(height)[:, None]
    hill = 0.42 * height + 18 * np.sin(np.arange(width) / 90.0)[None, :]
    sky = np.array([150, 185, 225]) + 40 * _clouds(rng, height, width, 5)[:, :, None]
    near = np.clip((rows - hill) / (height - hill), 0, 1)[:, :, None]
    grass = np.array([92, 128, 52]) + 60 * (_clouds(rng, height, width, 1)[:, :, None] - 0.5)
    grass = grass * (1.15 - 0.35 * near) + 28 * near * rng.normal(size=(height, width, 1))
    flowers = (rng.random((height, width, 1)) > 0.997) & (near > 0.1)
    ground = np.where(flowers, np.array([226, 205, 70]), grass)
    return np.clip(np.where((rows < hill)[:, :, None], sky, ground), 0, 255).astype(np.uint8)


def _clouds(rng: np.random.Generator, height: int, width: int, coarse: int) -> np.ndarray:
    """(h, w) smooth noise in 0..1: octaves of random grids, enlarged."""
    total = np.zeros((height, width))
    for octave in range(coarse, 8):
        grid = rng.random((max(2, height >> (8 - octave)), max(2, width >> (8 - octave))))
        image = Image.fromarray((grid * 255).astype(np.uint8))
        total += np.asarray(image.resize((width, height), Image.Resampling.BICUBIC)) / 2.0**octave
    return (total - total.min()) / (np.ptp(total) or 1.0)
