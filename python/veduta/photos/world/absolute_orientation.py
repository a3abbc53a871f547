"""Absolute orientation: the similarity between corresponding points (equations 2.29 to 2.33).

Closed, by singular values (Umeyama 1991): least squares in scale, rotation and shift. The thesis's
(2.32), T = Ymean - R Xmean, drops the scale; the shift here is Ymean - s R Xmean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.photos.world.georeference import Similarity


def absolute_orientation(model: NDArray[np.float64], world: NDArray[np.float64]) -> Similarity:
    """The similarity that takes (n, 3) of the model nearest to (n, 3) of the world, n >= 3."""
    mean, target = model.mean(axis=0), world.mean(axis=0)
    about, to = model - mean, world - target
    left, values, right = np.linalg.svd(to.T @ about)
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = (left * sign) @ right
    scale = float((values * sign).sum() / (about**2).sum())
    return Similarity(scale, rotation, target - scale * rotation @ mean)


def similarity_jacobian(arm: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3n, 7) of places by the logarithm of scale, the rotation about the world's axes and the
    shift; arm: (n, 3) places less the centre, turned and scaled.
    """
    count = len(arm)
    x, y, z = arm.T
    zero = np.zeros(count)
    turned = np.stack(
        [
            np.column_stack([zero, z, -y]),
            np.column_stack([-z, zero, x]),
            np.column_stack([y, -x, zero]),
        ],
        axis=1,
    )
    shift = np.broadcast_to(np.eye(3), (count, 3, 3))
    return np.concatenate([arm[:, :, None], turned, shift], axis=2).reshape(3 * count, 7)
