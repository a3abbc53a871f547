"""Several glTF documents as one: each below a node of its own, with all that it refers to.

All numbers that refer (views, accessors, images, textures, materials, meshes, nodes, skins,
animations, lights) move by what is there already. Only what Veduta's own writers use is known here.
"""

from __future__ import annotations

import copy
import hashlib
from typing import Any

from veduta.formats.gltf_bin import GltfBin

_LISTS = (
    "samplers", "textures", "materials", "meshes", "nodes", "skins",
    "cameras", "animations",
)  # fmt: skip
_LIGHTS, _INSTANCING = "KHR_lights_punctual", "EXT_mesh_gpu_instancing"


class JoinedGltf:
    """A document as it grows. `root` is complete but for what `GltfBin` holds."""

    def __init__(self) -> None:
        self.root: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "veduta"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
        }
        self.binary = GltfBin()
        self._image_of: dict[bytes, int] = {}
        self._used: set[str] = set()
        self._required: set[str] = set()

    def add(self, root: dict[str, Any], content: bytes, node: dict[str, Any]) -> dict[str, Any]:
        """Put a document below a node; what it looks like here, with this document's numbers.

        root: with one scene; it is not changed. content: its binary chunk. node: the new one's
        fields, but for its children.
        """
        added = copy.deepcopy(root)
        first = {name: len(self.root.get(name, ())) for name in _LISTS}
        first["accessors"] = len(self.binary.accessors)
        first["lights"] = len(self._lights())
        self._add_views(added, content)
        self.binary.accessors.extend(added.get("accessors", ()))
        for name in _LISTS:
            shift = _SHIFTS.get(name)
            for item in added.get(name, ()):
                if shift is not None:
                    shift(item, first)
            if added.get(name):
                self.root.setdefault(name, []).extend(added[name])
        lights = added.get("extensions", {}).get(_LIGHTS, {}).get("lights", [])
        if lights:
            told = self.root.setdefault("extensions", {}).setdefault(_LIGHTS, {"lights": []})
            told["lights"].extend(lights)
        self._used |= set(added.get("extensionsUsed", ()))
        self._required |= set(added.get("extensionsRequired", ()))
        children = [number + first["nodes"] for number in added["scenes"][0]["nodes"]]
        nodes = self.root.setdefault("nodes", [])
        self.root["scenes"][0]["nodes"].append(len(nodes))
        nodes.append(node | ({"children": children} if children else {}))
        return added

    def _add_views(self, added: dict[str, Any], content: bytes) -> None:
        """The views, and the images: one that is here already is taken for its like."""
        pictures = {image["bufferView"]: image for image in added.get("images", ())}
        number_of: dict[int, int] = {}
        for number, view in enumerate(added.get("bufferViews", ())):
            start = view.get("byteOffset", 0)
            data = content[start : start + view["byteLength"]]
            if number in pictures:
                number_of[number] = self._image(pictures[number], data)
            else:
                number_of[number] = self.binary.add(data, view.get("target"))
        for item in added.get("accessors", ()):
            item["bufferView"] = number_of[item["bufferView"]]
        numbers = [number_of[image["bufferView"]] for image in added.get("images", ())]
        for texture in added.get("textures", ()):
            texture["source"] = numbers[texture["source"]]
        for material in added.get("materials", ()):
            told = material.get("extras", {}).get("veduta", {})
            if "invented_mask" in told:
                told["invented_mask"] = numbers[told["invented_mask"]]

    def _image(self, image: dict[str, Any], data: bytes) -> int:
        """The number of an image with these bytes."""
        digest = hashlib.sha256(data).digest()
        if digest not in self._image_of:
            images = self.root.setdefault("images", [])
            self._image_of[digest] = len(images)
            images.append(image | {"bufferView": self.binary.add(data)})
        return self._image_of[digest]

    def use(self, *extensions: str) -> None:
        """Say that the file uses extensions."""
        self._used |= set(extensions)

    def document(self) -> tuple[dict[str, Any], bytes]:
        """The whole, and its binary chunk."""
        binary = self.binary
        binary.content.extend(b"\0" * (-len(binary.content) % 4))
        whole = dict(self.root)
        for name, used in (("extensionsUsed", self._used), ("extensionsRequired", self._required)):
            if used:
                whole[name] = sorted(used)
        # Materials, meshes and the like may not be empty lists.
        whole |= {"accessors": binary.accessors, "bufferViews": binary.views}
        whole = {name: value for name, value in whole.items() if value not in ([], {})}
        if binary.content:
            whole["buffers"] = [{"byteLength": len(binary.content)}]
        return whole, bytes(binary.content)

    def _lights(self) -> list[Any]:
        lights: list[Any] = self.root.get("extensions", {}).get(_LIGHTS, {}).get("lights", [])
        return lights


def _shift_texture(item: dict[str, Any], first: dict[str, int]) -> None:
    if "sampler" in item:
        item["sampler"] += first["samplers"]


def _shift_material(item: dict[str, Any], first: dict[str, int]) -> None:
    picture = item["pbrMetallicRoughness"].get("baseColorTexture")
    if picture is not None:
        picture["index"] += first["textures"]


def _shift_mesh(item: dict[str, Any], first: dict[str, int]) -> None:
    for primitive in item["primitives"]:
        primitive["attributes"] = _shifted(primitive["attributes"], first["accessors"])
        if "indices" in primitive:
            primitive["indices"] += first["accessors"]
        if "material" in primitive:
            primitive["material"] += first["materials"]
        if "targets" in primitive:
            primitive["targets"] = [
                _shifted(target, first["accessors"]) for target in primitive["targets"]
            ]


def _shift_node(item: dict[str, Any], first: dict[str, int]) -> None:
    for name, kind in (("mesh", "meshes"), ("skin", "skins"), ("camera", "cameras")):
        if name in item:
            item[name] += first[kind]
    if "children" in item:
        item["children"] = [child + first["nodes"] for child in item["children"]]
    extensions = item.get("extensions", {})
    if _LIGHTS in extensions:
        extensions[_LIGHTS]["light"] += first["lights"]
    if _INSTANCING in extensions:
        told = extensions[_INSTANCING]
        told["attributes"] = _shifted(told["attributes"], first["accessors"])


def _shift_skin(item: dict[str, Any], first: dict[str, int]) -> None:
    item["joints"] = [joint + first["nodes"] for joint in item["joints"]]
    if "skeleton" in item:
        item["skeleton"] += first["nodes"]
    if "inverseBindMatrices" in item:
        item["inverseBindMatrices"] += first["accessors"]


def _shift_animation(item: dict[str, Any], first: dict[str, int]) -> None:
    for sampler in item["samplers"]:
        sampler["input"] += first["accessors"]
        sampler["output"] += first["accessors"]
    for channel in item["channels"]:
        channel["target"]["node"] += first["nodes"]


def _shifted(numbers: dict[str, int], by: int) -> dict[str, int]:
    return {name: number + by for name, number in numbers.items()}


_SHIFTS = {
    "textures": _shift_texture,
    "materials": _shift_material,
    "meshes": _shift_mesh,
    "nodes": _shift_node,
    "skins": _shift_skin,
    "animations": _shift_animation,
}
