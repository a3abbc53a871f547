"""A plain background, found from the colours along the photos' borders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.run.progress import StepProgress, no_progress

Pixels = NDArray[np.uint8]
Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
BLACK = np.array([0.0, 128.0, 128.0])
"""In OpenCV's 8-bit Lab."""


@dataclass(frozen=True)
class BackgroundRule:
    """How colours become silhouettes.

    border: of a photo's shorter side, how broad the band is that is taken for background.
    kinds: colours of the background at most (a table, a wall, a frame). least_share: of the band's
    pixels, below which a kind is the object itself that touches the border.
    noise_lab: what a colour may differ by noise (L, a, b; OpenCV's 8-bit Lab).
    shade: by what share of its way from black a colourful background may differ in light and
    shadow; colourful: its least distance from grey. On a grey one only lightness tells the object.
    far: distances beyond it (in deviations) are all the same: surely the object.
    near: the least and the greatest threshold. small_hole, small_piece: of the silhouette's area;
    holes that are smaller are filled, pieces that are smaller dropped. What is too much in one
    view, the others take away; what is missing in one is gone: small pieces stay.
    ring_px, ring_share: a kind that is not this much of what lies around the silhouettes (a frame,
    a far wall) tells nothing within their boxes, where it would bite into shadows.
    grey_threshold, grey_close: before a grey background the object's own shadows look like it: the
    threshold is so much of what Otsu finds, and gaps of so much of the photo's larger side close.
    Chosen by looking at silhouettes of the Oxford dinosaur and the Middlebury rings.
    """

    border: float = 0.06
    kinds: int = 6
    least_share: float = 0.015
    noise_lab: tuple[float, float, float] = (4.0, 2.0, 2.0)
    shade: float = 0.12
    colourful: float = 12.0
    far: float = 24.0
    near: tuple[float, float] = (3.5, 12.0)
    small_hole: float = 0.002
    small_piece: float = 0.001
    ring_px: int = 8
    ring_share: float = 0.02
    grey_threshold: float = 0.55
    grey_close: float = 0.008
    samples: int = 3000


def masks_of_background(
    photos: Sequence[Pixels],
    seeds: Sequence[tuple[int, int, int]] = (),
    rule: BackgroundRule | None = None,
    *,
    progress: StepProgress = no_progress,
) -> tuple[list[NDArray[np.bool_]], float]:
    """Silhouettes (h, w) of the photos (h, w, 3), and the threshold that parts them (deviations).

    seeds: the background's colours (sRGB), instead of those along the borders.
    """
    rule = rule or BackgroundRule()
    kinds = _given(seeds, rule) if seeds else _along_borders(photos, rule)
    each = []
    for number, photo in enumerate(photos):
        each.append(_distances(photo, kinds, rule))
        progress("silhouettes", 0.7 * (number + 1) / len(photos))
    threshold = _parting([one.min(axis=0) for one in each], rule)
    grey = not any(_chroma(mean) > rule.colourful for mean, _ in kinds)
    if grey:
        threshold = max(rule.grey_threshold * threshold, rule.near[0])
    first = [_silhouette(one.min(axis=0), threshold, rule, grey) for one in each]
    around = _kinds_around(each, first, rule)
    masks = []
    for number, (one, mask) in enumerate(zip(each, first, strict=True)):
        masks.append(mask if around.all() else _again(one, mask, around, threshold, rule, grey))
        progress("silhouettes", 0.7 + 0.3 * (number + 1) / len(photos))
    return masks, threshold


Kind = tuple[Floats, Floats]
"""Mean (3,), and the matrix (3, 3) that makes its deviations those of a unit ball."""


def _chroma(lab: NDArray[np.floating]) -> float:
    """How far a colour is from grey."""
    return float(np.linalg.norm((lab - BLACK)[1:]))


def _lab(photo: Pixels) -> Floats:
    return cv2.cvtColor(photo, cv2.COLOR_RGB2LAB).astype(np.float32)


def _given(seeds: Sequence[tuple[int, int, int]], rule: BackgroundRule) -> list[Kind]:
    colours = _lab(np.array([list(seeds)], dtype=np.uint8))[0]
    whiten = np.diag(1.0 / (2.0 * np.array(rule.noise_lab, dtype=np.float32))).astype(np.float32)
    return [(colour, whiten) for colour in colours]


