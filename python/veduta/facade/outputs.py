"""The pictures of a facade document: the label image, and what was found drawn over the photo.

`labels.png` follows from `facade.json` alone. Extents are painted in order as polygons, then the
elements in order as rectangles, or as the polygons of their outlines; a shape owns a pixel when the
pixel's centre is inside it. A centre on a left or upper border is inside, one on a right or lower
border is not, so that shapes which share a border never both own a pixel. What no shape owns is
`other`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.facade.document import FacadeClass, FacadeDocument
from veduta.imaging.encode import png_bytes

COLOURS: dict[FacadeClass, tuple[int, int, int]] = {
    "window": (74, 144, 217),
    "wall": (226, 201, 160),
    "balcony": (150, 92, 190),
    "door": (226, 120, 50),
    "roof": (98, 104, 128),
    "chimney": (158, 74, 66),
    "sky": (190, 224, 240),
    "shop": (86, 164, 106),
    "other": (150, 150, 150),
}
"""sRGB of each class in label images, overlays and reports."""


def rasterise(document: FacadeDocument) -> NDArray[np.uint8]:
    """(h, w) labels at the size of the rectified image; a label is the place in `classes`."""
    place = {name: index for index, name in enumerate(document.classes)}
    size = document.rectification
    labels = np.full((size.height_px, size.width_px), place["other"], dtype=np.uint8)
    for extent in document.extents:
        _paint_polygon(labels, np.array(extent.polygon_px), place[extent.class_])
    for element in document.elements:
        if element.outline_px:
            _paint_polygon(labels, np.array(element.outline_px), place[element.class_])
            continue
        rows = _centres_between(element.y_px, element.y_px + element.height_px)
        columns = _centres_between(element.x_px, element.x_px + element.width_px)
        labels[rows, columns] = place[element.class_]
    return labels


def label_png(document: FacadeDocument, labels: NDArray[np.uint8]) -> bytes:
    """(h, w) labels as an 8-bit palette PNG whose index is the place in `classes`."""
    image = Image.fromarray(labels)
    image.putpalette([part for name in document.classes for part in COLOURS[name]])
    return png_bytes(image, optimize=True)


def coloured(document: FacadeDocument, labels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB of (h, w) labels."""
    palette = np.array([COLOURS[name] for name in document.classes], dtype=np.uint8)
    return palette[labels]


def _centres_between(start: float, end: float) -> slice:
    """The pixels whose centre c holds start <= c < end; the centre of pixel i is i + 0.5."""
    first = max(0, int(np.ceil(start - 0.5)))
    return slice(first, max(first, int(np.ceil(end - 0.5))))


def _paint_polygon(labels: NDArray[np.uint8], polygon: NDArray[np.float64], label: int) -> None:
    """Paint an (n, 2) polygon by the even-odd rule, in the pixels' own frame.

    Each edge toggles, in every row whose centre line it crosses, all pixels whose centres lie on
    or right of the crossing: what is toggled an odd number of times is inside. Only the rows and
    columns that the polygon covers are looked at: a document may hold many small ones.
    """
    if len(polygon) < 3:
        return
    (left, top), (right, bottom) = polygon.min(axis=0), polygon.max(axis=0)
    # One column more on either side: a crossing may be rounded past the end of its edge.
    down, across = _centres_between(top, bottom), _centres_between(left - 1.0, right + 1.0)
    part = labels[down, across]
    if part.size == 0:
        return
    height, width = part.shape
    toggles = np.zeros((height, width + 1), dtype=np.bool_)
    for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        covered = _centres_between(min(y0, y1), max(y0, y1))
        rows = np.arange(covered.start, min(covered.stop, down.start + height))
        if len(rows) == 0:
            continue
        if y0 > y1:  # the same crossings, to the last bit, for both owners of a shared edge
            x0, y0, x1, y1 = x1, y1, x0, y0
        crossing = x0 + (rows + 0.5 - y0) * ((x1 - x0) / (y1 - y0))
        columns = np.clip(np.ceil(crossing - 0.5) - across.start, 0, width).astype(np.intp)
        toggles[rows - down.start, columns] ^= True
    inside = np.logical_xor.accumulate(toggles[:, :-1], axis=1)
    part[inside] = label
