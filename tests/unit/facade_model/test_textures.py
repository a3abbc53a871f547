"""The atlas: what each layer shows, what is marked as invented, and where metres lie in it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from sample_document import FACADE_M, PHOTO_PX, element, sample_document, sample_photo

from veduta.facade.document import FacadeDocument
from veduta.facade.photo_masks import BORDER_PX, PixelBox, seen_mask
from veduta.facade.textures import LONGEST_PX, Atlas, make_atlas
from veduta.place.builder import UvMap

BALCONY = element("balcony", 3.0, 6.0, 3.0, 1.0)


def atlas_of(document: FacadeDocument) -> Atlas:
    return make_atlas(document, sample_photo(document), FACADE_M[1])


def look_up(atlas: Atlas, uv: UvMap, x_m: float, z_m: float) -> tuple[NDArray[np.uint8], bool]:
    """The nearest texel at a place on the facade, and whether it is invented."""
    u, v = uv(np.array([[x_m, 0.0, z_m]]))[0]
    height, width = atlas.texture.invented.shape
    row, column = int(v * height), int(u * width)
    return atlas.texture.pixels[row, column], bool(atlas.texture.invented[row, column])


def test_photo_layer_shows_the_pixel_of_the_photo() -> None:
    document = sample_document()
    photo, atlas = sample_photo(document), atlas_of(document)
    rng = np.random.default_rng(3)
    for x_m, z_m in rng.uniform((0.1, 0.1), (11.9, 14.9), (200, 2)):
        column = int(document.facade.x_px + x_m / document.scale.metres_per_px)
        bottom = document.facade.y_px + document.facade.height_px
        row = int(bottom - z_m / document.scale.metres_per_px)
        texel, invented = look_up(atlas, atlas.photo_uv, x_m, z_m)
        assert np.array_equal(texel, photo[row, column])
        assert not invented


def test_railing_is_on_the_railing_and_not_on_the_wall() -> None:
    atlas = atlas_of(sample_document(elements=[BALCONY]))
    seen, seen_invented = look_up(atlas, atlas.photo_uv, 4.5, 6.5)
    behind, behind_invented = look_up(atlas, atlas.surface_uv, 4.5, 6.5)
    assert seen.mean() < 70
    assert behind.mean() > 170
    assert (seen_invented, behind_invented) == (False, True)


def test_wall_away_from_balconies_is_not_invented() -> None:
    atlas = atlas_of(sample_document(elements=[BALCONY]))
    for x_m, z_m in ((1.0, 6.5), (4.5, 9.0), (4.5, 4.0)):
        assert not look_up(atlas, atlas.surface_uv, x_m, z_m)[1]


def test_colours_are_those_of_the_classes() -> None:
    colours = atlas_of(sample_document()).colours
    np.testing.assert_allclose(colours.wall, np.array([214, 199, 172]) / 255, atol=0.02)
    np.testing.assert_allclose(colours.balcony, np.array([40, 40, 44]) / 255, atol=0.04)


def test_long_photos_shrink_to_the_limit() -> None:
    document = sample_document(facade_m=(12.0, 15.0))
    tall = 6000
    scale = document.scale.model_copy(update={"metres_per_px": 15.0 / tall})
    facade = document.facade.model_copy(
        update={"x_px": 0.0, "y_px": 0.0, "width_px": 400.0, "height_px": float(tall)}
    )
    large = document.model_copy(update={"facade": facade, "scale": scale})
    photo = np.full((tall, 400, 3), 128, dtype=np.uint8)
    texture = make_atlas(large, photo, 15.0).texture
    assert max(texture.invented.shape) == LONGEST_PX
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
    mask = seen_mask(document, box)
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
    photo[~seen_mask(document, PixelBox(0, 0, *PHOTO_PX))] = 0
    atlas = make_atlas(document, photo, FACADE_M[1])
    assert atlas.texture.pixels.max(axis=2).min() > 60
    assert atlas.texture.invented.any()
    assert atlas.colours.wall[0] == pytest.approx(214 / 255, abs=0.02)
