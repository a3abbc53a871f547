"""The textures: what each shows, what is marked as invented, and where metres lie in them."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from sample_document import FACADE_M, PHOTO_PX, element, sample_document, sample_photo

from veduta.facade.document import FacadeDocument
from veduta.facade.photo_masks import BORDER_PX, PixelBox, seen_mask
from veduta.facade.textures import USUAL, FacadeTextures, make_textures
from veduta.place.material import Texture

BALCONY = element("balcony", 3.0, 6.0, 3.0, 1.0)


def textures_of(document: FacadeDocument, top_m: float = FACADE_M[1]) -> FacadeTextures:
    return make_textures(document, sample_photo(document), top_m)


def look_up(
    textures: FacadeTextures, texture: Texture, x_m: float, z_m: float
) -> tuple[NDArray[np.uint8], bool]:
    """The nearest texel at a place on the facade, and whether it is invented."""
    height, width = texture.invented.shape
    column = int((x_m - textures.left_m) / textures.width_m * width)
    row = int((1.0 - (z_m - textures.foot_m) / textures.height_m) * height)
    return texture.pixels[row, column], bool(texture.invented[row, column])


@pytest.mark.parametrize("shift_px", [0.0, 0.3, -0.7])
def test_the_front_shows_the_pixel_of_the_photo(shift_px: float) -> None:
    document = sample_document()
    moved = {"x_px": document.facade.x_px + shift_px, "y_px": document.facade.y_px + shift_px}
    document = document.model_copy(update={"facade": document.facade.model_copy(update=moved)})
    photo, textures = sample_photo(document), textures_of(document)
    rng = np.random.default_rng(3)
    for x_m, z_m in rng.uniform((0.1, 0.1), (11.9, 14.9), (200, 2)):
        column = int(document.facade.x_px + x_m / document.scale.metres_per_px)
        bottom = document.facade.y_px + document.facade.height_px
        row = int(bottom - z_m / document.scale.metres_per_px)
        texel, invented = look_up(textures, textures.front, x_m, z_m)
        assert np.array_equal(texel, photo[row, column])
        assert not invented


def test_railing_is_on_the_railing_and_not_on_the_wall() -> None:
    textures = textures_of(sample_document(elements=[BALCONY]))
    seen, seen_invented = look_up(textures, textures.front, 4.5, 6.5)
    behind, behind_invented = look_up(textures, textures.wall, 4.5, 6.5)
    assert seen.mean() < 70
    assert behind.mean() > 170
    assert (seen_invented, behind_invented) == (False, True)


def test_wall_away_from_balconies_is_not_invented() -> None:
    textures = textures_of(sample_document(elements=[BALCONY]))
    for x_m, z_m in ((1.0, 6.5), (4.5, 9.0), (4.5, 4.0)):
        assert not look_up(textures, textures.wall, x_m, z_m)[1]


def test_colours_are_those_of_the_classes() -> None:
    colours = textures_of(sample_document()).colours
    np.testing.assert_allclose(colours.wall, np.array([214, 199, 172]) / 255, atol=0.02)
    np.testing.assert_allclose(colours.balcony, np.array([40, 40, 44]) / 255, atol=0.04)


def test_what_rises_over_the_photo_takes_its_border_and_is_invented() -> None:
    document = sample_document()
    over_m = 10.0  # the photo has 4.5 m above the eaves
    textures = textures_of(document, FACADE_M[1] + over_m)
    border, invented = look_up(textures, textures.front, 6.0, FACADE_M[1] + over_m - 0.1)
    assert invented
    assert np.array_equal(border, sample_photo(document)[0, int(20.0 + 6.0 / 0.025)])
    assert not look_up(textures, textures.front, 6.0, FACADE_M[1] + 4.0)[1]
    assert textures.height_m == pytest.approx(FACADE_M[1] + over_m, abs=0.03)


@pytest.mark.parametrize("top_m", [15.0, 1000.0])
def test_long_photos_shrink_to_the_limit(top_m: float) -> None:
    document = sample_document(facade_m=(12.0, 15.0))
    tall = 6000
    scale = document.scale.model_copy(update={"metres_per_px": 15.0 / tall})
    facade = document.facade.model_copy(
        update={"x_px": 0.0, "y_px": 0.0, "width_px": 400.0, "height_px": float(tall)}
    )
    large = document.model_copy(update={"facade": facade, "scale": scale})
    photo = np.full((tall, 400, 3), 128, dtype=np.uint8)
    texture = make_textures(large, photo, top_m).front
    assert max(texture.invented.shape) == USUAL.longest_px
    assert texture.pixels.shape[:2] == texture.invented.shape


def tilted(document: FacadeDocument) -> FacadeDocument:
    homography = [[1.1, 0.1, -30.0], [0.05, 1.2, -60.0], [1e-4, 3e-4, 1.0]]
    update = {"rectified_from_source": homography, "method": "corners"}
    return document.model_copy(
        update={"rectification": document.rectification.model_copy(update=update)}
    )


def test_what_the_source_does_not_show_is_found_pixel_by_pixel() -> None:
    document = tilted(sample_document())
    box = PixelBox(0, 0, PHOTO_PX[0], PHOTO_PX[1])
    mask = seen_mask(document, box, sample_photo(document))
    back = np.linalg.inv(np.array(document.rectification.rectified_from_source))
    rng = np.random.default_rng(5)
    for column, row in rng.integers((0, 0), PHOTO_PX, (400, 2)):
        x, y, w = back @ np.array([column + 0.5, row + 0.5, 1.0])
        inside = (
            BORDER_PX <= x / w <= document.source.width_px - BORDER_PX
            and BORDER_PX <= y / w <= document.source.height_px - BORDER_PX
        )
        assert mask[row, column] == inside
    assert 0.2 < mask.mean() < 0.99


def test_what_the_source_does_not_show_is_painted_and_marked() -> None:
    document = tilted(sample_document(elements=[]))
    photo = sample_photo(document)
    photo[~seen_mask(document, PixelBox(0, 0, *PHOTO_PX), photo)] = 0
    textures = make_textures(document, photo, FACADE_M[1])
    for texture in (textures.front, textures.wall):
        assert texture.pixels.max(axis=2).min() > 60
        assert texture.invented.any()
    assert textures.colours.wall[0] == pytest.approx(214 / 255, abs=0.02)


def test_a_corner_that_an_earlier_rectification_left_is_filled_and_marked() -> None:
    document = sample_document(elements=[])
    photo = sample_photo(document)
    width, height = PHOTO_PX
    corner = np.array([[0, height], [0, height // 2], [width // 4, height]], np.int32)
    cv2.fillConvexPoly(photo, corner, (0, 0, 0))
    textures = make_textures(document, photo, FACADE_M[1])
    for texture in (textures.front, textures.wall):
        assert texture.pixels.max(axis=2).min() > 60
        _, invented = look_up(textures, texture, 0.2, 1.0)
        assert invented
