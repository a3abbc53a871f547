"""Reading the triangles, colours and pictures of any binary glTF file, whoever wrote it."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from veduta.formats.glb_bounds import require_bounded
from veduta.formats.model_pictures import beside, colour_texture, image_number
from veduta.formats.obj_read import (
    LARGEST_BYTES,
    MOST_CORNERS,
    MOST_REPEATS,
    ReadMesh,
    lost_picture,
)
from veduta.imaging.srgb import srgb_of_linear
from veduta.place.material import Colour
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import limited
from veduta.run.names import real_path

if TYPE_CHECKING:
    import trimesh

_REMEDY = "Export it again as binary glTF 2.0 (.glb), with everything in one file."
_GLOSSY, _TRANSFORM = "KHR_materials_pbrSpecularGlossiness", "KHR_texture_transform"
_PLACES = "_PICTURE_PLACE"
"""What the corners' places on pictures are called for the reader of meshes: it leaves them as they
are, where it would turn `TEXCOORD_0`, whole numbers too."""
_HEAD = 20


def read_glb_mesh(path: Path, most_corners: int = MOST_CORNERS) -> ReadMesh:
    """All triangles of the file's scene, y up. InputError says what is wrong.

    most_corners: of all triangles together.
    """
    return limited(_read, (path, most_corners), path, _REMEDY)


def _read(asked: tuple[Path, int]) -> ReadMesh:
    import trimesh  # here, as only the process that reads needs it

    path, most_corners = asked
    try:
        require_file(path, LARGEST_BYTES)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error
    try:
        require_bounded(data, most_corners)
        root, plain = _without_pictures(data)
        scene = trimesh.load_scene(io.BytesIO(plain), file_type="glb", process=False)
        pieces = [one for one in scene.dump() if isinstance(one, trimesh.Trimesh)]
        return _joined(pieces, most_corners, root, path)
    except (
        ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error, OSError,
        RecursionError, MemoryError, OverflowError,
    ) as error:  # fmt: skip
        raise InputError(path, f"is no mesh that can be read ({error})", _REMEDY) from error


def _without_pictures(data: bytes) -> tuple[dict[str, Any], bytes]:
    """The document as it is, and the file with numbers for the names of its materials.

    Nothing decodes a picture there that nobody has asked for.
    """
    (size,) = struct.unpack_from("<I", data, 12)
    told = data[_HEAD : _HEAD + size]
    root, plain = json.loads(told), json.loads(told)
    materials = plain.get("materials", [])
    for name in ("images", "textures", "samplers"):
        plain.pop(name, None)
    plain["materials"] = [{"name": str(number)} for number in range(len(materials))]
    for mesh in plain.get("meshes", ()):
        for primitive in mesh["primitives"]:
            given, attributes = primitive["attributes"], primitive["attributes"]
            attributes = {
                name: accessor
                for name, accessor in given.items()
                if not name.startswith(("TEXCOORD_", _PLACES))
            }
            number = primitive.get("material")
            told_of = None if number is None else colour_texture(root["materials"][number])
            named = None if told_of is None else f"TEXCOORD_{_set_of(told_of)}"
            if named in given:
                attributes[_PLACES] = given[named]
            primitive["attributes"] = attributes
    text = json.dumps(plain).encode()
    text += b" " * (-len(text) % 4)
    whole = _HEAD + len(text) + len(data) - _HEAD - size
    head = struct.pack("<4sIII4s", b"glTF", 2, whole, len(text), b"JSON")
    return root, head + text + data[_HEAD + size :]


def _set_of(texture: dict[str, Any]) -> int:
    """Which coordinates of the corners a picture lies by."""
    moved = texture.get("extensions", {}).get(_TRANSFORM, {})
    return int(moved.get("texCoord", texture.get("texCoord", 0)))


def _joined(
    pieces: list[trimesh.Trimesh], most_corners: int, root: dict[str, Any], path: Path
) -> ReadMesh:
    count = sum(len(piece.faces) for piece in pieces)
    if count == 0:
        raise ValueError("it has no triangles")
    if 3 * count > most_corners:
        raise ValueError(f"it has {count} triangles; {most_corners // 3} are the most")
    points = np.concatenate([np.asarray(piece.vertices, dtype=np.float64) for piece in pieces])
    if not np.isfinite(points).all():
        raise ValueError("it has points that are no numbers")
    for piece in pieces:
        if len(piece.faces) and not 0 <= piece.faces.min() <= piece.faces.max() < len(
            piece.vertices
        ):
            raise ValueError("it has triangles with corners that are not there")
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    corners = [
        np.asarray(piece.faces, dtype=np.int64).reshape(-1) + start
        for piece, start in zip(pieces, starts[:-1].tolist(), strict=True)
    ]
    looks = [_look(_material(piece, root), root, path) for piece in pieces]
    number_of: dict[_Look, int] = {}
    rows = [number_of.setdefault(look, len(number_of)) for look, _ in looks]
    uv = [_uv(piece, _material(piece, root)) for piece in pieces]
    pictures = tuple(picture for _, _, picture in number_of)
    return ReadMesh(
        points=points,
        corners=np.concatenate(corners).astype(np.uint32),
        offsets=np.arange(0, 3 * count + 1, 3, dtype=np.int64),
        face_material=np.repeat(rows, [len(piece.faces) for piece in pieces]).astype(np.int32),
        materials=tuple((name, colour) for name, colour, _ in number_of),
        face_group=np.zeros(count, dtype=np.int32),
        groups=("",),
        uv=np.concatenate(uv) if any(pictures) else None,
        pictures=pictures,
        notes=tuple(dict.fromkeys(note for _, note in looks if note)),
    )


_Look = tuple[str, Colour | None, str | None]


def _material(piece: trimesh.Trimesh, root: dict[str, Any]) -> dict[str, Any]:
    """What the document says of the material of a piece; nothing where it has none."""
    name = getattr(getattr(piece.visual, "material", None), "name", None)
    if name is None or not str(name).isdigit():
        return {}
    found: dict[str, Any] = root["materials"][int(name)]
    return found


def _look(material: dict[str, Any], root: dict[str, Any], path: Path) -> tuple[_Look, str | None]:
    """Name, base colour and picture, and what is to be said of a picture that is not there."""
    name = str(material.get("name") or "")
    glossy = material.get("extensions", {}).get(_GLOSSY, {})
    shading = material.get("pbrMetallicRoughness", {})
    factor = shading.get("baseColorFactor", glossy.get("diffuseFactor"))
    colour = None if factor is None else _colour(factor)
    if colour_texture(material) is None:
        return (name, colour, None), None
    number = image_number(root, material)
    image = {} if number is None else root["images"][number]
    uri = str(image.get("uri", "data:"))
    if number is not None and uri.startswith("data:"):
        return (name, colour, f"{real_path(path)}#{number}"), None
    found = beside(unquote(uri), path.parent, path.parent)
    if found is None:
        told = uri if number is not None else "of a kind that is not read"
        return (name, colour, None), lost_picture(told, name)
    return (name, colour, str(found)), None


def _colour(factor: list[float]) -> Colour:
    """glTF's colours are linear."""
    linear = np.clip(np.array(factor[:3], dtype=np.float64), 0.0, 1.0)
    red, green, blue = np.clip(srgb_of_linear(linear), 0.0, 1.0).round(4).tolist()
    return red, green, blue


