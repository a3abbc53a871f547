"""The building of the sample document, against closed forms and trimesh."""

from __future__ import annotations

from math import cos, radians, tan

import numpy as np
import pytest
from closed_shells import assert_closed, shells
from sample_document import FACADE_M, ROOF_M, element, sample_document, sample_photo

from veduta.facade.adjusted import count_adjusted
from veduta.facade.document import FacadeClass
from veduta.facade.model import build_part
from veduta.facade.options import ModelSizes
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

DEPTH_M, SETBACK_M = 10.0, 0.2


@pytest.fixture(scope="module")
def part() -> Part:
    document = sample_document()
    return build_part(document, sample_photo(document), "sample")


def rows(part: Part, semantic: SemanticClass) -> list[int]:
    return np.flatnonzero(part.features.class_code == semantic.code).tolist()


def test_every_shell_is_closed(part: Part) -> None:
    assert_closed(part)


def test_every_element_is_there_once(part: Part) -> None:
    document = sample_document()
    for name in ("window", "door", "shop"):
        wanted = sum(1 for item in document.elements if item.class_ == name)
        assert len(rows(part, SemanticClass(name))) == wanted
    assert part.notes == ()


def test_bare_building_has_the_volume_of_box_and_mansard() -> None:
    document = sample_document(elements=[])
    part = build_part(document, sample_photo(document), "bare")
    width, height = FACADE_M
    lower, upper = 0.85 * ROOF_M, 0.15 * ROOF_M
    inset = lower / tan(radians(72.0))
    a, b = width - 2 * inset, DEPTH_M - 2 * inset
    # The frustum of two rectangles that are not similar: Simpson's rule is exact.
    middle = (width - inset) * (DEPTH_M - inset)
    frustum = lower / 6 * (width * DEPTH_M + 4 * middle + a * b)
    short, long = min(a, b), max(a, b)
    hip = upper * short * (3 * long - short) / 6
    body = next(shells(part))
    assert body.volume == pytest.approx(width * DEPTH_M * height + frustum + hip, rel=1e-5)


def test_openings_take_their_volume_out_of_the_wall() -> None:
    window = element("window", 4.0, 6.0, 1.2, 1.8)
    bare = sample_document(elements=[], roof_m=0.0)
    holed = sample_document(elements=[window], roof_m=0.0)
    photo = sample_photo(bare)
    volumes = [next(shells(build_part(document, photo, "x"))).volume for document in (bare, holed)]
    glass = (1.2 - 0.12) * (1.8 - 0.12) * 0.25 * SETBACK_M
    assert volumes[0] - volumes[1] == pytest.approx(1.2 * 1.8 * SETBACK_M + glass, rel=1e-3)


def test_wall_area_is_the_facade_less_its_openings() -> None:
    windows = [element("window", 1.0 + 3 * k, 6.0, 1.2, 1.8) for k in range(3)]
    document = sample_document(elements=windows)
    part = build_part(document, sample_photo(document), "x")
    wall = part.features.name.index("front wall")
    assert part.feature_area_m2[wall] == pytest.approx(
        FACADE_M[0] * FACADE_M[1] - 3 * 1.2 * 1.8, rel=1e-5
    )


def test_front_slope_leans_by_the_mansards_angle() -> None:
    document = sample_document(elements=[])
    part = build_part(document, sample_photo(document), "x")
    slope = part.features.name.index("front lower slope")
    polygon = int(np.flatnonzero(part.polygon_feature == slope)[0])
    normal = part.triangles.polygon_normal[polygon]
    assert normal[1] < 0
    assert normal[2] == pytest.approx(cos(radians(72.0)), abs=1e-6)


def test_nothing_beside_balconies_stands_before_the_facade_plane(part: Part) -> None:
    body = part.features.shell[part.polygon_feature] == 0
    first = part.ring_offsets[part.polygon_offsets[:-1]]
    last = part.ring_offsets[part.polygon_offsets[1:]]
    for begin, end in zip(first[body], last[body], strict=True):
        assert part.positions_m[begin:end, 1].min() >= 0.0
    low, high = part.bounds_m
    assert low[1] == pytest.approx(-0.6)
    assert (low[0], low[2]) == (0.0, 0.0)
    assert high[1] == pytest.approx(DEPTH_M)


