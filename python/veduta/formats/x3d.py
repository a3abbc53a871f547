"""X3D 4.0 (ISO/IEC 19775-1:2023) in its XML encoding: a scene as it grows, and shapes of a part.

X3D is y-up: (x, y, z) of the part becomes (x, z, -y) here and nowhere else. Textures lie in the
file itself as data addresses. A texture's colour is multiplied into its pixels: players of X3D
differ in whether a material's colour changes its texture.
"""

from __future__ import annotations

import base64
import math
from collections.abc import Iterable, Sequence
from functools import lru_cache
from xml.etree import ElementTree

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veduta
from veduta.formats.gltf_bin import y_up
from veduta.imaging.encode import jpeg_bytes
from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.place.material import Colour, Material, Texture
from veduta.place.part import Part

Element = ElementTree.Element
JPEG_QUALITY = 82
_DIGITS = 4


class X3dScene:
    """A scene as it grows. Names (DEF) are made unique, and of letters that XML ids may have."""

    def __init__(
        self, title: str, components: Sequence[tuple[str, int]] = (("Followers", 1),)
    ) -> None:
        self._root = Element("X3D", {"profile": "Immersive", "version": "4.0"})
        head = ElementTree.SubElement(self._root, "head")
        for name, level in components:
            ElementTree.SubElement(head, "component", {"name": name, "level": str(level)})
        for name, content in (("title", title), ("generator", f"Veduta {veduta.__version__}")):
            ElementTree.SubElement(head, "meta", {"name": name, "content": content})
        self.scene = ElementTree.SubElement(self._root, "Scene")
        self._names: set[str] = set()
        self._looks: dict[tuple[int, int, bool], str] = {}
        self._routes: list[dict[str, str]] = []

    def node(self, parent: Element, kind: str, name: str = "", **fields: object) -> Element:
        """A node in another; fields as X3D names them, a `_` at the end is dropped (`global_`)."""
        given = {"DEF": self.unique(name)} if name else {}
        given |= {key.rstrip("_"): _text(value) for key, value in fields.items()}
        return ElementTree.SubElement(parent, kind, given)

    def unique(self, name: str) -> str:
        """A name that no node has yet."""
        base = "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "-" for c in name)
        base = base if base[:1].isalpha() else f"n-{base}"
        found, number = base, 2
        while found in self._names:
            found, number = f"{base}-{number}", number + 1
        self._names.add(found)
        return found

    def route(self, first: Element, event: str, second: Element, to: str) -> None:
        """An event of one node goes to another; both have names."""
        self._routes.append(
            {"fromNode": first.attrib["DEF"], "fromField": event}
            | {"toNode": second.attrib["DEF"], "toField": to}
        )

    def shapes(
        self,
        parent: Element,
        part: Part,
        chosen: NDArray[np.bool_],
        about_m: Sequence[float] = (0.0, 0.0, 0.0),
        *,
        glows: bool = True,
    ) -> None:
        """A shape for each material that the chosen polygons have.

        about_m: the corners are about this point. glows: whether what can glow does.
        """
        triangles = part.triangles
        rows = np.flatnonzero(chosen[triangles.polygon])
        if len(rows) == 0:
            return
        of_row = part.polygon_material[triangles.polygon[rows]]
        order = np.argsort(of_row, kind="stable")
        rows = rows[order]
        materials, starts = np.unique(of_row[order], return_index=True)
        about = np.array(about_m, dtype=np.float32)
        for row, alike in zip(materials.tolist(), np.split(rows, starts[1:]), strict=True):
            used, corners = np.unique(triangles.indices[alike], return_inverse=True)
            shape = self.node(parent, "Shape")
            self._appearance(shape, part, row, glows=glows)
            faces = self.node(shape, "IndexedTriangleSet", index=corners.reshape(-1))
            self.node(faces, "Coordinate", point=y_up(part.positions_m[used] - about))
            if part.materials[row].texture is not None:
                uv = part.uv[used] * np.array([1.0, -1.0]) + np.array([0.0, 1.0])
                self.node(faces, "TextureCoordinate", point=uv)

    def _appearance(self, shape: Element, part: Part, row: int, *, glows: bool) -> None:
        """How a shape looks: a material of the part, written once in the file."""
        key = (id(part), row, glows)
        if key in self._looks:
            self.node(shape, "Appearance", USE=self._looks[key])
            return
        material = part.materials[row]
        look = self.node(shape, "Appearance", f"look-{material.name}")
        self._looks[key] = look.attrib["DEF"]
        self._material(look, material, glows=glows)

    def appearance(self, shape: Element, material: Material, name: str = "") -> str:
        """How a shape of a mesh looks; the name under which another can USE it."""
        look = self.node(shape, "Appearance", f"look-{name or material.name}")
        self._material(look, material, glows=True)
        return look.attrib["DEF"]

    def _material(self, look: Element, material: Material, *, glows: bool) -> None:
        texture = material.texture
        colour = (1.0, 1.0, 1.0) if texture is not None else material.colour
        glow = material.glow if glows else 0.0
        shine = 1.0 - material.roughness
        if not material.unlit:
            self.node(
                look,
                "Material",
                ambientIntensity=1.0,
                diffuseColor=colour,
                emissiveColor=[glow * channel for channel in material.colour],
                specularColor=[0.5 * shine * shine] * 3,
                shininess=round(0.1 + 0.6 * shine, 3),
                transparency=round(1.0 - material.opacity, 4),
            )
        elif texture is None:
            self.node(look, "UnlitMaterial", emissiveColor=colour)
        if texture is not None:
            image = self.node(look, "ImageTexture", url=[_address(texture, material.colour)])
            self.node(
                image, "TextureProperties", generateMipMaps=True, anisotropicDegree=4.0,
                minificationFilter="AVG_PIXEL_AVG_MIPMAP", magnificationFilter="AVG_PIXEL",
            )  # fmt: skip

    def content(self) -> bytes:
        """The file; it can be called once."""
        for route in self._routes:
            ElementTree.SubElement(self.scene, "ROUTE", route)
        ElementTree.indent(self._root, space=" ")
        text = ElementTree.tostring(self._root, encoding="unicode")
        return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def place_of(point_m: ArrayLike) -> NDArray[np.float64]:
    """(3,) a point or a direction in X3D's axes."""
    x, y, z = np.asarray(point_m, dtype=np.float64)
    return np.array([x, z, -y]) + 0.0


