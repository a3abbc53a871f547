"""The building of one facade document: planned, written as rules, and derived from these.

The rules are what `veduta grammar derive` takes, too; here what the photo shows of each surface is
added to what they derive to.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.facade.cleared import Cleared
from veduta.facade.document import Element, FacadeDocument
from veduta.facade.plan import Plan, plan_building
from veduta.facade.repeat import repeating_rules
from veduta.facade.rule_file import Known, write_rules
from veduta.facade.rule_head import CELLS, PHOTO_TEXTURE, SIDE_TEXTURE, WALL_TEXTURE
from veduta.facade.scale import LARGEST_SIDE_M, SMALLEST_SIDE_M, is_possible
from veduta.facade.textures import make_textures
from veduta.grammar.brought import brought_textures, derive_text
from veduta.grammar.building import build_part as part_of
from veduta.place.material import Texture
from veduta.place.part import Features, Part
from veduta.place.semantics import Provenance
from veduta.run.errors import InputError

Rect = tuple[float, float, float, float]
FRONT = "front wall"
_NO_RECT: Rect = (np.nan, np.nan, np.nan, np.nan)


@dataclass(frozen=True)
class Model:
    """A building as rules, the textures that these name, and the part that they derive to.

    size_m: width and depth of the lot that the rules are made for. repeating: the same as rules
    for a lot of any size; those above where nothing in the front repeats.
    """

    rules: str
    repeating: str
    textures: Mapping[str, Texture]
    size_m: tuple[float, float]
    part: Part
    cleared: Cleared


def build_model(
    document: FacadeDocument,
    rectified: NDArray[np.uint8],
    part_id: str,
    before: NDArray[np.uint8] | None = None,
) -> Model:
    """Write the rules of one document, and derive them.

    rectified: (h, w, 3) uint8 sRGB, the rectified photo that the document describes.
    before: (h, w) what stands before the front, places in `cleared.KINDS`.
    The part's frame: x right along the wall, z up, facade plane y = 0, body at y >= 0.
    The body is shell 0 and closed; balconies, chimneys and lids are closed shells of their own.
    """
    _check(document, rectified)
    _check_sizes(document)
    plan = plan_building(document)
    shutters = [shutter.number for shutter in plan.shutters]
    textures = make_textures(document, rectified, plan.top_m, before, shutters)
    rules = write_rules(plan, textures, _roof_provenance(document), document.source.image)
    repeating, left_out = repeating_rules(plan, textures.colours, document.source.image) or (
        rules.text,
        (),
    )
    images = {PHOTO_TEXTURE: textures.front, WALL_TEXTURE: textures.wall}
    images[SIDE_TEXTURE] = textures.side
    part = _derived(rules.text, plan, images, part_id)
    facade = document.facade
    wall_px = (facade.x_px, facade.y_px, facade.width_px, facade.height_px)
    part = replace(
        part,
        features=_with_photo(part, rules.known, wall_px),
        attributes={
            "storeysAboveGround": document.storeys,
            "eavesHeight_m": plan.eaves_m,
            "scale_basis": document.scale.basis,
        },
        notes=(*plan.notes, *left_out, *part.notes),
    )
    return Model(
        rules.text, repeating, images, (plan.width_m, plan.depth_m), part, textures.cleared
    )


def build_part(document: FacadeDocument, rectified: NDArray[np.uint8], part_id: str) -> Part:
    """The part of `build_model` alone."""
    return build_model(document, rectified, part_id).part


def _derived(text: str, plan: Plan, images: Mapping[str, Texture], part_id: str) -> Part:
    """The part on a lot of the plan's size."""
    x, y = plan.width_m, plan.depth_m
    lot = [(0.0, 0.0, 0.0), (x, 0.0, 0.0), (x, y, 0.0), (0.0, y, 0.0)]
    made = derive_text(CELLS, text, lot)
    if isinstance(made, str):
        raise ValueError(f"the rules of {part_id} do not derive: {made}")
    derived, assets = made
    part = part_of(derived, part_id, assets, {**brought_textures(assets), **images})
    # What lies a little beside the photo takes its border: the sides of a narrow balcony.
    return replace(part, uv=np.clip(part.uv, 0.0, 1.0))


def _roof_provenance(document: FacadeDocument) -> Provenance:
    """Of the roof that the photo shows: as the document's extents have it."""
    roofs = [extent.provenance for extent in document.extents if extent.class_ == "roof"]
    return Provenance(roofs[0]) if roofs else Provenance.INFERRED


def _with_photo(part: Part, known: Mapping[str, Known], wall_px: Rect) -> Features:
    """The features, with where the photo shows them, how sure they are, and the plan's sizes."""
    features = part.features
    rows = [known.get(name) for name in features.name]
    derived = zip(features.width_m.tolist(), features.height_m.tolist(), strict=True)
    sizes = [own if row is None else row.size_m for row, own in zip(rows, derived, strict=True)]
    elements = [None if row is None else row.element for row in rows]
    rects = [_NO_RECT if element is None else photo_rect(element) for element in elements]
    rects[features.name.index(FRONT)] = wall_px
    seen = [np.nan if row is None else row.seen_height_m for row in rows]
    scores = [np.nan if element is None else element.score for element in elements]
    return replace(
        features,
        width_m=np.array([width for width, _ in sizes]),
        height_m=np.array([height for _, height in sizes]),
        photo_px=np.array(rects, dtype=np.float64).reshape(-1, 4),
        seen_height_m=np.array(seen, dtype=np.float64),
        score=np.array(scores, dtype=np.float64),
    )


def photo_rect(element: Element) -> Rect:
    """Where the element lies in the rectified photo: x, y, width, height (px)."""
    return (element.x_px, element.y_px, element.width_px, element.height_px)


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
