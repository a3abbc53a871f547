"""Reading the faces, colours and pictures of a COLLADA file, whoever wrote it.

https://www.khronos.org/files/collada_spec_1_4.pdf - geometry, the nodes of the scene with their
transforms, the colours and pictures of materials (`dae_materials`), unit and up axis. Skins and
cameras are not read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from veduta.formats.dae_materials import (
    DaeMaterial,
    child_of,
    children_of,
    first_below,
    material_of,
    reference_of,
    tag_of,
)
from veduta.formats.obj_read import LARGEST_BYTES, MOST_CORNERS, MOST_REPEATS, ReadMesh
from veduta.place.material import Colour
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

MOST_NODES, DEEPEST = 100_000, 64
_REMEDY = "Export it again as COLLADA 1.4 with polygons or triangles, or as OBJ or GLB."
_Y_UP = {
    "Y_UP": np.eye(3),
    "Z_UP": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    "X_UP": np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
}
"""What takes each up axis of the format to y up, as OBJ and glTF have it."""
_FACES = ("triangles", "polylist", "polygons")


@dataclass(frozen=True)
class _Faces:
    """Of one geometry: points (v, 3), corners and sizes of faces, and the symbol of a material.

    uv: (c, 2) the places of the corners on pictures, from the lower left, by the sets of the file.
    """

    points: NDArray[np.float64]
    corners: NDArray[np.int64]
    sizes: NDArray[np.int64]
    symbol: str
    uv: dict[int, NDArray[np.float32]]


@dataclass
class _Scene:
    """The elements of a file by their ids, and what is read of them so far."""

    by_id: dict[str, Any]
    path: Path
    geometries: dict[str, list[_Faces]] = field(default_factory=dict)
    nodes: int = 0
    corners: int = 0


def read_dae_mesh(path: Path, most_corners: int = MOST_CORNERS) -> ReadMesh:
    """All faces of the file's scene in metres, y up. InputError says what is wrong."""
    try:
        require_file(path, LARGEST_BYTES)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True)
    try:
        root = etree.fromstring(data, parser)
        if tag_of(root) != "COLLADA":
            raise ValueError("it is XML of another kind")
        return _mesh(root, path, most_corners)
    except (etree.XMLSyntaxError, ValueError, KeyError, IndexError, OverflowError) as error:
        raise InputError(path, f"is no mesh that can be read ({error})", _REMEDY) from error


def _mesh(root: Any, path: Path, most_corners: int) -> ReadMesh:
    scene = _Scene({one.get("id"): one for one in root.iter() if one.get("id")}, path)
    unit = first_below(root, "unit")
    metres = 1.0 if unit is None else float(unit.get("meter", "1"))
    axis = first_below(root, "up_axis")
    up = _Y_UP.get("Y_UP" if axis is None else (axis.text or "").strip(), _Y_UP["Y_UP"])
    turn = np.eye(4)
    turn[:3, :3] = metres * up
    pieces = []
    for piece in _pieces(root, scene, turn):
        scene.corners += len(piece[0].corners)
        if scene.corners > most_corners:
            raise ValueError(f"it has more than {most_corners} corners")
        pieces.append(piece)
    if not pieces:
        raise ValueError("it has no faces")
    return _joined(pieces)


_Piece = tuple[_Faces, NDArray[np.float64], DaeMaterial]


def _joined(pieces: list[_Piece]) -> ReadMesh:
    points = np.concatenate(
        [faces.points @ turn[:3, :3].T + turn[:3, 3] for faces, turn, _ in pieces]
    )
    if not np.isfinite(points).all():
        raise ValueError("it has points that are no numbers")
    starts = np.cumsum([0, *(len(faces.points) for faces, _, _ in pieces)])
    sizes = np.concatenate([faces.sizes for faces, _, _ in pieces])
    number_of: dict[tuple[str, Colour | None, str | None], int] = {}
    rows = [number_of.setdefault(material.look, len(number_of)) for _, _, material in pieces]
    pictures = tuple(picture for _, _, picture in number_of)
    corners = [
        faces.corners + start for (faces, _, _), start in zip(pieces, starts[:-1], strict=True)
    ]
    return ReadMesh(
        points=points,
        corners=np.concatenate(corners).astype(np.uint32),
        offsets=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        face_material=np.repeat(rows, [len(faces.sizes) for faces, _, _ in pieces]).astype(
            np.int32
        ),
        materials=tuple((name, colour) for name, colour, _ in number_of),
        face_group=np.zeros(len(sizes), dtype=np.int32),
        groups=("",),
        uv=np.concatenate([_uv(faces, own) for faces, _, own in pieces]) if any(pictures) else None,
        pictures=pictures,
        notes=tuple(dict.fromkeys(own.note for _, _, own in pieces if own.note)),
    )


def _uv(faces: _Faces, material: DaeMaterial) -> NDArray[np.float32]:
    """(c, 2) the places on the material's picture: of the set that it names, or else the first."""
    first = min(faces.uv, default=0)
    number = first if material.uv_set is None else material.uv_set
    found = faces.uv.get(number, faces.uv.get(first))
    if found is None:
        return np.full((len(faces.corners), 2), np.nan, dtype=np.float32)
    return found


def _pieces(root: Any, scene: _Scene, turn: NDArray[np.float64]) -> Iterator[_Piece]:
    """The faces of the scene that is shown; of all geometries where the file has none."""
    shown = next((one for one in root.iter() if tag_of(one) == "instance_visual_scene"), None)
    if shown is not None:
        for node in children_of(scene.by_id[reference_of(shown)], "node"):
            yield from _of_node(node, scene, turn, 0)
        return
    for geometry in root.iter():
        if tag_of(geometry) == "geometry":
            for faces in _faces_of(geometry, scene):
                yield faces, turn, material_of(None, faces.symbol, scene.by_id, scene.path)


