"""`plan.dxf`: the storeys beside each other on layers of their own, in metres (R2010).

Doors and windows are blocks: those that look alike are one, placed as often as it stands, with id,
type and width as attributes. Each storey has chains of dimensions along its outer walls.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import ezdxf
from ezdxf import units
from ezdxf.document import Drawing as DxfDocument
from ezdxf.enums import TextEntityAlignment
from ezdxf.layouts.layout import Modelspace

from veduta.plan.drawing import LAYERS, Drawing, Layer, Shape
from veduta.plan.outputs.colours import LAYER_COLOURS, rgb
from veduta.plan.outputs.dxf_blocks import add_dimensions, place_block
from veduta.plan.outputs.svg import GAP_M, text_size_m

_NAMES: dict[Layer, str] = {
    "rooms": "A-AREA",
    "furniture": "A-FURN",
    "walls": "A-WALL",
    "windows": "A-GLAZ",
    "doors": "A-DOOR",
    "stairs": "A-FLOR-STRS",
    "names": "A-AREA-IDEN",
}
"""Layers as the National CAD Standard names them."""
_WEIGHT = {"walls": 50, "windows": 25, "doors": 25}


def plan_dxf(drawings: Sequence[Drawing]) -> bytes:
    """The file's content. The first storey lies where the plan has it, the others to its right."""
    with _same_bytes():
        return _plan_dxf(drawings)


def _plan_dxf(drawings: Sequence[Drawing]) -> bytes:
    document = ezdxf.new("R2010", setup=True, units=units.M)
    for layer in LAYERS:
        entry = document.layers.add(_NAMES[layer], lineweight=_WEIGHT.get(layer, 18))
        entry.rgb = rgb(LAYER_COLOURS[layer])
    space = document.modelspace()
    x = 0.0
    for drawing in drawings:
        left, _, right, top = drawing.bounds_m
        offset = x - left if x else 0.0
        for shape in drawing.shapes:
            if shape.layer in ("doors", "windows"):
                place_block(document, shape, offset, _NAMES[shape.layer])
            else:
                _add(space, shape, offset)
        add_dimensions(document, drawing, offset)
        _add_labels(space, drawing, offset, top)
        x = offset + right + GAP_M
    return _content(document)


def _add(space: Modelspace, shape: Shape, offset: float) -> None:
    layer = {"layer": _NAMES[shape.layer]}
    moved = [[(x + offset, y) for x, y in ring.tolist()] for ring in shape.rings]
    for ring in moved:
        space.add_lwpolyline(ring, close=True, dxfattribs=layer)
    if shape.layer == "walls":
        hatch = space.add_hatch(dxfattribs=layer)
        for number, ring in enumerate(moved):
            hatch.paths.add_polyline_path(ring, is_closed=True, flags=1 if number == 0 else 16)
    for line in shape.lines:
        points = [(x + offset, y) for x, y in line.tolist()]
        space.add_lwpolyline(points, dxfattribs=layer)


def _add_labels(space: Modelspace, drawing: Drawing, offset: float, top: float) -> None:
    layer = {"layer": _NAMES["names"]}
    for label in drawing.labels:
        size = 0.7 * text_size_m(label, drawing)
        at = (label.at_m[0] + offset, label.at_m[1])
        below = (at[0], at[1] - 1.6 * size)
        for text, place in ((label.text, at), (label.detail, below)):
            entity = space.add_text(text, height=size, dxfattribs=layer)
            entity.set_placement(place, align=TextEntityAlignment.MIDDLE_CENTER)
    title = space.add_text(drawing.storey.name, height=0.3, dxfattribs=layer)
    title.set_placement((drawing.bounds_m[0] + offset, top + 0.5))


def _content(document: DxfDocument) -> bytes:
    # ezdxf adds these itself, in the order of a set, which is another one in each process.
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    file = io.StringIO()
    document.write(file)
    return document.encode(file.getvalue())


@contextmanager
def _same_bytes() -> Iterator[None]:
    """No time of writing and no random ids in the file: the same plan gives the same bytes."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
