"""The wall of a footprint that a front is put on: which edge, how deep, and where it lies."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import shapely
import trimesh
from drawn_facade import draw_facade
from numpy.typing import NDArray
from PIL import Image

import veduta
from veduta.facade.batch import run_call
from veduta.facade.footprint import on_wall, read_wall
from veduta.facade.load import DOCUMENT
from veduta.facade.options import (
    EyesOptions,
    FacadeOptions,
    ModelOptions,
    OntoOptions,
    RectifyOptions,
    ScaleOptions,
)
from veduta.facade.wall import Wall
from veduta.place.place import Place
from veduta.run.errors import InputError
from veduta.run.progress import Progress

Corners = list[tuple[float, float]]
FAR = (500_100.0, 5_400_200.0)
HOUSE: Corners = [(0, 0), (14, 7), (10, 15), (-4, 8)]
"""A rectangle, turned: 15.65 m along the first edge, 8.94 m deep."""
COURT: Corners = [(0, 0), (20, 0), (20, 12), (13, 12), (13, 5), (6, 5), (6, 12), (0, 12)]
QUIET = Progress(quiet=True)


def lots(
    path: Path, *polygons: Corners, crs: str | None = None, roads: Sequence[Corners] = ()
) -> Path:
    """A GeoJSON of polygons, named a, b, ..."""
    features: list[object] = [
        {
            "type": "Feature",
            "properties": {"name": "abcdef"[number]},
            "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
        }
        for number, ring in enumerate(polygons)
    ]
    features += [
        {
            "type": "Feature",
            "properties": {"highway": "residential"},
            "geometry": {"type": "LineString", "coordinates": line},
        }
        for line in roads
    ]
    document: dict[str, object] = {"type": "FeatureCollection", "features": features}
    if crs is not None:
        document["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def far(ring: Corners) -> Corners:
    """The same in a projected CRS."""
    return [(x + FAR[0], y + FAR[1]) for x, y in ring]


def mean_ray_m(ring: Corners, edge: int, rays: int = 20_000) -> float:
    """Mean way from a polygon's edge inwards to the first other edge, ray by ray."""
    points = np.array(ring, float)
    a, b = points[edge], points[(edge + 1) % len(points)]
    along = (b - a) / np.linalg.norm(b - a)
    inwards = np.array([-along[1], along[0]])
    starts = a + np.outer((np.arange(rays) + 0.5) / rays, b - a)
    nearest = np.full(rays, np.inf)
    for number, c in enumerate(points):
        side = points[(number + 1) % len(points)] - c
        cross = inwards[0] * side[1] - inwards[1] * side[0]
        if number == edge or abs(cross) < 1e-12:
            continue
        to = c - starts
        t = (to[:, 0] * side[1] - to[:, 1] * side[0]) / cross
        u = (to[:, 0] * inwards[1] - to[:, 1] * inwards[0]) / cross
        hit = (t > 1e-9) & (u >= 0) & (u <= 1)
        nearest[hit] = np.minimum(nearest[hit], t[hit])
    return float(nearest.mean())


@pytest.mark.parametrize("ring", [HOUSE, COURT, [(0, 0), (9, 1), (12, 6), (4, 9), (-2, 5)]])
def test_depth_is_the_mean_way_through_the_footprint(tmp_path: Path, ring: Corners) -> None:
    path = lots(tmp_path / "lot.geojson", ring)
    for edge in range(len(ring)):
        wall = read_wall(path, OntoOptions(edge=edge))
        assert wall.depth_m == pytest.approx(mean_ray_m(ring, edge), rel=1e-3)
        assert wall.width_m == pytest.approx(math.dist(ring[edge], ring[(edge + 1) % len(ring)]))


def test_box_and_footprint_overlap_as_their_areas(tmp_path: Path) -> None:
    ell: Corners = [(0, 0), (10, 0), (10, 4), (5, 4), (5, 8), (0, 8)]
    wall = read_wall(lots(tmp_path / "lot.geojson", ell), OntoOptions())
    # Mean depth 6: the box of 60 m2 and the L of 60 m2 have 50 m2 in common.
    assert wall.depth_m == pytest.approx(6.0)
    assert wall.overlap == pytest.approx(50 / 70, abs=1e-4)
    assert read_wall(lots(tmp_path / "b.geojson", HOUSE), OntoOptions()).overlap == 1.0


