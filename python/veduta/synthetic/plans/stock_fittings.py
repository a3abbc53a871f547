"""What a builder's catalogue draws in rooms: tubs in alcoves, counters, rods, a hearth."""

from __future__ import annotations

from shapely.geometry import Point, Polygon, box

from veduta.synthetic.plans.gallery import Gallery
from veduta.synthetic.plans.house import Fitting, Room, Storey
from veduta.synthetic.plans.ranch import GREAT, OWNERS_BATH, WALK_IN, Ranch
from veduta.synthetic.plans.sanitary import basin, closet
from veduta.synthetic.plans.stock_doors import Pen

Bounds = tuple[float, float, float, float]
TUB_M = 0.76


def fitted(pen: Pen, storey: Storey, size: Ranch | Gallery) -> tuple[Fitting, ...]:
    """All of a storey; what has no kind of its own (rods, hearth, island) is drawn alone."""
    found: list[Fitting] = []
    for room in storey.rooms:
        at = Polygon(room.outline_m).bounds
        if room.use == "bathroom" and isinstance(size, Ranch) and room.id == OWNERS_BATH:
            found += _owners_bath(pen, at)
        elif room.use == "bathroom":
            found += _bath(pen, at)
        elif room.use == "kitchen":
            found += _kitchen(pen, at, size)
        elif room.use == "utility":
            found += _laundry(pen, at)
        elif room.use == "wardrobe":
            _rods(pen, room, at, isinstance(size, Ranch))
        elif room.id == GREAT and isinstance(size, Ranch):
            _hearth(pen, at, size)
    return tuple(found)


def _tub(pen: Pen, area: Bounds) -> Fitting:
    """From wall to wall, with a rounded basin and its drain."""
    left, bottom, right, top = area
    pen.outline(box(*area))
    pen.outline(box(left + 0.3, bottom + 0.3, right - 0.3, top - 0.3).buffer(0.2))
    wide = right - left > top - bottom
    drain = (left + 0.3, (bottom + top) / 2.0) if wide else ((left + right) / 2.0, bottom + 0.3)
    pen.outline(Point(*drain).buffer(0.04))
    return Fitting("bathtub", area)


def _bath(pen: Pen, at: Bounds) -> list[Fitting]:
    """A tub in the alcove at the window's end, the toilet and the basin along a side."""
    left, bottom, right, top = at
    tub = _tub(pen, (left, bottom, right, bottom + TUB_M))
    return [
        tub,
        closet(pen.canvas, (left, bottom + TUB_M + 0.2), pen.width_px, pen.ink),
        basin(pen.canvas, (left, top - 0.75), pen.width_px, pen.ink),
    ]


def _owners_bath(pen: Pen, at: Bounds) -> list[Fitting]:
    """A tub in a deck across the corner of the room, a shower of glass, two basins in a counter."""
    left, bottom, right, _ = at
    tub = _tub(pen, (left, bottom, left + 1.7, bottom + 0.95))
    shower = (right - 1.0, bottom, right, bottom + 1.1)
    pen.outline(box(*shower))
    pen.line(shower[:2], shower[2:], width=0.7)
    pen.line((shower[0], shower[3]), (shower[2], shower[1]), width=0.7)
    middle = (left + 0.28, bottom + 1.95)
    pen.outline(box(left, bottom + 1.3, left + 0.55, bottom + 3.0))
    for shift in (-0.3, 0.55):
        pen.outline(Point(middle[0], middle[1] + shift).buffer(0.17))
    basins = [
        Fitting(
            "basin", (middle[0] - 0.2, middle[1] + y - 0.2, middle[0] + 0.2, middle[1] + y + 0.2)
        )
        for y in (-0.3, 0.55)
    ]
    toilet = closet(pen.canvas, (left, bottom + 3.2), pen.width_px, pen.ink)
    return [tub, Fitting("shower", shower), *basins, toilet]


