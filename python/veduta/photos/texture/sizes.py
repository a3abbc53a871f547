"""How fine each face's texture is: as the photos show it, within bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from veduta.photos.options import TextureOptions
from veduta.photos.texture.atlas import GUTTER
from veduta.photos.texture.cells import Sights
from veduta.photos.texture.faces import Face

FINEST_M, COARSEST_M = 0.005, 0.2
FINER_SHARE = 0.75
"""Of a face's cells, the best view of so many is as fine as the texture, or coarser."""
MOST_TEXELS = 200_000_000
"""Of all faces together; beyond, all become coarser."""


def fine_m(sights: Sights) -> float:
    """The side of a texel (m) that is as fine as the photos show the face."""
    best = (sights.density * (sights.share() > 0)).max(axis=0)
    shown = best[best > 0]
    if not len(shown):
        return COARSEST_M
    finest = 1.0 / math.sqrt(float(np.quantile(shown, FINER_SHARE)))
    return min(COARSEST_M, max(FINEST_M, finest))


def texel_sizes(
    faces: Sequence[Face], fine: Sequence[float], options: TextureOptions
) -> list[float]:
    """The side of a texel of each face (m), of what `fine_m` says of each."""
    sizes = [one if options.texel_m is None else options.texel_m for one in fine]
    texels = sum(math.prod(face.size_m) / size**2 for face, size in zip(faces, sizes, strict=True))
    coarser = max(1.0, math.sqrt(texels / MOST_TEXELS))
    most_px = options.max_atlas_px - 2 * GUTTER - 1
    return [
        max(coarser * size, max(face.size_m) / most_px)
        for face, size in zip(faces, sizes, strict=True)
    ]
