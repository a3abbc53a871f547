"""The textures made by code: their sizes, their borders, their colours."""

from __future__ import annotations

import zlib

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.grammar.surfaces.bonds import random_lengths, running
from veduta.grammar.surfaces.canvas import MOST_PX, Canvas
from veduta.grammar.surfaces.catalogue import (
    PREFIX,
    SURFACES,
    mean_colour,
    painted,
    sizes_m,
    texture_names,
)
from veduta.grammar.textures import WHITE, Textures, mean_light
from veduta.grammar.tile_pictures import picture_files
from veduta.run.errors import InputError

Pixels = NDArray[np.uint8]


def seam(picture: Pixels, axis: int) -> float:
    """How much more neighbours differ across the border than anywhere within; below 1 unseen."""
    rows = np.moveaxis(picture.astype(np.float64), axis, 0)
    within = np.abs(np.diff(rows, axis=0)).mean(axis=(1, 2))
    return float(np.abs(rows[0] - rows[-1]).mean() / within.max())


@pytest.mark.parametrize("name", texture_names())
def test_a_texture_is_what_the_catalogue_says(name: str) -> None:
    picture = painted(name)
    width, height = sizes_m()[name]
    assert picture.dtype == np.uint8
    assert max(picture.shape[:2]) == MOST_PX
    # Pixels are square, so that nothing is stretched where it lies in metres.
    assert picture.shape[1] / width == pytest.approx(picture.shape[0] / height, rel=3e-3)
    light = mean_light(Textures({})[name].pixels)
    np.testing.assert_allclose(light, mean_colour(name), atol=0.008)
    [content] = picture_files({name: name}, [(name, WHITE)]).values()
    assert len(content) < 180_000


@pytest.mark.parametrize("name", texture_names())
def test_borders_meet(name: str) -> None:
    picture = painted(name)
    assert seam(picture, 0) < 1.05
    assert seam(picture, 1) < 1.05


@pytest.mark.parametrize("name", ["slate", "plaster", "stone"])
def test_a_texture_cut_anywhere_has_a_seam(name: str) -> None:
    """That the measure of the test before sees seams."""
    picture = painted(PREFIX + name)
    cut = picture[: picture.shape[0] * 5 // 7, : picture.shape[1] * 5 // 7]
    assert max(seam(cut, 0), seam(cut, 1)) > 1.05


def test_what_textures_are_made_with_wraps() -> None:
    """Moved by any way, each tool gives what it gave, moved: no border is special."""
    canvas = Canvas((2.0, 1.0), 4)
    field = canvas.noise(0.4, 0.02)
    moved = np.roll(field, (71, -113), axis=(0, 1))
    tools = (
        lambda f: canvas.lit(f, 0.01),
        lambda f: canvas.blurred(f, 0.05),
        lambda f: canvas.hollow(f, 0.05, 1.0),
    )
    for tool in tools:
        again = np.roll(tool(field), (71, -113), axis=(0, 1))
        np.testing.assert_allclose(tool(moved), again, atol=1e-5)
    bricks = running(canvas, 8, 4, jitter=0.1)
    step = bricks.right[:, 0] - bricks.right[:, -1]
    # From the last column to the first, the brick goes on by a pixel, or another begins.
    goes_on = np.isclose(step, canvas.px_m, atol=1e-5)
    assert (goes_on == (bricks.number[:, 0] == bricks.number[:, -1])).all()
    assert goes_on.any()


@pytest.mark.parametrize("name", [name for name in texture_names() if "glass" not in name])
def test_no_blotch_is_seen_to_repeat(name: str) -> None:
    """Quarters of a texture are nearly equally bright; a pane of glass shows the sky once."""
    picture = painted(name).astype(np.float64).mean(axis=2)
    rows, columns = (n // 4 * 4 for n in picture.shape)
    blocks = picture[:rows, :columns].reshape(4, rows // 4, 4, columns // 4).mean(axis=(1, 3))
    assert blocks.std() / blocks.mean() < 0.035


@pytest.mark.parametrize("name", ["ashlar", "clay-tile", "shingles"])
def test_the_same_seed_paints_the_same(name: str) -> None:
    surface = SURFACES[name]
    seed = zlib.crc32((PREFIX + name).encode())
    again = surface.paint(Canvas(surface.size_m, seed))
    assert np.array_equal(again, painted(PREFIX + name))
    assert not np.array_equal(surface.paint(Canvas(surface.size_m, seed + 1)), again)


def test_an_unknown_name_has_a_hint() -> None:
    with pytest.raises(InputError, match="Did you mean `builtin/textures/ashlar`"):
        mean_colour("builtin/textures/aslar")
    with pytest.raises(InputError, match=r"docs/textures\.md"):
        painted("textures/qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq")


def test_pieces_of_a_bond_fill_the_canvas() -> None:
    canvas = Canvas((2.0, 1.0), 3)
    bricks = running(canvas, 8, 4)
    assert bricks.count == 32
    np.testing.assert_allclose(bricks.width, 0.25, atol=1e-6)
    np.testing.assert_allclose(bricks.height, 0.25, atol=1e-6)
    areas = np.bincount(bricks.number.ravel()) * canvas.px_m**2
    np.testing.assert_allclose(areas, 0.0625, atol=1e-9)
    # Every other course is shifted by half a brick: 0.125 m.
    assert bricks.right[-1, 0] == pytest.approx(canvas.px_m / 2, abs=1e-6)
    assert bricks.right[-100, 0] == pytest.approx(0.125 + canvas.px_m / 2, abs=1e-6)


def test_joints_keep_clear_of_those_below() -> None:
    canvas = Canvas((2.88, 2.88), 1)
    stones = random_lengths(canvas, [0.36] * 8, 0.6, 1.0)
    starts = [np.flatnonzero(np.diff(line) != 0) for line in stones.number[20::64]]
    for above, below in zip(starts[:-1], starts[1:], strict=True):
        assert np.abs(above[:, None] - below).min() * canvas.px_m > 0.08
    for own in (stones.right, stones.up):
        assert own.min() >= 0.0
    assert (stones.right <= stones.width + 1e-5).all()
    assert (stones.up <= stones.height + 1e-5).all()


def test_noise_has_no_feature_larger_than_it_is_told() -> None:
    canvas = Canvas((4.0, 4.0), 2)
    field = canvas.noise(0.5, 0.05)
    assert abs(float(field.mean())) < 1e-5
    assert float(field.std()) == pytest.approx(1.0, abs=1e-4)
    power = np.abs(np.fft.rfft2(field)) ** 2
    waves = np.hypot(np.fft.fftfreq(512, 4.0 / 512)[:, None], np.fft.rfftfreq(512, 4.0 / 512))
    assert power[waves < 1.99].sum() / power.sum() < 1e-9