@pytest.mark.parametrize("turned", [HOUSE, HOUSE[::-1]])
def test_the_building_lies_behind_the_wall(tmp_path: Path, turned: Corners) -> None:
    path = lots(tmp_path / "lot.geojson", far(turned), crs="EPSG:25832")
    for edge in range(4):
        wall = read_wall(path, OntoOptions(edge=edge))
        assert wall.crs == "EPSG:25832"
        for front_m in (wall.width_m, wall.width_m - 2.0):
            matrix = wall.world_from_part(front_m)
            assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1.0)
            left, right, inside = (
                (matrix @ (x, y, 0.0, 1.0))[:2] + wall.origin_m[:2]
                for x, y in ((0.0, 0.0), (front_m, 0.0), (front_m / 2, wall.depth_m / 2))
            )
            ends = {(round(x, 6), round(y, 6)) for x, y in far(turned)}
            if front_m == wall.width_m:
                assert {tuple(np.round(left, 6)), tuple(np.round(right, 6))} < ends
            middle = np.mean(far(turned), axis=0)
            assert np.abs(inside - middle).max() < 1e-6
            # Who looks at the front has its left end on the left: the body is left of the way.
            way, body = right - left, middle - left
            assert way[0] * body[1] - way[1] * body[0] > 0


def test_an_edge_is_chosen(tmp_path: Path) -> None:
    path = lots(tmp_path / "a.geojson", HOUSE[1:] + HOUSE[:1])
    wall = read_wall(path, OntoOptions())
    # The two long edges are as long: that of the south is taken.
    assert wall.edge == 3
    assert "most to the south" in wall.chosen
    assert "south-east" in wall.told
    longest = lots(tmp_path / "b.geojson", [(0, 0), (8, 0), (8, 9), (2, 10)])
    assert read_wall(longest, OntoOptions()).edge == 3
    street = lots(
        tmp_path / "c.geojson", COURT, roads=[[(-30, 18), (50, 18)], [(-30, 90), (9, 99)]]
    )
    chosen = read_wall(street, OntoOptions())
    assert "street" in chosen.chosen
    assert chosen.start_m[1] + chosen.origin_m[1] == 12.0
    assert chosen.end_m[1] + chosen.origin_m[1] == 12.0


@pytest.mark.parametrize(
    ("options", "fault", "remedy"),
    [
        (OntoOptions(edge=4, lot="a"), r"has 4 edges: 0 \(15.7 m, facing south-east", "0 to 3"),
        (OntoOptions(lot="z"), "is no polygon", "It has: a, b"),
        (OntoOptions(), "has 2 polygons", "--lot"),
        (OntoOptions(edge=0, lot="b"), "is 0.2 m wide", "another edge"),
    ],
)
def test_bad_walls(tmp_path: Path, options: OntoOptions, fault: str, remedy: str) -> None:
    narrow: Corners = [(30, 0), (30.2, 0), (35, 9), (25, 9)]
    path = lots(tmp_path / "lot.geojson", HOUSE, narrow)
    with pytest.raises(InputError, match=fault) as caught:
        read_wall(path, options)
    assert remedy in caught.value.remedy
    assert str(path) in f"{caught.value.subject} {caught.value.fault}"


def test_a_wall_without_depth(tmp_path: Path) -> None:
    thin = lots(tmp_path / "lot.geojson", [(0, 0), (30, 0), (30, 0.3), (0, 0.3)])
    with pytest.raises(InputError, match=r"0.3 m deep behind edge 0") as caught:
        read_wall(thin, OntoOptions())
    assert "another edge: 0 (30.0 m, facing south)" in caught.value.remedy


