"""The building of one facade document: walls with openings, a mansard, plain sides and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.balconies import add_balconies
from veduta.facade.body import add_flat_roof, add_mansard, add_plain_walls
from veduta.facade.chimneys import add_chimneys
from veduta.facade.document import FacadeDocument
from veduta.facade.dormers import plan_dormers, reach_m
from veduta.facade.front import add_front
from veduta.facade.layout import Layout, lay_out
from veduta.facade.paint import make_paint
from veduta.facade.roof import Mansard, plan_mansard
from veduta.facade.scale import LARGEST_SIDE_M, SMALLEST_SIDE_M, is_possible
from veduta.facade.textures import make_atlas
from veduta.place.builder import PartBuilder
from veduta.place.part import Part
from veduta.place.semantics import Provenance
from veduta.run.errors import InputError

# Recesses may take this share of the building's depth.
DEEPEST_SHARE = 0.4


def build_part(
    document: FacadeDocument,
    rectified: NDArray[np.uint8],
    part_id: str,
) -> Part:
    """Build the part of one document.

    rectified: (h, w, 3) uint8 sRGB, the rectified photo that the document describes.
    The part's frame: x right along the wall, z up, facade plane y = 0, body at y >= 0.
    The body is shell 0 and closed; balconies, chimneys and lids are closed shells of their own.
    """
    _check(document, rectified)
    _check_sizes(document)
    builder = PartBuilder(part_id)
    footprint = (document.facade.width_m, document.model.depth_m, document.facade.height_m)
    setback = min(document.model.setback_m, DEEPEST_SHARE * document.model.depth_m)

    layout = lay_out(document)
    builder.notes.extend(layout.notes)
    mansard = plan_mansard(
        *footprint, document.rules.roof_height_m, reach_m(layout.dormers, footprint[2])
    )
    dormers = plan_dormers(layout.dormers, mansard, builder.notes)

    atlas = make_atlas(document, rectified, _top_m(layout, mansard, footprint[2]))
    paint = make_paint(builder, atlas)
    wall = add_front(builder, document, layout, setback, paint)
    add_plain_walls(builder, footprint, paint)
    if mansard is None:
        add_flat_roof(builder, footprint, paint)
    else:
        add_mansard(builder, mansard, dormers, setback, paint, _roof_provenance(document))
    add_balconies(builder, layout.balconies, mansard, paint, wall)
    add_chimneys(builder, layout.chimneys, footprint, mansard, paint)
    builder.attributes.update(
        storeysAboveGround=document.storeys,
        eavesHeight_m=round(footprint[2], 3),
        scale_basis=document.scale.basis,
    )
    return builder.build()


def _roof_provenance(document: FacadeDocument) -> Provenance:
    """Of the roof that the photo shows: as the document's extents have it."""
    roofs = [extent.provenance for extent in document.extents if extent.class_ == "roof"]
    return Provenance(roofs[0]) if roofs else Provenance.INFERRED


def _top_m(layout: Layout, mansard: Mansard | None, eaves_m: float) -> float:
    """The highest point that the photo has to show."""
    tops = [piece.rectangle.z1 for piece in (*layout.chimneys, *layout.balconies)]
    return max(eaves_m if mansard is None else mansard.top_m, *tops, eaves_m)


def _check(document: FacadeDocument, rectified: NDArray[np.uint8]) -> None:
    homography = np.array(document.rectification.rectified_from_source, dtype=np.float64)
    if homography.shape != (3, 3) or not abs(np.linalg.det(homography)) > 0.0:
        raise InputError(
            document.source.image,
            "rectified_from_source is not an invertible 3x3 matrix",
            "Restore the homography in facade.json.",
        )
    expected = (document.rectification.height_px, document.rectification.width_px, 3)
    if rectified.shape != expected:
        raise InputError(
            document.source.image,
            f"the rectified photo is {rectified.shape}, the document says {expected}",
            "Use the rectified.jpg that was written with this facade.json.",
        )


def _check_sizes(document: FacadeDocument) -> None:
    bounds = f"not between {SMALLEST_SIDE_M:g} and {LARGEST_SIDE_M:g} m"
    if not is_possible(document.model.depth_m):
        fault = f"is {document.model.depth_m:g} m, {bounds}"
        remedy = "Give a depth that a building has, there or as model.depth_m in facade.json."
        raise InputError("--depth-m", fault, remedy)
    facade, roof_m = document.facade, document.rules.roof_height_m
    # Whoever made the document has said so already, and named what is to be mended.
    if not is_possible(facade.width_m) or not is_possible(facade.height_m):
        raise InputError(
            document.source.image,
            f"the facade is {facade.width_m:g} m wide and {facade.height_m:g} m high, {bounds}",
            "Mend facade, or scale.metres_per_px, in facade.json.",
        )
    if not roof_m <= LARGEST_SIDE_M or not document.scale.metres_per_px > 0:
        raise InputError(
            document.source.image,
            f"the roof is {roof_m:g} m high, a pixel {document.scale.metres_per_px:g} m",
            "Mend both in facade.json.",
        )
