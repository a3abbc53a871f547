"""A drawn animal that turns round: flat, and narrower as it is seen from its end."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from veduta.synthetic.animals.film import Filmed

_NARROWEST = 0.2
"""Of its length, an animal is wide."""


def turned_round(film: Filmed, first: int, last: int) -> Filmed:
    """The film of an animal that turns between two frames and goes back the way it came.

    The legs that were the near ones stay so: what is drawn is its one side.
    """
    count, (height, width) = len(film.frames), film.masks.shape[1:]
    share = np.clip((np.arange(count) - first) / (last - first), 0.0, 1.0)
    squeeze = np.cos(np.pi * share)
    sign = np.where(squeeze < 0.0, -1.0, 1.0)
    squeeze = sign * np.maximum(np.abs(squeeze), _NARROWEST)
    middle = np.mean([at[:, 0] for at in film.joints.values()], axis=0)
    turn = float(middle[(first + last) // 2])
    there = np.where(sign > 0.0, middle, 2.0 * turn - middle)
    frames, masks = np.empty_like(film.frames), np.empty_like(film.masks)
    for row in range(count):
        shift = there[row] - squeeze[row] * middle[row]
        matrix = np.array([[squeeze[row], 0.0, shift], [0.0, 1.0, 0.0]])
        # Pixels' middles lie at halves.
        matrix[0, 2] += 0.5 * squeeze[row] - 0.5
        own = cv2.warpAffine(
            film.masks[row].astype(np.float32), matrix, (width, height), flags=cv2.INTER_LINEAR
        )
        picture = cv2.warpAffine(film.frames[row], matrix, (width, height), flags=cv2.INTER_LINEAR)
        masks[row] = own > 0.5
        soft = np.asarray(own)[..., None]
        mixed = film.background * (1.0 - soft) + picture * soft
        frames[row] = np.clip(mixed, 0, 255).astype(np.uint8)
    joints = {
        name: np.stack([there + squeeze * (at[:, 0] - middle), at[:, 1]], axis=1)
        for name, at in film.joints.items()
    }
    return replace(film, frames=frames, masks=masks, joints=joints)
