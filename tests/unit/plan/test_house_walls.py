"""Walls of a house against closed forms, shapely and trimesh."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from closed_shells import shells
from hypothesis import given
from hypothesis import strategies as st
from sample_plan import INNER_M, OUTER_M, opening, sample_plan, sample_storey, wall, window
from shapely.geometry import LineString, Polygon, box
from shapely.ops import unary_union

from veduta.geometry.arcs import arc_points
from veduta.place.builder import PartBuilder
from veduta.place.part import Part
from veduta.plan.document import Junction, Storey
from veduta.plan.house import roof
from veduta.plan.house.build import build_house
from veduta.plan.house.frame import Sculptor
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.looks import Looks
from veduta.plan.house.roof import SLOPE_DEG, add_roof
from veduta.plan.house.space import space_of
from veduta.plan.house.walls import wall_solid
from veduta.plan.house.windows import add_window
from veduta.plan.options import HouseOptions

HEIGHT_M = 2.55


def bare_storey(points: dict[str, tuple[float, float]], walls: list[tuple[str, str]]) -> Storey:
    """Walls alone, of one thickness."""
    junctions = [Junction(id=name, at_m=at, type="L") for name, at in points.items()]
    lines = [wall(f"{start}{end}", start, end) for start, end in walls]
    return sample_storey(junctions=junctions, walls=lines, openings=[], rooms=[])


def mesh_of_walls(part: Part) -> trimesh.Trimesh:
    """The first shell after the body: what the walls close."""
    return list(shells(part))[1]


def test_wall_volume_is_area_times_height_less_openings() -> None:
    storey = sample_storey()
    space = space_of(storey, HEIGHT_M)
    area = unary_union([line.strip for line in space.lines.values()]).area + 4 * (OUTER_M / 2) ** 2
    # Four corners: the outer quarter of each is no wall's strip.
    front, inner, w1, w2 = storey.openings
    taken = sum(
        thickness * one.width_m * one.height_m
        for one, thickness in ((front, OUTER_M), (inner, INNER_M), (w1, OUTER_M), (w2, OUTER_M))
    )
    assert space.walls.area == pytest.approx(area, abs=1e-6)
    assert wall_solid(space, HEIGHT_M).volume() == pytest.approx(area * HEIGHT_M - taken, abs=1e-6)


def test_walls_in_the_part_are_watertight_and_have_the_same_volume() -> None:
    part = build_house(sample_plan(), HouseOptions()).part
    mesh = mesh_of_walls(part)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    space = space_of(sample_storey(), 2.8 - 0.25)
    assert mesh.volume == pytest.approx(wall_solid(space, 2.8 - 0.25).volume(), rel=1e-5)


def test_a_right_angle_is_mitred_to_the_outer_corner() -> None:
    storey = bare_storey({"a": (0, 0), "b": (4, 0), "c": (4, 3)}, [("a", "b"), ("b", "c")])
    walls = footprint(wall_lines(storey).values())
    half = OUTER_M / 2
    expected = Polygon(
        [(0, -half), (4 + half, -half), (4 + half, 3), (4 - half, 3), (4 - half, half), (0, half)]
    )
    assert walls.symmetric_difference(expected).area < 1e-9


@given(angle=st.floats(0.7, 2.0 * math.pi - 0.7), length=st.floats(1.0, 6.0))
def test_two_walls_are_mitred_as_shapely_mitres_their_line(angle: float, length: float) -> None:
    tip = (length * math.cos(angle), length * math.sin(angle))
    storey = bare_storey({"a": (3, 0), "b": (0, 0), "c": tip}, [("a", "b"), ("b", "c")])
    walls = footprint(wall_lines(storey).values())
    line = LineString([(3, 0), (0, 0), tip])
    expected = line.buffer(OUTER_M / 2, cap_style="flat", join_style="mitre", mitre_limit=10.0)
    assert walls.symmetric_difference(expected).area < 1e-6


@given(bulge=st.floats(-1.0, 1.0).filter(lambda value: abs(value) > 0.01))
def test_a_curved_wall_is_the_arc_of_its_bulge(bulge: float) -> None:
    points = arc_points((1.0, 2.0), (5.0, 2.0), bulge)
    radius = 4.0 * (1.0 + bulge**2) / (4.0 * abs(bulge))
    centre = np.array([3.0, 2.0 + 4.0 * (1.0 - bulge**2) / (4.0 * bulge)])
    assert np.linalg.norm(points - centre, axis=1) == pytest.approx(radius)
    middle = points[len(points) // 2]
    if len(points) % 2 == 1:
        # The arc's height is the bulge times half the chord; going east, right is south.
        assert middle == pytest.approx([3.0, 2.0 - 2.0 * bulge])


def test_an_opening_in_a_curved_wall_leaves_it_closed() -> None:
    junctions = [
        Junction(id="a", at_m=(0.0, 0.0), type="end"),
        Junction(id="b", at_m=(4.0, 0.0), type="end"),
    ]
    storey = sample_storey(
        junctions=junctions,
        walls=[wall("arc", "a", "b", bulge=0.4)],
        openings=[window("w", "arc", 1.5, 1.0)],
        rooms=[],
    )
    solid = wall_solid(space_of(storey, HEIGHT_M), HEIGHT_M)
    whole = wall_solid(
        space_of(sample_storey(**dict(storey) | {"openings": []}), HEIGHT_M), HEIGHT_M
    )
    assert solid.genus() == 1  # one hole through it
    assert whole.volume() - solid.volume() == pytest.approx(1.0 * 1.25 * OUTER_M, rel=1e-3)


def test_what_cannot_be_cut_is_left_out_and_said() -> None:
    storey = sample_storey()
    more = [
        *storey.openings,
        opening("tiny", "middle", 3.0, 0.1),
        window("double", "south-1", 3.0, 1.0),
    ]
    space = space_of(sample_storey(openings=more), HEIGHT_M)
    assert [hole.opening.id for hole in space.holes] == ["front", "inner", "w1", "w2"]
    assert any("tiny" in note and "too short" in note for note in space.notes)
    assert any("double" in note and "w1" in note for note in space.notes)


def test_a_window_in_a_curved_wall_follows_it() -> None:
    junctions = [
        Junction(id="a", at_m=(0.0, 0.0), type="end"),
        Junction(id="b", at_m=(4.0, 0.0), type="end"),
    ]
    storey = sample_storey(
        junctions=junctions,
        walls=[wall("arc", "a", "b", bulge=0.6)],
        openings=[window("w", "arc", 0.8, 3.0)],
        rooms=[],
    )
    builder = PartBuilder("test")
    space = space_of(storey, HEIGHT_M)
    add_window(space.holes[0], space, Sculptor(builder, Looks(builder)), "surround")
    points = builder.build().positions_m
    # The circle through the wall's ends with a sagitta of 0.6 half chords, below the chord.
    radius = 2.0 * (1.0 + 0.6**2) / (2.0 * 0.6)
    away = np.hypot(points[:, 0] - 2.0, points[:, 1] + 1.2 - radius) - radius
    # Sills reach farthest; the centre line is polygonal.
    assert np.abs(away).max() < OUTER_M / 2 + 0.12 + 0.01
    assert len(points) > 100


def test_a_roof_that_cannot_be_cut_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A side is missing: the other faces are there, and it is said."""
    whole = roof._solid

    def open_solid(*given: object) -> object:
        faces = whole(*given)  # type: ignore[arg-type]
        return faces[1:] if faces else faces

    monkeypatch.setattr(roof, "_solid", open_solid)
    builder = PartBuilder("test")
    sculptor = Sculptor(builder, Looks(builder))
    notes = add_roof(Polygon([(0, 0), (8, 0), (8, 5), (0, 5)]), 3.0, sculptor, HouseOptions())
    assert notes == ["roof 1 is no closed solid: its eaves may hang into rooms"]
    assert len(builder.build().positions_m) > 8


