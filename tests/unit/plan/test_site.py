"""North, place and time of a house: what is given, kept and assumed, and where it is written."""

from __future__ import annotations

import json
import math
import struct
from xml.etree import ElementTree

import ifcopenshell
import ifcopenshell.validate
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from sample_plan import sample_plan
from scipy.spatial.transform import Rotation
from x3d_classes import typed_scene

from veduta.formats.gltf import glb_bytes
from veduta.place.manifest import Tour
from veduta.place.sunlight import Sunlight
from veduta.plan.document import PlanDocument
from veduta.plan.house.build import House, build_house
from veduta.plan.house.placing import place_of, visitor_start
from veduta.plan.options import HouseOptions, SiteOptions
from veduta.plan.outputs.ifc import compound_angle, house_ifc
from veduta.plan.outputs.x3d import house_x3d
from veduta.plan.surroundings.daylight import sunlight_of
from veduta.plan.surroundings.site import check_site, site_of, with_site
from veduta.plan.surroundings.turning import turned_north
from veduta.run.errors import InputError

OPTIONS = HouseOptions()
SYDNEY = (-33.8568, 151.2153)


@pytest.fixture(scope="module")
def house() -> House:
    return build_house(sample_plan(), OPTIONS)


def sited(**options: object) -> PlanDocument:
    return with_site(sample_plan(), SiteOptions(**options))


def test_nothing_is_known_of_a_plan() -> None:
    site = site_of(sample_plan())
    assert site.assumed == ("north", "place", "time")
    assert site.for_place().model_dump() == {
        "latitude_deg": None, "longitude_deg": None, "time": None,
        "assumed": ["north", "place", "time"],
    }  # fmt: skip
    # The studio's usual light: from the left, from before the house, and from above.
    assert site.toward_sun == pytest.approx((-0.622, -0.536, 0.571), abs=2e-3)
    assert "assumed" in dict(site.facts())["north"]


def test_what_is_given_is_kept_in_the_document_and_goes_before_it() -> None:
    first = sited(north=-30.0, place=SYDNEY, time="2026-12-21T09:00")
    assert (first.north_deg, first.place_deg) == (330.0, SYDNEY)
    text = first.model_dump_json(by_alias=True)
    again = with_site(PlanDocument.model_validate_json(text), SiteOptions(north=12.0))
    assert (again.north_deg, again.place_deg, again.time) == (12.0, SYDNEY, "2026-12-21T09:00")
    site = site_of(again)
    assert site.time == "2026-12-21T09:00:00+10:00"
    assert site.assumed == ()
    # A summer's morning in Sydney: from the east, high.
    assert 60.0 < site.sun.azimuth_deg < 110.0
    assert 40.0 < site.sun.elevation_deg < 60.0


def test_a_place_without_a_time_has_an_afternoon() -> None:
    site = site_of(sited(place=SYDNEY))
    assert site.assumed == ("north", "time")
    assert site.sun.is_up
    # South of the equator the sun goes through the north.
    assert not 90.0 < site.sun.azimuth_deg < 270.0


