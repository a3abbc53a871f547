"""Fittings of plans that are drawn here, by strokes of this file, and what follows from them."""

from __future__ import annotations

import math
from collections.abc import Callable

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from sample_plan import sample_plan

from veduta.plan.document import Fitting
from veduta.plan.drawn import Cleaned, Drawn, DrawnFitting, DrawnRoom
from veduta.plan.fittings.find import find_fittings, fitting_rooms
from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.furnish import furnish
from veduta.plan.names.guess import RoomFacts, guess_uses

SCALE = 70.0
"""Pixels per metre."""
MARGIN = 40


class Pen:
    """Draws on a room of 4 x 3 m in metres, y down; its walls are thick lines around it."""

    def __init__(self, width: int = 2) -> None:
        self.width = width
        self.ink = np.zeros(
            (round(3 * SCALE) + 2 * MARGIN, round(4 * SCALE) + 2 * MARGIN), np.uint8
        )
        cv2.rectangle(self.ink, self.at(-0.1, -0.1), self.at(4.1, 3.1), 255, 12)

    def at(self, x: float, y: float) -> tuple[int, int]:
        return round(x * SCALE) + MARGIN, round(y * SCALE) + MARGIN

    def box(self, x: float, y: float, width: float, height: float) -> None:
        cv2.rectangle(self.ink, self.at(x, y), self.at(x + width, y + height), 255, self.width)

    def oval(self, x: float, y: float, width: float, height: float) -> None:
        """An ellipse with this middle."""
        axes = (round(width * SCALE / 2), round(height * SCALE / 2))
        cv2.ellipse(self.ink, self.at(x, y), axes, 0, 0, 360, 255, self.width, cv2.LINE_AA)

    def line(self, x0: float, y0: float, x1: float, y1: float) -> None:
        cv2.line(self.ink, self.at(x0, y0), self.at(x1, y1), 255, self.width, cv2.LINE_AA)


def toilet(pen: Pen) -> None:
    pen.box(1.0, 0.02, 0.42, 0.16)
    pen.oval(1.21, 0.42, 0.37, 0.46)


def bath(pen: Pen) -> None:
    pen.box(0.03, 1.2, 0.75, 1.7)
    pen.oval(0.4, 2.05, 0.55, 1.5)
    pen.oval(0.4, 2.6, 0.06, 0.06)


def basin(pen: Pen) -> None:
    pen.box(2.0, 2.55, 0.6, 0.44)
    pen.oval(2.3, 2.77, 0.42, 0.28)


def shower(pen: Pen) -> None:
    pen.box(3.08, 0.02, 0.9, 0.9)
    pen.line(3.08, 0.02, 3.98, 0.92)
    pen.line(3.98, 0.02, 3.08, 0.92)


def hob(pen: Pen) -> None:
    pen.box(3.4, 1.2, 0.58, 0.6)
    for x in (3.54, 3.84):
        for y in (1.35, 1.65):
            pen.oval(x, y, 0.19, 0.19)


def sink(pen: Pen) -> None:
    """In a worktop with a hob, ribs beside it."""
    pen.box(3.4, 0.3, 0.58, 2.2)
    pen.box(3.5, 0.5, 0.36, 0.42)
    for y in (1.0, 1.08, 1.16):
        pen.line(3.5, y, 3.86, y)


def half_round(pen: Pen) -> None:
    """A basin whose tap touches its bowl, so that the rim is a C."""
    cv2.ellipse(pen.ink, pen.at(1.5, 0.02), (20, 30), 0, 0, 180, 255, pen.width, cv2.LINE_AA)
    pen.line(1.5 - 20 / SCALE, 0.02, 1.5 + 20 / SCALE, 0.02)
    pen.oval(1.5, 0.24, 0.24, 0.24)
    pen.line(1.5, 0.02, 1.5, 0.12)


def bed(pen: Pen) -> None:
    pen.box(1.0, 0.02, 1.6, 2.0)
    pen.box(1.1, 0.1, 0.6, 0.35)
    pen.box(1.9, 0.1, 0.6, 0.35)
    pen.line(1.0, 0.65, 2.6, 0.65)


