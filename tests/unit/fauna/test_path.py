"""Paths over a terrain against a plain Dijkstra, and each way in which a path can be bad."""

from __future__ import annotations

import heapq
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from veduta.fauna.path.given import read_path
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.plan import free_cells, planned_way
from veduta.fauna.path.terrain import terrain_of, terrain_of_heights
from veduta.fauna.path.through import FoundPath, path_through
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError, NotFoundError

LIMITS = PathLimits()


def _hills(side: int, *, seed: int = 5, height: float = 0.6) -> np.ndarray:
    rough = np.random.default_rng(seed).normal(size=(side, side))
    smooth = cv2.GaussianBlur(rough, (0, 0), side / 12.0)
    return smooth / smooth.std() * height


def _scores(
    free: np.ndarray, heights: np.ndarray, cell: float, start: tuple[int, int]
) -> np.ndarray:
    """The least score to every cell, with a heap: the same weights, written anew."""
    mean = cv2.blur(heights, (3, 3))
    spread = np.maximum(cv2.blur(heights**2, (3, 3)) - mean**2, 0.0)
    best = np.full(free.shape, np.inf)
    best[start] = 0.0
    heap = [(0.0, start)]
    while heap:
        score, (row, column) = heapq.heappop(heap)
        if score > best[row, column]:
            continue
        for down in (-1, 0, 1):
            for right in (-1, 0, 1):
                near = (row + down, column + right)
                if (down, right) == (0, 0) or not (
                    0 <= near[0] < free.shape[0] and 0 <= near[1] < free.shape[1]
                ):
                    continue
                length = cell * np.hypot(down, right)
                if not free[near] or abs(heights[near] - heights[row, column]) > length * np.tan(
                    np.radians(LIMITS.slope_deg)
                ):
                    continue
                varied = 0.5 * (spread[near] + spread[row, column])
                worth = score + length * (1.0 + varied / (LIMITS.step * 1.0) ** 2)
                if worth < best[near]:
                    best[near] = worth
                    heapq.heappush(heap, (worth, near))
    return best


def test_the_way_has_the_least_score() -> None:
    heights = _hills(40)
    heights[10:13, 5:35] = np.nan
    terrain = terrain_of_heights(heights, 0.25, (0.0, 0.0))
    ways = free_cells(terrain, LIMITS, 1.0)
    cells = np.argwhere(ways.free)
    first, last = cells[3], cells[-4]
    points = terrain.point_of(np.stack([first, last]).astype(float))
    way = planned_way(terrain, ways, points, LIMITS, 1.0).astype(int)
    best = _scores(ways.free, ways.heights_m, 0.25, (int(first[0]), int(first[1])))
    assert tuple(way[0]) == tuple(first)
    assert tuple(way[-1]) == tuple(last)
    along = [best[tuple(cell)] for cell in way]
    # Every cell of a shortest way is reached by a shortest way.
    back = _scores(ways.free, ways.heights_m, 0.25, (int(last[0]), int(last[1])))
    assert all(
        a + back[tuple(cell)] == pytest.approx(best[tuple(last)])
        for a, cell in zip(along, way, strict=True)
    )


def test_a_large_terrain_is_planned_nearly_as_well() -> None:
    heights = _hills(300)
    terrain = terrain_of_heights(heights, 0.25, (0.0, 0.0))
    ways = free_cells(terrain, LIMITS, 1.0)
    points = np.array([[5.0, 6.0], [66.0, 60.0]])
    way = planned_way(terrain, ways, points, LIMITS, 1.0).astype(int)
    best = _scores(ways.free, ways.heights_m, 0.25, tuple(way[0]))
    score = 0.0
    mean = cv2.blur(ways.heights_m, (3, 3))
    spread = np.maximum(cv2.blur(ways.heights_m**2, (3, 3)) - mean**2, 0.0)
    for a, b in zip(way[:-1], way[1:], strict=True):
        length = 0.25 * float(np.hypot(*(b - a)))
        score += length * (1.0 + 0.5 * (spread[tuple(a)] + spread[tuple(b)]) / LIMITS.step**2)
    assert score <= 1.05 * best[tuple(way[-1])]


def test_the_path_is_smooth_clear_and_on_the_ground() -> None:
    heights = _hills(120, height=0.3)
    heights[50:70, 0:90] = np.nan
    terrain = terrain_of_heights(heights, 0.2, (-3.0, 2.0))
    points = np.array([[0.0, 5.0], [0.0, 22.0]])
    found = path_through(terrain, points, LIMITS, 1.0)
    cells = np.round(terrain.cell_of(found.points_m)).astype(int)
    assert found.ways.free[cells[:, 0], cells[:, 1]].all()
    assert np.allclose(found.points_m[[0, -1], :2], points, atol=0.15)
    assert np.abs(found.points_m[:, 2] - terrain.height_at(found.points_m)).max() < 0.1
    steps = np.diff(found.points_m[:, :2], axis=0)
    turns = np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))
    assert np.abs(turns).max() < 0.35


def test_a_round_where_nobody_asked_for_a_path() -> None:
    terrain = terrain_of_heights(_hills(100, height=0.2), 0.2, (0.0, 0.0))
    found = path_through(terrain, None, LIMITS, 0.6)
    assert found.closed
    assert np.allclose(found.points_m[0], found.points_m[-1])
    apart = np.linalg.norm(found.points_m[None, :, :2] - found.through_m[:, None], axis=2)
    assert apart.min(axis=1).max() < 0.35 * 0.6 + 0.2


