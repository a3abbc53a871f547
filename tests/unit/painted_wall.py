"""A house with a painted front, and pictures of it: the front warped by each homography."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.straight import Pinhole
from veduta.photos.texture.faces import Face, faces_of
from veduta.photos.texture.views import View, plane_view
from veduta.place.builder import PartBuilder
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.camera import look_at

TEXEL_M = 0.02
SKY = (150, 170, 200)


def box_part(name: str, low: tuple[float, ...], high: tuple[float, ...]) -> Part:
    """A box with walls, a roof and a ground; the south wall is two polygons side by side."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    middle = (x0 + x1) / 2
    builder = PartBuilder(name)
    plain = builder.material(Material("plain"))
    walls = [(x0, y0, middle, y0), (middle, y0, x1, y0), (x1, y0, x1, y1)]
    walls += [(x1, y1, x0, y1), (x0, y1, x0, y0)]
    for number, (a, b, c, d) in enumerate(walls):
        feature = builder.feature(SemanticClass.WALL, Provenance.MEASURED, f"wall {number}")
        builder.polygon([[(a, b, z0), (c, d, z0), (c, d, z1), (a, b, z1)]], feature, plain)
    ring = [(x0, y0), (middle, y0), (x1, y0), (x1, y1), (x0, y1)]
    for semantic, height, order in (
        (SemanticClass.ROOF, z1, ring),
        (SemanticClass.GROUND, z0, ring[::-1]),
    ):
        feature = builder.feature(semantic, Provenance.MEASURED, semantic.value)
        builder.polygon([[(x, y, height) for x, y in order]], feature, plain)
    return builder.build()


def city_of(*parts: Part) -> CityModel:
    """Buildings about the origin."""
    buildings = tuple(CityBuilding(part.id, part, (0.0, 0.0, 0.0)) for part in parts)
    return CityModel(buildings, None, (0.0, 0.0, 0.0))


def south(faces: Sequence[Face]) -> Face:
    """The first face that looks south."""
    return next(face for face in faces if face.normal[1] < -0.9)


@dataclass(frozen=True)
class PaintedWall:
    """paint: (150, 300, 3) sRGB of the south front, 6 m by 3 m. gains: of each view's light."""

    city: CityModel
    paint: NDArray[np.uint8]
    views: list[View]
    gains: NDArray[np.float64]


def painted_wall(gains: Sequence[float], *, car: bool = False) -> PaintedWall:
    """A view per gain, side by side before the front; a dark thing stands before part of one."""
    city = city_of(box_part("house", (0.0, 0.0, 0.0), (6.0, 4.0, 3.0)))
    face = south(faces_of(city))
    paint = _paint()
    views = []
    for number, gain in enumerate(gains):
        along = 6.0 * (number + 0.5) / len(gains)
        camera = look_at((along, -6.0, 1.5), (0.5 * along + 1.5, 0.0, 1.5), (480, 360), 330.0)
        pinhole = Pinhole(480, 360, (330.0, 330.0), camera.centre_px)
        pose = camera.cam_from_world[:3]
        pixels = _picture(View("", pinhole, pose, lambda: paint), face, paint, gain)
        if car and number == len(gains) // 2:
            pixels[170:250, 220:300] = (25, 20, 30)
        views.append(View(f"view {number}", pinhole, pose, lambda pixels=pixels: pixels))
    return PaintedWall(city, paint, views, np.asarray(gains))


def _paint() -> NDArray[np.uint8]:
    rng = np.random.default_rng(11)
    sum_ = np.zeros((150, 300, 3), dtype=np.float32)
    for size, weight in ((5, 0.5), (15, 1.0), (50, 0.6)):
        small = rng.standard_normal((150 // size + 2, 300 // size + 2, 3)).astype(np.float32)
        sum_ += weight * cv2.resize(small, (300, 150), interpolation=cv2.INTER_CUBIC)
    return np.clip(120 + 22 * sum_, 40, 190).astype(np.uint8)


def _picture(view: View, face: Face, paint: NDArray[np.uint8], gain: float) -> NDArray[np.uint8]:
    """The paint under the view's homography, its light multiplied; sky around."""
    plane = plane_view(view, face)
    if plane is None:
        raise ValueError("the view does not see the wall")
    texels = np.array([[TEXEL_M, 0, TEXEL_M / 2], [0, TEXEL_M, TEXEL_M / 2], [0, 0, 1]])
    index = np.array([[1, 0, -0.5], [0, 1, -0.5], [0, 0, 1]])
    light = linear_of_srgb(paint / 255.0) * gain
    lit = np.round(255 * srgb_of_linear(np.clip(light, 0, 1))).astype(np.uint8)
    size = (view.camera.width_px, view.camera.height_px)
    found = cv2.warpPerspective(lit, index @ plane.matrix @ texels, size, borderValue=SKY)
    return np.asarray(found, dtype=np.uint8)
