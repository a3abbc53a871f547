"""A segment as it was scanned: the models that the studio shows instead of the mended ones."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.coloured import coloured
from veduta.drive.build.fill import Source
from veduta.drive.build.layers import Layers
from veduta.drive.build.pictures_of import Seen
from veduta.drive.build.segment import Geometry
from veduta.drive.build.surface import surface_over
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.place import ModelFile, PlacedPart, Standing
from veduta.place.semantics import SemanticClass

RAW = "raw"
UNSEEN = (150, 150, 148)
"""The colour of what no image shows."""
_BLOCKS = ((1, 1), (2, 1), (3, 1), (2, 2), (3, 2), (4, 2), (4, 3))
"""Beams that make one cell, up and along."""
_WHOLE = 0.85
"""Cells are large enough where so many have neighbours."""


def raw_file(identity: str) -> str:
    """The name of a part's raw model in the folder of the place."""
    return f"{RAW}/{identity}.glb"


def met(geometry: Geometry) -> tuple[NDArray[np.float64], NDArray[np.float32], NDArray[np.bool_]]:
    """What the beams met first: (r, c, 3) points (m), their depths, and where it is no ground.

    Beams lie closer than the scanner's where it is coarse: of a few neighbours the nearest is taken,
    so many that most cells have one. NaN where there is none.
    """
    first, frame = geometry.layers.first, geometry.frame
    shares = []
    for rows, columns in _BLOCKS:
        cells = _in_blocks(first, rows, columns)
        shares.append(_neighbours(np.where(np.isfinite(cells), cells, np.inf).min(axis=2)))
        if shares[-1] > _WHOLE:
            break
    rows, columns = _BLOCKS[int(np.argmax(shares))]
    cells = _in_blocks(first, rows, columns)
    nearest = np.where(np.isfinite(cells), cells, np.inf).argmin(axis=2)
    depth = np.take_along_axis(cells, nearest[..., None], axis=2)[..., 0]
    at = [
        np.take_along_axis(_in_blocks(one, rows, columns), nearest[..., None], axis=2)[..., 0]
        for one in (*np.moveaxis(frame.vertices(first), 2, 0), on_ground(geometry.layers))
    ]
    return np.stack(at[:3], axis=2), depth, at[3] == 0


def _in_blocks(image: NDArray[Any], rows: int, columns: int) -> NDArray[Any]:
    """(r / rows, c / columns, rows * columns) the pixels of each block; the last ones repeat."""
    height, width = image.shape
    padded = np.pad(image, [(0, -height % rows), (0, -width % columns)], mode="edge")
    cells = padded.reshape(padded.shape[0] // rows, rows, -1, columns).swapaxes(1, 2)
    return np.asarray(cells.reshape(*cells.shape[:2], rows * columns))


def _neighbours(depth: NDArray[np.float32]) -> float:
    """The share of cells that have one above and beside them."""
    there = np.isfinite(depth)
    joined = there[:-1, :-1] & there[1:, :-1] & there[:-1, 1:]
    return float(joined.sum() / max(there.sum(), 1))


def raw_meshes(
    geometry: Geometry, middle: NDArray[np.float64], seen: Sequence[Seen]
) -> list[Mesh]:
    """What each beam met first, as triangles about `middle` (3,): walls and all before them, and
    the ground; without those that are empty.
    """
    grid, depth, standing = met(geometry)
    source = np.where(np.isfinite(depth), Source.MEASURED, Source.NOTHING).astype(np.uint8)
    surface = surface_over(grid, depth, source, standing, geometry.frame)
    colours = coloured(surface.vertices, seen, UNSEEN)
    found = []
    for wall in (True, False):
        used, triangles = np.unique(surface.triangles[surface.wall == wall], return_inverse=True)
        if not len(used):
            continue
        identity = geometry.segment.id if wall else f"{geometry.segment.id}-ground"
        found.append(Mesh.simple(
            identity, surface.vertices[used] - middle, triangles.reshape(-1, 3),
            SemanticClass.OTHER if wall else SemanticClass.GROUND, name="as scanned",
            colours=colours[used], material=Material("as scanned", unlit=bool(len(seen))),
        ))  # fmt: skip
    return found


def on_ground(layers: Layers) -> NDArray[np.bool_]:
    """(r, c) the beams that met the ground, and nothing before it."""
    return np.asarray(~layers.wall & ~np.isfinite(layers.foreground))


def write_raw(meshes: Sequence[Mesh], folder: Path) -> frozenset[str]:
    """Write the raw models of a segment into the folder of the place; the ids of their parts."""
    for mesh in meshes:
        file = ModelFile(raw_file(mesh.id))
        row = PlacedPart(mesh.id, Standing(), partial(_itself, mesh), file=file, _content=mesh)
        row.save(folder)
    return frozenset(mesh.id for mesh in meshes)


def _itself(mesh: Mesh) -> Mesh:
    return mesh
