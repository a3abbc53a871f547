"""What the learned eyes say of a front, as evidence for and against a class at each place of it.

`P(picture | class)` of a cell is, but for a factor that is the same for all classes, the chance
that the network gives the class divided by how frequent the class is. A style's label is not what
is there everywhere: with `stray` of the cells it is anything. What something else hides says
nothing. So the logarithm of the likelihood of a label, against that of a cell of which nothing is
known, is

    log(hidden + (1 - hidden) (stray + (1 - stray) chance / frequency))

and that of a front is the sum over its cells. Cells beside each other fail together: a cell counts
as much as its area has of a `patch`, over which what the network says is about one observation.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import FacadeDocument
from veduta.facade.eyes import Seen, SeenElement, seen_elements

LABELS = ("sky", "roof", "wall", "shop", "door", "window", "balcony")
"""What a cell of a front may be; the place in it is the label."""
KINDS = ("window", "balcony", "door", "shop")
"""The labels whose single elements have boxes."""
_SEEN: dict[str, tuple[str, ...]] = {
    "sky": ("sky",),
    "roof": ("roof",),
    "wall": ("wall", "cornice", "sill", "ornament", "pillar"),
    "shop": ("shop",),
    "door": ("door",),
    "window": ("window", "blind"),
    "balcony": ("balcony",),
}
Float = NDArray[np.float64]


@dataclass(frozen=True)
class ObservedParameters:
    """How a front is looked at; lengths in metres of the document.

    cell_m: the side of a cell. patch_m2: the area that counts as one observation, less than a
    window. above_m: how much above the eaves is looked at: a mansard is not higher. stray: share of
    cells where a label says nothing, as the share of pixels that the eyes get wrong (0.15 on ECP).
    frequency: of the labels in fronts. confused: share of a label's cells that look like another
    one, as seen on renders of the styles: glass in shops, doors of glass, slate, thin railings.
    """

    cell_m: float = 0.15
    patch_m2: float = 0.5
    above_m: float = 6.0
    stray: float = 0.15
    frequency: tuple[float, ...] = (0.10, 0.08, 0.43, 0.06, 0.02, 0.20, 0.11)
    confused: tuple[tuple[str, str, float], ...] = (
        ("roof", "wall", 0.25),
        ("roof", "shop", 0.05),
        ("shop", "window", 0.25),
        ("shop", "door", 0.1),
        ("door", "shop", 0.25),
        ("door", "window", 0.15),
        ("window", "shop", 0.15),
        ("balcony", "window", 0.1),
        ("balcony", "wall", 0.1),
    )


@dataclass(frozen=True)
class Observed:
    """A front as it was seen, in its own frame: metres, x right, z up from its lower left corner.

    ratios (7, rows, columns): the logarithm of how much likelier what was seen of a cell is with a
    label of `LABELS`; row 0 is the lowest. boxes: (k, 4) x0, z0, x1, z1 of the elements of a kind.
    """

    width_m: float
    eaves_m: float
    cell_m: float
    ratios: Float
    boxes: dict[str, Float]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells."""
        return self.ratios.shape[1], self.ratios.shape[2]


def observe(
    seen: Seen, document: FacadeDocument, parameters: ObservedParameters | None = None
) -> Observed:
    """What was seen of the front of a document, in whose rectified photo the eyes looked."""
    own = parameters or ObservedParameters()
    facade, m = document.facade, document.scale.metres_per_px
    above_px = min(facade.y_px, own.above_m / m)
    left, right = facade.x_px, facade.x_px + facade.width_px
    top, bottom = facade.y_px - above_px, facade.y_px + facade.height_px
    rows = max(1, round((bottom - top) * m / own.cell_m))
    columns = max(1, round((right - left) * m / own.cell_m))
    high, wide = seen.classes.shape[1:]
    across, down = wide / seen.width_px, high / seen.height_px
    x0, x1 = _span(left * across, right * across, wide)
    y0, y1 = _span(top * down, bottom * down, high)
    chances = np.stack(
        [
            cv2.resize(one[y0:y1, x0:x1], (columns, rows), interpolation=cv2.INTER_AREA)[::-1]
            for one in (seen.chance(*_SEEN[label]) for label in LABELS)
        ]
    ).astype(np.float64)
    boxes = {
        kind: _boxes([e for e in seen_elements(seen) if e.kind == kind], (left, bottom), m)
        for kind in KINDS
    }
    size = facade.width_m, facade.height_m
    return observed_of(chances, size, boxes, own)


def observed_of(
    chances: Float,
    size_m: tuple[float, float],
    boxes: dict[str, Float],
    parameters: ObservedParameters | None = None,
) -> Observed:
    """From the chances (7, rows, columns) of the labels, whose sum falls short by what hides them.

    size_m: width, and height up to the eaves.
    """
    own = parameters or ObservedParameters()
    whole = np.maximum(chances.sum(axis=0), 1e-9)
    hidden = np.clip(1.0 - whole, 0.0, 1.0)
    frequency = np.array(own.frequency)[:, None, None]
    likelier = np.tensordot(_confusion(own), chances / whole / frequency, axes=1)
    told = own.stray + (1.0 - own.stray) * likelier
    weight = own.cell_m**2 / own.patch_m2
    ratios = weight * np.log(hidden + (1.0 - hidden) * told)
    return Observed(size_m[0], size_m[1], own.cell_m, ratios, boxes)


def _confusion(own: ObservedParameters) -> Float:
    """(7, 7) how often a label (row) looks like another one (column)."""
    shares = np.eye(len(LABELS))
    for label, other, share in own.confused:
        row = LABELS.index(label)
        shares[row, row] -= share
        shares[row, LABELS.index(other)] += share
    return shares


def _span(start: float, end: float, size: int) -> tuple[int, int]:
    low = int(np.clip(round(start), 0, size - 1))
    return low, int(np.clip(round(end), low + 1, size))


def _boxes(elements: list[SeenElement], origin_px: tuple[float, float], m: float) -> Float:
    """In metres from the lower left corner of the front."""
    left, bottom = origin_px
    found = [(e.x0 - left, bottom - e.y1, e.x1 - left, bottom - e.y0) for e in elements]
    return m * np.array(found, dtype=np.float64).reshape(-1, 4)
