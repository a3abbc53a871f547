"""Edited documents: each fault is told by its place and its reason."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from sample_plan import sample_plan

from veduta.plan.load import load_document
from veduta.run.errors import InputError


def written(path: Path, *changes: tuple[list[str | int], Any]) -> Path:
    """The sample's document with values changed at places."""
    content = json.loads(sample_plan().model_dump_json(by_alias=True))
    for place, value in changes:
        target = content["storeys"][0]
        for step in place[:-1]:
            target = target[step]
        if value is KeyError:
            del target[place[-1]]
        else:
            target[place[-1]] = value
    file = path / "plan.json"
    file.write_text(json.dumps(content))
    return file


def test_a_sound_document_is_read_and_its_areas_made_anew(tmp_path: Path) -> None:
    document = load_document(written(tmp_path, (["rooms", 0, "area_m2"], 1.0)))
    assert document.storeys[0].rooms[0].area_m2 == pytest.approx(4.79 * 4.7, abs=1e-3)


def flight(**changes: Any) -> dict[str, Any]:
    """A flight of stairs as it stands in a file."""
    outline = [[1.0, 1.0], [2.0, 1.0], [2.0, 3.5], [1.0, 3.5]]
    good = {"id": "s1", "outline_m": outline, "treads": 10, "up": [0.0, 1.0], "score": 0.9}
    return good | changes


TWO_STEPS = [[[1, 1], [2, 1], [2, 2], [1, 2]], [[1, 2], [2, 2], [2, 3.5], [1, 3.5]]]


ROUND = [
    [1.5 + 0.5 * math.cos(turn), 2.5 + 0.5 * math.sin(turn)]
    for turn in (2.0 * math.pi * number / 65 for number in range(65))
]


def turning(**changes: Any) -> dict[str, Any]:
    """Stairs with their treads."""
    return flight(treads=2, steps_m=TWO_STEPS, path_m=[[1.5, 1.0], [1.5, 3.5]]) | changes


def lamp(**changes: Any) -> dict[str, Any]:
    """A lamp as it stands in a file."""
    good = {"id": "l1", "kind": "floor", "room": "living", "at_m": [1.0, 1.0], "lumen": 800.0}
    return good | {"above_m": 1.5} | changes


def test_stairs_with_their_treads_pass(tmp_path: Path) -> None:
    (one,) = load_document(written(tmp_path, (["stairs"], [turning()]))).storeys[0].stairs
    assert len(one.steps_m) == one.treads == 2


def test_a_good_flight_and_a_good_lamp_pass(tmp_path: Path) -> None:
    stairs = load_document(written(tmp_path, (["stairs"], [flight()]))).storeys[0].stairs
    assert [one.id for one in stairs] == ["s1"]
    lights = load_document(written(tmp_path, (["lights"], [lamp()]))).storeys[0].lights
    assert lights is not None
    assert [one.id for one in lights] == ["l1"]


