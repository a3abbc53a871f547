"""The panorama: which pixel is seen in which direction, what is invented, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from sample_plan import sample_plan, sample_storey

from veduta.formats.gltf import read_glb, write_glb
from veduta.place.part import Part
from veduta.place.place import Place
from veduta.place.semantics import Provenance
from veduta.plan.house.space import space_of
from veduta.plan.surroundings import panorama
from veduta.plan.surroundings.backdrop import EYE_M, add_backdrop, build_backdrop
from veduta.plan.surroundings.panorama import FILES, Pictures, given_pictures, kept_pictures
from veduta.plan.surroundings.sky_picture import LOWEST_DEG, SkyPicture, sky_picture
from veduta.plan.surroundings.terrain import terrain_of
from veduta.run.errors import InputError

TERRAIN = terrain_of(space_of(sample_storey(), 2.55), 6.0)
TERRAIN_LEVEL = terrain_of(space_of(sample_storey(), 2.55), 0.0)


def colour_of(way: NDArray[np.float64]) -> NDArray[np.uint8]:
    """(..., 3) x east, y north, z up: a colour that says the direction."""
    return (127.5 + 110.0 * way).round().astype(np.uint8)


def ways(
    bearing_deg: NDArray[np.float64], elevation_deg: NDArray[np.float64]
) -> NDArray[np.float64]:
    b, e = np.radians(bearing_deg), np.radians(elevation_deg)
    return np.stack([np.cos(e) * np.sin(b), np.cos(e) * np.cos(b), np.sin(e)], axis=-1)


def spherical(width: int = 720) -> NDArray[np.uint8]:
    b = (np.arange(width) + 0.5) / width * 360.0 - 180.0
    e = 90.0 - (np.arange(width // 2) + 0.5) / width * 360.0
    return colour_of(ways(*np.meshgrid(b, e)))


def cylindrical(width: int = 720, height: int = 200) -> NDArray[np.uint8]:
    b = (np.arange(width) + 0.5) / width * 360.0 - 180.0
    rise = (height / 2.0 - np.arange(height) - 0.5) * 2.0 * math.pi / width
    return colour_of(ways(*np.meshgrid(b, np.degrees(np.arctan(rise)))))


def side(number: int, size: int = 256) -> NDArray[np.uint8]:
    """What a camera with 90 degrees of view sees that looks north (0), east, south or west."""
    aside, up = np.meshgrid(
        (np.arange(size) + 0.5) / size * 2.0 - 1.0, 1.0 - (np.arange(size) + 0.5) / size * 2.0
    )
    ray = np.stack([aside, np.ones_like(aside), up], axis=-1)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    turn = -number * math.pi / 2.0
    east = math.cos(turn) * ray[..., 0] - math.sin(turn) * ray[..., 1]
    north = math.sin(turn) * ray[..., 0] + math.cos(turn) * ray[..., 1]
    return colour_of(np.stack([east, north, ray[..., 2]], axis=-1))


def sky_of(*pixels: NDArray[np.uint8]) -> SkyPicture:
    kind = "round" if len(pixels) == 1 else "directions"
    return sky_picture(Pictures(kind, (b"",) * len(pixels), pixels))


@pytest.mark.parametrize(
    "sky",
    [sky_of(spherical()), sky_of(cylindrical()), sky_of(*(side(k) for k in range(4)))],
    ids=["spherical", "cylindrical", "directions"],
)
def test_each_direction_has_its_colour(sky: SkyPicture) -> None:
    rows, columns = sky.pixels.shape[:2]
    e = 90.0 - (np.arange(rows) + 0.5) * (90.0 - LOWEST_DEG) / rows
    b = (np.arange(columns) + 0.5) / columns * 360.0 - 180.0
    bearing, elevation = np.meshgrid(b, e)
    # Where two of the four meet, the edge of one goes on into the other.
    apart = np.abs((bearing + 360.0) % 90.0 - 45.0) > 3.5
    known = ~sky.invented & apart
    wanted = colour_of(ways(bearing, elevation)).astype(int)
    off = np.abs(sky.pixels.astype(int) - wanted).max(axis=2)
    assert known.mean() > 0.3
    assert off[known].max() <= 3


def test_what_no_picture_shows_is_invented_and_goes_on_from_the_edge() -> None:
    sky = sky_of(cylindrical(720, 200))
    highest = math.degrees(math.atan(100 * 2.0 * math.pi / 720))
    rows = len(sky.pixels)
    e = 90.0 - (np.arange(rows) + 0.5) * (90.0 - LOWEST_DEG) / rows
    assert (sky.invented.any(axis=1) == (e > highest)).all()
    first = int(np.flatnonzero(~sky.invented[:, 0])[0])
    assert np.abs(sky.pixels[first - 1].astype(int) - sky.pixels[first].astype(int)).max() < 6
    assert np.ptp(sky.pixels[0].astype(int), axis=0).max() <= 1
    assert not sky_of(spherical()).invented.any()


def seen_from_the_middle(part: Part, sky: SkyPicture, turn_deg: float) -> None:
    """Corners' texture coordinates are those of the directions in which they are seen."""
    left, bottom, right, top = TERRAIN.plot.bounds
    eye = np.array([(left + right) / 2.0, (bottom + top) / 2.0, EYE_M])
    way = part.positions_m.astype(float) - eye
    way[np.abs(way[:, 2] + EYE_M) < 1.5, 2] = -EYE_M  # on the slope the level ground's is taken
    elevation = np.degrees(np.arctan2(way[:, 2], np.hypot(way[:, 0], way[:, 1])))
    bearing = np.degrees(np.arctan2(way[:, 0], way[:, 1])) - turn_deg
    wanted = sky.uv(bearing, elevation)
    inner = elevation < 89.0
    aside = (part.uv[inner, 0] - wanted[inner, 0] + 0.5) % 1.0 - 0.5
    assert np.abs(aside).max() < 1e-4
    assert np.abs(part.uv[:, 1] - wanted[:, 1]).max() < 2e-3


