"""What a camera makes of radiance: vignetting, blur, exposure, noise, tone curve, JPEG."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.srgb import srgb_of_linear
from veduta.synthetic.seeds import stream

_FOCAL_LENGTH_35MM = 0xA405
_EXIF_IFD = 0x8769


@dataclass(frozen=True)
class Lens:
    """The faults of a camera.

    blur (px, deviation), vignetting (share lost in the corners), noise (deviation at mid grey,
    share of white), JPEG quality (1..95), exposure (stops off the right one), tint (what the
    white balance multiplies red, green and blue with).
    """

    blur_px: float = 0.45
    vignetting: float = 0.12
    noise: float = 0.006
    quality: int = 92
    exposure: float = 0.0
    tint: tuple[float, float, float] = (1.0, 1.0, 1.0)


def develop(radiance: NDArray[np.float32], lens: Lens, seed: int) -> NDArray[np.uint8]:
    """An sRGB picture (h, w, 3) uint8, exposed so that the brightest tenth is just not white."""
    height, width = radiance.shape[:2]
    y, x = np.indices((height, width), dtype=np.float32)
    radius2 = ((x + 0.5) / width - 0.5) ** 2 + ((y + 0.5) / height - 0.5) ** 2
    light = radiance * (1.0 - lens.vignetting * 2.0 * radius2)[..., None]
    if lens.blur_px > 0:
        light = cv2.GaussianBlur(light, (0, 0), lens.blur_px).astype(np.float32)
    level = light @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    light = light * np.float32(0.62 / max(float(np.percentile(level, 88)), 1e-4))
    light = light * (2.0**lens.exposure * np.array(lens.tint)).astype(np.float32)
    rng = stream(seed, "noise")
    shot = np.sqrt(np.clip(light, 0.0, None) / 0.2 + 0.05)
    light = light + lens.noise * shot * rng.standard_normal(light.shape, dtype=np.float32)
    shoulder = 0.8
    over = np.maximum(light - shoulder, 0.0)
    light = np.minimum(light, shoulder) + (1 - shoulder) * over / (over + (1 - shoulder))
    light = np.clip(light, 0.0, 1.0)
    return np.asarray(np.rint(srgb_of_linear(light) * 255.0), np.uint8)


def encode_jpeg(pixels: NDArray[np.uint8], lens: Lens, focal_mm35: float | None) -> bytes:
    """The bytes of a JPEG file; the focal length goes into its EXIF, as a camera writes it."""
    exif = Image.Exif()
    if focal_mm35 is not None:
        exif.get_ifd(_EXIF_IFD)[_FOCAL_LENGTH_35MM] = round(focal_mm35)
    buffer = BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=lens.quality, subsampling=0, exif=exif)
    return buffer.getvalue()
