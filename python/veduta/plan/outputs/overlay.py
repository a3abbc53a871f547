"""`overlay.png`: what was found, drawn over the cleaned drawing of each storey."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from shapely.geometry import Polygon, box

from veduta.imaging.lettering import text_width, write
from veduta.plan.document import Fitting, Sheet, Storey
from veduta.plan.drawing import Drawing, Layer, Shape
from veduta.plan.outputs.colours import LAYER_COLOURS, USE_COLOURS, Rgb, rgb

SIDE_PX = 1800
"""Drawings are enlarged or reduced so that their longer side has this many pixels."""
PANEL_PX = 300
GAP_PX = 24
AROUND = 0.08
"""So much is shown around a storey that shares its sheet, as a part of its longer side."""
FADED = 0.45
"""How much of the drawing's ink is left."""
_OPACITY: dict[Layer, float] = {"rooms": 0.42, "walls": 0.55}
_INK: Rgb = (31, 42, 55)
_FAINT: Rgb = (104, 112, 122)
_PAPER: Rgb = (250, 249, 246)
_FITTING: Rgb = (176, 48, 128)
_SHIFT = 4
"""OpenCV draws at 1/16 px."""
_DOUBTFUL = 0.5
_LINE_PX = 25
_SHIFTS_PX = (0, 30, -30, 60, -60, 90, -90)
"""By how much a label is moved, the nearest free place first."""


