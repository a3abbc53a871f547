"""Plans of strangers that once failed: what is right of each is kept right.

Not yet right, and therefore only in part here: of `jp_madori` the storeys are parted and closets
slide, but ROOM 1 has no way out and stairs do not meet; of `fr_13` the bedrooms lose what lies
behind height lines, and its stairs; of `b3d_3` two bedrooms are one, and so are study and suite; of
`b3d_5` the door of the shower room, whose leaf hides its stub, is not.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import pytest

from veduta.imaging.read import read_image
from veduta.plan.analyse import ReadPlan, read_drawings
from veduta.plan.document import Storey
from veduta.plan.doubts import doubts
from veduta.plan.options import PlanOptions
from veduta.plan.pages import find_drawings
from veduta.plan.reading import cleaned_sheet
from veduta.plan.several_plans import storeys_drawn
from veduta.plan.text.orientation import find_position
from veduta.plan.text.sheet_text import read_sheet
from veduta.run.errors import NotFoundError

pytestmark = pytest.mark.regression


@pytest.fixture
def cases(veduta_data: Path) -> Path:
    folder = veduta_data / "cases" / "plan"
    if not folder.is_dir():
        pytest.skip(f"no cases/plan in {veduta_data}")
    return folder


@lru_cache(maxsize=4)
def read(*paths: Path) -> ReadPlan:
    drawings = find_drawings(list(paths), None)
    return read_drawings(drawings, PlanOptions(), [], lambda *_: None)


def areas(storey: Storey) -> dict[str, float]:
    return {room.name.casefold() or room.use: room.area_m2 for room in storey.rooms}


def total(storey: Storey) -> float:
    return sum(room.area_m2 for room in storey.rooms)


def test_hebrew_writing_mirrors_no_sheet(cases: Path) -> None:
    assert find_position(read_image(cases / "heb_73351.jpg").pixels).is_upright


def test_a_coloured_garden_is_paper_and_a_sellers_rooms_are_found(cases: Path) -> None:
    """Nine rooms and a corridor; bedrooms have 10 to 16 m2 by the sizes that are printed."""
    (storey,) = read(cases / "heb_73351.jpg").document.storeys
    sizes = sorted(room.area_m2 for room in storey.rooms)
    assert 9 <= len(sizes) <= 10
    assert 80.0 < sum(sizes) < 130.0
    assert 30.0 < sizes[-1] < 50.0


def test_storeys_side_by_side_are_two_by_their_titles(cases: Path) -> None:
    plan = read(cases / "tf2_123.jpg").document
    ground, first = plan.storeys
    assert (ground.name, first.name) == ("Ground Floor", "First Floor")
    # Printed: 39.29 and 36.97 m2.
    assert total(ground) == pytest.approx(39.29, rel=0.03)
    assert total(first) == pytest.approx(36.97, rel=0.03)
    assert len(ground.rooms) == 4
    assert len(first.rooms) >= 6
    assert any("2 plans lie on this sheet" in one for one in doubts(plan, None))


def test_three_plans_apart_are_three_storeys(cases: Path) -> None:
    sheet = read_sheet(read_image(cases / "jp_madori.png").pixels)
    assert len(storeys_drawn(*cleaned_sheet(sheet.pixels, sheet.texts))) == 3
    assert any("帖" in text.text for text in sheet.texts)


def test_closets_of_panels_from_wall_to_wall_slide(cases: Path) -> None:
    _, first, second = read(cases / "jp_madori.png").document.storeys
    for storey in (first, second):
        sliding = [one for one in storey.openings if one.type == "sliding"]
        assert len(sliding) == 1
        closets = [one for one in storey.rooms if sliding[0].id in one.openings]
        assert min(one.area_m2 for one in closets) < 2.5
    # Doors in walls of two lines that run on: the bath, and both rooms of the top.
    assert sum(one.type == "swing" for one in first.openings) >= 2
    assert sum(one.type == "swing" for one in second.openings) >= 2


def test_a_thin_outline_beside_party_walls_closes_its_rooms(cases: Path) -> None:
    (storey,) = read(cases / "de_wohnung.png").document.storeys
    found = areas(storey)
    for name, area in {"zimmer": 9.14, "schlafzimmer": 12.14, "küche": 8.25, "bad": 4.56}.items():
        assert found[name] == pytest.approx(area, rel=0.03), name
    # As large as they are drawn: by the four others, a tenth less than the sheet says.
    for name, area in {"wohnen": 20.96, "flur": 14.49}.items():
        assert found[name] == pytest.approx(area, rel=0.1), name
    assert not any("<" in one.text for one in storey.scale.evidence)


def test_the_wall_of_a_plot_is_a_fence(cases: Path) -> None:
    (storey,) = read(cases / "pdf_30x50_Model_landscape.pdf").document.storeys
    assert any("it is a fence" in note for note in storey.notes)
    assert total(storey) < 80.0
    assert sum(one.kind == "window" for one in storey.openings) >= 8
    assert "living" not in areas(storey)


def test_the_scale_of_a_sheet_with_height_lines(cases: Path) -> None:
    (storey,) = read(cases / "fr_13.png").document.storeys
    found = areas(storey)
    assert found["palier"] == pytest.approx(11.93, rel=0.03)
    assert not any("ht" in one.text for one in storey.scale.evidence)


def test_cars_are_no_walls(cases: Path) -> None:
    (storey,) = read(cases / "b3d_3.png").document.storeys
    garage = next(room for room in storey.rooms if "garage" in room.name)
    # Twice as long as deep and closed, with no wall in it.
    assert len(garage.outline_m) <= 8
    # Beds and cars are painted over, so that thin inner walls count, and doors say the scale.
    assert len(storey.rooms) >= 12
    assert 24.0 < garage.area_m2 < 42.0


def test_chimney_breasts_are_no_slanted_walls(cases: Path) -> None:
    (storey,) = read(cases / "b3d_5.png").document.storeys
    at = {one.id: one.at_m for one in storey.junctions}
    party = min(point[0] for point in at.values()) + 0.6
    on_party = {wall.id for wall in storey.walls if max(at[wall.start][0], at[wall.end][0]) < party}
    assert on_party
    assert not [one for one in storey.openings if one.wall in on_party and one.kind == "window"]


def test_a_sketch_that_gives_no_house_ends_with_the_reason(cases: Path) -> None:
    with pytest.raises(NotFoundError, match="strokes that are none of a plan"):
        read(cases / "b3d_6_sketch.jpg")


def test_feet_without_marks_make_a_house(cases: Path) -> None:
    (storey,) = read(cases / "web_2d.jpg").document.storeys
    assert 45.0 < total(storey) < 70.0
    bedroom = max(room.area_m2 for room in storey.rooms if room.use == "bedroom")
    # 12 x 13 feet are the largest.
    assert bedroom == pytest.approx(12 * 13 * 0.3048**2, rel=0.15)


def test_storeys_of_two_files_agree_in_scale(cases: Path) -> None:
    ground, first = read(cases / "two_g.png", cases / "two_f.png").document.storeys
    assert total(first) == pytest.approx(36.97, rel=0.03)
    assert ground.scale.metres_per_px == pytest.approx(first.scale.metres_per_px)
