"""A house in a row: party walls, closed, under a roof that goes on over the neighbours."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import DEPTH_M, OUTER_M, WIDTH_M, sample_plan, wall, window

from veduta.place.semantics import Provenance
from veduta.plan.document import Junction, PlanDocument, Text
from veduta.plan.house.build import build_house
from veduta.plan.house.neighbours import build_neighbours
from veduta.plan.house.party import Party, parties_of
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.cityjson import house_cityjson
from veduta.plan.surroundings.terrain import own_plot, terrain_of
from veduta.plan.terrace import terrace_named, terrace_options, with_terrace

ASKED = HouseOptions(terraced=True, neighbours=True)
HALF = OUTER_M / 2.0


def written(text: str, score: float = 0.95) -> Text:
    return Text(text=text, box_px=[(0, 0), (9, 0), (9, 3), (0, 3)], score=score)


def changed(**changes: object) -> PlanDocument:
    plan = sample_plan()
    return plan.model_copy(update={"storeys": [plan.storeys[0].model_copy(update=changes)]})


def party(document: PlanDocument) -> set[str]:
    return {wall.id for storey in document.storeys for wall in storey.walls if wall.party}


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("A mid terrace house", "mid"),
        ("Terraced House", "mid"),
        ("PARTY WALL", "mid"),
        ("Reihenmittelhaus", "mid"),
        ("tussenwoning", "mid"),
        ("End of Terrace", "end"),
        ("Roof terrace, terraced house", "mid"),
        ("Semi-detached house with garage", "end"),
        ("Semi-Detached", "end"),
        ("Doppelhaushälfte", "end"),
    ],
)
def test_what_a_sheet_calls_a_house_in_a_row(text: str, kind: str) -> None:
    assert terrace_named([written(text)]) == (kind, text)


@pytest.mark.parametrize(
    "text",
    [
        "Terrace",
        "Roof terrace 12 m2",
        "Terrasse",
        "Party room",
        "Garden terrace home office",
        "ROOF TERRACE HOUSE PLAN",
        "semi detached garage",
        "Semi-detached double garage",
        "Townhouse car port",
    ],
)
def test_other_words_say_nothing_of_it(text: str) -> None:
    assert terrace_named([written(text)]) is None
    assert terrace_named([written("Mid terrace", 0.5)]) is None


def test_the_sheet_is_believed_and_said() -> None:
    plan = changed(texts=[written("Mid Terrace")])
    found = with_terrace(plan, HouseOptions(), by_text=True)
    assert party(found) == {"east", "west"}
    (doubt,) = found.storeys[0].doubts
    assert "at the right and left of the page" in doubt
    assert "'Mid Terrace' is on the sheet" in doubt
    assert not party(with_terrace(plan, HouseOptions(), by_text=False))
    assert with_terrace(found, ASKED, by_text=True) is found


def test_an_end_house_has_one() -> None:
    found = with_terrace(changed(texts=[written("End terrace")]), HouseOptions(), by_text=True)
    assert len(party(found)) == 1


def test_a_room_that_is_named_end_terrace_is_no_house() -> None:
    storey = sample_plan().storeys[0]
    rooms = [storey.rooms[0].model_copy(update={"name": "End terrace"}), *storey.rooms[1:]]
    found = with_terrace(
        changed(texts=[written("End terrace")], rooms=rooms), HouseOptions(), by_text=True
    )
    assert not party(found)


def test_windows_speak_against_what_the_sheet_says() -> None:
    openings = sample_plan().storeys[0].openings
    sides = [window("we", "east", 2.0, 1.0), window("ww", "west", 2.0, 1.0)]
    plan = changed(texts=[written("Mid Terrace")], openings=[*openings, *sides])
    found = with_terrace(plan, HouseOptions(), by_text=True)
    assert not party(found)
    assert "it stands alone" in found.storeys[0].doubts[0]


def test_what_is_asked_closes_windows_and_names_them() -> None:
    storey = sample_plan().storeys[0]
    rooms = [one.model_copy(update={"openings": [*one.openings, "we"]}) for one in storey.rooms]
    plan = changed(openings=[*storey.openings, window("we", "east", 2.0, 1.0)], rooms=rooms)
    found = with_terrace(plan, ASKED, by_text=True)
    assert party(found) == {"east", "west"}
    assert "closed in party walls" in found.storeys[0].doubts[0]
    assert "we" in found.storeys[0].doubts[0]
    assert "without --terraced, and set party of the walls" in found.storeys[0].doubts[0]
    assert "we" not in {one.id for one in found.storeys[0].openings}
    assert all("we" not in room.openings for room in found.storeys[0].rooms)


def test_thick_blank_sides_are_party_walls() -> None:
    storey = sample_plan().storeys[0]

    def with_thickness(thickness_m: float) -> PlanDocument:
        thick = {"thickness_m": thickness_m}
        return changed(
            walls=[
                wall.model_copy(update=thick if wall.id in ("east", "west") else {})
                for wall in storey.walls
            ]
        )

    found = with_terrace(with_thickness(0.45), HouseOptions(), by_text=True)
    assert party(found) == {"east", "west"}
    assert "much thicker" in found.storeys[0].doubts[0]
    (ground,) = with_thickness(0.45).storeys
    upper = ground.model_copy(
        update={
            "name": "first floor",
            "elevation_m": 2.8,
            "openings": [*ground.openings, window("we", "east", 2.0, 1.0)],
        }
    )
    above = sample_plan().model_copy(update={"storeys": [ground, upper]})
    assert with_terrace(above, HouseOptions(), by_text=True) is above
    usual = with_thickness(0.36)
    assert with_terrace(usual, HouseOptions(), by_text=True) is usual


def test_neighbours_of_a_house_that_stands_alone_are_refused_in_words() -> None:
    found = with_terrace(sample_plan(), HouseOptions(neighbours=True), by_text=True)
    assert "--neighbours" in found.storeys[0].doubts[0]


def test_the_roof_ends_at_the_party_walls_and_reaches_over_the_others() -> None:
    document = with_terrace(sample_plan(), ASKED, by_text=False)
    options = terrace_options(document, ASKED)
    assert options.roof == "gable"
    house = build_house(document, options)
    part = house.part
    roof = [row for row, name in enumerate(part.features.name) if name.startswith("roof")]
    own = np.isin(part.polygon_feature[part.triangles.polygon], roof)
    points = part.positions_m[part.triangles.indices[own]].reshape(-1, 3).astype(float)
    low, high = points.min(axis=0), points.max(axis=0)
    np.testing.assert_allclose((low[0], high[0]), (-HALF, WIDTH_M + HALF), atol=0.01)
    assert low[1] < -HALF - 0.3
    assert high[1] > DEPTH_M + HALF + 0.3
    ridge = points[points[:, 2] > high[2] - 1e-3]
    assert np.ptp(ridge[:, 0]) == pytest.approx(WIDTH_M + 2 * HALF, abs=0.02)
    assert np.ptp(ridge[:, 1]) < 0.05
    content, notes = house_cityjson(house, options)
    assert content
    assert not [note for note in notes if "roof" in note]


def test_neighbours_are_invented_and_touch_nothing() -> None:
    document = with_terrace(sample_plan(), ASKED, by_text=False)
    options = terrace_options(document, ASKED)
    part = build_neighbours(build_house(document, options), options, 0.04)
    assert part is not None
    told = {part.features.provenance(row) for row in range(len(part.features))}
    assert told == {Provenance.INVENTED}
    places = part.positions_m
    inside = (places[:, 0] > -HALF) & (places[:, 0] < WIDTH_M + HALF)
    assert not inside.any()
    assert places[:, 2].min() == pytest.approx(0.0)
    alone = sample_plan()
    assert build_neighbours(build_house(alone, HouseOptions()), HouseOptions(), 0.0) is None


def as_deep_as(depth_m: float) -> PlanDocument:
    """The sample with less or more from front to back."""
    storey = sample_plan().storeys[0]
    junctions = [
        one.model_copy(update={"at_m": (one.at_m[0], one.at_m[1] * depth_m / DEPTH_M)})
        for one in storey.junctions
    ]
    return changed(junctions=junctions, rooms=[])


@pytest.mark.parametrize("depth_m", [2.4, 3.0, 5.0])
def test_no_neighbour_stands_beyond_the_roof(depth_m: float) -> None:
    document = with_terrace(as_deep_as(depth_m), ASKED, by_text=False)
    options = terrace_options(document, ASKED)
    part = build_neighbours(build_house(document, options), options, 0.0)
    assert part is not None
    of_roof = [row for row, name in enumerate(part.features.name) if name.endswith("roof")]
    feature = part.polygon_feature[part.triangles.polygon]
    corners = part.positions_m[part.triangles.indices].astype(float)
    roofs = corners[np.isin(feature, of_roof)].reshape(-1, 3)
    blocks = corners[~np.isin(feature, of_roof)].reshape(-1, 3)
    assert roofs[:, 0].min() == pytest.approx(blocks[:, 0].min(), abs=0.02)
    assert roofs[:, 0].max() == pytest.approx(blocks[:, 0].max(), abs=0.02)


def test_party_walls_that_leave_no_plot_leave_it_all_around() -> None:
    """As of a court: each lies on the other's side."""
    document = with_terrace(sample_plan(), ASKED, by_text=False)
    space = build_house(document, terrace_options(document, ASKED)).spaces[0]
    first, second = parties_of(space)
    crossed = [Party(second.face_m, first.out), Party(first.face_m, second.out)]
    assert own_plot(space.slab, crossed).bounds == own_plot(space.slab, []).bounds
    assert own_plot(space.slab, parties_of(space)).area < own_plot(space.slab, []).area


