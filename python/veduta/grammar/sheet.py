"""The contact sheet of `veduta grammar sample`: buildings in rows, each with its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from veduta.grammar.outline import Attribute
from veduta.grammar.portrait import CLASS_COLOURS, PAPER
from veduta.imaging.encode import jpeg_bytes, png_bytes
from veduta.place.semantics import SemanticClass

GAP_PX = 26
INK, PALE, LINE = (38, 40, 44), (116, 118, 122), (216, 213, 205)
TITLE_PX, TEXT_PX, SMALL_PX = 30, 19, 16
MAX_FACTS = 4
Font = ImageFont.FreeTypeFont | ImageFont.ImageFont


@dataclass(frozen=True)
class Cell:
    """A sampled building.

    pictures: (h, w, 3) sRGB each, of one size. facts: attributes that differ between the samples.
    """

    title: str
    prior: str
    facts: Sequence[tuple[str, Attribute]]
    pictures: Sequence[NDArray[np.uint8]]


def draw_sheet(
    title: str, note: str, cells: Sequence[Cell], columns: int, classes: Sequence[SemanticClass]
) -> Image.Image:
    """All cells in rows of `columns`; `classes` are those of the legend, empty for none."""
    height, width = cells[0].pictures[0].shape[:2]
    cell_width = width * len(cells[0].pictures)
    cell_height = height + _caption_px()
    rows = -(-len(cells) // columns)
    head = GAP_PX + TITLE_PX + SMALL_PX + 26
    foot = GAP_PX + SMALL_PX + 8 if classes else 0
    size = (
        GAP_PX + columns * (cell_width + GAP_PX),
        head + rows * (cell_height + GAP_PX) + foot,
    )
    sheet = Image.new("RGB", size, tuple(int(part) for part in PAPER))
    pen = ImageDraw.Draw(sheet)
    pen.text((GAP_PX, GAP_PX - 6), title, INK, _font(TITLE_PX))
    pen.text((GAP_PX, GAP_PX + TITLE_PX + 6), note, PALE, _font(SMALL_PX))
    for number, cell in enumerate(cells):
        row, column = divmod(number, columns)
        x = GAP_PX + column * (cell_width + GAP_PX)
        y = head + row * (cell_height + GAP_PX)
        for place, picture in enumerate(cell.pictures):
            sheet.paste(Image.fromarray(picture), (x + place * width, y))
        _caption(pen, cell, x, y + height, cell_width)
    _legend(pen, classes, size[1] - foot + 4)
    return sheet


def encoded(sheet: Image.Image, suffix: str) -> bytes:
    """The bytes of a PNG or JPEG file."""
    if suffix in (".jpg", ".jpeg"):
        return jpeg_bytes(sheet, 88, optimize=True)
    return png_bytes(sheet, optimize=True)


def shown(value: Attribute) -> str:
    """A value in few characters."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.3g}"
    return value if len(value) <= 16 else f"{value[:15]}…"


def _caption_px() -> int:
    return TEXT_PX + 2 * SMALL_PX + 30


def _caption(pen: ImageDraw.ImageDraw, cell: Cell, x: int, y: int, width: int) -> None:
    text, small = _font(TEXT_PX), _font(SMALL_PX)
    pen.line([(x, y + 4), (x + width, y + 4)], LINE, 1)
    pen.text((x, y + 10), cell.title, INK, text)
    pen.text((x + width - pen.textlength(cell.prior, text), y + 10), cell.prior, INK, text)
    at, line = float(x), y + 10 + TEXT_PX + 8
    for name, value in cell.facts:
        label = f"{name} "
        is_colour = _colour(value) is not None
        said = "" if is_colour else shown(value)
        length = pen.textlength(label + said, small) + (SMALL_PX if is_colour else 0)
        if at > x and at + length > x + width:
            at, line = float(x), line + SMALL_PX + 5
            if line > y + 10 + TEXT_PX + 8 + SMALL_PX + 5:
                return
        pen.text((at, line), label, PALE, small)
        pen.text((at + pen.textlength(label, small), line), said, INK, small)
        if is_colour:
            left = at + pen.textlength(label, small)
            box = [left, line + 3, left + SMALL_PX - 2, line + SMALL_PX + 1]
            pen.rectangle(box, _colour(value), LINE)
        at += length + 16


def _legend(pen: ImageDraw.ImageDraw, classes: Sequence[SemanticClass], y: int) -> None:
    at, font = float(GAP_PX), _font(SMALL_PX)
    for one in classes:
        pen.rectangle([at, y + 2, at + SMALL_PX, y + 2 + SMALL_PX], CLASS_COLOURS[one], LINE)
        pen.text((at + SMALL_PX + 7, y), one.value, INK, font)
        at += SMALL_PX + 7 + pen.textlength(one.value, font) + 24


def _colour(value: Attribute) -> str | None:
    """The value where it is a colour: `#rrggbb`."""
    is_colour = isinstance(value, str) and len(value) == 7 and value.startswith("#")
    digits = value[1:].lower() if is_colour and isinstance(value, str) else "-"
    return str(value) if all(digit in "0123456789abcdef" for digit in digits) else None


def _font(size: int) -> Font:
    return ImageFont.load_default(size)
