"""Small facade documents, made by hand."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from veduta.facade.document import (
    DerivationNode,
    Element,
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

Rectangle = tuple[float, float, float, float]
Make = Callable[..., FacadeDocument]

METRES_PER_PX = 0.05


def document(
    size_px: tuple[int, int] = (120, 200),
    box: Rectangle = (10.0, 40.0, 100.0, 150.0),
    extents: list[tuple[FacadeClass, list[tuple[float, float]]]] | None = None,
    elements: list[tuple[FacadeClass, Rectangle]] | None = None,
) -> FacadeDocument:
    """A document of two storeys; rectangles are x, y, width, height in pixels."""
    width_px, height_px = size_px
    x, y, w, h = box
    width_m, height_m = w * METRES_PER_PX, h * METRES_PER_PX
    if extents is None:
        wall = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        extents = [("sky", [(0, 0), (width_px, 0), (width_px, y), (0, y)]), ("wall", wall)]
    return FacadeDocument(
        source=Source(image="a.jpg", sha256="0" * 64, width_px=width_px, height_px=height_px),
        rectification=Rectification(
            method="rectified",
            width_px=width_px,
            height_px=height_px,
            rectified_from_source=[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            aspect="given",
        ),
        scale=Scale(metres_per_px=METRES_PER_PX, basis="assumed-storey"),
        facade=FacadeBox(
            x_px=x, y_px=y, width_px=w, height_px=h, width_m=width_m, height_m=height_m
        ),
        extents=[Extent(class_=name, polygon_px=points) for name, points in extents],
        elements=[
            Element(
                class_=name,
                x_px=ex,
                y_px=ey,
                width_px=ew,
                height_px=eh,
                x_m=(ex - x) * METRES_PER_PX,
                y_m=(y + h - ey - eh) * METRES_PER_PX,
                width_m=ew * METRES_PER_PX,
                height_m=eh * METRES_PER_PX,
                score=0.5,
            )
            for name, (ex, ey, ew, eh) in elements or []
        ],
        storeys=2,
        rules=RuleParameters(
            building_height_m=height_m,
            roof_height_m=0.0,
            facade=Split(symbols=["Gf", "Fl_1"], sizes_m=[height_m / 2, height_m / 2]),
            floors=[Split(symbols=["Wa"], sizes_m=[width_m])] * 2,
        ),
        derivation=DerivationNode(symbol="B", x_m=0, y_m=0, width_m=width_m, height_m=height_m),
        energy={},
    )


@pytest.fixture
def make_document() -> Make:
    """The function that makes a document; see `document`."""
    return document
