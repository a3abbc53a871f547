"""Shutters of the document as what is built: leaves on the wall, and before the panes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.cells import snapped
from veduta.facade.document import FacadeDocument, Shutter
from veduta.facade.layout import Opening, rectangle_of
from veduta.facade.rectangles import Rectangle, carve


@dataclass(frozen=True)
class ShutterLimits:
    """Shutters that are narrower or lower are left out (m): the model would have slivers.

    inside: the share of a closed one that lies before one opening; what lies beside that is cut
    off. A window that was left out, or stands in a roof, has none. foot: one that ends where its
    window was seen to end, within this share of its height, goes down with it to a balcony's floor.
    beside_m: how far from its window an open one may lie.
    """

    wide_m: float = 0.12
    high_m: float = 0.3
    inside: float = 0.5
    foot: float = 0.1
    beside_m: float = 0.1


@dataclass(frozen=True)
class PlannedShutter:
    """Where a shutter lies on the front (m), its number in the document, and what that says."""

    number: int
    place: Rectangle
    shutter: Shutter


def plan_shutters(
    document: FacadeDocument,
    wall: Rectangle,
    openings: Sequence[Opening],
    notes: list[str],
    limits: ShutterLimits | None = None,
) -> tuple[PlannedShutter, ...]:
    """The shutters of a document: open ones clear of all openings, closed ones within theirs.

    notes: gets what is not built, and why.
    """
    own = limits or ShutterLimits()
    found: list[PlannedShutter] = []
    open_leaves: list[Rectangle] = []
    holes = [opening.rectangle for opening in openings]
    for number, each in enumerate(document.shutters):
        seen = _down_with(_metres(each, document), openings, own)
        if not _is_at_one(seen, openings, own):
            notes.append(_not_built(number, each, "no window that is built is beside it"))
            continue
        if each.kind == "open":
            place = carve(seen.common(wall), [*holes, *open_leaves], 0.0)
        else:
            place = _before(seen, holes, own)
        if place.width < own.wide_m or place.height < own.high_m:
            notes.append(_not_built(number, each, "it is too small, or has no room"))
            continue
        if each.kind == "open":
            open_leaves.append(place)
        found.append(PlannedShutter(number, snapped(place), each))
    return tuple(found)


def _not_built(number: int, shutter: Shutter, reason: str) -> str:
    return f"{shutter.kind} shutter (shutters[{number}]): not built, {reason}"


def _is_at_one(seen: Rectangle, openings: Sequence[Opening], own: ShutterLimits) -> bool:
    """Whether one of the openings is under it or beside it, as it was seen or as it is built."""
    near = seen.grown(own.beside_m)
    places = [p for o in openings for p in (o.rectangle, rectangle_of(o.element))]
    return any(near.common(place).area > 0.0 for place in places)


def _metres(shutter: Shutter, document: FacadeDocument) -> Rectangle:
    """The rectangle in the facade frame."""
    box, m = document.facade, document.scale.metres_per_px
    left = (shutter.x_px - box.x_px) * m
    top = (box.y_px + box.height_px - shutter.y_px) * m
    return Rectangle(left, top - shutter.height_px * m, left + shutter.width_px * m, top)


def _down_with(seen: Rectangle, openings: Sequence[Opening], own: ShutterLimits) -> Rectangle:
    """The shutter, as far down as the window that it belongs to."""
    for opening in openings:
        window, built = rectangle_of(opening.element), opening.rectangle
        touches = window.grown(own.beside_m).common(seen).area > 0.0
        if touches and built.z0 < seen.z0 < window.z0 + own.foot * seen.height:
            return Rectangle(seen.x0, built.z0, seen.x1, seen.z1)
    return seen


def _before(seen: Rectangle, openings: Sequence[Rectangle], own: ShutterLimits) -> Rectangle:
    """What of a closed shutter lies before the opening that it covers; empty where none does."""
    common = max((seen.common(one) for one in openings), key=lambda r: r.area, default=None)
    if common is None or common.area < own.inside * seen.area:
        return Rectangle(0.0, 0.0, 0.0, 0.0)
    return common
