"""From the document's rectangles to openings that can be built: none touches another.

Rectangles of a photo may overlap, touch each other or hang over the border. A wall with such
holes does not close, so each is clipped clear of those before it, and what is lost is noted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from veduta.facade.adjusted import clipped, left_out
from veduta.facade.document import Element, FacadeDocument
from veduta.facade.rectangles import Rectangle, carve

# Least wall between two openings, and between an opening and the border (m).
GAP_M = 0.05
# An opening smaller than this in either direction is left out (m).
SMALLEST_M = 0.2
# Thickness of a balcony's slab, which lies below its railing (m).
SLAB_M = 0.15
# A window whose lower edge is at most this far above a balcony's railing opens onto it (m).
RAILING_REACH_M = 0.4
# An opening that is made to reach further down by no more than this counts as seen whole (m).
HIDDEN_M = 0.1
# Share of a door's area in a shop from which it counts as the shop's own door.
INSIDE_SHARE = 0.6
# What the extents are made of; as elements they have no place of their own in a building.
_SURROUNDINGS = {"wall", "roof", "sky", "other"}
_PAINTED_ONLY = "elements of this class are painted into labels.png alone"


@dataclass(frozen=True)
class Opening:
    """A hole in a wall, with the element that it was made from and that one's place in the list."""

    rectangle: Rectangle
    element: Element
    number: int
    children: tuple[Opening, ...] = ()

    @property
    def seen_height_m(self) -> float | None:
        """Height of what the document has of it, where a rule makes it reach further down."""
        seen = self.rectangle.common(rectangle_of(self.element)).height
        return seen if self.rectangle.height - seen > HIDDEN_M else None


@dataclass(frozen=True)
class Layout:
    """Everything that stands on or in the front, in the facade frame (metres)."""

    openings: tuple[Opening, ...]
    dormers: tuple[Opening, ...]
    balconies: tuple[Opening, ...]
    chimneys: tuple[Opening, ...]
    notes: tuple[str, ...]


@dataclass
class _Front:
    """The wall while openings are being placed."""

    wall: Rectangle
    placed: list[Rectangle] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def place(self, element: Element, number: int, wanted: Rectangle) -> Rectangle | None:
        """Clip `wanted` clear of the border and of all before it; None where nothing is left."""
        inside = wanted.common(self.wall.grown(-GAP_M))
        found = carve(inside, self.placed, GAP_M)
        if found.width < SMALLEST_M or found.height < SMALLEST_M:
            reason = "no room beside other openings or the border"
            self.notes.append(left_out(element, number, reason))
            return None
        self.notes.extend(_lost(element, number, wanted, found))
        self.placed.append(found)
        return found


def rectangle_of(element: Element) -> Rectangle:
    """The element's rectangle in the facade frame."""
    return Rectangle(
        element.x_m,
        element.y_m,
        element.x_m + element.width_m,
        element.y_m + element.height_m,
    )


def lay_out(document: FacadeDocument) -> Layout:
    """Place shops, doors, windows and balconies on the wall, dormers and chimneys above it."""
    wall = Rectangle(0.0, 0.0, document.facade.width_m, document.facade.height_m)
    numbered = list(enumerate(document.elements))
    front = _Front(wall)
    balconies = _balconies(numbered, document, front.notes)
    # A way through the house is no door of a shop: it comes first, and cuts a shop around it.
    through = [(n, e) for n, e in numbered if e.class_ == "door" and e.passage]
    cut_first = {n for n, _ in through}
    others = [(n, e) for n, e in numbered if n not in cut_first]
    passages = _doors(through, front, ())
    shops = _shops(others, front)
    doors = [*passages, *_doors(others, front, shops)]
    doors.sort(key=lambda door: door.number)
    windows = _windows(numbered, front, (shops, doors), [each.rectangle for each in balconies])
    front.notes += [left_out(e, n, _PAINTED_ONLY) for n, e in numbered if e.class_ in _SURROUNDINGS]
    roof = [(n, e) for n, e in numbered if _is_above(e, wall)]
    dormers = [Opening(rectangle_of(e), e, n) for n, e in roof if e.class_ == "window"]
    chimneys = [Opening(rectangle_of(e), e, n) for n, e in numbered if e.class_ == "chimney"]
    return Layout(
        openings=(*shops, *doors, *windows),
        dormers=tuple(dormers),
        balconies=tuple(balconies),
        chimneys=tuple(chimneys),
        notes=tuple(front.notes),
    )


Numbered = Sequence[tuple[int, Element]]


def _is_above(element: Element, wall: Rectangle) -> bool:
    """Whether more of it lies above the eaves than below."""
    return element.y_m + 0.5 * element.height_m > wall.z1