def overlay(drawings: Sequence[Drawing], sheets: Sequence[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB: the storeys below each other, each over its (h, w, 3) cleaned drawing."""
    where = [(one.storey.sheet.sha256, one.storey.sheet.page) for one in drawings]
    panels = [
        _storey(drawing, pixels, alone=where.count(place) == 1)
        for drawing, pixels, place in zip(drawings, sheets, where, strict=True)
    ]
    width = max(panel.shape[1] for panel in panels)
    height = sum(panel.shape[0] for panel in panels) + GAP_PX * (len(panels) - 1)
    canvas = np.full((height, width, 3), _PAPER, dtype=np.uint8)
    top = 0
    for panel in panels:
        canvas[top : top + panel.shape[0], : panel.shape[1]] = panel
        top += panel.shape[0] + GAP_PX
    return canvas


def pixels_of(sheet: Sheet, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 2) points of the plan frame (m) in the cleaned image (px)."""
    flipped = points_m * np.array([1.0, -1.0]) / sheet.metres_per_px
    moved: NDArray[np.float64] = flipped + np.array(sheet.origin_px)
    return moved


def _storey(drawing: Drawing, pixels: NDArray[np.uint8], *, alone: bool) -> NDArray[np.uint8]:
    """A storey over its sheet; of one with several (not `alone`) over its own part of it."""
    sheet = drawing.storey.sheet
    left, top, right, bottom = _part(drawing, pixels, alone=alone)
    scale = SIDE_PX / max(right - left, bottom - top)
    way = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_CUBIC
    sized = cv2.resize(pixels, None, fx=scale, fy=scale, interpolation=way)
    faded = 255.0 - FADED * (255.0 - sized.astype(np.float32))
    picture = faded.astype(np.uint8)
    for shape in drawing.shapes:
        _draw(picture, shape, sheet, scale)
    for one in drawing.storey.fittings:
        ring = _at(sheet, _around(one), scale)
        cv2.polylines(picture, [ring], True, _FITTING, 2, cv2.LINE_AA, _SHIFT)
    whole = Image.fromarray(picture)
    pen = ImageDraw.Draw(whole)
    _room_names(pen, drawing, scale)
    _opening_ids(pen, drawing, scale)
    own = whole.crop(
        (round(left * scale), round(top * scale), round(right * scale), round(bottom * scale))
    )
    canvas = Image.new("RGB", (own.width + PANEL_PX, max(own.height, 520)), _PAPER)
    canvas.paste(own, (0, 0))
    _legend(ImageDraw.Draw(canvas), drawing.storey, own.width + 24)
    return np.asarray(canvas, dtype=np.uint8)


def _part(
    drawing: Drawing, pixels: NDArray[np.uint8], *, alone: bool
) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of what is shown of a sheet, in its pixels."""
    height, width = pixels.shape[:2]
    rings = [ring for shape in drawing.shapes for ring in (*shape.rings, *shape.lines)]
    if alone or not rings:
        return 0.0, 0.0, float(width), float(height)
    points = pixels_of(drawing.storey.sheet, np.concatenate(rings))
    low, high = points.min(axis=0), points.max(axis=0)
    edge = AROUND * float(np.max(high - low))
    (left, top), (right, bottom) = np.maximum(low - edge, 0.0), high + edge
    return float(left), float(top), min(float(right), width), min(float(bottom), height)


def _around(one: Fitting) -> NDArray[np.float64]:
    """The corners of a fitting, (4, 2), plan frame."""
    cos, sin = np.cos(one.turn_rad), np.sin(one.turn_rad)
    signs = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    corners = 0.5 * signs * np.array(one.size_m)
    turned: NDArray[np.float64] = corners @ np.array([[cos, sin], [-sin, cos]]) + np.array(one.at_m)
    return turned


def _draw(picture: NDArray[np.uint8], shape: Shape, sheet: Sheet, scale: float) -> None:
    colour = rgb(LAYER_COLOURS[shape.layer])
    if shape.layer == "rooms":
        colour = rgb({str(use): code for use, code in USE_COLOURS.items()}[shape.kind])
    rings = [_at(sheet, ring, scale) for ring in shape.rings]
    lines = [_at(sheet, line, scale) for line in shape.lines]
    opacity = _OPACITY.get(shape.layer)
    if opacity is not None:
        _fill(picture, rings, colour, opacity)
    if shape.layer != "rooms":
        width = {"doors": 3, "windows": 3, "furniture": 1}.get(shape.layer, 2)
        cv2.polylines(picture, rings, True, colour, width, cv2.LINE_AA, _SHIFT)
        cv2.polylines(picture, lines, False, colour, width, cv2.LINE_AA, _SHIFT)


def _fill(
    picture: NDArray[np.uint8], rings: list[NDArray[np.int32]], colour: Rgb, opacity: float
) -> None:
    """Tint what lies within the rings; only the box around them is looked at."""
    corners = np.concatenate(rings) >> _SHIFT
    left, top = np.maximum(corners.min(axis=0) - 1, 0).tolist()
    right, bottom = (corners.max(axis=0) + 2).tolist()
    part = picture[top:bottom, left:right]
    if part.size == 0:
        return
    mask = np.zeros(part.shape[:2], dtype=np.uint8)
    moved = [ring - np.array([left, top], dtype=np.int32) * (1 << _SHIFT) for ring in rings]
    cv2.fillPoly(mask, moved, 255, cv2.LINE_AA, _SHIFT)
    share = (opacity / 255.0) * mask[..., None].astype(np.float32)
    part[:] = (part * (1.0 - share) + np.array(colour, dtype=np.float32) * share).astype(np.uint8)


def _at(sheet: Sheet, points_m: NDArray[np.float64], scale: float) -> NDArray[np.int32]:
    """OpenCV has the centre of the first pixel at (0, 0)."""
    places = pixels_of(sheet, points_m) * scale - 0.5
    return np.round(places * (1 << _SHIFT)).astype(np.int32)


def _room_names(pen: ImageDraw.ImageDraw, drawing: Drawing, scale: float) -> None:
    written = [
        box(
            *(np.array(text.box_px).min(axis=0) * scale),
            *(np.array(text.box_px).max(axis=0) * scale),
        )
        for text in drawing.storey.texts
    ]
    for label in drawing.labels:
        width = max(text_width(label.text, 22), text_width(label.detail, 17))
        x, y = _beside(_spot(drawing.storey.sheet, label.at_m, scale), width, written)
        haloed(pen, (x, y - 12), label.text, 22, _INK)
        haloed(pen, (x, y + 12), label.detail, 17, _INK)


def _beside(at: tuple[float, float], width: float, written: list[Polygon]) -> tuple[float, float]:
    """A little above or below what the plan itself says there, so that both can be read."""

    def covered(down: float) -> float:
        x, y = at[0], at[1] + down
        own = box(x - width / 2, y - _LINE_PX, x + width / 2, y + _LINE_PX)
        return float(sum(own.intersection(text).area for text in written))

    return (at[0], at[1] + min(_SHIFTS_PX, key=covered))


def _opening_ids(pen: ImageDraw.ImageDraw, drawing: Drawing, scale: float) -> None:
    """Ids beside their openings; what is doubtful has a question mark."""
    scores = {opening.id: opening.score for opening in drawing.storey.openings}
    for shape in drawing.shapes:
        if shape.layer not in {"doors", "windows"}:
            continue
        middle = np.mean([line.mean(axis=0) for line in shape.lines[:2]], axis=0)
        doubt = "?" if scores[shape.name] < _DOUBTFUL else ""
        colour = rgb(LAYER_COLOURS[shape.layer])
        at = _spot(drawing.storey.sheet, (float(middle[0]), float(middle[1])), scale)
        haloed(pen, at, f"{shape.name}{doubt}", 15, colour)


def _spot(sheet: Sheet, at_m: tuple[float, float], scale: float) -> tuple[float, float]:
    x, y = (pixels_of(sheet, np.array([at_m])) * scale)[0].tolist()
    return (x, y)


def haloed(
    pen: ImageDraw.ImageDraw, at: tuple[float, float], text: str, size_px: int, colour: Rgb
) -> None:
    """Write text about a place, with a rim that keeps it legible on any drawing."""
    write(pen, at, text, size_px, colour, halo=_PAPER)


def _legend(pen: ImageDraw.ImageDraw, storey: Storey, x: int) -> None:
    write(pen, (x, 24), storey.name, 24, _INK, anchor="left")
    y = 76
    doors = [one for one in storey.openings if one.kind == "door"]
    windows = [one for one in storey.openings if one.kind == "window"]
    gaps = [one for one in storey.openings if one.kind == "gap"]
    for colour, count, name in (
        (LAYER_COLOURS["walls"], len(storey.walls), "walls"),
        (LAYER_COLOURS["doors"], len(doors), "doors"),
        (LAYER_COLOURS["doors"], len(gaps), "gaps"),
        (LAYER_COLOURS["windows"], len(windows), "windows"),
        (LAYER_COLOURS["rooms"], len(storey.rooms), "rooms"),
    ):
        pen.rectangle((x, y + 3, x + 18, y + 17), fill=rgb(colour))
        write(pen, (x + 30, y), f"{count} {name}", 18, _INK, anchor="left")
        y += 30
    y += 12
    for use in dict.fromkeys(room.use for room in storey.rooms):
        pen.rectangle((x, y + 2, x + 18, y + 16), fill=rgb(USE_COLOURS[use]), outline=_FAINT)
        write(pen, (x + 30, y), use, 15, _INK, anchor="left")
        y += 24
    y += 12
    scale = storey.scale
    doubtful = any(one.score < _DOUBTFUL for one in storey.openings)
    lines = [
        f"{1000 * scale.metres_per_px:.2f} mm per pixel",
        f"± {100 * scale.sigma:.1f} % ({scale.basis})",
        *([f"? is doubtful: score below {_DOUBTFUL}"] if doubtful else []),
    ]
    for line in lines:
        write(pen, (x, y), line, 15, _FAINT, anchor="left")
        y += 22