def test_openings_name_their_wall_and_their_photo(part: Part) -> None:
    wall = part.features.name.index("front wall")
    shop = rows(part, SemanticClass.SHOP)[0]
    parents = [int(part.features.parent[row]) for row in rows(part, SemanticClass.DOOR)]
    assert sorted(parents) == sorted([wall, shop])
    windows = rows(part, SemanticClass.WINDOW)
    said = [part.features.provenance(row) for row in windows]
    # The sample's second and third floors have balconies, which hide the foot of each window.
    assert (said.count(Provenance.MEASURED), said.count(Provenance.INFERRED)) == (12, 8)
    assert np.isnan(part.features.score[wall]), "a wall has no score"
    for row in windows:
        assert np.isfinite(part.features.photo_px[row]).all()
        assert 0.0 <= part.features.score[row] <= 1.0, "it says how sure it was"
        assert part.features.width_m[row] == pytest.approx(1.2, abs=0.3)


def test_provenance_says_what_no_photo_shows(part: Part) -> None:
    said = dict(zip(part.features.name, part.features.provenance_code.tolist(), strict=True))
    assert said["front wall"] == Provenance.MEASURED.code
    assert said["front lower slope"] == Provenance.MEASURED.code
    assert said["reveal of window 1"] == Provenance.INFERRED.code
    for name in ("left wall", "right wall", "back wall", "footprint", "back lower slope"):
        assert said[name] == Provenance.INVENTED.code


def test_window_behind_a_balcony_reaches_down_to_its_floor() -> None:
    window = element("window", 4.0, 7.0, 1.2, 1.5)
    balcony = element("balcony", 3.5, 6.0, 2.2, 1.0)
    document = sample_document(elements=[window, balcony])
    part = build_part(document, sample_photo(document), "x")
    row = rows(part, SemanticClass.WINDOW)[0]
    assert part.features.height_m[row] == pytest.approx(2.5)
    assert part.features.seen_height_m[row] == pytest.approx(1.5)
    assert part.features.provenance(row) is Provenance.INFERRED
    assert_closed(part)


@pytest.mark.parametrize("kind", ["door", "shop"])
@pytest.mark.parametrize(("foot_m", "seen_m"), [(0.0, np.nan), (0.1, np.nan), (0.4, 2.5)])
def test_what_is_made_to_reach_the_ground_says_what_was_seen(
    kind: FacadeClass, foot_m: float, seen_m: float
) -> None:
    document = sample_document(elements=[element(kind, 4.0, foot_m, 1.6, 2.5)])
    part = build_part(document, sample_photo(document), "x")
    row = rows(part, SemanticClass(kind))[0]
    # The wall keeps 5 cm below, so 5 cm are added to a foot at 10 cm: too little to speak of.
    assert part.features.height_m[row] == pytest.approx(2.5 + max(foot_m, 0.05) - 0.05, abs=0.06)
    assert part.features.seen_height_m[row] == pytest.approx(seen_m, nan_ok=True)
    extended = not np.isnan(seen_m)
    assert (part.features.provenance(row) is Provenance.INFERRED) == extended


def test_nothing_invented_becomes_inferred_by_reaching_down() -> None:
    door = element("door", 4.0, 0.4, 1.6, 2.5)
    door.provenance = "invented"
    document = sample_document(elements=[door])
    part = build_part(document, sample_photo(document), "x")
    row = rows(part, SemanticClass.DOOR)[0]
    assert part.features.provenance(row) is Provenance.INVENTED
    assert part.features.seen_height_m[row] == pytest.approx(2.5)


def test_overlapping_windows_are_clipped_and_said_so() -> None:
    pair = [element("window", 4.0, 6.0, 1.2, 1.8), element("window", 4.6, 6.2, 1.2, 1.8)]
    document = sample_document(elements=pair)
    part = build_part(document, sample_photo(document), "x")
    assert part.notes == ("window (elements[1]): clipped from 1.20 x 1.80 m to 0.55 x 1.80 m",)
    assert count_adjusted(part.notes) == {"left_out": 0, "clipped": 1}
    assert_closed(part)


