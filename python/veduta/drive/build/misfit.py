"""The correspondence error of section 7.1: how badly an image's pixels fit the background.

Where an image shows the background, the next image shows the same where the background is in it.
What stands before it is elsewhere there: parallax.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.record import Shot


@dataclass(frozen=True)
class MisfitParameters:
    """wide_px: images are compared at this width. reach_px: matches are looked for so far around
    (px of that width). patch_px: odd side of what is compared. better, by: a match farther off must
    cost less than `better` times the nearer one's, and by so much less (of 255): plain surfaces fit
    where they are expected.
    """

    wide_px: int = 640
    reach_px: int = 8
    patch_px: int = 5
    better: float = 0.75
    by: float = 2.0


@dataclass(frozen=True, eq=False)
class Frame:
    """An image of the drive in memory. pixels: (h, w, 3) uint8."""

    shot: Shot
    pixels: NDArray[np.uint8]


def correspondence_error(
    one: Frame,
    depth: NDArray[np.float32],
    beside: Sequence[Frame],
    parameters: MisfitParameters | None = None,
) -> NDArray[np.float32]:
    """(h, w) pixels between where the background should be in the images `beside` and what looks
    alike there, the most of them; NaN where there is no background or none of them sees it.

    depth: (h, w) of the background (m). Instead of one patch after the other, the image beside is
    warped by the background, moved by each offset within reach, and compared as a whole.
    """
    chosen = parameters or MisfitParameters()
    height, width = depth.shape
    share = min(1.0, chosen.wide_px / width)
    size = (max(int(round(width * share)), 1), max(int(round(height * share)), 1))
    small = _smaller(one.pixels, size)
    near = np.asarray(cv2.resize(depth, size, interpolation=cv2.INTER_NEAREST), dtype=np.float32)
    error = np.full((size[1], size[0]), np.nan, dtype=np.float32)
    for other in beside:
        warped, shown = _as_seen_from(one.shot, near, other, size)
        off = np.where(shown, _offset(small, warped, chosen), np.nan).astype(np.float32)
        error = np.fmax(error, off)
    grown = cv2.resize(error, (width, height), interpolation=cv2.INTER_NEAREST)
    return np.where(np.isfinite(depth), grown / share, np.nan).astype(np.float32)


def _smaller(pixels: NDArray[np.uint8], size: tuple[int, int]) -> NDArray[np.uint8]:
    """An image at a size, its dark parts spread: differences in the shade count as those in light."""
    table = np.rint(np.sqrt(np.arange(256) / 255.0) * 255.0).astype(np.uint8)
    smaller = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
    return np.asarray(cv2.LUT(smaller, table), dtype=np.uint8)


def _as_seen_from(
    shot: Shot, depth: NDArray[np.float32], other: Frame, size: tuple[int, int]
) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """Another image's view of the background at an image's pixels, and which of them it shows."""
    scale = np.array([size[0] / shot.width_px, size[1] / shot.height_px])
    focal, centre = np.array(shot.focal_px) * scale, np.array(shot.centre_px) * scale
    across = (np.arange(size[0]) + 0.5 - centre[0]) / focal[0]
    down = (np.arange(size[1]) + 0.5 - centre[1]) / focal[1]
    ray = np.stack(np.broadcast_arrays(across[None], down[:, None], 1.0), axis=2)
    known = np.isfinite(depth)
    local = ray * np.where(known, depth, 1.0)[..., None]
    world = local @ shot.world_from_cam[:3, :3].T + shot.world_from_cam[:3, 3]
    pixels, away = other.shot.project(world.reshape(-1, 3))
    there = np.array([other.pixels.shape[1], other.pixels.shape[0]])
    shrunk = _smaller(other.pixels, size)
    at = (pixels * (np.array(size) / there) - 0.5).reshape(*depth.shape, 2)
    shown = known & (away.reshape(depth.shape) > 1.0) & (at >= 0.0).all(axis=2)
    shown &= (at[..., 0] <= size[0] - 1) & (at[..., 1] <= size[1] - 1)
    maps = np.where(shown[..., None], at, 0.0).astype(np.float32)
    warped = cv2.remap(
        shrunk, np.ascontiguousarray(maps[..., 0]), np.ascontiguousarray(maps[..., 1]),
        cv2.INTER_LINEAR,
    )  # fmt: skip
    return np.asarray(warped, dtype=np.uint8), shown


def _offset(
    image: NDArray[np.uint8], warped: NDArray[np.uint8], chosen: MisfitParameters
) -> NDArray[np.float32]:
    """(h, w) how far from each pixel of the warped image lies what looks most alike (px)."""
    reach = chosen.reach_px
    around = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1).T
    length = np.hypot(around[:, 0], around[:, 1])
    order = np.lexsort((around[:, 1], around[:, 0], length))
    wide = cv2.copyMakeBorder(image, reach, reach, reach, reach, cv2.BORDER_REPLICATE)
    height, width = image.shape[:2]
    patch = (chosen.patch_px, chosen.patch_px)
    least = np.full((height, width), np.inf, dtype=np.float32)
    offset = np.zeros((height, width), dtype=np.float32)
    for row in order[length[order] <= reach].tolist():
        down, right = around[row] + reach
        moved = wide[down : down + height, right : right + width]
        unlike = cv2.transform(cv2.absdiff(moved, warped), np.full((1, 3), 1.0 / 3.0))
        cost = cv2.blur(unlike.astype(np.float32), patch)
        better = cost < np.minimum(chosen.better * least, least - chosen.by)
        offset[better] = length[row]
        least = np.where(better, cost, least)
    return offset
