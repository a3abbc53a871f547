"""`house.x3d` through the typed classes of X3D's own package, and what its routes connect."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from sample_plan import sample_plan, sample_storey
from scipy.spatial.transform import Rotation
from x3d_classes import X3DTypeError, typed_scene

from veduta.formats.x3d import look_from, place_of
from veduta.place.manifest import Tour
from veduta.plan.house.build import House, build_house
from veduta.plan.house.placing import visitor_start
from veduta.plan.house.space import pieces_of
from veduta.plan.lights.lighting import light_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.x3d import View, house_x3d, room_of_polygons

OPTIONS = HouseOptions()


@pytest.fixture(scope="module")
def house() -> House:
    upper = sample_storey(name="upper floor", elevation_m=2.8)
    return build_house(light_house(sample_plan(sample_storey(), upper), OPTIONS).document, OPTIONS)


@pytest.fixture(scope="module")
def content(house: House) -> bytes:
    start = visitor_start(house)
    view = View("Stop <1> & more", (1.0, 2.0, 1.7), (3.0, 2.0, 1.7))
    return house_x3d(house, OPTIONS, start, [view])


def test_it_passes_the_typed_classes(content: bytes) -> None:
    """Each node is made by its class, which refuses fields and values that X3D does not have."""
    made = typed_scene(content)
    assert made["Viewpoint"] == 6  # the entrance, one that was asked for, four rooms
    assert made["PointLight"] == 8
    assert made["TouchSensor"] == 4
    assert made["ProximitySensor"] == 4 + 4  # rooms and doors
    assert made["OrientationChaser"] == 4
    assert made["Background"] == made["NavigationInfo"] == 1


def test_typed_classes_refuse_what_is_wrong(content: bytes) -> None:
    broken = content.replace(b'headlight="false"', b'headlight="perhaps"')
    with pytest.raises(X3DTypeError):
        typed_scene(broken)
    with pytest.raises(AttributeError):
        typed_scene(content.replace(b"<Background", b"<Foreground"))


def test_a_tour_is_a_viewpoint_that_walks(house: House) -> None:
    times = [0.0, 0.1, 0.2, 5.0, 10.0]
    eyes = [(0.0, -5.0 + time, 1.7) for time in times]
    ways = [(0.0, 1.0, 0.0)] * 3 + [(1.0, 0.0, 0.0)] * 2
    tour = Tour(id="tour", name="All rooms", times_s=times, eyes=eyes, directions=ways)
    start = visitor_start(house)
    content = house_x3d(house, OPTIONS, start, tours=[tour])
    typed_scene(content)
    root = ElementTree.fromstring(content)
    nodes = {node.get("DEF"): node for node in root.iter()}
    key = [float(value) for value in nodes["tour-tour-position"].get("key", "").split()]
    assert key == [0.0, 0.5, 1.0]
    values = np.array(nodes["tour-tour-position"].get("keyValue", "").split(), dtype=float)
    assert values.reshape(-1, 3)[1] == pytest.approx(place_of(eyes[3]))
    last = np.array(nodes["tour-tour-orientation"].get("keyValue", "").split(), dtype=float)[-4:]
    seen = Rotation.from_rotvec(last[3] * last[:3]).apply([0.0, 0.0, -1.0])
    assert seen == pytest.approx([1.0, 0.0, 0.0], abs=1e-3)


def test_routes_lead_from_nodes_to_nodes(content: bytes) -> None:
    root = ElementTree.fromstring(content)
    names = [node.get("DEF") for node in root.iter() if node.get("DEF")]
    assert len(names) == len(set(names))
    routes = list(root.iter("ROUTE"))
    assert {route.get(end) for route in routes for end in ("fromNode", "toNode")} <= set(names)
    used = {node.get("USE") for node in root.iter() if node.get("USE")}
    assert used <= set(names)
    ends = {(route.get("toNode"), route.get("toField")) for route in routes}
    lights = [node.get("DEF") for node in root.iter("PointLight")]
    assert all((name, "set_on") in ends for name in lights)
    leaves = [node.get("DEF") for node in root.iter("Transform") if "leaf" in node.get("DEF", "")]
    assert len(leaves) == 4
    assert all((name, "set_rotation") in ends for name in leaves)


def test_a_lamp_lights_the_room_that_it_hangs_in(house: House, content: bytes) -> None:
    """X3D's lights shine through walls: each lies in the group of its room, and is not global."""
    root = ElementTree.fromstring(content)
    for name, count in (("ground-floor-living", 2), ("upper-floor-bath", 2)):
        group = next(node for node in root.iter("Group") if node.get("DEF") == name)
        lights = list(group.iter("PointLight"))
        assert [light.get("global") for light in lights] == count * ["false"]
        assert {light.get("on") for light in lights} == {"false"}


