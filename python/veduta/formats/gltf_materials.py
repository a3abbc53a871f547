"""Materials of a glTF file: colours, textures once each, and the masks of invented pixels.

Each class of surface has materials of its own. Where several classes look alike, those after the
first have a material that differs by its name (`roof.wall`, say), and
`extras.veduta.looks_like` is the number of the first one's.
"""

from __future__ import annotations

import copy
import hashlib
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from veduta.formats.gltf_bin import GltfBin
from veduta.imaging.encode import jpeg_bytes, mask_bytes, png_bytes
from veduta.place.material import Material, Texture
from veduta.place.semantics import SemanticClass

JPEG_QUALITY = 90
UNLIT = "KHR_materials_unlit"
LOOKS_LIKE = "looks_like"
DIGEST = "sha256-"
CLAMP, REPEAT = 33071, 10497
_LINEAR, _LINEAR_MIPMAP_LINEAR = 9729, 9987


class GltfMaterials:
    """The materials of the file: those of the part that are used, by class, in the order of use.

    wrap_of: how the texture of a material goes on beside its borders (`CLAMP`, `REPEAT`).
    """

    def __init__(
        self,
        root: dict[str, Any],
        materials: Sequence[Material],
        wrap_of: Callable[[int], int],
        binary: GltfBin,
    ) -> None:
        self._root, self._all, self._wrap_of, self._binary = root, materials, wrap_of, binary
        self._number_of: dict[tuple[int, int], int] = {}
        self._first_of: dict[int, int] = {}
        self._images: dict[Texture, tuple[int, dict[str, Any]]] = {}

    def number(self, row: int, code: int) -> int:
        """The number in the file of a material of the part, as surfaces of a class have it."""
        if (row, code) not in self._number_of:
            entry = self._entry(row) if row not in self._first_of else self._alike(row, code)
            number = self._number_of[row, code] = len(self._number_of)
            self._first_of.setdefault(row, number)
            self._root["materials"].append(entry)
        return self._number_of[row, code]

    def _alike(self, row: int, code: int) -> dict[str, Any]:
        """What is there already, in another class's name."""
        first = self._first_of[row]
        entry = copy.deepcopy(self._root["materials"][first])
        entry["name"] = f"{SemanticClass.of_code(code).value}.{entry['name']}"
        entry.setdefault("extras", {}).setdefault("veduta", {})[LOOKS_LIKE] = first
        return dict(entry)

    def _entry(self, row: int) -> dict[str, Any]:
        material = self._all[row]
        shading: dict[str, Any] = {
            "baseColorFactor": [
                *(_linear(channel) for channel in material.colour),
                material.opacity,
            ],
            "metallicFactor": material.metalness,
            "roughnessFactor": material.roughness,
        }
        entry: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": shading}
        if material.opacity < 1.0:
            entry["alphaMode"] = "BLEND"
        if material.glow > 0.0:
            entry["emissiveFactor"] = [
                round(material.glow * _linear(channel), 6) for channel in material.colour
            ]
        if material.texture is not None:
            image, told = self._pictures(material.texture)
            shading["baseColorTexture"] = {"index": self._texture(image, self._wrap_of(row))}
            entry["extras"] = {"veduta": told}
            if material.texture.cut:
                entry |= {"alphaMode": "MASK", "alphaCutoff": 0.5}
        if material.two_sided:
            entry["doubleSided"] = True
        if material.unlit:
            entry["extensions"] = {UNLIT: {}}
            if UNLIT not in self._root.setdefault("extensionsUsed", []):
                self._root["extensionsUsed"].append(UNLIT)
        return entry

    def _pictures(self, texture: Texture) -> tuple[int, dict[str, Any]]:
        """The image of a texture, and what of it is invented: an image where it is not all alike.

        Once in the file, whatever colours it has.
        """
        if texture not in self._images:
            if texture.cut:
                image = _image(self._root, _cut_png(texture), "image/png", self._binary)
            else:
                image = _image(self._root, _jpeg(texture), "image/jpeg", self._binary)
            first = bool(texture.invented.flat[0])
            told: dict[str, Any] = {"invented": first}
            if (texture.invented != first).any():
                mask = _image(self._root, _mask_png(texture), "image/png", self._binary)
                told = {"invented_mask": mask}
            self._images[texture] = (image, told)
        return self._images[texture]

    def _texture(self, image: int, wrap: int) -> int:
        """The number of the texture with this image and wrapping."""
        samplers = self._root.setdefault("samplers", [])
        sampler = {
            "magFilter": _LINEAR,
            "minFilter": _LINEAR_MIPMAP_LINEAR,
            "wrapS": wrap,
            "wrapT": wrap,
        }
        if sampler not in samplers:
            samplers.append(sampler)
        textures: list[dict[str, Any]] = self._root.setdefault("textures", [])
        told = {"source": image, "sampler": samplers.index(sampler)}
        if told not in textures:
            textures.append(told)
        return textures.index(told)


def _linear(srgb: float) -> float:
    """IEC 61966-2-1: glTF's factors are linear."""
    value = srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4
    return round(value, 6)


def _image(root: dict[str, Any], data: bytes, mime: str, binary: GltfBin) -> int:
    """Its name is the digest of its content: who shows several files decodes it once.

    Textures that were made apart may be the same picture: it is in the file once.
    """
    images = root.setdefault("images", [])
    name = f"{DIGEST}{hashlib.sha256(data).hexdigest()}"
    for number, image in enumerate(images):
        if image["name"] == name and image["mimeType"] == mime:
            return number
    images.append({"name": name, "bufferView": binary.add(data), "mimeType": mime})
    return len(images) - 1


@lru_cache(maxsize=32)
def _jpeg(texture: Texture) -> bytes:
    """Encoded once for all models of a process."""
    return jpeg_bytes(texture.pixels, JPEG_QUALITY, optimize=True)


@lru_cache(maxsize=32)
def _cut_png(texture: Texture) -> bytes:
    alpha = np.where(texture.invented, 0, 255).astype(np.uint8)
    return png_bytes(np.dstack([texture.pixels, alpha]))


@lru_cache(maxsize=32)
def _mask_png(texture: Texture) -> bytes:
    return mask_bytes(texture.invented)
