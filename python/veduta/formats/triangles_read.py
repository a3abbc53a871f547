"""What is in STL and PLY files, by trimesh: for the process that reads under limits."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_LARGEST_BYTES = 2 * 2**30


@dataclass(frozen=True, eq=False)
class ReadTriangles:
    """vertices_m: (v, 3). triangles: (m, 3) of them. colours: (v, 3) where there are some."""

    vertices_m: NDArray[np.float64]
    triangles: NDArray[np.int64]
    colours: NDArray[np.uint8] | None


@dataclass(frozen=True, eq=False)
class ReadPoints:
    """points_m: (n, 3). colours: (n, 3), grey where the file has none."""

    points_m: NDArray[np.float64]
    colours: NDArray[np.uint8]


def read_triangles(path: Path) -> ReadTriangles | ReadPoints:
    """The triangles of a file, or its points; InputError where it has neither."""
    import trimesh  # here, as it takes longer to import than all else that most calls need

    try:
        require_file(path, _LARGEST_BYTES)
        found = trimesh.load(path, process=False)
    except FileNotFoundError:
        raise InputError(path, "does not exist", "Check its name.") from None
    except (ValueError, KeyError, IndexError, TypeError, OSError, MemoryError) as error:
        fault = f"is no {path.suffix[1:].upper()} file that can be read ({error})"
        raise InputError(path, fault, "Export it again.") from error
    if isinstance(found, trimesh.PointCloud):
        points = np.asarray(found.vertices, dtype=np.float64)
        return ReadPoints(points, _colours(np.asarray(found.colors, np.uint8), len(points)))
    if isinstance(found, trimesh.Trimesh) and len(found.faces):
        colours = None
        if isinstance(found.visual, trimesh.visual.ColorVisuals) and found.visual.kind == "vertex":
            colours = np.asarray(found.visual.vertex_colors, dtype=np.uint8)[:, :3].copy()
        vertices = np.asarray(found.vertices, dtype=np.float64)
        return ReadTriangles(vertices, np.asarray(found.faces), colours)
    raise InputError(path, "has neither triangles nor points", "Check that it is the right one.")


def _colours(given: NDArray[np.uint8], count: int) -> NDArray[np.uint8]:
    if given.shape[:1] != (count,) or given.ndim != 2:
        return np.full((count, 3), 200, dtype=np.uint8)
    return given[:, :3].copy()
