"""The scorers of the plan benchmark, on cases made by hand."""

from __future__ import annotations

import typing

import numpy as np
import pytest
from plan_scores import Hits, gap_overlap, iou, matched, opening_hits, room_hits, same_use, score
from plan_truth import Gap, Layout, Space, found_layout, true_layout
from shapely.geometry import Polygon, box

from veduta.plan import document
from veduta.synthetic.plans import house
from veduta.synthetic.plans.house import Opening, Room, Wall
from veduta.synthetic.plans.house import Storey as TrueStorey
from veduta.synthetic.plans.truth_file import SheetTruth


def gap(start: tuple[float, float], end: tuple[float, float], kind: str = "door") -> Gap:
    return Gap(kind, "swing", np.array([start, end], float), 0.2)


def test_words_are_those_of_the_document() -> None:
    pairs = (
        (house.Use, document.RoomUse),
        (house.DoorType, document.DoorType),
        (house.WindowType, document.WindowType),
    )
    for own, theirs in pairs:
        assert set(typing.get_args(own)) <= set(typing.get_args(theirs))


@pytest.mark.parametrize(
    ("start", "end", "expected"),
    [
        ((1.0, 0.0), (2.0, 0.0), 1.0),
        ((2.0, 0.0), (1.0, 0.0), 1.0),  # the other way along the wall
        ((1.5, 0.1), (2.5, 0.1), 0.5 / 1.5),
        ((0.0, 0.0), (4.0, 0.0), 0.25),
        ((2.0, 0.0), (3.0, 0.0), 0.0),  # beside it
        ((1.0, 0.4), (2.0, 0.4), 0.0),  # in another wall
        ((1.5, -0.5), (1.5, 0.5), 0.0),  # across
    ],
)
def test_overlap_along_the_wall(
    start: tuple[float, float], end: tuple[float, float], expected: float
) -> None:
    assert gap_overlap(gap(start, end), gap((1.0, 0.0), (2.0, 0.0))) == pytest.approx(expected)


def test_openings_are_counted_once_and_by_kind() -> None:
    true = [gap((1, 0), (2, 0)), gap((4, 0), (5, 0), "window")]
    found = [gap((1, 0), (2, 0)), gap((1.05, 0), (2.05, 0)), gap((4, 0), (5, 0))]
    assert opening_hits(found, true) == Hits(1, 3, 2)
    assert opening_hits(found, true, kind=False) == Hits(2, 3, 2)
    assert Hits(1, 3, 2).f1 == pytest.approx(2 / 5)
    assert Hits(0, 0, 0).f1 == 1.0
    assert Hits(0, 2, 0).precision == 0.0


def test_matching_is_the_best_of_all() -> None:
    """Greedy would pair the first two and leave the rest; here 0.6 + 0.6 beats 0.7."""
    table = {(0, 0): 0.7, (0, 1): 0.6, (1, 0): 0.6}
    pairs = matched([0, 1], [0, 1], lambda i, j: table.get((i, j), 0.0))
    assert pairs == [(0, 1), (1, 0)]


def test_rooms_need_their_shape_and_their_use() -> None:
    true = [Space("kitchen", box(0, 0, 4, 3)), Space("hall", box(4, 0, 6, 3))]
    found = [Space("bedroom", box(0, 0, 4, 3)), Space("corridor", box(4, 0, 6, 2.5))]
    assert room_hits(found, true) == Hits(1, 2, 2)
    assert room_hits(found, true, use=False) == Hits(2, 2, 2)
    small = [Space("hall", box(4, 0, 6, 2.3))]
    assert room_hits(small, true) == Hits(0, 1, 2)
    assert same_use("hall", "corridor")
    assert not same_use("hall", "kitchen")


def test_a_sheet_that_cannot_be_read_scores_nothing() -> None:
    solid = box(0, 0, 4, 0.2)
    true = Layout(solid, solid, (gap((1, 0), (2, 0)),), (Space("hall", box(0, 0, 1, 1)),), 0.01)
    lost = score(None, true)
    assert lost.wall_iou == 0.0
    assert lost.openings == Hits(0, 0, 1)
    assert lost.rooms == Hits(0, 0, 1)
    assert lost.scale_error is None
    right = score(true, true)
    assert right.wall_iou == right.wall_recall == right.openings.f1 == right.rooms.recall == 1.0
    assert right.scale_error == 0.0
    assert iou(Polygon(), Polygon()) == 1.0


