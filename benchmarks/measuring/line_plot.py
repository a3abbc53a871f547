"""Lines over a logarithmic axis as a picture: what a benchmark's table shows at a glance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

WIDTH_PX, HEIGHT_PX = 560, 420
LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX = 60, 16, 40, 36
LEGEND_PX = 34
DECADES = (0.1, 1.0, 10.0, 100.0, 1000.0)


@dataclass(frozen=True)
class Line:
    """A name, a colour, and (x, y) from left to right."""

    name: str
    colour: str
    points: Sequence[tuple[float, float]]


def write_plot(path: Path, panels: Mapping[str, Sequence[Line]]) -> None:
    """A panel for each title, side by side, one legend below; y from 0.1 to 1000."""
    picture = Image.new("RGB", (WIDTH_PX * len(panels), HEIGHT_PX + LEGEND_PX), "white")
    draw = ImageDraw.Draw(picture)
    font = ImageFont.load_default(14)
    for number, (title, lines) in enumerate(panels.items()):
        _panel(draw, font, number * WIDTH_PX, title, lines)
    at = LEFT_PX
    for line in next(iter(panels.values())):
        draw.line([(at, HEIGHT_PX + 14), (at + 26, HEIGHT_PX + 14)], line.colour, 4)
        draw.text((at + 32, HEIGHT_PX + 5), line.name, "black", font)
        at += 32 + int(draw.textlength(line.name, font)) + 28
    picture.save(path, optimize=True)


def _panel(
    draw: ImageDraw.ImageDraw,
    font: ImageFont.FreeTypeFont | ImageFont.ImageFont,
    left: int,
    title: str,
    lines: Sequence[Line],
) -> None:
    values = sorted({x for line in lines for x, _ in line.points})
    span = (values[-1] - values[0]) or 1.0
    width, height = WIDTH_PX - LEFT_PX - RIGHT_PX, HEIGHT_PX - TOP_PX - BOTTOM_PX

    def place(x: float, y: float) -> tuple[float, float]:
        bounded = float(np.log10(np.clip(y, DECADES[0], DECADES[-1]) / DECADES[0]))
        up = bounded / float(np.log10(DECADES[-1] / DECADES[0]))
        across = (x - values[0]) / span
        return left + LEFT_PX + across * width, TOP_PX + (1.0 - up) * height

    draw.text((left + LEFT_PX, 12), title, "black", font)
    for decade in DECADES:
        draw.line([place(values[0], decade), place(values[-1], decade)], "#dddddd")
        label = f"{decade:g}"
        x, y = place(values[0], decade)
        draw.text((x - 8 - draw.textlength(label, font), y - 9), label, "black", font)
    for value in values:
        draw.line([place(value, DECADES[0]), place(value, DECADES[-1])], "#eeeeee")
        label = f"{value:g}"
        x, y = place(value, DECADES[0])
        draw.text((x - draw.textlength(label, font) / 2, y + 8), label, "black", font)
    for line in lines:
        draw.line([place(*point) for point in line.points], line.colour, 3, joint="curve")
