"""Short gaps bridged by interpolation along rows, then along columns."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.options import FillParameters

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


def bridge(pixels: Floats, known: Mask, parameters: FillParameters) -> tuple[Floats, Mask]:
    """(h, w, 3) pixels with short smooth gaps filled, and (h, w) what is known then.

    A gap is filled linearly where its ends are alike and smooth around (section 7.3), first along
    rows, then along columns, since man-made edges run so.
    """
    pixels, known = _along_rows(pixels, known, parameters)
    turned, turned_known = _along_rows(
        np.ascontiguousarray(pixels.transpose(1, 0, 2)), known.T.copy(), parameters
    )
    return np.ascontiguousarray(turned.transpose(1, 0, 2)), turned_known.T.copy()


def _along_rows(pixels: Floats, known: Mask, parameters: FillParameters) -> tuple[Floats, Mask]:
    _height, width = known.shape
    columns = np.broadcast_to(np.arange(width), known.shape)
    left = np.maximum.accumulate(np.where(known, columns, -1), axis=1)
    right = np.where(known, columns, width)[:, ::-1]
    right = np.minimum.accumulate(right, axis=1)[:, ::-1]
    y, x = np.nonzero(~known & (left >= 0) & (right < width))
    start, end = left[y, x], right[y, x]
    short = end - start - 1 <= parameters.bridge_px
    y, x, start, end = y[short], x[short], start[short], end[short]
    first, last = pixels[y, start], pixels[y, end]
    rough = _roughness(pixels, known, parameters.around_px)
    fits = np.abs(first - last).max(axis=1) <= parameters.alike
    fits &= np.maximum(rough[y, start], rough[y, end]) <= parameters.smooth
    share = ((x - start) / np.maximum(end - start, 1))[:, None]
    between = first * (1.0 - share) + last * share
    filled, now = pixels.copy(), known.copy()
    filled[y[fits], x[fits]] = between[fits]
    now[y[fits], x[fits]] = True
    return filled, now


def _roughness(pixels: Floats, known: Mask, around_px: int) -> Floats:
    """(h, w) standard deviation of the known pixels around, of the roughest channel."""
    size = (around_px, around_px)
    weight = cv2.boxFilter(known.astype(np.float32), -1, size, normalize=False)
    weight = np.maximum(weight, 1.0)
    there = np.where(known[..., None], pixels, 0.0).astype(np.float32)
    mean = cv2.boxFilter(there, -1, size, normalize=False) / weight[..., None]
    square = cv2.boxFilter(there**2, -1, size, normalize=False) / weight[..., None]
    deviation = np.sqrt(np.maximum(square - mean**2, 0.0)).max(axis=-1)
    return np.asarray(deviation, dtype=np.float32)