def test_surfaces_are_of_the_room_that_sees_them(house: House) -> None:
    part = house.part
    seen = room_of_polygons(part, house.spaces, {"ground floor": 2.55, "upper floor": 2.55})
    checked = 0
    for row, feature in enumerate(part.polygon_feature.tolist()):
        name = part.features.name[feature]
        up = part.triangles.polygon_normal[row][2]
        if name.endswith(" in living") or (name.endswith("living floor") and up > 0.5):
            space, room, _ = seen.rooms[seen.number[row]]
            assert room.id == "living"
            assert name.startswith(space.storey.name)
            checked += 1
        if name.endswith(" outside") and abs(up) < 0.5:
            assert seen.number[row] == -1
    assert checked >= 10


def test_door_opens_to_where_the_model_has_it_open(house: House, content: bytes) -> None:
    """The corners of an open leaf: turned by X3D's rotation, and by the mover's in our axes."""
    root = ElementTree.fromstring(content)
    goals = {node.get("DEF"): node for node in root.iter("OrientationInterpolator")}
    mover = next(one for one in house.part.movers if one.name == "front leaf")
    goal = next(node for name, node in goals.items() if name and "front-leaf" in name)
    axis_angle = np.array([float(value) for value in goal.get("keyValue", "").split()[:4]])
    ours = Rotation.from_rotvec(mover.turn_rad * np.array(mover.axis))
    theirs = Rotation.from_rotvec(axis_angle[3] * axis_angle[:3])
    way = np.array([0.3, 0.8, 0.1])
    assert theirs.apply(place_of(way)) == pytest.approx(place_of(ours.apply(way)), abs=1e-3)


@pytest.mark.parametrize("target", [(5.0, 2.0, 1.0), (-3.0, 4.0, 3.0), (0.0, -9.0, 1.6)])
def test_viewpoints_look_at_their_target_upright(target: tuple[float, float, float]) -> None:
    eye = (0.5, 1.0, 1.6)
    turn = look_from(eye, target)
    seen = Rotation.from_rotvec(turn[3] * turn[:3])
    way = place_of(np.array(target) - np.array(eye))
    assert seen.apply([0.0, 0.0, -1.0]) == pytest.approx(way / np.linalg.norm(way))
    assert seen.apply([1.0, 0.0, 0.0])[1] == pytest.approx(0.0, abs=1e-12)
    assert math.isfinite(turn.sum())


def test_the_same_house_gives_the_same_file(house: House, content: bytes) -> None:
    start = visitor_start(house)
    view = View("Stop <1> & more", (1.0, 2.0, 1.7), (3.0, 2.0, 1.7))
    assert house_x3d(house, OPTIONS, start, [view]) == content


def test_a_room_in_two_pieces_has_its_lamps_once() -> None:
    """A wall that parts the floor of a room of the document, which stays one room."""
    storey = sample_storey()
    junctions = [*storey.junctions]
    junctions += [
        junctions[0].model_copy(update={"id": "p", "at_m": (2.2, 0.0)}),
        junctions[0].model_copy(update={"id": "q", "at_m": (2.2, 5.0)}),
    ]
    walls = [
        *storey.walls,
        storey.walls[-1].model_copy(update={"id": "x", "start": "p", "end": "q"}),
    ]
    parted = sample_storey(junctions=junctions, walls=walls)
    house = build_house(light_house(sample_plan(parted), OPTIONS).document, OPTIONS)
    start = visitor_start(house)
    root = ElementTree.fromstring(house_x3d(house, OPTIONS, start))
    lights = [node.get("DEF") for node in root.iter("PointLight")]
    assert len(lights) == len(house.part.lamps)
    groups = [node.get("DEF") for node in root.iter("Group")]
    assert groups.count("ground-floor-living") == 1
    (pieces,) = [region for room, region in house.spaces[0].floors if room and room.id == "living"]
    assert len(pieces_of(pieces)) == 2
