"""A quad of 2 m by 1 m with a picture of four colours on it, as each format writes it.

The picture is red at the upper left, green at the upper right, blue at the lower left and white at
the lower right. The whole of it lies on the quad, upright as seen from +z, but where a test says
otherwise.
"""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.formats.gltf_bin import glb_container

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
QUARTERS = {(-1, 1): RED, (1, 1): GREEN, (-1, -1): BLUE, (1, -1): WHITE}
"""The colour of each corner of the quad: left or right, and low or high."""
POINTS = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
UPRIGHT = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
"""From the lower left."""
Places = Sequence[tuple[float, float]]


def picture(alpha: NDArray[np.uint8] | None = None) -> Image.Image:
    """16 pixels a side; alpha (16, 16) where given."""
    pixels = np.zeros((16, 16, 3), dtype=np.uint8)
    pixels[:8, :8], pixels[:8, 8:], pixels[8:, :8], pixels[8:, 8:] = RED, GREEN, BLUE, WHITE
    image = Image.fromarray(pixels)
    if alpha is not None:
        image.putalpha(Image.fromarray(alpha))
    return image


def png(alpha: NDArray[np.uint8] | None = None) -> bytes:
    file = io.BytesIO()
    picture(alpha).save(file, "PNG")
    return file.getvalue()


def write_obj(folder: Path, named: str = "four.png", uv: Places = UPRIGHT) -> Path:
    (folder / "four.png").write_bytes(png())
    (folder / "quad.mtl").write_text(f"newmtl skin\nKd 1 1 1\nmap_Kd {named}\n")
    lines = ["mtllib quad.mtl", "usemtl skin"]
    lines += [f"v {x} {y} 0" for x, y in POINTS]
    lines += [f"vt {u} {v}" for u, v in uv]
    path = folder / "quad.obj"
    path.write_text("\n".join([*lines, "f 1/1 2/2 3/3 4/4"]))
    return path


def write_glb(
    folder: Path,
    uv: Places = UPRIGHT,
    image: bytes | None = None,
    texture: dict[str, Any] | None = None,
    material: dict[str, Any] | None = None,
    whole_numbers: bool = False,
) -> Path:
    """texture: what the material says of it besides; whole_numbers: places in 16 bits."""
    from_top = np.array([(u, 1.0 - v) for u, v in uv])
    stored = np.round(from_top * 65535).astype("<u2") if whole_numbers else from_top.astype("<f4")
    places = stored.tobytes()
    pieces = [
        np.array([(x, y, 0.0) for x, y in POINTS], dtype="<f4").tobytes(),
        places,
        struct.pack("<6H", 0, 1, 2, 0, 2, 3),
        image or png(),
    ]
    starts = np.cumsum([0, *(len(piece) + -len(piece) % 4 for piece in pieces)]).tolist()
    content = b"".join(piece + b"\0" * (-len(piece) % 4) for piece in pieces)
    kind = 5123 if whole_numbers else 5126
    shown = {"baseColorTexture": {"index": 0, **(texture or {})}}
    root: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0, "TEXCOORD_0": 1},
                        "indices": 2,
                        "material": 1,
                    }
                ]
            }
        ],
        "materials": [
            {"name": "skin"},
            {"name": "skin", "pbrMetallicRoughness": shown, **(material or {})},
        ],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 3, "mimeType": "image/png"}],
        "buffers": [{"byteLength": len(content)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(piece)}
            for start, piece in zip(starts, pieces, strict=False)
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {
                "bufferView": 1,
                "componentType": kind,
                "count": 4,
                "type": "VEC2",
                "normalized": whole_numbers,
            },
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
    }
    path = folder / "quad.glb"
    path.write_bytes(glb_container(json.loads(json.dumps(root)), content))
    return path


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_images><image id="im"><init_from>{named}</init_from></image></library_images>
<library_effects><effect id="fx"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>im</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="samp" texcoord="UVS"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="skin"><instance_effect url="#fx"/></material>
</library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">{points}</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<source id="w"><float_array id="b" count="8">0 0 0 0 0 0 0 0</float_array>
<technique_common><accessor source="#b" count="4" stride="2"/></technique_common></source>
<source id="t"><float_array id="c" count="8">{places}</float_array>
<technique_common><accessor source="#c" count="4" stride="2"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist count="1" material="sym"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#w" offset="1" set="0"/>
<input semantic="TEXCOORD" source="#t" offset="2" set="1"/><vcount>4</vcount>
<p>0 0 0 1 0 1 2 0 2 3 0 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="sym" target="#m">
<bind_vertex_input semantic="UVS" input_semantic="TEXCOORD" input_set="1"/></instance_material>
</technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>
"""
"""Its first places are all at one corner: the material binds those of the second set."""


def write_dae(folder: Path, named: str = "four.png", uv: Places = UPRIGHT) -> Path:
    (folder / "four.png").write_bytes(png())
    points = " ".join(f"{x} {y} 0" for x, y in POINTS)
    places = " ".join(f"{u} {v}" for u, v in uv)
    path = folder / "quad.dae"
    path.write_text(DAE.format(named=named, points=points, places=places))
    return path
