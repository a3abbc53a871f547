"""Railings, leaves, dormers, cornices and chimneys of the asset library, and the sides' wall."""

from __future__ import annotations

import numpy as np
import pytest
from closed_shells import assert_closed
from numpy.typing import NDArray
from sample_document import EAVES_PX, METRES_PER_PX, element, sample_document, sample_photo

from veduta.facade.depth_words import depth_of_opening
from veduta.facade.document import Element, FacadeDocument, Moulding, Shutter, ShutterKind
from veduta.facade.model import build_model
from veduta.facade.options import ModelSizes
from veduta.facade.plan import plan_building
from veduta.facade.side_wall import side_of
from veduta.place.instances import placed
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass


def _document() -> FacadeDocument:
    mouldings = [
        Moulding(
            kind=kind,
            x_px=20.0,
            y_px=EAVES_PX + down / METRES_PER_PX,
            width_px=480.0,
            height_px=high / METRES_PER_PX,
            score=0.8,
            provenance="measured",
        )
        for kind, down, high in (("modillions", 0.0, 0.6), ("string-course", 12.0, 0.2))
    ]
    document = sample_document(sizes=ModelSizes(detail="library"))
    return document.model_copy(update={"mouldings": mouldings, "shutters": _shutters(document)})


def _shutters(document: FacadeDocument) -> list[Shutter]:
    """An open leaf left of a window behind a balcony, a blind over half of it, one in the wall."""
    window = _shuttered(document)
    x, y, wide, high = window.x_px, window.y_px, window.width_px, window.height_px

    def shutter(kind: ShutterKind, left: float, width: float, height: float) -> Shutter:
        return Shutter(kind=kind, x_px=left, y_px=y, width_px=width, height_px=height, score=0.9)

    return [
        shutter("open", x - 0.3 * wide, 0.3 * wide, high),
        shutter("closed", x, wide, 0.5 * high),
        shutter("closed", 22.0, 30.0, high),
    ]


def _shuttered(document: FacadeDocument) -> Element:
    """The second window of the second floor; it is 1.2 m wide and 1.7 m high."""
    return next(e for e in document.elements if (e.x_m, e.y_m) == (4.0, 6.9))


@pytest.fixture(scope="module")
def part() -> Part:
    document = _document()
    return build_model(document, sample_photo(document), "house").part


def _instances(part: Part) -> dict[str, int]:
    """How often things stand in each feature."""
    counts: dict[str, int] = {}
    assert part.instances is not None
    for group in part.instances.groups:
        for row in group.feature.tolist():
            name = part.features.name[row]
            counts[name] = counts.get(name, 0) + 1
    return counts


