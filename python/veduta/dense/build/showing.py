"""Depth maps as pictures for people."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.dense.document import DepthMap

UNKNOWN = 32


def depth_picture(
    depths_m: NDArray[np.float32], near_far_m: tuple[float, float]
) -> NDArray[np.uint8]:
    """(h, w, 3) uint8: near red, far blue, even in inverse depth; dark where unknown."""
    near, far = near_far_m
    known = np.isfinite(depths_m)
    inverse = 1.0 / np.where(known, depths_m, far)
    share = (inverse - 1.0 / far) / max(1.0 / near - 1.0 / far, 1e-12)
    return share_picture(share, known)


def share_picture(share: NDArray[np.floating], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """(h, w, 3) uint8: 1 red, 0 blue; dark where unknown."""
    whole = (np.clip(np.where(known, share, 0.0), 0.0, 1.0) * 255.0).astype(np.uint8)
    coloured = cv2.applyColorMap(whole, cv2.COLORMAP_TURBO)[:, :, ::-1]
    return np.where(known[:, :, None], coloured, UNKNOWN).astype(np.uint8)


def shown_range_m(depth_map: DepthMap) -> tuple[float, float]:
    """Between which depths a picture has its colours."""
    known = depth_map.depths_m[depth_map.known]
    if not known.size:
        return 1.0, 2.0
    low, high = np.quantile(known, [0.01, 0.99])
    return float(low) * 0.95, float(high) * 1.05


def beside(pictures: list[NDArray[np.uint8]], height_px: int = 420) -> NDArray[np.uint8]:
    """Pictures in a row, of one height."""
    scaled = [
        cv2.resize(one, (max(1, round(one.shape[1] * height_px / one.shape[0])), height_px),
                   interpolation=cv2.INTER_AREA)
        for one in pictures
    ]  # fmt: skip
    return np.asarray(np.hstack(scaled), dtype=np.uint8)


def confidence_picture(confidence: NDArray[np.float32]) -> NDArray[np.uint8]:
    """(h, w, 3) uint8: white where a depth is sure."""
    grey = np.clip(confidence * 255.0, 0.0, 255.0).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)
