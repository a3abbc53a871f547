"""`overlay.png`: what was found, drawn over the rectified photo, with a legend beside it.

Each element has its outline, dashed where it is doubtful, and its number in `facade.json`.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.outputs import COLOURS, coloured, rasterise
from veduta.facade.overlay_numbers import FONT_PX, draw_tags
from veduta.facade.shape import corners_px
from veduta.imaging.encode import png_bytes

MIN_HEIGHT_PX = 1400
"""Small photos are enlarged to this height, so that lines and numbers can be read."""
MAX_SIDE_PX = 3000
FILL = 0.34
"""Opacity of an element's fill; extents get half of it."""
DASH_PX = 8
PANEL_PX = 290
LEGEND_PX = 612
"""Height of a legend with every line; the picture of a long street may be lower."""
INK = (38, 42, 48)
FAINT = (110, 116, 124)
PAPER = (250, 249, 246)
FLOOR_LINE = (214, 40, 90)
_SHIFT = 4
"""OpenCV draws at 1/16 px."""


def overlay(document: FacadeDocument, pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h', w', 3) sRGB picture from the (h, w, 3) rectified photo."""
    scale = _scale(pixels)
    picture = _tinted(document, pixels, scale)
    for element in document.elements:
        _outline(picture, element, scale)
    for _, y_px in floor_lines(document):
        _floor_line(picture, document, y_px, scale)
    size = (picture.shape[1] + PANEL_PX, max(picture.shape[0], LEGEND_PX))
    canvas = Image.new("RGB", size, PAPER)
    canvas.paste(Image.fromarray(picture), (0, 0))
    draw = ImageDraw.Draw(canvas)
    draw_tags(draw, document, scale, _font(FONT_PX))
    _storey_heights(draw, document, picture.shape[1], scale)
    _legend(draw, document, picture.shape[1] + 74)
    return np.asarray(canvas, dtype=np.uint8)


def png(pixels: NDArray[np.uint8]) -> bytes:
    """(h, w, 3) sRGB as a PNG file."""
    # Level 6 takes three times as long, for a file that is a twentieth smaller.
    return png_bytes(pixels, compress_level=2)


def floor_lines(document: FacadeDocument) -> list[tuple[float, float]]:
    """Height above the ground (m) and row (px) of each storey's top, from the ground up."""
    box, scale = document.facade, document.scale.metres_per_px
    heights = np.cumsum(document.rules.facade.sizes_m)
    return [(float(y_m), float(box.y_px + box.height_px - y_m / scale)) for y_m in heights]


def _scale(pixels: NDArray[np.uint8]) -> float:
    height, width = pixels.shape[:2]
    enlarged = max(1.0, MIN_HEIGHT_PX / height)
    return float(min(enlarged, MAX_SIDE_PX / max(height, width)))


def _tinted(document: FacadeDocument, pixels: NDArray[np.uint8], scale: float) -> NDArray[np.uint8]:
    """The photo, enlarged, with each class in its colour."""
    height, width = pixels.shape[:2]
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    how = cv2.INTER_CUBIC if scale > 1 else cv2.INTER_AREA
    photo = cv2.resize(pixels, size, interpolation=how).astype(np.float32)
    labels = rasterise(document)
    tint = cv2.resize(coloured(document, labels), size, interpolation=cv2.INTER_NEAREST)
    is_element = labels != rasterise(document.model_copy(update={"elements": []}))
    opacity = np.where(is_element, FILL, FILL / 2).astype(np.float32)
    share = cv2.resize(opacity, size, interpolation=cv2.INTER_NEAREST)[:, :, None]
    return np.asarray(np.clip(photo * (1 - share) + tint * share, 0, 255), dtype=np.uint8)


def _outline(picture: NDArray[np.uint8], element: Element, scale: float) -> None:
    corners = np.array(corners_px(element))
    edges = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    lines = [np.vstack([corners, corners[:1]])]
    if element.is_doubtful:
        lines = [dash for start, end in edges for dash in _dashes(start, end, DASH_PX / scale)]
    points = [_fixed_point(line, scale) for line in lines]
    for colour, thickness in (((255, 255, 255), 4), (COLOURS[element.class_], 2)):
        cv2.polylines(picture, points, False, colour, thickness, cv2.LINE_AA, _SHIFT)


