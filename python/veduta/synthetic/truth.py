"""The truth about a synthetic photo: sizes in metres, places in pixels, labels per pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.place.semantics import LABELS, Label, SemanticClass
from veduta.synthetic.camera import Camera
from veduta.synthetic.layout import Layout, Rect
from veduta.synthetic.roofs import DORMER_FRONT_M

_LABEL_OF_SEMANTIC: dict[SemanticClass, Label] = {
    SemanticClass.WALL: "wall",
    SemanticClass.CORNICE: "wall",
    SemanticClass.ROOF: "roof",
    SemanticClass.GROUND: "other",
    SemanticClass.WINDOW: "window",
    SemanticClass.DOOR: "door",
    SemanticClass.BALCONY: "balcony",
    SemanticClass.SHOP: "shop",
    SemanticClass.CHIMNEY: "chimney",
    SemanticClass.OTHER: "other",
}


@dataclass(frozen=True)
class TrueElement:
    """One window, door, shop or balcony.

    `rect` is in facade metres; `visible` is what no railing hides from the camera (a window's
    upper part). `quad_px` (4, 2): the corners of `visible` in the photo, seen in the facade
    plane (upper left, upper right, lower right, lower left). `floor` is None in the roof.
    """

    label: Label
    rect: Rect
    visible: Rect
    floor: int | None
    column: int | None
    quad_px: NDArray[np.float64]


@dataclass(frozen=True)
class FacadeTruth:
    """What a perfect reader of the photo would say.

    `photo_from_facade` (3, 3) takes facade metres (x right, y up) to photo pixels. `labels`
    (h, w) uint8: places in LABELS; a balcony covers what its outline covers.
    """

    style: str
    width_m: float
    height_m: float
    storeys: int
    columns: int
    elements: tuple[TrueElement, ...]
    photo_from_facade: NDArray[np.float64]
    labels: NDArray[np.uint8]


def facade_homography(camera: Camera) -> NDArray[np.float64]:
    """Photo pixels from facade metres, for a part that stands at the world's origin."""
    x, z, zero = np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.zeros(3)
    return camera.image_from_plane(zero, x, z)


def elements_of(layout: Layout, camera: Camera) -> tuple[TrueElement, ...]:
    """All windows, doors, shops and balconies of a layout, in the photo of a camera."""
    found = [
        _element(
            o.class_, o.rect, _uncovered(o.rect, layout, camera), o.floor, o.column, 0.0, camera
        )
        for o in layout.openings
    ]
    found += [
        _element("window", rect, rect, None, column, DORMER_FRONT_M, camera)
        for column, rect in enumerate(layout.roof.dormers)
    ]
    found += [
        _element("balcony", b.rect, b.rect, b.floor, b.column, -b.depth_m, camera)
        for b in layout.balconies
    ]
    return tuple(found)


def _element(
    label: Label,
    rect: Rect,
    visible: Rect,
    floor: int | None,
    column: int | None,
    y_m: float,
    camera: Camera,
) -> TrueElement:
    return TrueElement(label, rect, visible, floor, column, _corners_px(visible, y_m, camera))


def _uncovered(rect: Rect, layout: Layout, camera: Camera) -> Rect:
    """A window without the part that a railing hides from the camera, in the facade plane.

    From below, the railing of a deep balcony hides more than what lies behind it.
    """
    low = rect.y_m
    for balcony in layout.balconies:
        cover = balcony.rect
        spans = cover.x_m <= rect.x_m + 0.1 and cover.right_m >= rect.right_m - 0.1
        if spans and cover.y_m <= rect.y_m + 0.3 and rect.y_m < cover.top_m < rect.top_m:
            low = max(low, _seen_height(cover.top_m, balcony.depth_m, camera))
    low = min(low, rect.top_m)
    return Rect(rect.x_m, low, rect.width_m, rect.top_m - low)


def _seen_height(z_m: float, depth_m: float, camera: Camera) -> float:
    """Where, in the facade plane, one sees a point that is `depth_m` in front of it."""
    _, y, z = camera.position_m
    return float(z + (z_m - z) * -y / (-y - depth_m))


def _corners_px(rect: Rect, y_m: float, camera: Camera) -> NDArray[np.float64]:
    x = [rect.x_m, rect.right_m, rect.right_m, rect.x_m]
    z = [rect.top_m, rect.top_m, rect.y_m, rect.y_m]
    return camera.project(np.stack([x, np.full(4, y_m), z], axis=1))[0]


def label_image(feature: NDArray[np.int32], class_codes: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Features per pixel to labels; `class_codes` (f,) are semantic codes, -1 pixels are sky."""
    classes = [SemanticClass.of_code(code) for code in class_codes.tolist()]
    table = [LABELS.index(_LABEL_OF_SEMANTIC[each]) for each in classes]
    table.append(LABELS.index("sky"))
    return np.asarray(table, np.uint8)[feature]
