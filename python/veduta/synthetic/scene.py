"""A place made ready for rays: all triangles of all parts in the world, and what they look like."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb
from veduta.place.flatten import flattened
from veduta.place.material import Material
from veduta.place.part import Part

# (part, world_from_part 4x4)
PlacedPart = tuple[Part, NDArray[np.float64]]
_STRIDE = 512


@dataclass(frozen=True)
class Hits:
    """What rays met. `ray` (k,) are the rays that met something; the rest is about those."""

    ray: NDArray[np.int64]
    triangle: NDArray[np.int32]
    distance: NDArray[np.float32]
    weight: NDArray[np.float32]


class RayScene:
    """Triangles in the world as columns, under one ray tracer.

    `feature` (m,) counts through all parts: part p's feature f is `first_feature[p] + f`.
    `mirrors` gives, by material name, how much of each texel mirrors ((h, w) uint8).
    """

    def __init__(
        self,
        parts: Sequence[PlacedPart],
        mirrors: Mapping[str, NDArray[np.uint8]] | None = None,
    ) -> None:
        corners, uv, normals, material, feature, polygon = [], [], [], [], [], []
        self.materials: list[Material] = []
        self.first_feature: list[int] = []
        features = polygons = 0
        for placed, world_from_part in parts:
            part = flattened(placed)
            triangles = part.triangles
            turn = world_from_part[:3, :3]
            world = part.positions_m.astype(np.float64) @ turn.T + world_from_part[:3, 3]
            corners.append(world[triangles.indices])
            uv.append(part.uv[triangles.indices])
            normals.append((triangles.polygon_normal @ turn.T)[triangles.polygon])
            material.append(part.polygon_material[triangles.polygon] + len(self.materials))
            feature.append(part.polygon_feature[triangles.polygon] + features)
            polygon.append(triangles.polygon.astype(np.int64) + polygons)
            self.materials += part.materials
            self.first_feature.append(features)
            features += len(part.features)
            polygons += len(part.polygon_feature)
        self.corners = np.concatenate(corners).astype(np.float32)
        self.uv = np.concatenate(uv).astype(np.float32)
        self.normal = np.concatenate(normals).astype(np.float32)
        self.material = np.concatenate(material).astype(np.int32)
        self.feature = np.concatenate(feature).astype(np.int32)
        self.polygon = np.concatenate(polygon)
        self._mirrors = mirrors or {}
        self._texels: dict[int, NDArray[np.uint8]] = {}
        self._tracer = EmbreeScene()
        self._mesh = TriangleMesh(self._tracer, self.corners)
        self.opacity = np.array([one.opacity for one in self.materials], np.float32)
        self._shading = self._tracer
        opaque = self.opacity[self.material] >= 1.0
        if opaque.any() and not opaque.all():
            # Panes that are seen through throw no shadow.
            self._shading = EmbreeScene()
            self._opaque = TriangleMesh(self._shading, self.corners[opaque])

    def cast(self, origins: NDArray[np.float32], directions: NDArray[np.float32]) -> Hits:
        """The first triangle on each ray; origins and directions are (n, 3)."""
        found = self._tracer.run(origins, directions, output=1)
        ray = np.flatnonzero(found["primID"] >= 0)
        weight = np.stack([found["u"][ray], found["v"][ray]], axis=1)
        return Hits(ray, found["primID"][ray], found["tfar"][ray], weight)

    def blocked(
        self,
        origins: NDArray[np.float32],
        directions: NDArray[np.float32],
        reach_m: float | NDArray[np.float64],
    ) -> NDArray[np.bool_]:
        """Whether anything opaque stands within `reach_m`, one for all or one each."""
        reach = np.array(np.broadcast_to(reach_m, len(origins)), np.float32)
        hit = self._shading.run(origins, directions, reach, query="OCCLUDED")
        return np.asarray(hit >= 0)

    def surface(self, hits: Hits) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Linear albedo (k, 3) and mirror share (k,) of what was hit."""
        uv = self.uv[hits.triangle]
        u, v = hits.weight[:, 0:1], hits.weight[:, 1:2]
        at = uv[:, 0] * (1 - u - v) + uv[:, 1] * u + uv[:, 2] * v
        material = self.material[hits.triangle]
        albedo = np.empty((len(material), 3), np.float32)
        mirror = np.empty(len(material), np.float32)
        order = np.argsort(material, kind="stable")
        names, starts = np.unique(material[order], return_index=True)
        for name, members in zip(names, np.split(order, starts[1:]), strict=True):
            sample = _sample(self._texels_of(int(name)), at[members])
            albedo[members] = _LINEAR_OF_SRGB[sample[:, :3]]
            mirror[members] = sample[:, 3] / np.float32(255.0)
        return albedo, mirror

    def _texels_of(self, number: int) -> NDArray[np.uint8]:
        """Of a material, made when it is first met: of many houses few rays see all."""
        if number not in self._texels:
            material = self.materials[number]
            self._texels[number] = _texels(material, self._mirrors.get(material.name))
        return self._texels[number]


_LINEAR_OF_SRGB = linear_of_srgb(np.arange(256) / 255.0).astype(np.float32)


def _texels(material: Material, mirror: NDArray[np.uint8] | None) -> NDArray[np.uint8]:
    """(h, w, 4) uint8: colour and mirror share, the material's colour multiplied in."""
    if material.texture is None:
        pixels = np.ones((1, 1, 3), np.float32)
    else:
        pixels = material.texture.pixels.astype(np.float32) / 255.0
    pixels = pixels * np.asarray(material.colour, np.float32)
    if mirror is None:
        smooth = max(0.0, 1.0 - 2.0 * material.roughness) * 255.0
        mirror = np.full(pixels.shape[:2], round(smooth), np.uint8)
    colour = np.rint(np.clip(pixels, 0, 1) * 255.0).astype(np.uint8)
    return np.ascontiguousarray(np.dstack([colour, mirror]))


def _sample(texels: NDArray[np.uint8], uv: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Bilinear texels (n, 4) at (n, 2) texture coordinates; outside 0..1 the texture repeats."""
    height, width = texels.shape[:2]
    rows = -(-len(uv) // _STRIDE)
    maps = np.zeros((2, rows * _STRIDE), np.float32)
    maps[0, : len(uv)] = (uv[:, 0] % 1.0) * width - 0.5
    maps[1, : len(uv)] = (uv[:, 1] % 1.0) * height - 0.5
    shaped = maps.reshape(2, rows, _STRIDE)
    image = cv2.remap(texels, shaped[0], shaped[1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
    return np.asarray(image.reshape(-1, 4)[: len(uv)], np.uint8)