WANTED: list[tuple[Callable[[Pen], None], str, tuple[float, float], tuple[float, float]]] = [
    (toilet, "toilet", (1.21, 0.34), (0, -1)),
    (bath, "bathtub", (0.4, 2.05), (-1, 0)),
    (basin, "basin", (2.3, 2.77), (0, 1)),
    (shower, "shower", (3.53, 0.47), (0, 0)),
    (hob, "hob", (3.69, 1.5), (1, 0)),
    (bed, "bed", (1.8, 1.02), (0, -1)),
]  # fmt: skip


def found_in(pen: Pen, quarter: int = 0) -> tuple[list[DrawnFitting], NDArray[np.float64]]:
    """What is found on the sheet turned by quarters, and how pixels were turned, (2, 3)."""
    ink = np.rot90(pen.ink, -quarter).astype(np.float32) / 255.0
    height = pen.ink.shape[0]
    turns = {0: [[1, 0, 0], [0, 1, 0]], 1: [[0, -1, height], [1, 0, 0]]}
    affine = np.array(turns[quarter], dtype=np.float64)
    corners = np.array(
        [pen.at(x, y) for x, y in ((0, 0), (0, 3), (4, 3), (4, 0))], dtype=np.float64
    )
    outline = corners @ affine[:, :2].T + affine[:, 2]
    pixels = np.repeat((255 - 255 * ink).astype(np.uint8)[..., None], 3, axis=2)
    cleaned = Cleaned(pixels, np.ascontiguousarray(ink), np.eye(3), False, 0.0, float(pen.width))
    room_ = DrawnRoom("r1", outline, (), (), (), False, 1.0)
    return list(find_fittings(Drawn(cleaned, (), (), (), (room_,)), 1 / SCALE)), affine


@pytest.mark.parametrize("quarter", [0, 1])
@pytest.mark.parametrize(("draw", "kind", "middle", "back"), WANTED)
def test_a_symbol_is_what_it_is_and_where_it_is(
    draw: Callable[[Pen], None],
    kind: str,
    middle: tuple[float, float],
    back: tuple[float, float],
    quarter: int,
) -> None:
    pen = Pen()
    draw(pen)
    found, affine = found_in(pen, quarter)
    assert [one.kind for one in found] == [kind]
    at = affine[:, :2] @ np.array(pen.at(*middle)) + affine[:, 2]
    assert np.linalg.norm(found[0].middle_px - at) < 0.08 * SCALE
    if any(back):
        assert found[0].back @ (affine[:, :2] @ np.array(back)) > 0.95


def test_a_bathroom_has_all_its_things() -> None:
    pen = Pen()
    for draw in (toilet, bath, basin, shower):
        draw(pen)
    assert sorted(one.kind for one in found_in(pen)[0]) == ["basin", "bathtub", "shower", "toilet"]


def cupboards(pen: Pen) -> None:
    for x in (0.02, 0.62, 1.22):
        pen.box(x, 0.02, 0.6, 0.6)
    pen.box(2.4, 0.02, 1.5, 0.6)
    pen.line(2.4, 0.02, 3.9, 0.62)
    pen.line(3.9, 0.02, 2.4, 0.62)


def table(pen: Pen) -> None:
    pen.box(1.4, 1.1, 1.2, 0.8)
    for x in (1.7, 2.3):
        pen.box(x - 0.2, 0.65, 0.4, 0.4)
        pen.box(x - 0.2, 1.95, 0.4, 0.4)


def tiles(pen: Pen) -> None:
    for k in range(1, 13):
        pen.line(0.3 * k, 0, 0.3 * k, 3)
    for k in range(1, 10):
        pen.line(0, 0.3 * k, 4, 0.3 * k)


def letters(pen: Pen) -> None:
    cv2.putText(pen.ink, "BOARD ROOM 80", pen.at(0.5, 1.5), cv2.FONT_HERSHEY_SIMPLEX, 0.9, 255, 2)


@pytest.mark.parametrize("draw", [cupboards, table, tiles, letters])
def test_what_is_none_is_none(draw: Callable[[Pen], None]) -> None:
    pen = Pen()
    draw(pen)
    assert found_in(pen)[0] == []


def test_a_name_that_says_another_room_goes_before_a_symbol() -> None:
    pen = Pen()
    bath(pen)
    found, _ = found_in(pen)
    assert fitting_rooms(found, {"r1": "bedroom"}) == ()
    assert [one.kind for one in fitting_rooms(found, {"r1": "bathroom"})] == ["bathtub"]
    assert len(fitting_rooms(found, {})) == 1


