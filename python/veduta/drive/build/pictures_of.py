"""The images of the drive in memory, with what hides the facades in each (section 7.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.backdrop import Backdrop, draw_backdrops
from veduta.drive.build.flood import flood_foreground
from veduta.drive.build.misfit import Frame, correspondence_error
from veduta.drive.record import Shot
from veduta.imaging.read import read_image
from veduta.run.errors import InputError

_FARTHEST_M = 1e6


@dataclass(frozen=True)
class MaskParameters:
    """point_m: a foreground point hides so much around itself. closed_px: gaps between projected
    points up to this are of the object. most_px: no point hides more.
    sky_blue: by so much blue exceeds red in the sky, of 255; sky_light: and is so light.
    """

    point_m: float = 0.10
    solid_m: float = 0.2
    solid_px: int = 24
    """The same of what is below the points that stand on the ground: its far side has none,"""
    solid_nearer_m: float = 0.3
    """and it hides what is that close behind its foot, too."""
    closed_px: int = 9
    most_px: int = 12
    nearest_m: float = 1.5
    sky_blue: int = 18
    sky_light: int = 110
    leaf_green: int = 14
    leaf_px: int = 9
    """Leaves: 2 G - R - B exceeds this, in most of a square of so many pixels,"""
    leaf_share: float = 0.12
    """and this share of R + G + B; less green is leaves only where it does not fit the background,"""
    leaf_fits_px: float = 1.5
    """which what fits better than this does: plaster may be greenish, too."""
    leaf_rough: float = 12.0
    """Much green that fits, too, is paint where its light varies by less (standard deviation, of
    255) in that square."""


@dataclass(frozen=True, eq=False)
class Seen:
    """An image and what is known of it. pixels: (h, w, 3) uint8 sRGB.

    hidden_m: (h, w) float32 depth of the nearest foreground there, inf where there is none.
    sky: (h, w) bool. leaves: (h, w) bool, plants by their colour: scanners that look level do not
    see the crowns of trees. misfit: (h, w) float32 correspondence error (px), NaN where none is.
    """

    shot: Shot
    pixels: NDArray[np.uint8]
    hidden_m: NDArray[np.float32]
    sky: NDArray[np.bool_]
    leaves: NDArray[np.bool_]
    misfit: NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Around:
    """What is near an image. foreground: (n, 3) scan points (m, world). crowns: (k, 3) where trees
    may go on above what the scanner saw. backdrops: the surfaces behind, without holes. solid:
    (s, 3) what is below the foreground, down to the ground.
    """

    foreground: NDArray[np.float64]
    crowns: NDArray[np.float64]
    backdrops: tuple[Backdrop, ...] = ()
    solid: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))


def read_shot(shot: Shot) -> Frame:
    """InputError where the image is not as large as its calibration says."""
    pixels = read_image(shot.path).pixels
    if pixels.shape[:2] != (shot.height_px, shot.width_px):
        fault = f"is {pixels.shape[1]} x {pixels.shape[0]} pixels, not as its calibration says"
        raise InputError(shot.path, fault, "Give the image that the camera took.")
    return Frame(shot, pixels)


def look(
    one: Frame,
    around: Around,
    beside: Sequence[Frame] = (),
    parameters: MaskParameters | None = None,
) -> Seen:
    """beside: the images taken before and after. Where they tell what does not fit the background,
    crowns are taken from them; elsewhere all is hidden where crowns may be.
    """
    chosen = parameters or MaskParameters()
    sky = _sky(one.pixels, chosen)
    wide = replace(chosen, point_m=chosen.solid_m, most_px=chosen.solid_px)
    below = _hidden(one.shot, around.solid, wide) - chosen.solid_nearer_m
    hidden = np.minimum(_hidden(one.shot, around.foreground, chosen), below)
    crowns = _hidden(one.shot, around.crowns, chosen)
    drawn = draw_backdrops(one.shot, around.backdrops)
    misfit = correspondence_error(one, drawn.depth, beside)
    leaves = _leaves(one.pixels, sky, misfit, chosen)
    told = np.isfinite(misfit)
    if told.any():
        flooded = flood_foreground(one, misfit, drawn, around.foreground, sky)
        crowns[told] = np.inf
        hidden = np.minimum(hidden, flooded)
    return Seen(one.shot, one.pixels, np.minimum(hidden, crowns), sky, leaves, misfit)


def _hidden(
    shot: Shot, foreground: NDArray[np.float64], chosen: MaskParameters
) -> NDArray[np.float32]:
    """Each point hides a square of its size; what lies between close ones is hidden, too."""
    shape = (shot.height_px, shot.width_px)
    hidden = np.full(shape, np.inf, dtype=np.float32)
    pixels, depth = shot.project(foreground)
    inside = (depth > chosen.nearest_m) & (pixels >= 0).all(axis=1)
    inside &= (pixels[:, 0] < shape[1]) & (pixels[:, 1] < shape[0])
    at, depth = pixels[inside].astype(np.int64), depth[inside].astype(np.float32)
    radius = np.clip(chosen.point_m * shot.focal_px[0] / depth, 1, chosen.most_px).astype(np.int64)
    for size in np.unique(radius):
        own = radius == size
        layer = np.full(shape, np.inf, dtype=np.float32)
        np.minimum.at(layer, (at[own, 1], at[own, 0]), depth[own])
        block = np.ones((2 * int(size) + 1,) * 2, dtype=np.uint8)
        np.minimum(hidden, cv2.erode(layer, block), out=hidden)
    close = np.ones((chosen.closed_px, chosen.closed_px), dtype=np.uint8)
    closed = -cv2.morphologyEx(-hidden, cv2.MORPH_CLOSE, close)
    # OpenCV takes the greatest number for what is outside of the image.
    return np.where(closed < _FARTHEST_M, closed, np.inf).astype(np.float32)


def _sky(pixels: NDArray[np.uint8], chosen: MaskParameters) -> NDArray[np.bool_]:
    """Light blue that goes on from the upper border."""
    red, blue = pixels[..., 0].astype(np.int16), pixels[..., 2].astype(np.int16)
    blueish = (blue - red >= chosen.sky_blue) & (blue >= chosen.sky_light)
    cleaned = cv2.morphologyEx(blueish.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, label = cv2.connectedComponents(cleaned)
    from_top = np.zeros(count, dtype=bool)
    from_top[np.unique(label[:3])] = True
    from_top[0] = False
    return np.asarray(from_top[label], dtype=bool)


def _leaves(
    pixels: NDArray[np.uint8],
    sky: NDArray[np.bool_],
    misfit: NDArray[np.float32],
    chosen: MaskParameters,
) -> NDArray[np.bool_]:
    """Plants by their colour, or by less of it where they do not fit the background. Painted shop
    fronts and doors may be as green as leaves: they fit, and are plain.
    """
    red, green, blue = (pixels[..., axis].astype(np.int16) for axis in range(3))
    excess = 2 * green - red - blue
    greenish = excess >= chosen.leaf_green
    strong = greenish & (excess >= chosen.leaf_share * (red + green + blue))
    size = (chosen.leaf_px, chosen.leaf_px)
    most, sure = (cv2.blur(one.astype(np.float32), size) > 0.5 for one in (greenish, strong))
    with np.errstate(invalid="ignore"):
        fits = misfit < chosen.leaf_fits_px
    light = pixels.astype(np.float32).mean(axis=2)
    spread = cv2.blur(light * light, size) - cv2.blur(light, size) ** 2
    paint = fits & (spread < chosen.leaf_rough**2)
    return np.asarray(((sure & ~paint) | (most & ~fits)) & ~sky, dtype=bool)
