"""Balconies: a floor and three railings as a solid of its own before the wall."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.facade.layout import SLAB_M, Opening
from veduta.facade.paint import Finish, Paint, photo_rect
from veduta.facade.roof import Mansard
from veduta.facade.solids import Box, TrayFinish, add_box, add_tray
from veduta.place.builder import PartBuilder
from veduta.place.semantics import Provenance, SemanticClass

# How far a balcony juts out (m): one before a single window, and one that people stand on.
SHALLOW_M, DEEP_M = 0.30, 0.60
# From this width on, a balcony serves more than one window (m).
WIDE_M = 2.2
RAILING_M = 0.04
# A balcony with less room than this between its railings is a plain box (m).
LEAST_INSIDE_M = 0.1


def add_balconies(
    builder: PartBuilder,
    balconies: Sequence[Opening],
    mansard: Mansard | None,
    paint: Paint,
    wall: int,
) -> None:
    """Add each as a closed solid; its front shows the photo, the rest follows from a rule."""
    for number, balcony in enumerate(balconies, start=1):
        place = balcony.rectangle
        shell = builder.new_shell()
        front = builder.feature(
            SemanticClass.BALCONY,
            Provenance(balcony.element.provenance),
            f"balcony {number}",
            parent=wall,
            shell=shell,
            size_m=(place.width, place.height),
            photo_px=photo_rect(balcony.element),
        )
        out = DEEP_M if place.width >= WIDE_M else SHALLOW_M
        rest = builder.feature(
            SemanticClass.BALCONY,
            Provenance.INFERRED,
            f"floor and sides of balcony {number}",
            parent=front,
            shell=shell,
            size_m=(place.width, out),
        )
        back = _back_m(place.z0, mansard)
        box = Box(place.x0, place.x1, back - out, back, place.z0, place.z1)
        if min(place.width - 2 * RAILING_M, place.height - SLAB_M) > LEAST_INSIDE_M:
            add_tray(builder, box, RAILING_M, SLAB_M, _finish(paint, box, front, rest))
        else:
            add_box(builder, box, paint.seen(front), Finish(rest, paint.railing))


def _finish(paint: Paint, box: Box, front: int, rest: int) -> TrayFinish:
    """The photo shows the front railing alone; its ends are bent around the corners."""

    def bent(end_x: float, inwards: float) -> Finish:
        def to_uv(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
            along = np.minimum(points_m[:, 1] - box.y0, box.x1 - box.x0)
            flat = np.stack([end_x + inwards * along, points_m[:, 1], points_m[:, 2]], axis=1)
            return paint.atlas.photo_uv(flat)

        return Finish(rest, paint.photo, to_uv)

    return TrayFinish(
        front=paint.seen(front),
        right=bent(box.x1, -1.0),
        left=bent(box.x0, 1.0),
        inner_front=paint.seen(rest),
        rest=Finish(rest, paint.reveal),
    )


def _back_m(floor_m: float, mansard: Mansard | None) -> float:
    """Where the balcony meets the building: the wall, or the slope above the eaves."""
    if mansard is None or floor_m <= mansard.eaves_m:
        return 0.0
    return mansard.front_y_m(min(floor_m + SLAB_M, mansard.break_m))