@pytest.mark.parametrize(
    "given", [{"place": (91.0, 0.0)}, {"place": (0.0, 181.0)}, {"time": "noon"}, {"north": 400.0}]
)
def test_faulty_options_are_refused(given: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        SiteOptions(**given)


@pytest.mark.parametrize(
    "field", [{"north_deg": 361.0}, {"place_deg": (95.0, 0.0)}, {"time": "soon"}, {"panorama": "x"}]
)
def test_faulty_fields_are_refused(field: dict[str, object]) -> None:
    content = json.loads(sample_plan().model_dump_json(by_alias=True)) | field
    with pytest.raises(ValidationError):
        PlanDocument.model_validate_json(json.dumps(content))


def test_a_time_asks_for_a_place() -> None:
    with pytest.raises(InputError, match=r"--time: .* Give --place"):
        check_site(sample_plan(), SiteOptions(time="2026-12-21T09:00"))
    check_site(sited(place=SYDNEY), SiteOptions(time="2026-12-21T09:00"))


@pytest.mark.parametrize("north_deg", [0.0, 30.0, 200.0])
def test_north_comes_to_y_in_the_place(house: House, north_deg: float) -> None:
    tour = Tour(
        id="tour", name="All", times_s=[0.0, 1.0], eyes=[(1.0, 2.0, 1.7), (2.0, 2.0, 1.7)],
        directions=[(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)],
    )  # fmt: skip
    place = place_of(house, "house.glb", None, OPTIONS, [tour])
    turned = turned_north(place, north_deg)
    angle = math.radians(north_deg)
    north = np.array([math.sin(angle), math.cos(angle), 0.0, 0.0])
    world_from_part = turned.parts["house"].standing.transform
    assert world_from_part @ north == pytest.approx([0.0, 1.0, 0.0, 0.0], abs=1e-12)
    part = place.parts["house"].standing.transform
    assert place.start is not None
    assert turned.start is not None
    moved = world_from_part @ np.linalg.inv(part) @ [*place.start.eye, 1.0]
    assert moved[:3] == pytest.approx(turned.start.eye)
    step = np.array(turned.tours[0].eyes[1]) - turned.tours[0].eyes[0]
    assert step == pytest.approx(turned.tours[0].directions[0])


@given(st.floats(-180.0, 180.0))
def test_compound_angles_add_up(angle: float) -> None:
    degrees, minutes, seconds, millionths = compound_angle(angle)
    parts = np.array([degrees, minutes, seconds, millionths])
    assert (parts >= 0).all() or (parts <= 0).all()
    assert np.abs(parts[1:3]).max() < 60
    total = degrees + minutes / 60 + (seconds + millionths / 1e6) / 3600
    assert total == pytest.approx(angle, abs=1e-9)


def test_ifc_says_north_and_place(house: House) -> None:
    site = site_of(sited(north=30.0, place=SYDNEY))
    model = ifcopenshell.file.from_string(house_ifc(house, OPTIONS, site).decode())
    logger = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(model, logger)
    assert logger.statements == []
    context = model.by_type("IfcGeometricRepresentationContext", include_subtypes=False)[0]
    assert context.TrueNorth.DirectionRatios == pytest.approx((0.5, math.sqrt(0.75)))
    ground = model.by_type("IfcSite")[0]
    assert ground.RefLatitude == (-33, -51, -24, -480000)
    assert ground.RefLongitude == (151, 12, 55, 80000)
    unknown = ifcopenshell.file.from_string(house_ifc(house, OPTIONS).decode())
    assert unknown.by_type("IfcSite")[0].RefLatitude is None
    assert unknown.by_type("IfcGeometricRepresentationContext")[0].TrueNorth is None


def root_of(content: bytes) -> dict:
    (size,) = struct.unpack_from("<I", content, 12)
    return json.loads(content[20 : 20 + size])


@pytest.mark.parametrize("toward", [(0.6, 0.0, 0.8), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)])
def test_gltf_light_shines_from_the_sun(house: House, toward: tuple[float, float, float]) -> None:
    root = root_of(glb_bytes(house.part, sun=Sunlight(toward, (1.0, 1.0, 1.0), 0.5)))
    node = next(node for node in root["nodes"] if node["name"] == "sun")
    light = root["extensions"]["KHR_lights_punctual"]["lights"][-1]
    assert light["type"] == "directional"
    assert node["extensions"]["KHR_lights_punctual"]["light"] == (
        len(root["extensions"]["KHR_lights_punctual"]["lights"]) - 1
    )
    shines = Rotation.from_quat(node["rotation"]).apply([0.0, 0.0, -1.0])
    x, y, z = toward
    assert shines == pytest.approx([-x, -z, y], abs=1e-6)
    assert root["extensionsUsed"].count("KHR_lights_punctual") == 1


@pytest.mark.parametrize(
    ("time", "is_day"), [("2026-12-21T09:00", True), ("2026-12-21T23:00", False)]
)
def test_x3d_light_shines_from_the_sun_or_the_moon(house: House, time: str, is_day: bool) -> None:
    site = site_of(sited(north=90.0, place=SYDNEY, time=time))
    start = visitor_start(house)
    content = house_x3d(house, OPTIONS, start, site=site, backdrop=house.part)
    made = typed_scene(content)
    assert made["Collision"] == 1
    nodes = {node.get("DEF"): node for node in ElementTree.fromstring(content).iter()}
    around = next(node for node in nodes.values() if node.tag == "Collision")
    assert around.get("enabled") == "false"
    x, y, z = sunlight_of(site).toward
    way = [float(value) for value in nodes["sun"].get("direction").split()]
    assert way == pytest.approx([-x, -z, y], abs=1e-3)
    assert z > 0.0
    zenith = float(nodes["sky"].get("skyColor").split()[2])
    assert (zenith > 0.5) == is_day
    # North is to the right of the page: by day the sun, in the east, is below.
    assert (y < -0.3) == is_day or not is_day
