"""What a texture is made by: options of the caller, and thresholds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera

Pixels = NDArray[np.uint8]


@dataclass(frozen=True)
class TextureParameters:
    """Thresholds.

    candidates: views that are weighed for a triangle. margin_px: nothing is taken so near to a
    photo's border. steepest: cosine between the surface's normal and the ray below which a view is
    too slanting. hidden: a surface in front hides a point that is so much farther, as a share of
    the distance. smoothing: rounds in which the views' worth is spread to neighbours. seam: what a
    seam along one edge costs; 1 is the worth of the best view. rounds: of choosing. smallest:
    triangles that keep a view of their own. differs: difference from the median of all views (of
    255) at which a view shows something else, which passed by. fewest: views for such a vote.
    padding_px: photo kept around a chart. level_smooth, level_keep: weights of an even correction
    and of none, against 1 for equal colours at seams. level_most: largest correction (of 255).
    """

    candidates: int = 8
    margin_px: float = 2.0
    steepest: float = 0.1
    hidden: float = 0.002
    smoothing: int = 8
    seam: float = 0.25
    rounds: int = 24
    smallest: int = 24
    differs: float = 45.0
    fewest: int = 4
    padding_px: int = 3
    level_smooth: float = 0.3
    level_keep: float = 0.002
    level_most: float = 70.0


@dataclass(frozen=True)
class TextureOptions:
    """largest_px: the atlas's longest side; the texture is made coarser until it fits.

    detail: texels along a pixel of the photo, at most. name: of the material.
    """

    largest_px: int = 4096
    detail: float = 1.0
    name: str = "photographed"
    parameters: TextureParameters = field(default_factory=TextureParameters)


@dataclass(frozen=True, eq=False)
class SurfaceView:
    """A photo that may give texture. camera: without distortion, of the photo's size.

    read: gives (h, w, 3) uint8 sRGB; it is called a few times. hidden: gives (h, w) bool, True
    where the photo shows what is not of the surface.
    """

    camera: Camera
    read: Callable[[], Pixels]
    hidden: Callable[[], NDArray[np.bool_] | None] = lambda: None
