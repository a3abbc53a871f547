"""Lawns, decks and floors of one tone, which are broader than walls: paper, however dark.

Sellers colour what lies around a house and in it. Such a field would be ink, and the house in it a
hole; it is painted white, and what is much darker in it stays: walls and lines. Thick walls with a
grey or coloured fill are no fields: they are long bands, where lawns, beds and cars are blobs.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean.ink import LEAST_CONTRAST


@dataclass(frozen=True)
class FieldRule:
    """What is a field. Darkness is that of the darkest channel, 0 to 1.

    broad: at least so broad both ways, as a share of the drawing's longer side: walls are not.
    dark: and at least so dark: paler floors are no ink as it is.
    pale: and at most so dark, of the darkest ink.
    much: all fields together cover so much of the sheet at least.
    alike: what is connected with a field, near it, and differs by so little is of it ...
    thin: ... if it is not thinner than this part of `broad`: panes are no lawn.
    band: what stands out darker in a field, is thicker than this part of `broad`, and paler than
    ink, is a grey wall beside a coloured floor: it stays as it is.
    hued, same: a colour whose channels are so far apart is a lawn, and goes on where they differ by
    so little (0 to 255), however narrow it is.
    beyond: ink in a field is darker than it by this part of what is left to the darkest.
    grain_px, grainy: grass and wood have a grain, which is smoothed so far first, where it is so
    strong at the median.
    white, paper: this share of the sheet is at most so dark; on a sheet in the shade all would be
    a field.
    steep, sharp: this share of a field's edge is as steep as this part of its tone: shadows end
    softly.
    wall, slender, around, near: outer walls are bands no wider than this share of the drawing's
    longer side, so many times longer than wide, and together so many times as long as that side.
    Shorter pieces of their tone, up to so many times as wide, are walls between openings. In
    eleven sheets of strangers and two of CubiCasa fields are wider than 0.12 of that side, or up to
    2.4 times longer than wide (beds, cars); a grey wall of 45 px in a house of 880 px is 0.06 wide
    with its blur, and all are 2.6 times as long as the house.
    """

    broad: float = 0.05
    dark: float = 0.2
    pale: float = 0.8
    much: float = 0.02
    alike: float = 0.14
    thin: float = 0.2
    band: float = 0.08
    hued: float = 60.0
    same: float = 24.0
    beyond: float = 0.4
    grain_px: float = 2.0
    grainy: float = 0.02
    white: float = 0.1
    paper: float = 0.25
    steep: float = 0.4
    sharp: float = 0.4
    wall: float = 0.09
    slender: float = 3.0
    around: float = 1.5
    near: float = 1.25


RULE = FieldRule()
MOST_COLOURS = 6


def without_fields(pixels: NDArray[np.uint8], rule: FieldRule = RULE) -> NDArray[np.uint8]:
    """sRGB pixels (h, w, 3), dark on light, with fields painted white; the same where none are."""
    dark = (np.float32(255.0) - pixels.min(axis=2).astype(np.float32)) / np.float32(255.0)
    seen = dark > LEAST_CONTRAST
    if seen.mean() < rule.much or (dark < rule.white).mean() < rule.paper:
        return pixels
    darkest = float(np.percentile(dark[seen], 98))
    smooth = np.asarray(cv2.GaussianBlur(dark, (0, 0), rule.grain_px), np.float32)
    field, tone = _fields(dark, smooth, darkest, rule)
    if field.mean() < rule.much:
        return pixels
    field = _sharp(field, smooth, tone, rule)
    lawn = _lawn(pixels, field, rule)
    tone = np.where(lawn, np.maximum(smooth, tone), tone)
    field = field | lawn
    # Thin lines on plain colours are seen as they are, those on grass without its grain.
    grain = float(np.median(np.abs(dark - smooth)[field])) if field.any() else 0.0
    fine = cv2.GaussianBlur(dark, (0, 0), 0.5 * rule.grain_px) if grain > rule.grainy else dark
    stays = fine > tone + rule.beyond * (darkest - tone)
    painted = field & ~stays & (fine < rule.pale * darkest)
    # Of a patch or two there is no need, and their lines would lose their edges.
    if painted.mean() < rule.much:
        return pixels
    return np.where(painted[:, :, None], np.uint8(255), pixels)


def _fields(
    dark: NDArray[np.float32], smooth: NDArray[np.float32], darkest: float, rule: FieldRule
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """Where fields are, and how dark each is."""
    seen = dark > LEAST_CONTRAST
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    longer = float(max(np.ptp(rows), np.ptp(columns)))
    side = max(3, round(rule.broad * longer))
    square = np.ones((side, side), np.uint8)
    level = np.asarray(cv2.morphologyEx(smooth, cv2.MORPH_OPEN, square), np.float32)
    core = (level > rule.dark) & (level < rule.pale * darkest)
    core &= ~_grey(dark, level, side, darkest, rule)
    around = cv2.dilate(np.where(core, level, np.float32(0.0)), square)
    rim = (around > 0) & (np.abs(smooth - around) < rule.alike)
    least = np.ones((2 * round(rule.thin * side / 2.0) + 1,) * 2, np.uint8)
    like = cv2.morphologyEx((core | rim).astype(np.uint8), cv2.MORPH_OPEN, least)
    _, labels = cv2.connectedComponents(like, connectivity=4)
    own = np.unique(labels[core])
    tone = np.where(core, level, around).astype(np.float32)
    field = np.isin(labels, own[own > 0])
    return field & ~_walls(field, smooth, longer, rule), tone


def _grey(
    dark: NDArray[np.float32],
    level: NDArray[np.float32],
    side: int,
    darkest: float,
    rule: FieldRule,
) -> NDArray[np.bool_]:
    """Bands that are darker than what is broad around them, and paler than ink; to their edges.

    Of the tone as it is: letters would be grey if smoothed.
    """
    ink = level + rule.beyond * (darkest - level)
    darker = dark > level + rule.alike
    least = np.ones((2 * round(rule.band * side / 2.0) + 1,) * 2, np.uint8)
    band = cv2.morphologyEx((darker & (dark < ink)).astype(np.uint8), cv2.MORPH_OPEN, least)
    reach = np.ones((2 * round(2.0 * rule.grain_px) + 1,) * 2, np.uint8)
    return np.asarray((cv2.dilate(band, reach) > 0) & darker, np.bool_)


def _walls(
    field: NDArray[np.bool_], smooth: NDArray[np.float32], longer: float, rule: FieldRule
) -> NDArray[np.bool_]:
    """Those of the fields that lie in walls: a corner is broader than its wall."""
    labels, area, width = _pieces(field)
    mean = np.bincount(labels[field], smooth[field], minlength=len(area)) / np.maximum(area, 1)
    left = width <= rule.wall * longer
    left[0] = False
    wall = np.zeros(len(area), np.bool_)
    least = np.ones((2 * round(rule.thin * rule.broad * longer / 2.0) + 1,) * 2, np.uint8)
    for _ in range(MOST_COLOURS):
        if not left.any():
            break
        level = mean[np.argmax(np.where(left, area, 0))]
        alike = (np.abs(smooth - level) < rule.alike).astype(np.uint8)
        band = _bands(cv2.morphologyEx(alike, cv2.MORPH_OPEN, least) > 0, longer, rule)
        same = left & (np.abs(mean - level) < rule.alike)
        within = np.bincount(labels[field & band], minlength=len(area))
        wall |= same & (within > 0.5 * area)
        left &= ~same
    return np.asarray(wall[labels], np.bool_)


def _bands(ink: NDArray[np.bool_], longer: float, rule: FieldRule) -> NDArray[np.bool_]:
    """Where ink of one tone is bands of even width that go around a house, if it is any."""
    labels, area, width = _pieces(ink)
    narrow = width <= rule.wall * longer
    narrow[0] = False
    band = narrow & (area >= rule.slender * width**2)
    if (area / width)[band].sum() < rule.around * longer:
        return np.zeros_like(ink)
    return np.asarray((narrow & (width <= rule.near * width[band].max()))[labels], np.bool_)


def _pieces(
    mask: NDArray[np.bool_],
) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.float64]]:
    """What is connected: labels, the area of each in px2 and its greatest width in px."""
    count, found = cv2.connectedComponents(mask.astype(np.uint8), connectivity=4)
    labels = np.asarray(found, np.int32)
    framed = cv2.copyMakeBorder(mask.astype(np.uint8), 1, 1, 1, 1, cv2.BORDER_CONSTANT, value=0)
    inside = cv2.distanceTransform(framed, cv2.DIST_L2, 5)[1:-1, 1:-1]
    width = np.ones(count, np.float64)
    np.maximum.at(width, labels[mask], 2.0 * inside[mask])
    area = np.bincount(labels[mask], minlength=count)
    return labels, area, width


def _sharp(
    field: NDArray[np.bool_],
    smooth: NDArray[np.float32],
    tone: NDArray[np.float32],
    rule: FieldRule,
) -> NDArray[np.bool_]:
    """Those of the fields that end sharply."""
    reach = np.ones((2 * round(2.0 * rule.grain_px) + 1,) * 2, np.uint8)
    slope = cv2.dilate(smooth, reach) - cv2.erode(smooth, reach)
    inner = cv2.erode(field.astype(np.uint8), np.ones((3, 3), np.uint8))
    count, labels = cv2.connectedComponents(field.astype(np.uint8), connectivity=4)
    edge = field & (inner == 0)
    at = labels[edge]
    steep = np.bincount(at, slope[edge] > rule.steep * tone[edge], minlength=count)
    kept = steep > rule.sharp * np.bincount(at, minlength=count)
    kept[0] = False
    return np.asarray(kept[labels], np.bool_)


def _lawn(
    pixels: NDArray[np.uint8], field: NDArray[np.bool_], rule: FieldRule
) -> NDArray[np.bool_]:
    """Where the strong colours of fields go on in places that are as narrow as walls."""
    soft = np.asarray(cv2.GaussianBlur(pixels, (0, 0), 1.5 * rule.grain_px), np.float32)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(field.astype(np.uint8))
    found = np.zeros(field.shape, np.bool_)
    for label in 1 + np.argsort(-stats[1:, cv2.CC_STAT_AREA])[:MOST_COLOURS]:
        colour = np.median(soft[labels == label], axis=0)
        if np.ptp(colour) >= rule.hued:
            found |= np.abs(soft - colour.astype(np.float32)).max(axis=2) <= rule.same
    least = np.ones((2 * round(rule.grain_px) + 1,) * 2, np.uint8)
    return np.asarray(cv2.dilate(found.astype(np.uint8), least) > 0, np.bool_)
