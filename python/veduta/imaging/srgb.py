"""The transfer curve of sRGB (IEC 61966-2-1)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def linear_of_srgb(values: NDArray[Any]) -> NDArray[Any]:
    """Linear light (0 to 1) of sRGB values (0 to 1), of any shape; the floating type stays."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def srgb_of_linear(light: NDArray[Any]) -> NDArray[Any]:
    """sRGB values (0 to 1) of linear light (0 to 1), of any shape; the floating type stays."""
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