def test_bad_files_and_use(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        read_wall(tmp_path / "none.geojson", OntoOptions())
    path = tmp_path / "lot.geojson"
    path.write_text('{"type": "FeatureCollection", "features": []}', encoding="utf-8")
    with pytest.raises(InputError, match="has no lot"):
        read_wall(path, OntoOptions())
    with pytest.raises(InputError, match="none is named") as caught:
        on_wall(FacadeOptions(onto=OntoOptions(edge=1)))
    assert caught.value.subject == "--edge 1"
    photos = [tmp_path / "a.png", tmp_path / "b.png"]
    for photo in photos:
        Image.new("RGB", (80, 80)).save(photo)
    with pytest.raises(InputError, match="2 photos"):
        run_call(photos, tmp_path / "out", FacadeOptions(onto=OntoOptions(onto=path)), QUIET)
    with pytest.raises(ValueError, match="at least"):
        Wall(
            footprint="a", lot="a", edge=0, start_m=(0, 0, 0), end_m=(0.1, 0, 0),
            depth_m=1, overlap=1, chosen="",
        )  # fmt: skip


def test_what_is_given_is_kept(tmp_path: Path) -> None:
    path = lots(tmp_path / "lot.geojson", HOUSE)
    onto = OntoOptions(onto=path)
    own = on_wall(FacadeOptions(onto=onto))
    assert own.scale.width_m == pytest.approx(math.dist(HOUSE[0], HOUSE[1]))
    assert own.model.depth_m == pytest.approx(math.dist(HOUSE[1], HOUSE[2]))
    given = FacadeOptions(
        onto=onto, scale=ScaleOptions(storey_m=3.2), model=ModelOptions(depth_m=5.0)
    )
    kept = on_wall(given)
    assert (kept.scale, kept.model) == (given.scale, given.model)
    assert kept.wall is not None
    said = " ".join(kept.wall.notes(9.0, 5.0, is_scaled=False))
    assert "9.00 m wide and stands in its middle" in said
    assert "5.00 m deep as asked" in said
    assert "beyond both" in " ".join(kept.wall.notes(19.0, 5.0, is_scaled=False))


def front_ends(folder: Path) -> NDArray[np.float64]:
    """(4, 3) the corners of the body's foot in the CRS, front left first, about the part's x."""
    place = Place.load(folder)
    (placed,) = place.parts.values()
    positions = placed.content.positions_m.astype(np.float64)
    low, high = positions[:, 0].min(), positions[:, 0].max()
    deep = positions[:, 1].max()
    foot = np.array([(low, 0, 0), (high, 0, 0), (high, deep, 0), (low, deep, 0)])
    matrix = placed.standing.transform
    return np.asarray(foot @ matrix[:3, :3].T + matrix[:3, 3] + place.origin_m)


def test_a_photo_becomes_a_building_on_the_wall(tmp_path: Path) -> None:
    drawn = draw_facade()
    photo, out = tmp_path / "house.png", tmp_path / "out"
    Image.fromarray(drawn.pixels).save(photo)
    path = lots(tmp_path / "lot.geojson", far(HOUSE), crs="EPSG:25832")
    options = FacadeOptions(
        eyes=EyesOptions(eyes="plain"),
        rectify=RectifyOptions(rectified=True),
        onto=OntoOptions(onto=path),
    )
    result = run_call([photo], out, options, QUIET, jobs=1)
    assert result.exit_code == 0
    place = Place.load(out)
    assert place.crs == "EPSG:25832"
    # Millimetres, as rule files have them, and single precision.
    assert np.abs(front_ends(out)[:, :2] - far(HOUSE)).max() < 2e-3
    assert place.start is not None
    eye = np.array(place.start.eye)[:2] + place.origin_m[:2] - FAR
    assert np.cross((*HOUSE[1], 0), (*eye, 0))[2] < 0  # in the street, not in the house
    notes = json.loads((out / "house" / DOCUMENT).read_text(encoding="utf-8"))["notes"]
    assert any("the longest" in note for note in notes)
    assert any("gives the scale" in note for note in notes)

    again = tmp_path / "again"
    rebuilt = run_call([out / "house" / DOCUMENT], again, FacadeOptions(), QUIET, jobs=1)
    assert rebuilt.exit_code == 0
    assert np.allclose(front_ends(again), front_ends(out))
    document = json.loads((out / "house" / DOCUMENT).read_text(encoding="utf-8"))
    document["wall"]["end_m"] = document["wall"]["start_m"]
    (again / "house" / DOCUMENT).write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(InputError, match=r"facade\.json.* wall.*at least 0\.5 m"):
        run_call([again / "house" / DOCUMENT], again, FacadeOptions(), QUIET, jobs=1)
    # The footprint's content is part of the call: another one is another call.
    lots(path, far(COURT), crs="EPSG:25832")
    with pytest.raises(InputError, match="other"):
        run_call([photo], out, options, QUIET, jobs=1)


RECESSED = """version "1.0"
Lot --> extrude(world.up, 9) comp(f) { side : Side | all : Wall. }
Side --> split(y) { 1 : Wall. | { 1.6 : Row | 1.4 : Wall. }* }
Row --> split(x) { ~0.8 : Wall. | { 1.2 : Hole | ~0.8 : Wall. }* }
Hole --> t(0, 0, -0.3) Pane.
"""


def model_of(path: Path, how: str) -> Path:
    """The turned house: of rules whose windows lie back, or of another program with wide eaves."""
    if how == "rules":
        rules = path / "recessed.cga"
        rules.write_text(RECESSED, encoding="utf-8")
        veduta.derive(rules, lots(path / "lot.geojson", HOUSE), path / "out")
        return next((path / "out" / "parts").rglob("*.glb"))
    body = trimesh.creation.extrude_polygon(shapely.Polygon(HOUSE), 8.0)
    eaves = trimesh.creation.extrude_polygon(
        shapely.Polygon(HOUSE).buffer(0.6, join_style="mitre"), 0.3
    )
    shed = trimesh.creation.box((3.0, 3.0, 2.5), np.eye(4))
    eaves.apply_translation((0, 0, 8.0))
    shed.apply_translation((40.0, 0, 1.25))
    up_along_y = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
    for one in (body, eaves, shed):
        one.apply_transform(up_along_y)
    return written(path / "other.glb", body, eaves, shed)


def written(path: Path, *meshes: trimesh.Trimesh) -> Path:
    data = trimesh.Scene(meshes).export(file_type="glb")  # type: ignore[no-untyped-call]
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("how", ["rules", "another program"])
def test_the_walls_of_a_model_are_found_behind_its_windows_and_below_its_eaves(
    tmp_path: Path, how: str
) -> None:
    model = model_of(tmp_path, how)
    lot = "1" if how == "another program" else None
    due = {round(math.dist(a, b), 1) for a, b in zip(HOUSE, HOUSE[1:] + HOUSE[:1], strict=True)}
    walls = [read_wall(model, OntoOptions(lot=lot, edge=edge)) for edge in range(4)]
    assert {round(wall.width_m, 1) for wall in walls} == due
    longest = read_wall(model, OntoOptions(lot=lot))
    assert longest.width_m == pytest.approx(math.dist(HOUSE[0], HOUSE[1]), abs=0.05)
    assert longest.depth_m == pytest.approx(math.dist(HOUSE[1], HOUSE[2]), abs=0.05)
    for corner in (longest.start_m, longest.end_m):
        if how == "another program":
            assert min(math.dist(corner[:2], due_at) for due_at in HOUSE) < 0.05
    assert longest.start_m[2] == pytest.approx(0.0, abs=1e-3)
    with pytest.raises(InputError, match="has 4 edges"):
        read_wall(model, OntoOptions(lot=lot, edge=4))


def _boxes(
    path: Path, *sizes: tuple[tuple[float, float, float], tuple[float, float, float]]
) -> Path:
    """Boxes from their low corner to their high one (m, z up), as a model with y up."""
    up_along_y = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
    made = []
    for low, high in sizes:
        extents = np.subtract(high, low)
        place = np.eye(4)
        place[:3, 3] = np.add(low, high) / 2.0
        made.append(trimesh.creation.box(extents, place))
        made[-1].apply_transform(up_along_y)
    return written(path, *made)


@pytest.mark.parametrize(
    "ground",
    [((-6.0, -6.0, 0.0), (16.0, 16.0, 1.0)), ((-30.0, -30.0, 0.0), (40.0, 40.0, 0.5))],
    ids=["podium", "slab"],
)
def test_what_a_house_stands_on_is_no_wall(
    tmp_path: Path, ground: tuple[tuple[float, float, float], tuple[float, float, float]]
) -> None:
    model = _boxes(tmp_path / "on.glb", ground, ((0.0, 0.0, ground[1][2]), (10.0, 10.0, 9.0)))
    walls = [read_wall(model, OntoOptions(edge=edge)) for edge in range(4)]
    assert [wall.width_m for wall in walls] == pytest.approx([10.0] * 4, abs=0.05)


def test_houses_that_touch_at_a_corner_are_two(tmp_path: Path) -> None:
    model = _boxes(
        tmp_path / "two.glb",
        ((0.0, 0.0, 0.0), (10.0, 10.0, 8.0)),
        ((10.0, 10.0, 0.0), (20.0, 19.0, 8.0)),
    )
    widths = {
        round(read_wall(model, OntoOptions(lot=lot, edge=edge)).width_m)
        for lot in ("1", "2")
        for edge in range(4)
    }
    assert widths == {9, 10}


def test_a_model_without_walls_and_a_text_one_are_refused(tmp_path: Path) -> None:
    flat = trimesh.Trimesh([(0, 0, 0), (9, 0, 0), (0, 0, 9)], [(0, 1, 2)])
    written(tmp_path / "flat.glb", flat)
    with pytest.raises(InputError, match="no closed wall"):
        read_wall(tmp_path / "flat.glb", OntoOptions())
    (tmp_path / "text.gltf").write_text("{}")
    with pytest.raises(InputError, match=r"binary glTF \(.glb\)"):
        read_wall(tmp_path / "text.gltf", OntoOptions())
    with pytest.raises(InputError, match="is of files of lots"):
        read_wall(tmp_path / "flat.glb", OntoOptions(crs="EPSG:2154"))


def test_roads_of_another_file_say_which_wall_is_on_the_street(tmp_path: Path) -> None:
    path = lots(tmp_path / "lot.geojson", far(HOUSE))
    street = [far([(-8, 8), (10, 19)])]
    roads = lots(tmp_path / "roads.geojson", crs="EPSG:25832", roads=street)
    asked = OntoOptions(crs="EPSG:25832", roads=roads)
    wall = read_wall(path, asked)
    assert wall.crs == "EPSG:25832"
    assert "on the street" in wall.chosen
    middle = 0.5 * (np.array(wall.start_m[:2]) + wall.end_m[:2]) + wall.origin_m[:2]
    assert middle == pytest.approx((FAR[0] + 3.0, FAR[1] + 11.5), abs=0.1)
    with pytest.raises(InputError, match="--roads"):
        on_wall(FacadeOptions(onto=OntoOptions(roads=roads)))