@pytest.mark.parametrize(
    ("drawn", "area_m2", "use"),
    [("bathtub", 11.0, "bathroom"), ("toilet", 1.5, "toilet"), ("toilet", 6.0, "bathroom"),
     ("hob", 12.0, "kitchen"), ("hob", 40.0, "living"), ("bed", 5.0, "bedroom")],
)  # fmt: skip
def test_what_is_drawn_names_a_room(drawn: str, area_m2: float, use: str) -> None:
    facts = RoomFacts(area_m2=area_m2, fittings=frozenset({drawn}))  # type: ignore[arg-type]
    assert guess_uses([facts], [], [None])[0][0] == use


def test_things_stand_where_they_are_drawn() -> None:
    document = sample_plan()
    storey = document.storeys[0]
    bathroom = next(one for one in storey.rooms if one.use == "bathroom")
    xs, ys = zip(*bathroom.outline_m, strict=True)
    # In the middle of its upper wall, facing down, and a little askew.
    at = ((min(xs) + max(xs)) / 2, max(ys) - 0.36)
    drawn = Fitting(
        id="t1",
        kind="toilet",
        room=bathroom.id,
        at_m=at,
        turn_rad=0.03,
        size_m=(0.4, 0.66),
        score=0.9,
    )
    asked = document.model_copy(
        update={"storeys": [storey.model_copy(update={"fittings": [drawn]}), *document.storeys[1:]]}
    )
    made = furnish(asked, builtin_catalogue(), 0, 0.25)[0].storeys[0].furniture or []
    entries = builtin_catalogue().entries
    toilets = [
        one for one in made if entries[one.object].type == "toilet" and one.room == bathroom.id
    ]
    assert len(toilets) == 1
    assert toilets[0].origin == "measured"
    assert math.dist(toilets[0].at_m, at) < 0.1
    assert toilets[0].turn_rad == pytest.approx(0.0, abs=1e-6)
    assert all(one.origin == "invented" for one in made if one is not toilets[0])
    assert [entries[one.object].type for one in made if one.room == bathroom.id].count("basin") <= 1


def test_what_is_drawn_near_each_other_stands_near_each_other() -> None:
    document = sample_plan()
    storey = document.storeys[0]
    bathroom = next(one for one in storey.rooms if one.use == "bathroom")
    xs, ys = zip(*bathroom.outline_m, strict=True)
    # A toilet at the upper wall, and a basin right before it at the side: within its free space.
    places = {
        "toilet": ((max(xs) - 0.6, max(ys) - 0.36), 0.0, (0.4, 0.66)),
        "basin": ((max(xs) - 0.26, max(ys) - 1.02), -math.pi / 2, (0.55, 0.45)),
    }
    drawn = [
        Fitting(
            id=kind,
            kind=kind,
            room=bathroom.id,
            at_m=at,
            turn_rad=turn,
            size_m=size,
            score=0.9,  # type: ignore[arg-type]
        )
        for kind, (at, turn, size) in places.items()
    ]
    asked = document.model_copy(
        update={"storeys": [storey.model_copy(update={"fittings": drawn}), *document.storeys[1:]]}
    )
    made = furnish(asked, builtin_catalogue(), 0, 0.25)[0].storeys[0].furniture or []
    measured = [one for one in made if one.origin == "measured"]
    assert len(measured) == 2
    # No smaller one aside, which would leave the free space before the toilet.
    assert measured[1].size_m[0] == pytest.approx(0.55)
    assert measured[1].at_m[1] == pytest.approx(places["basin"][0][1], abs=0.01)


@pytest.mark.parametrize("quarter", [0, 1])
def test_a_sink_is_found_in_its_worktop(quarter: int) -> None:
    pen = Pen()
    sink(pen)
    found, _ = found_in(pen, quarter)
    assert [one.kind for one in found] == ["kitchen-sink"]


def test_a_basin_whose_tap_touches_its_bowl_is_one() -> None:
    pen = Pen(1)
    half_round(pen)
    found, _ = found_in(pen)
    assert [one.kind for one in found] == ["basin"]
