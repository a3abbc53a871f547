"""Files of pixels, read back by OpenCV."""

from __future__ import annotations

import cv2
import numpy as np
from PIL import Image

from veduta.imaging.encode import jpeg_bytes, mask_bytes, png_bytes

PIXELS = cv2.resize(
    np.random.default_rng(0).integers(0, 256, (6, 8, 3), dtype=np.uint8), (160, 120)
).astype(np.uint8)


def read(data: bytes) -> np.ndarray:
    found = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    assert found is not None
    return found[..., ::-1] if found.ndim == 3 else found


def test_png_is_exact() -> None:
    for data in (png_bytes(PIXELS), png_bytes(Image.fromarray(PIXELS), optimize=True)):
        assert data.startswith(b"\x89PNG")
        assert np.array_equal(read(data), PIXELS)
    assert len(png_bytes(PIXELS, compress_level=0)) > len(png_bytes(PIXELS))


def test_jpeg_is_as_good_as_asked() -> None:
    errors = [
        np.abs(read(jpeg_bytes(PIXELS, quality)).astype(float) - PIXELS).mean()
        for quality in (20, 90)
    ]
    assert errors[1] < 3.0 < errors[0]
    full = read(jpeg_bytes(PIXELS, 90, subsampling=0)).astype(float)
    assert np.abs(full - PIXELS).mean() < errors[1]


def test_masks_have_a_bit_per_pixel() -> None:
    mask = PIXELS[..., 0] > 100
    data = mask_bytes(mask)
    assert data[24] == 1, "bits per sample, in the header"
    assert np.array_equal(read(data) > 0, mask)
