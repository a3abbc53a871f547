"""A face's texture at its full size: the chosen photos, levelled and feathered over the seams."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.photos.texture.cells import SAMPLES, Sights
from veduta.photos.texture.choice import Choice
from veduta.photos.texture.halves import level_of
from veduta.photos.texture.nearest import nearest_marked
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.views import warped

FEATHER_M = 0.05
"""Deviation of the blur of the seams; at least `FEATHER_TEXELS`."""
FEATHER_TEXELS = 2.0
NEAR_M = 0.4
"""Over so much of a distance from what was seen its colour fades to that of the face."""
BLUR_M, MOST_BLUR = 0.1, 12.0
"""Deviation of the blur of such colours (m), at most so many texels: else they are streaks."""
RIM_TEXELS = 2
_LEAST_WEIGHT = 1e-3
_LINEAR = linear_of_srgb(np.arange(256) / 255.0)


@dataclass(frozen=True)
class FaceTexture:
    """pixels: (h, w, 3) uint8 sRGB from the face's upper left. invented: (h, w) bool, unseen.

    seen_share: of what lies inside the polygons. views: (rows) the photos that it is made of.
    """

    pixels: NDArray[np.uint8]
    invented: NDArray[np.bool_]
    texel_m: float
    seen_share: float
    views: tuple[int, ...]


def compose(
    sights: Sights,
    choice: Choice,
    offsets: NDArray[np.float32],
    gains: NDArray[np.float64],
    store: PictureStore,
    texel_m: float,
) -> FaceTexture:
    """The texture of a face; texels that no view shows undisturbed are invented."""
    width, height = sights.face.size_m
    shape = (max(1, math.ceil(height / texel_m - 1e-6)), max(1, math.ceil(width / texel_m - 1e-6)))
    sum_ = np.zeros((*shape, 3), dtype=np.float32)
    weight = np.zeros(shape, dtype=np.float32)
    used = []
    for row in _by_use(choice):
        gaps = bool((weight < _LEAST_WEIGHT).any())
        own = _own(choice, row, gaps, shape, sights.grid.cell_m, texel_m)
        if own is None:
            continue
        view = int(sights.views[row])
        seen = store.seen(view, sights.planes[row], shape, texel_m)
        chosen, spare = own
        # Where no chosen view sees a texel the next best steps in, with little weight: it loses to
        # one that is chosen and comes later.
        share = np.where(seen, np.maximum(chosen, spare * (weight < _LEAST_WEIGHT)), 0.0)
        if not share.any():
            continue
        used.append(view)
        colour = _coloured(sights, row, gains, store, shape, texel_m)
        colour += _spread(offsets, choice.label == row, shape, sights.grid.cell_m, texel_m)
        sum_ += share[..., None] * colour
        weight += share.astype(np.float32)
    return _finished(sights, sum_, weight, texel_m, tuple(sorted(used)))


def _by_use(choice: Choice) -> list[int]:
    """The views that are chosen most first, then those that are not, by how good they are."""
    k = len(choice.usable)
    counts = np.bincount(choice.label[choice.label >= 0], minlength=k)
    rank = np.argsort(choice.order, axis=0).mean(axis=(1, 2))
    order: list[int] = np.lexsort((rank, -counts)).tolist()
    return order


def _own(
    choice: Choice,
    row: int,
    gaps: bool,
    shape: tuple[int, int],
    cell_m: float,
    texel_m: float,
) -> tuple[NDArray[np.float32], NDArray[np.float32]] | None:
    """Two weights per texel: as the chosen view, feathered, and as one that may step in."""
    is_chosen = choice.label == row
    if not is_chosen.any() and not (gaps and choice.usable[row].any()):
        return None
    deviation = max(FEATHER_M / texel_m, FEATHER_TEXELS)
    chosen = _enlarged(is_chosen.astype(np.float32), shape, cell_m, texel_m, cv2.INTER_NEAREST)
    if is_chosen.any():
        chosen = np.asarray(cv2.GaussianBlur(chosen, (0, 0), deviation), dtype=np.float32)
    usable = choice.usable[row].astype(np.float32)
    spare = _enlarged(usable, shape, cell_m, texel_m, cv2.INTER_NEAREST)
    clear = choice.clear[row].astype(np.float32)
    spare *= _enlarged(clear, shape, cell_m / SAMPLES, texel_m, cv2.INTER_NEAREST)
    # What is disturbed in this view does not come in by the feather either.
    return chosen * spare, 2 * _LEAST_WEIGHT * spare


def _enlarged(
    cells: NDArray[np.float32], shape: tuple[int, int], cell_m: float, texel_m: float, how: int
) -> NDArray[np.float32]:
    """Values of cells at texels; both grids begin at the face's upper left corner."""
    step = texel_m / cell_m
    move = np.array([[step, 0, 0.5 * step - 0.5], [0, step, 0.5 * step - 0.5]])
    size = (shape[1], shape[0])
    found = cv2.warpAffine(
        cells, move, size, flags=how | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_REPLICATE
    )
    return np.asarray(found, dtype=np.float32).reshape(*shape, *cells.shape[2:])


