"""What is not of the wall: sky where the model is too high, and things before it."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from painted_wall import SKY, TEXEL_M, box_part, city_of, painted_wall

from veduta.photos.options import TextureOptions
from veduta.photos.texture.cells import Grid, Sights
from veduta.photos.texture.choice import clear_samples
from veduta.photos.texture.compose import FaceTexture
from veduta.photos.texture.faces import faces_of
from veduta.photos.texture.recipe import texture_model
from veduta.photos.texture.views import PlaneView


def front(height_m: float) -> FaceTexture:
    """The painted front, 3 m high, under a model of another height."""
    wall = painted_wall((1.0, 1.0, 1.0, 1.0))
    city = city_of(box_part("house", (0.0, 0.0, 0.0), (6.0, 4.0, height_m)))
    model = texture_model(wall.views, city, TextureOptions(texel_m=TEXEL_M))
    found = [texture for _, texture in next(model.buildings).faces if texture is not None]
    return found[0]


@pytest.mark.parametrize("excess_m", [0.5, 1.5])
def test_sky_above_the_real_wall_is_no_texture(excess_m: float) -> None:
    texture = front(3.0 + excess_m)
    rows = round(excess_m / TEXEL_M)
    above, below = texture.invented[: rows - 3], texture.invented[rows + 8 : rows + 60]
    assert above.mean() > 0.97
    assert below.mean() < 0.03
    off = np.abs(texture.pixels[: rows - 8].astype(int) - SKY).max(axis=-1)
    assert np.median(off) > 25


def test_a_model_of_the_right_height_loses_nothing() -> None:
    texture = front(3.0)
    assert not texture.invented[5:-5, 5:-5].any()


def some_sights(images: np.ndarray) -> Sights:
    """(k, rows S, columns S, 3) uint8 of a face that all views see."""
    k, rows, columns, _ = images.shape
    face = faces_of(city_of(box_part("a", (0, 0, 0), (6, 4, 3))))[0]
    ones = np.ones((k, rows // 4, columns // 4), dtype=np.float32)
    grid = Grid(rows // 4, columns // 4, 0.25)
    planes = (PlaneView(np.eye(3), np.zeros(3)),) * k
    seen = np.ones((k, rows, columns), dtype=np.bool_)
    return Sights(face, grid, np.arange(k), planes, images, seen, 1e4 * ones, ones)


def test_a_leaf_is_unclear_and_a_shifted_edge_is_not() -> None:
    """Windows that views show a sample off, and a thing of 3 x 3 samples in one of them."""
    wall = np.full((40, 60, 3), 170, dtype=np.uint8)
    for x in (10, 30, 45):
        cv2.rectangle(wall, (x, 8), (x + 6, 26), (60, 60, 70), -1)
    images = np.stack([np.roll(wall, shift, axis=1) for shift in (-1, 0, 0, 1)])
    sights = some_sights(images)
    assert clear_samples(sights, (images / 255.0).astype(np.float32)).all()
    images[2, 30:33, 22:25] = (40, 90, 30)
    clear = clear_samples(sights, (images / 255.0).astype(np.float32))
    assert not clear[2, 30:33, 22:25].any()
    assert clear[[0, 1, 3]].all()
    assert (~clear[2]).sum() <= 6 * 6


def test_two_views_have_no_majority() -> None:
    images = np.full((2, 8, 8, 3), 100, dtype=np.uint8)
    images[1, 2:6, 2:6] = 10
    sights = some_sights(images)
    assert clear_samples(sights, (images / 255.0).astype(np.float32)).all()