def test_party_walls_of_a_court_have_no_row_beyond_them() -> None:
    corners = [(0, 0), (10, 0), (10, 8), (7, 8), (7, 3), (3, 3), (3, 8), (0, 8)]
    junctions = [Junction(id=f"j{index}", at_m=at, type="L") for index, at in enumerate(corners)]
    walls = [
        wall(f"w{index}", f"j{index}", f"j{(index + 1) % 8}", party=index in (3, 5))
        for index in range(8)
    ]
    document = changed(junctions=junctions, walls=walls, rooms=[], openings=[])
    options = terrace_options(document, ASKED)
    house = build_house(document, options)
    assert any("no row goes on at 2 of its sides" in note for note in house.part.notes)
    assert build_neighbours(house, options, 0.0) is None
    assert terrain_of(house.spaces[0], 0.0).plot.bounds == own_plot(house.spaces[0].slab, []).bounds


def test_a_side_in_two_walls_ends_at_the_farther_one() -> None:
    corners = [(0, 8), (0, 0), (10, 0), (10, 4), (10.3, 4), (10.3, 8)]
    junctions = [Junction(id=f"j{index}", at_m=at, type="L") for index, at in enumerate(corners)]
    walls = [
        wall(f"w{index}", f"j{index}", f"j{(index + 1) % 6}", party=index in (0, 2, 4))
        for index in range(6)
    ]
    document = changed(junctions=junctions, walls=walls, rooms=[], openings=[])
    left, right = parties_of(build_house(document, HouseOptions()).spaces[0])
    assert left.face_m @ left.out == pytest.approx(HALF)
    assert right.face_m @ right.out == pytest.approx(10.3 + HALF)


def test_the_plot_ends_at_the_neighbours() -> None:
    document = with_terrace(sample_plan(), ASKED, by_text=False)
    house = build_house(document, terrace_options(document, ASKED))
    left, bottom, right, top = terrain_of(house.spaces[0], 0.0).plot.bounds
    assert (left, right) == pytest.approx((-HALF, WIDTH_M + HALF), abs=1e-6)
    assert bottom < -10.0
    assert top > DEPTH_M + 10.0


def test_openings_that_are_closed_are_named_with_their_storeys() -> None:
    storey = sample_plan().storeys[0]
    ground = storey.model_copy(
        update={"openings": [*storey.openings, window("o7", "east", 2.0, 1.0)]}
    )
    upper = ground.model_copy(update={"name": "first floor", "elevation_m": 2.8})
    plan = sample_plan().model_copy(update={"storeys": [ground, upper]})
    said = with_terrace(plan, ASKED, by_text=True).storeys[0].doubts
    assert any("o7 of ground floor, o7 of first floor" in one for one in said)
