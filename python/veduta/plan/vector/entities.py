"""The entities of a DXF drawing as plain lines, filled shapes and words with their roles."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from ezdxf import path as paths
from ezdxf.disassemble import make_primitive
from ezdxf.document import Drawing as DxfDocument
from ezdxf.entities import DXFEntity, DXFGraphic, Hatch, Insert, LWPolyline, MText
from ezdxf.entities import Text as DxfText
from ezdxf.lldxf.const import DXFError
from ezdxf.math import Vec3
from numpy.typing import NDArray

from veduta.plan.vector.layers import Role, role_of

Points = NDArray[np.float64]
MOST_ENTITIES = 400_000
"""Blocks in blocks can make any number of entities out of a small file."""
_LOOKED_AT = 5
"""So many times as many are looked at: blocks may hold nothing but blocks, or what is not shown."""
_DEEPEST = 12
_MOST_WORDS = 4
"""Lines of more words are remarks for builders, and no names of rooms."""
_FLAT = 2e-3
"""Curves stray by at most this share of their size from the lines that stand for them."""
_LINES = frozenset({"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE"})
_FILLED = frozenset({"SOLID", "TRACE"})
_SOLID_BODIES = frozenset(
    {"3DFACE", "3DSOLID", "MESH", "BODY", "REGION", "SURFACE", "EXTRUDEDSURFACE"}
)
_NO_DRAWING = frozenset({"DIMENSION", "LEADER", "MULTILEADER", "VIEWPORT", "POINT", "ATTDEF"})
_FAULTS = (DXFError, ValueError, TypeError, ZeroDivisionError, AttributeError, KeyError)


@dataclass(frozen=True)
class Stroke:
    """A line of points (n, 2) in drawing units; `arc`: its radius, middle and sweep if it is one.

    `width` is that of the pen, 0 for a line without any.
    """

    role: Role
    points: Points
    width: float = 0.0
    arc: tuple[float, float, float, float] | None = None


@dataclass(frozen=True)
class Word:
    """A line of text; `box` (4, 2) in drawing units: upper left, upper right, and so on round."""

    text: str
    box: Points


@dataclass
class Entities:
    """All of a drawing's model space that may be of a plan."""

    strokes: list[Stroke] = field(default_factory=list)
    filled: list[tuple[Role, list[Points]]] = field(default_factory=list)
    """Outlines of hatches and solids."""
    words: list[Word] = field(default_factory=list)
    bodies: int = 0
    """3D faces and solids, which are no drawing."""
    unread: Counter[str] = field(default_factory=Counter)
    """Entities that could not be understood, by their type."""
    missing: list[str] = field(default_factory=list)
    """Files that this one refers to and does not hold."""
    more: bool = False
    """Whether there were more than are read."""
    left: int = 0
    """How many are looked at still."""


def entities_of(document: DxfDocument, most: int = MOST_ENTITIES) -> Entities:
    """What the model space shows: layers that are off or frozen are left out.

    After `most` entities no more are read, nor after some times as many that show nothing.
    """
    found = Entities(left=_LOOKED_AT * most)
    hidden = {
        layer.dxf.name.lower()
        for layer in document.layers
        if layer.is_off() or layer.is_frozen() or layer.dxf.name.lower() == "defpoints"
    }
    shown = _shown(document.modelspace(), "other", "0", hidden, found, 0)
    for number, (role, entity) in enumerate(shown):
        if number >= most:
            found.more = True
            break
        try:
            _take(role, entity, found)
        except _FAULTS:
            found.unread[entity.dxftype()] += 1
    return found


def _shown(
    entities: Iterable[DXFEntity],
    role: Role,
    layer: str,
    hidden: set[str],
    found: Entities,
    depth: int,
) -> Iterator[tuple[Role, DXFGraphic]]:
    """Entities with blocks taken apart; what lies on layer 0 of a block is on the block's layer."""
    for entity in entities:
        if not _goes_on(found):
            return
        if not isinstance(entity, DXFGraphic) or entity.dxf.get("invisible", 0):
            continue
        own = str(entity.dxf.get("layer", "0"))
        own = layer if own == "0" else own
        if own.lower() in hidden:
            continue
        named = role_of(own)
        mine = role if named == "other" else named
        kind = entity.dxftype()
        if isinstance(entity, Insert):
            yield from _inside(entity, mine, own, hidden, found, depth)
        elif kind == "MLINE":
            for part in entity.virtual_entities():  # type: ignore[attr-defined]
                yield mine, part
        elif kind not in _NO_DRAWING:
            yield mine, entity


