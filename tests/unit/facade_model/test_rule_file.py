"""The rules of a building: clean, laid out, and derived to what the document says."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from math import cos, radians, sin

import numpy as np
import pytest
from closed_shells import assert_closed, shells
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_document import FACADE_M, element, sample_document, sample_photo
from test_any_document import PHOTO, elements, model_sizes

from veduta import _core
from veduta.facade.document import Element, FacadeDocument
from veduta.facade.layout import SLAB_M
from veduta.facade.model import build_model
from veduta.facade.options import ModelSizes
from veduta.facade.plan import plan_building
from veduta.facade.rectangles import Rectangle
from veduta.facade.rule_head import RULES
from veduta.grammar.brought import with_imports
from veduta.grammar.building import build_part
from veduta.place.material import Texture
from veduta.place.part import Part

LOT = [(0.0, 0.0, 0.0), (12.0, 0.0, 0.0), (12.0, 10.0, 0.0), (0.0, 10.0, 0.0)]


def rules_of(document: FacadeDocument) -> str:
    return build_model(document, sample_photo(document), "sample").rules


def derived(
    text: str,
    attributes: dict[str, float] | None = None,
    lot: list[tuple[float, float, float]] = LOT,
    textures: Mapping[str, Texture] | None = None,
) -> Part:
    """The rules alone, as `veduta grammar derive` takes them."""
    (found,) = _core.GrammarRules(with_imports(RULES, text)).derive(
        [[lot]], [0], attributes=[dict(attributes or {})]
    )
    assert not isinstance(found, str), found
    return build_part(found, "sample", textures=textures or {})


def points_of(part: Part, name: str) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
    row = part.features.name.index(name)
    ends = part.ring_offsets[part.polygon_offsets]
    chosen = np.flatnonzero(part.polygon_feature == row)
    return np.concatenate([part.positions_m[ends[k] : ends[k + 1]] for k in chosen])


def box(part: Part, name: str) -> tuple[float, float, float, float]:
    """x0, z0, x1, z1 of a surface (m)."""
    points = points_of(part, name)
    (x0, _, z0), (x1, _, z1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return x0, z0, x1, z1


@settings(max_examples=30)
@given(
    items=st.lists(elements, max_size=24),
    roof_m=st.sampled_from([-1.0, 0.0, 0.6, 3.6, 9.0]),
    facade_m=st.tuples(st.floats(0.5, 40.0), st.floats(0.5, 40.0)),
    chosen=model_sizes(),
)
def test_the_rules_of_any_document_are_clean(
    items: list[Element], roof_m: float, facade_m: tuple[float, float], chosen: ModelSizes
) -> None:
    text = build_model(sample_document(items, roof_m, facade_m, chosen), PHOTO, "any").rules
    told, errors, warnings, underived = _core.grammar_check(with_imports(RULES, text))
    assert (told, errors, warnings, underived) == ("", 0, 0, "")
    assert _core.grammar_format(RULES, text) == text


def test_windows_are_where_the_document_has_them() -> None:
    document = sample_document(elements=[e for e in sample_document().elements if e.y_m < 15])
    plain = [e for e in document.elements if e.class_ != "balcony"]  # they hide the windows' feet
    document = sample_document(elements=plain)
    part = derived(rules_of(document))
    windows = [e for e in plain if e.class_ == "window"]
    assert len(windows) == 16
    for number, window in enumerate(windows, start=1):
        wanted = (
            window.x_m,
            window.y_m,
            window.x_m + window.width_m,
            window.y_m + window.height_m,
        )
        assert box(part, f"window {number}") == pytest.approx(wanted, abs=1e-3)


def test_all_that_stands_on_the_front_is_in_its_place() -> None:
    part = derived(rules_of(sample_document()))
    for name, wanted in {
        "balcony 1": (0.4, 6.1 - SLAB_M, 11.6, 7.1),
        "door 2": (9.2, 0.05, 10.8, 2.8),
        "shop 1": (0.6, 0.05, 8.0, 3.0),
        "chimney 1": (8.9, 18.06 - 0.3, 10.3, 19.2),
        "window 17": (1.2, 15.6, 2.2, 17.1),
        "front wall": (0.0, 0.0, *FACADE_M),
    }.items():
        assert box(part, name) == pytest.approx(wanted, abs=1e-3), name


def test_names_tell_the_side_of_a_slope() -> None:
    part = derived(rules_of(sample_document(elements=[])))
    outwards = {"front": (1, -1), "right": (0, 1), "back": (1, 1), "left": (0, -1)}
    for which in ("lower", "upper"):
        for side, (axis, sign) in outwards.items():
            row = part.features.name.index(f"{side} {which} slope")
            (polygon,) = np.flatnonzero(part.polygon_feature == row)
            normal = part.triangles.polygon_normal[polygon]
            assert np.sign(normal[axis]) == sign
            assert abs(normal[1 - axis]) < 1e-6


def test_rules_alone_say_what_surfaces_are() -> None:
    document = sample_document()
    model = build_model(document, sample_photo(document), "sample").part
    alone = derived(rules_of(document))
    assert alone.features.id == model.features.id
    for column in ("class_code", "provenance_code", "parent", "shell"):
        np.testing.assert_array_equal(
            getattr(alone.features, column), getattr(model.features, column)
        )
    assert alone.positions_m.tobytes() == model.positions_m.tobytes()


def test_the_building_turns_with_its_lot() -> None:
    document = sample_document()
    model = build_model(document, sample_photo(document), "sample")
    angle = radians(30.0)
    turn = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
    turned = [(*(np.array([x, y]) @ turn).tolist(), 0.0) for x, y, _ in LOT]
    there = derived(model.rules, lot=turned, textures=model.textures)
    assert_closed(there)
    own = model.part
    np.testing.assert_allclose(
        there.positions_m[:, :2], own.positions_m[:, :2].astype(np.float64) @ turn, atol=1e-5
    )
    np.testing.assert_allclose(there.positions_m[:, 2], own.positions_m[:, 2], atol=1e-5)
    np.testing.assert_allclose(np.clip(there.uv, 0, 1), own.uv, atol=1e-5)


@pytest.mark.parametrize(
    ("change", "volume_m3"),
    [
        ({"floor2": 4.0}, 120.0),
        ({"depth": 11.0}, None),
        ({"width": 14.0}, None),
        ({"setback": 0.0}, None),
        ({"setback": 0.35}, None),
        ({"roofAngle": 68.0}, None),
        ({"roofAngle": 55.0}, None),
        ({"lowerRoof": 4.0}, None),
        ({"slab": 0.25, "railing": 0.1, "deep": 1.0}, None),
        ({"frame": 0.1, "lid": 0.2, "cheek": 0.2}, None),
    ],
)
def test_an_edited_building_closes_too(change: dict[str, float], volume_m3: float | None) -> None:
    text = rules_of(sample_document())
    before, after = derived(text), derived(text, change)
    assert_closed(after)
    assert len(after.features) >= 79 - 25  # without recesses, no reveals
    if volume_m3 is not None:
        body, taller = next(shells(before)), next(shells(after))
        assert taller.volume - body.volume == pytest.approx(volume_m3, rel=1e-4)
        assert after.bounds_m[1][2] == pytest.approx(before.bounds_m[1][2] + 1.0, abs=1e-4)


def test_what_stands_on_a_floor_or_the_roof_goes_with_it() -> None:
    text = rules_of(sample_document())
    before, after = derived(text), derived(text, {"floor1": 4.0, "floor3": 2.5})
    # What is between a window and the lines of its floor (0.9 below, 0.4 above it) grows alike.
    moves = {"window 1": 0.9 / 1.3, "balcony 1": 1.0, "window 18": 0.5, "chimney 1": 0.5}
    for name, move_m in moves.items():
        assert box(after, name)[1] == pytest.approx(box(before, name)[1] + move_m, abs=1e-4), name


def test_a_wider_floor_keeps_the_sizes_of_windows() -> None:
    text = rules_of(sample_document())
    before, after = derived(text), derived(text, {"width": 15.0})
    for number in range(1, 17):
        x0, z0, x1, z1 = box(before, f"window {number}")
        moved = box(after, f"window {number}")
        assert moved[2] - moved[0] == pytest.approx(x1 - x0, abs=1e-5)
        assert (moved[1], moved[3]) == pytest.approx((z0, z1), abs=1e-5)
        assert moved[0] > x0


@pytest.mark.parametrize(
    ("foot_m", "height_m", "lines_m"),
    [
        (3.9, 1.7, [0.0, 3.0, 6.0, 9.0, 12.0, 15.0]),
        (2.8, 1.7, [0.0, 2.8, 6.0, 9.0, 12.0, 15.0]),  # over the first floor's line, by a little
        (1.8, 1.7, [0.0, 3.5, 6.0, 9.0, 12.0, 15.0]),
        (1.5, 3.0, [0.0, 6.0, 9.0, 12.0, 15.0]),  # as much in the ground floor as in the first
    ],
)
def test_lines_between_floors_cut_no_opening(
    foot_m: float, height_m: float, lines_m: list[float]
) -> None:
    document = sample_document(elements=[element("window", 4.0, foot_m, 1.0, height_m)])
    bands = plan_building(document).bands
    assert [bands[0].foot_m, *(band.top_m for band in bands)] == pytest.approx(lines_m)
    assert all(low.top_m == high.foot_m for low, high in pairwise(bands))
    (opening,) = [o for band in bands for o in band.openings]
    assert opening.rectangle == Rectangle(4.0, foot_m, 5.0, foot_m + height_m)


def test_a_name_of_a_photo_ends_no_comment() -> None:
    document = sample_document(elements=[])
    source = document.source.model_copy(update={"image": "odd*/name.jpg"})
    text = rules_of(document.model_copy(update={"source": source}))
    assert _core.grammar_check(with_imports(RULES, text))[1] == 0
