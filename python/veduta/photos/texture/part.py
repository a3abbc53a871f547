"""A building's part with its textures: atlases as materials, and where each polygon lies in them.

What a photo shows at least half of is measured; the others are inferred: their outlines are the
model's, and nothing but it speaks for them. Texels that no photo shows are marked in the atlas's
mask (`Texture.invented`); a polygon that none shows keeps a plain colour.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityBuilding
from veduta.photos.options import TextureOptions
from veduta.photos.texture.atlas import Spot, filled, packed
from veduta.photos.texture.compose import FaceTexture
from veduta.photos.texture.faces import Face
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance

MEASURED_SHARE = 0.5
PLAIN = (0.62, 0.60, 0.57)
"""The colour of what no photo shows."""


@dataclass(frozen=True)
class TexturedBuilding:
    """One building; `row` is its place in the city model.

    polygon_seen: (p,) the share of each polygon's face that photos show. atlases: how many of the
    part's materials, the first, are textures. faces: with the texture of each, None where no photo
    shows it.
    """

    row: int
    part: Part
    offset_m: tuple[float, float, float]
    polygon_seen: NDArray[np.float64]
    atlases: int
    faces: tuple[tuple[Face, FaceTexture | None], ...]

    @property
    def id(self) -> str:
        """The building's name."""
        return self.part.id


def textured_building(
    row: int,
    building: CityBuilding,
    faces: Sequence[tuple[Face, FaceTexture | None]],
    options: TextureOptions,
) -> TexturedBuilding:
    """The building with what its faces look like."""
    part = building.part
    shown = [(face, texture) for face, texture in faces if texture is not None]
    packing = packed([texture.pixels.shape[1::-1] for _, texture in shown], options.max_atlas_px)
    pixels = filled(packing, [texture.pixels for _, texture in shown], _byte(PLAIN))
    masks = filled(packing, [texture.invented.view(np.uint8) for _, texture in shown], 1)
    materials = [
        Material(f"atlas {number}", texture=Texture(atlas, mask.astype(np.bool_)))
        for number, (atlas, mask) in enumerate(zip(pixels, masks, strict=True))
    ]
    material = np.full(len(part.polygon_material), len(materials), dtype=np.int32)
    seen = np.zeros(len(part.polygon_material))
    uv = np.zeros_like(part.uv, dtype=np.float64)
    for (face, texture), spot in zip(shown, packing.spots, strict=True):
        material[face.polygons] = spot.atlas
        seen[face.polygons] = texture.seen_share
        corners = _corners_of(part, face.polygons)
        world = part.positions_m[corners].astype(np.float64) + building.offset_m
        uv[corners] = _uv(face, texture, spot, world, packing.sizes[spot.atlas])
    if (material == len(materials)).any():
        materials.append(Material("unseen", colour=PLAIN))
    textured = replace(
        part,
        uv=uv.astype(np.float32),
        polygon_material=material,
        materials=tuple(materials),
        features=replace(part.features, provenance_code=_provenance(part, seen)),
    )
    atlases = len(packing.sizes)
    return TexturedBuilding(row, textured, building.offset_m, seen, atlases, tuple(faces))


def _byte(colour: tuple[float, float, float]) -> tuple[int, ...]:
    return tuple(round(255 * channel) for channel in colour)


def _corners_of(part: Part, polygons: NDArray[np.int64]) -> NDArray[np.int64]:
    """The vertices of polygons."""
    first = part.ring_offsets[part.polygon_offsets]
    return np.concatenate([np.arange(first[row], first[row + 1]) for row in polygons.tolist()])


def _uv(
    face: Face,
    texture: FaceTexture,
    spot: Spot,
    world: NDArray[np.float64],
    size: tuple[int, int],
) -> NDArray[np.float64]:
    """(n, 2) glTF's: 0 at the atlas's upper left corner, 1 at its lower right."""
    places = (world - face.corner) @ np.stack([face.right, face.down], axis=1)
    found: NDArray[np.float64] = (places / texture.texel_m + (spot.x, spot.y)) / size
    return found


def _provenance(part: Part, seen: NDArray[np.float64]) -> NDArray[np.uint8]:
    """(f,) by the share of each feature's area that photos show."""
    area = part.triangles.polygon_area_m2
    whole, shown = np.zeros(len(part.features)), np.zeros(len(part.features))
    np.add.at(whole, part.polygon_feature, area)
    np.add.at(shown, part.polygon_feature, area * seen)
    measured = shown >= MEASURED_SHARE * np.maximum(whole, 1e-12)
    return np.where(measured, Provenance.MEASURED.code, Provenance.INFERRED.code).astype(np.uint8)