@pytest.mark.parametrize(
    ("place", "value", "told"),
    [
        (["walls", 0, "start"], "nowhere", "storeys[0].walls[0].start: there is no 'nowhere'"),
        (["walls", 0, "thickness_m"], 0.0, "storeys[0].walls[0].thickness_m: 0 m"),
        (["walls", 0, "thickness_m"], "0.3", "storeys[0].walls[0].thickness_m: Input should be"),
        (["walls", 1, "id"], "south-1", "storeys[0].walls[1].id: 'south-1' is there twice"),
        (["walls", 1, "end"], "b", "storeys[0].walls[1]: its junctions lie on each other"),
        (["walls", 0, "bulge"], 3.0, "storeys[0].walls[0].bulge: 3, more than 1"),
        (["walls", 6, "party"], True, "storeys[0].walls[6].party: wall 'middle' is an inner one"),
        (["openings", 0, "wall"], "x", "storeys[0].openings[0].wall: there is no 'x'"),
        (["openings", 0, "width_m"], 9.0, "storeys[0].openings[0]: ends at 9.60 m"),
        (["openings", 2, "height_m"], 0.0, "storeys[0].openings[2].height_m: must be above zero"),
        (["openings", 0, "kind"], "window", "storeys[0].openings[0].type: 'swing' is none of a w"),
        (["openings", 0, "kind"], "hatch", "storeys[0].openings[0].kind: Input should be"),
        (["rooms", 0, "outline_m"], [[0, 0], [1, 1]], "storeys[0].rooms[0].outline_m: 2 points"),
        (
            ["rooms", 0, "outline_m"],
            [[0, 0], [1, 1], [1, 0], [0, 1]],
            "storeys[0].rooms[0].outline_m: its line crosses",
        ),
        (["rooms", 1, "openings"], ["gone"], "storeys[0].rooms[1].openings: there is no 'gone'"),
        (["junctions", 0, "at_m"], [1e9, 0.0], "storeys[0].junctions[0].at_m[0]: 1000000000.0 is"),
        (["junctions", 0, "at_m"], [-700.0, 0.0], "storeys[0]: is 708 m from end to end; 500 m"),
        (["height_m"], 1.0, "storeys[0].height_m: 1 m, less than 2"),
        (["scale"], KeyError, "storeys[0].scale: Field required"),
        (
            ["rooms", 0, "holes_m"],
            [[[-1.0, 2.0], [9.0, 2.0], [9.0, 2.5], [-1.0, 2.5]]],
            "storeys[0].rooms[0].holes_m: they cross",
        ),
        (["stairs"], [flight(treads=0)], "storeys[0].stairs[0].treads: Input should be"),
        (["stairs"], [flight(outline_m=[])], "storeys[0].stairs[0].outline_m: 0 points"),
        (
            ["stairs"],
            [flight(outline_m=[[1, 1], [1, 1], [1, 1]])],
            "storeys[0].stairs[0].outline_m: its line crosses itself, or encloses nothing",
        ),
        (["stairs"], [flight(up=[100.0, 0.0])], "storeys[0].stairs[0].up: is 100 long"),
        (["stairs"], [turning(treads=3)], "storeys[0].stairs[0].steps_m: 2 outlines, but 3 treads"),
        (["stairs"], [turning(path_m=[])], "storeys[0].stairs[0].path_m: 0 points"),
        (
            ["stairs"],
            [turning(path_m=[[1.5, 1.0], [1.5, 1.9]])],
            "storeys[0].stairs[0].path_m: does not lead over steps_m[1]",
        ),
        (
            ["stairs"],
            [turning(path_m=[[1.5, 1.0], [1.5, 1.0], [1.5, 3.5]])],
            "storeys[0].stairs[0].path_m: points 1 and 2 lie on each other",
        ),
        (
            ["stairs"],
            [turning(path_m=[[1.5, 1.0], [1.5, 3.5], [1.5, 3.5001]])],
            "storeys[0].stairs[0].path_m: points 2 and 3 lie on each other",
        ),
        (
            ["stairs"],
            [turning(steps_m=[TWO_STEPS[0], [[1, 2], [2, 3], [2, 2], [1, 3]]])],
            "storeys[0].stairs[0].steps_m[1]: its line crosses itself, or encloses nothing",
        ),
        (
            ["stairs"],
            [flight(path_m=[[1.0, 1.0], [1.0, 2.0]])],
            "storeys[0].stairs[0].path_m: there are no steps_m",
        ),
        (
            ["stairs"],
            [turning(steps_m=TWO_STEPS[::-1])],
            "storeys[0].stairs[0].path_m: comes to steps_m[1] before steps_m[0]",
        ),
        (
            ["stairs"],
            [turning(path_m=[[1.5, 0.2], [1.5, 3.5]])],
            "storeys[0].stairs[0].path_m: begins 0.80 m from the edge of steps_m[0]",
        ),
        (
            ["stairs"],
            [turning(path_m=[[1.5, 1.0], [1.5, 2.5]])],
            "storeys[0].stairs[0].path_m: ends 0.50 m from the edge of steps_m[1]",
        ),
        (
            ["stairs"],
            [turning(steps_m=[TWO_STEPS[0], [[1, 1.5], [2, 1.5], [2, 3.5], [1, 3.5]]])],
            "storeys[0].stairs[0].steps_m[1]: 0.50 m² of it lie on steps_m[0]",
        ),
        (
            ["stairs"],
            [turning(steps_m=[TWO_STEPS[0], ROUND])],
            "storeys[0].stairs[0].steps_m[1]: 65 points, not between 3 and 64",
        ),
        (["rooms", 0, "id"], "unnamed", "storeys[0].rooms[0].id: 'unnamed' is what is said of"),
        (["lights"], [lamp(above_m=50.0)], "storeys[0].lights[0].above_m: 50 m is not between"),
        (["colour"], "red", "storeys[0].colour: Extra inputs are not permitted"),
    ],
)
def test_the_field_and_the_reason_are_named(
    tmp_path: Path, place: list[str | int], value: Any, told: str
) -> None:
    with pytest.raises(InputError) as caught:
        load_document(written(tmp_path, (place, value)))
    assert told in caught.value.fault
    assert caught.value.subject.endswith("plan.json")


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (("a b", "a-b"), "storeys[1].name: 'a-b' is the name of another storey, too"),
        (("a", "a living"), "storeys[1].rooms[0].id: with its storey's name it is the same as"),
    ],
)
def test_names_that_are_one_in_the_model(tmp_path: Path, names: tuple[str, str], told: str) -> None:
    """Ids are made of them, blanks as dashes."""
    content = json.loads(sample_plan().model_dump_json(by_alias=True))
    (ground,) = content["storeys"]
    upper = json.loads(json.dumps(ground)) | {"elevation_m": 2.8, "name": names[1]}
    if names[1] == "a living":
        ground["rooms"][0]["id"], upper["rooms"][0]["id"] = "living x", "x"
        ground["lights"] = ground["furniture"] = upper["lights"] = upper["furniture"] = None
    content["storeys"] = [ground | {"name": names[0]}, upper]
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(content))
    with pytest.raises(InputError) as caught:
        load_document(file)
    assert told in caught.value.fault


def test_a_time_needs_a_place(tmp_path: Path) -> None:
    file = written(tmp_path)
    content = json.loads(file.read_text()) | {"time": "2026-06-21T12:00"}
    file.write_text(json.dumps(content))
    with pytest.raises(InputError, match="time: says where the sun stands only with a place_deg"):
        load_document(file)
    file.write_text(json.dumps(content | {"place_deg": [51.5, -0.1]}))
    assert load_document(file).time == "2026-06-21T12:00"


def test_no_storey_at_all(tmp_path: Path) -> None:
    file = tmp_path / "plan.json"
    file.write_text('{"storeys": []}')
    with pytest.raises(InputError, match="storeys: 0, not between 1 and 50"):
        load_document(file)


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ('{"storeys": [', "line 1, column 14: not JSON"),
        ('{"storeys": [' + "1" * 5000 + "]}", "is not usable JSON"),
    ],
)
def test_what_is_no_json_is_told(tmp_path: Path, content: str, told: str) -> None:
    file = tmp_path / "plan.json"
    file.write_text(content)
    with pytest.raises(InputError) as caught:
        load_document(file)
    assert told in caught.value.fault


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        load_document(tmp_path / "plan.json")
    with pytest.raises(InputError, match="is a folder"):
        load_document(tmp_path)