def test_a_round_house_has_a_hip_roof_where_it_cannot_have_gables() -> None:
    turn = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
    round_house = Polygon(5.0 * np.column_stack([np.cos(turn), np.sin(turn)]))
    builder = PartBuilder("test")
    notes = add_roof(
        round_house, 3.0, Sculptor(builder, Looks(builder)), HouseOptions(roof="gable")
    )
    assert notes == ["roof 1 is hipped: its outline allows no gable roof"]
    top = builder.build().positions_m[:, 2].max()
    slope = np.tan(np.radians(SLOPE_DEG))
    # A cone's height, but for the polygon's inner radius.
    assert top == pytest.approx(3.0 + slope * 5.0, rel=0.02)


def test_a_mansard_is_steep_below_and_flatter_above() -> None:
    builder = PartBuilder("test")
    sculptor = Sculptor(builder, Looks(builder))
    assert add_roof(box(0.0, 0.0, 12.0, 9.0), 3.0, sculptor, HouseOptions(roof="mansard")) == []
    points = builder.build().positions_m
    levels = np.unique(points[:, 2].round(2))
    # Eaves, the knee and the ridge; the eaves do not hang before the windows.
    assert levels.min() > 3.0 - 0.4
    knee = levels[(levels > 3.5)].min()
    at_knee = points[np.abs(points[:, 2] - knee) < 0.02]
    inset = float(at_knee[:, 0].min())
    assert (knee - 3.0) / inset > np.tan(np.radians(60.0))
    assert (levels.max() - knee) / (4.5 - inset) < np.tan(np.radians(30.0))