def _truth(px_from_m: np.ndarray) -> SheetTruth:
    walls = (
        Wall("w0", (0.0, 0.0), (4.0, 0.0), 0.0, 0.2, "r0", None),
        Wall("w1", (4.0, 0.0), (4.0, 3.0), 0.0, 0.2, "r0", None),
        Wall("w2", (4.0, 3.0), (0.0, 3.0), 0.3, 0.2, "r0", None),
        Wall("w3", (0.0, 3.0), (0.0, 0.0), 0.0, 0.2, "r0", None),
    )
    openings = (
        Opening("d0", "w0", "door", "swing", 0.5, 0.9, "start", "left"),
        Opening("g0", "w1", "gap", "plain", 0.5, 1.2),
    )
    room = Room("r0", "living", ((0.1, 0.1), (3.9, 0.1), (3.9, 2.9), (0.1, 2.9)), 3.8 * 2.8)
    storey = TrueStorey(0, walls, openings, (room,))
    return SheetTruth("a.png", 1, "plain", "clean", (), "filled", px_from_m, True, None, storey)


def _document(truth: SheetTruth, scale_error: float, clean: np.ndarray) -> document.Storey:
    """What a perfect reader writes that takes a metre for `1 / (1 + scale_error)` of one."""
    metres_per_px = truth.metres_per_px / np.sqrt(abs(np.linalg.det(clean[:2, :2])))
    metres_per_px *= 1.0 + scale_error
    origin = (123.0, 456.0)
    clean_from_truth = clean @ truth.px_from_m

    def metres(point: tuple[float, float]) -> tuple[float, float]:
        x, y, _ = clean_from_truth @ [*point, 1.0]
        return (x - origin[0]) * metres_per_px, (origin[1] - y) * metres_per_px

    grow = 1.0 + scale_error
    turned = np.linalg.det(clean_from_truth[:2, :2]) > 0  # the reader left it mirrored
    storey = truth.storey
    return document.Storey.model_validate(
        {
            "name": "0", "elevation_m": 0.0, "height_m": 2.7,
            "sheet": {
                "file": "a.png", "sha256": "", "width_px": 1, "height_px": 1,
                "clean_from_scan": clean.tolist(), "origin_px": origin,
                "metres_per_px": metres_per_px,
            },
            "scale": {"metres_per_px": metres_per_px, "sigma": 0.01, "basis": "evidence"},
            "junctions": [
                {"id": w.id, "at_m": metres(w.start_m), "type": "L"} for w in storey.walls
            ],
            "walls": [
                {
                    "id": w.id, "start": w.id, "end": storey.walls[(i + 1) % 4].id,
                    "bulge": -w.bulge if turned else w.bulge,
                    "thickness_m": w.thickness_m * grow, "drawing": "filled", "outer": True,
                    "score": 1.0,
                }
                for i, w in enumerate(storey.walls)
            ],
            "openings": [
                {
                    "id": o.id, "wall": o.wall, "kind": "door", "type": o.type,
                    "along_m": o.along_m * grow, "width_m": o.width_m * grow, "height_m": 2.1,
                    "score": 1.0,
                }
                for o in storey.openings
            ],
            "rooms": [
                {
                    "id": r.id, "outline_m": [metres(p) for p in r.outline_m], "area_m2": 1.0,
                    "use": r.use, "use_score": 1.0, "score": 1.0,
                }
                for r in storey.rooms
            ],
        }
    )  # fmt: skip


@pytest.mark.parametrize("scale_error", [0.0, 0.25])
@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_a_perfect_reading_is_perfect_on_any_scan(scale_error: float, flip: float) -> None:
    """Turned, mirrored, cleaned at another size and wrongly scaled, it lies on the truth."""
    cos, sin = np.cos(0.06), np.sin(0.06)
    px_from_m = np.array([[80 * cos, -80 * sin, 40.0], [-80 * sin, -80 * cos, 500.0], [0, 0, 1.0]])
    clean = np.array(
        [[flip * 1.7 * cos, flip * 1.7 * sin, 9.0], [-1.7 * sin, 1.7 * cos, 4.0], [0, 0, 1]]
    )
    truth = _truth(px_from_m)
    true = true_layout(truth)
    found = found_layout(_document(truth, scale_error, clean), truth.px_from_m, False)
    result = score(found, true)
    assert result.wall_iou == pytest.approx(1.0, abs=1e-6)
    assert result.openings == Hits(2, 2, 2)
    assert result.rooms == Hits(1, 1, 1)
    assert result.scale_error == pytest.approx(scale_error)