def test_every_element_that_has_no_room_is_named() -> None:
    """What is in the document and not in the model is in the notes, each once."""
    elements = [
        element("door", 9.2, 0.0, 1.6, 2.8),
        element("window", 9.4, 2.0, 1.0, 0.6),  # over the leaf of the door
        element("door", 4.0, 15.2, 1.0, 2.0),  # on the roof
        element("window", 4.0, 6.0, 1.2, 1.8),
        element("window", 4.1, 6.1, 1.0, 1.6),  # on the window before it
        element("balcony", 20.0, 6.0, 1.0, 1.0),  # beside the facade
        element("window", 4.0, 15.6, 1.0, 1.5),  # on a roof that is flat
        element("chimney", 2.0, 3.0, 1.0, 1.0),  # below the eaves
        element("wall", 6.0, 6.0, 1.0, 1.0),  # no part of a model by itself
    ]
    document = sample_document(elements=elements, roof_m=0.0)
    part = build_part(document, sample_photo(document), "x")
    named = [f"{elements[n].class_} (elements[{n}]): left out, " for n in (5, 1, 2, 4, 6, 7, 8)]
    assert len(part.notes) == len(named)
    assert all(sum(start in note for note in part.notes) == 1 for start in named)
    assert count_adjusted(part.notes) == {"left_out": 7, "clipped": 0}
    kinds = [part.features.semantic(row).value for row in range(len(part.features))]
    assert (kinds.count("door"), kinds.count("window")) == (1, 1)
    assert kinds.count("balcony") == kinds.count("chimney") == 0


def test_a_balcony_over_the_border_is_clipped_and_said_so() -> None:
    document = sample_document(elements=[element("balcony", 11.0, 6.0, 3.0, 1.0)])
    part = build_part(document, sample_photo(document), "x")
    assert part.notes == ("balcony (elements[0]): clipped from 3.00 x 1.00 m to 1.00 x 1.00 m",)


def test_low_roof_is_flat_and_invented() -> None:
    document = sample_document(elements=[element("window", 4.0, 15.5, 1.0, 1.0)], roof_m=0.0)
    part = build_part(document, sample_photo(document), "x")
    row = part.features.name.index("flat roof")
    assert part.features.provenance(row) is Provenance.INVENTED
    assert any("no roof" in note for note in part.notes)
    assert part.bounds_m[1][2] == pytest.approx(FACADE_M[1])


def test_a_roof_that_is_called_flat_is_flat() -> None:
    document = sample_document([element("window", 4.0, 15.5, 1.0, 1.0)], roof_m=3.0)
    part = build_part(document.model_copy(update={"roof": "flat"}), sample_photo(document), "x")
    assert "flat roof" in part.features.name
    assert part.bounds_m[1][2] == pytest.approx(FACADE_M[1])


def test_photo_of_another_size_is_refused() -> None:
    document = sample_document()
    with pytest.raises(InputError, match=r"rectified\.jpg"):
        build_part(document, np.zeros((10, 10, 3), dtype=np.uint8), "x")


@pytest.mark.parametrize("width_m", [0.0, -3.0, 0.1, 2000.0, float("nan"), float("inf")])
def test_facade_of_no_building_is_refused(width_m: float) -> None:
    document = sample_document(elements=[])
    broken = document.model_copy(
        update={"facade": document.facade.model_copy(update={"width_m": width_m})}
    )
    with pytest.raises(InputError, match=r"the facade is .* m wide"):
        build_part(broken, sample_photo(document), "x")


def test_depth_of_no_building_is_refused() -> None:
    document = sample_document(elements=[], sizes=ModelSizes(depth_m=1e6))
    with pytest.raises(InputError, match="--depth-m"):
        build_part(document, sample_photo(document), "x")


def test_same_input_same_columns(part: Part) -> None:
    document = sample_document()
    again = build_part(document, sample_photo(document), "sample")
    assert again.positions_m.tobytes() == part.positions_m.tobytes()
    assert again.uv.tobytes() == part.uv.tobytes()
    assert again.features.id == part.features.id