def _coloured(
    sights: Sights,
    row: int,
    gains: NDArray[np.float64],
    store: PictureStore,
    shape: tuple[int, int],
    texel_m: float,
) -> NDArray[np.float32]:
    """(h, w, 3) levelled sRGB, 0..1 and above, of one view."""
    view = int(sights.views[row])
    seen = sights.share()[row] > 0
    wanted = level_of(float(np.median(sights.density[row][seen])), texel_m)
    level, picture = store.levels(view).at(wanted)
    pixels = warped(picture, sights.planes[row], level, shape, texel_m)
    table = srgb_of_linear(_LINEAR[:, None] * gains[view]).astype(np.float32)
    return np.stack([table[pixels[..., channel], channel] for channel in range(3)], axis=-1)


def _spread(
    offsets: NDArray[np.float32],
    own: NDArray[np.bool_],
    shape: tuple[int, int],
    cell_m: float,
    texel_m: float,
) -> NDArray[np.float32]:
    """The offsets of one view's cells at all texels; beyond them those of the nearest."""
    if not own.any():
        return np.zeros((*shape, 3), dtype=np.float32)
    filled = offsets[own][nearest_marked(own)[0]]
    return _enlarged(filled, shape, cell_m, texel_m, cv2.INTER_LINEAR)


def _finished(
    sights: Sights,
    sum_: NDArray[np.float32],
    weight: NDArray[np.float32],
    texel_m: float,
    used: tuple[int, ...],
) -> FaceTexture:
    seen = _without_rim(weight >= _LEAST_WEIGHT)
    inside = sights.face.inside(weight.shape, texel_m)
    colour = sum_ / np.maximum(weight, 1e-9)[..., None]
    pixels = np.round(np.clip(colour, 0.0, 1.0) * 255.0).astype(np.uint8)
    if seen.any() and not seen.all():
        shown = seen & inside if (seen & inside).any() else seen
        pixels[~seen] = _invented(pixels, seen, shown, texel_m)[~seen]
    share = float((seen & inside).sum() / max(1, int(inside.sum())))
    return FaceTexture(pixels, ~seen, texel_m, share, used)


def _without_rim(seen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """What is seen, but for texels beside what is not: they are mixed with what hides it."""
    square = np.ones((2 * RIM_TEXELS + 1, 2 * RIM_TEXELS + 1), dtype=np.uint8)
    inner = cv2.erode(seen.astype(np.uint8), square, borderValue=1) > 0
    return np.asarray(inner) if inner.any() else seen


def _invented(
    pixels: NDArray[np.uint8], seen: NDArray[np.bool_], shown: NDArray[np.bool_], texel_m: float
) -> NDArray[np.uint8]:
    """The colours beside what was seen, blurred, and fading to that of the face."""
    middle = np.median(pixels[shown], axis=0).astype(np.float32)
    nearest, distance = nearest_marked(seen)
    beside = cv2.GaussianBlur(pixels[seen][nearest], (0, 0), min(MOST_BLUR, BLUR_M / texel_m))
    fades = np.exp(-distance * (texel_m / NEAR_M))[..., None]
    return np.asarray(np.round(middle + fades * (beside - middle)), dtype=np.uint8)
