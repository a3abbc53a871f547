"""The materials of COLLADA files: diffuse colours and pictures; and how elements are looked up.

https://www.khronos.org/files/collada_spec_1_4.pdf - an effect names the picture of its diffuse
colour by a sampler, which names a surface, which names an image, which names a file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from veduta.formats.model_pictures import beside
from veduta.formats.obj_read import lost_picture
from veduta.place.material import Colour

_STEPS = 8
"""From a texture to its file; there are four."""


@dataclass(frozen=True)
class DaeMaterial:
    """look: name, diffuse colour (sRGB, 0..1) and picture, as `model_pictures` names it.

    uv_set: which places of corners the picture lies by; None where the file does not tell. note:
    what is to be said of a picture that is not there.
    """

    look: tuple[str, Colour | None, str | None]
    uv_set: int | None = None
    note: str | None = None


def material_of(instance: Any, symbol: str, by_id: Mapping[str, Any], path: Path) -> DaeMaterial:
    """The material that an instance of a geometry binds to the symbol of faces."""
    bound = next(
        (
            one
            for one in (() if instance is None else instance.iter())
            if tag_of(one) == "instance_material" and one.get("symbol") == symbol
        ),
        None,
    )
    target = symbol if bound is None else reference_of(bound, "target")
    material = by_id.get(target)
    if material is None or tag_of(material) != "material":
        return DaeMaterial((symbol, None, None))
    name = material.get("name") or target
    own = child_of(material, "instance_effect")
    effect = None if own is None else by_id.get(reference_of(own))
    colour, texture = None, None
    for diffuse in () if effect is None else effect.iter():
        if tag_of(diffuse) != "diffuse":
            continue
        given, shown = child_of(diffuse, "color"), child_of(diffuse, "texture")
        if colour is None and given is not None:
            colour = _colour(given)
        texture = shown if texture is None else texture
    if texture is None:
        return DaeMaterial((name, colour, None))
    named = _file_named(texture.get("texture") or "", effect, by_id)
    found = None if named is None else beside(unquote(named), path.parent, path.parent)
    if found is None:
        return DaeMaterial((name, colour, None), note=lost_picture(named or "", name))
    return DaeMaterial((name, colour, str(found)), _uv_set(bound, texture.get("texcoord")))


def _colour(element: Any) -> Colour:
    given = np.array((element.text or "").split(), dtype=np.float64)
    red, green, blue = np.clip(given[:3], 0.0, 1.0).round(4).tolist()
    return red, green, blue


def _file_named(name: str, effect: Any, by_id: Mapping[str, Any]) -> str | None:
    """The file that the texture of an effect leads to; None where it leads nowhere."""
    params = {one.get("sid"): one for one in effect.iter() if tag_of(one) == "newparam"}
    for _ in range(_STEPS):
        element = params.pop(name, None)
        if element is None:
            image = by_id.get(name)
            if image is None or tag_of(image) != "image":
                return None
            first = first_below(image, "init_from")
            inner = None if first is None else child_of(first, "ref")  # 1.5
            told = first if inner is None else inner
            return None if told is None else (told.text or "").strip() or None
        step = first_below(element, "source")
        if step is None:
            step = first_below(element, "init_from")
        if step is None:
            step = first_below(element, "instance_image")
        if step is None:
            return None
        name = (step.text or "").strip() or (step.get("url") or "").lstrip("#")
    return None


def _uv_set(bound: Any, texcoord: str | None) -> int | None:
    """The set of places that is bound to the name that a texture has for it."""
    for one in () if bound is None else children_of(bound, "bind_vertex_input"):
        if one.get("semantic") == texcoord:
            return int(one.get("input_set", "0"))
    return None


def reference_of(element: Any, name: str = "url") -> str:
    """The id that an element refers to; ValueError where it lies in another file."""
    text = element.get(name) or element.get("source") or ""
    if not text.startswith("#"):
        raise ValueError(f"it refers to another file ({text[:80]})")
    return str(text[1:])


def tag_of(element: Any) -> str:
    """The name of an element, without that of its schema."""
    return str(element.tag).rpartition("}")[2]


def children_of(element: Any, tag: str) -> list[Any]:
    """The elements of this name in an element."""
    return [one for one in element if tag_of(one) == tag]


def child_of(element: Any, tag: str) -> Any:
    """The first element of this name in an element; None where there is none."""
    return next(iter(children_of(element, tag)), None)


def first_below(root: Any, tag: str) -> Any:
    """The first element of this name, however deep; None where there is none."""
    return next((one for one in root.iter() if tag_of(one) == tag), None)