@pytest.mark.parametrize("turn_deg", [0.0, 37.0])
def test_backdrop_shows_directions_where_they_are(turn_deg: float) -> None:
    sky = sky_of(spherical(512))
    part = build_backdrop(sky, TERRAIN, turn_deg)
    seen_from_the_middle(part, sky, turn_deg)
    assert {part.features.provenance(row) for row in range(2)} == {Provenance.INVENTED}
    place = Place()
    add_backdrop(place, part, "panorama.glb")
    assert place.parts[part.id].standing.backdrop


def test_backdrop_is_seen_from_inside_and_joins_the_garden() -> None:
    part = build_backdrop(sky_of(spherical(512)), TERRAIN, 20.0)
    left, bottom, right, top = TERRAIN.plot.bounds
    middle = np.array([(left + right) / 2.0, (bottom + top) / 2.0, EYE_M])
    triangles = part.triangles
    corner = part.positions_m[triangles.indices[:, 0]].astype(float)
    inward = ((middle - corner) * triangles.polygon_normal[triangles.polygon]).sum(axis=1)
    steep = np.abs(triangles.polygon_normal[triangles.polygon][:, 2]) < 0.9
    assert (inward[steep] > 0.0).all()
    # Its inner edge is the plot's: corners and heights.
    at = part.positions_m.astype(float)
    for x, y in ((left, bottom), (right, bottom), (right, top), (left, top)):
        wanted = np.array([x, y, TERRAIN.height(np.array([[x, y]]))[0]])
        assert np.linalg.norm(at - wanted, axis=1).min() < 1e-3
    inside = (at[:, 0] > left + 0.01) & (at[:, 0] < right - 0.01)
    inside &= (at[:, 1] > bottom + 0.01) & (at[:, 1] < top - 0.01) & (at[:, 2] < 50.0)
    assert not inside.any()


@pytest.mark.parametrize("turn_deg", [0.0, 37.0])
def test_without_a_garden_its_ground_goes_on_up_to_the_house(turn_deg: float) -> None:
    sky = sky_of(spherical(512))
    part = build_backdrop(sky, TERRAIN_LEVEL, turn_deg, garden=False)
    triangles = part.triangles
    corners = part.positions_m[triangles.indices].astype(float)
    left, bottom, right, top = TERRAIN_LEVEL.plot.bounds
    middle = np.array([(left + right) / 2.0, (bottom + top) / 2.0])
    centre = corners.mean(axis=1)
    within = (centre[:, 0] > left) & (centre[:, 0] < right)
    within &= (centre[:, 1] > bottom) & (centre[:, 1] < top) & (centre[:, 2] < EYE_M)
    assert np.abs(corners[within][:, :, 2]).max() == 0.0
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[within]
    assert (sides[:, 2] > 0.0).all()
    free_m2 = sum(area.area for _, area in TERRAIN_LEVEL.areas)
    assert sides[:, 2].sum() / 2.0 == pytest.approx(free_m2, rel=1e-3)
    # Each corner shows the direction in which it lies, down to the picture's end.
    at, uv = corners[within].reshape(-1, 3), part.uv[triangles.indices[within]].reshape(-1, 2)
    off = at[:, :2] - middle
    reach = np.hypot(*off.T)
    bearing = np.degrees(np.arctan2(*off.T)) - turn_deg
    elevation = np.maximum(-np.degrees(np.arctan2(EYE_M, reach)), LOWEST_DEG + 0.5)
    wanted = sky.uv(bearing, elevation)
    assert np.abs(uv[:, 1] - wanted[:, 1]).max() < 1e-4
    aside = (uv[:, 0] - wanted[:, 0] + 0.5) % 1.0 - 0.5
    assert np.abs(aside[reach > 0.5]).max() < 1e-3
    # No triangle runs around the picture.
    assert np.ptp(part.uv[triangles.indices[within]][:, :, 0], axis=1).max() < 0.02