def _box_of(part: Part, name: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper corner of the things of a feature (m)."""
    assert part.instances is not None
    found = []
    for group in part.instances.groups:
        corners = placed(group.part_from_mesh, part.instances.meshes[group.mesh].positions_m)
        found += [
            corners[k] for k, row in enumerate(group.feature) if part.features.name[row] == name
        ]
    points = np.concatenate(found)
    return points.min(axis=0), points.max(axis=0)


def test_the_body_is_closed_and_all_is_there(part: Part) -> None:
    assert_closed(part)
    told = "closed shutter (shutters[2]): not built, no window that is built is beside it"
    assert part.notes == (told,)
    found = _instances(part)
    assert found["balcony 1"] > found["balcony 2"] > 2
    assert found["leaf of door 2"] == 1
    assert found["moulding 1"] > found["moulding 2"] >= 1
    assert {f"dormer {k}" for k in range(1, 5)} <= set(found)
    assert "chimney 1" in found
    classes = {
        part.features.semantic(part.features.name.index(name))
        for name in ("moulding 1", "dormer 1")
    }
    assert classes == {SemanticClass("cornice"), SemanticClass("wall")}


def test_nothing_stands_far_from_where_the_document_has_it(part: Part) -> None:
    low, high = part.bounds_m
    assert low[1] > -0.75  # balconies are the furthest before the front
    assert low[0] > -0.2
    assert high[0] < 12.2


def test_shutters_lie_beside_their_window_or_in_it(part: Part) -> None:
    """The leaf goes down to the floor of the balcony; what is before no window is left out."""
    found = {name for name in _instances(part) if name.startswith("shutter")}
    assert found == {"shutter 1", "shutter 2"}
    # y points into the house: the setback is 0.2 m.
    low, high = _box_of(part, "shutter 1")
    assert low == pytest.approx([3.64, -0.065, 6.1], abs=0.01)
    assert high == pytest.approx([4.0, -0.02, 8.6], abs=0.01)
    low, high = _box_of(part, "shutter 2")
    assert low == pytest.approx([4.0, 0.135, 7.75], abs=0.02)
    assert high == pytest.approx([5.2, 0.18, 8.6], abs=0.02)


def test_a_passage_is_deep_and_has_no_leaf() -> None:
    """Three metres, which are invented; the house door beside it has its leaf."""
    document = _document()
    door = next(e for e in document.elements if e.class_ == "door" and e.x_m == 9.2)
    passage = door.model_copy(update={"passage": True})
    elements = [passage if e is door else e for e in document.elements]
    changed = document.model_copy(update={"elements": elements})
    part = build_model(changed, sample_photo(document), "house").part
    assert_closed(part)
    names = part.features.name
    assert "leaf of door 2" not in names
    row = names.index("reveal of door 2")
    triangles = part.triangles
    own = part.polygon_feature[triangles.polygon] == row
    corners = part.positions_m[triangles.indices[own]].reshape(-1, 3)
    assert corners[:, 1].max() == pytest.approx(3.0, abs=0.01)
    assert part.features.provenance(row) is Provenance.INVENTED


@pytest.mark.parametrize(("foot_m", "out_m", "deep_m"), [(15.0, 0.0, 0.07), (13.9, 0.25, 0.25)])
def test_a_balustrade_stands_on_the_wall_or_before_its_end(
    foot_m: float, out_m: float, deep_m: float
) -> None:
    """Bars before the sky; and stone before the wall, where the photo has no sky behind it."""
    document = _document()
    balcony = next(e for e in document.elements if e.class_ == "balcony" and e.width_m > 9.0)
    y_px = EAVES_PX + (14.0 - foot_m) / METRES_PER_PX
    rail = balcony.model_copy(update={"y_m": foot_m, "y_px": y_px, "balustrade": True})
    elements = [e for e in document.elements if e.class_ != "balcony"]
    changed = document.model_copy(update={"elements": [*elements, rail], "shutters": []})
    made = build_model(changed, sample_photo(document), "house")
    assert_closed(made.part)
    assert "attr railingKind" not in made.rules
    assert _instances(made.part)["balcony 1"] > 5
    low, high = _box_of(made.part, "balcony 1")
    assert low == pytest.approx([0.4, -out_m, foot_m], abs=0.05)
    assert high == pytest.approx([11.6, deep_m - out_m, foot_m + 1.0], abs=0.05)
    assert ("ledge under balcony 1" in made.part.features.name) == (out_m > 0.0)


def test_leaves_without_a_window_stay_as_they_are_in_the_photo() -> None:
    """None is built in bare wall, nor one of 7 cm; the photo is filled where one is built."""
    document = _document()
    window, (leaf, *_) = _shuttered(document), document.shutters
    narrow = leaf.model_copy(update={"x_px": window.x_px + window.width_px, "width_px": 3.0})
    changed = document.model_copy(update={"shutters": [leaf, narrow]})
    made = build_model(changed, sample_photo(document), "house")
    assert {n for n in _instances(made.part) if n.startswith("shutter")} == {"shutter 1"}
    reason = "it is too small, or has no room"
    assert f"open shutter (shutters[1]): not built, {reason}" in made.part.notes
    assert made.cleared.shares["shutter"] > 0.0
    elements = [e for e in document.elements if e is not window and e.class_ != "balcony"]
    bare = build_model(
        changed.model_copy(update={"elements": elements}), sample_photo(document), "house"
    )
    assert not any(name.startswith("shutter") for name in _instances(bare.part))
    told = "open shutter (shutters[0]): not built, no window that is built is beside it"
    assert told in bare.part.notes
    assert "shutter" not in bare.cleared.shares


def test_a_leaf_as_wide_as_numbers_go_fills_no_more_than_the_picture() -> None:
    document = _document()
    leaf = document.shutters[0].model_copy(update={"width_px": 1e6, "height_px": 1e6})
    wide = document.model_copy(update={"shutters": [leaf]})
    made = build_model(wide, sample_photo(document), "house")
    assert "shutter 1" in _instances(made.part)
    assert made.cleared.shares.get("shutter", 0.0) <= 1.0


def test_a_passage_through_a_shop_cuts_it_and_is_deep() -> None:
    """It is no door of the shop: as wide as it was seen, three metres deep, down to the ground."""
    through = element("door", 3.0, 0.0, 2.4, 2.6).model_copy(update={"passage": True})
    across = element("door", 7.0, 0.0, 2.4, 2.6).model_copy(update={"passage": True})
    for passage, shop in ((through, (0.5, 8.0)), (across, (0.5, 7.5))):
        document = sample_document([element("shop", shop[0], 0.0, shop[1], 3.0), passage])
        plan = plan_building(document)
        found = {o.element.class_: o for band in plan.bands for o in band.openings}
        assert found["door"].rectangle.width == pytest.approx(2.4)
        assert found["shop"].children == ()
        assert depth_of_opening(found["door"], plan, "setback", 1.0).m == 3.0


def test_the_photo_on_plain_boxes_has_none_of_it() -> None:
    document = _document()
    photo = document.model_copy(update={"model": ModelSizes(detail="photo")})
    made = build_model(photo, sample_photo(document), "house")
    assert made.part.instances is None or not made.part.instances.groups
    assert "attr library = false" in made.rules


def test_railings_have_the_colour_of_the_photo(part: Part) -> None:
    assert part.instances is not None
    row = part.features.name.index("balcony 1")
    numbers = {
        number
        for group in part.instances.groups
        if row in group.feature.tolist()
        for number in group.materials
    }
    colours = np.array([part.materials[number].colour for number in numbers])
    assert (np.abs(colours - np.array([40, 40, 44]) / 255.0) < 0.06).all()


def test_the_sides_have_the_wall_and_its_base_without_courses() -> None:
    front = np.zeros((200, 80, 3), np.uint8)
    front[:150], front[150:] = (200, 180, 150), (150, 120, 90)
    front[80:88] = (120, 100, 80)
    wall = np.ones((200, 80), np.bool_)
    front[20:60, 20:60] = 0
    wall[20:60, 20:60] = False
    side = side_of(front, wall, slice(0, 200), (0.7, 0.6, 0.5))
    assert np.abs(side[5:145].mean(axis=1) - (200, 180, 150)).max() < 4.0
    assert np.abs(side[155:].mean(axis=1) - (150, 120, 90)).max() < 4.0


def test_shadows_make_no_base() -> None:
    front = np.full((200, 80, 3), 180, np.uint8)
    front[150:] = 174
    side = side_of(front, np.ones((200, 80), np.bool_), slice(0, 200), (0.7, 0.7, 0.7))
    assert np.abs(side.astype(float).mean(axis=1) - 180.0).max() < 3.0


def test_a_front_without_wall_has_the_usual_colour() -> None:
    front = np.zeros((40, 30, 3), np.uint8)
    side = side_of(front, np.zeros((40, 30), np.bool_), slice(0, 40), (0.5, 0.5, 0.5))
    assert np.abs(side.astype(float) - 127.5).max() < 12.0


def test_a_railing_of_other_stuff_is_of_its_own_kind() -> None:
    document = _document()
    photo = sample_photo(document).copy()
    plain = build_model(document, photo, "house").rules
    assert "set(railingKind" not in plain
    balcony = next(e for e in document.elements if e.class_ == "balcony")
    x, y = round(balcony.x_px), round(balcony.y_px)
    photo[y : y + round(balcony.height_px), x : x + round(balcony.width_px)] = (200, 190, 170)
    made = build_model(document, photo, "house").rules
    assert made.count('set(railingKind, "stone")') == 1
    assert made.count('attr railingKind = "iron"') == 1
