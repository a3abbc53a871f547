"""`place.json`'s schema and the rule for merging two places."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from veduta.place.manifest import (
    IDENTITY,
    Bounds,
    Place,
    PlaceCamera,
    PlacePart,
    PlacePoints,
    Start,
    merge,
)
from veduta.run.errors import InputError

START = Start(eye=(0.0, -10.0, 1.7), target=(0.0, 0.0, 5.0))
BOUNDS = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))


def part(part_id: str, **changes: Any) -> PlacePart:
    fields = {
        "id": part_id,
        "name": part_id,
        "model": f"{part_id}/model.glb",
        "arrangement": "single",
        "bounds": BOUNDS,
    }
    return PlacePart.model_validate(fields | changes)


def place(*names: str, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Place:
    return Place(parts=[part(name) for name in names], origin=origin, start=START)


def test_the_union_keeps_order_ids_and_start() -> None:
    both = merge(place("a", "b"), place("c", "b"))
    assert [item.id for item in both.parts] == ["a", "b", "c"]
    assert both.start == START


def test_parts_move_into_the_first_origin() -> None:
    both = merge(place("a", origin=(100.0, 0.0, 0.0)), place("b", origin=(103.0, 4.0, 1.0)))
    assert both.origin == (100.0, 0.0, 0.0)
    assert both.parts[0].transform == IDENTITY
    assert both.parts[1].transform[12:15] == (3.0, 4.0, 1.0)


def test_files_of_the_second_are_found_below_its_folder() -> None:
    both = merge(place("a"), place("b"), "other")
    assert [item.model for item in both.parts] == ["a/model.glb", "other/b/model.glb"]


def test_one_id_for_two_things_is_refused() -> None:
    other = Place(parts=[part("a", name="another")], start=START)
    with pytest.raises(InputError, match="'a'"):
        merge(place("a"), other)


def test_two_coordinate_systems_are_refused() -> None:
    other = place("b").model_copy(update={"crs": "EPSG:28992"})
    with pytest.raises(InputError, match="EPSG:28992"):
        merge(place("a"), other)


names = st.lists(st.sampled_from("abcdef"), max_size=6, unique=True)
origins = st.tuples(*[st.integers(-50, 50).map(float)] * 3)
places = st.builds(lambda chosen, origin: place(*chosen, origin=origin), names, origins)


@given(one=places)
def test_merging_a_place_with_itself_changes_nothing(one: Place) -> None:
    assert merge(one, one) == one


@given(chosen=st.permutations("abcdef"), cuts=st.tuples(st.integers(0, 6), st.integers(0, 6)))
def test_merging_is_associative(chosen: list[str], cuts: tuple[int, int]) -> None:
    low, high = sorted(cuts)
    first = place(*chosen[:low], origin=(1.0, 0.0, 0.0))
    second = place(*chosen[low:high], origin=(0.0, 5.0, 0.0))
    third = place(*chosen[high:])
    assert merge(merge(first, second), third) == merge(first, merge(second, third))


@pytest.mark.parametrize("path", ["../x.glb", "/etc/passwd", "a/../../x", "C:/x", "a\\b", ""])
def test_files_outside_of_the_folder_are_refused(path: str) -> None:
    with pytest.raises(ValidationError):
        part("a", model=path)


@pytest.mark.parametrize(
    "changes",
    [
        {"transform": (0.0,) * 16},
        {"transform": IDENTITY[:15]},
        {"transform": (*IDENTITY[:12], float("nan"), 0.0, 0.0, 1.0)},
        {"transform": (*IDENTITY[:3], 1.0, *IDENTITY[4:])},
        {"colour": "red"},
        {"id": ""},
    ],
)
def test_broken_parts_are_refused(changes: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        part("a", **changes)


def test_two_parts_of_one_id_are_refused() -> None:
    with pytest.raises(ValidationError, match="two parts"):
        place("a", "a")


def seen(camera_id: str, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Place:
    camera = PlaceCamera(
        id=camera_id,
        name=f"{camera_id}.jpg",
        picture=f"pictures/{camera_id}.jpg",
        width_px=60,
        height_px=40,
        focal_px=(50.0, 50.0),
        centre_px=(30.0, 20.0),
        transform=IDENTITY,
    )
    points = PlacePoints(id=f"points-{camera_id}", file="points.ply", count=5, bounds=BOUNDS)
    return Place(parts=[], points=[points], cameras=[camera], origin=origin, start=START)


def test_points_and_cameras_move_with_their_files() -> None:
    both = merge(seen("a"), seen("b", origin=(3.0, 4.0, 1.0)), "other")
    assert [camera.id for camera in both.cameras] == ["a", "b"]
    assert both.cameras[1].transform[12:15] == (3.0, 4.0, 1.0)
    assert both.cameras[1].picture == "other/pictures/b.jpg"
    assert [cloud.file for cloud in both.points] == ["points.ply", "other/points.ply"]
    assert both.points[1].transform[12:15] == (3.0, 4.0, 1.0)


def test_a_place_of_unknown_scale_joins_no_other() -> None:
    small = seen("a").model_copy(update={"scale": "unknown"})
    for first, second in ((small, seen("b")), (seen("b"), small)):
        with pytest.raises(InputError, match="scale"):
            merge(first, second)


def test_two_cameras_of_one_id_are_refused() -> None:
    camera = seen("a").cameras[0]
    with pytest.raises(ValidationError, match="two cameras"):
        Place(parts=[], cameras=[camera, camera], start=START)


def moved(x_m: float) -> tuple[float, ...]:
    return (*IDENTITY[:12], x_m, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("transform", "words"),
    [
        ((0.0,) * 16, "no placement in space"),
        ((*(0.0,) * 15, 1.0), "no placement in space"),
        (moved(1e9), "more than 10,000,000 m away"),
    ],
)
def test_what_stands_nowhere_is_refused(transform: tuple[float, ...], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        part("wall", transform=transform)
    with pytest.raises(ValidationError, match=words):
        PlacePoints(id="all", file="points.ply", count=1, bounds=BOUNDS, transform=transform)


def test_a_projected_coordinate_is_not_too_far() -> None:
    assert part("wall", transform=moved(9.9e6)).transform[12] == 9.9e6