def _dashes(
    start: NDArray[np.float64], end: NDArray[np.float64], dash: float
) -> list[NDArray[np.float64]]:
    """A line in dashes of about this length, with gaps as long; it begins and ends with one."""
    # Half as many as lengths, and not many thousands for an element far larger than the picture.
    count = int(np.clip(round(float(np.linalg.norm(end - start)) / dash / 2), 1, 500))
    ends = np.linspace(0.0, 1.0, 2 * count)[:, None]
    points = start + ends * (end - start)
    return [points[i : i + 2] for i in range(0, 2 * count, 2)]


def _floor_line(
    picture: NDArray[np.uint8], document: FacadeDocument, y_px: float, scale: float
) -> None:
    box = document.facade
    ends = np.array([(box.x_px, y_px), (box.x_px + box.width_px, y_px)])
    cv2.polylines(picture, [_fixed_point(ends, scale)], False, FLOOR_LINE, 2, cv2.LINE_AA, _SHIFT)


def _fixed_point(points: NDArray[np.float64], scale: float) -> NDArray[np.int32]:
    """Rectified pixels (corner of the first at 0) as OpenCV's (its centre at 0), times 16."""
    moved = np.clip(points * scale - 0.5, -(2**14), 2**14)
    return np.rint(moved * (1 << _SHIFT)).astype(np.int32)


def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)


def _storey_heights(
    draw: ImageDraw.ImageDraw, document: FacadeDocument, left: int, scale: float
) -> None:
    """The height of each storey in metres, beside the photo."""
    below = (document.facade.y_px + document.facade.height_px) * scale
    for (_, y_px), size_m in zip(floor_lines(document), document.rules.facade.sizes_m, strict=True):
        y = y_px * scale
        draw.line([(left, y), (left + 14, y)], fill=FLOOR_LINE, width=2)
        draw.text((left + 10, (y + below) / 2), f"{size_m:.1f} m", INK, _font(17), anchor="lm")
        below = y


def _legend(draw: ImageDraw.ImageDraw, document: FacadeDocument, left: int) -> None:
    """Swatches with the number found of each class, and the facade's size."""
    counts = dict.fromkeys(document.classes, 0)
    for element in document.elements:
        counts[element.class_] += 1
    painted = {extent.class_ for extent in document.extents}
    box = document.facade
    basis = document.scale.basis
    given = {"assumed-storey": "assumed", "edited": "as edited"}.get(basis, "given")
    y = 24
    for line in (f"{box.width_m:.1f} x {box.height_m:.1f} m", f"{document.storeys} storeys"):
        draw.text((left, y), line, INK, _font(24))
        y += 32
    doubt = ["storeys doubtful"] if document.storeys_doubtful else []
    for line in (*doubt, f"scale {given}"):
        draw.text((left, y), line, FAINT, _font(17))
        y += 22
    y += 22
    for name, count in counts.items():
        if count == 0 and name not in painted:
            continue
        draw.rounded_rectangle([left, y, left + 22, y + 22], 4, fill=COLOURS[name])
        text = f"{name}  {count}" if count else name
        draw.text((left + 34, y + 11), text, INK, _font(19), anchor="lm")
        y += 34
    draw.line([(left, y + 11), (left + 22, y + 11)], fill=FLOOR_LINE, width=3)
    draw.text((left + 34, y + 11), "floor line", INK, _font(19), anchor="lm")
    doubtful = sum(element.is_doubtful for element in document.elements)
    if doubtful:
        y += 34
        for x in (0, 9, 18):
            draw.line([(left + x, y + 11), (left + x + 4, y + 11)], fill=INK, width=2)
        draw.text((left + 34, y + 11), f"doubtful  {doubtful}", INK, _font(19), anchor="lm")
    if document.elements:
        y += 46
        for line in ("17 is elements[17]", "of facade.json"):
            draw.text((left, y), line, FAINT, _font(17))
            y += 22
