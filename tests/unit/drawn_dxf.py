"""A house of two rooms as a DXF file, in any unit, on any layers, anywhere.

Outer faces from (0, 0) to (8, 5) m, walls of 0.3 m; the middle wall of 0.1 m has its axis at
x = 4; its door of 0.9 m spans y = 1.0 to 1.9, hangs below and opens to the right; a window of
1.5 m spans x = 1.2 to 2.7 in the wall below.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import ezdxf
from ezdxf.document import Drawing as DxfDocument

Line = Sequence[tuple[float, float]]
WALLS: tuple[Line, ...] = (
    ((1.2, 0.0), (0.0, 0.0), (0.0, 5.0), (8.0, 5.0), (8.0, 0.0), (2.7, 0.0)),
    ((1.2, 0.3), (0.3, 0.3), (0.3, 4.7), (3.95, 4.7), (3.95, 1.9), (4.05, 1.9), (4.05, 4.7)),
    ((4.05, 4.7), (7.7, 4.7), (7.7, 0.3), (4.05, 0.3), (4.05, 1.0), (3.95, 1.0), (3.95, 0.3)),
    ((3.95, 0.3), (2.7, 0.3), (2.7, 0.0)),
    ((1.2, 0.0), (1.2, 0.3)),
)
PANES: tuple[Line, ...] = tuple(((1.2, y), (2.7, y)) for y in (0.0, 0.12, 0.18, 0.3))
LEAF: Line = ((4.05, 1.0), (4.95, 1.0))


def two_rooms(
    unit_m: float = 0.001,
    layers: tuple[str, str, str] = ("A-WALL", "A-DOOR", "A-GLAZ"),
    insunits: int = 4,
    at: tuple[float, float] = (0.0, 0.0),
    words: bool = True,
) -> DxfDocument:
    """The document; `at` in drawing units is where its lower left corner lies."""
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = insunits
    space = document.modelspace()

    def put(points: Line) -> list[tuple[float, float]]:
        return [(x / unit_m + at[0], y / unit_m + at[1]) for x, y in points]

    wall, door, window = layers
    for line in WALLS:
        space.add_lwpolyline(put(line), dxfattribs={"layer": wall})
    for line in PANES:
        space.add_line(*put(line), dxfattribs={"layer": window})
    space.add_line(*put(LEAF), dxfattribs={"layer": door})
    space.add_arc(put([(4.05, 1.0)])[0], 0.9 / unit_m, 0, 90, dxfattribs={"layer": door})
    if words:
        for text, place in (("Bedroom", (1.5, 2.5)), ("Kitchen", (5.5, 3.5))):
            entity = space.add_text(text, height=0.25 / unit_m, dxfattribs={"layer": "A-ANNO"})
            entity.set_placement(put([place])[0])
    return document


def saved(document: DxfDocument, path: Path) -> Path:
    document.saveas(path)
    return path
