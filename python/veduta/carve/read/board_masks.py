"""Silhouettes over a printed board: what is not as the sheet was printed is the object."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Board, Camera
from veduta.carve.read.background import BackgroundRule, cleaned
from veduta.carve.views import Mask, Pixels


@dataclass(frozen=True)
class PrintRule:
    """What is the sheet's print (8-bit Lab of OpenCV).

    colour: distance from the paper's or ink's colour. light: of lightness. shadow: the least share
    of the lightness in a shadow. edge_px: about the edges of the print, between which the sheet may
    be as light as either. rim_px: about the sheet's own edge, where only what is broader is the
    object. dots_per_px: of the drawing that is laid under the photo.
    """

    colour: float = 9.0
    light: float = 18.0
    shadow: float = 0.5
    edge_px: int = 2
    rim_px: int = 5
    dots_per_px: float = 1.5


def without_print(
    camera: Camera, photo: Pixels, mask: Mask, board: Board, rule: PrintRule | None = None
) -> Mask:
    """(h, w) of the mask, what is not the sheet. A grey object on it looks like a shadow, a white
    one like the paper: those need masks.
    """
    rule = rule or PrintRule()
    expected, inside = _sheet_in(camera, board, rule)
    lab = cv2.cvtColor(photo, cv2.COLOR_RGB2LAB).astype(np.float32)
    paper, ink = expected > 235.0, expected < 20.0
    if not (inside & paper).any() or not (inside & ink).any():
        return mask
    white, black = np.median(lab[inside & paper], axis=0), np.median(lab[inside & ink], axis=0)
    share = expected[..., None] / 255.0
    wanted = black + share * (white - black)
    reach = np.ones((2 * rule.edge_px + 1,) * 2, np.uint8)
    high = cv2.dilate(wanted[..., 0].astype(np.float32), reach) + rule.light
    low = cv2.erode(wanted[..., 0].astype(np.float32), reach) * rule.shadow - rule.light
    light = (lab[..., 0] > low) & (lab[..., 0] < high)
    coloured = np.linalg.norm(lab[..., 1:] - wanted[..., 1:], axis=2) > rule.colour
    left = (mask & ~(inside & light & ~coloured)).astype(np.uint8)
    reach = np.ones((rule.rim_px,) * 2, np.uint8)
    sheet = inside.astype(np.uint8)
    rim = cv2.dilate(sheet, reach) != cv2.erode(sheet, reach)
    left = np.where(rim, cv2.morphologyEx(left, cv2.MORPH_OPEN, reach), left).astype(np.uint8)
    return cleaned(left, BackgroundRule())


def _sheet_in(camera: Camera, board: Board, rule: PrintRule) -> tuple[NDArray[np.float32], Mask]:
    """(h, w) how light the print is in the photo, 0 to 255, and where the sheet is."""
    away = max(float(camera.project(np.zeros(3))[1][0]), 1e-6)
    dots_per_m = rule.dots_per_px * max(camera.focal_px) / away
    sheet = board.drawn(dots_per_m)
    width, height = board.size_m
    metres = np.array(
        [[1.0 / dots_per_m, 0.0, -width / 2.0], [0.0, -1.0 / dots_per_m, height / 2.0], [0, 0, 1.0]]
    )
    # OpenCV's first pixel has its middle at (0, 0).
    half = np.array([[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]])
    warp = np.linalg.inv(half) @ camera.projection()[:, [0, 1, 3]] @ metres @ half
    size = (camera.width_px, camera.height_px)
    soft = cv2.GaussianBlur(sheet, (0, 0), 0.6 * rule.dots_per_px)
    shown = cv2.warpPerspective(soft, warp, size, borderMode=cv2.BORDER_REPLICATE)
    inside = cv2.warpPerspective(np.full_like(sheet, 255), warp, size) > 0
    grown = cv2.dilate(inside.astype(np.uint8), np.ones((5, 5), np.uint8))
    return shown.astype(np.float32), np.asarray(grown > 0, dtype=bool)
