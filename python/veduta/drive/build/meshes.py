"""A segment's walls and ground as meshes: what is measured, filled and inferred is told apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import Textured
from veduta.place.features import FeatureRow, feature_table
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass

_PLAIN, _PLAIN_GROUND = (0.62, 0.6, 0.57), (0.36, 0.36, 0.37)
_ROWS: tuple[tuple[bool, Source, FeatureRow], ...] = (
    (True, Source.MEASURED, (SemanticClass.WALL, Provenance.MEASURED, "wall")),
    (True, Source.FILLED, (SemanticClass.WALL, Provenance.INVENTED, "wall filled")),
    (True, Source.INFERRED, (SemanticClass.WALL, Provenance.INFERRED, "wall above the scan")),
    (False, Source.MEASURED, (SemanticClass.GROUND, Provenance.MEASURED, "ground")),
    (False, Source.FILLED, (SemanticClass.GROUND, Provenance.INVENTED, "ground filled")),
)
CLASS_COLOURS: dict[int, tuple[int, int, int]] = {
    PointClass.UNCLASSIFIED: (120, 120, 130),
    PointClass.GROUND: (150, 125, 100),
    PointClass.BUILDING: (225, 190, 110),
    PointClass.FOREGROUND: (60, 150, 80),
    PointClass.GLASS: (90, 180, 230),
    PointClass.FILLED: (235, 150, 60),
}


def segment_mesh(textured: Textured, middle: NDArray[np.float64], *, wall: bool) -> Mesh | None:
    """The walls or the ground of a segment about an origin `middle` (3,); None where none is."""
    surface, geometry = textured.surface, textured.geometry
    chosen = np.flatnonzero(surface.wall == wall)
    if not len(chosen):
        return None
    rows = [row for row in _ROWS if row[0] == wall]
    feature = np.zeros(len(chosen), dtype=np.int32)
    for number, (_, source, _) in enumerate(rows):
        feature[surface.source[chosen] == source] = number
    used, triangles = np.unique(surface.triangles[chosen], return_inverse=True)
    uv, texture = _cropped(textured, textured.atlas.uv(surface.pixel[used]))
    identity = geometry.segment.id if wall else f"{geometry.segment.id}-ground"
    return Mesh(
        id=identity,
        positions_m=(surface.vertices[used] - middle).astype(np.float32),
        triangles=triangles.reshape(-1, 3).astype(np.uint32),
        features=feature_table(identity, [row for _, _, row in rows]),
        materials=(
            Material("images", texture=texture, unlit=True),
            Material("not seen in any image", _PLAIN if wall else _PLAIN_GROUND),
        ),
        triangle_feature=feature,
        triangle_material=_of_triangles(textured, textured.plain)[chosen].astype(np.int32),
        uv=uv,
    )


def _cropped(
    textured: Textured, uv: NDArray[np.float32]
) -> tuple[NDArray[np.float32], Texture]:
    """The rows of the atlas that a part of the surface needs, and its coordinates there."""
    height = len(textured.pixels)
    low = max(int(np.floor(uv[:, 1].min() * height)) - 1, 0)
    high = min(int(np.ceil(uv[:, 1].max() * height)) + 1, height)
    moved = uv.copy()
    moved[:, 1] = (uv[:, 1] * height - low) / (high - low)
    invented = (textured.invented | textured.plain)[low:high]
    return moved, Texture(np.ascontiguousarray(textured.pixels[low:high]), invented)


def _of_triangles(textured: Textured, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(m,) what a mask of the atlas says at the middle of each triangle."""
    height, width = mask.shape
    uv = textured.atlas.uv(textured.surface.pixel)[textured.surface.triangles].mean(axis=1)
    at = np.clip((uv * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    return np.asarray(mask[at[:, 1], at[:, 0]])
