"""The derivation as a drawing: the start shape on the left, each rule one step further right."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from veduta.grammar.edits import path_text
from veduta.grammar.portrait import CLASS_COLOURS
from veduta.grammar.tree_rows import Row
from veduta.grammar.tree_text import choice_text, label, parameters_text, size_text

ROW_PX, STEP_PX, BOX_PX, LETTER_PX = 30, 46, 22, 6.6
MARGIN_PX = 24
_COLOURS = {one.value: colour for one, colour in CLASS_COLOURS.items()}
_PLAIN = "#ffffff"
_UNPRINTABLE = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd]")
"""What XML cannot hold."""


def tree_svg(title: str, rows: Sequence[Row]) -> str:
    """An SVG of the rows; the tooltip of a box has the path for a file of edits."""
    body, width = [], _width(title) + 2 * MARGIN_PX
    above: list[float] = []
    for number, row in enumerate(rows):
        x, y = MARGIN_PX + row.depth * STEP_PX, MARGIN_PX + 40 + number * ROW_PX
        drawn, right = _box(row, x, y)
        del above[row.depth :]
        body.append((_link(above[-1], x, y) if above else "") + drawn)
        above.append(y)
        width = max(width, right + MARGIN_PX)
    height = MARGIN_PX * 2 + 40 + len(rows) * ROW_PX
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height}" '
        f'viewBox="0 0 {width:.0f} {height}" font-family="Helvetica, Arial, sans-serif" '
        'font-size="12" fill="#26282c">'
        f'<rect width="100%" height="100%" fill="#faf9f6"/>'
        f'<text x="{MARGIN_PX}" y="{MARGIN_PX + 12}" font-size="16">{_safe(title)}</text>'
    )
    return head + "\n".join(body) + "</svg>\n"


def _box(row: Row, x: float, y: float) -> tuple[str, float]:
    """A row's box and what stands beside it; the x at which all of it ends."""
    name = row.name + ("." if row.is_leaf else "")
    inner = name + (f"  ×{row.count}" if row.count > 1 else "")
    width = _width(inner) + 16
    colour = _COLOURS.get(row.surface_class, _PLAIN)
    behind = ""
    if row.count > 1:
        behind = f'<rect x="{x + 3}" y="{y + 3}" width="{width:.1f}" {_side(colour)}/>'
    beside = [
        parameters_text(row),
        size_text(row),
        *(choice_text(choice) for choice in row.choices),
    ]
    beside += [f"+ {row.hidden} shapes below"] if row.hidden else []
    text = "  ·  ".join(word for word in beside if word)
    ink = "#ffffff" if _is_dark(colour) else "#26282c"
    tip = f"{label(row)}\n{path_text(row.path, row.name)}"
    drawn = (
        f'<g><title>{_safe(tip)}</title>{behind}<rect x="{x}" y="{y}" width="{width:.1f}" '
        f'{_side(colour)}/><text x="{x + 8}" y="{y + 15}" fill="{ink}">{_safe(inner)}</text>'
        f'<text x="{x + width + 10:.1f}" y="{y + 15}" fill="#74767a" font-size="11">'
        f"{_safe(text)}</text></g>"
    )
    return drawn, x + width + 20 + _width(text)


def _side(colour: str) -> str:
    return f'height="{BOX_PX}" rx="4" fill="{colour}" stroke="#8d8f93" stroke-width="0.8"'


def _link(parent_y: float, x: float, y: float) -> str:
    """The line from the box of the parent, which begins a step further left."""
    left, middle = x - STEP_PX + 16, y + BOX_PX / 2
    return (
        f'<path d="M{left} {parent_y + BOX_PX} V{middle - 6} Q{left} {middle} {left + 6} {middle} '
        f'H{x}" fill="none" stroke="#b9b7b0"/>'
    )


def _is_dark(colour: str) -> bool:
    red, green, blue = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return 0.299 * red + 0.587 * green + 0.114 * blue < 140


def _width(text: str) -> float:
    return LETTER_PX * len(text)


def _safe(text: str) -> str:
    return escape(_UNPRINTABLE.sub("�", text))
