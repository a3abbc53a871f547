"""Holes of the atlas: what no image shows is invented from around, and marked (section 7.3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.atlas import Atlas
from veduta.surfaces import fill_holes


@dataclass(frozen=True)
class TextureFillParameters:
    """reach_m: farther from any texel that was seen nothing is invented: it stays plain."""

    reach_m: float = 4.0
    alike: float = 30.0
    """Ends of a line that differ less (of 255) are joined by interpolation,"""
    calm: float = 12.0
    """where the surroundings of both vary less (standard deviation, of 255)."""
    around_px: int = 9
    around_m: float = 4.5
    """So much about a hole is looked at for what repeats: windows are up to so far apart. Of 2, 3,
    4.5 and 6 m chosen on seed 1 of `benchmarks/drive/made_texture.py`, where 2 m found 1 of 12
    windows again, and 4.5 m 5; 6 m found 7 and took twice as long,"""
    most_hidden: float = 0.45
    """unless more than this share of it is hidden."""
    fewest_px: int = 150
    most_holes: int = 30
    joined_m: tuple[float, float] = (0.6, 0.6)
    """Longest lines of walls that are joined, along the street and upright (m): shorter than
    windows, which a wall's smooth ends would else be joined over. Chosen on seed 20 of
    `benchmarks/drive/synthetic_texture.py`."""
    ground_m: tuple[float, float] = (8.0, 1.0)
    """The same of the ground, whose kerbs go on."""


def fill_texture(
    atlas: Atlas,
    texel_m: float,
    told: Callable[[float], None] = lambda share: None,
    parameters: TextureFillParameters | None = None,
    ground: NDArray[np.bool_] | None = None,
) -> tuple[NDArray[np.uint8], NDArray[np.bool_], NDArray[np.bool_]]:
    """The atlas without holes, (h, w) which texels are invented, and (h, w) which stay plain.

    told: hears how far it is, 0 to 1. ground: (h, w) texels that are of no wall; None: none.
    """
    chosen = parameters or TextureFillParameters()
    if not atlas.seen.any():
        return atlas.pixels, np.zeros_like(atlas.seen), atlas.surface.copy()
    distance = ndimage.distance_transform_edt(~atlas.seen)
    holes = atlas.surface & ~atlas.seen
    invented = holes & (distance * texel_m <= chosen.reach_m)
    plain = holes & ~invented
    level = np.zeros_like(atlas.seen) if ground is None else ground
    pixels, known = atlas.pixels, atlas.seen
    for part, longest_m in ((level, chosen.ground_m), (~level, chosen.joined_m)):
        wanted = invented & part
        pixels, known = _along_lines(pixels, known, wanted, texel_m, longest_m, chosen)
    rest = invented & ~known
    pixels[rest] = _diffused(pixels, known)[rest]
    pixels = _copied(pixels, atlas.seen, rest, texel_m, told, chosen)
    pixels[plain] = np.median(atlas.pixels[atlas.seen], axis=0).astype(np.uint8)
    return np.asarray(pixels, dtype=np.uint8), invented, plain


def _copied(
    pixels: NDArray[np.uint8],
    seen: NDArray[np.bool_],
    holes: NDArray[np.bool_],
    texel_m: float,
    told: Callable[[float], None],
    chosen: TextureFillParameters,
) -> NDArray[np.uint8]:
    """Holes with enough that is seen around them are filled by what repeats there (section 7.3).

    Where most of the surroundings is hidden, too, nothing repeats: those stay diffused.
    """
    result = pixels.copy()
    count, label, boxes, _ = cv2.connectedComponentsWithStats(holes.astype(np.uint8))
    margin = int(chosen.around_m / texel_m)
    order = np.argsort(-boxes[1:count, cv2.CC_STAT_AREA], kind="stable")[: chosen.most_holes] + 1
    for done, number in enumerate(order.tolist()):
        told(done / len(order))
        left, top, width, height, area = boxes[number].tolist()
        if area < chosen.fewest_px:
            break
        rows = slice(max(top - margin, 0), top + height + margin)
        columns = slice(max(left - margin, 0), left + width + margin)
        hole = label[rows, columns] == number
        unknown = ~seen[rows, columns]
        if unknown.mean() > chosen.most_hidden:
            continue
        filled = fill_holes(np.ascontiguousarray(pixels[rows, columns]), unknown).pixels
        result[rows, columns][hole] = filled[hole]
    return result


def _diffused(pixels: NDArray[np.uint8], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """The known texels averaged over ever wider surroundings (a pyramid pulled up and pushed down).

    OpenCV's inpainting draws fans into holes as wide as cars; this is smooth, and far faster.
    """
    weight = [known.astype(np.float32)]
    colour = [pixels.astype(np.float32) * weight[0][..., None]]
    while min(weight[-1].shape) > 2:
        colour.append(np.asarray(cv2.pyrDown(colour[-1]), dtype=np.float32))
        weight.append(np.asarray(cv2.pyrDown(weight[-1]), dtype=np.float32))
    filled = colour[-1] / np.maximum(weight[-1], 1e-6)[..., None]
    for level in range(len(weight) - 2, -1, -1):
        size = (weight[level].shape[1], weight[level].shape[0])
        coarse = cv2.resize(filled, size, interpolation=cv2.INTER_LINEAR)
        share = np.minimum(weight[level] * 2.0, 1.0)[..., None]
        own = colour[level] / np.maximum(weight[level], 1e-6)[..., None]
        filled = share * own + (1.0 - share) * coarse
    return np.clip(filled, 0, 255).astype(np.uint8)


def _along_lines(
    pixels: NDArray[np.uint8],
    seen: NDArray[np.bool_],
    invented: NDArray[np.bool_],
    texel_m: float,
    longest_m: tuple[float, float],
    chosen: TextureFillParameters,
) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """Linear interpolation in smooth surroundings: along rows, then along columns."""
    colour, known = pixels.astype(np.float32), seen.copy()
    for axis, most_m in ((1, longest_m[0]), (0, longest_m[1])):
        # Along the line alone: a kerb is calm along itself.
        size = (chosen.around_px, 1) if axis == 1 else (1, chosen.around_px)
        weight = np.maximum(cv2.blur(known.astype(np.float32), size), 1e-6)
        grey = np.where(known, colour.mean(axis=2), 0.0).astype(np.float32)
        mean = cv2.blur(grey, size) / weight
        square = cv2.blur(grey * grey, size) / weight
        calm = np.sqrt(np.maximum(square - mean**2, 0.0)) < chosen.calm
        wanted = invented & _short_gaps(known, axis, most_m / texel_m)
        colour, known = _interpolated(colour, known, wanted, calm, axis, chosen.alike)
    return np.clip(colour, 0, 255).astype(np.uint8), known


def _short_gaps(known: NDArray[np.bool_], axis: int, longest: float) -> NDArray[np.bool_]:
    """Texels in gaps of a line that are no longer than so many texels."""
    before, after, place = _ends(np.moveaxis(known, axis, 1))
    return np.moveaxis((after - before <= longest) & (place >= 0), 1, axis)


def _ends(
    valid: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Of each texel the last valid one before it (-1: none), the first after it (the length of the
    line: none), and its own place.
    """
    place = np.broadcast_to(np.arange(valid.shape[1]), valid.shape)
    before = np.maximum.accumulate(np.where(valid, place, -1), axis=1)
    after = np.where(valid, place, valid.shape[1])[:, ::-1]
    return before, np.minimum.accumulate(after, axis=1)[:, ::-1], place


def _interpolated(
    colour: NDArray[np.float32],
    known: NDArray[np.bool_],
    invented: NDArray[np.bool_],
    calm: NDArray[np.bool_],
    axis: int,
    alike: float,
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    values = np.moveaxis(colour, axis, 1)
    valid, wanted, smooth = (np.moveaxis(layer, axis, 1) for layer in (known, invented, calm))
    before, after, place = _ends(valid)
    both = wanted & ~valid & (before >= 0) & (after < valid.shape[1])
    line = np.arange(valid.shape[0])[:, None]
    low, high = np.maximum(before, 0), np.minimum(after, valid.shape[1] - 1)
    near, far = values[line, low], values[line, high]
    both &= smooth[line, low] & smooth[line, high]
    both &= np.abs(near - far).max(axis=2) < alike
    share = ((place - before) / np.maximum(after - before, 1))[..., None]
    values = np.where(both[..., None], near + share * (far - near), values).astype(np.float32)
    return np.moveaxis(values, 1, axis), np.moveaxis(valid | both, 1, axis)
