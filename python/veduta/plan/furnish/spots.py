"""Where an arrangement may come into a room, the best place first."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.plan.furnish.arrangement import Spot, Variant
from veduta.plan.furnish.layout import Layout
from veduta.plan.furnish.room import Stretch
from veduta.plan.furnish.walk import CELL_M

STEP_M = 0.2
FREE_STEP_M = 0.25
MOST_SPOTS = 90
MOST_FREE_SPOTS = 60
_CORNER_M = 0.02


def spots_of(variant: Variant, layout: Layout, rng: np.random.Generator) -> list[Spot]:
    """At most MOST_SPOTS, by the order of walls and the place on them that the variant prefers."""
    if variant.free:
        return _free_spots(layout, rng)
    found: list[tuple[float, Spot]] = []
    for stretch in layout.space.stretches:
        liking = 1.5 * float(rng.random())
        found += [
            (_cost(spot, stretch, centring, variant, layout, rng, liking), spot)
            for spot, centring in _along(stretch, variant, layout)
        ]
    found.sort(key=lambda one: one[0])
    return [spot for _, spot in found[:MOST_SPOTS]]


def _along(
    stretch: Stretch, variant: Variant, layout: Layout
) -> Iterator[tuple[Spot, tuple[float, float]]]:
    """Spots on a stretch, each with the distances to where it could be first and last."""
    half = variant.width_m / 2.0
    # Along a wall, with the room on the left, the right side of what stands there comes first.
    low = half + _margin(variant, "right", stretch.inner_start)
    high = stretch.length - half - _margin(variant, "left", stretch.inner_end)
    if high < low - 1e-6:
        return
    if variant.corner:
        places = [high] if stretch.inner_end else []
    else:
        count = max(1, round((high - low) / STEP_M))
        places = sorted({*np.linspace(low, high, count + 1).round(3).tolist(), (low + high) / 2})
    for place in places:
        spot = Spot(layout.space, stretch.at(place), stretch.turn, stretch)
        yield spot, (place - low, high - place)


def _margin(variant: Variant, side: str, is_corner: bool) -> float:
    if not is_corner:
        return 0.0
    return _CORNER_M if side in variant.sides else max(variant.side_m, _CORNER_M)


def _cost(
    spot: Spot, stretch: Stretch, centring: tuple[float, float], variant: Variant, layout: Layout,
    rng: np.random.Generator, liking: float,
) -> float:  # fmt: skip
    """What is to be small, in metres, more or less. liking: of a wall whose order is free."""
    cost = 0.3 * float(rng.random())
    if variant.order == "near":
        cost += 0.7 * spot.door_m + 0.3 * stretch.door_m
    elif variant.order == "far":
        cost -= 0.5 * spot.door_m + 0.5 * stretch.door_m
    else:
        cost += liking
    if variant.prefer == "ends":
        cost += 1.2 * min(min(centring), 1.5)
    elif variant.prefer == "middle":
        cost += 0.6 * abs(centring[0] - centring[1])
    elif variant.prefer == "window":
        cost += 0.8 * _nearest(spot, [window.zone.centroid for window in layout.space.windows])
    elif variant.prefer == "beside":
        cost += 1.5 * _nearest(spot, [one.shape.centroid for one in layout.stood])
    return cost


def _nearest(spot: Spot, points: list) -> float:  # type: ignore[type-arg]
    return min((float(np.hypot(p.x - spot.at[0], p.y - spot.at[1])) for p in points), default=0.0)


def _free_spots(layout: Layout, rng: np.random.Generator) -> list[Spot]:
    """Points of the room far from all that stands there, turned as its walls are."""
    grid = layout.ways.grid
    free = grid.floor & ~layout.mask & ~grid.covered(layout.space.blocked)
    away = ndimage.distance_transform_edt(free) * CELL_M
    step = round(FREE_STEP_M / CELL_M)
    rows, columns = np.nonzero(away[::step, ::step] > 0.4)
    points = np.column_stack([grid.x[columns * step], grid.y[rows * step]])
    room = away[rows * step, columns * step] + 0.05 * rng.random(len(points))
    best = points[np.argsort(-room, kind="stable")[:MOST_FREE_SPOTS]]
    turns = _turns(layout)
    return [Spot(layout.space, point, turn, None) for point in best for turn in turns]


def _turns(layout: Layout) -> NDArray[np.float64]:
    """Along the longest wall, and across it."""
    if not layout.space.stretches:
        return np.array([0.0])
    longest = max(layout.space.stretches, key=lambda stretch: stretch.length)
    return np.array([longest.turn, longest.turn + np.pi / 2.0])
