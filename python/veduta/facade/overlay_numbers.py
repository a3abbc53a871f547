"""The number of each element on the overlay: `17` is `elements[17]` of facade.json."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import ImageDraw, ImageFont

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.outputs import COLOURS

FONT_PX = 15
_PADDING_PX = 2.5
_HEIGHT_PX = 16.0
_SEEN = 0.9
"""Share of a tag that must lie on what is visible of its element: else it would seem another's."""

_DARKER = 0.62
"""Of the colour of the class, so that white digits stand out from it."""

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""


@dataclass(frozen=True)
class Tag:
    """An element's number and where it stands, in pixels of the overlay."""

    number: int
    box: Box


def tags(document: FacadeDocument, scale: float, font: Font) -> list[Tag]:
    """A tag for each element that has room for it; `scale`: overlay pixels per rectified one."""
    owners = _owners(document, scale)
    found = []
    for number, element in enumerate(document.elements):
        width = font.getlength(str(number)) + 2 * _PADDING_PX
        for box in _corners(_visible(element, owners.shape, scale), width):
            left, top, right, bottom = (round(side) for side in box)
            if (owners[top:bottom, left:right] == number).mean() >= _SEEN:
                found.append(Tag(number, box))
                break
    return found


def draw_tags(
    draw: ImageDraw.ImageDraw, document: FacadeDocument, scale: float, font: Font
) -> None:
    """White digits on the colour of the class; the other way round where it is doubtful."""
    for tag in tags(document, scale, font):
        element = document.elements[tag.number]
        red, green, blue = (round(_DARKER * part) for part in COLOURS[element.class_])
        dark, light = (red, green, blue), (255, 255, 255)
        paper, ink = (light, dark) if element.is_doubtful else (dark, light)
        left, top, right, bottom = tag.box
        draw.rounded_rectangle(tag.box, 3, fill=paper, outline=dark)
        middle = ((left + right) / 2, (top + bottom) / 2)
        draw.text(middle, str(tag.number), ink, font, anchor="mm")


def _owners(document: FacadeDocument, scale: float) -> NDArray[np.int32]:
    """(h, w) number of the element that is seen at each pixel of the overlay, -1 for none."""
    size = document.rectification
    height, width = round(size.height_px * scale), round(size.width_px * scale)
    owners = np.full((max(1, height), max(1, width)), -1, dtype=np.int32)
    for number, element in enumerate(document.elements):
        left, top, right, bottom = (round(v) for v in _visible(element, owners.shape, scale))
        owners[top:bottom, left:right] = number
    return owners


def _visible(element: Element, shape: tuple[int, ...], scale: float) -> Box:
    """What of the element lies in the picture."""
    height, width = shape
    return (
        max(0.0, element.x_px * scale),
        max(0.0, element.y_px * scale),
        min(float(width), (element.x_px + element.width_px) * scale),
        min(float(height), (element.y_px + element.height_px) * scale),
    )


def _corners(box: Box, width: float) -> Iterator[Box]:
    """Where a tag of this width fits into a box: in its corners, the upper left first."""
    left, top, right, bottom = box
    if right - left < width or bottom - top < _HEIGHT_PX:
        return
    for y in (top, bottom - _HEIGHT_PX):
        for x in (left, right - width):
            yield x, y, x + width, y + _HEIGHT_PX
