"""How near a rendering comes to a photo: PSNR and SSIM where both show a building."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.place.part import Part
from veduta.synthetic.camera import Camera
from veduta.synthetic.scene import RayScene

_WINDOW_PX, _DEVIATION_PX = 11, 1.5
_C1, _C2 = 0.01**2, 0.03**2
_SAME_M = 0.1
SAMPLES = 2


@dataclass(frozen=True)
class Rendered:
    """light: (h, w, 3) linear, of the textures as they are. depth_m: (h, w), NaN in the open."""

    light: NDArray[np.float64]
    depth_m: NDArray[np.float64]


def render_parts(parts: Sequence[Part], camera: Camera) -> Rendered:
    """Textured parts (each about the origin) without any light of their own."""
    scene = RayScene([(part, np.eye(4)) for part in parts])
    height, width = camera.height_px, camera.width_px
    light = np.zeros((height * width, 3))
    for x in range(SAMPLES):
        for y in range(SAMPLES):
            offset = ((x + 0.5) / SAMPLES, (y + 0.5) / SAMPLES)
            hits = scene.cast(*_rays(camera, offset))
            light[hits.ray] += scene.surface(hits)[0] / SAMPLES**2
    return Rendered(light.reshape(height, width, 3), depth_of(scene, camera))


def depth_of(scene: RayScene, camera: Camera) -> NDArray[np.float64]:
    """(h, w) along the optical axis through the pixels' middles."""
    hits = scene.cast(*_rays(camera, (0.5, 0.5)))
    depth = np.full(camera.height_px * camera.width_px, np.nan)
    depth[hits.ray] = hits.distance
    return depth.reshape(camera.height_px, camera.width_px)


def _rays(
    camera: Camera, offset: tuple[float, float]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    x, y = np.meshgrid(
        np.arange(camera.width_px) + offset[0], np.arange(camera.height_px) + offset[1]
    )
    rays = camera.rays(np.column_stack([x.ravel(), y.ravel()])).astype(np.float32)
    origins = np.broadcast_to(camera.position_m.astype(np.float32), rays.shape)
    return np.ascontiguousarray(origins), rays


def compared_px(rendered: Rendered, truth: RayScene, camera: Camera) -> NDArray[np.bool_]:
    """(h, w) where the photo shows the surface that the rendering shows."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.abs(rendered.depth_m - depth_of(truth, camera)) < _SAME_M)


def exposed(
    light: NDArray[np.float64], photo: NDArray[np.uint8], where: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """The rendering as sRGB (0..1) in the exposure of the photo: the gain per channel that fits.

    A held-back photo has an exposure of its own that no texture can know.
    """
    wanted = linear_of_srgb(photo[where] / 255.0)
    own = light[where]
    gain = (wanted * own).sum(axis=0) / np.maximum((own * own).sum(axis=0), 1e-9)
    found: NDArray[np.float64] = srgb_of_linear(np.clip(light * gain, 0.0, 1.0))
    return found


def psnr(
    first: NDArray[np.float64], second: NDArray[np.float64], where: NDArray[np.bool_]
) -> float:
    """Peak signal to noise ratio (dB) of two pictures (0..1)."""
    return float(-10.0 * np.log10(max(1e-12, ((first - second)[where] ** 2).mean())))


def ssim(
    first: NDArray[np.float64], second: NDArray[np.float64], where: NDArray[np.bool_]
) -> float:
    """Structural similarity of the luma, mean over `where` (Wang et al. 2004: 11 x 11, 1.5 px).

    Elsewhere both are set to the first: what lies beside is not compared.
    """
    weights = np.array([0.299, 0.587, 0.114])
    one, other = first @ weights, second @ weights
    other = np.where(where, other, one)

    def mean(values: NDArray[np.float64]) -> NDArray[np.float64]:
        size = (_WINDOW_PX, _WINDOW_PX)
        return np.asarray(cv2.GaussianBlur(values, size, _DEVIATION_PX), dtype=np.float64)

    a, b = mean(one), mean(other)
    aa, bb, ab = mean(one * one) - a * a, mean(other * other) - b * b, mean(one * other) - a * b
    found = (2 * a * b + _C1) * (2 * ab + _C2) / ((a * a + b * b + _C1) * (aa + bb + _C2))
    return float(found[where].mean())