def test_glb_is_unlit_and_read_back(tmp_path: Path) -> None:
    part = build_backdrop(sky_of(cylindrical()), TERRAIN, 0.0, (0.5, 0.5, 0.6))
    path = tmp_path / "panorama.glb"
    write_glb(part, path)
    material = read_glb(path).materials[0]
    assert material.unlit
    assert material.colour == pytest.approx((0.5, 0.5, 0.6), abs=1e-3)
    assert material.texture.invented.any()


def test_pictures_are_kept_as_they_are_read_again(tmp_path: Path) -> None:
    given = tmp_path / "mine.png"
    Image.fromarray(spherical(400)).save(given)
    pictures = given_pictures(str(given))
    for name, content in pictures.files.items():
        (tmp_path / name).write_bytes(content)
    again = kept_pictures("round", tmp_path)
    assert again.digest == pictures.digest
    assert (again.pixels[0] == pictures.pixels[0]).all()


@pytest.mark.parametrize(("size", "most"), [((266, 140), 256), ((1040, 65), 1030)])
def test_what_is_accepted_is_accepted_at_a_rebuild(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, size: tuple[int, int], most: int
) -> None:
    """Made smaller, they are 256 x 135 and 1030 x 64 px: too high and too flat by less than one."""
    monkeypatch.setitem(panorama.MOST_PX, "round", most)
    given = tmp_path / "mine.jpg"
    Image.new("RGB", size, (90, 120, 150)).save(given)
    pictures = given_pictures(str(given))
    (tmp_path / FILES["round"][0]).write_bytes(pictures.contents[0])
    assert kept_pictures("round", tmp_path).digest == pictures.digest


def test_a_picture_that_is_too_small_once_it_is_kept_is_refused(tmp_path: Path) -> None:
    strip = tmp_path / "strip.png"
    Image.new("RGB", (5000, 150)).save(strip)
    with pytest.raises(InputError, match=r"is 5000 x 150 px, and 2048 x 61 px .* too small"):
        given_pictures(",".join(f"{name}={strip}" for name in "NESW"))


def test_four_pictures_in_any_order_and_with_commas_in_their_names(tmp_path: Path) -> None:
    names = {"S": "a,b.png", "N": "n.png", "W": "w.png", "E": "e.png"}
    for number, direction in enumerate("NESW"):
        Image.fromarray(side(number, 128)).save(tmp_path / names[direction])
    text = ",".join(f"{name}={tmp_path / file}" for name, file in names.items())
    pictures = given_pictures(text)
    assert tuple(pictures.files) == FILES["directions"]
    for number in range(4):
        middle = pictures.pixels[number][64, 64].astype(int)
        assert np.abs(middle - side(number, 128)[64, 64]).max() <= 4


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("gone.jpg", "gone.jpg"),
        ("cut.jpg", "cut.jpg"),
        ("photo.jpg", "does not show all around"),
        ("strip.jpg", "shows no sky"),
        ("tiny.jpg", "too small"),
        ("N=photo.jpg,E=photo.jpg", "names not each direction once"),
        ("N=photo.jpg,E=photo.jpg,S=photo.jpg,S=photo.jpg", "names not each direction once"),
        ("N=photo.jpg,E=photo.jpg,S=photo.jpg,W=gone.jpg", "gone.jpg"),
    ],
)
def test_faulty_pictures_are_told(
    text: str, fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Image.fromarray(spherical(400)).save("whole.jpg")
    Path("cut.jpg").write_bytes(Path("whole.jpg").read_bytes()[:900])
    for name, size in (("photo", (400, 300)), ("strip", (4000, 100)), ("tiny", (64, 30))):
        Image.new("RGB", size).save(f"{name}.jpg")
    with pytest.raises(InputError, match=fault):
        given_pictures(text)


def test_a_picture_that_the_document_names_must_be_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"panorama.jpg: is missing, and .*plan.json"):
        kept_pictures("round", tmp_path)
    assert sample_plan().panorama is None
