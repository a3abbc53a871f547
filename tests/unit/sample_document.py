"""A facade made by hand, with its photo drawn from it: five storeys, a shop and a mansard."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import (
    DerivationNode,
    Element,
    EnergyTerm,
    Extent,
    FacadeBox,
    FacadeClass,
    FacadeDocument,
    Rectification,
    RuleParameters,
    Scale,
    Source,
    Split,
)
from veduta.facade.options import ModelSizes

METRES_PER_PX = 0.025
FACADE_M = (12.0, 15.0)
FACADE_LEFT_PX, EAVES_PX = 20.0, 180.0
PHOTO_PX = (520, 800)  # width, height
ROOF_M = 3.6


def element(
    class_: FacadeClass, x_m: float, y_m: float, width_m: float, height_m: float
) -> Element:
    """An element whose pixels and metres agree with this module's constants."""
    return Element.model_validate(
        {
            "class": class_,
            "x_px": FACADE_LEFT_PX + x_m / METRES_PER_PX,
            "y_px": EAVES_PX + (FACADE_M[1] - y_m - height_m) / METRES_PER_PX,
            "width_px": width_m / METRES_PER_PX,
            "height_px": height_m / METRES_PER_PX,
            "x_m": x_m,
            "y_m": y_m,
            "width_m": width_m,
            "height_m": height_m,
            "score": 1.0,
            "provenance": "measured",
        }
    )


def sample_elements() -> list[Element]:
    """A shop with a door in it, a house door, windows on four floors, balconies, dormers."""
    found = [
        element("shop", 0.6, 0.0, 7.4, 3.0),
        element("door", 9.2, 0.0, 1.6, 2.8),
        element("door", 3.6, 0.1, 1.2, 2.5),
    ]
    for floor in range(1, 5):
        for column in range(4):
            found.append(element("window", 1.1 + 2.9 * column, 0.9 + 3.0 * floor, 1.2, 1.7))
    found.append(element("balcony", 0.4, 6.1, 11.2, 1.0))
    found += [element("balcony", 0.9 + 2.9 * column, 9.1, 1.6, 0.9) for column in range(4)]
    found += [element("window", 1.2 + 2.9 * column, 15.6, 1.0, 1.5) for column in range(4)]
    found.append(element("chimney", 8.9, 17.9, 1.4, 1.3))
    return found


def sample_document(
    elements: list[Element] | None = None,
    roof_m: float = ROOF_M,
    facade_m: tuple[float, float] = FACADE_M,
    sizes: ModelSizes | None = None,
) -> FacadeDocument:
    """The document; its extents are sky, roof and wall."""
    width_px, height_px = PHOTO_PX
    left, right = FACADE_LEFT_PX, FACADE_LEFT_PX + FACADE_M[0] / METRES_PER_PX
    ridge, ground = EAVES_PX - ROOF_M / METRES_PER_PX, EAVES_PX + FACADE_M[1] / METRES_PER_PX
    extents = [
        _band("sky", 0.0, float(width_px), 0.0, float(height_px)),
        _band("roof", left, right, ridge, EAVES_PX),
        _band("wall", left, right, EAVES_PX, ground),
        _band("other", 0.0, float(width_px), ground, float(height_px)),
    ]
    split = Split(symbols=["Gf", "Fl_1", "Fl_2", "Fl_3", "Fl_4"], sizes_m=[3.0] * 5)
    return FacadeDocument(
        source=Source(image="sample.jpg", sha256="0" * 64, width_px=width_px, height_px=height_px),
        rectification=Rectification(
            method="rectified",
            width_px=width_px,
            height_px=height_px,
            rectified_from_source=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            aspect="given",
        ),
        scale=Scale(metres_per_px=METRES_PER_PX, basis="height"),
        facade=FacadeBox(
            x_px=FACADE_LEFT_PX,
            y_px=EAVES_PX,
            width_px=facade_m[0] / METRES_PER_PX,
            height_px=facade_m[1] / METRES_PER_PX,
            width_m=facade_m[0],
            height_m=facade_m[1],
        ),
        model=sizes or ModelSizes(detail="photo"),
        extents=extents,
        elements=sample_elements() if elements is None else elements,
        storeys=5,
        rules=RuleParameters(
            building_height_m=facade_m[1], roof_height_m=roof_m, facade=split, floors=[]
        ),
        derivation=DerivationNode(
            symbol="Footprint", x_m=0.0, y_m=0.0, width_m=facade_m[0], height_m=facade_m[1]
        ),
        energy={"floors": EnergyTerm(total=-0.5, terms={}, nodes=0, labels=0)},
    )


def _band(class_: FacadeClass, x0: float, x1: float, y0: float, y1: float) -> Extent:
    return Extent.model_validate(
        {"class": class_, "polygon_px": [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]}
    )


_COLOURS: dict[str, tuple[int, int, int]] = {
    "sky": (178, 205, 232),
    "roof": (92, 102, 116),
    "wall": (214, 199, 172),
    "other": (120, 118, 114),
    "window": (58, 70, 84),
    "door": (76, 46, 30),
    "shop": (44, 74, 66),
    "balcony": (40, 40, 44),
    "chimney": (150, 92, 70),
}


def sample_photo(document: FacadeDocument, seed: int = 1) -> NDArray[np.uint8]:
    """(h, w, 3) uint8 sRGB: the document painted in plain colours with a little noise."""
    size = (document.rectification.height_px, document.rectification.width_px, 3)
    photo = np.zeros(size, dtype=np.uint8)
    for extent in document.extents:
        corners = np.round(np.array(extent.polygon_px)).astype(np.int32)
        cv2.fillPoly(photo, [corners], _COLOURS[extent.class_])
    for item in document.elements:
        corner = (round(item.x_px), round(item.y_px))
        other = (round(item.x_px + item.width_px) - 1, round(item.y_px + item.height_px) - 1)
        cv2.rectangle(photo, corner, other, _COLOURS[item.class_], -1)
        if item.class_ == "window":
            cv2.rectangle(photo, corner, other, (236, 234, 226), 2)
            middle = (corner[0] + other[0]) // 2
            cv2.line(photo, (middle, corner[1]), (middle, other[1]), (236, 234, 226), 2)
    noise = np.random.default_rng(seed).normal(0.0, 5.0, size)
    return np.clip(photo + noise, 0, 255).astype(np.uint8)