def _shops(numbered: Numbered, front: _Front) -> list[Opening]:
    found = []
    for number, element in numbered:
        if element.class_ != "shop":
            continue
        wanted = _down_to_threshold(rectangle_of(element), front.wall)
        place = front.place(element, number, wanted)
        if place is not None:
            doors = _shop_doors(numbered, front, place)
            found.append(Opening(place, element, number, doors))
    return found


def _shop_doors(numbered: Numbered, front: _Front, shop: Rectangle) -> tuple[Opening, ...]:
    """Doors and windows that lie in the shop front are set into it."""
    inner = _Front(shop, notes=front.notes)
    found = []
    for kind in ("door", "window"):
        for number, element in numbered:
            wanted = rectangle_of(element)
            if element.class_ != kind or _share_inside(wanted, shop) < INSIDE_SHARE:
                continue
            place = inner.place(element, number, wanted)
            if place is not None:
                found.append(Opening(place, element, number))
    return tuple(found)


def _doors(numbered: Numbered, front: _Front, shops: Sequence[Opening]) -> list[Opening]:
    found = []
    for number, element in numbered:
        wanted = rectangle_of(element)
        if element.class_ != "door":
            continue
        if _is_above(element, front.wall):
            front.notes.append(left_out(element, number, "it lies above the eaves"))
            continue
        if any(_share_inside(wanted, shop.rectangle) >= INSIDE_SHARE for shop in shops):
            continue
        place = front.place(element, number, _down_to_threshold(wanted, front.wall))
        if place is not None:
            found.append(Opening(place, element, number))
    return found


def _windows(
    numbered: Numbered,
    front: _Front,
    below: tuple[Sequence[Opening], Sequence[Opening]],
    balconies: Sequence[Rectangle],
) -> list[Opening]:
    """Windows from the ground up; one that opens onto a balcony reaches down to its floor.

    below: shops, and doors.
    """
    shops, doors = below
    found = []
    for number, element in sorted(numbered, key=lambda pair: (pair[1].y_m, pair[0])):
        wanted = rectangle_of(element)
        if element.class_ != "window" or _is_above(element, front.wall):
            continue
        if any(_share_inside(wanted, shop.rectangle) >= INSIDE_SHARE for shop in shops):
            continue
        if any(_share_inside(wanted, door.rectangle) >= INSIDE_SHARE for door in doors):
            front.notes.append(left_out(element, number, "it lies in a door"))
            continue
        place = front.place(element, number, _down_to_balcony(wanted, balconies))
        if place is not None:
            found.append(Opening(place, element, number))
    return found


def _balconies(numbered: Numbered, document: FacadeDocument, notes: list[str]) -> list[Opening]:
    """Balconies within the facade's width; they may not stand in the ground."""
    width = document.facade.width_m
    top = document.facade.height_m + max(document.rules.roof_height_m, 0.0)
    allowed = Rectangle(0.0, 0.3, width, max(top, 0.3))
    found: list[Opening] = []
    for number, element in numbered:
        if element.class_ != "balcony":
            continue
        wanted = rectangle_of(element)
        place = carve(wanted.common(allowed), [other.rectangle for other in found], GAP_M)
        if place.width < SMALLEST_M or place.height < SMALLEST_M:
            notes.append(left_out(element, number, "too small or off the facade"))
            continue
        notes.extend(_lost(element, number, wanted, place))
        found.append(Opening(place, element, number))
    return found


def _lost(element: Element, number: int, wanted: Rectangle, found: Rectangle) -> list[str]:
    """The note of a rectangle that lost more than the wall around it."""
    if max(wanted.width - found.width, wanted.height - found.height) <= 2 * GAP_M:
        return []
    before = f"{wanted.width:.2f} x {wanted.height:.2f}"
    after = f"{found.width:.2f} x {found.height:.2f}"
    return [clipped(element, number, f"from {before} m to {after} m")]


def _down_to_threshold(wanted: Rectangle, wall: Rectangle) -> Rectangle:
    """Doors and shops that end near the ground reach down to it."""
    if wanted.z0 > wall.z0 + 0.6:
        return wanted
    return Rectangle(wanted.x0, wall.z0, wanted.x1, wanted.z1)


def _down_to_balcony(wanted: Rectangle, balconies: Sequence[Rectangle]) -> Rectangle:
    """The railing of a balcony hides the lower part of the window behind it."""
    for balcony in balconies:
        beside = min(wanted.x1, balcony.x1) - max(wanted.x0, balcony.x0)
        within = balcony.z0 < wanted.z0 < balcony.z1 + RAILING_REACH_M
        if beside < 0.5 * wanted.width or not within:
            continue
        return Rectangle(wanted.x0, balcony.z0, wanted.x1, wanted.z1)
    return wanted


def _share_inside(rectangle: Rectangle, other: Rectangle) -> float:
    if rectangle.area <= 0.0:
        return 0.0
    return rectangle.common(other).area / rectangle.area
