"""The document of a front with what a depth map says of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.measured.elements import (
    OPENINGS,
    ElementParameters,
    by_class,
    measured_elements,
    painted,
)
from veduta.facade.measured.elevation import read_depths
from veduta.facade.measured.ledges import LedgeParameters, find_ledges
from veduta.facade.measured.surface import Depths, SurfaceParameters, wall_surface
from veduta.facade.measured_depths import Elevation, MeasuredDepths
from veduta.geometry import homography

NOTHING = "depth map: too little of the wall has a depth: no recess and no projection is measured"


@dataclass(frozen=True)
class DepthParameters:
    """around: border beside an element that is not wall, share of the front's width."""

    around: float = 0.005
    surface: SurfaceParameters = field(default_factory=SurfaceParameters)
    elements: ElementParameters = field(default_factory=ElementParameters)
    ledges: LedgeParameters = field(default_factory=LedgeParameters)


def with_depths(
    document: FacadeDocument,
    path: Path,
    elevation: Elevation,
    parameters: DepthParameters | None = None,
) -> FacadeDocument:
    """The document with the depths of its elements, its ledges, and what there is to say of them.

    InputError where the depth map cannot be read.
    """
    parameters = parameters or DepthParameters()
    depths = _rectified(read_depths(path, elevation), document)
    box = document.facade
    left, right = max(0, round(box.x_px)), round(box.x_px + box.width_px)
    top, bottom = max(0, round(box.y_px)), round(box.y_px + box.height_px)
    front = np.zeros(depths.shape, dtype=np.bool_)
    front[top:bottom, left:right] = True
    around = parameters.around * box.width_px
    wall = front & ~painted(document.elements, (*OPENINGS, "balcony"), depths.shape, around)
    surface = wall_surface(depths, wall, parameters.surface)
    known = float(np.isfinite(depths[front]).mean()) if front.any() else 0.0
    if surface is None:
        said = [*document.notes, NOTHING]
        kept = MeasuredDepths(wall=elevation.wall, known=round(known, 4), wall_spread_m=0.0)
        return document.model_copy(update={"notes": said, "depths": kept})
    scale, detail = document.scale.metres_per_px, elevation.detail_m
    elements = measured_elements(
        document.elements, surface.beyond_m, wall, (detail / scale, scale), parameters.elements
    )
    inside = np.s_[top:bottom, left:right]
    ledges = find_ledges(
        surface.beyond_m[inside],
        wall[inside],
        scale,
        surface.spread_m,
        detail,
        parameters.ledges,
    )
    kept = MeasuredDepths(
        wall=elevation.wall,
        known=round(known, 4),
        wall_spread_m=round(surface.spread_m, 4),
        detail_m=round(detail, 4),
        classes=by_class(elements, box.y_px),
        ledges=tuple(one.model_copy(update={"y_px": one.y_px + top}) for one in ledges),
    )
    notes = [*document.notes, *_said(kept, elements)]
    return document.model_copy(update={"elements": elements, "depths": kept, "notes": notes})


def _rectified(depths_m: Depths, document: FacadeDocument) -> Depths:
    """The depth of each pixel of the rectified photo: that of the nearest pixel of the photo."""
    record = document.rectification
    # OpenCV puts the centre of the upper left pixel at (0, 0).
    half = homography.translation(0.5, 0.5)
    matrix = np.linalg.inv(half) @ np.array(record.rectified_from_source) @ half
    warped = cv2.warpPerspective(
        depths_m,
        matrix,
        (record.width_px, record.height_px),
        flags=cv2.INTER_NEAREST,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(float("nan"),) * 4,
    )
    return np.asarray(warped, dtype=np.float32)


def _said(depths: MeasuredDepths, elements: Sequence[Element]) -> list[str]:
    said = [
        f"depth map: of wall {depths.wall}, {100 * depths.known:.0f} % of the front has a depth;"
        f" the wall lies within {1000 * depths.wall_spread_m:.0f} mm of a plane,"
        f" and what is smaller than {depths.detail_m:.2f} m is smoothed away"
    ]
    kinds = {one.kind for one in depths.classes}
    for kind in (*OPENINGS, "balcony"):
        count = sum(one.class_ == kind for one in elements)
        if count and kind not in kinds:
            said.append(
                f"depth map: {kind}: none of {count} measured (too small for it, or unknown)"
            )
    for one in depths.classes:
        where = "before" if one.median_m > 0 else "behind"
        said.append(
            f"depth map: {one.kind}: {one.measured} of {one.found} measured,"
            f" {abs(one.median_m):.2f} m {where} the wall in the median,"
            f" spread {one.spread_m:.2f} m"
            + ("" if one.measured == one.found else "; the others take the median (inferred)")
        )
    said += [
        f"depth map: a ledge juts out by {one.out_m:.2f} m (spread {one.spread_m:.2f} m),"
        f" from row {one.y_px:.0f} of rectified.jpg down, {one.height_px:.0f} px high"
        for one in depths.ledges
    ]
    return said