def turn_of(axis: ArrayLike, angle_rad: float) -> NDArray[np.float64]:
    """(4,) a rotation in X3D's axes: axis and angle."""
    return np.append(place_of(axis), angle_rad)


def look_from(eye_m: ArrayLike, target_m: ArrayLike) -> NDArray[np.float64]:
    """(4,) how a viewpoint is turned that looks from one point at another, upright.

    A viewpoint without a turn looks along -z, with y up. Both points in the part's frame.
    """
    way = place_of(np.asarray(target_m) - np.asarray(eye_m))
    turn = math.atan2(-way[0], -way[2])
    pitch = math.atan2(way[1], math.hypot(way[0], way[2]))
    return _axis_angle(turn, pitch)


def _axis_angle(turn: float, pitch: float) -> NDArray[np.float64]:
    """First about x by the pitch, then about y by the turn, as one rotation."""
    a, b = turn / 2.0, pitch / 2.0
    w = math.cos(a) * math.cos(b)
    axis = np.array(
        [math.cos(a) * math.sin(b), math.sin(a) * math.cos(b), -math.sin(a) * math.sin(b)]
    )
    size = float(np.linalg.norm(axis))
    if size < 1e-9:
        return np.array([0.0, 1.0, 0.0, 0.0])
    return np.append(axis / size, 2.0 * math.atan2(size, w))


def _text(value: object) -> str:
    """A field's value in the XML encoding."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, np.ndarray):
        return _numbers(value.reshape(-1))
    if isinstance(value, Iterable):
        items = list(value)
        if items and isinstance(items[0], str):
            return " ".join(f'"{item}"' for item in items)
        return _numbers(np.array(items).reshape(-1))
    return _number(value)


def _numbers(values: NDArray[np.generic]) -> str:
    if values.dtype.kind in "iu":
        return " ".join(map(str, values.tolist()))
    # Places, normals and texture coordinates of a house repeat: each is put into words once.
    distinct, which = np.unique(values.astype(np.float64).round(_DIGITS), return_inverse=True)
    words = np.array([_number(value) for value in distinct.tolist()], dtype=object)
    return " ".join(words[which].tolist())


def _number(value: object) -> str:
    if isinstance(value, int):
        return str(value)
    rounded = round(float(str(value)), _DIGITS) + 0.0
    return f"{rounded:g}" if abs(rounded) < 1e5 and rounded == round(rounded) else str(rounded)


@lru_cache(maxsize=32)
def _address(texture: Texture, colour: Colour) -> str:
    """A texture of a colour as a data address."""
    light = linear_of_srgb(texture.pixels.astype(np.float32) / 255.0)
    mixed = srgb_of_linear(light * linear_of_srgb(np.array(colour, dtype=np.float32)))
    pixels = (255.0 * mixed).round().clip(0, 255).astype(np.uint8)
    data = base64.b64encode(jpeg_bytes(pixels, JPEG_QUALITY, optimize=True)).decode()
    return f"data:image/jpeg;base64,{data}"
