"""The photo of wall and roof without what stands before them."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.cleared.kinds import KINDS
from veduta.facade.cleared.light import even_light
from veduta.facade.cleared.repeats import own_repeats
from veduta.facade.cleared.shadows import shadows_below
from veduta.facade.document import Element, FacadeDocument
from veduta.facade.photo_masks import Mask, PixelBox, element_mask, pixels_of, strip_mask
from veduta.surfaces import Repeated, fill_by_repeats

Pixels = NDArray[np.uint8]
_ROOF, _UPPER, _GROUND = range(3)
# A balcony's pixels spread beyond its rectangle by this share of its height (shadow, handrail).
BALCONY_SPREAD = 0.08
# Below it, its slab ends within this share of its height: the model has one of its own.
SLAB_SPREAD = 0.2
# Other things spread by this share of a storey.
SPREAD = 0.02
# Nothing is filled where more of the picture than this is hidden: it would be all invented.
MOST_HIDDEN = 0.8


@dataclass(frozen=True, eq=False)
class Cleared:
    """pixels (h, w, 3) uint8 sRGB; filled (h, w) bool, what was before the wall.

    shares: of the picture, by what was there. copied: share of the filled that other places of the
    front gave, the rest is interpolated. evened: the largest change of light, as a share. notes:
    what was left as it is, and why.
    """

    pixels: Pixels
    filled: Mask
    shares: dict[str, float]
    copied: float
    evened: float
    notes: tuple[str, ...] = ()


def clear_surface(
    document: FacadeDocument,
    crop: Pixels,
    box: PixelBox,
    before: NDArray[np.uint8],
    unseen: Mask | None = None,
) -> Cleared:
    """Take balconies and what `before` has out of a crop of the photo, and even its light.

    crop: (h, w, 3), the part `box` of the photo. before: (h, w) of the crop, places in `KINDS`.
    unseen: (h, w) what lies outside of the photo, and is filled with the rest.
    """
    _, storey = _repeats(document, box)
    kinds = _with_balconies(document, box, before, storey)
    plain = kinds == 0
    for class_ in ("window", "door", "shop"):
        plain &= ~element_mask(document, box, class_)
    zones = _zones(document, box)
    plain &= (zones[0] == _UPPER)[:, None]
    balconies = [pixels_of(e, box) for e in document.elements if e.class_ == "balcony"]
    shadow = shadows_below(crop, plain, balconies, storey)
    kinds[shadow & (kinds == 0)] = KINDS.index("balcony")
    holes = kinds > 0
    shares = {
        name: float((kinds == place).mean())
        for place, name in enumerate(KINDS)
        if place and (kinds == place).any()
    }
    leaves = _open_leaves(document, box)
    if leaves.any():
        holes = holes | leaves
        shares["shutter"] = float(leaves.mean())
    if unseen is not None and (holes | unseen).mean() <= MOST_HIDDEN:
        holes = holes | unseen
    pixels, copied = crop, 0.0
    notes: tuple[str, ...] = ()
    if holes.any() and holes.mean() <= MOST_HIDDEN:
        made = fill_front(document, crop, box, holes)
        pixels, copied = made.pixels, float(made.copied[holes].mean())
    elif holes.any():
        holes, shares = np.zeros_like(holes), {}
        notes = (f"{kinds.astype(bool).mean():.0%} of the front is hidden: left as in the photo",)
    wall = ~holes
    for class_ in ("window", "door", "shop"):
        wall &= ~element_mask(document, box, class_)
    pixels, evened = even_light(pixels, wall, zones[1], storey)
    return Cleared(pixels, holes, shares, copied, evened, notes)


def fill_front(document: FacadeDocument, crop: Pixels, box: PixelBox, holes: Mask) -> Repeated:
    """Fill the holes (h, w) of a crop by what the windows of the document say of repeats."""
    offsets, storey = _repeats(document, box)
    return fill_by_repeats(crop, holes, offsets, storey, _zones(document, box)[0])


def _repeats(document: FacadeDocument, box: PixelBox) -> tuple[NDArray[np.int64], float]:
    """Offsets (n, 2) between the windows of the document, and the height of a storey (px)."""
    own = own_repeats(_boxes(document, box, "window"))
    return own.offsets, own.storey_px or _mean_storey(document)


def _boxes(document: FacadeDocument, box: PixelBox, wanted: str) -> NDArray[np.float64]:
    """(n, 4) left, top, right, bottom in the crop."""
    rows = [
        (e.x_px, e.y_px, e.x_px + e.width_px, e.y_px + e.height_px)
        for e in document.elements
        if e.class_ == wanted
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 4) - (box.x0, box.y0, box.x0, box.y0)


def _mean_storey(document: FacadeDocument) -> float:
    return document.facade.height_px / max(document.storeys, 1)


def _with_balconies(
    document: FacadeDocument, box: PixelBox, before: NDArray[np.uint8], storey_px: float
) -> NDArray[np.uint8]:
    """What stands before the wall, with the balconies of the document, and a little around all."""
    side = 2 * max(1, round(SPREAD * storey_px)) + 1
    kernel = np.ones((side, side), np.uint8)
    kinds = np.zeros_like(before)
    for place in range(len(KINDS) - 1, 0, -1):
        mask = (before == place).astype(np.uint8)
        if mask.any():
            kinds[cv2.dilate(mask, kernel) > 0] = place
    for element in document.elements:
        if element.class_ == "balcony" and not _is_guess_in_roof(element, document):
            spread = BALCONY_SPREAD * element.height_px
            rows, columns = pixels_of(element, box, spread)
            slab = rows.stop + round((SLAB_SPREAD - BALCONY_SPREAD) * element.height_px)
            kinds[rows.start : slab, columns] = KINDS.index("balcony")
    return kinds


def _open_leaves(document: FacadeDocument, box: PixelBox) -> Mask:
    """Where open shutters lie on the wall that the model has as things of their own.

    A leaf throws a shadow, and its hinges reach to the window: a tenth of its width goes along.
    """
    mask = np.zeros((box.size[1], box.size[0]), dtype=np.bool_)
    if document.model.detail != "library":
        return mask
    for each in document.shutters:
        if each.kind == "open":
            mask |= strip_mask(each, box, max(1, round(0.1 * each.width_px)))
    for class_ in ("window", "door", "shop"):
        mask &= ~element_mask(document, box, class_)
    return mask


def _is_guess_in_roof(element: Element, document: FacadeDocument) -> bool:
    """Whether a balcony is in doubt and lies in the roof: it would take a dormer with it."""
    return element.is_doubtful and element.y_px + 0.5 * element.height_px < document.facade.y_px


def _zones(document: FacadeDocument, box: PixelBox) -> tuple[NDArray[np.int64], slice]:
    """(h,) whether each row is of the roof, the upper floors or the ground floor; the upper rows.

    A front without floors is one zone below its eaves.
    """
    height = box.y1 - box.y0
    eaves = document.facade.y_px - box.y0
    foot = eaves + document.facade.height_px
    floors = document.rules.facade.sizes_m
    ground = foot - floors[0] / document.scale.metres_per_px if len(floors) > 1 else foot
    middles = np.arange(height) + 0.5
    zones = np.where(middles < eaves, _ROOF, np.where(middles < ground, _UPPER, _GROUND))
    upper = np.flatnonzero(zones == _UPPER)
    rows = slice(int(upper[0]), int(upper[-1]) + 1) if len(upper) else slice(0, 0)
    return zones.astype(np.int64), rows
