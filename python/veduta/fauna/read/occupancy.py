"""How well a figure covers silhouettes, and how that changes when its joints move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Cover:
    """loss: (t,) squared difference for the silhouette's area. by_joint: (t, j, 2) and by_deep:
    (t, j) its gradients.
    """

    loss: Floats
    by_joint: Floats
    by_deep: Floats


def cover(
    figure: Figure, joints: Floats, deep: Floats, pixels: Singles, shares: Singles,
    weights: Singles, soft: float,
) -> Cover:  # fmt: skip
    """Soft occupancy of tapered capsules against silhouettes.

    joints: (t, j, 2). deep: (j,) half of the thickness. pixels: (p, 2) the places that are looked
    at, shares: (t, p) how much of each the silhouette has, weights: (p,) how much it counts, soft:
    how wide an edge is; all in one unit. Capsules are joined as what is in none: 1 - prod(1 - o),
    so every one of them feels every pixel that is near to it.
    """
    start, end = figure.start, figure.end
    count, joint_count = joints.shape[:2]
    loss = np.zeros(count)
    by_joint = np.zeros((count, joint_count, 2))
    by_deep = np.zeros((count, joint_count))
    first, last = deep[start].astype(np.float32), deep[end].astype(np.float32)
    for row in range(count):
        a = joints[row, start].astype(np.float32)
        along = joints[row, end].astype(np.float32) - a
        size = np.maximum((along**2).sum(axis=1), 1e-9)
        x = pixels[None, :, 0] - a[:, 0, None]
        y = pixels[None, :, 1] - a[:, 1, None]
        t = np.clip((x * along[:, 0, None] + y * along[:, 1, None]) / size[:, None], 0.0, 1.0)
        x -= t * along[:, 0, None]
        y -= t * along[:, 1, None]
        far = np.sqrt(x * x + y * y) + 1e-6
        apart = (far - first[:, None] - t * (last - first)[:, None]) / soft
        inside = 1.0 / (1.0 + np.exp(np.clip(apart, -20.0, 20.0)))
        empty = np.prod(1.0 - inside, axis=0)
        error = 1.0 - empty - shares[row]
        area = max(float(shares[row].sum()), 1.0)
        loss[row] = float((weights * error * error).sum()) / area
        # By the distance: occupancy falls by (1 - occupancy) * inside / soft.
        pull = inside * (-2.0 / (soft * area) * weights * error * empty)[None, :]
        near = pull * (1.0 - t)
        x *= 1.0 / far
        y *= 1.0 / far
        far_share = pull - near
        for joint, weight in ((start, near), (end, far_share)):
            np.add.at(by_deep[row], joint, -weight.sum(axis=1))
            np.add.at(by_joint[row, :, 0], joint, -(weight * x).sum(axis=1))
            np.add.at(by_joint[row, :, 1], joint, -(weight * y).sum(axis=1))
    return Cover(loss, by_joint, by_deep)
