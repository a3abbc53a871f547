"""Reading the triangles and colours of any binary glTF file, whoever wrote it."""

from __future__ import annotations

import io
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from veduta.formats.glb_bounds import require_bounded
from veduta.formats.obj_read import LARGEST_BYTES, MOST_CORNERS, ReadMesh
from veduta.imaging.srgb import srgb_of_linear
from veduta.place.material import Colour
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import limited

if TYPE_CHECKING:
    import trimesh

_REMEDY = "Export it again as binary glTF 2.0 (.glb), with everything in one file."


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
        scene = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)
        pieces = [one for one in scene.dump() if isinstance(one, trimesh.Trimesh)]
        return _joined(pieces, most_corners)
    except (
        ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error, OSError,
        RecursionError, MemoryError, OverflowError,
    ) as error:  # fmt: skip
        raise InputError(path, f"is no mesh that can be read ({error})", _REMEDY) from error


def _joined(pieces: list[trimesh.Trimesh], most_corners: int) -> ReadMesh:
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
    number_of: dict[tuple[str, Colour | None], int] = {}
    rows = [number_of.setdefault(_material(piece), len(number_of)) for piece in pieces]
    return ReadMesh(
        points=points,
        corners=np.concatenate(corners).astype(np.uint32),
        offsets=np.arange(0, 3 * count + 1, 3, dtype=np.int64),
        face_material=np.repeat(rows, [len(piece.faces) for piece in pieces]).astype(np.int32),
        materials=tuple(number_of),
        face_group=np.zeros(count, dtype=np.int32),
        groups=("",),
    )


def _material(piece: trimesh.Trimesh) -> tuple[str, Colour | None]:
    """Name and base colour; glTF's colours are linear, and trimesh hands them on as 0 to 255."""
    material = getattr(piece.visual, "material", None)
    factor = getattr(material, "baseColorFactor", None)
    name = str(getattr(material, "name", None) or "")
    if factor is None:
        return name, None
    linear = np.asarray(factor, dtype=np.float64)[:3] / 255.0
    red, green, blue = np.clip(srgb_of_linear(linear), 0.0, 1.0).round(4).tolist()
    return name, (red, green, blue)