def _place(*, marked: bool = True) -> Place:
    ground = np.array([[0, 0, 0], [20, 0, 0], [20, 20, 4], [0, 20, 4]], dtype=float)
    wall = np.array([[8, 0, -1], [8, 15, -1], [8, 15, 6], [8, 0, 6]], dtype=float)
    roof = np.array([[12, 2, 9], [18, 2, 9], [18, 8, 9], [12, 8, 9]], dtype=float)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    place = Place()
    place.add(Mesh.simple("ground", ground, faces, SemanticClass.GROUND), Standing(ground=marked))
    place.add(Mesh.simple("wall", wall, faces, SemanticClass.WALL))
    place.add(Mesh.simple("roof", roof, faces, SemanticClass.ROOF))
    return place


def test_the_ground_of_a_place_and_what_stands_on_it() -> None:
    terrain = terrain_of(_place(), 1.0)
    at = np.array([[3.0, 10.0], [15.0, 5.0], [8.0, 5.0], [8.0, 18.0]])
    assert np.allclose(terrain.height_at(at), 0.2 * at[:, 1], atol=1e-4)
    cells = np.round(terrain.cell_of(at)).astype(int)
    # The wall is in the way, what is under the roof is not.
    assert terrain.blocked[cells[:, 0], cells[:, 1]].tolist() == [False, False, True, False]


def test_a_path_goes_round_a_wall() -> None:
    found = path_through(
        terrain_of(_place(), 1.0), np.array([[3.0, 3.0], [14.0, 3.0]]), LIMITS, 1.0
    )
    crossing = found.points_m[np.abs(found.points_m[:, 0] - 8.0).argmin()]
    assert crossing[1] > 15.0


@pytest.mark.parametrize(
    ("points", "fault"),
    [
        ([[3.0, 3.0]], "one point only"),
        ([[3.0, 3.0], [8.0, 5.0]], "is in an obstacle"),
        ([[3.0, 3.0], [50.0, 5.0]], "outside of the terrain"),
    ],
)
def test_bad_points_are_refused(points: list[list[float]], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        path_through(terrain_of(_place(), 1.0), np.array(points), LIMITS, 1.0)


def test_no_way_over_a_cliff() -> None:
    heights = np.zeros((60, 60))
    heights[30:] = 5.0
    terrain = terrain_of_heights(heights, 0.25, (0.0, 0.0))
    with pytest.raises(NotFoundError, match="slopes of more than 35 degrees"):
        path_through(terrain, np.array([[5.0, 3.0], [5.0, 12.0]]), LIMITS, 1.0)


def test_no_way_through_a_wall_that_parts_the_place() -> None:
    heights = np.zeros((60, 60))
    heights[30:32] = np.nan
    terrain = terrain_of_heights(heights, 0.25, (0.0, 0.0))
    with pytest.raises(NotFoundError, match="part two points"):
        path_through(terrain, np.array([[5.0, 3.0], [5.0, 12.0]]), LIMITS, 1.0)


def test_a_place_without_ground_is_refused() -> None:
    with pytest.raises(InputError, match="has no ground"):
        terrain_of(_place(marked=False), 1.0)


def test_paths_as_geojson(tmp_path: Path) -> None:
    path = tmp_path / "path.geojson"
    line = {"type": "LineString", "coordinates": [[0, 1], [2, 3, 9]]}
    path.write_text(json.dumps({"type": "Feature", "geometry": line, "properties": {}}))
    assert read_path(path).tolist() == [[0.0, 1.0], [2.0, 3.0]]
    features = [
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [k, k]}} for k in range(3)
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    assert len(read_path(path)) == 3


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("{", "is no JSON"),
        ('{"type": "Point", "coordinates": [1, 2]}', "has 1 points"),
        ('{"type": "LineString", "coordinates": [[1, 2], ["a", 2]]}', "no numbers"),
        ('{"type": "LineString", "coordinates": [[1, 2], [1]]}', "no numbers"),
        ("[]", "has 0 points"),
    ],
)
def test_bad_geojson_is_refused(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "path.geojson"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        read_path(path)


def _back_and_forth(heights: np.ndarray, *, turns: bool) -> FoundPath:
    terrain = terrain_of_heights(heights, 0.25, (0.0, 0.0))
    points = np.array([[3.0, 10.0], [15.0, 10.0], [4.0, 12.0]])
    return path_through(terrain, points, LIMITS, 1.0, turns=turns)


def test_what_has_legs_turns_on_the_spot_where_it_goes_back() -> None:
    found = _back_and_forth(np.zeros((80, 80)), turns=True)
    (corner,) = found.corners
    np.testing.assert_allclose(found.points_m[corner, :2], [15.0, 10.0], atol=0.2)
    came = found.points_m[corner] - found.points_m[corner - 3]
    goes = found.points_m[corner + 3] - found.points_m[corner]
    assert came @ goes < -0.9 * np.linalg.norm(came) * np.linalg.norm(goes)
    # Without legs it goes round in a curve.
    assert _back_and_forth(np.zeros((80, 80)), turns=False).corners == ()


def test_nobody_turns_where_a_wall_is_in_the_way() -> None:
    heights = np.zeros((80, 80))
    heights[:, 62:64] = np.nan  # the point is on the ground, the nose would be in the wall
    assert _back_and_forth(heights, turns=True).corners == ()
