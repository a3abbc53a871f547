"""RECTIFY of section 3.6: a depth map made consistent with another one that it overlaps."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.poisson import extend_destinations

Map = NDArray[np.float32]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class RectifyLimits:
    """step_px: of the grid on which (7) is solved. tear: difference of neighbours' inverse depths,
    as a share, across which little is passed on. detail_px: how far what the grid cannot say
    reaches in from the border. most: largest correction, as a share of the inverse depth.
    """

    step_px: int = 4
    tear: float = 0.06
    detail_px: float = 6.0
    most: float = 0.5


def rectified(
    own: Map, domain: Mask, other: Map, domain_other: Mask, limits: RectifyLimits = RectifyLimits()
) -> Map:
    """Equation (7): (h, w) inverse depths of a model on the common surface, consistent with another.

    Where both are (Psi) the other's are taken; elsewhere the gradient stays as it was, and the
    border of Psi is met. Inverse depth is corrected, not depth: a disparity is equally wrong
    near and far. Outside of its domain nothing is changed.
    """
    shared = domain & domain_other
    if not shared.any() or not (domain & ~shared).any():
        return np.where(shared, other, own)
    wished = np.where(shared, other - own, 0.0).astype(np.float32)
    wished = np.clip(wished, -limits.most * own, limits.most * own)
    coarse = _coarse(own, domain, wished, shared, limits)
    correction = _detailed(coarse, wished, shared, limits)
    least = (1.0 - limits.most) * own
    return np.where(shared, other, np.where(domain, np.maximum(own + correction, least), own))


def _coarse(own: Map, domain: Mask, wished: Map, shared: Mask, limits: RectifyLimits) -> Map:
    """The harmonic correction, on a grid of nodes, at all pixels."""
    step = limits.step_px
    size = (max(2, own.shape[1] // step), max(2, own.shape[0] // step))
    small, share = (
        np.asarray(cv2.resize(one.astype(np.float32), size, interpolation=cv2.INTER_AREA), np.float32)
        for one in (own, shared)
    )
    inside = cv2.resize(domain.astype(np.float32), size, interpolation=cv2.INTER_AREA) > 0.5
    known = (share > 0.5) | ~inside
    mean = cv2.resize(wished, size, interpolation=cv2.INTER_AREA) / np.maximum(share, 1e-6)
    right, down = _firmness(small, limits)
    apart = np.diff(inside.astype(np.int8), axis=1, append=inside[:, -1:].astype(np.int8)) != 0
    right = np.where(apart, 1e-6, right)
    apart = np.diff(inside.astype(np.int8), axis=0, append=inside[-1:].astype(np.int8)) != 0
    down = np.where(apart, 1e-6, down)
    points = small[..., None].astype(np.float64)
    destinations = points + np.where(share > 0.5, mean, 0.0)[..., None]
    found = extend_destinations(points, destinations, known, right, down)
    change = (found - points)[..., 0].astype(np.float32)
    whole = (own.shape[1], own.shape[0])
    return np.asarray(cv2.resize(change, whole, interpolation=cv2.INTER_LINEAR), np.float32)


def _firmness(
    inverse: Map, limits: RectifyLimits
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """How firmly nodes hang on those on the right and below: hardly across a break in depth."""
    logs = np.log(np.maximum(inverse, 1e-6))
    found = []
    for axis in (1, 0):
        apart = np.abs(np.diff(logs, axis=axis, append=np.take(logs, [-1], axis=axis)))
        found.append(np.where(apart > limits.tear, 0.02, 1.0))
    return found[0], found[1]


def _detailed(coarse: Map, wished: Map, shared: Mask, limits: RectifyLimits) -> Map:
    """With what the grid left open at the border of Psi, fading with the distance from it."""
    away, labels = cv2.distanceTransformWithLabels(
        (~shared).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    left = np.zeros(int(labels.max()) + 1, dtype=np.float32)
    left[labels[shared]] = (wished - coarse)[shared]
    fading = np.exp(-np.maximum(away - 1.0, 0.0) / np.float32(limits.detail_px))
    return np.asarray(coarse + left[labels] * fading, dtype=np.float32)
