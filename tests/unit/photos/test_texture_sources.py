"""Textures are as fine as the photos themselves, and not as the studio's pictures of them."""

from __future__ import annotations

import numpy as np
import pycolmap
from painted_wall import box_part, city_of

from veduta.photos.options import TextureOptions
from veduta.photos.structure import Structure
from veduta.photos.texture.recipe import texture_model
from veduta.photos.texture.sources import views_of
from veduta.synthetic.camera import look_at

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 2400, 800, 2400.0
AWAY_M = 14.4
"""A pixel is 6 mm of the wall; in a picture of 1600 px it would be 9."""
STRIPE_PX = 2


def one_photo() -> tuple[Structure, np.ndarray]:
    """A photo of a wall of upright stripes, each of two pixels; radial distortion."""
    camera = pycolmap.Camera(
        camera_id=1,
        model="SIMPLE_RADIAL",
        width=WIDTH_PX,
        height=HEIGHT_PX,
        params=[FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2, -0.03],
    )
    pose = look_at((3.0, -AWAY_M, 1.5), (3.0, 0.0, 1.5), (WIDTH_PX, HEIGHT_PX), FOCAL_PX)
    x, y = np.meshgrid(np.arange(WIDTH_PX) + 0.5, np.arange(HEIGHT_PX) + 0.5)
    local = camera.cam_from_img(np.column_stack([x.ravel(), y.ravel()]))
    stripes = np.floor(local[:, 0] * FOCAL_PX / STRIPE_PX).astype(int) % 2
    pixels = np.where(stripes, 200, 60).astype(np.uint8).reshape(HEIGHT_PX, WIDTH_PX)
    none = np.zeros(0, dtype=np.int64)
    structure = Structure(
        cameras={1: camera},
        camera_of={1: 1},
        image_ids=(1,),
        names=("photo",),
        cam_from_world=pose.cam_from_world[None, :3],
        keypoints_px=(np.zeros((0, 2)),),
        points=np.zeros((0, 3)),
        colours=np.zeros((0, 3), dtype=np.uint8),
        image_of=none,
        keypoint_of=none,
        point_of=none,
    )
    return structure, np.repeat(pixels[..., None], 3, axis=2)


def test_a_texture_is_as_sharp_as_the_photo() -> None:
    structure, pixels = one_photo()
    city = city_of(box_part("house", (0.0, 0.0, 0.0), (6.0, 4.0, 3.0)))
    model = texture_model(views_of(structure, lambda _: pixels), city, TextureOptions())
    (texture,) = [one for _, one in next(model.buildings).faces if one is not None]
    metres_px = AWAY_M / FOCAL_PX
    assert 0.95 * metres_px < texture.texel_m < 1.05 * metres_px
    # Two samples a stripe: of the contrast of 140 most is left, and at 1600 px it would be a fifth.
    middle = texture.pixels[200:300, 300:700, 0].astype(float)
    assert np.quantile(middle, 0.9) - np.quantile(middle, 0.1) > 70
