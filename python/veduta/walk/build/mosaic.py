"""The 3D-mosaic of a key position (section 3.6): one local model in place of those of its views."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import NotFoundError
from veduta.walk.build.level import Compared, Gains, compare_colours, level_gains
from veduta.walk.build.local_model import SKY_M, LocalModel
from veduta.walk.build.rectify_maps import Map, Mask, rectified
from veduta.walk.build.sampling import sampled
from veduta.walk.build.screen import Screen
from veduta.walk.build.turns import Turns, find_turns
from veduta.walk.rig import Image

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class MosaicLimits:
    """most_rad: half the angle of a mosaic. blind: least share of a column in which stereo must be
    sure for the geometry at a view's left border to count; blind_most: share of the width that may
    not count. power: how soon one picture gives way to the next.
    """

    most_rad: float = 3.1
    blind: float = 0.35
    blind_most: float = 0.25
    power: float = 6.0


@dataclass(frozen=True, eq=False)
class Mosaic:
    """model: the merged one; its `front` is the view that it stands in the frame of. turns: of the
    views. gains: (n, 3) of their colours. gap: share of the picture that no view shows.
    """

    model: LocalModel
    turns: Turns
    gains: Gains
    gap: float


@dataclass(frozen=True, eq=False)
class _Laid:
    """A view on the common surface. shown: where its picture is; domain: where its geometry counts.

    border: (h, w) 0..1 how far from the view's border. inverse: 1 / depth of the common surface.
    """

    colour: NDArray[np.float32]
    shown: Mask
    domain: Mask
    border: Map
    inverse: Map
    measured: Mask
    sky: Mask


def make_mosaic(
    models: list[LocalModel], turns: Turns | None = None, limits: MosaicLimits = MosaicLimits()
) -> Mosaic:
    """Register, make consistent by (7) and merge the views of one key position.

    turns: the rotations, where they are known.

    NotFoundError where no two views have anything in common. Views that have nothing in common
    with the others are left out: `turns.found`.
    """
    turns = find_turns(models) if turns is None else turns
    used = [n for n in range(len(models)) if turns.found[n]]
    if len(used) < 2:
        raise NotFoundError(
            f"the mosaic of key position {models[0].key}",
            "no two of its views have anything in common",
            "Turn by less than the angle of view from one to the next.",
        )
    screen = _screen(models[turns.front].screen, turns.front_from_view[used], limits)
    order = sorted(used, key=lambda n: _aside(turns, n))
    laid = [_laid(models[n], turns.front_from_view[n], screen, limits) for n in order]
    gains = np.ones((len(models), 3))
    gains[order] = _gains(laid)
    image = _merged_colours(laid, gains[order], limits)
    inverse, domain, measured, sky = _merged_maps(laid)
    shown = np.any([one.shown for one in laid], axis=0)
    rows = _whole_rows(shown)
    kept = Screen(
        screen.width_px, rows.stop - rows.start, screen.focal_px,
        (screen.centre_px[0], screen.centre_px[1] - rows.start), round=True,
    )  # fmt: skip
    depth = np.where(sky, SKY_M, 1.0 / np.maximum(inverse, 1.0 / SKY_M)).astype(np.float32)
    model = LocalModel(
        models[0].key, kept, image[rows], depth[rows], (measured & domain)[rows], sky[rows],
        front=models[turns.front],
    )  # fmt: skip
    return Mosaic(model, turns, gains, float(1.0 - shown[rows].mean()))


def _aside(turns: Turns, view: int) -> float:
    """How far a view is turned from the front one (rad)."""
    return float(np.arccos(np.clip(turns.front_from_view[view][2, 2], -1.0, 1.0)))


def _screen(front: Screen, turns: Matrix, limits: MosaicLimits) -> Screen:
    """The cylinder that holds all views, as finely as the front one."""
    angles, heights = [], []
    edge = np.concatenate(
        [front.pixels[[0, -1]].reshape(-1, 2), front.pixels[:, [0, -1]].reshape(-1, 2)]
    )
    rays = front.points(edge, np.ones(len(edge)))
    for turn in turns:
        turned = rays @ turn.T
        angle = np.arctan2(turned[:, 0], turned[:, 2])
        middle = float(np.arctan2(turn[0, 2], turn[2, 2]))
        angle = middle + (angle - middle + np.pi) % (2.0 * np.pi) - np.pi
        angles += [angle.min(), angle.max()]
        height = turned[:, 1] / np.hypot(turned[:, 0], turned[:, 2])
        heights += [height.min(), height.max()]
    left, right = max(min(angles), -limits.most_rad), min(max(angles), limits.most_rad)
    fx, fy = front.focal_px
    width = int(np.floor((right - left) * fx))
    height = int(np.floor((max(heights) - min(heights)) * fy))
    return Screen(width, height, (fx, fy), (-left * fx, -min(heights) * fy), round=True)


def _laid(model: LocalModel, turn: Matrix, screen: Screen, limits: MosaicLimits) -> _Laid:
    rays = screen.points(screen.pixels, np.ones(screen.pixels.shape[:2])) @ turn
    plane = model.screen
    pixels, ahead = plane.project(rays)
    pixels = np.nan_to_num(pixels, nan=-1e4).astype(np.float32)
    size = np.array([plane.width_px, plane.height_px], dtype=np.float32)
    room = np.minimum(pixels, size - pixels)
    shown = (room >= 0.5).all(axis=-1) & (ahead > 1e-6)
    border = np.clip((room / (0.5 * size)).min(axis=-1), 0.0, 1.0)
    depth = sampled(1.0 / model.depth_m, pixels)
    inverse = depth * np.maximum(ahead, 1e-6)
    measured = shown & (sampled(model.measured, pixels, nearest=True) > 0)
    sky = shown & (sampled(model.sky, pixels, nearest=True) > 0)
    domain = shown & (pixels[..., 0] > _blind_px(model, limits))
    return _Laid(
        sampled(model.image, pixels), shown, domain, np.where(shown, border, 0.0).astype(np.float32),
        inverse.astype(np.float32), measured, sky,
    )  # fmt: skip


def _blind_px(model: LocalModel, limits: MosaicLimits) -> float:
    """How wide the strip on the left is that the right camera did not see."""
    most = int(limits.blind_most * model.screen.width_px)
    land = np.maximum((~model.sky).sum(axis=0), 1)
    sure = (model.measured.sum(axis=0) / land)[:most] >= limits.blind
    return float(np.argmax(sure)) if sure.any() else float(most)


def _gains(laid: list[_Laid]) -> Gains:
    """(n, 3) so that views show what they share in one colour; the first is left as it is."""
    compared = []
    for first in range(len(laid)):
        for second in range(first + 1, len(laid)):
            both = laid[first].shown & laid[second].shown
            ratio = compare_colours(laid[first].colour[both], laid[second].colour[both])
            if ratio is not None:
                compared.append(Compared(first, second, ratio))
    gains = level_gains(len(laid), compared)
    return np.asarray(gains / gains[0])


def _merged_colours(laid: list[_Laid], gains: Gains, limits: MosaicLimits) -> Image:
    """Of each pixel most of the view in whose middle it is nearest."""
    total = np.zeros(laid[0].border.shape, dtype=np.float32)
    colour = np.zeros((*total.shape, 3), dtype=np.float32)
    best = np.max([one.border for one in laid], axis=0)
    for one, gain in zip(laid, gains, strict=True):
        weight = (one.border / np.maximum(best, 1e-6)) ** np.float32(limits.power)
        weight = np.where(one.shown, np.maximum(weight, 1e-6), 0.0).astype(np.float32)
        colour += weight[..., None] * one.colour * gain.astype(np.float32)
        total += weight
    return np.clip(np.round(colour / np.maximum(total, 1e-9)[..., None]), 0, 255).astype(np.uint8)


def _merged_maps(laid: list[_Laid]) -> tuple[Map, Mask, Mask, Mask]:
    """RECTIFY for all pairs i < j, then the first view's map wherever it is, and so on."""
    inverse = [one.inverse for one in laid]
    for first in range(len(laid)):
        for second in range(first + 1, len(laid)):
            inverse[second] = rectified(
                inverse[second], laid[second].domain & ~laid[second].sky,
                inverse[first], laid[first].domain & ~laid[first].sky,
            )  # fmt: skip
    merged = np.zeros_like(inverse[0])
    domain, measured, sky = (np.zeros(merged.shape, dtype=bool) for _ in range(3))
    for one, values in zip(laid, inverse, strict=True):
        new = one.domain & ~domain
        merged = np.where(new, values, merged)
        measured |= new & one.measured
        sky |= new & one.sky
        domain |= new
    # The blind strip of the outermost view hangs on what is beside it.
    done = domain.copy()
    for one in laid:
        new = one.shown & ~done
        merged = np.where(new, rectified(one.inverse, one.shown, merged, done), merged)
        sky |= new & one.sky
        done |= new
    return (_nearest(merged, done) if not done.all() else merged), domain, measured, sky


def _nearest(values: Map, known: Mask) -> Map:
    """Beyond the views: what is nearest."""
    _, labels = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    table = np.zeros(int(labels.max()) + 1, dtype=np.float32)
    table[labels[known]] = values[known]
    return np.asarray(np.where(known, values, table[labels]), dtype=np.float32)


def _whole_rows(shown: Mask) -> slice:
    """The rows, about the middle one, that are shown from end to end (but for a pixel)."""
    whole = shown[:, 1:-1].all(axis=1)
    if not whole.any():
        return slice(0, len(shown))
    middle = int(np.flatnonzero(whole)[whole.sum() // 2])
    gaps = np.flatnonzero(~whole)
    top = int(gaps[gaps < middle].max(initial=-1)) + 1
    bottom = int(gaps[gaps > middle].min(initial=len(shown)))
    return slice(top, bottom)
