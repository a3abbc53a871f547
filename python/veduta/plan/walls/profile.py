"""What lies across a wall, by the median of many places along it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from veduta.plan.walls.pieces import Piece


def profile_across(
    piece: Piece, ink: NDArray[np.float32], across_px: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n,) of the (h, w) ink at distances from the centre line, to the right of the piece.

    What touches the wall in some places does not count; its ends are left out.
    """
    trim = min(0.5 * piece.thickness_px, 0.2 * piece.length_px)
    count = int(np.clip(piece.length_px / 2, 5, 200))
    along = np.linspace(trim, piece.length_px - trim, count)
    points = piece.arc.at(along[:, None], across_px[None, :])
    # The centre of the upper left pixel is (0.5, 0.5).
    flat = points.reshape(-1, 2).T[::-1] - 0.5
    values = map_coordinates(ink, flat, order=1, mode="nearest", prefilter=False)
    found: NDArray[np.float64] = np.median(
        values.reshape(count, len(across_px)).astype(np.float64), axis=0
    )
    return found