def _of_node(node: Any, scene: _Scene, above: NDArray[np.float64], depth: int) -> Iterator[_Piece]:
    scene.nodes += 1
    if depth > DEEPEST or scene.nodes > MOST_NODES:
        raise ValueError("its nodes are too many, or hold themselves")
    turn = above @ _transform(node)
    for child in node:
        tag = tag_of(child)
        if tag == "node":
            yield from _of_node(child, scene, turn, depth + 1)
        elif tag == "instance_node":
            yield from _of_node(scene.by_id[reference_of(child)], scene, turn, depth + 1)
        elif tag == "instance_geometry":
            for faces in _faces_of(scene.by_id[reference_of(child)], scene):
                yield faces, turn, material_of(child, faces.symbol, scene.by_id, scene.path)


def _transform(node: Any) -> NDArray[np.float64]:
    """(4, 4) of a node, its steps in their order."""
    found = np.eye(4)
    for child in node:
        tag, step = tag_of(child), np.eye(4)
        if tag not in ("matrix", "translate", "scale", "rotate"):
            continue
        numbers = _numbers(child)
        if tag == "matrix":
            step = numbers.reshape(4, 4)
        elif tag == "translate":
            step[:3, 3] = numbers[:3]
        elif tag == "scale":
            step[:3, :3] = np.diag(numbers[:3])
        else:
            step[:3, :3] = _about(numbers[:3], float(np.deg2rad(numbers[3])))
        found = found @ step
    return found


def _about(axis: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    """(3, 3) the turn about an axis (Rodrigues)."""
    length = float(np.linalg.norm(axis))
    if length < 1e-12:
        return np.eye(3)
    x, y, z = axis / length
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    found: NDArray[np.float64] = (
        np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    )
    return found


def _faces_of(geometry: Any, scene: _Scene) -> list[_Faces]:
    name = geometry.get("id") or str(id(geometry))
    if name not in scene.geometries:
        mesh = child_of(geometry, "mesh")
        own = [] if mesh is None else [one for one in mesh if tag_of(one) in _FACES]
        scene.geometries[name] = [faces for one in own if (faces := _faces(one, scene)) is not None]
    return scene.geometries[name]


def _faces(element: Any, scene: _Scene) -> _Faces | None:
    inputs = [
        (
            one.get("semantic"),
            int(one.get("offset", "0")),
            reference_of(one),
            int(one.get("set", "0")),
        )
        for one in children_of(element, "input")
    ]
    stride = max((offset for _, offset, *_ in inputs), default=0) + 1
    corner = next(((offset, to) for what, offset, to, _ in inputs if what == "VERTEX"), None)
    if corner is None:
        raise ValueError("its faces name no vertices")
    offset, vertices = corner
    position = next(
        (
            reference_of(one)
            for one in children_of(scene.by_id[vertices], "input")
            if one.get("semantic") == "POSITION"
        ),
        None,
    )
    if position is None:
        raise ValueError("its vertices have no positions")
    points = _rows(scene.by_id[position], scene, 3)
    lists = [_numbers(one, np.int64) for one in children_of(element, "p")]
    rows = [one.reshape(-1, stride) for one in lists if len(one)]
    if not rows:
        return None
    every = np.concatenate(rows)
    corners = every[:, offset]
    counts = child_of(element, "vcount")
    if tag_of(element) == "triangles":
        sizes = np.full(len(corners) // 3, 3, dtype=np.int64)
    elif counts is not None:
        sizes = _numbers(counts, np.int64)
    else:
        sizes = np.array([len(row) for row in rows], dtype=np.int64)
    if int(sizes.sum()) != len(corners) or (sizes < 3).any():
        raise ValueError("its faces do not fit their corners")
    if corners.min() < 0 or corners.max() >= len(points):
        raise ValueError("a face names a point that is not there")
    uv = {
        number: _places(scene.by_id[to], every[:, place], scene)
        for what, place, to, number in inputs
        if what == "TEXCOORD"
    }
    return _Faces(points, corners, sizes, element.get("material", ""), uv)


def _places(source: Any, rows: NDArray[np.int64], scene: _Scene) -> NDArray[np.float32]:
    """(c, 2) places on pictures; NaN where the file has none or one too far off."""
    known = _rows(source, scene, 2)
    is_known = (rows >= 0) & (rows < len(known))
    found = np.full((len(rows), 2), np.nan)
    found[is_known] = known[rows[is_known]]
    found[~(np.abs(found) < MOST_REPEATS).all(axis=1)] = np.nan
    return found.astype(np.float32)


def _rows(source: Any, scene: _Scene, width: int) -> NDArray[np.float64]:
    """(n, width) the numbers of a source: points, or places on pictures."""
    accessor = first_below(source, "accessor")
    if accessor is None:
        raise ValueError("its points have no accessor")
    values = _numbers(scene.by_id[reference_of(accessor, "source")])
    stride, first = int(accessor.get("stride", "1")), int(accessor.get("offset", "0"))
    count = int(accessor.get("count", "0"))
    if stride < width or count < 0 or first < 0 or first + stride * count > len(values):
        raise ValueError("its points do not fit their numbers")
    found: NDArray[np.float64] = values[first : first + stride * count].reshape(count, stride)[
        :, :width
    ]
    return found


def _numbers(element: Any, kind: Any = np.float64) -> NDArray[Any]:
    return np.array((element.text or "").split(), dtype=kind)
