"""The depth of each opening and balcony before or behind the wall's surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import Element
from veduta.facade.measured.surface import NORMAL, Depths, Mask
from veduta.facade.measured_depths import ClassDepth

OPENINGS = ("window", "door", "shop")


@dataclass(frozen=True)
class ElementParameters:
    """inner: share of an opening's sides that is looked at, for its outline is not exact.
    least_share, fewest_px: of what is looked at that must have a depth.
    most_spread_m: depths of one element that differ by more tell nothing (panes mirror).
    deepest_m, farthest_m: an opening is no deeper, a balcony no farther out.
    out_m: what stands farther out than this belongs to a balcony. out_share: of a balcony's pixels.
    details: the smaller side of an opening must have so many times what the depth map resolves.
    beside_m: so far around an element the wall is that which it lies in: walls bend.
    """

    inner: float = 0.7
    least_share: float = 0.2
    fewest_px: int = 12
    most_spread_m: float = 0.15
    deepest_m: float = 1.5
    farthest_m: float = 3.0
    out_m: float = 0.08
    out_share: float = 0.15
    details: float = 2.0
    beside_m: float = 0.4


def measured_elements(
    elements: Sequence[Element],
    beyond_m: Depths,
    wall: Mask,
    sizes: tuple[float, float],
    parameters: ElementParameters,
) -> list[Element]:
    """The elements, those of which the depth map says it with their `depth_m`.

    beyond_m: (h, w) of the rectified photo's pixels, NaN where unknown. wall: (h, w) what
    belongs to no element. sizes: what is smaller is smoothed away (px), and metres per pixel.
    """
    detail_px, metres_per_px = sizes
    beside_px = max(parameters.beside_m / metres_per_px, detail_px)
    on_wall = np.where(wall, beyond_m, np.float32(np.nan))
    balconies = painted(elements, ("balcony",), beyond_m.shape)
    found = []
    for element in elements:
        depth, side_px = None, min(element.width_px, element.height_px)
        if element.class_ in OPENINGS and side_px >= parameters.details * detail_px:
            own = _part(element, beyond_m, parameters.inner).copy()
            own[_part(element, balconies, parameters.inner)] = np.nan
            depth = _opening(own, parameters)
        elif element.class_ == "balcony" and side_px >= detail_px:
            depth = _balcony(_part(element, beyond_m, 1.0), parameters)
        if depth is not None:
            depth -= _wall_around(element, on_wall, beside_px, parameters)
        found.append(
            element if depth is None else element.model_copy(update={"depth_m": round(depth, 4)})
        )
    return found


def by_class(elements: Sequence[Element], eaves_y_px: float) -> tuple[ClassDepth, ...]:
    """How many of each class were measured below the eaves, with median and spread."""
    found = []
    for kind in (*OPENINGS, "balcony"):
        own = [
            element
            for element in elements
            if element.class_ == kind and element.y_px + 0.5 * element.height_px >= eaves_y_px
        ]
        depths = np.array([element.depth_m for element in own if element.depth_m is not None])
        if len(depths) == 0:
            continue
        middle = float(np.median(depths))
        spread = NORMAL * float(np.median(np.abs(depths - middle)))
        found.append(
            ClassDepth(
                kind=kind,
                measured=len(depths),
                found=len(own),
                median_m=round(middle, 4),
                spread_m=round(spread, 4),
            )
        )
    return tuple(found)


def painted(
    elements: Sequence[Element], kinds: Sequence[str], shape: tuple[int, ...], around: float = 0.0
) -> Mask:
    """(h, w) the pixels of all elements of some kinds; around: border beside them (px)."""
    mask = np.zeros(shape[:2], dtype=np.bool_)
    for element in elements:
        if element.class_ in kinds:
            mask[_rows(element, 1.0, around), _columns(element, 1.0, around)] = True
    return mask


def _opening(depths: NDArray[np.float32], parameters: ElementParameters) -> float | None:
    known = depths[np.isfinite(depths)]
    if len(known) < max(parameters.fewest_px, parameters.least_share * depths.size):
        return None
    depth = float(np.median(known))
    spread = NORMAL * float(np.median(np.abs(known - depth)))
    if spread > parameters.most_spread_m or abs(depth) > parameters.deepest_m:
        return None
    return depth


def _balcony(depths: NDArray[np.float32], parameters: ElementParameters) -> float | None:
    """Of its front: the median of the farther half of what stands out at all."""
    known = depths[np.isfinite(depths)]
    out = known[(known > parameters.out_m) & (known < parameters.farthest_m)]
    if len(out) < max(parameters.fewest_px, parameters.out_share * len(known)):
        return None
    return float(np.quantile(out, 0.75))


def _wall_around(
    element: Element, on_wall: Depths, beside_px: float, parameters: ElementParameters
) -> float:
    """Where the wall around an element lies, before its plane above 0."""
    around = on_wall[_rows(element, 1.0, beside_px), _columns(element, 1.0, beside_px)]
    known = around[np.isfinite(around)]
    return float(np.median(known)) if len(known) >= parameters.fewest_px else 0.0


def _part(element: Element, pixels: NDArray, share: float) -> NDArray:  # type: ignore[type-arg]
    return pixels[_rows(element, share, 0.0), _columns(element, share, 0.0)]


def _rows(element: Element, share: float, around: float) -> slice:
    return _span(element.y_px, element.height_px, share, around)


def _columns(element: Element, share: float, around: float) -> slice:
    return _span(element.x_px, element.width_px, share, around)


def _span(start: float, length: float, share: float, around: float) -> slice:
    """The pixels whose centres lie in the middle share of a stretch, with a border beside it."""
    cut = 0.5 * (1.0 - share) * length - around
    low, high = start + cut, start + length - cut
    return slice(max(0, round(low)), max(0, round(high)))
