"""Fewer triangles under a stated error (px): right triangles that are split where it matters.

The grid of nodes is covered by large right-angled triangles, each halved at the middle of its
longest side until leaving out that node changes nothing by more than the error (Evans, Kirkpatrick
and Townsend 2001). A node that is kept keeps those that it hangs on, so that no side has a node of another triangle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.mesh import GRASS, MOVING, WATER, MeshSettings, MorphMesh, breaks

Numbers = NDArray[np.int64]


@dataclass(frozen=True)
class FewerSettings:
    """error_px: of anything that is drawn, at its worst on the way. tile: side of the largest
    triangles (cells, a power of two). psi_px: what a whole step of psi counts, and mark_px the
    border of what is marked. walk_m: how far one goes at most: what a depth that is off moves by then.
    """

    error_px: float = 1.0
    tile: int = 16
    psi_px: float = 8.0
    mark_px: float = 4.0
    walk_m: float = 2.0


def fewer_triangles(
    mesh: MorphMesh, size_px: tuple[int, int], focal_px: float,
    settings: FewerSettings = FewerSettings(), made: MeshSettings = MeshSettings(),
) -> MorphMesh:  # fmt: skip
    """The same surface of fewer triangles. size_px: of the pictures. What is torn is left as it is.

    made: the settings that the mesh was made with.
    """
    shape = grid_shape(mesh)
    if min(shape) < 3:
        return mesh
    values = _measures(mesh, size_px, focal_px, settings)
    kept = _triangles(values, _torn_nodes(mesh), shape, settings)
    used, numbers = np.unique(kept, return_inverse=True)
    triangles = numbers.reshape(kept.shape)[:, ::-1].astype(np.uint32)
    return MorphMesh(
        mesh.points[used], mesh.destinations[used], mesh.uv[used], mesh.uv_second[used],
        mesh.psi[used], triangles, _is_torn(kept, mesh, shape, made), mesh.round,
        None if mesh.marks is None else mesh.marks[used],
    )  # fmt: skip


def grid_shape(mesh: MorphMesh) -> tuple[int, int]:
    """Rows and columns of the nodes."""
    columns = int(np.argmax(mesh.uv[:, 1] != mesh.uv[0, 1])) or len(mesh.uv)
    return len(mesh.uv) // columns, columns


def _measures(
    mesh: MorphMesh, size_px: tuple[int, int], focal_px: float, settings: FewerSettings
) -> NDArray[np.float64]:
    """(v, k) what triangles interpolate, in pixels."""
    reach = focal_px * settings.walk_m
    far = [
        np.linalg.norm(ends.astype(np.float64), axis=1) for ends in (mesh.points, mesh.destinations)
    ]
    return np.column_stack(
        [
            *(reach / np.maximum(one, 0.05) for one in far),
            mesh.uv_second.astype(np.float64) * np.array(size_px),
            mesh.psi.astype(np.float64) * settings.psi_px,
            *_marked(mesh, settings),
        ]
    )


def _marked(mesh: MorphMesh, settings: FewerSettings) -> list[NDArray[np.float64]]:
    """(v,) of each mark, so that its border is kept; none where nothing is marked."""
    if mesh.marks is None or not mesh.marks.any():
        return []
    marks = [(mesh.marks & bit) > 0 for bit in (WATER, GRASS, MOVING)]
    return [mark.astype(np.float64) * settings.mark_px for mark in marks]


def _torn_nodes(mesh: MorphMesh) -> NDArray[np.bool_]:
    """(v,) the nodes of torn triangles."""
    nodes = np.zeros(len(mesh.points), dtype=bool)
    nodes[mesh.triangles[mesh.torn].ravel()] = True
    return nodes


def _triangles(
    values: NDArray[np.float64], forced: NDArray[np.bool_], shape: tuple[int, int],
    settings: FewerSettings,
) -> Numbers:  # fmt: skip
    """(t, 3) the nodes of triangles, the right angle's last."""
    rows, columns = shape
    tile = settings.tile
    high, wide = (-(-(size - 1) // tile) * tile for size in shape)
    beyond = ((0, high + 1 - rows), (0, wide + 1 - columns))
    table = np.pad(values.reshape(rows, columns, -1), (*beyond, (0, 0)), mode="edge")
    must = np.pad(forced.reshape(shape), beyond)
    # The grid ends within a tile: there all nodes are kept, and what lies beyond is left out.
    must[rows - 1 :, :] = True
    must[:, columns - 1 :] = True
    levels = _all_levels(high, wide, tile)
    worst = np.where(must, np.inf, 0.0)
    for corners in reversed(levels):
        a, b = corners[:, 0], corners[:, 1]
        middle = (a + b) // 2
        ends = table[a[:, 0], a[:, 1]] + table[b[:, 0], b[:, 1]]
        off = np.abs(table[middle[:, 0], middle[:, 1]] - 0.5 * ends).max(axis=1)
        for child in _halves(corners):
            inner = (child[:, 0] + child[:, 1]) // 2
            is_node = ((child[:, 0] + child[:, 1]) % 2 == 0).all(axis=1)
            off = np.maximum(off, np.where(is_node, worst[inner[:, 0], inner[:, 1]], 0.0))
        np.maximum.at(worst, (middle[:, 0], middle[:, 1]), off)
    return _split(levels[0], worst > settings.error_px, shape)


def _all_levels(high: int, wide: int, tile: int) -> list[Numbers]:
    """(t, 3, 2) the corners (row, column) of all triangles that have a node in the middle of their
    longest side, from the largest to the smallest.
    """
    top, left = np.meshgrid(np.arange(0, high, tile), np.arange(0, wide, tile), indexing="ij")
    start = np.stack([top.ravel(), left.ravel()], axis=1)
    down, right = np.array([tile, 0]), np.array([0, tile])
    one = np.stack([start, start + down + right, start + right], axis=1)
    other = np.stack([start + down + right, start, start + down], axis=1)
    levels = [np.concatenate([one, other])]
    while True:
        halves = np.concatenate(_halves(levels[-1]))
        if ((halves[0, 0] + halves[0, 1]) % 2).any():
            break
        levels.append(halves)
    return levels


def _halves(corners: Numbers) -> tuple[Numbers, Numbers]:
    """Both halves; the last corner is at the right angle."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    middle = (a + b) // 2
    return np.stack([c, a, middle], axis=1), np.stack([b, c, middle], axis=1)


def _split(
    corners: Numbers, needed: NDArray[np.bool_], shape: tuple[int, int]
) -> Numbers:
    """Halve all whose middle node is needed, as long as there is one."""
    done = []
    while len(corners):
        whole = corners[:, 0] + corners[:, 1]
        is_node = (whole % 2 == 0).all(axis=1)
        middle = whole // 2
        more = is_node & needed[middle[:, 0], middle[:, 1]]
        done.append(corners[~more])
        corners = np.concatenate(_halves(corners[more])) if more.any() else corners[:0]
    found = np.concatenate(done)
    found = found[(found < np.array(shape)).all(axis=(1, 2))]
    return np.asarray(found[..., 0] * shape[1] + found[..., 1])


def _is_torn(
    kept: Numbers, mesh: MorphMesh, shape: tuple[int, int], made: MeshSettings
) -> NDArray[np.bool_]:
    """(t,) whether a side at the right angle crosses a break in depth; only the smallest do."""
    right, down = breaks(mesh.depth_m.reshape(shape).astype(np.float64), made)
    torn = np.zeros(len(kept), dtype=bool)
    row, column = kept // shape[1], kept % shape[1]
    for end in (0, 1):
        upper, left = (np.minimum(one[:, end], one[:, 2]) for one in (row, column))
        level = row[:, end] == row[:, 2]
        apart = np.abs(row[:, end] - row[:, 2]) + np.abs(column[:, end] - column[:, 2])
        torn |= (apart == 1) & np.where(level, right[upper, left], down[upper, left])
    return torn