def _uv(piece: trimesh.Trimesh, material: dict[str, Any]) -> NDArray[np.float32]:
    """(3 m, 2) the places of a piece's corners on its picture, from the lower left; NaN without."""
    faces = np.asarray(piece.faces, dtype=np.int64).reshape(-1)
    told, given = colour_texture(material), piece.vertex_attributes.get(_PLACES)
    stored = np.asarray(() if given is None else given)
    if told is None or stored.ndim != 2 or len(stored) != len(piece.vertices):
        return np.full((len(faces), 2), np.nan, dtype=np.float32)
    stored = stored[:, :2]
    places = stored.astype(np.float64)
    if stored.dtype.kind == "u":
        places /= np.iinfo(stored.dtype).max
    moved = _moved(places, told.get("extensions", {}).get(_TRANSFORM, {}))
    moved[~(np.abs(moved) < MOST_REPEATS).all(axis=1)] = np.nan
    moved[:, 1] = 1.0 - moved[:, 1]
    found: NDArray[np.float32] = moved[faces].astype(np.float32)
    return found


def _moved(places: NDArray[np.float64], told: dict[str, Any]) -> NDArray[np.float64]:
    """As `KHR_texture_transform` stretches, turns and moves them."""
    turn = float(told.get("rotation", 0.0))
    cosine, sine = np.cos(turn), np.sin(turn)
    turned = np.array([[cosine, sine], [-sine, cosine]])
    stretch = np.array(told.get("scale", (1.0, 1.0)), dtype=np.float64)
    shift = np.array(told.get("offset", (0.0, 0.0)), dtype=np.float64)
    found: NDArray[np.float64] = (places * stretch) @ turned.T + shift
    return found