def _inside(
    insert: Insert, role: Role, layer: str, hidden: set[str], found: Entities, depth: int
) -> Iterator[tuple[Role, DXFGraphic]]:
    block = insert.block()
    if block is None or depth >= _DEEPEST:
        found.unread["INSERT"] += 1
        return
    if block.block is not None and block.block.is_xref:
        found.missing.append(str(block.block.dxf.get("xref_path", block.name)))
        return
    named = role_of(block.name)
    mine: Role = named if role == "other" else role
    yield from ((mine, one) for one in insert.attribs if not one.is_invisible)
    try:
        for single in insert.multi_insert() if insert.mcount > 1 else (insert,):
            # An array has copies without end of a block without content.
            if not _goes_on(found):
                return
            yield from _shown(single.virtual_entities(), mine, layer, hidden, found, depth + 1)
    except _FAULTS:
        found.unread["INSERT"] += 1


def _goes_on(found: Entities) -> bool:
    """Whether one more is looked at."""
    found.left -= 1
    found.more |= found.left < 0
    return found.left >= 0


def _take(role: Role, entity: DXFGraphic, found: Entities) -> None:
    kind = entity.dxftype()
    if kind in ("TEXT", "ATTRIB", "MTEXT"):
        found.words += _words(entity)
    elif kind in _SOLID_BODIES:
        found.bodies += 1
    elif isinstance(entity, Hatch):
        rings = [_flat(one) for one in paths.from_hatch(entity)]
        rings = [ring for ring in rings if len(ring) >= 4]
        # Only where paint is a wall: floors and shades are hatched, too.
        if rings and (role == "wall"):
            found.filled.append((role, rings))
    elif kind in _FILLED:
        corners = np.array([(at.x, at.y) for at in entity.wcs_vertices()])  # type: ignore[attr-defined]
        found.filled.append((role, [corners]))
    elif kind in _LINES:
        _take_line(role, entity, found)
    else:
        found.unread[kind] += 1


def _take_line(role: Role, entity: DXFGraphic, found: Entities) -> None:
    if entity.dxftype() == "POLYLINE" and (entity.is_poly_face_mesh or entity.is_polygon_mesh):  # type: ignore[attr-defined]
        found.bodies += 1
        return
    width = 0.0
    if isinstance(entity, LWPolyline):
        width = float(entity.dxf.get("const_width", 0.0))
    for path in paths.make_path(entity).sub_paths():
        points = _flat(path)
        if len(points) > 1 and float(np.ptp(points, axis=0).max()) > 0.0:
            found.strokes.append(Stroke(role, points, width, _arc(entity)))


def _flat(path: paths.Path) -> Points:
    """The path as points (n, 2), without repeated ones."""
    control = np.array([(at.x, at.y) for at in path.control_vertices()])
    if not len(control) or not np.isfinite(control).all():
        return np.empty((0, 2))
    size = float(np.ptp(control, axis=0).max())
    if not path.has_curves:
        points = control
    else:
        distance = max(_FLAT * size, 1e-9)
        points = np.array([(at.x, at.y) for at in path.flattening(distance, segments=8)])
    fresh = np.r_[True, (np.abs(np.diff(points, axis=0)) > 0).any(axis=1)]
    return np.asarray(points[fresh], dtype=np.float64)


def _arc(entity: DXFGraphic) -> tuple[float, float, float, float] | None:
    """Radius, centre and sweep (degrees) of an arc that stands by itself."""
    if entity.dxftype() != "ARC":
        return None
    centre = entity.ocs().to_wcs(Vec3(entity.dxf.center))
    sweep = (float(entity.dxf.end_angle) - float(entity.dxf.start_angle)) % 360.0
    return float(entity.dxf.radius), float(centre.x), float(centre.y), sweep


def _words(entity: DXFGraphic) -> list[Word]:
    """The lines of a text with a box each; by the font's usual widths, so boxes are rough."""
    if isinstance(entity, MText):
        lines = [line.strip() for line in entity.plain_text(split=True)]
    elif isinstance(entity, DxfText):
        lines = [entity.plain_text().strip()]
    else:
        return []
    corners = np.array([(at.x, at.y) for at in make_primitive(entity).vertices()])
    if len(corners) < 4 or not any(lines) or not np.isfinite(corners).all():
        return []
    low_left, low_right, up_right, up_left = corners[:4]
    shares = np.linspace(0.0, 1.0, len(lines) + 1)
    found = []
    for line, above, below in zip(lines, shares[:-1], shares[1:], strict=True):
        if line and sum(word[:1].isalpha() for word in line.split()) <= _MOST_WORDS:
            box = [
                up_left + above * (low_left - up_left),
                up_right + above * (low_right - up_right),
                up_right + below * (low_right - up_right),
                up_left + below * (low_left - up_left),
            ]
            found.append(Word(line, np.array(box)))
    return found
