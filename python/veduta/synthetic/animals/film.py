"""Drawing an animal's tubes over a ground, as footage with noise and grass in front."""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.animals.mottled import Coat

Floats = NDArray[np.float64]
Frames = NDArray[np.uint8]
_SHIFT = 4
_FAT_PX = 0.35
"""So much wider than they ought to be are the discs that OpenCV draws, measured by their areas."""
_SHADE = 0.35
"""How much of its light the ground loses in a shadow."""


@dataclass(frozen=True, eq=False)
class Tube:
    """A chain of joints and how thick it is. joints: (t, n, 2) px, y down. half: (n,) px.

    upright: flat from side to side and seen from there; half is how far it reaches up and down.
    """

    joints: Floats
    half: Floats
    light: float = 1.0
    upright: bool = False


@dataclass(frozen=True, eq=False)
class Filmed:
    """frames: (t, h, w, 3). background: (h, w, 3), with the grass. masks: (t, h, w), without it.

    joints: (t, 2) px by name, y down. down: (t,) by foot, whether it stands. cycle: frames of a
    stride. lengths: px of parts, halves: half thickness (px) at joints.
    """

    frames: Frames
    background: Frames
    masks: NDArray[np.bool_]
    joints: dict[str, Floats]
    cycle: float
    length_px: float
    down: dict[str, NDArray[np.bool_]] = field(default_factory=dict)
    lengths: dict[str, float] = field(default_factory=dict)
    halves: dict[str, float] = field(default_factory=dict)


def film(
    tubes: list[Tube],
    size: tuple[int, int],
    random: np.random.Generator,
    *,
    grass: int = 0,
    shadow: Floats | None = None,
    mottled: bool = False,
) -> tuple[Frames, Frames, NDArray[np.bool_]]:
    """Frames of height and width `size` with tubes over each other in their order; what is behind
    them; and the masks.

    shadow: (2, 3) from a pixel of the animal to where its shadow falls; None: there is none.
    mottled: its coat has spots, which move with it.
    """
    count = len(tubes[0].joints)
    rough = random.normal(150.0, 55.0, (*size, 3)).astype(np.float32)
    ground = cv2.GaussianBlur(rough, (0, 0), 4.0) + np.array([-14.0, 8.0, -22.0], np.float32)
    coat = np.array([112.0, 84.0, 58.0]) * random.uniform(0.5, 1.1)
    blades = _blades(size, grass, random)
    coats = [Coat.drawn(random) if mottled else None for _ in tubes]
    frames = np.empty((count, *size, 3), dtype=np.uint8)
    masks = np.zeros((count, *size), dtype=np.bool_)
    for row in range(count):
        drawn = [_drawn(tube, row, size) for tube in tubes]
        whole = np.maximum.reduce(drawn)
        picture = ground.copy() if shadow is None else ground * _shaded(whole, shadow)
        for tube, mask, spots in zip(tubes, drawn, coats, strict=True):
            share = cv2.GaussianBlur(mask, (0, 0), 0.7)[..., None].astype(np.float32) / 255.0
            own = np.full((*size, 1), tube.light, np.float32)
            if spots is not None:
                own *= spots.on(tube.joints, row, size)[..., None]
            picture = picture * (1.0 - share) + coat.astype(np.float32) * own * share
        masks[row] = whole > 127
        noisy = np.where(blades[..., None] > 0, np.float32(70.0), picture)
        noisy = noisy + random.normal(0.0, 4.0, picture.shape).astype(np.float32)
        frames[row] = np.clip(noisy, 0, 255).astype(np.uint8)
    behind = np.where(blades[..., None] > 0, np.float32(70.0), ground)
    return frames, np.clip(behind, 0, 255).astype(np.uint8), masks


def _drawn(tube: Tube, row: int, size: tuple[int, int]) -> NDArray[np.uint8]:
    mask = np.zeros(size, np.uint8)
    draw = _strips if tube.upright else _discs
    draw(mask, tube.joints[row], tube.half)
    return mask


def _strips(mask: NDArray[np.uint8], joints: Floats, half: Floats) -> None:
    """What lies between the upright lines through each joint and the next one."""
    up = np.stack([np.zeros_like(half), half], axis=1)
    above, below = joints - up, joints + up
    for first in range(len(joints) - 1):
        corners = np.stack([above[first], above[first + 1], below[first + 1], below[first]])
        points = np.round((corners - 0.5) * 2**_SHIFT).astype(np.int32)
        cv2.fillConvexPoly(mask, points, 255, cv2.LINE_8, _SHIFT)


def _shaded(whole: NDArray[np.uint8], shadow: Floats) -> NDArray[np.float32]:
    """(h, w, 1) the share of its light that the ground keeps beside an animal."""
    cast = cv2.warpAffine(whole, shadow, (whole.shape[1], whole.shape[0]))
    soft = cv2.GaussianBlur(cast, (0, 0), 2.0)[..., None].astype(np.float32)
    return np.asarray(1.0 - _SHADE * soft / np.float32(255.0), dtype=np.float32)


def _discs(mask: NDArray[np.uint8], joints: Floats, half: Floats) -> None:
    """Discs along a chain, a third of a pixel from each other at most a radius apart."""
    for first in range(len(joints) - 1):
        way = float(np.linalg.norm(joints[first + 1] - joints[first]))
        steps = max(2, int(way / max(0.25 * float(half[first : first + 2].min()), 0.5)) + 1)
        for share in np.linspace(0.0, 1.0, steps):
            x, y = joints[first] * (1.0 - share) + joints[first + 1] * share
            reach = float(half[first] * (1.0 - share) + half[first + 1] * share)
            centre = (round((x - 0.5) * 2**_SHIFT), round((y - 0.5) * 2**_SHIFT))
            round_px = max(1, round((reach - _FAT_PX) * 2**_SHIFT))
            cv2.circle(mask, centre, round_px, 255, -1, cv2.LINE_8, _SHIFT)


def _blades(size: tuple[int, int], count: int, random: np.random.Generator) -> NDArray[np.uint8]:
    found = np.zeros(size, np.uint8)
    for _ in range(count):
        foot = random.uniform(0.0, size[1])
        tip = foot + random.normal(0.0, 8.0)
        low = (round(foot), size[0] - 1)
        cv2.line(found, low, (round(tip), round(size[0] * random.uniform(0.8, 0.92))), 255, 1)
    return found
