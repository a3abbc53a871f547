"""`house.city.json`: closed and valid by an oracle of its own; rooms by closed forms; read back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from city_oracle import faults, loaded, mesh_of, points_of, solids_of
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_plan import HEIGHT_M, opening, rectangle, room, sample_plan, sample_storey
from shapely.geometry import Polygon, box

from veduta.formats.cityjson_read import read_cityjson
from veduta.formats.cityjson_solids import CityDocument, CityFace
from veduta.plan.document import Furniture, PlanDocument, Stairs
from veduta.plan.house.build import build_house
from veduta.plan.house.floors import FINISH_M
from veduta.plan.lights.lighting import light_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.cityjson import house_cityjson
from veduta.synthetic.plans.house import StairsKind
from veduta.synthetic.plans.stairs import StairPlan, stairs_in

SLAB_M, LIVING_M2 = 0.25, 4.79 * 4.7
CLEAR_M = HEIGHT_M - SLAB_M - 2 * FINISH_M


def flight() -> Stairs:
    """Along the northern wall of the living room."""
    outline = rectangle(1.0, 3.85, 4.5, 4.85)
    return Stairs(id="s1", outline_m=outline, treads=14, up=(1.0, 0.0), score=0.9)


def city_of(document: PlanDocument, **options: Any) -> dict[str, Any]:
    made = HouseOptions(slab=SLAB_M, **options)
    content, notes = house_cityjson(build_house(document, made), made)
    assert notes == []
    return loaded(content)


def two_storeys() -> PlanDocument:
    sofa = Furniture(
        id="f1", object="sofa-slim", room="living", at_m=(2.0, 1.5), size_m=(2.1, 0.9, 0.8)
    )
    other = sofa.model_copy(update={"id": "f2", "at_m": (2.0, 3.0), "turn_rad": np.pi / 2})
    ground = sample_storey(stairs=[flight()], furniture=[sofa, other])
    first = sample_storey(name="first floor", elevation_m=HEIGHT_M, furniture=[])
    return light_house(sample_plan(ground, first), HouseOptions()).document


@pytest.fixture(scope="module")
def city() -> dict[str, Any]:
    return city_of(two_storeys())


def shell_of(city: dict[str, Any], name: str) -> list[list[list[int]]]:
    (shell,) = solids_of(city["CityObjects"][name]["geometry"][0])
    return shell


def kinds_of(city: dict[str, Any], name: str) -> list[str]:
    semantics = city["CityObjects"][name]["geometry"][0]["semantics"]
    return [semantics["surfaces"][value]["type"] for value in semantics["values"][0]]


def test_every_solid_is_valid_and_looks_outwards(city: dict[str, Any]) -> None:
    points = points_of(city)
    count = 0
    for name, item in city["CityObjects"].items():
        for geometry in item.get("geometry", ()):
            assert geometry["type"] != "MultiSurface", name
            for shell in solids_of(geometry):
                assert faults(shell, points) == [], name
                assert mesh_of(shell, points).volume > 0.0, name
                count += 1
    assert count == 1 + 4 + 1 + 1 + 2  # the shell, rooms, a flight, its rail, rails of the well


def test_objects_are_a_tree_of_storeys_and_rooms(city: dict[str, Any]) -> None:
    objects = city["CityObjects"]
    assert objects["house"]["children"] == ["house/ground-floor", "house/first-floor"]
    living = objects["house/ground-floor/living"]
    assert (living["type"], living["parents"]) == ("BuildingRoom", ["house/ground-floor"])
    assert living["attributes"]["name"] == "Living"
    assert living["attributes"]["function"] == "living"
    types = [objects[name]["type"] for name in living["children"]]
    assert types.count("BuildingFurniture") == 2
    assert "BuildingInstallation" in types
    assert objects["house/ground-floor-stairs-s1"]["parents"] == ["house/ground-floor/living"]


def test_rooms_are_the_air_within_walls(city: dict[str, Any]) -> None:
    """Floor by height, with the halves of the openings up to their panels."""
    points = points_of(city)
    half_wall, half_inner, panel = 0.15, 0.06, 0.035
    niches = (half_wall - panel) * (1.0 * (2.05 - FINISH_M) + 1.8 * 1.25)
    niches += (half_inner - panel) * 0.9 * (2.05 - FINISH_M)
    volume = mesh_of(shell_of(city, "house/ground-floor/living"), points).volume
    stairwell = volume - (LIVING_M2 * CLEAR_M + niches)
    assert 0.0 < stairwell < 3.5 * 1.0 * FINISH_M + 1e-3  # no coat of the ceiling over the flight
    bath = mesh_of(shell_of(city, "house/ground-floor/bath"), points)
    niches = (half_inner - panel) * 0.9 * (2.05 - FINISH_M) + (half_wall - panel) * 1.2 * 1.25
    assert bath.volume == pytest.approx(2.79 * 4.7 * CLEAR_M + niches, rel=1e-3)


def test_surfaces_are_named_as_cityjson_has_them(city: dict[str, Any]) -> None:
    assert set(kinds_of(city, "house")) == {
        "WallSurface", "RoofSurface", "GroundSurface", "Window", "Door",
        "OuterCeilingSurface", "OuterFloorSurface",
    }  # fmt: skip
    living = kinds_of(city, "house/ground-floor/living")
    assert living.count("ClosureSurface") == 1  # where the stairs go up
    assert living.count("Door") == 2
    assert {"InteriorWallSurface", "FloorSurface", "CeilingSurface", "Window"} < set(living)
    assert "ClosureSurface" not in kinds_of(city, "house/ground-floor/bath")
    surfaces = city["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"]
    window = next(one for one in surfaces if one["name"] == "ground floor window w1")
    wall = surfaces[window["parent"]]
    # South-1 and south-2 are one face of the house.
    assert wall["name"] in {f"ground floor wall south-{number} outside" for number in (1, 2)}
    assert surfaces.index(window) in wall["children"]
    assert wall["provenance"] == "inferred"
    roofs = [one for one in surfaces if one["type"] == "RoofSurface" and "roof" in one["name"]]
    assert {one["provenance"] for one in roofs} == {"invented"}


def turning(kind: StairsKind, *, grown_m: float = 0.0) -> PlanDocument:
    """Two storeys with stairs that turn in the middle of the living room."""
    drawn = stairs_in(box(1.0, 1.0, 2.96, 4.2), StairPlan(kind, False, 0.95, 0.27, 4, 5))
    rings = [Polygon(ring).buffer(grown_m, join_style="mitre") for ring in drawn.steps_m]
    stairs = Stairs(
        id="s1", outline_m=list(drawn.outline_m), treads=drawn.treads, up=drawn.up, score=0.9,
        steps_m=[list(ring.exterior.coords)[:-1] for ring in rings], path_m=list(drawn.path_m),
    )  # fmt: skip
    upper = sample_storey(name="first floor", elevation_m=HEIGHT_M)
    return sample_plan(sample_storey(stairs=[stairs]), upper)


@pytest.mark.parametrize("kind", ["half-winding", "spiral"])
def test_stairs_that_turn_and_their_rails_are_valid_solids(kind: StairsKind) -> None:
    city = city_of(turning(kind), roof="none")
    points = points_of(city)
    told: dict[str, set[str]] = {}
    most = 0
    for name, item in city["CityObjects"].items():
        if item["type"] != "BuildingInstallation":
            continue
        (shape,) = item["geometry"]
        shells = list(solids_of(shape))
        assert shells, name
        assert [fault for shell in shells for fault in faults(shell, points)] == [], name
        said = told.setdefault(item["attributes"]["class"], set())
        said |= {one["provenance"] for one in shape["semantics"]["surfaces"]}
        most = max(most, len(shells))
    assert most > 1 or kind == "spiral"  # a rail is not one body
    column = {"column": {"invented"}} if kind == "spiral" else {}
    assert told == column | {"stairs": {"inferred"}, "rail": {"invented"}}


def test_stairs_that_close_no_solid_are_told() -> None:
    """Treads that cover each other: such a document is refused, but none is written in silence."""
    made = HouseOptions(roof="none")
    _, notes = house_cityjson(build_house(turning("half-winding", grown_m=0.05), made), made)
    assert any("stairs-s1 is no closed solid" in note for note in notes)


def test_a_room_without_air_is_told() -> None:
    storey = sample_storey()
    low = room("slot", rectangle(8.2, 1.0, 8.3, 2.0))
    made = HouseOptions(roof="none")
    document = sample_plan(sample_storey(rooms=[*storey.rooms, low]))
    content, notes = house_cityjson(build_house(document, made), made)
    assert "house/ground-floor/slot" not in loaded(content)["CityObjects"]
    assert len(notes) == 1
    assert notes[0].startswith("ground floor slot has no")


def test_a_gap_is_closed_by_one_surface_for_both_rooms() -> None:
    gap = opening("g", "middle", 1.0, 0.9, kind="gap", type="plain")
    city = city_of(sample_plan(sample_storey(openings=[gap])))
    points = points_of(city)
    found = []
    for name in ("living", "bath"):
        shell = shell_of(city, f"house/ground-floor/{name}")
        kinds = kinds_of(city, f"house/ground-floor/{name}")
        (face,) = [
            face for face, kind in zip(shell, kinds, strict=True) if kind == "ClosureSurface"
        ]
        found.append({tuple(points[vertex].round(3)) for vertex in face[0]})
    assert found[0] == found[1]
    assert {corner[0] for corner in found[0]} == {5.0}  # the middle of the wall


def test_the_shell_is_that_of_the_model(city: dict[str, Any]) -> None:
    points = points_of(city)
    assert city["CityObjects"]["house"]["attributes"]["roofType"] == "hip"  # asked for: "auto"
    mesh = mesh_of(shell_of(city, "house"), points)
    assert mesh.bounds[0] == pytest.approx([-0.6, -0.6, -0.2], abs=2e-3)  # eaves, ground slab
    assert mesh.bounds[1][:2] == pytest.approx([8.6, 5.6], abs=2e-3)
    middle = [[2.5, 2.5, 1.2], [2.5, 2.5, 4.0], [2.5, 2.5, 6.0], [8.4, 2.5, 5.0]]
    assert mesh.contains(middle).tolist() == [True, True, True, False]  # rooms, attic, eaves


def test_furniture_is_one_shape_in_two_places(city: dict[str, Any]) -> None:
    sofas = [
        item["geometry"][0]
        for item in city["CityObjects"].values()
        if item["type"] == "BuildingFurniture"
    ]
    assert len({one["template"] for one in sofas}) == 1
    shape = city["geometry-templates"]["templates"][sofas[0]["template"]]
    corners = np.unique(np.concatenate([ring for face in shape["boundaries"] for ring in face]))
    local = np.array(city["geometry-templates"]["vertices-templates"])[corners]
    for one, size in zip(sofas, [(2.1, 0.9), (0.9, 2.1)], strict=True):
        turn = np.array(one["transformationMatrix"]).reshape(4, 4)[:3, :3]
        placed = local @ turn.T + points_of(city)[one["boundaries"][0]]
        assert np.ptp(placed, axis=0)[:2] == pytest.approx(size, abs=0.05)
        assert placed[:, 2].min() == pytest.approx(FINISH_M, abs=2e-3)


def test_it_is_read_back(city: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "house.city.json"
    path.write_text(json.dumps(city))
    (building,) = read_cityjson(path).buildings
    assert building.solid
    assert len(building.polygons) == len(shell_of(city, "house"))


@pytest.mark.parametrize("roof", ["none", "flat", "gable", "mansard"])
def test_every_roof_gives_a_closed_shell(roof: str) -> None:
    city = city_of(sample_plan(), roof=roof)
    assert faults(shell_of(city, "house"), points_of(city)) == []
    assert city["CityObjects"]["house"]["attributes"]["roofType"] == roof


@settings(max_examples=6, deadline=None)
@given(
    turn=st.floats(0.0, 1.5),
    along=st.floats(0.1, 3.0),
    width=st.floats(0.6, 1.6),
    kind=st.sampled_from(["door", "window", "gap"]),
)
def test_turned_houses_are_closed(turn: float, along: float, width: float, kind: str) -> None:
    """Walls that are not along an axis have corners that no grid has."""
    storey = sample_storey(openings=[opening("o", "west", along, width, kind=kind)])
    cos, sin = np.cos(turn), np.sin(turn)

    def turned(point: tuple[float, float]) -> tuple[float, float]:
        return cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]

    junctions = [one.model_copy(update={"at_m": turned(one.at_m)}) for one in storey.junctions]
    rooms = [
        one.model_copy(update={"outline_m": [turned(point) for point in one.outline_m]})
        for one in storey.rooms
    ]
    made = storey.model_copy(update={"junctions": junctions, "rooms": rooms})
    city = city_of(sample_plan(made))
    for name in ("house", "house/ground-floor/living", "house/ground-floor/bath"):
        assert faults(shell_of(city, name), points_of(city)) == [], name


def box_faces(low: list[float], high: list[float]) -> list[CityFace]:
    """The six faces of a box, counter-clockwise seen from outside."""
    (x, y, z), (u, v, w) = low, high
    sides = [
        [(x, y, z), (x, v, z), (u, v, z), (u, y, z)], [(x, y, w), (u, y, w), (u, v, w), (x, v, w)],
        [(x, y, z), (u, y, z), (u, y, w), (x, y, w)], [(x, v, z), (x, v, w), (u, v, w), (u, v, z)],
        [(x, y, z), (x, y, w), (x, v, w), (x, v, z)], [(u, y, z), (u, v, z), (u, v, w), (u, y, w)],
    ]  # fmt: skip
    return [CityFace([np.array(ring)], "wall") for ring in sides]


def test_what_is_open_is_no_solid_and_two_bodies_are_many() -> None:
    document = CityDocument("t", np.zeros(3))
    first, second = box_faces([0, 0, 0], [1, 1, 1]), box_faces([2, 0, 0], [3, 1, 1])
    told = {"wall": {"type": "WallSurface"}}
    assert document.solid([first], told)["type"] == "Solid"
    both = document.solid([first, second], told)
    assert (both["type"], len(both["boundaries"])) == ("MultiSolid", 2)
    assert document.solid([first[:-1]], told)["type"] == "MultiSurface"
    touching = box_faces([1, 1, 0], [2, 2, 1])  # the two have an edge in common
    assert document.solid([[*first, *touching]], told)["type"] == "MultiSurface"


def test_outdoor_rooms_are_floors_of_the_shell() -> None:
    terrace = room("t", rectangle(0.5, -3.0, 4.0, -0.15), use="terrace", outdoors=True)
    storey = sample_storey()
    city = city_of(sample_plan(sample_storey(rooms=[*storey.rooms, terrace])))
    assert "house/ground-floor/t" not in city["CityObjects"]
    surfaces = city["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"]
    names = [one.get("name") for one in surfaces if one["type"] == "OuterFloorSurface"]
    assert "ground floor t floor" in names
