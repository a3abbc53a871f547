"""What hangs together in a mesh, against a walk from vertex to vertex."""

from __future__ import annotations

import numpy as np

from veduta.surfaces import compact, vertex_pieces


def _walked(triangles: list[tuple[int, int, int]], vertices: int) -> list[set[int]]:
    beside: list[set[int]] = [set() for _ in range(vertices)]
    for triangle in triangles:
        for one in triangle:
            beside[one] |= set(triangle)
    found: list[set[int]] = []
    for start in range(vertices):
        if any(start in one for one in found):
            continue
        reached, edge = {start}, {start}
        while edge:
            edge = set().union(*(beside[one] for one in edge)) - reached
            reached |= edge
        found.append(reached)
    return found


def test_vertices_that_triangles_join_are_one_piece() -> None:
    random = np.random.default_rng(5)
    triangles = random.integers(0, 60, (24, 3))
    pieces = vertex_pieces(triangles, 60)
    sets = [set(np.flatnonzero(pieces == one).tolist()) for one in range(pieces.max() + 1)]
    assert sets == _walked([tuple(one) for one in triangles.tolist()], 60)


def test_only_used_points_stay_in_their_order() -> None:
    points = np.arange(12.0).reshape(6, 2)
    left, triangles = compact(points, np.array([[5, 1, 3], [3, 1, 5]], np.uint32))
    assert left.tolist() == [[2.0, 3.0], [6.0, 7.0], [10.0, 11.0]]
    assert triangles.tolist() == [[2, 0, 1], [1, 0, 2]]
    assert triangles.dtype == np.uint32
