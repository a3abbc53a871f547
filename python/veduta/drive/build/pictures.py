"""Pictures of a segment for the report: depth images before and after, and atlases (figure 16)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Source
from veduta.drive.build.segment import Geometry, Textured

_EMPTY = (24, 24, 28)
_SOURCES = {
    Source.NOTHING: _EMPTY, Source.MEASURED: (205, 200, 190),
    Source.FILLED: (230, 120, 40), Source.INFERRED: (90, 140, 220),
}  # fmt: skip
_CONTRADICTED = (210, 40, 50)
_SEED = 7


def depth_picture(depth: NDArray[np.float32], geometry: Geometry) -> NDArray[np.uint8]:
    """(h, w, 3) near is light, far is dark; empty pixels nearly black. Rows are beams."""
    most = float(np.nanmax(geometry.background.main)) + 2.0 if geometry.measured_walls() else 20.0
    share = np.clip(np.nan_to_num(depth, nan=0.0) / most, 0.0, 1.0)
    grey = (235 - 190 * share).astype(np.uint8)
    coloured = np.repeat(grey[..., None], 3, axis=2)
    coloured[~np.isfinite(depth)] = _EMPTY
    return _upright(coloured, geometry)


def object_picture(geometry: Geometry) -> NDArray[np.uint8]:
    """(h, w, 3) each object of the foreground in a colour of its own."""
    random = np.random.default_rng(_SEED)
    table = random.integers(70, 255, (geometry.object_count + 1, 3)).astype(np.uint8)
    table[0] = _EMPTY
    return _upright(table[geometry.objects], geometry)


def source_picture(textured: Textured) -> NDArray[np.uint8]:
    """(h, w, 3) grey measured, orange filled, blue inferred; red filled and not borne out."""
    background, geometry = textured.background, textured.geometry
    table = np.array([_SOURCES[Source(value)] for value in range(4)], dtype=np.uint8)
    picture = table[background.source]
    wrong = cv2.dilate(textured.consistency.contradicted.astype(np.uint8), np.ones((3, 3), np.uint8))
    picture[(wrong > 0) & (background.source == Source.FILLED)] = _CONTRADICTED
    return _upright(picture, geometry)


def histogram_picture(geometry: Geometry) -> NDArray[np.uint8]:
    """(h, w, 3) the 2D histogram (figure 12), with main depth white and split depth blue."""
    depths = geometry.layers.depths
    grid = np.clip(depths.histogram.T / 1.5, 0.0, 1.0)
    picture = cv2.applyColorMap((grid * 255).astype(np.uint8), cv2.COLORMAP_INFERNO)[..., ::-1]
    picture = np.ascontiguousarray(picture)
    for line, colour in ((depths.main, (255, 255, 255)), (depths.split, (90, 160, 255))):
        known = np.flatnonzero(np.isfinite(line))
        rows = np.clip((line[known] / depths.bin_m).astype(int), 0, len(picture) - 1)
        picture[rows, known] = colour
    picture = picture[::-1] if geometry.frame.side == "left" else picture[::-1, ::-1]
    return np.asarray(cv2.resize(picture, None, fx=2, fy=3, interpolation=cv2.INTER_NEAREST))


def atlas_picture(textured: Textured, *, filled: bool) -> NDArray[np.uint8]:
    """(h, w, 3) the atlas with its holes red, or filled."""
    pixels = (textured.pixels if filled else textured.atlas.pixels).copy()
    pixels[~textured.atlas.surface] = _EMPTY
    if not filled:
        pixels[textured.atlas.surface & ~textured.atlas.seen] = (220, 40, 40)
    shrink = min(1.0, 1600 / pixels.shape[1])
    return np.asarray(cv2.resize(pixels, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA))


def plan_picture(
    points: NDArray[np.float64], kinds: NDArray[np.uint8], line: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """(h, w, 3) from above: the path, the points (n, 3) by class, the main depths."""
    points = points[:, :2]
    everything = np.vstack([points, line[:, :2]])
    low, high = np.quantile(everything, [0.001, 0.999], axis=0)
    scale = min(1000.0 / max(float((high - low).max()), 1.0), 20.0)
    size = np.ceil((high - low) * scale).astype(int) + 1
    picture = np.full((size[1], size[0], 3), 18, dtype=np.uint8)
    colours = {66: (150, 85, 45), 2: (95, 85, 75), 6: (240, 200, 110), 64: (70, 190, 100), 65: (90, 180, 240)}
    for kind, colour in colours.items():
        _dots(picture, points[kinds == kind], low, scale, colour)
    _dots(picture, line[:, :2], low, scale, (255, 255, 255))
    return picture


def _dots(
    picture: NDArray[np.uint8],
    points: NDArray[np.float64],
    low: NDArray[np.float64],
    scale: float,
    colour: tuple[int, int, int],
) -> None:
    at = ((points - low) * scale).astype(int)
    inside = (at >= 0).all(axis=1) & (at[:, 0] < picture.shape[1]) & (at[:, 1] < picture.shape[0])
    picture[picture.shape[0] - 1 - at[inside, 1], at[inside, 0]] = colour


def _upright(picture: NDArray[np.uint8], geometry: Geometry) -> NDArray[np.uint8]:
    """High beams at the top, and columns as one sees them from the street."""
    rows = geometry.background.source.any(axis=1) | (geometry.objects > 0).any(axis=1)
    last = int(np.flatnonzero(rows).max()) + 8 if rows.any() else len(picture)
    turned = picture[:last][::-1]
    turned = turned if geometry.frame.side == "left" else turned[:, ::-1]
    return np.ascontiguousarray(cv2.resize(turned, None, fx=2, fy=2, interpolation=cv2.INTER_NEAREST))
