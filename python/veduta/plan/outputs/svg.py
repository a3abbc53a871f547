"""`plan.svg`: the storeys beside each other, a group for each layer, in metres."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import arc_points
from veduta.plan.document import RoomUse, Storey
from veduta.plan.drawing import LAYERS, Drawing, Label, Shape
from veduta.plan.outputs.colours import LAYER_COLOURS, USE_COLOURS

GAP_M = 2.0
MARGIN_M = 0.6
TITLE_M = 1.0
PX_PER_M = 60
_LINE_M = {
    "walls": 0.0,
    "windows": 0.03,
    "doors": 0.03,
    "stairs": 0.02,
    "rooms": 0.0,
    "furniture": 0.012,
}
_TEXT_M, _LEAST_TEXT_M = 0.28, 0.12


def plan_svg(drawings: Sequence[Drawing]) -> bytes:
    """The file's content; one user unit is a metre, y points down."""
    groups, x, height = [], MARGIN_M, 0.0
    for drawing in drawings:
        left, bottom, right, top = drawing.bounds_m
        offset = (x - left, top + MARGIN_M + TITLE_M)
        groups.append(_storey(drawing, offset, x))
        x += right - left + GAP_M
        height = max(height, top - bottom)
    size = (x - GAP_M + MARGIN_M, height + 2 * MARGIN_M + TITLE_M)
    head = (
        '<svg xmlns="http://www.w3.org/2000/svg"'
        f' width="{size[0] * PX_PER_M:.0f}" height="{size[1] * PX_PER_M:.0f}"'
        f' viewBox="0 0 {_n(size[0])} {_n(size[1])}"'
        ' font-family="Inter, Helvetica, Arial, sans-serif">'
    )
    paper = '<rect width="100%" height="100%" fill="#ffffff"/>'
    return "\n".join([head, paper, *groups, "</svg>", ""]).encode()


def _storey(drawing: Drawing, offset: tuple[float, float], x: float) -> str:
    name = drawing.storey.name
    lines = [
        f"<g id={quoteattr(name)}>",
        f'<text x="{_n(x)}" y="{_n(MARGIN_M + 0.3)}" font-size="0.4" fill="#1f2a37">'
        f"{escape(name)}</text>",
    ]
    for layer in LAYERS:
        shapes = [shape for shape in drawing.shapes if shape.layer == layer]
        if shapes:
            lines.append(f'<g class="{layer}">')
            lines += [_shape(shape, offset) for shape in shapes]
            lines.append("</g>")
        if layer == "walls":
            lines += _wall_ids(drawing.storey, offset)
    lines.append('<g class="names" text-anchor="middle" fill="#1f2a37">')
    lines += [_label(label, drawing, offset) for label in drawing.labels]
    return "\n".join([*lines, "</g>", "</g>"])


def _wall_ids(storey: Storey, offset: tuple[float, float]) -> list[str]:
    """Unseen: what a wall and a junction are called, where the pointer rests on them."""
    at = {one.id: one.at_m for one in storey.junctions}
    found = ['<g class="ids" fill="none" stroke="none" pointer-events="all">']
    for wall in storey.walls:
        line = _path(arc_points(at[wall.start], at[wall.end], wall.bulge), offset)
        told = escape(f"{wall.id}, from {wall.start} to {wall.end}")
        found.append(
            f'<path d="{line}" stroke-width="{_n(wall.thickness_m)}"><title>{told}</title></path>'
        )
    radius = 0.5 * min((wall.thickness_m for wall in storey.walls), default=0.1)
    for name, (x, y) in at.items():
        told = escape(f"{name}, at {_n(x)}, {_n(y)} m")
        found.append(
            f'<circle cx="{_n(x + offset[0])}" cy="{_n(offset[1] - y)}" r="{_n(radius)}">'
            f"<title>{told}</title></circle>"
        )
    return [*found, "</g>"]


def _shape(shape: Shape, offset: tuple[float, float]) -> str:
    path = " ".join(
        [_path(ring, offset) + " Z" for ring in shape.rings]
        + [_path(line, offset) for line in shape.lines]
    )
    title = f"<title>{escape(' '.join(filter(None, (shape.name, shape.kind))))}</title>"
    if shape.layer == "rooms":
        look = f'fill="{_use_colour(shape.kind)}" stroke="none"'
    elif shape.layer == "walls":
        look = f'fill="{LAYER_COLOURS["walls"]}" fill-rule="evenodd" stroke="none"'
    else:
        width = _LINE_M.get(shape.layer, 0.02)
        look = f'fill="none" stroke="{LAYER_COLOURS[shape.layer]}" stroke-width="{width}"'
    return f'<path d="{path}" {look}>{title if shape.name else ""}</path>'


def _label(label: Label, drawing: Drawing, offset: tuple[float, float]) -> str:
    size = text_size_m(label, drawing)
    x, y = label.at_m[0] + offset[0], offset[1] - label.at_m[1]
    return (
        f'<text x="{_n(x)}" y="{_n(y)}" font-size="{_n(size)}">{escape(label.text)}</text>'
        f'<text x="{_n(x)}" y="{_n(y + 1.2 * size)}" font-size="{_n(0.8 * size)}">'
        f"{escape(label.detail)}</text>"
    )


def text_size_m(label: Label, drawing: Drawing) -> float:
    """Letters as high as fit into the width of the room."""
    rings = [shape.rings[0] for shape in drawing.shapes if shape.layer == "rooms"]
    at = np.array(label.at_m)
    around = [
        ring for ring in rings if (ring.min(axis=0) <= at).all() and (at <= ring.max(axis=0)).all()
    ]
    width = min((float(np.ptp(ring[:, 0])) for ring in around), default=2.0)
    letters = max(len(label.text), len(label.detail), 1)
    return float(np.clip(width * 0.9 / (0.6 * letters), _LEAST_TEXT_M, _TEXT_M))


def _use_colour(use: str) -> str:
    known: dict[str, str] = {str(name): colour for name, colour in USE_COLOURS.items()}
    unknown: RoomUse = "unknown"
    return known.get(use, USE_COLOURS[unknown])


def _path(points: NDArray[np.float64], offset: tuple[float, float]) -> str:
    moved = [f"{_n(x + offset[0])} {_n(offset[1] - y)}" for x, y in points.tolist()]
    return "M " + " L ".join(moved)


def _n(value: float) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".")
