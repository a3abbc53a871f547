"""Materials: a colour, or a texture whose invented pixels are marked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Colour = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Texture:
    """An image that several surfaces share through UV; two of the same pixels are two.

    pixels: (h, w, 3) uint8 sRGB.
    invented: (h, w) bool, True where a pixel was synthesised and not photographed.
    cut: whether one sees through where it is invented: nothing is known to be there.
    """

    pixels: NDArray[np.uint8]
    invented: NDArray[np.bool_]
    cut: bool = False

    def __post_init__(self) -> None:
        height, width = self.pixels.shape[:2]
        if self.pixels.shape != (height, width, 3) or self.pixels.dtype != np.uint8:
            raise ValueError(f"texture must be (h, w, 3) uint8, not {self.pixels.shape}")
        if self.invented.shape != (height, width) or self.invented.dtype != np.bool_:
            raise ValueError(f"mask must be ({height}, {width}) bool, not {self.invented.shape}")


@dataclass(frozen=True)
class Material:
    """How a surface looks.

    colour: sRGB, 0..1; it multiplies the texture where there is one (white leaves it alone).
    roughness, metalness: glTF's, 0..1.
    opacity: 0..1; below 1 one sees through it (glass).
    glow: 0..1; the share of its colour that it gives off by itself (a lamp's glass).
    unlit: whether it is seen as it is, whatever light falls on it (a picture of far away).
    two_sided: whether it is seen from behind, too (leaves on a sheet).
    """

    name: str
    colour: Colour = (1.0, 1.0, 1.0)
    roughness: float = 0.9
    metalness: float = 0.0
    texture: Texture | None = None
    opacity: float = 1.0
    glow: float = 0.0
    unlit: bool = False
    two_sided: bool = False