def _kitchen(pen: Pen, at: Bounds, size: Ranch | Gallery) -> list[Fitting]:
    """A counter along the right wall and part of the front one, an island, a range, an icebox."""
    left, bottom, right, top = at
    if isinstance(size, Ranch):
        top = min(top, size.deep - 0.1)
    deep = 0.63
    pen.line((right - deep, top), (right - deep, bottom + deep), (left + 2.2, bottom + deep),
             (left + 2.2, bottom))  # fmt: skip
    pen.line((right - 0.32, top), (right - 0.32, bottom + 0.32), (left + 2.2, bottom + 0.32),
             width=0.6)  # fmt: skip
    hob = (left + 2.5, bottom, left + 3.26, bottom + deep)
    pen.outline(box(*hob))
    for x in (hob[0] + 0.2, hob[2] - 0.2):
        for y in (bottom + 0.18, bottom + 0.45):
            pen.outline(Point(x, y).buffer(0.09))
    middle = (bottom + top) / 2.0 + 0.3
    sink = (right - 0.55, middle - 0.4, right - 0.12, middle + 0.4)
    for low in (sink[1] + 0.02, middle + 0.02):
        pen.outline(box(sink[0], low, sink[2], low + 0.36).buffer(-0.03).buffer(0.03))
    ice = box(right - 0.85, top - 0.95, right, top - 0.05)
    pen.canvas.fill(ice, (255, 255, 255))
    pen.outline(ice)
    pen.line((right - 0.85, top - 0.95), (right, top - 0.05), width=0.7)
    island = box(left + 2.0, bottom + 1.75, left + 3.9, bottom + 2.6)
    pen.outline(island)
    pen.line((left + 2.0, bottom + 2.35), (left + 3.9, bottom + 2.35), width=0.7)
    return [Fitting("hob", hob), Fitting("kitchen-sink", sink)]


def _laundry(pen: Pen, at: Bounds) -> list[Fitting]:
    """A washer and a dryer side by side at the wall."""
    left, bottom, right, _ = at
    side = min(0.66, (right - left - 0.9) / 2.0)
    first = (right - side, bottom, right, bottom + side)
    second = (right - 2 * side, bottom, right - side, bottom + side)
    for area, letter in ((first, "D"), (second, "W")):
        pen.outline(box(*area))
        middle = ((area[0] + area[2]) / 2.0, (area[1] + area[3]) / 2.0)
        pen.canvas.text(letter, middle, 0.16 / pen.canvas.metres_per_px, "sans", pen.ink)
    return [Fitting("washer", second)]


def _rods(pen: Pen, room: Room, at: Bounds, house: bool) -> None:
    """A shelf and a rod: around a closet that is walked into, along a shallow one."""
    left, bottom, right, top = at
    if house and room.id == WALK_IN:
        inner = (left + 0.5, bottom + 0.5, right - 0.5)
        pen.line((inner[0], top - 1.3), (inner[0], inner[1]), (inner[2], inner[1]),
                 (inner[2], top - 0.4))  # fmt: skip
        pen.dashed((left + 0.3, top - 1.3), (left + 0.3, bottom + 0.3))
        pen.dashed((right - 0.3, top - 0.4), (right - 0.3, bottom + 0.3))
        return
    rod = left + 0.72 * (right - left)
    pen.dashed((rod, bottom), (rod, top))


def _hearth(pen: Pen, at: Bounds, size: Ranch) -> None:
    """A box of a chimney at the wall to the owners' bedroom, its fire, and a slab before it."""
    x = size.suite + 0.06
    low = size.front + (size.deep - size.front + size.corner) / 2.0 - 0.5
    pen.outline(box(x, low, x + 0.6, low + 1.5))
    pen.outline(Polygon([(x + 0.6, low + 0.3), (x + 0.6, low + 1.2), (x + 0.2, low + 1.0),
                         (x + 0.2, low + 0.5)]))  # fmt: skip
    pen.outline(box(x + 0.6, low, x + 1.0, low + 1.5))
