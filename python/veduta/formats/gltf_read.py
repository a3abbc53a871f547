"""Reading back the GLB files that `formats.gltf` writes.

The polygons are gone in a GLB: each triangle comes back as a polygon of its own. Features,
materials, textures and their masks of invented pixels come back as they were (JPEG aside).
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.formats.gltf_chunks import BROKEN, REMEDY, Glb, feature_rows, glb_chunks, glb_content
from veduta.formats.gltf_instances import INSTANCING, part_placement
from veduta.formats.gltf_materials import LOOKS_LIKE
from veduta.formats.gltf_movers_read import mover_nodes, pivot_of, read_mover
from veduta.place.instances import InstanceGroup, Instances, SharedMesh
from veduta.place.material import Colour, Material, Texture
from veduta.place.part import Features, Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

LARGEST_PIXELS = 64 * 2**20
_Columns = NDArray[np.float32]


def read_glb(path: Path) -> Part:
    """Read a GLB file that Veduta wrote; raises InputError on any other."""
    data = glb_content(path)
    try:
        return part_of(glb_chunks(data))
    except BROKEN as error:
        raise InputError(path, f"not a GLB file of Veduta ({error})", REMEDY) from error


def part_of(glb: Glb) -> Part:
    """The part in a file's chunks; one of `BROKEN` where they hold none."""
    if glb.root["asset"].get("generator") != "veduta":
        raise ValueError("another program wrote it")
    extras = glb.root["scenes"][0]["extras"]["veduta"]
    positions, uv = [np.zeros((0, 3), np.float32)], [np.zeros((0, 2), np.float32)]
    features, materials = [np.zeros(0, np.int32)], [np.zeros(0, np.int32)]
    own = glb.root["meshes"][0]["primitives"] if "mesh" in glb.root["nodes"][0] else []
    moving: list[tuple[int, int, int]] = []
    still = np.zeros(3, dtype=np.float32)
    pieces = [(primitive, still) for primitive in own]
    first = sum(_triangle_count(glb, primitive) for primitive in own)
    looks, row_of = looks_of(glb)
    for number, node in mover_nodes(glb):
        primitives = glb.root["meshes"][node["mesh"]]["primitives"]
        pieces += [(primitive, pivot_of(glb, number)) for primitive in primitives]
        after = first + sum(_triangle_count(glb, primitive) for primitive in primitives)
        moving.append((number, first, after))
        first = after
    for primitive, about in pieces:
        attributes = primitive["attributes"]
        corners = glb.array(primitive["indices"])
        points = glb.array(attributes["POSITION"])
        positions.append(_z_up(points[corners] + about))
        flat = np.zeros((len(points), 2), dtype=np.float32)
        seen = glb.array(attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else flat
        uv.append(seen[corners])
        features.append(feature_rows(glb.array(attributes["_FEATURE_ID_0"])[corners][::3]))
        row = row_in(row_of, primitive["material"])
        materials.append(np.full(len(corners) // 3, row, dtype=np.int32))
    count = sum(len(rows) for rows in features)
    table = features_of(extras["features"])
    feature = np.concatenate(features)
    if count and not 0 <= int(feature.min()) <= int(feature.max()) < len(table):
        raise ValueError("a face names a feature that is not in the table")
    return Part(
        id=glb.root["nodes"][0]["name"],
        positions_m=np.concatenate(positions),
        uv=np.concatenate(uv),
        ring_offsets=np.arange(0, 3 * count + 1, 3, dtype=np.int64),
        polygon_offsets=np.arange(count + 1, dtype=np.int64),
        polygon_feature=feature,
        polygon_material=np.concatenate(materials),
        features=table,
        materials=looks,
        attributes=dict(extras.get("attributes", {})),
        notes=tuple(extras.get("notes", ())),
        instances=_instances(glb, len(table), row_of),
        movers=tuple(read_mover(glb, number, np.arange(a, b)) for number, a, b in moving),
    )


def _triangle_count(glb: Glb, primitive: dict[str, Any]) -> int:
    return int(glb.root["accessors"][primitive["indices"]]["count"]) // 3


def _instances(glb: Glb, features: int, row_of: list[int]) -> Instances | None:
    """What stands many times; None where there is nothing."""
    found = list(_groups(glb))
    if not found:
        return None
    names = list(dict.fromkeys(mesh["name"] for mesh, _, _ in found))
    meshes: dict[str, SharedMesh] = {}
    groups = []
    for mesh, feature, place in found:
        meshes.setdefault(mesh["name"], _shared_mesh(glb, mesh))
        if not 0 <= int(feature.min()) <= int(feature.max()) < features:
            raise ValueError("an instance names a feature that is not in the table")
        groups.append(
            InstanceGroup(
                mesh=names.index(mesh["name"]),
                materials=tuple(row_in(row_of, one["material"]) for one in mesh["primitives"]),
                part_from_mesh=part_placement(*place),
                feature=feature,
            )
        )
    return Instances(tuple(meshes[name] for name in names), tuple(groups))


def _groups(glb: Glb) -> Iterator[tuple[dict[str, Any], NDArray[np.int32], list[_Columns]]]:
    """Mesh, feature rows and places (moves, turns, stretches) of what stands many times."""
    nodes = glb.root["nodes"]
    for node in nodes:
        if INSTANCING in node.get("extensions", {}):
            told = node["extensions"][INSTANCING]["attributes"]
            place = [glb.array(told[name]) for name in ("TRANSLATION", "ROTATION", "SCALE")]
            feature = feature_rows(glb.array(told["_FEATURE_ID_0"]))
            yield glb.root["meshes"][node["mesh"]], feature, place
        elif node.get("extras", {}).get("veduta", {}).get("instances"):
            children = [nodes[number] for number in node["children"]]
            place = [
                np.array([child[name] for child in children], dtype=np.float32)
                for name in ("translation", "rotation", "scale")
            ]
            rows = [child["extras"]["veduta"]["instance"] for child in children]
            if len({child["mesh"] for child in children}) != 1:
                raise ValueError("the instances of a group have different meshes")
            yield glb.root["meshes"][children[0]["mesh"]], np.array(rows, dtype=np.int32), place


def _shared_mesh(glb: Glb, mesh: dict[str, Any]) -> SharedMesh:
    primitives = mesh["primitives"]
    attributes = primitives[0]["attributes"]
    positions = glb.array(attributes["POSITION"])
    corners = [glb.array(primitive["indices"]).reshape(-1, 3) for primitive in primitives]
    if max(int(own.max()) for own in corners) >= len(positions):
        raise ValueError(f"mesh {mesh['name']} has triangles without points")
    slots = [_plain(glb, primitive["material"])["name"] for primitive in primitives]
    return SharedMesh(
        name=mesh["name"],
        positions_m=_z_up(positions),
        normals=_z_up(glb.array(attributes["NORMAL"])),
        indices=np.concatenate(corners),
        slot=np.repeat(np.arange(len(corners)), [len(own) for own in corners]).astype(np.int32),
        slots=tuple(slots),
        uv=glb.array(attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else None,
    )


def _z_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """glTF's (x, y, z) with y up to the part's (x, -z, y); no negative zeros."""
    return np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], axis=1) + np.float32(0.0)


def features_of(columns: dict[str, list[Any]]) -> Features:
    """The feature table of its JSON columns."""
    unseen = [np.nan] * 4
    return Features(
        id=tuple(columns["id"]),
        name=tuple(columns["name"]),
        class_code=np.array([SemanticClass(n).code for n in columns["class"]], dtype=np.uint8),
        provenance_code=np.array(
            [Provenance(name).code for name in columns["provenance"]], dtype=np.uint8
        ),
        parent=np.array(columns["parent"], dtype=np.int32),
        shell=np.array(columns["shell"], dtype=np.int32),
        width_m=_sizes(columns["width_m"]),
        height_m=_sizes(columns["height_m"]),
        photo_px=np.array(
            [unseen if rect is None else rect for rect in columns["photo_px"]], dtype=np.float64
        ).reshape(-1, 4),
        # A model of an older Veduta does not say the one, most models not the other.
        seen_height_m=_sizes(columns.get("seen_height_m", [None] * len(columns["id"]))),
        score=_sizes(columns.get("score", [None] * len(columns["id"]))),
    )


def _sizes(column: list[float | None]) -> NDArray[np.float64]:
    return np.array([np.nan if value is None else value for value in column], dtype=np.float64)


def looks_of(glb: Glb) -> tuple[tuple[Material, ...], list[int]]:
    """The materials, and the row in them of each in the file: classes that look alike share one."""
    entries = glb.root["materials"]
    plain = [_plain(glb, number) for number in range(len(entries))]
    rows = [number for number, entry in enumerate(entries) if entry is plain[number]]
    at = {id(entries[number]): row for row, number in enumerate(rows)}
    found = tuple(material_of(glb, entries[number]) for number in rows)
    return found, [at[id(entry)] for entry in plain]


def row_in(row_of: list[int], number: Any) -> int:
    """The row of a material of the file; ValueError where the file has none of this number."""
    if type(number) is not int or not 0 <= number < len(row_of):
        raise ValueError("a surface names a material that is not there")
    return row_of[number]


def _plain(glb: Glb, number: int) -> dict[str, Any]:
    """What tells the look of a material: itself, or the one that it looks like."""
    entry = glb.one("materials", number)
    told = entry.get("extras", {}).get("veduta", {})
    if LOOKS_LIKE not in told:
        return entry
    first = glb.one("materials", told[LOOKS_LIKE])
    if LOOKS_LIKE in first.get("extras", {}).get("veduta", {}):
        raise ValueError(f"material {number} looks like one that looks like another")
    return first


def material_of(glb: Glb, entry: dict[str, Any]) -> Material:
    """A material with its texture and mask."""
    shading = entry["pbrMetallicRoughness"]
    red, green, blue = (_srgb(value) for value in shading["baseColorFactor"][:3])
    colour: Colour = (red, green, blue)
    texture = None
    if "baseColorTexture" in shading:
        source = glb.one("textures", shading["baseColorTexture"]["index"])["source"]
        pixels = _pixels(glb, source, "RGB")
        cut = entry.get("alphaMode") == "MASK"
        texture = Texture(pixels=pixels, invented=_invented(glb, entry, pixels), cut=cut)
    return Material(
        entry["name"],
        colour,
        shading["roughnessFactor"],
        shading["metallicFactor"],
        texture,
        shading["baseColorFactor"][3],
        _glow(entry),
        "KHR_materials_unlit" in entry.get("extensions", {}),
    )


def _invented(glb: Glb, entry: dict[str, Any], pixels: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """(h, w) which pixels of a texture are invented: a mask, or one word for all of them."""
    told = entry["extras"]["veduta"]
    if "invented_mask" in told:
        return np.asarray(_pixels(glb, told["invented_mask"], "L") > 127)
    return np.full(pixels.shape[:2], told["invented"] is True)


def _glow(entry: dict[str, Any]) -> float:
    """The share of its colour that a material gives off; none of a black one's can be told."""
    given, own = entry.get("emissiveFactor", [0.0]), entry["pbrMetallicRoughness"]
    brightest = max(own["baseColorFactor"][:3])
    return round(max(given) / brightest, 5) if max(given) > 0.0 and brightest > 0.0 else 0.0


def _pixels(glb: Glb, number: int, mode: str) -> NDArray[np.uint8]:
    image = Image.open(io.BytesIO(glb.view(glb.one("images", number)["bufferView"])))
    if image.width * image.height > LARGEST_PIXELS:
        raise ValueError(f"image {number} is {image.width} x {image.height} pixels")
    return np.asarray(image.convert(mode), dtype=np.uint8)


def _srgb(linear: float) -> float:
    """IEC 61966-2-1, the way back from `formats.gltf`."""
    value = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return round(value, 5)