def _along_borders(photos: Sequence[Pixels], rule: BackgroundRule) -> list[Kind]:
    taken = []
    for photo in photos:
        smooth = _lab(np.asarray(cv2.GaussianBlur(photo, (0, 0), 1.0), dtype=np.uint8))
        height, width = smooth.shape[:2]
        band = max(4, round(rule.border * min(height, width)))
        on_border = np.ones((height, width), dtype=bool)
        on_border[band:-band, band:-band] = False
        pixels = smooth[on_border]
        taken.append(pixels[:: max(1, len(pixels) // rule.samples)])
    colours = np.concatenate(taken)
    cv2.setRNGSeed(1)
    ends = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 30, 0.1)
    first = np.zeros((len(colours), 1), np.int32)
    _, labels, _ = cv2.kmeans(colours, rule.kinds, first, ends, 2, cv2.KMEANS_PP_CENTERS)
    kinds = []
    for number in range(rule.kinds):
        own = colours[labels[:, 0] == number]
        if len(own) < rule.least_share * len(colours):
            continue
        mean = own.mean(axis=0)
        spread = np.cov(own.T) + np.diag(np.square(rule.noise_lab))
        if _chroma(mean) > rule.colourful:
            spread += rule.shade**2 * np.outer(mean - BLACK, mean - BLACK)
        whiten = np.linalg.cholesky(np.linalg.inv(spread)).T
        kinds.append((mean.astype(np.float32), whiten.astype(np.float32)))
    return kinds


def _distances(photo: Pixels, kinds: Sequence[Kind], rule: BackgroundRule) -> NDArray[np.float16]:
    """(k, h, w) deviations to each of the background's colours."""
    lab = _lab(photo)
    found = np.empty((len(kinds), *lab.shape[:2]), dtype=np.float16)
    for number, (mean, whiten) in enumerate(kinds):
        # One affine map: whitened and shifted, so that its length is the distance.
        moved = cv2.transform(lab, np.column_stack([whiten, -whiten @ mean]))
        length = np.sqrt(np.einsum("ijk,ijk->ij", moved, moved))
        found[number] = np.minimum(length, rule.far)
    return np.asarray(found, dtype=np.float16)


def _kinds_around(
    each: Sequence[NDArray[np.float16]], masks: Sequence[Mask], rule: BackgroundRule
) -> NDArray[np.bool_]:
    """(k,) which of the background's colours lie around the object."""
    counts = np.zeros(len(each[0]))
    reach = np.ones((2 * rule.ring_px + 1,) * 2, np.uint8)
    for one, mask in zip(each, masks, strict=True):
        # About the convex hull: what a kind bit out of the object must not count as around it.
        whole = np.zeros(mask.shape, np.uint8)
        places = np.argwhere(mask)[:, ::-1].astype(np.int32)
        if len(places):
            cv2.fillConvexPoly(whole, cv2.convexHull(places), 1)
        ring = (cv2.dilate(whole, reach) > 0) & (whole == 0)
        counts += np.bincount(one[:, ring].argmin(axis=0), minlength=len(counts))
    return np.asarray(counts >= rule.ring_share * max(counts.sum(), 1.0), dtype=bool)


def _again(
    distances: NDArray[np.float16],
    mask: Mask,
    around: NDArray[np.bool_],
    threshold: float,
    rule: BackgroundRule,
    grey: bool,
) -> Mask:
    """The silhouette once more: within its box only the colours around it are background."""
    nearest = distances.min(axis=0)
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if len(rows) and around.any():
        box = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        nearest[box] = distances[around][(slice(None), *box)].min(axis=0)
    return _silhouette(nearest, threshold, rule, grey)


def _parting(distances: Sequence[NDArray[np.float16]], rule: BackgroundRule) -> float:
    """Otsu's threshold of all photos together, within what noise and objects allow."""
    scale = 255.0 / rule.far
    counts = np.zeros(256)
    for one in distances:
        counts += np.bincount(
            (one.astype(np.float32) * scale).astype(np.uint8).ravel(), minlength=256
        )
    weights, values = np.cumsum(counts), np.cumsum(counts * np.arange(256))
    rest = weights[-1] - weights
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = np.square(values / weights - (values[-1] - values) / rest) * weights * rest
    best = float(np.nanargmax(np.where(np.isfinite(apart), apart, -1.0)))
    # An edge's mixed pixels are the object's from their middle on, which lies nearer to the noise.
    return float(np.clip(0.6 * (best + 1.0) / scale, *rule.near))


def _silhouette(
    distance: NDArray[np.float16], threshold: float, rule: BackgroundRule, grey: bool
) -> Mask:
    smooth = cv2.GaussianBlur(distance.astype(np.float32), (0, 0), 0.7)
    mask = (smooth > threshold).astype(np.uint8)
    if grey:
        side = 2 * round(rule.grey_close * max(mask.shape)) + 1
        disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
        mask = np.asarray(cv2.morphologyEx(mask, cv2.MORPH_CLOSE, disc), dtype=np.uint8)
    return cleaned(mask, rule)


def cleaned(mask: NDArray[np.uint8], rule: BackgroundRule) -> Mask:
    """A silhouette (1 on the object) without specks and small holes."""
    mask = np.asarray(cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((2, 2), np.uint8)), np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=8)
    areas = stats[1:, cv2.CC_STAT_AREA]
    if not len(areas):
        return np.zeros(mask.shape, dtype=bool)
    kept = np.flatnonzero(np.concatenate([[0], areas >= rule.small_piece * areas.max()]))
    solid = np.isin(labels, kept)
    holes, stats = cv2.connectedComponentsWithStats((~solid).astype(np.uint8), connectivity=4)[1:3]
    small = stats[:, cv2.CC_STAT_AREA] < rule.small_hole * float(solid.sum())
    small[0] = False
    return np.asarray(solid | small[holes], dtype=bool)
