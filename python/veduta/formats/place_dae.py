"""A place as COLLADA 1.4.1 (ISO/PAS 17506), with its textures beside it.

https://www.khronos.org/files/collada_spec_1_4.pdf - z up, metres. A part is a geometry and a node,
a look a material; the triangles of a look are a `<triangles>` of their own.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree
from numpy.typing import NDArray

import veduta
from veduta.formats.pictures import Pictures
from veduta.formats.shapes import Look, Shape, shapes
from veduta.place.place import Place
from veduta.run.atomic import atomic_write

_NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"
_MADE = "1970-01-01T00:00:00Z"
"""The schema asks for a time; the same place is to give the same bytes."""


def write_dae(place: Place, path: Path) -> None:
    """Write the scene, and a `.jpg` for each texture beside it."""
    root = etree.Element("COLLADA", {"xmlns": _NAMESPACE, "version": "1.4.1"})
    _asset(root, place)
    images, effects, materials, geometries, scenes = (
        etree.SubElement(root, f"library_{name}")
        for name in ("images", "effects", "materials", "geometries", "visual_scenes")
    )
    scene = _child(scenes, "visual_scene", id="scene", name=clean(place.title or "Place"))
    pictures = Pictures(path)
    known: dict[str, str] = {}
    for number, shape in enumerate(shapes(place)):
        for look in shape.looks:
            if look.name not in known:
                known[look.name] = f"look-{len(known)}"
                _material(look, known[look.name], pictures.name(look), images, effects, materials)
        _geometry(geometries, shape, f"part-{number}", known)
        _node(scene, shape, f"part-{number}", known)
    for library in (images, effects, materials, geometries):
        if len(library) == 0:
            root.remove(library)
    _child(_child(root, "scene"), "instance_visual_scene", url="#scene")
    content = etree.tostring(root, encoding="UTF-8", xml_declaration=True, pretty_print=True)
    with atomic_write(path) as temporary:
        temporary.write_bytes(content)


def _child(parent: Any, tag: str, text: str | None = None, **attributes: str) -> Any:
    made = etree.SubElement(parent, tag, attributes)
    if text is not None:
        made.text = text
    return made


def _asset(root: Any, place: Place) -> None:
    asset = _child(root, "asset")
    contributor = _child(asset, "contributor")
    if place.author:
        _child(contributor, "author", clean(place.author))
    _child(contributor, "authoring_tool", f"Veduta {veduta.__version__}")
    if place.licence:
        _child(contributor, "copyright", clean(place.licence))
    _child(asset, "created", _MADE)
    _child(asset, "modified", _MADE)
    x, y, z = place.origin_m
    if place.crs:
        _child(asset, "subject", clean(f"zero is at ({x}, {y}, {z}) in {place.crs}"))
    if place.title:
        _child(asset, "title", clean(place.title))
    _child(asset, "unit", name="metre", meter="1")
    _child(asset, "up_axis", "Z_UP")


def clean(text: str) -> str:
    """The text without what XML may not hold."""
    return re.sub(r"[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "?", text)


def _material(
    look: Look, name: str, picture: str | None, images: Any, effects: Any, materials: Any
) -> None:
    effect = _child(effects, "effect", id=f"{name}-effect")
    profile = _child(effect, "profile_COMMON")
    if picture is not None:
        image = _child(images, "image", id=f"{name}-image")
        _child(image, "init_from", picture)
        surface = _child(_child(profile, "newparam", sid="surface"), "surface", type="2D")
        _child(surface, "init_from", f"{name}-image")
        sampler = _child(_child(profile, "newparam", sid="sampler"), "sampler2D")
        _child(sampler, "source", "surface")
    shading = _child(_child(profile, "technique", sid="common"), "lambert")
    own = look.material
    if own.glow > 0.0:
        _colour(_child(shading, "emission"), [own.glow * value for value in own.colour])
    diffuse = _child(shading, "diffuse")
    if picture is None:
        _colour(diffuse, own.colour)
    else:
        _child(diffuse, "texture", texture="sampler", texcoord="UV")
    if own.opacity < 1.0:
        _colour(_child(shading, "transparent", opaque="A_ONE"), (1.0, 1.0, 1.0))
        _child(_child(shading, "transparency"), "float", f"{own.opacity:.4f}")
    material = _child(materials, "material", id=name, name=clean(look.name))
    _child(material, "instance_effect", url=f"#{name}-effect")


def _colour(parent: Any, colour: Any) -> None:
    _child(parent, "color", " ".join(f"{value:.4f}" for value in (*colour, 1.0)))


def _geometry(geometries: Any, shape: Shape, name: str, known: dict[str, str]) -> None:
    own = shape.triangles
    geometry = _child(geometries, "geometry", id=name, name=clean(shape.placed.id))
    mesh = _child(geometry, "mesh")
    uv = np.column_stack([own.uv[:, 0], 1.0 - own.uv[:, 1]])
    _source(mesh, f"{name}-at", own.positions_m, "XYZ", 5)
    _source(mesh, f"{name}-normal", own.normals, "XYZ", 4)
    _source(mesh, f"{name}-uv", uv, "ST", 6)
    vertices = _child(mesh, "vertices", id=f"{name}-vertices")
    _child(vertices, "input", semantic="POSITION", source=f"#{name}-at")
    for look, rows in shape.by_look():
        triangles = _child(mesh, "triangles", material=known[look.name], count=str(len(rows)))
        for semantic, source in (("VERTEX", "vertices"), ("NORMAL", "normal"), ("TEXCOORD", "uv")):
            told = {"semantic": semantic, "source": f"#{name}-{source}", "offset": "0"}
            _child(triangles, "input", **(told | ({"set": "0"} if source == "uv" else {})))
        _child(triangles, "p", " ".join(map(str, own.corners[rows].reshape(-1).tolist())))


def _source(mesh: Any, name: str, rows: NDArray[np.float64], axes: str, digits: int) -> None:
    source = _child(mesh, "source", id=name)
    text = (f"%.{digits}f " * rows.size) % tuple(rows.reshape(-1).tolist())
    _child(source, "float_array", text.rstrip(), id=f"{name}-array", count=str(rows.size))
    technique = _child(source, "technique_common")
    accessor = _child(
        technique, "accessor",
        source=f"#{name}-array", count=str(len(rows)), stride=str(len(axes)),
    )  # fmt: skip
    for axis in axes:
        _child(accessor, "param", name=axis, type="float")


def _node(scene: Any, shape: Shape, name: str, known: dict[str, str]) -> None:
    title = clean(shape.placed.standing.name or shape.placed.id)
    node = _child(scene, "node", id=f"{name}-node", name=title, type="NODE")
    instance = _child(node, "instance_geometry", url=f"#{name}")
    bound = _child(_child(instance, "bind_material"), "technique_common")
    for look, _ in shape.by_look():
        symbol = known[look.name]
        used = _child(bound, "instance_material", symbol=symbol, target=f"#{symbol}")
        told = {"semantic": "UV", "input_semantic": "TEXCOORD", "input_set": "0"}
        _child(used, "bind_vertex_input", **told)
